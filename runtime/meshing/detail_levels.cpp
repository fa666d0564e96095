#include "runtime/meshing/detail_levels.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/meshing/impl/impostor.h"
#include "runtime/meshing/impl/thinning.h"
#include "runtime/meshing/impl/visible_areas.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

// Each level has this part of the triangles of the one before, and at most kMaxPart of them.
constexpr double kPart = 1.0 / 2.45;
constexpr double kMaxPart = 1.0 / 2.0;
constexpr double kMinPart = 1.0 / 3.0;
constexpr double kMinPartOfBoxes = 1.0 / 4.5; // a step of their subdivision has a quarter
constexpr std::uint32_t kMaxSideLevel = 8;
constexpr int kMaxTries = 24;
constexpr double kEnough = 0.96; // of the wanted triangles end the search for a number of paths
constexpr int kFittingSteps = 12;
constexpr double kCloseAreas = 0.002; // ends the fitting of areas: part of wood, and a part of all
constexpr double kAreaWeight = 0.1;
constexpr double kMinScale = 0.2; // of what is fitted
constexpr double kMaxScale = 6.0;
constexpr double kMaxStep = 1.8;   // factor of a scale from one try to the next
constexpr double kMaxExcess = 3.0; // of an area, as a part of the wanted one
constexpr double kMinTint = 0.4;
constexpr double kMaxTint = 2.0;
constexpr double kCloseTint = 0.005; // is left as it is
constexpr double kMinCover = 0.25;   // of impostors
constexpr double kMaxCover = 1.75;
// Triangles of the level before an impostor.
constexpr std::uint64_t kMinBeforeImpostor = 3 * kImpostorTriangles / 2;
constexpr std::uint64_t kWantedBeforeImpostor = 5 * kImpostorTriangles / 2;
constexpr std::uint64_t kMaxBeforeImpostor = 3 * kImpostorTriangles;
constexpr double kMinMove = 1e-12;       // of a step that teaches derivatives
constexpr float kMaxRadiusErrors = 2.0F; // radius of widened wood in errors: it is two pixels wide

std::uint64_t triangles_of(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (const MeshPart& part : mesh.parts) {
        count += part.index_count / 3;
    }
    return count;
}

float largest_extent(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    const glm::vec3 extent = bounds.high - bounds.low;
    return std::max({extent.x, extent.y, extent.z});
}

Thinning thinning_of(const DetailLevel& level) {
    return {.paths = level.paths,
            .foliage = level.foliage,
            .max_radius = kMaxRadiusErrors * level.error,
            .wood_scale = level.wood_scale,
            .foliage_scale = level.foliage_scale};
}

class Planner {
public:
    Planner(const Skeleton& skeleton,
            const std::vector<UserMesh>& user_meshes,
            const MeshOptions& options,
            const ThinningOrder& order)
        : skeleton_(skeleton), user_meshes_(user_meshes), order_(order),
          options_(resolved(options, skeleton)) {
        wood_.segments = skeleton.segments;
        wood_.l3d_compatible_surface = skeleton.l3d_compatible_surface;
        wood_.box_segments = skeleton.box_segments;
        foliage_ = skeleton;
        foliage_.segments = {};
        foliage_.segment_origins = {};
        fine_ = foliage_shapes(order, user_meshes, options.level);
    }

    std::optional<Stop> plan(const DetailChain& chain, DetailLevels& result) {
        DetailLevel level{
            .options = options_, .paths = order_.path_count(), .foliage = order_.foliage.size()};
        count(skeleton_, options_);
        if (stop_) {
            return stop_;
        }
        level.triangles = triangles_of(mesh_);
        finest_ = static_cast<double>(level.triangles);
        extent_ = largest_extent(mesh_);
        for (const glm::vec3& position : mesh_.positions) {
            frame_.add(position);
        }
        measure_polygons();
        areas_ = areas_of(level);
        result.levels.push_back(level);
        const std::uint64_t end = chain.pictures ? kMinBeforeImpostor : kMinDetailTriangles;
        min_wanted_ = chain.pictures ? static_cast<double>(kWantedBeforeImpostor) : 0.0;
        while (result.levels.size() <= chain.last && level.triangles > end) {
            if (chain.pictures && level.triangles <= kMaxBeforeImpostor) {
                result.levels.push_back(impostor());
                return stop_;
            }
            DetailLevel next = coarser(level);
            fit_areas(next);
            if (chain.pictures) {
                next.tint = tint_for(areas_of(next));
            }
            next.triangles = exact_triangles(next);
            if (stop_) {
                return stop_;
            }
            const bool is_last = next.triangles <= end || next.triangles >= level.triangles;
            if (chain.pictures && is_last) {
                result.levels.push_back(impostor());
                return stop_;
            }
            if (next.triangles >= level.triangles) {
                break;
            }
            level = next;
            result.levels.push_back(level);
        }
        return std::nullopt;
    }

private:
    /// Meshes without arrays that do not change the number of triangles.
    void count(const Skeleton& skeleton, MeshOptions options) {
        options.texture_coordinates = false;
        options.tangents = false;
        options.colours = false;
        options.segments = false;
        if (!stop_) {
            stop_ = make_mesh(skeleton, user_meshes_, options, mesh_);
        }
    }

    std::uint64_t wood_triangles(const DetailLevel& level) {
        if (!level.thinned) {
            count(wood_, level.options);
            return triangles_of(mesh_);
        }
        Skeleton thin;
        thin_skeleton(wood_, order_, {.paths = level.paths, .foliage = 0}, {}, {}, thin, numbers_);
        count(thin, level.options);
        return triangles_of(mesh_);
    }

    /// About: corners of a polygon that coincide make no triangles.
    double triangles_of_item(std::uint32_t item, const std::vector<FoliageShape>& shapes) const {
        const std::size_t objects = skeleton_.objects.size();
        return item < objects
                   ? static_cast<double>(shapes[order_.group_of[item]].triangles)
                   : triangles_per_ear_ *
                         static_cast<double>(skeleton_.polygons[item - objects].corner_count - 2);
    }
    double foliage_triangles(const DetailLevel& level) const {
        const std::vector<FoliageShape> shapes =
            foliage_shapes(order_, user_meshes_, level.options.level);
        double sum = 0.0;
        for (std::uint64_t rank = 0; rank < level.foliage; ++rank) {
            sum += triangles_of_item(order_.foliage[rank], shapes);
        }
        return sum;
    }
    void measure_polygons() {
        double ears = 0.0;
        for (const Polygon& polygon : skeleton_.polygons) {
            ears += static_cast<double>(polygon.corner_count - 2);
        }
        if (ears > 0.0) {
            Skeleton polygons;
            polygons.polygons = skeleton_.polygons;
            polygons.corners = skeleton_.corners;
            count(polygons, options_);
            triangles_per_ear_ = static_cast<double>(triangles_of(mesh_)) / ears;
        }
    }

    /// Meshes with what decides over visible areas.
    void draw(const Skeleton& skeleton, MeshOptions options, Mesh& mesh) {
        options.texture_coordinates = true;
        options.tangents = false;
        options.colours = false;
        options.segments = false;
        if (!stop_) {
            stop_ = make_mesh(skeleton, user_meshes_, options, mesh);
        }
    }
    VisibleAreas areas_of(const DetailLevel& level) {
        if (!level.thinned) {
            draw(wood_, level.options, mesh_);
            draw(foliage_, level.options, foliage_mesh_);
        } else {
            Skeleton thin;
            thin_skeleton(skeleton_, order_, thinning_of(level), fine_,
                          foliage_shapes(order_, user_meshes_, level.options.level), thin,
                          numbers_);
            Skeleton rest = thin;
            thin.objects = {};
            thin.polygons = {};
            rest.segments = {};
            draw(thin, level.options, mesh_);
            draw(rest, level.options, foliage_mesh_);
        }
        return stop_ ? VisibleAreas{} : visible_areas(mesh_, foliage_mesh_, frame_);
    }

    /// Scales wood and foliage until they cover what they cover at the finest level, by Broyden's
    /// method ("A class of methods for solving nonlinear simultaneous equations", 1965).
    void fit_areas(DetailLevel& level) {
        if (!level.thinned &&
            (level.options.method != MeshMethod::Tubes || skeleton_.l3d_compatible_surface)) {
            return;
        }
        DetailLevel tried = level;
        glm::dvec2 scales(1.0);
        glm::dvec2 step(0.0);
        glm::dvec2 before(0.0);
        // Inverse of the derivatives of areas: that of wood grows as its widths, that of foliage as
        // the square of its size.
        glm::dmat2 inverse(1.0, 0.0, 0.0, 0.5);
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i < kFittingSteps && !stop_; ++i) {
            tried.wood_scale = static_cast<float>(scales.x);
            tried.foliage_scale = static_cast<float>(scales.y);
            const VisibleAreas now = areas_of(tried);
            const double off = difference(now);
            if (off < best) {
                best = off;
                level = tried;
            }
            if (off < kCloseAreas) {
                return;
            }
            const glm::dvec2 error(excess(now.wood, areas_.wood),
                                   excess(now.foliage, areas_.foliage));
            const glm::dvec2 moved = inverse * (error - before);
            const double length = glm::dot(step, moved);
            if (std::abs(length) > kMinMove) {
                inverse += glm::outerProduct(step - moved, step * inverse) / length;
            }
            before = error;
            const glm::dvec2 wanted = scales - inverse * error;
            step = glm::clamp(glm::clamp(wanted, scales / kMaxStep, scales * kMaxStep),
                              glm::dvec2(kMinScale), glm::dvec2(kMaxScale)) -
                   scales;
            scales += step;
            tried.thinned = true;
        }
    }
    /// The impostor that covers what the finest level covers.
    DetailLevel impostor() {
        DetailLevel level{.options = options_, .impostor = true};
        draw(skeleton_, level.options, mesh_);
        if (stop_) {
            return level;
        }
        const ImpostorBaker baker(mesh_);
        const Mesh none;
        double low = kMinCover;
        double high = kMaxCover;
        for (int i = 0; i < kFittingSteps; ++i) {
            level.cover = 0.5 * (low + high);
            const Mesh cards = baker.make(level.cover);
            level.triangles = triangles_of(cards);
            (visible_areas(none, cards, frame_).all() < areas_.all() ? low : high) = level.cover;
        }
        const Mesh cards = baker.make(level.cover);
        level.tint = tint_for(visible_areas(none, cards, frame_));
        set_error(static_cast<double>(level.triangles), level);
        return level;
    }
    /// The factor of colours that gives `now` the mean colour of the finest level.
    glm::vec3 tint_for(const VisibleAreas& now) const {
        glm::dvec3 tint(1.0);
        const glm::dvec3 wanted = areas_.mean_colour();
        const glm::dvec3 own = now.mean_colour();
        for (int c = 0; c < 3; ++c) {
            if (own[c] > 0.0) {
                tint[c] = std::clamp(wanted[c] / own[c], kMinTint, kMaxTint);
            }
        }
        const glm::dvec3 off = glm::abs(tint - 1.0);
        return std::max({off.x, off.y, off.z}) < kCloseTint ? glm::vec3(1.0F) : glm::vec3(tint);
    }
    /// Difference of colour as the part of wood, and less so of what is covered.
    double difference(const VisibleAreas& now) const {
        const double all = std::max(areas_.all(), 1.0);
        return std::abs(now.wood / std::max(now.all(), 1.0) - areas_.wood / all) +
               kAreaWeight * std::abs(now.all() / all - 1.0);
    }
    static double excess(double area, double wanted) {
        return wanted > 0.0 ? std::min(area / wanted - 1.0, kMaxExcess) : 0.0;
    }

    /// The triangles of a level as it will be drawn.
    std::uint64_t exact_triangles(const DetailLevel& level) {
        if (!level.thinned) {
            count(skeleton_, level.options);
        } else {
            Skeleton thin;
            thin_skeleton(skeleton_, order_, thinning_of(level), fine_,
                          foliage_shapes(order_, user_meshes_, level.options.level), thin,
                          numbers_);
            count(thin, level.options);
        }
        return triangles_of(mesh_);
    }

    /// Sets the course allowed to branches of a level of about so many triangles.
    void set_error(double triangles, DetailLevel& level) const {
        const auto part = static_cast<float>(std::sqrt(std::max(triangles, 1.0) / finest_));
        level.pixels = kFinestPixels * part;
        level.error = 0.5F * extent_ / level.pixels;
        level.options.axis_error = level.error;
    }

    DetailLevel coarser(const DetailLevel& before) {
        const auto all = static_cast<double>(before.triangles);
        const bool is_boxes = before.options.method == MeshMethod::Boxes;
        const double min = (is_boxes ? kMinPartOfBoxes : kMinPart) * all;
        DetailLevel base = before;
        set_error(kPart * all, base);
        auto wood = static_cast<double>(wood_triangles(base));
        double foliage = foliage_triangles(base);
        // Fewer sides, as long as that alone does not leave too little.
        for (std::uint32_t sides = before.options.level;
             sides <= options_.level + kMaxSideLevel && !stop_; ++sides) {
            DetailLevel level = base;
            level.options.level = sides;
            const auto level_wood = static_cast<double>(wood_triangles(level));
            const double level_foliage = foliage_triangles(level);
            const double triangles = level_wood + level_foliage;
            if (triangles < min) {
                break;
            }
            if (triangles <= kMaxPart * all) {
                return level;
            }
            base = level;
            wood = level_wood;
            foliage = level_foliage;
        }
        return thinner(base, wood, foliage, std::max(kPart * all, min_wanted_));
    }

    /// Leaves out paths and foliage until about `wanted` triangles are left, in the proportion of
    /// `wood` and `foliage`.
    DetailLevel thinner(DetailLevel level, double wood, double foliage, double wanted) {
        level.thinned = true;
        if (!leaves_out_) {
            leaves_out_ = true;
            level.options.method = MeshMethod::Tubes;
            level.options.bark_noise = 0.0F;
            level.options.grooves = 0.0F;
            level.options.smooth_joints = false;
            level.options.deviation = 0.0F;
        }
        const double part = wanted / std::max(wood + foliage, 1.0);
        double left = 0.0;
        if (level.foliage > 0) {
            const std::vector<FoliageShape> shapes =
                foliage_shapes(order_, user_meshes_, level.options.level);
            std::uint64_t rank = 0;
            for (; rank < level.foliage; ++rank) {
                const double more = triangles_of_item(order_.foliage[rank], shapes);
                if (rank > 0 && left + more > part * foliage) {
                    break;
                }
                left += more;
            }
            level.foliage = rank;
        }
        if (level.paths > 0) {
            thin_paths(level, std::max(wanted - left, 0.0));
        }
        return level;
    }

    /// Sets the largest number of paths that have at most `wanted` triangles, at least one.
    void thin_paths(DetailLevel& level, double wanted) {
        std::uint64_t high = level.paths;
        std::uint64_t high_count = wood_triangles(level);
        if (static_cast<double>(high_count) <= wanted) {
            return;
        }
        std::uint64_t low = 0;
        std::uint64_t low_count = 0;
        for (int i = 0; i < kMaxTries && high - low > 1 && !stop_; ++i) {
            // By proportion, and by halves every other time.
            const double slope = (wanted - static_cast<double>(low_count)) /
                                 static_cast<double>(high_count - low_count);
            const auto step = static_cast<std::uint64_t>((i % 2 == 0 ? slope : 0.5) *
                                                         static_cast<double>(high - low));
            level.paths = low + std::clamp<std::uint64_t>(step, 1, high - low - 1);
            const std::uint64_t now = wood_triangles(level);
            if (static_cast<double>(now) <= wanted) {
                low = level.paths;
                low_count = now;
                if (static_cast<double>(now) >= kEnough * wanted) {
                    return;
                }
            } else {
                high = level.paths;
                high_count = std::max(now, low_count + 1);
            }
        }
        level.paths = std::max<std::uint64_t>(low, 1);
        if (low == 0) {
            straighten(level, wanted);
        }
    }

    /// Takes joints from the only path that is left.
    void straighten(DetailLevel& level, double wanted) {
        std::uint64_t now = wood_triangles(level);
        for (int i = 0; i<kMaxTries&& static_cast<double>(now)> wanted && !stop_; ++i) {
            if (level.options.axis_error > extent_) {
                break;
            }
            level.options.axis_error *= 1.25F;
            now = wood_triangles(level);
        }
    }

    const Skeleton& skeleton_;
    const std::vector<UserMesh>& user_meshes_;
    const ThinningOrder& order_;
    MeshOptions options_;
    Skeleton wood_;
    Skeleton foliage_;
    Mesh foliage_mesh_;
    std::vector<FoliageShape> fine_;
    Mesh mesh_;
    LargeVector<std::uint32_t> numbers_;
    bool leaves_out_ = false; // levels from here on have fewer parts
    VisibleAreas areas_;      // of the finest level
    Bounds frame_;
    double finest_ = 1.0;
    double min_wanted_ = 0.0;        // triangles of a level
    double triangles_per_ear_ = 1.0; // of polygons, which have corners - 2 ears
    float extent_ = 0.0F;
    std::optional<Stop> stop_;
};

/// Whether all vertices of each part have one colour.
bool has_plain_parts(const Mesh& mesh) {
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        for (std::uint64_t i = 1; i < part.index_count && !mesh.colours.empty(); ++i) {
            if (mesh.colours[indices[part.first_index + i]] !=
                mesh.colours[indices[part.first_index]]) {
                return false;
            }
        }
    }
    return true;
}

/// Multiplies the colours of materials, which then replace those of vertices.
void tint_materials(const glm::vec3& tint, Mesh& mesh) {
    if (tint == glm::vec3(1.0F) || !has_plain_parts(mesh)) {
        return;
    }
    mesh.colours.clear();
    for (Material& material : mesh.materials) {
        material.colour = glm::vec4(tint, 1.0F) * material.colour;
    }
}

/// The impostor of a pose, with the arrays that are asked for.
std::optional<Stop> make_impostor(const Skeleton& skeleton,
                                  const std::vector<UserMesh>& user_meshes,
                                  const MeshOptions& options,
                                  double cover,
                                  Mesh& mesh) {
    MeshOptions baked = options;
    baked.texture_coordinates = true;
    baked.tangents = false;
    baked.colours = true;
    baked.segments = false;
    if (const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, baked, mesh)) {
        return stop;
    }
    return catch_out_of_memory(
        [&]() -> std::optional<Stop> {
            mesh = ImpostorBaker(mesh).make(cover);
            if (!options.tangents) {
                mesh.tangents.clear();
            }
            if (options.colours) {
                mesh.colours.resize(mesh.positions.size());
                std::fill(mesh.colours.begin(), mesh.colours.end(), std::uint16_t{0});
            }
            if (options.segments) {
                mesh.segments.resize(mesh.positions.size());
                std::fill(mesh.segments.begin(), mesh.segments.end(),
                          VertexSegments{kNoSegment, kNoSegment});
            }
            return std::nullopt;
        },
        [&] {
            mesh = {};
            return Stop::OutOfMemory;
        });
}

} // namespace

std::optional<Stop> plan_detail_levels(const Skeleton& skeleton,
                                       const std::vector<UserMesh>& user_meshes,
                                       const MeshOptions& options,
                                       const DetailChain& chain,
                                       DetailLevels& levels) {
    levels = {};
    if (chain.last == 0 || options.method == MeshMethod::Solid) {
        levels.levels.push_back({.options = options});
        return std::nullopt;
    }
    return catch_out_of_memory(
        [&] {
            const auto order = std::make_shared<const ThinningOrder>(thinning_order(skeleton));
            levels.order = order;
            return Planner(skeleton, user_meshes, options, *order).plan(chain, levels);
        },
        [&] {
            levels = {};
            return Stop::OutOfMemory;
        });
}

std::optional<Stop> make_detail_mesh(const Skeleton& skeleton,
                                     const std::vector<UserMesh>& user_meshes,
                                     const DetailLevels& levels,
                                     std::size_t number,
                                     const MeshOptions& options,
                                     Mesh& mesh) {
    const DetailLevel& level = levels.levels[number];
    MeshOptions all = level.options;
    all.texture_coordinates = options.texture_coordinates;
    all.tangents = options.tangents;
    all.colours = options.colours;
    all.segments = options.segments;
    all.threads = options.threads;
    all.max_bytes = options.max_bytes;
    if (level.impostor) {
        const std::optional<Stop> stop =
            make_impostor(skeleton, user_meshes, all, level.cover, mesh);
        tint_materials(level.tint, mesh);
        return stop;
    }
    if (!level.thinned) {
        const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, all, mesh);
        tint_materials(level.tint, mesh);
        return stop;
    }
    return catch_out_of_memory(
        [&]() -> std::optional<Stop> {
            const ThinningOrder& order = *levels.order;
            Skeleton thin;
            LargeVector<std::uint32_t> numbers;
            thin_skeleton(skeleton, order, thinning_of(level),
                          foliage_shapes(order, user_meshes, levels.levels[0].options.level),
                          foliage_shapes(order, user_meshes, all.level), thin, numbers);
            if (const std::optional<Stop> stop = make_mesh(thin, user_meshes, all, mesh)) {
                return stop;
            }
            tint_materials(level.tint, mesh);
            for (VertexSegments& pair : mesh.segments) {
                for (std::uint32_t& segment : pair) {
                    segment = segment < numbers.size() ? numbers[segment] : kNoSegment;
                }
            }
            return std::nullopt;
        },
        [&] {
            mesh = {};
            return Stop::OutOfMemory;
        });
}

} // namespace lsys
