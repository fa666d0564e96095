// SPDX-License-Identifier: MIT
#include "viewer/gl/renderer.h"

#include "runtime/platform/cpu_time.h"
#include "viewer/gl/impl/figure_mesh.h"
#include "viewer/gl/impl/forest_culling.h"
#include "viewer/gl/impl/forest_pass.h"
#include "viewer/gl/impl/frame_block.h"
#include "viewer/gl/impl/gpu_timer.h"
#include "viewer/gl/impl/line_set.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/pick_target.h"
#include "viewer/gl/impl/plant_mesh.h"
#include "viewer/gl/impl/program.h"
#include "viewer/gl/impl/render_target.h"
#include "viewer/gl/impl/sense_pass.h"
#include "viewer/gl/impl/shadow_map.h"
#include "viewer/gl/impl/temporal_antialiasing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint32_t kShadowTexels = 2048;
constexpr GLuint kFrameBinding = 0;
constexpr GLuint kShadowTexture = 0;
constexpr GLuint kNearShadowTextures = 7; // first unit of kNearMaps; in light.glsl
/// A shadow map around the eye in a forest.
struct NearMap {
    float radius;        // m
    std::uint32_t level; // level of the branches that cast shadows
    // With soft shadows: depth of the map divided by its width. The map must reach casters far
    // above the eye, because they widen the edge of the shadow. Also kMapDepths of light.glsl.
    float depth;
};
constexpr std::array<NearMap, kNearMaps> kNearMapSpecs = {{{8.0F, 0, 4.0F}, {30.0F, 2, 1.0F}}};
// Texture units of the depths of shadow maps, for soft shadows; in light.glsl.
constexpr GLuint kNearDepthTextures = 10; // of kNearMaps
constexpr GLuint kShadowDepthTexture = 12;
// Uniform locations of ground.*.glsl.
constexpr GLint kDisc = 0;
constexpr GLint kGridStep = 1;
constexpr GLint kPickedContent = 20; // in pick.frag.glsl
// Light of sky and air is divided by (raised exposure / usual exposure) ^ kSkyAdaptation.
constexpr float kSkyAdaptation = 0.8F;
constexpr float kDiscInRadii = 14.0F; // radius of the ground disc, in radii of the plant

struct Programs {
    ProgramObject sky;
    ProgramObject mesh;
    ProgramObject shadow;
    ProgramObject ground;
    ProgramObject line;
    ProgramObject sense;
};

Result<Programs> make_programs(Device& device, const ShaderSource& shaders) {
    Programs programs;
    struct ProgramSpec {
        ProgramObject Programs::*program;
        const char* vertex;
        const char* fragment;
    };
    const std::array<ProgramSpec, 6> wanted = {
        {{&Programs::sky, "sky.vert.glsl", "sky.frag.glsl"},
         {&Programs::mesh, "mesh.vert.glsl", "mesh.frag.glsl"},
         {&Programs::shadow, "shadow.vert.glsl", "shadow.frag.glsl"},
         {&Programs::ground, "ground.vert.glsl", "ground.frag.glsl"},
         {&Programs::line, "line.vert.glsl", "line.frag.glsl"},
         {&Programs::sense, "sense.vert.glsl", "sense.frag.glsl"}}};
    for (const ProgramSpec& one : wanted) {
        Result<ProgramObject> made = make_program(device, shaders, one.vertex, one.fragment);
        if (!made) {
            return made.error();
        }
        programs.*one.program = std::move(made.value());
    }
    return programs;
}

/// Box around a plant and the part of the ground on which the shadow of the plant may fall.
Bounds shadow_bounds(const Bounds& plant) {
    Bounds bounds = plant;
    const float height = plant.high.y - plant.low.y;
    const float wide = std::max(plant.high.x - plant.low.x, plant.high.z - plant.low.z);
    const float reach = 0.5F * height + 0.05F * wide;
    bounds.low -= glm::vec3(reach, 0.0F, reach);
    bounds.high += glm::vec3(reach, 0.0F, reach);
    return bounds;
}

/// Box of the objects whose shadows may fall into `lit`.
Bounds shadow_casters(const Bounds& lit) {
    Bounds casters = lit;
    const glm::vec3 reach = 6.0F * (lit.high - lit.low);
    casters.low -= reach;
    casters.high += reach;
    return casters;
}

bool overlaps(const Bounds& a, const Bounds& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// Matrix of a shadow map with a range of depths `factor` times as long, extended towards the sun.
glm::mat4 deepened(const glm::mat4& matrix, float factor) {
    glm::mat4 deep = matrix;
    for (int column = 0; column < 4; ++column) {
        deep[column].z = (matrix[column].z + (factor - 1.0F) * matrix[column].w) / factor;
    }
    return deep;
}

/// Term number `index` of the Halton sequence (1964) with a base, 0 to 1.
float halton(std::uint32_t index, std::uint32_t base) {
    float sum = 0.0F;
    for (float part = 1.0F; index != 0; index /= base) {
        part /= static_cast<float>(base);
        sum += part * static_cast<float>(index % base);
    }
    return sum;
}

/// Shifts a picture by a part of a pixel, and its dither pattern by whole pixels. `index`: number
/// of the refinement; 0: no shift.
void shift(FrameBlock& block, std::uint32_t index, const PixelArea& area) {
    if (index == 0) {
        return;
    }
    block.time_before.y = static_cast<float>(index);
    const glm::vec2 by = (2.0F * glm::vec2(halton(index, 2), halton(index, 3)) - 1.0F) /
                         glm::vec2(area.width, area.height);
    for (int column = 0; column < 4; ++column) {
        glm::vec4& of = block.view_projection[column];
        of.x += by.x * of.w;
        of.y += by.y * of.w;
    }
    block.clip_to_world = glm::inverse(block.view_projection);
    block.viewport.x += 7.0F * static_cast<float>(index);
    block.viewport.y += 3.0F * static_cast<float>(index);
}

class GlRenderer final : public Renderer {
public:
    GlRenderer()
        : timer_(device_), target_(device_), shadow_(device_, kShadowTexels), textures_(device_),
          temporal_(device_), plant_(device_), lines_(device_), senses_(device_), forest_(device_),
          frame_(device_), near_frame_(device_), empty_(make_vertex_array(device_)) {
        device_.set_quality(tier_of(Quality::Auto));
    }

    void show_plant(const Mesh& mesh) override {
        plant_.upload(mesh, textures_);
        invalidate_shadows();
        temporal_.forget();
        is_forest_ = false;
    }
    Result<void> show_forest(ForestModel model) override {
        if (!has_forest_shaders_) {
            if (Result<void> done = forest_.reload(shaders_); !done) {
                return done;
            }
            has_forest_shaders_ = true;
        }
        if (Result<void> done = choose_culling(); !done) {
            return done;
        }
        forest_.show(std::move(model), textures_);
        invalidate_shadows();
        temporal_.forget();
        is_forest_ = true;
        return {};
    }
    Result<void> set_quality(Quality quality) override {
        const Quality before = std::exchange(quality_, quality);
        const std::uint32_t tier = tier_of(quality);
        if (tier == device_.quality()) {
            return {};
        }
        const std::uint32_t tier_before = device_.quality();
        device_.set_quality(tier);
        Result<void> done = reload(shaders_);
        if (!done) {
            quality_ = before;
            device_.set_quality(tier_before);
        }
        return done;
    }
    Quality quality() const override {
        return static_cast<Quality>(device_.quality() + static_cast<std::uint32_t>(Quality::Low));
    }
    void set_culling(Culling culling) override { culling_ = culling; }
    bool prefers_temporal() const override {
        return device_.quality() > 1 && !device_.is_software();
    }
    void update_trees() override {
        if (is_forest_) {
            forest_.update_trees();
            invalidate_shadows();
            temporal_.forget();
        }
    }
    bool has_stand_ins() const override { return forest_.has_stand_ins(); }
    bool bake_impostors(double seconds) override {
        if (!is_forest_) {
            return true;
        }
        const bool all_baked = forest_.bake_impostors(seconds, textures_);
        invalidate_shadows();
        return all_baked;
    }
    void change_tree(std::uint32_t index, const Tree& tree, bool alive) override {
        forest_.change_tree(index, tree, alive);
        invalidate_shadows();
    }
    void change_squares(const SquareChanges& changes) override {
        const Bounds changed = forest_.change_squares(changes);
        if (!changed.empty && overlaps(changed, casters_)) {
            invalidate_shadows();
        }
    }
    const Bounds& bounds() const override {
        return is_forest_              ? forest_.bounds()
               : plant_.bounds().empty ? lines_.bounds()
                                       : plant_.bounds();
    }
    void colour_branches(BranchColours by) override {
        forest_.set_colours(by);
        invalidate_shadows();
    }
    void show_lines(std::span<const LineVertex> lines) override { lines_.upload(lines); }
    void show_senses(const SenseDrawing& drawing) override { senses_.upload(drawing); }

    Result<void> reload(const ShaderSource& shaders) override {
        Result<Programs> made = make_programs(device_, shaders);
        if (!made) {
            return made.error();
        }
        if (has_forest_shaders_) {
            if (Result<void> done = forest_.reload(shaders); !done) {
                return done;
            }
        }
        if (device_.quality() > 1) {
            if (Result<void> done = temporal_.reload(shaders); !done) {
                return done;
            }
        }
        temporal_.forget();
        shaders_ = shaders;
        programs_ = std::move(made.value());
        pick_plant_ = {};
        copy_ = {};
        return {};
    }

    FrameStats draw(const Frame& frame, const PixelArea& area) override {
        shown_frame_ = frame;
        shown_area_ = area;
        refinements_ = 0;
        return draw_sample(frame.temporal && device_.quality() > 1 && !frame.transparent &&
                           area == PixelArea{0, 0, frame.width, frame.height});
    }
    bool refine() override {
        constexpr std::uint32_t kMax = 16; // max number of refinements of a picture
        if (!shown_frame_ || refinements_ >= kMax) {
            return false;
        }
        if (!copy_) {
            Result<ProgramObject> made =
                make_program(device_, shaders_, "copy.vert.glsl", "copy.frag.glsl");
            if (!made) {
                return false; // the picture stays without refinement
            }
            copy_ = std::move(made.value());
        }
        const auto add = [&] {
            glBindVertexArray(empty_.name());
            target_.accumulate(copy_, 1.0F / static_cast<float>(refinements_ + 1));
        };
        if (refinements_ == 0) {
            add();
        }
        ++refinements_;
        static_cast<void>(draw_sample(false));
        add();
        return true;
    }
    Result<Picked> pick(const Frame& world_frame, std::uint32_t x, std::uint32_t y) override {
        if (Result<void> made = compile_pick_programs(); !made) {
            return made.error();
        }
        const Frame frame = localised(world_frame);
        const FrameBlock block =
            make_frame_block(frame, {x, y, 1, 1}, glm::mat4(1.0F), kShadowTexels);
        frame_.fill(std::span<const FrameBlock>(&block, 1));
        glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_.name());
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glFrontFace(GL_CCW);
        if (is_forest_) {
            forest_.prepare(frame);
        }
        PickTarget target(device_);
        target.begin();
        glDepthFunc(GL_GEQUAL); // reversed depth
        if (is_forest_) {
            forest_.draw_picked(textures_);
        } else if (frame.style != PlantStyle::None) {
            glUseProgram(pick_plant_.name());
            glUniform1ui(kPickedContent, static_cast<GLuint>(PickedKind::Plant));
            plant_.draw(textures_, PlantMesh::Pass::Pick);
        }
        glDisable(GL_CULL_FACE);
        const PickTarget::Content content = target.read();
        const auto kind = static_cast<PickedKind>(content.kind);
        Picked picked;
        if (kind == PickedKind::Plant) {
            picked.triangle = content.index;
        } else if (is_forest_) {
            picked = forest_.picked(kind, content.index);
        }
        picked.kind = kind;
        const glm::vec4 place = block.clip_to_world * glm::vec4(0.0F, 0.0F, content.depth, 1.0F);
        const glm::dvec3 origin = frame.camera.origin;
        picked.place = kind == PickedKind::Nothing
                           ? glm::vec3(0.0F)
                           : glm::vec3(origin + glm::dvec3(glm::vec3(place) / place.w));
        return picked;
    }
    std::vector<std::uint32_t> trees_of(std::uint32_t form) const override {
        return is_forest_ ? forest_.trees_of(form) : std::vector<std::uint32_t>{};
    }
    const ForestFrameStats& forest_stats() const override { return forest_stats_; }
    ForestSizes forest_sizes() const override {
        return is_forest_ ? forest_.sizes() : ForestSizes{};
    }
    FrameTimes frame_times() const override { return times_; }
    void read_shown(std::vector<std::uint8_t>& pixels) override {
        target_.read(pixels, refinements_ != 0);
    }
    void read(std::vector<std::uint8_t>& pixels) override {
        if (refinements_ != 0) {
            static_cast<void>(draw(*shown_frame_, shown_area_));
        }
        target_.read(pixels, false);
        glFinish(); // reading waits for the texels only, not for the queries after them
        collect_device_stats();
    }
    void present(const PixelArea& area) override { target_.present(area, refinements_ != 0); }

    std::string device_name() const override { return device_.renderer(); }
    std::uint64_t live_objects() const override { return device_.live_objects(); }
    std::uint64_t uploaded_bytes() const override { return device_.uploaded_bytes(); }
    const std::vector<std::string>& errors() const override { return device_.errors(); }

private:
    /// Draws the shown frame; for a refinement, shifted by a part of a pixel. `is_temporal`: mixes
    /// it with the pictures before.
    FrameStats draw_sample(bool is_temporal) {
        const Frame& world_frame = *shown_frame_;
        const PixelArea& area = shown_area_;
        const double cpu_start = platform::thread_cpu_seconds();
        timer_.begin();
        FrameStats stats;
        forest_stats_ = {};
        const Frame frame = localised(world_frame);
        place_figure(frame);
        const Bounds lit = is_forest_              ? forest_.shadow_bounds(frame)
                           : plant_.bounds().empty ? Bounds{}
                                                   : shadow_bounds(plant_.bounds());
        casters_ = shadow_casters(lit);
        glm::mat4 shadow_from_world(1.0F);
        if (frame.shadows && frame.style != PlantStyle::None && !lit.empty) {
            shadow_from_world = shadow_matrix(lit, frame.light.to_sun, kShadowTexels);
        }
        FrameBlock block = make_frame_block(frame, area, shadow_from_world, kShadowTexels);
        if (is_temporal) {
            temporal_.resize(area.width, area.height);
        } else if (refinements_ == 0) {
            temporal_.forget(); // the next picture must not be mixed with earlier ones
        }
        const TemporalAntialiasing::Moment now{block.view_projection, block.wind, block.eye_time.w};
        const TemporalAntialiasing::Moment& before = temporal_.before(now);
        block.wind_before = before.wind;
        block.time_before.x = before.time;
        shift(block, is_temporal ? temporal_.shift() : refinements_, area);
        if (frame.style == PlantStyle::None || lit.empty) {
            block.to_sun.w = 0.0F;
        }
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glFrontFace(GL_CCW);
        if (is_forest_) {
            forest_.prepare(frame);
        }
        if (is_forest_ && block.to_sun.w != 0.0F && device_.quality() > 0) {
            draw_near_shadows(frame, block);
        }
        if (is_forest_ && device_.quality() > 0) {
            block.crowns = forest_.draw_crowns(frame.camera.eye);
            const float brighter = forest_.exposure_below_crowns(frame.camera.eye);
            block.sky.w *= brighter;
            block.near_maps.w = std::pow(brighter, -kSkyAdaptation);
            block.hills = forest_.hills();
        }
        frame_.fill(std::span<const FrameBlock>(&block, 1));
        glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_.name());
        const bool have_moved = is_forest_ && has_soft_shadows() &&
                                (frame.wind != far_wind_ || frame.time != far_time_);
        if (block.to_sun.w != 0.0F && (have_moved || shadow_.is_stale(shadow_from_world))) {
            draw_shadows(shadow_from_world, stats);
            far_wind_ = frame.wind;
            far_time_ = frame.time;
        }
        const bool moves = is_temporal && is_forest_ && forest_.is_windy();
        target_.begin(area.width, area.height, frame.samples, moves);
        if (frame.transparent) {
            constexpr std::array<GLfloat, 4> kNothing{};
            glClearBufferfv(GL_COLOR, 0, kNothing.data());
        }
        glDepthFunc(GL_GEQUAL); // reversed depth
        glBindTextureUnit(kShadowTexture, shadow_.texture());
        if (has_soft_shadows()) {
            glBindTextureUnit(kShadowDepthTexture, shadow_.depths());
        }
        if (is_forest_) {
            glPolygonMode(GL_FRONT_AND_BACK,
                          frame.style == PlantStyle::Wireframe ? GL_LINE : GL_FILL);
            forest_.draw(textures_, forest_stats_);
            glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        } else if (frame.style != PlantStyle::None) {
            draw_plant(frame.style, stats);
        }
        if (frame.figure) {
            glUseProgram(programs_.mesh.name());
            stats.draws += figure_->draw(textures_, PlantMesh::Pass::Colour);
            stats.triangles += figure_->triangles();
        }
        glDisable(GL_CULL_FACE);
        glBindVertexArray(empty_.name());
        if (frame.ground && !is_forest_ && !bounds().empty) {
            draw_ground(frame, stats);
        }
        if (!frame.transparent) { // the sky is drawn where nothing else was
            glUseProgram(programs_.sky.name());
            glDrawArrays(GL_TRIANGLES, 0, 3);
            ++stats.draws;
            ++stats.triangles;
        }
        target_.end_motions();
        if (!senses_.empty()) {
            glUseProgram(programs_.sense.name());
            senses_.draw(stats);
            glBindVertexArray(empty_.name());
        }
        glDepthFunc(GL_ALWAYS);
        if (frame.dims && !frame.transparent) {
            // Dims the picture by drawing a partly transparent sky over it.
            constexpr GLfloat kVeil = 0.6F;
            glEnable(GL_BLEND);
            glBlendColor(0.0F, 0.0F, 0.0F, kVeil);
            glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
            glUseProgram(programs_.sky.name());
            glDrawArrays(GL_TRIANGLES, 0, 3);
            glDisable(GL_BLEND);
            ++stats.draws;
            ++stats.triangles;
        }
        glUseProgram(programs_.line.name());
        stats.draws += lines_.draw();
        if (is_temporal) {
            target_.copy_parts(temporal_.parts(), moves);
            glBindVertexArray(empty_.name());
            target_.show(temporal_.mix(now, moves));
            ++stats.draws;
            ++stats.triangles;
        } else {
            target_.resolve();
        }
        for (const FrameStats* pass : {&forest_stats_.branches, &forest_stats_.impostors,
                                       &forest_stats_.terrain, &forest_stats_.shadow}) {
            stats.draws += pass->draws;
            stats.triangles += pass->triangles;
        }
        timer_.end();
        collect_device_stats();
        times_.cpu = 1e3 * (platform::thread_cpu_seconds() - cpu_start);
        return stats;
    }
    /// Whether the edges of shadows widen with the distance from the caster, and the shadows of far
    /// trees move with the wind.
    [[nodiscard]] bool has_soft_shadows() const { return device_.quality() > 1; }
    /// QUALITY of shaders.
    [[nodiscard]] std::uint32_t tier_of(Quality quality) const {
        return quality == Quality::Auto
                   ? (device_.is_software() ? 0 : 1)
                   : static_cast<std::uint32_t>(quality) - static_cast<std::uint32_t>(Quality::Low);
    }
    /// The frame with its camera relative to the origin of the forest that is shown.
    Frame localised(const Frame& frame) {
        if (!is_forest_) {
            Frame local = frame;
            local.camera = relative_to(frame.camera, glm::dvec3(0.0));
            return local;
        }
        bool moved = false;
        const Frame local = forest_.localised(frame, moved);
        if (moved) {
            invalidate_shadows();
            temporal_.forget();
        }
        return local;
    }

    /// Moves the person to the place that `frame` states. The camera of `frame` is relative to the
    /// origin.
    void place_figure(const Frame& frame) {
        const std::optional<glm::vec3> place =
            frame.figure ? std::optional(glm::vec3(*frame.figure - frame.camera.origin))
                         : std::nullopt;
        if (place == figure_place_) {
            return;
        }
        figure_place_ = place;
        if (!is_forest_) {
            shadow_.invalidate();
        }
        if (place) {
            if (figure_ == nullptr) {
                figure_ = std::make_unique<PlantMesh>(device_);
            }
            figure_->upload(make_figure_mesh(*place), textures_);
        }
    }

    /// Chooses whether the CPU or the GPU selects the visible trees of the next forest.
    Result<void> choose_culling() {
        if (culling_ == Culling::Cpu || (culling_ == Culling::Auto && device_.is_software())) {
            return forest_.cull_on_device(false, shaders_);
        }
        if (const std::optional<std::string> lacking = lacking_for_culling(culling_limits())) {
            return culling_ == Culling::Auto ? forest_.cull_on_device(false, shaders_)
                                             : Error{fmt::format("--culling gpu: {} has {}",
                                                                 device_.renderer(), *lacking)};
        }
        Result<void> done = forest_.cull_on_device(true, shaders_);
        return done || culling_ == Culling::Gpu ? done : forest_.cull_on_device(false, shaders_);
    }
    void collect_device_stats() {
        times_.gpu = timer_.milliseconds();
        if (is_forest_) {
            forest_.collect_device_stats(forest_stats_);
        }
    }

    void invalidate_shadows() {
        shadow_.invalidate();
        for (ShadowMap& map : near_shadows_) {
            map.invalidate();
        }
    }

    static void begin_casters(ShadowMap& map, const glm::mat4& matrix) {
        map.begin(matrix);
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1.5F, 2.0F);
        glEnable(GL_DEPTH_CLAMP);
    }

    /// Draws the shadow maps around the eye, and sets the members of `block` that describe them.
    void draw_near_shadows(const Frame& frame, FrameBlock& block) {
        for (std::size_t i = 0; i < kNearMaps; ++i) {
            if (near_shadows_.size() == i) {
                near_shadows_.emplace_back(device_, kShadowTexels);
            }
            ShadowMap& map = near_shadows_[i];
            // The map shows a sphere ahead of the eye. The sphere moves in large steps.
            const float radius = kNearMapSpecs[i].radius;
            const float step = 0.125F * radius;
            const glm::vec3 middle =
                glm::round((frame.camera.eye + 0.6F * radius * forward_of(frame.camera)) / step) *
                step;
            const glm::vec3 half(radius / std::sqrt(3.0F));
            const glm::mat4 lit = shadow_matrix({middle - half, middle + half, false},
                                                frame.light.to_sun, kShadowTexels);
            const bool is_soft = has_soft_shadows();
            const glm::mat4 matrix = is_soft ? deepened(lit, kNearMapSpecs[i].depth) : lit;
            block.near_from_world[i] = matrix;
            block.near_maps[static_cast<int>(i)] =
                2.0F * radius / static_cast<float>(kShadowTexels);
            block.near_maps.z = 1.0F;
            glBindTextureUnit(kNearShadowTextures + static_cast<GLuint>(i), map.texture());
            if (is_soft) {
                glBindTextureUnit(kNearDepthTextures + static_cast<GLuint>(i), map.depths());
            }
            if (map.is_stale(matrix) || frame.wind != near_wind_ || frame.time != near_time_) {
                FrameBlock casters = block;
                casters.view_projection = matrix;
                near_frame_.fill(std::span<const FrameBlock>(&casters, 1));
                glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, near_frame_.name());
                begin_casters(map, matrix);
                forest_.draw_near_shadows(i, lit, kNearMapSpecs[i].level, textures_);
                glDisable(GL_DEPTH_CLAMP);
                glDisable(GL_POLYGON_OFFSET_FILL);
            }
        }
        near_wind_ = frame.wind;
        near_time_ = frame.time;
    }

    void draw_shadows(const glm::mat4& matrix, FrameStats& stats) {
        begin_casters(shadow_, matrix);
        if (is_forest_) {
            forest_.draw_shadows(matrix, forest_stats_);
        } else {
            glUseProgram(programs_.shadow.name());
            stats.draws += plant_.draw(textures_, PlantMesh::Pass::Shadow);
            stats.triangles += plant_.triangles();
            if (figure_place_) {
                stats.draws += figure_->draw(textures_, PlantMesh::Pass::Shadow);
            }
        }
        glDisable(GL_DEPTH_CLAMP);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }

    /// Compiles the shaders of pick() when it is first called.
    Result<void> compile_pick_programs() {
        if (is_forest_) {
            return forest_.compile_pick_programs(shaders_);
        }
        if (!pick_plant_) {
            Result<ProgramObject> made = make_program(device_, shaders_, "mesh.vert.glsl",
                                                      "pick.frag.glsl", "#define PLANT\n");
            if (!made) {
                return made.error();
            }
            pick_plant_ = std::move(made.value());
        }
        return {};
    }

    void draw_plant(PlantStyle style, FrameStats& stats) {
        glUseProgram(programs_.mesh.name());
        if (style == PlantStyle::Wireframe) {
            glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        }
        stats.draws += plant_.draw(textures_, PlantMesh::Pass::Colour);
        stats.triangles += plant_.triangles();
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    }

    void draw_ground(const Frame& frame, FrameStats& stats) {
        const glm::vec4 disc =
            frame.ground_disc.w > 0.0F ? frame.ground_disc : ground_disc_of(bounds());
        // The distance of grid lines is a power of ten with which about ten lines lie along the
        // plant.
        const float unit =
            std::pow(10.0F, std::floor(std::log10(std::max(disc.w / kDiscInRadii, 1e-6F))));
        glUseProgram(programs_.ground.name());
        glUniform4f(kDisc, disc.x, disc.y, disc.z, disc.w);
        glUniform1f(kGridStep, unit);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        ++stats.draws;
        stats.triangles += 2;
    }

    Device device_; // first member: must outlive the members below
    Programs programs_;
    ProgramObject pick_plant_; // compiled on first use
    GpuTimer timer_;
    FrameTimes times_;
    Culling culling_ = Culling::Auto;
    Quality quality_ = Quality::Auto;
    RenderTarget target_;
    ShadowMap shadow_;
    std::vector<ShadowMap> near_shadows_; // one per entry of kNearMapSpecs; made when needed
    Wind near_wind_;                      // wind when near_shadows_ were last drawn
    double near_time_ = 0.0;
    Wind far_wind_; // wind when shadow_ was last drawn
    double far_time_ = 0.0;
    MaterialTextures textures_;
    TemporalAntialiasing temporal_;
    PlantMesh plant_;
    std::unique_ptr<PlantMesh> figure_;     // made when a person is first shown
    std::optional<glm::vec3> figure_place_; // feet of the person in figure_; nullopt: not shown
    LineSet lines_;
    SensePass senses_;
    ForestPass forest_;
    ForestFrameStats forest_stats_;
    bool is_forest_ = false; // a forest is shown
    Bounds casters_;         // box of the casters in the last shadow map
    ShaderSource shaders_;   // forest shaders are compiled on first use
    bool has_forest_shaders_ = false;
    std::optional<Frame> shown_frame_; // frame of the last draw()
    PixelArea shown_area_;
    std::uint32_t refinements_ = 0;
    ProgramObject copy_; // compiled on first use
    Buffer frame_;
    Buffer near_frame_; // FrameBlock while near_shadows_ are drawn
    VertexArray empty_;
};

} // namespace

const char* name_of(Quality quality) {
    constexpr std::array<const char*, 4> kNames = {"auto", "low", "medium", "high"};
    return kNames[static_cast<std::size_t>(quality)];
}

glm::vec4 ground_disc_of(const Bounds& plant) {
    const glm::vec3 size = plant.high - plant.low;
    const float radius = 0.5F * std::max(std::max(size.x, size.y), size.z);
    const float below = std::min(plant.low.y, 0.0F) - 1e-4F * radius;
    return {0.5F * (plant.low.x + plant.high.x), below, 0.5F * (plant.low.z + plant.high.z),
            kDiscInRadii * radius};
}

Result<std::unique_ptr<Renderer>> Renderer::make(const ShaderSource& shaders) {
    auto renderer = std::make_unique<GlRenderer>();
    const Result<void> loaded = renderer->reload(shaders);
    if (!loaded) {
        return loaded.error();
    }
    return std::unique_ptr<Renderer>(std::move(renderer));
}

} // namespace lsys::view
