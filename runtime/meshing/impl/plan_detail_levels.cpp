// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/detail_planner.h"

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

// Usual ratio of the triangles of a level to those of the next level.
constexpr double kUsualFactor = 2.45;
constexpr double kRootFactor = 1.5652;      // square root of kUsualFactor
constexpr double kLastTriangles = 45.0;     // wanted triangles of the last level without impostors
constexpr double kLastCardTriangles = 24.0; // wanted triangles of the last level with impostors
// A level with at most this many triangles may be followed by an impostor if the next mesh would
// look poor.
constexpr std::uint64_t kMaxTrianglesBeforePoor = 450;
// A mesh looks poor if wood of the plant is, on average, more than this many pixels away from the
// wood that the mesh keeps.
constexpr double kPoorPixels = 0.8;
constexpr std::uint64_t kMaxTrianglesBeforeCards = 100; // with fewer triangles only cards follow
constexpr std::uint64_t kMaxLastMeshTriangles = 20; // max triangles of a mesh that ends the chain
constexpr std::uint64_t kMaxLastCardTriangles = 40; // max triangles of cards that end the chain
constexpr double kMaxCardTriangles = 400.0;         // max triangles of an impostor
constexpr int kMaxEqualSteps = 3; // with at most this many steps left, all ratios are equal
constexpr int kRootSteps = 40;    // bisections in DetailPlanner::factor_from()

} // namespace

DetailPlanner::DetailPlanner(const Skeleton& skeleton,
                             const std::vector<UserMesh>& user_meshes,
                             const MeshOptions& options,
                             const ThinningOrder& order)
    : skeleton_(skeleton), user_meshes_(user_meshes), order_(order),
      options_(resolved(options, skeleton)) {
    wood_.segments = skeleton.segments;
    wood_.l3d_compatible_surface = skeleton.l3d_compatible_surface;
    wood_.box_segments = skeleton.box_segments;
    wood_.tube_shape = skeleton.tube_shape;
    wood_.looks = skeleton.looks;
    foliage_ = skeleton;
    foliage_.segments = {};
    foliage_.segment_origins = {};
    fine_ = foliage_shapes(order, user_meshes, options.level);
    measure_paths();
}

std::optional<Stop> DetailPlanner::plan(const DetailChain& chain, DetailLevels& result) {
    DetailLevel level{
        .options = options_, .paths = order_.path_count(), .foliage = order_.foliage.size()};
    measure_finest();
    level.triangles = finest_triangles_;
    result.levels.push_back(level);
    last_triangles_ = chain.pictures ? kLastCardTriangles : kLastTriangles;
    while (result.levels.size() <= chain.last && !stop_) {
        const std::uint64_t end = !chain.pictures     ? kMinDetailTriangles
                                  : level.is_impostor ? kMaxLastCardTriangles
                                                      : kMaxLastMeshTriangles;
        if (level.triangles <= end) {
            break;
        }
        DetailLevel next = level;
        if (!level.is_impostor && (!chain.pictures || level.triangles > kMaxTrianglesBeforeCards)) {
            next = coarser(level);
        }
        if (chain.pictures) {
            const DetailLevel cards = cards_after(level);
            const bool is_forced = next.triangles >= level.triangles;
            const bool is_poor = level.triangles <= kMaxTrianglesBeforePoor && looks_poor(next);
            const double off = ratio_excess(level, cards);
            if (is_forced || off < ratio_excess(level, next) || (is_poor && off == 0.0)) {
                next = cards;
            }
        }
        if (next.triangles >= level.triangles) {
            break;
        }
        level = next;
        result.levels.push_back(level);
    }
    return stop_;
}

void DetailPlanner::set_error(double triangles, DetailLevel& level) const {
    const auto part = static_cast<float>(
        std::sqrt(std::max(triangles, 1.0) / static_cast<double>(finest_triangles_)));
    level.pixels = kFinestPixels * part;
    level.error = 0.5F * extent_ / level.pixels;
    level.options.axis_error = level.error;
}

bool DetailPlanner::looks_poor(const DetailLevel& level) const {
    return !order_.foliage.empty() ||
           mean_distances_[level.paths] > kPoorPixels * 2.0 * static_cast<double>(level.error);
}

DetailLevel DetailPlanner::cards_after(const DetailLevel& before) const {
    const auto all = static_cast<double>(before.triangles);
    const double factor = before.triangles <= kMaxTrianglesBeforeCards
                              ? std::clamp(all / last_triangles_, kLowFactor, kMaxFactor)
                              : factor_from(all);
    const double wanted = std::min(all / factor, kMaxCardTriangles);
    DetailLevel level{.options = options_, .is_impostor = true};
    level.triangles = 2 * static_cast<std::uint64_t>(0.5 * wanted);
    if (kMaxFactor * static_cast<double>(level.triangles) < all &&
        static_cast<double>(level.triangles + 2) <= kMaxCardTriangles) {
        level.triangles += 2;
    }
    set_error(static_cast<double>(level.triangles), level);
    level.options = options_;
    return level;
}

double
DetailPlanner::ratio_excess(const DetailLevel& before, const DetailLevel& next, double safe) {
    const double max_factor =
        before.options.method == MeshMethod::Boxes ? kMaxFactorOfBoxes : kMaxFactor;
    const double factor =
        static_cast<double>(before.triangles) / std::max(static_cast<double>(next.triangles), 1.0);
    return std::max({safe * kLowFactor / factor, safe * factor / max_factor, 1.0}) - 1.0;
}

double DetailPlanner::factor_from(double triangles) const {
    const double all = triangles / last_triangles_;
    int steps = 1;
    double max_ratio = kMaxFactor;             // max ratio that `steps` steps can reach
    double usual = kUsualFactor * kRootFactor; // above it, steps + 1 fit kUsualFactor better
    while (max_ratio < all || usual < all) {
        ++steps;
        max_ratio *= kMaxFactor;
        usual *= kUsualFactor;
    }
    if (steps > kMaxEqualSteps) {
        return kUsualFactor;
    }
    double low = 1.0;
    double high = std::max(all, 1.0);
    for (int i = 0; i < kRootSteps; ++i) {
        const double middle = 0.5 * (low + high);
        double power = 1.0;
        for (int k = 0; k < steps; ++k) {
            power *= middle;
        }
        (power < all ? low : high) = middle;
    }
    return std::clamp(high, kLowFactor, kMaxFactor);
}

void DetailPlanner::measure_finest() {
    count(skeleton_, options_);
    finest_triangles_ = triangles_of(mesh_);
    for (const glm::vec3& position : mesh_.positions) {
        frame_.add(position);
    }
    const glm::vec3 extent = frame_.high - frame_.low;
    extent_ = std::max({extent.x, extent.y, extent.z});
    measure_polygons();
}

void DetailPlanner::measure_paths() {
    std::vector<double> areas(order_.path_count());
    std::vector<double> lengths(order_.path_count());
    double all = 0.0;
    for (std::size_t i = 0; i < skeleton_.segments.size(); ++i) {
        const Segment& segment = skeleton_.segments[i];
        const double area = outline_area(segment);
        areas[order_.path_ranks[i]] += area;
        lengths[order_.path_ranks[i]] += static_cast<double>(segment.length);
        all += area;
    }
    mean_distances_.assign(order_.path_count() + 1, 0.0);
    for (std::size_t rank = areas.size(); rank-- > 0 && all > 0.0;) {
        mean_distances_[rank] =
            mean_distances_[rank + 1] + 0.25 * lengths[rank] * areas[rank] / all;
    }
}

void DetailPlanner::count(const Skeleton& skeleton, MeshOptions options) {
    options.texture_coordinates = false;
    options.tangents = false;
    options.colours = false;
    options.segments = false;
    if (!stop_) {
        stop_ = make_mesh(skeleton, user_meshes_, options, mesh_);
    }
}

std::uint64_t DetailPlanner::wood_triangles(const DetailLevel& level) {
    if (!level.is_thinned) {
        count(wood_, level.options);
        return triangles_of(mesh_);
    }
    Skeleton thin;
    thin_skeleton(wood_, order_, {.paths = level.paths, .foliage = 0}, {}, {}, thin, numbers_);
    count(thin, level.options);
    return triangles_of(mesh_);
}

double DetailPlanner::triangles_of_item(std::uint32_t item,
                                        const std::vector<FoliageShape>& shapes) const {
    const std::size_t objects = skeleton_.objects.size();
    return item < objects
               ? static_cast<double>(shapes[order_.group_of[item]].triangles)
               : triangles_per_ear_ *
                     static_cast<double>(skeleton_.polygons[item - objects].corner_count - 2);
}

double DetailPlanner::foliage_triangles(const DetailLevel& level) const {
    const std::vector<FoliageShape> shapes =
        foliage_shapes(order_, user_meshes_, level.options.level);
    double sum = 0.0;
    for (std::uint64_t rank = 0; rank < level.foliage; ++rank) {
        sum += triangles_of_item(order_.foliage[rank], shapes);
    }
    return sum;
}

void DetailPlanner::measure_polygons() {
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

std::uint64_t DetailPlanner::exact_triangles(const DetailLevel& level) {
    if (!level.is_thinned) {
        count(skeleton_, level.options);
    } else {
        Skeleton thin;
        thin_skeleton(skeleton_, order_, thinning_of(level), fine_,
                      foliage_shapes(order_, user_meshes_, level.options.level), thin, numbers_);
        count(thin, level.options);
    }
    return triangles_of(mesh_);
}

} // namespace lsys
