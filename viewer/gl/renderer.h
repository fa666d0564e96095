// Renderer: pictures of plants. The one interface of everything that draws; what stands behind it
// (gl/) is the only code that knows OpenGL. A context has to be current whenever it is called.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"
#include "runtime/physics/physics.h"
#include "viewer/scene/camera.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/lines.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

/// The text of a shader by its file's name; none: there is no such file.
using ShaderSource = std::function<std::optional<std::string>(std::string_view name)>;
/// Those that are part of the program.
[[nodiscard]] std::optional<std::string> built_in_shader(std::string_view name);

/// The light of a clear day; linear RGB.
struct Light {
    glm::vec3 to_sun{0.44F, 0.72F, 0.54F}; // any length
    glm::vec3 sun{2.9F, 2.7F, 2.35F};
    glm::vec3 sky{0.36F, 0.55F, 0.95F};
    glm::vec3 horizon{0.78F, 0.86F, 0.95F};
    glm::vec3 ground{0.22F, 0.20F, 0.16F}; // what comes from below
    float extinction = 0.0F;               // of the air, 1/m
    float exposure = 0.8F;

    friend bool operator==(const Light&, const Light&) = default;
};

/// How plants are shown.
enum class PlantStyle : std::uint8_t { Surface, Wireframe, None };

/// A rectangle of a picture, pixels from its lower left corner.
struct PixelArea {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    friend bool operator==(const PixelArea&, const PixelArea&) = default;
};

/// One picture.
struct Frame {
    Camera camera;
    Light light;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    double time = 0.0; // s, of wind
    Wind wind;
    bool shadows = true;
    bool ground = true; // under a single plant
    PlantStyle style = PlantStyle::Surface;
    std::uint32_t samples = 4; // of a pixel: 1 or 4
    // Of a forest.
    std::uint64_t most_triangles = 1'500'000; // of branches; with more, trees are drawn coarser
    std::uint32_t most_expansions = ~0U;      // trees whose branches are made for one picture

    friend bool operator==(const Frame&, const Frame&) = default;
};

struct FrameStats {
    std::uint64_t draws = 0;
    std::uint64_t triangles = 0;
};

/// Of the last picture of a forest.
struct ForestFrameStats {
    std::array<std::uint32_t, kTreeLevels> trees_of_level{}; // drawn as branches
    std::uint64_t far_trees = 0;                             // as impostors
    std::uint64_t horizon_trees = 0;                         // with others of their cell
    std::uint64_t horizon_cells = 0;
    std::uint64_t blended_trees = 0; // of those, drawn as what comes next too
    std::uint64_t hidden_trees = 0;  // in view, but behind the ground
    std::uint64_t drawn_branches = 0;
    std::uint32_t expanded_trees = 0;
    std::uint32_t waiting_trees = 0;
    float detail = 1.0F; // by which sizes were multiplied, so that most_triangles was kept
    FrameStats branches;
    FrameStats impostors;
    FrameStats terrain;
    FrameStats shadow;
    double cull_milliseconds = 0.0; // with the making of branches
};

/// Of the forest that is shown.
struct ForestSizes {
    std::uint64_t trees = 0;
    std::uint64_t tree_bytes = 0;
    std::uint64_t branch_bytes = 0;
    std::uint64_t mesh_bytes = 0;
    std::uint64_t texture_bytes = 0;
    double upload_milliseconds = 0.0;
    double portrait_milliseconds = 0.0;
};

class Renderer {
public:
    /// Error: a shader does not compile.
    [[nodiscard]] static Result<std::unique_ptr<Renderer>> make(const ShaderSource& shaders);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    virtual ~Renderer() = default;

    /// The plant that is shown from now on, instead of the one before. `mesh` may then go.
    virtual void show_plant(const Mesh& mesh) = 0;
    /// The lines that are drawn over everything from now on, instead of those before.
    virtual void show_lines(std::span<const LineVertex> lines) = 0;
    /// The forest that is shown from now on instead. Its forest and terrain outlive what is shown.
    /// The pictures that stand for far trees are those of the forest before, where there was one,
    /// until make_portraits() has made others. Error: a shader does not compile.
    [[nodiscard]] virtual Result<void> show_forest(ForestModel model) = 0;
    /// Makes pictures of far trees that are missing, for about so many seconds; some each time.
    /// Whether all are there.
    [[nodiscard]] virtual bool make_portraits(double seconds) = 0;
    /// A tree of the forest that is shown comes or goes, at a cost that does not grow with the
    /// forest: ForestView::change_tree().
    virtual void change_tree(std::uint32_t index, const Tree& tree, bool alive) = 0;
    /// Of what is shown.
    [[nodiscard]] virtual const Bounds& bounds() const = 0;

    /// Compiles the shaders anew. Error: the ones before stay.
    [[nodiscard]] virtual Result<void> reload(const ShaderSource& shaders) = 0;

    /// Draws what lies within `area` of the picture into memory of the renderer's own.
    virtual FrameStats draw(const Frame& frame, const PixelArea& area) = 0;
    /// Of the last draw(); nothing if no forest is shown.
    [[nodiscard]] virtual const ForestFrameStats& forest_stats() const = 0;
    [[nodiscard]] virtual ForestSizes forest_sizes() const = 0;
    /// The rows of the last picture from top to bottom, four bytes a pixel.
    virtual void read(std::vector<std::uint8_t>& pixels) = 0;
    /// Copies the last picture to this part of the window whose context is current.
    virtual void present(const PixelArea& area) = 0;

    /// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6".
    [[nodiscard]] virtual std::string device_name() const = 0;
    [[nodiscard]] virtual std::uint64_t live_objects() const = 0;
    [[nodiscard]] virtual std::uint64_t uploaded_bytes() const = 0;
    /// What the driver reported as wrong, since the start.
    [[nodiscard]] virtual const std::vector<std::string>& errors() const = 0;

protected:
    Renderer() = default;
};

} // namespace lsys::view
