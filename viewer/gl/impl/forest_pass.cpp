// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/forest_pass.h"

#include "runtime/platform/cpu_time.h"
#include "viewer/gl/impl/program.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

// Bindings and locations of the shaders of trees.
constexpr GLuint kBarkTexture = 1;
constexpr GLuint kLeafTexture = 2;
constexpr GLuint kAlbedos = 3;
constexpr GLuint kNormals = 4;
constexpr GLuint kBoxes = 4; // in impostor.vert.glsl
constexpr GLuint kNormalMapTexture = 5;
constexpr GLint kPickedContent = 20; // in pick.frag.glsl
// Half the side of the shadow map, m: min, for an eye near the ground, and max.
constexpr float kMinShadowRange = 45.0F;
constexpr float kMinFarShadowRange = 120.0F; // min if other maps have the shadows near the eye
constexpr float kMaxShadowRange = 400.0F;
constexpr float kGroundBeyond = 3000.0F; // m, range of the ground around the forest

/// Bounding box of the casters, between the heights `low` and `high` (m), that can cast a shadow
/// into the map. `shadow_from_world`: matrix of shadow_matrix().
Bounds casters_of(const glm::mat4& shadow_from_world, float low, float high) {
    constexpr float kMinDepth = -3.0F; // in depths of the map; limits the box when the sun is low
    const glm::mat4 world_from_shadow = glm::inverse(shadow_from_world);
    Bounds casters;
    for (const float x : {-1.0F, 1.0F}) {
        for (const float y : {-1.0F, 1.0F}) {
            const glm::vec3 first(world_from_shadow * glm::vec4(x, y, 0.0F, 1.0F));
            const glm::vec3 last(world_from_shadow * glm::vec4(x, y, 1.0F, 1.0F));
            const glm::vec3 along = last - first; // downwards
            const auto depth_at = [&](float height) {
                const float depth = along.y < 0.0F ? (height - first.y) / along.y : kMinDepth;
                return glm::clamp(depth, kMinDepth, 1.0F);
            };
            casters.add(first + depth_at(high) * along);
            casters.add(first + depth_at(low) * along);
        }
    }
    return casters;
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

ForestPass::ForestPass(Device& device)
    : device_(&device), buffers_(device), impostors_(device), terrain_(device),
      quads_(make_vertex_array(device)), quad_trees_(device), branches_timer_(device),
      impostors_timer_(device), terrain_timer_(device), shadow_timer_(device) {
    glVertexArrayAttribIFormat(quads_.name(), 0, 1, GL_UNSIGNED_INT,
                               offsetof(ImpostorEntry, index));
    glVertexArrayAttribFormat(quads_.name(), 1, 2, GL_FLOAT, GL_FALSE,
                              offsetof(ImpostorEntry, range));
    for (const GLuint attribute : {0U, 1U}) {
        glEnableVertexArrayAttrib(quads_.name(), attribute);
        glVertexArrayAttribBinding(quads_.name(), attribute, 0);
    }
    glVertexArrayBindingDivisor(quads_.name(), 0, 1);
}

Result<void> ForestPass::reload(const ShaderSource& shaders) {
    std::array<ForestPrograms, 2> programs;
    for (const bool windy : {false, true}) {
        Result<ForestPrograms> made = make_forest_programs(*device_, shaders, windy);
        if (!made) {
            return made.error();
        }
        programs[windy ? 1 : 0] = std::move(made.value());
    }
    if (Result<void> done = impostors_.reload(shaders); !done) {
        return done;
    }
    if (Result<void> done = terrain_.reload(shaders); !done) {
        return done;
    }
    ProgramObject crown_program;
    if (device_->quality() > 0) {
        Result<ProgramObject> made =
            make_program(*device_, shaders, "crown.vert.glsl", "crown.frag.glsl");
        if (!made) {
            return made.error();
        }
        crown_program = std::move(made.value());
    }
    if (culling_ != nullptr) {
        if (Result<void> done = culling_->reload(shaders); !done) {
            return done;
        }
    }
    programs_ = std::move(programs);
    crown_program_ = std::move(crown_program);
    pick_programs_.reset();
    return {};
}

void ForestPass::show(ForestModel model, const MaterialTextures& textures) {
    const Clock::time_point start = Clock::now();
    lists_ = nullptr;
    lod_.reset();
    model_ = std::move(model);
    forget_near_trees();
    lod_ = std::make_unique<ForestLod>(model_);
    ImpostorPlan plan = plan_impostors(*lod_);
    has_clusters_ = plan.has_clusters;
    has_old_clusters_ = false;
    buffers_.upload(model_, plan, textures);
    buffers_.set_colours(model_, colours_);
    impostors_.begin(model_, std::move(plan), buffers_);
    buffers_.upload_trees(*lod_);
    show_on_device();
    const Region& region = model_.terrain->region();
    const float whole = static_cast<float>(std::hypot(region.width, region.depth)) + kGroundBeyond;
    const StreamedTrees* const streamed = model_.streamed.get();
    terrain_.show(*model_.terrain, model_.ground,
                  streamed == nullptr ? whole : std::min(whole, streamed->view_distance),
                  streamed == nullptr ? GroundCover() : streamed->cover, textures);
    upload_seconds_ = seconds_since(start);
    bake_seconds_ = 0.0;
}

void ForestPass::set_colours(BranchColours by) {
    if (by == std::exchange(colours_, by) || lod_ == nullptr) {
        return;
    }
    buffers_.set_colours(model_, by);
    impostors_.begin(model_, plan_impostors(*lod_), buffers_);
}

void ForestPass::update_trees() {
    lists_ = nullptr;
    forget_near_trees();
    lod_ = std::make_unique<ForestLod>(model_);
    ImpostorPlan plan = plan_impostors(*lod_);
    has_clusters_ = plan.has_clusters;
    has_old_clusters_ = true;
    buffers_.upload_forms(model_, plan);
    impostors_.begin(model_, std::move(plan), buffers_);
    buffers_.upload_trees(*lod_);
    show_on_device();
}

Result<void> ForestPass::cull_on_device(bool on_device, const ShaderSource& shaders) {
    if (on_device && culling_ == nullptr) {
        auto culling = std::make_unique<ForestCulling>(*device_);
        if (Result<void> done = culling->reload(shaders); !done) {
            return done;
        }
        culling_ = std::move(culling);
    }
    culls_on_device_ = on_device;
    return {};
}

void ForestPass::show_on_device() {
    is_culled_on_device_ =
        culls_on_device_ && model_.streamed == nullptr && culling_->show(*lod_, buffers_);
    buffers_.use_device_draws(is_culled_on_device_ ? &culling_->draws() : nullptr);
}

bool ForestPass::bake_impostors(double seconds, MaterialTextures& textures) {
    const Clock::time_point start = Clock::now();
    while (!impostors_.is_done()) {
        impostors_.step(model_, buffers_, textures);
        if (seconds_since(start) >= seconds) {
            break;
        }
    }
    if (impostors_.is_done() && model_.streamed != nullptr) {
        terrain_.set_canopy(impostors_.mean_colour_from_above(model_.streamed->crown_weights));
    }
    bake_seconds_ += seconds_since(start);
    return impostors_.is_done();
}

void ForestPass::change_tree(std::uint32_t index, const Tree& tree, bool alive) {
    forget_near_trees();
    const std::uint32_t number = lod_->change_tree(index, tree, alive);
    if (alive) {
        buffers_.upload_tree(*lod_, number);
    }
    if (is_culled_on_device_) {
        culling_->change_tree(number);
    }
}

Bounds ForestPass::change_squares(const SquareChanges& changes) {
    for (const SquareId& id : changes.removed) {
        lod_->remove_square(id);
    }
    for (const std::shared_ptr<const ForestSquare>& square : changes.added) {
        lod_->add_square(square);
    }
    if (!changes.empty()) {
        forget_near_trees();
        lists_ = nullptr;
    }
    return lod_->take_changed_box();
}

Frame ForestPass::localised(const Frame& frame, bool& moved) {
    const glm::dvec3 origin =
        model_.streamed == nullptr ? glm::dvec3(0.0) : nearest_origin(eye_of(frame.camera));
    moved = origin != lod_->origin();
    if (moved) {
        forget_near_trees();
        lod_->set_origin(origin);
        terrain_.set_origin(origin);
    }
    Frame local = frame;
    local.camera = relative_to(frame.camera, origin);
    return local;
}

std::array<float, 2> ForestPass::altitudes_near(const glm::vec2& middle, float half) const {
    constexpr int kSteps = 8; // number of samples along each side
    const glm::dvec3& origin = lod_->origin();
    std::array<float, 2> range = {std::numeric_limits<float>::max(),
                                  std::numeric_limits<float>::lowest()};
    for (int z = -kSteps; z <= kSteps; ++z) {
        for (int x = -kSteps; x <= kSteps; ++x) {
            const double step = 1.25 * static_cast<double>(half) / kSteps;
            const float height = model_.terrain->height(
                static_cast<float>(origin.x + static_cast<double>(middle.x) + step * x),
                static_cast<float>(origin.z + static_cast<double>(middle.y) + step * z));
            range = {std::min(range[0], height), std::max(range[1], height)};
        }
    }
    // The ground between the samples may be lower or higher than the samples.
    const float margin = 0.25F * (range[1] - range[0]);
    return {range[0] - margin, range[1] + margin + model_.streamed->tallest};
}

Bounds ForestPass::shadow_bounds(const Frame& frame) {
    const Camera& camera = frame.camera;
    const glm::dvec3 eye = eye_of(camera);
    const float ground =
        model_.terrain->height(static_cast<float>(eye.x), static_cast<float>(eye.z));
    const float above = std::max(camera.eye.y - ground, 0.0F);
    // With QUALITY 1 and 2, other maps have the shadows near the eye.
    float half = device_->quality() > 0 ? kMinFarShadowRange : kMinShadowRange;
    while (half < kMaxShadowRange && half < 1.2F * above) {
        half *= 1.5F;
    }
    // Centre of the shadow map: ahead of the eye, but at most as far away as the ground in the
    // middle of the view.
    const glm::vec3 along = forward_of(camera);
    const glm::vec2 flat(along.x, along.z);
    const float length = glm::length(flat);
    const float ground_distance = along.y < -0.05F ? above / -along.y * length : 2.0F * half;
    const float reach =
        std::min((above > 0.5F * half ? 1.5F : 0.75F) * half, std::max(ground_distance, 0.0F));
    const glm::vec2 wanted = glm::vec2(camera.eye.x, camera.eye.z) +
                             (length > 1e-4F ? flat / length * reach : glm::vec2(0.0F));
    const float step = 0.25F * half;
    const glm::vec2 middle = glm::round(wanted / step) * step;
    Bounds lit;
    if (model_.streamed != nullptr) {
        caster_altitudes_ = altitudes_near(middle, half);
        lit.add({middle.x - half, caster_altitudes_[0], middle.y - half});
        lit.add({middle.x + half, caster_altitudes_[1], middle.y + half});
        return lit;
    }
    const Bounds& all = bounds();
    caster_altitudes_ = {all.low.y, all.high.y};
    lit.add({middle.x - half, all.low.y, middle.y - half});
    lit.add({middle.x + half, all.high.y, middle.y + half});
    // Clips the box to the forest.
    lit.low = glm::max(lit.low, all.low - glm::vec3(half * 0.25F, 0.0F, half * 0.25F));
    lit.high = glm::min(lit.high, all.high + glm::vec3(half * 0.25F, 0.0F, half * 0.25F));
    if (lit.low.x >= lit.high.x || lit.low.z >= lit.high.z) {
        lit.low = {middle.x - half, all.low.y, middle.y - half};
        lit.high = {middle.x + half, all.high.y, middle.y + half};
    }
    return lit;
}

void ForestPass::prepare(const Frame& frame) {
    frustum_ = make_frustum(frame.camera, frame.width, frame.height);
    LodOptions options;
    options.max_triangles = frame.max_triangles;
    options.max_expansions = frame.max_expansions;
    options.wind = frame.wind;
    options.tree_range = frame.tree_range;
    constexpr float kMinWindSpeed = 1e-4F; // m/s; slower wind counts as none
    is_windy_ = glm::length(frame.wind.velocity) >= kMinWindSpeed;
    wind_ = frame.wind;
    has_one_sample_ = frame.samples == 1;
    has_old_clusters_ = has_old_clusters_ && !impostors_.is_done();
    options.cluster_pixels = has_clusters_ && !has_old_clusters_ ? options.cluster_pixels : 0.0F;
    terrain_.prepare(frustum_, frame.tree_range);
    const Clock::time_point start = Clock::now();
    const double cpu_start = platform::thread_cpu_seconds();
    // With wireframes, the ground occludes nothing.
    const bool ground_occludes = frame.style != PlantStyle::Wireframe;
    if (is_culled_on_device_) {
        view_ = {frustum_, options, ground_occludes ? terrain_.lod() : nullptr, terrain_.heights()};
        cull_seconds_ = seconds_since(start);
        cull_cpu_seconds_ = platform::thread_cpu_seconds() - cpu_start;
        return;
    }
    horizon_.set_viewpoint(*terrain_.lod(), frustum_.eye);
    lists_ = &lod_->select(frustum_, options, ground_occludes ? &horizon_ : nullptr);
    cull_seconds_ = seconds_since(start);
    cull_cpu_seconds_ = platform::thread_cpu_seconds() - cpu_start;
    if (model_.streamed != nullptr) {
        buffers_.upload_changed_trees(*lod_, lod_->take_changed_trees());
    }
    buffers_.upload_branches(lod_->pool());
    buffers_.upload_commands(*lists_);
}

void ForestPass::select_on_device() {
    const Clock::time_point start = Clock::now();
    const double cpu_start = platform::thread_cpu_seconds();
    culling_->select(*lod_, buffers_, view_);
    cull_seconds_ += seconds_since(start);
    cull_cpu_seconds_ += platform::thread_cpu_seconds() - cpu_start;
}

const ProgramObject& ForestPass::impostor_depth(bool blends) const {
    if (has_one_sample_) {
        return blends ? programs().one_sample_blending_impostor_depth
                      : programs().one_sample_impostor_depth;
    }
    return blends ? programs().blending_impostor_depth : programs().impostor_depth;
}

void ForestPass::draw_impostors(std::span<const ImpostorEntry> trees, FrameStats& stats) {
    if (trees.empty()) {
        return;
    }
    quad_trees_.fill(trees);
    // Draws depths first, so that only visible texels are lit: most of a quad is empty, and
    // lighting is expensive. A software renderer continues to shade a pixel after `discard`.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    const auto whole = static_cast<std::size_t>(
        std::partition_point(trees.begin(), trees.end(),
                             [](const ImpostorEntry& tree) { return tree.range.is_whole(); }) -
        trees.begin());
    stats.draws += draw_quads(impostor_depth(false), 0, whole);
    stats.draws += draw_quads(impostor_depth(true), whole, trees.size() - whole);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_EQUAL);
    glDepthMask(GL_FALSE);
    stats.draws += draw_quads(programs().impostor, 0, trees.size());
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GEQUAL);
    stats.triangles += 4 * trees.size();
}

std::uint64_t
ForestPass::draw_quads(const ProgramObject& program, std::size_t first, std::size_t count) {
    if (count == 0) {
        return 0;
    }
    bind_quads(program, quad_trees_.name());
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count),
                                      static_cast<GLuint>(first));
    return 1;
}

void ForestPass::bind_quads(const ProgramObject& program, GLuint entries) {
    glVertexArrayVertexBuffer(quads_.name(), 0, entries, 0, sizeof(ImpostorEntry));
    glUseProgram(program.name());
    glBindTextureUnit(kAlbedos, impostors_.albedos());
    glBindTextureUnit(kNormals, impostors_.normals());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBoxes, impostors_.boxes());
    glBindVertexArray(quads_.name());
}

std::uint64_t ForestPass::draw_device_quads(const ProgramObject& program,
                                            bool clusters,
                                            std::uint32_t first,
                                            std::uint32_t count) {
    constexpr std::size_t kCommand = 4 * sizeof(std::uint32_t);
    bind_quads(program, culling_->entries(clusters));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, culling_->impostor_commands());
    const std::size_t offset = ForestCulling::impostor_command(clusters) + first * kCommand;
    glMultiDrawArraysIndirect(GL_TRIANGLE_STRIP, reinterpret_cast<const void*>(offset),
                              static_cast<GLsizei>(count), kCommand);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    return 1;
}

void ForestPass::draw_device_impostors(bool clusters, FrameStats& stats) {
    // Draws depths first, as in draw_impostors().
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    stats.draws += draw_device_quads(impostor_depth(false), clusters, 0, 1);
    stats.draws += draw_device_quads(impostor_depth(true), clusters, 1, 1);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_EQUAL);
    glDepthMask(GL_FALSE);
    stats.draws += draw_device_quads(programs().impostor, clusters, 0, 2);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GEQUAL);
}

void ForestPass::draw_shadows(const glm::mat4& shadow_from_world, ForestFrameStats& stats) {
    if (is_culled_on_device_) {
        const double cpu_start = platform::thread_cpu_seconds();
        culling_->select_casters(*lod_, buffers_,
                                 casters_of(shadow_from_world, bounds().low.y, bounds().high.y));
        cull_cpu_seconds_ += platform::thread_cpu_seconds() - cpu_start;
        buffers_.bind_storage();
        glDisable(GL_CULL_FACE);
        shadow_timer_.begin();
        stats.shadow.draws += draw_device_quads(programs().impostor_shadow, false, 0, 1);
        shadow_timer_.end();
        return;
    }
    std::vector<std::uint32_t> numbers;
    lod_->find_within(casters_of(shadow_from_world, caster_altitudes_[0], caster_altitudes_[1]),
                      numbers);
    std::vector<ImpostorEntry> trees;
    trees.reserve(numbers.size());
    for (const std::uint32_t number : numbers) {
        trees.push_back({number, {}});
    }
    buffers_.bind_storage();
    glDisable(GL_CULL_FACE);
    if (!trees.empty()) {
        quad_trees_.fill(std::span<const ImpostorEntry>(trees));
        shadow_timer_.begin();
        stats.shadow.draws += draw_quads(programs().impostor_shadow, 0, trees.size());
        shadow_timer_.end();
        stats.shadow.triangles += 2 * trees.size();
    }
}

glm::vec4 ForestPass::draw_crowns(const glm::vec3& eye) {
    constexpr GLsizei kTexels = 1024;
    constexpr GLuint kCrownMap = 9; // in crowns.glsl
    constexpr float kHalf = 120.0F; // m, half side of the map
    constexpr float kStep = 20.0F;  // m, by which the map follows the eye
    if (!crowns_) {
        crowns_ = make_texture(*device_, GL_TEXTURE_2D);
        glTextureStorage2D(crowns_.name(), 1, GL_RG8, kTexels, kTexels);
        glTextureParameteri(crowns_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(crowns_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(crowns_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        crown_target_ = make_framebuffer(*device_);
        glNamedFramebufferTexture(crown_target_.name(), GL_COLOR_ATTACHMENT0, crowns_.name(), 0);
    }
    glBindTextureUnit(kCrownMap, crowns_.name());
    const glm::vec4 area(std::round(eye.x / kStep) * kStep, std::round(eye.z / kStep) * kStep,
                         kHalf, 1.0F);
    if (area == std::exchange(crown_area_, area)) {
        return area;
    }
    Bounds box;
    box.add({area.x - kHalf, 0.0F, area.y - kHalf});
    box.add({area.x + kHalf, 0.0F, area.y + kHalf});
    std::vector<std::uint32_t> numbers;
    lod_->find_within(box, numbers);
    std::vector<ImpostorEntry> trees;
    for (const std::uint32_t number : numbers) {
        trees.push_back({number, {}});
    }
    glBindFramebuffer(GL_FRAMEBUFFER, crown_target_.name());
    glViewport(0, 0, kTexels, kTexels);
    constexpr std::array<GLfloat, 4> kOpen = {1.0F, 1.0F, 1.0F, 1.0F};
    glClearNamedFramebufferfv(crown_target_.name(), GL_COLOR, 0, kOpen.data());
    buffers_.bind_storage();
    quad_trees_.fill(std::span<const ImpostorEntry>(trees));
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glProgramUniform3f(crown_program_.name(), 0, area.x, area.y, area.z);
    draw_quads(crown_program_, 0, trees.size());
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    return area;
}

float ForestPass::exposure_below_crowns(const glm::vec3& eye) const {
    constexpr float kMax = 2.2F; // max of the exposure factor, below closed crowns
    const float cover = lod_->crown_cover(eye);
    return 1.0F + (kMax - 1.0F) * cover * cover;
}

glm::vec4 ForestPass::hills() const {
    constexpr float kBeyond = 800.0F; // m, from the forest to the hills
    if (model_.streamed != nullptr) {
        return glm::vec4(0.0F);
    }
    const Region& region = model_.terrain->region();
    const auto diagonal = static_cast<float>(std::hypot(region.width, region.depth));
    return {0.5F * diagonal + kBeyond, bounds().empty ? 0.0F : bounds().low.y, 0.0F, 0.0F};
}

void ForestPass::list_casters(const glm::mat4& shadow_from_world,
                              std::uint32_t level,
                              NearCasters& casters) {
    std::vector<std::uint32_t> found;
    const Bounds& all = bounds();
    const bool is_streamed = model_.streamed != nullptr;
    lod_->find_within(casters_of(shadow_from_world, is_streamed ? caster_altitudes_[0] : all.low.y,
                                 is_streamed ? caster_altitudes_[1] : all.high.y),
                      found);
    const float per_metre = glm::length(
        glm::vec3(shadow_from_world[0].x, shadow_from_world[1].x, shadow_from_world[2].x));
    const Sway sway = sway_in(wind_);
    std::erase_if(found, [&](std::uint32_t number) {
        const LodTree& tree = lod_->lod_tree(number);
        const Sphere sphere = lod_->bounding_sphere(tree, lod_->tree_of(number).yaw);
        const glm::vec3 at(shadow_from_world * glm::vec4(sphere.centre, 1.0F));
        const float reach =
            1.0F + per_metre * (sphere.radius +
                                sway.displacement(2.0F * sphere.radius, 2.0F * sphere.radius));
        return std::abs(at.x) > reach || std::abs(at.y) > reach || at.z > reach;
    });
    lod_->list_whole_trees(found, level, casters.branches, casters.lists);
    casters.shadow_from_world = shadow_from_world;
    casters.wind = wind_;
}

void ForestPass::forget_near_trees() {
    crown_area_ = {};
    near_casters_ = {};
}

void ForestPass::draw_near_shadows(std::size_t map,
                                   const glm::mat4& shadow_from_world,
                                   std::uint32_t level,
                                   MaterialTextures& textures) {
    NearCasters& casters = near_casters_[map];
    if (casters.shadow_from_world != shadow_from_world || casters.wind != wind_) {
        list_casters(shadow_from_world, level, casters);
    }
    buffers_.use(BufferSet::Shadow);
    buffers_.set_branches(casters.branches);
    buffers_.upload_commands(casters.lists);
    buffers_.bind_storage();
    glUseProgram(programs().caster.name());
    for (const BranchClass kind :
         {BranchClass::OneSided, BranchClass::TwoSided, BranchClass::Plain}) {
        buffers_.draw(kind);
    }
    glBindTextureUnit(kLeafTexture, textures.base_colour_array(MaterialKind::Leaf));
    glUseProgram(programs().cut_out_caster.name());
    buffers_.draw(BranchClass::CutOut);
    buffers_.draw_pictures(programs().caster.name(), programs().cut_out_caster.name(),
                           programs().cut_out_caster.name(), textures, false);
    buffers_.use(BufferSet::Forest);
}

void ForestPass::draw_branches(const BranchPrograms& programs,
                               MaterialTextures& textures,
                               bool blends,
                               FrameStats& stats) {
    glUseProgram(programs.solid.name());
    stats.draws += buffers_.draw(BranchClass::OneSided, blends);
    stats.draws += buffers_.draw(BranchClass::TwoSided, blends);
    glUseProgram(programs.plain.name());
    stats.draws += buffers_.draw(BranchClass::Plain, blends);
    const ProgramObject& cut_out = has_one_sample_ ? programs.one_sample_cut_out : programs.cut_out;
    glUseProgram(cut_out.name());
    stats.draws += buffers_.draw(BranchClass::CutOut, blends);
    stats.draws += buffers_.draw_pictures(
        programs.solid.name(), cut_out.name(),
        (programs.bumpy_cut_out ? programs.bumpy_cut_out : cut_out).name(), textures, blends);
}

void ForestPass::draw(MaterialTextures& textures, ForestFrameStats& stats) {
    if (is_culled_on_device_) {
        select_on_device();
    }
    buffers_.bind_storage();
    branches_timer_.begin();
    for (const bool blends : {false, true}) {
        glBindTextureUnit(kBarkTexture, textures.base_colour_array(MaterialKind::Bark));
        glBindTextureUnit(kLeafTexture, textures.base_colour_array(MaterialKind::Leaf));
        glBindTextureUnit(kNormalMapTexture, textures.bark_normal_array());
        draw_branches(blends ? programs().blending_branches : programs().branches, textures, blends,
                      stats.branches);
    }
    branches_timer_.end();
    device_->end_pass();
    glDisable(GL_CULL_FACE);
    impostors_timer_.begin();
    if (is_culled_on_device_) {
        draw_device_impostors(false, stats.impostors);
        buffers_.bind_clusters();
        draw_device_impostors(true, stats.impostors);
        buffers_.bind_storage();
    } else {
        draw_impostors(lists_->trees, stats.impostors);
        if (!lists_->clusters.empty()) {
            buffers_.bind_clusters();
            draw_impostors(lists_->clusters, stats.impostors);
            buffers_.bind_storage();
        }
        set_stats(*lists_, stats);
    }
    impostors_timer_.end();
    terrain_timer_.begin();
    const FrameStats ground = terrain_.draw();
    terrain_timer_.end();
    stats.terrain.draws += ground.draws;
    stats.terrain.triangles += ground.triangles;
    stats.is_culled_on_device = is_culled_on_device_;
    stats.cull_milliseconds = 1e3 * cull_seconds_;
    stats.cull_cpu_milliseconds = 1e3 * cull_cpu_seconds_;
}

void ForestPass::set_stats(const DrawLists& lists, ForestFrameStats& stats) const {
    stats.branches.triangles += lists.triangles;
    stats.trees_of_level = lists.trees_of_level;
    stats.far_trees = lists.far_trees;
    stats.blended_trees = lists.blended;
    stats.occluded_trees = lists.occluded;
    stats.clustered_trees = lists.clustered_trees;
    stats.clusters = lists.clusters.size();
    stats.drawn_branches = lists.branches.size();
    stats.expanded_trees = lists.expanded;
    stats.waiting_trees = lists.waiting;
    stats.detail = lists.detail;
}

void ForestPass::collect_device_stats(ForestFrameStats& stats) {
    stats.branches.gpu_milliseconds = branches_timer_.milliseconds();
    stats.impostors.gpu_milliseconds = impostors_timer_.milliseconds();
    stats.terrain.gpu_milliseconds = terrain_timer_.milliseconds();
    stats.shadow.gpu_milliseconds = shadow_timer_.milliseconds();
    if (!is_culled_on_device_) {
        return;
    }
    stats.cull_gpu_milliseconds = culling_->gpu_milliseconds();
    const CullingState* const state = culling_->finished_state();
    if (state == nullptr) {
        return;
    }
    stats.trees_of_level = state->level_counts;
    stats.far_trees = state->impostor_count(false) - state->branch_blended;
    stats.blended_trees =
        std::uint64_t{state->cluster_blended} + state->branch_blended + state->level_blended;
    stats.occluded_trees = state->occluded;
    stats.clustered_trees = state->clustered;
    stats.clusters = state->impostor_count(true);
    stats.drawn_branches = state->drawn_branches;
    stats.expanded_trees = state->near_totals[1] - state->waiting;
    stats.detail = state->detail;
    stats.branches.triangles = state->triangle_count();
    stats.impostors.triangles = 4 * (state->impostor_count(false) + state->impostor_count(true));
    stats.device_triangles = stats.branches.triangles + stats.impostors.triangles;
}

Result<void> ForestPass::compile_pick_programs(const ShaderSource& shaders) {
    if (pick_programs_) {
        return {};
    }
    PickPrograms programs;
    for (const bool windy : {false, true}) {
        Result<ForestPickPrograms> made = make_pick_programs(*device_, shaders, windy);
        if (!made) {
            return made.error();
        }
        programs.forest[windy ? 1 : 0] = std::move(made.value());
    }
    Result<ProgramObject> ground =
        make_program(*device_, shaders, "terrain.vert.glsl", "pick.frag.glsl", "#define GROUND\n");
    if (!ground) {
        return ground.error();
    }
    programs.ground = std::move(ground.value());
    pick_programs_ = std::move(programs);
    return {};
}

void ForestPass::draw_picked(MaterialTextures& textures) {
    const ForestPickPrograms& picks = pick_programs_->forest[is_windy_ ? 1 : 0];
    const auto use = [](const ProgramObject& program, PickedKind kind) {
        glUseProgram(program.name());
        glUniform1ui(kPickedContent, static_cast<GLuint>(kind));
    };
    if (is_culled_on_device_) {
        select_on_device();
    }
    buffers_.bind_storage();
    for (const bool blends : {false, true}) {
        glBindTextureUnit(kLeafTexture, textures.base_colour_array(MaterialKind::Leaf));
        use(blends ? picks.blending_branch : picks.branch, PickedKind::Branch);
        for (const BranchClass kind :
             {BranchClass::OneSided, BranchClass::TwoSided, BranchClass::Plain}) {
            buffers_.draw(kind, blends);
        }
        use(blends ? picks.blending_cut_out : picks.cut_out, PickedKind::Branch);
        buffers_.draw(BranchClass::CutOut, blends);
        const GLuint cut_out = (blends ? picks.blending_cut_out : picks.cut_out).name();
        buffers_.draw_pictures((blends ? picks.blending_branch : picks.branch).name(), cut_out,
                               cut_out, textures, blends);
    }
    glDisable(GL_CULL_FACE);
    const auto draw_impostors = [&](std::span<const ImpostorEntry> entries, PickedKind kind) {
        if (entries.empty()) {
            return;
        }
        quad_trees_.fill(entries);
        const auto whole =
            static_cast<std::size_t>(std::partition_point(entries.begin(), entries.end(),
                                                          [](const ImpostorEntry& entry) {
                                                              return entry.range.is_whole();
                                                          }) -
                                     entries.begin());
        use(picks.impostor, kind);
        draw_quads(picks.impostor, 0, whole);
        use(picks.blending_impostor, kind);
        draw_quads(picks.blending_impostor, whole, entries.size() - whole);
    };
    if (is_culled_on_device_) {
        draw_picked_impostors(picks, false);
        buffers_.bind_clusters();
        draw_picked_impostors(picks, true);
        buffers_.bind_storage();
    } else {
        draw_impostors(lists_->trees, PickedKind::Impostor);
        if (!lists_->clusters.empty()) {
            buffers_.bind_clusters();
            draw_impostors(lists_->clusters, PickedKind::Cluster);
            buffers_.bind_storage();
        }
    }
    use(pick_programs_->ground, PickedKind::Ground);
    terrain_.draw_with(pick_programs_->ground);
}

void ForestPass::draw_picked_impostors(const ForestPickPrograms& picks, bool clusters) {
    const PickedKind kind = clusters ? PickedKind::Cluster : PickedKind::Impostor;
    std::uint32_t command = 0; // 0: whole impostors; 1: blended impostors
    for (const ProgramObject* program : {&picks.impostor, &picks.blending_impostor}) {
        glProgramUniform1ui(program->name(), kPickedContent, static_cast<GLuint>(kind));
        draw_device_quads(*program, clusters, command++, 1);
    }
}

Picked ForestPass::picked(PickedKind kind, std::uint32_t index) const {
    Picked picked;
    picked.kind = kind;
    if (kind == PickedKind::Cluster) {
        picked.trees = lod_->cells()[index].count;
        return picked;
    }
    std::uint32_t tree = index;
    if (kind == PickedKind::Branch) {
        const PoolBranch branch =
            is_culled_on_device_ ? culling_->branch(index) : lod_->pool().branches()[index];
        picked.instance = branch.mesh;
        tree = branch.tree;
    }
    if (kind == PickedKind::Branch || kind == PickedKind::Impostor) {
        picked.form = lod_->lod_tree(tree).form;
        picked.tree = lod_->tree_of(tree);
        picked.tree.position = glm::vec3(glm::dvec3(picked.tree.position) + origin());
    }
    return picked;
}

std::vector<std::uint32_t> ForestPass::trees_of(std::uint32_t form) const {
    std::vector<std::uint32_t> numbers;
    lod_->for_each_alive([&](const LodTree& tree, const Tree& full) {
        if (tree.form == form) {
            numbers.push_back(full.number);
        }
    });
    return numbers;
}

ForestSizes ForestPass::sizes() const {
    ForestSizes sizes;
    sizes.trees = lod_->alive_count();
    sizes.tree_bytes =
        lod_->byte_count() + buffers_.tree_bytes() + model_.forest->trees.size() * sizeof(Tree);
    sizes.branch_bytes = buffers_.branch_bytes();
    sizes.culling_bytes = is_culled_on_device_ ? culling_->byte_count() : 0;
    sizes.mesh_bytes = buffers_.mesh_bytes();
    sizes.texture_bytes =
        impostors_.texture_bytes() + terrain_.texture_bytes() + buffers_.texture_bytes();
    sizes.upload_milliseconds = 1e3 * upload_seconds_;
    sizes.impostor_milliseconds = 1e3 * bake_seconds_;
    return sizes;
}

} // namespace lsys::view
