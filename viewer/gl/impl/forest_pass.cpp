#include "viewer/gl/impl/forest_pass.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

constexpr GLuint kBarkTexture = 1;
constexpr GLuint kLeafTexture = 2;
constexpr GLuint kAlbedos = 3;
constexpr GLuint kNormals = 4;
constexpr GLuint kBoxes = 4; // binding of impostor.vert.glsl
// The sun's map: half its side where the eye is near the ground, and at most (m).
constexpr float kNearestLit = 45.0F;
constexpr float kFarthestLit = 400.0F;
constexpr float kGroundBeyond = 3000.0F; // m, of ground that is drawn around the forest

/// What stands in the sun's map, seen from above: of all that lies between two heights.
/// `shadow_from_world`: as shadow_matrix() has it.
Bounds casters_of(const glm::mat4& shadow_from_world, float low, float high) {
    constexpr float kFarthest = -3.0F; // in depths of the map, where the sun is low
    const glm::mat4 world_from_shadow = glm::inverse(shadow_from_world);
    Bounds casters;
    for (const float x : {-1.0F, 1.0F}) {
        for (const float y : {-1.0F, 1.0F}) {
            const glm::vec3 first(world_from_shadow * glm::vec4(x, y, 0.0F, 1.0F));
            const glm::vec3 last(world_from_shadow * glm::vec4(x, y, 1.0F, 1.0F));
            const glm::vec3 along = last - first; // downwards
            const auto depth_at = [&](float height) {
                const float depth = along.y < 0.0F ? (height - first.y) / along.y : kFarthest;
                return glm::clamp(depth, kFarthest, 1.0F);
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
    : device_(&device), buffers_(device), portraits_(device), terrain_(device),
      quads_(make_vertex_array(device)), quad_trees_(device) {
    glVertexArrayAttribIFormat(quads_.name(), 0, 1, GL_UNSIGNED_INT, offsetof(Listed, number));
    glVertexArrayAttribFormat(quads_.name(), 1, 1, GL_FLOAT, GL_FALSE, offsetof(Listed, part));
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
    if (Result<void> done = portraits_.reload(shaders); !done) {
        return done;
    }
    if (Result<void> done = terrain_.reload(shaders); !done) {
        return done;
    }
    programs_ = std::move(programs);
    return {};
}

void ForestPass::show(ForestModel model) {
    const Clock::time_point start = Clock::now();
    lists_ = nullptr;
    view_.reset();
    model_ = std::move(model);
    view_ = std::make_unique<ForestView>(model_);
    PortraitPlan plan = plan_portraits(*view_);
    has_cells_ = plan.has_cells;
    buffers_.upload(model_, plan);
    portraits_.begin(model_, std::move(plan), buffers_);
    buffers_.upload_trees(*view_);
    const Region& region = model_.terrain->region();
    terrain_.show(*model_.terrain,
                  static_cast<float>(std::hypot(region.width, region.depth)) + kGroundBeyond);
    upload_seconds_ = seconds_since(start);
    bake_seconds_ = 0.0;
}

bool ForestPass::make_portraits(double seconds, MaterialTextures& textures) {
    const Clock::time_point start = Clock::now();
    while (!portraits_.is_done()) {
        portraits_.step(model_, buffers_, textures);
        if (seconds_since(start) >= seconds) {
            break;
        }
    }
    bake_seconds_ += seconds_since(start);
    return portraits_.is_done();
}

void ForestPass::change_tree(std::uint32_t index, const Tree& tree, bool alive) {
    const std::uint32_t number = view_->change_tree(index, tree, alive);
    if (alive && number >= view_->trees().size()) {
        buffers_.upload_tree(*view_, number);
    }
}

Bounds ForestPass::lit_bounds(const Frame& frame) const {
    const Camera& camera = frame.camera;
    const float ground = model_.terrain->height(camera.eye.x, camera.eye.z);
    const float above = std::max(camera.eye.y - ground, 0.0F);
    float half = kNearestLit;
    while (half < kFarthestLit && half < 1.2F * above) {
        half *= 1.5F;
    }
    // In front of the eye, or where it looks at from above.
    const glm::vec3 along = forward_of(camera);
    const glm::vec2 flat(along.x, along.z);
    const float length = glm::length(flat);
    const float down = along.y < -0.05F ? above / -along.y * length : 2.0F * half;
    const float reach = std::min((above > 0.5F * half ? 1.5F : 0.75F) * half, std::max(down, 0.0F));
    const glm::vec2 wanted = glm::vec2(camera.eye.x, camera.eye.z) +
                             (length > 1e-4F ? flat / length * reach : glm::vec2(0.0F));
    const float step = 0.25F * half;
    const glm::vec2 middle = glm::round(wanted / step) * step;
    const Bounds& all = bounds();
    Bounds lit;
    lit.add({middle.x - half, all.low.y, middle.y - half});
    lit.add({middle.x + half, all.high.y, middle.y + half});
    // No larger than the forest.
    lit.low = glm::max(lit.low, all.low - glm::vec3(half * 0.25F, 0.0F, half * 0.25F));
    lit.high = glm::min(lit.high, all.high + glm::vec3(half * 0.25F, 0.0F, half * 0.25F));
    if (lit.low.x >= lit.high.x || lit.low.z >= lit.high.z) {
        lit.low = {middle.x - half, all.low.y, middle.y - half};
        lit.high = {middle.x + half, all.high.y, middle.y + half};
    }
    return lit;
}

void ForestPass::prepare(const Frame& frame) {
    const Clock::time_point start = Clock::now();
    volume_ = view_volume(frame.camera, frame.width, frame.height);
    RingOptions rings;
    rings.most_triangles = frame.most_triangles;
    rings.most_expansions = frame.most_expansions;
    rings.wind = frame.wind;
    constexpr float kStill = 1e-4F; // m/s
    is_windy_ = glm::length(frame.wind.velocity) >= kStill;
    rings.horizon_pixels = has_cells_ ? rings.horizon_pixels : 0.0F;
    terrain_.prepare(volume_);
    // Edges of triangles hide nothing.
    const bool hides = frame.style != PlantStyle::Wireframe;
    horizon_.look(*terrain_.view(), volume_.eye);
    lists_ = &view_->select(volume_, rings, hides ? &horizon_ : nullptr);
    cull_seconds_ = seconds_since(start);
    buffers_.upload_branches(view_->pool());
    buffers_.command(*lists_);
}

void ForestPass::draw_impostors(std::span<const Listed> trees, FrameStats& stats) {
    if (trees.empty()) {
        return;
    }
    quad_trees_.fill(trees);
    // Most of a quad is empty, and light is the dear part: it is looked for only where a tree is
    // seen. A software renderer does not skip what comes after a texel was discarded.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    const auto whole = static_cast<std::size_t>(
        std::partition_point(trees.begin(), trees.end(),
                             [](const Listed& tree) { return tree.part == kWhole; }) -
        trees.begin());
    stats.draws += draw_quads(programs().impostor_depth, 0, whole);
    stats.draws += draw_quads(programs().blending_impostor_depth, whole, trees.size() - whole);
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
    glVertexArrayVertexBuffer(quads_.name(), 0, quad_trees_.name(), 0, sizeof(Listed));
    glUseProgram(program.name());
    glBindTextureUnit(kAlbedos, portraits_.albedos());
    glBindTextureUnit(kNormals, portraits_.normals());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBoxes, portraits_.boxes());
    glBindVertexArray(quads_.name());
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count),
                                      static_cast<GLuint>(first));
    return 1;
}

void ForestPass::draw_shadows(const glm::mat4& shadow_from_world, ForestFrameStats& stats) {
    std::vector<std::uint32_t> numbers;
    view_->find_within(casters_of(shadow_from_world, bounds().low.y, bounds().high.y), numbers);
    std::vector<Listed> trees;
    trees.reserve(numbers.size());
    for (const std::uint32_t number : numbers) {
        trees.push_back({number, kWhole});
    }
    buffers_.bind_storage();
    glDisable(GL_CULL_FACE);
    if (!trees.empty()) {
        quad_trees_.fill(std::span<const Listed>(trees));
        stats.shadow.draws += draw_quads(programs().impostor_shadow, 0, trees.size());
        stats.shadow.triangles += 2 * trees.size();
    }
}

void ForestPass::draw_branches(const BranchPrograms& programs, bool blends, FrameStats& stats) {
    glUseProgram(programs.solid.name());
    stats.draws += buffers_.draw(BranchClass::OneSided, blends);
    stats.draws += buffers_.draw(BranchClass::TwoSided, blends);
    glUseProgram(programs.plain.name());
    stats.draws += buffers_.draw(BranchClass::Plain, blends);
    glUseProgram(programs.cut_out.name());
    stats.draws += buffers_.draw(BranchClass::CutOut, blends);
}

void ForestPass::draw(MaterialTextures& textures, ForestFrameStats& stats) {
    buffers_.bind_storage();
    glBindTextureUnit(kBarkTexture, textures.base(MaterialKind::Bark));
    glBindTextureUnit(kLeafTexture, textures.base(MaterialKind::Leaf));
    draw_branches(programs().branches, false, stats.branches);
    draw_branches(programs().blending_branches, true, stats.branches);
    device_->end_pass();
    stats.branches.triangles += lists_->triangles;
    glDisable(GL_CULL_FACE);
    draw_impostors(lists_->trees, stats.impostors);
    if (!lists_->clumps.empty()) {
        buffers_.bind_cells();
        draw_impostors(lists_->clumps, stats.impostors);
        buffers_.bind_storage();
    }
    const FrameStats ground = terrain_.draw();
    stats.terrain.draws += ground.draws;
    stats.terrain.triangles += ground.triangles;
    stats.trees_of_level = lists_->trees_of_level;
    stats.far_trees = lists_->far_trees;
    stats.blended_trees = lists_->blended;
    stats.hidden_trees = lists_->hidden;
    stats.horizon_trees = lists_->clumped_trees;
    stats.horizon_cells = lists_->clumps.size();
    stats.drawn_branches = lists_->branches.size();
    stats.expanded_trees = lists_->expanded;
    stats.waiting_trees = lists_->waiting;
    stats.detail = lists_->detail;
    stats.cull_milliseconds = 1e3 * cull_seconds_;
}

ForestSizes ForestPass::sizes() const {
    ForestSizes sizes;
    sizes.trees = view_->alive_count();
    sizes.tree_bytes =
        view_->byte_count() + buffers_.tree_bytes() + model_.forest->trees.size() * sizeof(Tree);
    sizes.branch_bytes = buffers_.branch_bytes();
    sizes.mesh_bytes = buffers_.mesh_bytes();
    sizes.texture_bytes = portraits_.texture_bytes() + terrain_.texture_bytes();
    sizes.upload_milliseconds = 1e3 * upload_seconds_;
    sizes.portrait_milliseconds = 1e3 * bake_seconds_;
    return sizes;
}

} // namespace lsys::view
