// SPDX-License-Identifier: MIT
// Renderer: draws plants and forests. The interface of viewer/gl, whose code alone calls OpenGL.
// Every call needs a current context.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"
#include "runtime/physics/physics.h"
#include "viewer/scene/branch_colours.h"
#include "viewer/scene/branch_pool.h"
#include "viewer/scene/camera.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/forest_square.h"
#include "viewer/scene/lines.h"
#include "viewer/scene/sense_drawing.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

/// Returns the text of a shader by file name; nullopt if there is no such file.
using ShaderSource = std::function<std::optional<std::string>(std::string_view name)>;
/// Shaders embedded in the program.
[[nodiscard]] std::optional<std::string> built_in_shader(std::string_view name);

/// Light of a clear day; linear RGB.
struct Light {
    glm::vec3 to_sun{0.44F, 0.72F, 0.54F}; // any length
    glm::vec3 sun{2.9F, 2.7F, 2.35F};
    glm::vec3 sky{0.36F, 0.55F, 0.95F};
    glm::vec3 horizon{0.78F, 0.86F, 0.95F};
    glm::vec3 ground{0.22F, 0.20F, 0.16F}; // ambient light from below
    float extinction = 0.0F;               // 1/m, of the air
    float exposure = 0.8F;                 // factor of colours before tone mapping

    friend bool operator==(const Light&, const Light&) = default;
};

/// Style in which surfaces are drawn.
enum class PlantStyle : std::uint8_t { Surface, Wireframe, None };

/// Rectangle of a picture in pixels from its lower left corner.
struct PixelArea {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    friend bool operator==(const PixelArea&, const PixelArea&) = default;
};

/// Parameters of one picture.
struct Frame {
    Camera camera;
    Light light;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    double time = 0.0; // s since the wind began
    Wind wind;
    bool shadows = true;
    bool ground = true; // disc under a single plant
    /// Draw a plant without sky: pixels that nothing covers have opacity 0, and colours are
    /// multiplied by opacity.
    bool transparent = false;
    /// Centre (xyz) and radius (w) of the ground disc, m. Radius 0: ground_disc_of() of the plant
    /// that is shown. A growth uses one disc for all its pictures.
    glm::vec4 ground_disc{0.0F};
    PlantStyle style = PlantStyle::Surface;
    bool dims = false;         // dims everything except lines; not with `transparent`
    std::uint32_t samples = 4; // per pixel: 1 or 4
    /// Mix the picture with earlier pictures (temporal antialiasing). Only with Quality::High,
    /// for whole pictures, and not with `transparent`.
    bool temporal = false;
    std::optional<glm::dvec3> figure; // feet of a person of 1.8 m in the world, m
    // The three fields below are for forests only.
    /// Max triangles of branches; if there are more, trees are drawn in coarser levels.
    std::uint64_t max_triangles = 1'500'000;
    /// Max trees that the CPU expands into branches per picture; further trees stay impostors until
    /// the next picture. Ignored if compute shaders choose the trees.
    std::uint32_t max_expansions = ~0U;
    /// WantedSquares::range of a streamed forest, in m; other forests show all their trees.
    float tree_range = std::numeric_limits<float>::infinity();

    friend bool operator==(const Frame&, const Frame&) = default;
};

/// Ground disc under a plant: centre (xyz) and radius (w), m.
[[nodiscard]] glm::vec4 ground_disc_of(const Bounds& plant);

struct FrameStats {
    std::uint64_t draws = 0; // number of draw calls
    std::uint64_t triangles = 0;
    double gpu_milliseconds = 0.0; // set for passes of a forest; measured as FrameTimes::gpu
};

/// Processor that chooses the trees and branches in a picture of a forest. Pictures are the same
/// with both.
enum class Culling : std::uint8_t {
    Auto, // Gpu if a hardware renderer has the needed limits, else Cpu
    Cpu,
    Gpu,
};

/// Quality, and with it drawing time, of pictures. Shaders have it as the macro QUALITY: 0, 1, 2.
enum class Quality : std::uint8_t {
    Auto, // Low for a software renderer, else Medium
    Low,
    Medium,
    High,
};

/// The name of a quality, as `--quality` takes it.
[[nodiscard]] const char* name_of(Quality quality);

/// Times of the last picture, ms.
struct FrameTimes {
    double cpu = 0.0; // processor time of the thread that called draw()
    double gpu = 0.0; // by timer queries; of an earlier picture until the GPU is done
};

/// Statistics of the last picture of a forest.
struct ForestFrameStats {
    std::array<std::uint32_t, kTreeLevels> trees_of_level{}; // drawn as branches
    std::uint64_t far_trees = 0;                             // drawn as impostors
    std::uint64_t clustered_trees = 0;                       // drawn in clusters
    std::uint64_t clusters = 0;
    std::uint64_t blended_trees = 0;  // drawn in two levels of detail, mixed
    std::uint64_t occluded_trees = 0; // inside the frustum, but occluded by the ground
    std::uint64_t drawn_branches = 0;
    std::uint32_t expanded_trees = 0; // whose branches were made for this picture
    std::uint32_t waiting_trees = 0;  // near trees, drawn as impostors until they are expanded
    float detail = 1.0F;              // factor of heights in pixels; below 1 to keep max_triangles
    FrameStats branches;
    FrameStats impostors;
    FrameStats terrain;
    FrameStats shadow;
    double cull_milliseconds = 0.0;     // time to choose trees, with their expansion
    double cull_cpu_milliseconds = 0.0; // processor time of the thread, without waiting
    // Whether compute shaders choose the trees. Then all counts above, except those of draws, are
    // counts of the last picture that the device has finished: after read() the last picture,
    // before read() an earlier one.
    bool is_culled_on_device = false;
    double cull_gpu_milliseconds = 0.0; // time of the compute shaders
    /// Triangles that draw() does not count, because only the device knows their number.
    std::uint64_t device_triangles = 0;
};

/// Sizes of the forest that is shown.
struct ForestSizes {
    std::uint64_t trees = 0;         // number of trees
    std::uint64_t tree_bytes = 0;    // records of trees, on the device and in memory
    std::uint64_t branch_bytes = 0;  // branches of near trees
    std::uint64_t culling_bytes = 0; // buffers of the compute shaders, with their branches
    std::uint64_t mesh_bytes = 0;    // meshes of branches
    std::uint64_t texture_bytes = 0;
    double upload_milliseconds = 0.0;
    double impostor_milliseconds = 0.0; // time to bake impostors
};

/// Kind of the part that a pixel of a picture shows. The values are those that
/// shaders/pick.frag.glsl writes.
enum class PickedKind : std::uint8_t {
    Nothing = 0,  // sky, or the ground below a plant
    Plant = 1,    // a triangle of the plant
    Branch = 2,   // a branch of a near tree
    Impostor = 3, // the picture of a tree
    Cluster = 4,  // the picture of the trees of a cell
    Ground = 5,   // ground of a forest
};

struct Picked {
    PickedKind kind = PickedKind::Nothing;
    glm::vec3 place{};          // m; set for all kinds except Nothing
    std::uint64_t triangle = 0; // Plant: number of the triangle in the mesh of show_plant()
    std::uint32_t instance = 0; // Branch: index in InstanceCache::instances of the form
    std::uint32_t form = 0;     // Branch, Impostor: index in ForestModel::forms
    Tree tree;                  // Branch, Impostor
    std::uint32_t trees = 0;    // Cluster: number of trees
};

class Renderer {
public:
    /// Error: a shader does not compile.
    [[nodiscard]] static Result<std::unique_ptr<Renderer>> make(const ShaderSource& shaders);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    virtual ~Renderer() = default;

    /// Shows a plant in place of the previous plant or forest. `mesh` is copied to the device.
    virtual void show_plant(const Mesh& mesh) = 0;
    /// Replaces the lines, which are drawn on top of the picture.
    virtual void show_lines(std::span<const LineVertex> lines) = 0;
    /// Replaces what plants sense; in a forest, its places are relative to the forest's origin.
    virtual void show_senses(const SenseDrawing& drawing) = 0;
    /// Sets the quality of later pictures, which is Auto at first. Error: a shader does not
    /// compile; the old quality stays.
    [[nodiscard]] virtual Result<void> set_quality(Quality quality) = 0;
    /// The quality of later pictures: Low, Medium or High.
    [[nodiscard]] virtual Quality quality() const = 0;
    /// Sets the processor that chooses the trees of later forests, which is Auto at first.
    virtual void set_culling(Culling culling) = 0;
    /// Whether the device is fast enough for temporal antialiasing, and the quality is High.
    [[nodiscard]] virtual bool prefers_temporal() const = 0;
    /// Shows a forest in place of the previous plant or forest. The forest and the terrain of
    /// `model` must live as long as the forest is shown. bake_impostors() makes the new impostors.
    /// Until then, the impostors of the previous forest are drawn if both forests have the same
    /// number of impostors, else only the impostors that both forests share. Error: a shader does
    /// not compile, or the device lacks features that the value of set_culling() needs.
    [[nodiscard]] virtual Result<void> show_forest(ForestModel model) = 0;
    /// Updates the trees of the forest shown after a change; its other parts must be unchanged.
    virtual void update_trees() = 0;
    /// Bakes missing impostors for about `seconds`. Returns whether all are done.
    [[nodiscard]] virtual bool bake_impostors(double seconds) = 0;
    /// Whether all trees of the forest have impostors. Until its own impostor is baked, a tree may
    /// have that of another tree.
    [[nodiscard]] virtual bool has_stand_ins() const = 0;
    /// Adds or removes a tree of the forest, as ForestLod::change_tree() does.
    virtual void change_tree(std::uint32_t index, const Tree& tree, bool alive) = 0;
    /// Adds and removes squares of a streamed forest, which has no squares after show_forest().
    virtual void change_squares(const SquareChanges& changes) = 0;
    /// Colours the branches of this forest and of all later ones. Call bake_impostors() afterwards.
    virtual void colour_branches(BranchColours by) = 0;
    /// Bounding box of the plant or forest; empty for a streamed forest.
    [[nodiscard]] virtual const Bounds& bounds() const = 0;

    /// Compiles the shaders again. Error: a shader does not compile; the old shaders stay in use.
    [[nodiscard]] virtual Result<void> reload(const ShaderSource& shaders) = 0;

    /// Draws the part of a picture within `area` into an offscreen framebuffer.
    virtual FrameStats draw(const Frame& frame, const PixelArea& area) = 0;
    /// Finds the part that draw() shows at the middle of a pixel of the frame. Lines drawn over the
    /// picture are ignored; wireframes count as surfaces. `x`, `y`: pixels from the lower left
    /// corner of the picture. The last picture stays. Error: a shader does not compile.
    [[nodiscard]] virtual Result<Picked>
    pick(const Frame& frame, std::uint32_t x, std::uint32_t y) = 0;
    /// Numbers (Tree::number) of the trees of the form `form` that stand in the forest.
    [[nodiscard]] virtual std::vector<std::uint32_t> trees_of(std::uint32_t form) const = 0;
    /// Statistics of the last draw(); empty without a forest.
    [[nodiscard]] virtual const ForestFrameStats& forest_stats() const = 0;
    [[nodiscard]] virtual ForestSizes forest_sizes() const = 0;
    [[nodiscard]] virtual FrameTimes frame_times() const = 0;
    /// Draws the last picture again, shifted by a part of a pixel, and adds it to the mean, which
    /// present() shows until the next draw(). Precondition: the plant or forest has not changed
    /// since draw(). Once the mean has 17 pictures, draws nothing and returns false.
    [[nodiscard]] virtual bool refine() = 0;
    /// Reads the picture that present() shows: RGBA, rows from top to bottom.
    virtual void read_shown(std::vector<std::uint8_t>& pixels) = 0;
    /// Reads the picture of the last draw() without refinement: RGBA, rows from top to bottom.
    virtual void read(std::vector<std::uint8_t>& pixels) = 0;
    /// Copies the last picture, refined or not, to a part of the window whose OpenGL context is
    /// current.
    virtual void present(const PixelArea& area) = 0;

    /// Device and version of OpenGL, for example
    /// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6".
    [[nodiscard]] virtual std::string device_name() const = 0;
    [[nodiscard]] virtual std::uint64_t live_objects() const = 0;
    [[nodiscard]] virtual std::uint64_t uploaded_bytes() const = 0;
    /// Errors that the driver reported since the renderer was made.
    [[nodiscard]] virtual const std::vector<std::string>& errors() const = 0;

protected:
    Renderer() = default;
};

} // namespace lsys::view
