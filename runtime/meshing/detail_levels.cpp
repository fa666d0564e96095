// SPDX-License-Identifier: MIT
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
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace lsys {

namespace {

// Ratio of the triangles of a level to those of the next level: usual value, min and max.
constexpr double kUsualFactor = 2.45;
constexpr double kRootFactor = 1.5652; // square root of kUsualFactor
constexpr double kLowFactor = 2.0;
constexpr double kMaxFactor = 3.0;
constexpr double kSafeFactor = 1.04; // margin within both bounds, where possible
// Max ratio for boxes: a level with one step of subdivision less has a quarter of the triangles.
constexpr double kMaxFactorOfBoxes = 4.5;
constexpr std::uint32_t kMaxSideLevel = 8; // max increase of MeshOptions::level
constexpr int kMaxTries = 24;              // max steps of the search for a number of paths
constexpr double kEnoughTriangles = 0.96;  // fraction of the wanted triangles that suffices
constexpr int kFittingSteps = 12;          // max tries of fit_areas() and fit_impostor()
constexpr double kCloseAreas = 0.004;      // value of Planner::difference() that ends the fitting
constexpr double kAreaWeight = 0.1;        // weight of the covered area in Planner::difference()
constexpr double kMinScale = 0.2;          // min DetailLevel::wood_scale and foliage_scale
constexpr double kMaxScale = 6.0;
constexpr double kMaxStep = 1.8;   // max factor by which a scale changes from one try to the next
constexpr double kMaxExcess = 3.0; // max excess of an area relative to the wanted one
constexpr double kMinTint = 0.25;  // min component of DetailLevel::tint
constexpr double kMaxTint = 4.0;
constexpr float kMaxModerateTint = 1.6F; // beyond this tint all materials get one colour
constexpr double kCloseTint = 0.002;     // a tint nearer to 1 than this counts as 1
constexpr double kMinCover = 0.25;       // min DetailLevel::cover
constexpr double kMaxCover = 1.75;
constexpr double kFirstCover = 0.6;     // first try of DetailLevel::cover
constexpr double kCloseCover = 0.005;   // relative error of the area that ends the fitting of cover
constexpr double kLastTriangles = 45.0; // wanted triangles of the last level without impostors
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
constexpr double kCloseCount = 0.04; // accepted relative difference from the planned triangles
// A mesh is thinned to the max triangles of the next level if it has at most this multiple of it.
constexpr double kNearMax = 1.35;
constexpr int kMaxEqualSteps = 3; // max number of steps to the last level that get equal ratios
// Factors of the wanted number of triangles, tried one after the other.
constexpr std::array<double, 6> kTriangleFactors{1.0, 0.9, 1.1, 0.82, 1.18, 0.72};
constexpr int kRootSteps = 40;              // bisections in Planner::factor_from()
constexpr int kSeekSteps = 8;               // max bisections in Planner::seek()
constexpr int kMaxAxisErrorTries = 6;       // max tries of raise_axis_error_for_paths()
constexpr int kMaxAxisErrorRaises = 48;     // max steps of raise_axis_error()
constexpr float kAxisErrorRaise = 1.15F;    // factor of MeshOptions::axis_error per raise
constexpr int kMaxRestoringTries = 14;      // max tries of seek_joints()
constexpr std::uint64_t kMaxAddedPaths = 8; // by restore_triangle_count()
// Max triangles of levels to which restore_triangle_count() adds paths.
constexpr double kMaxTrianglesForPaths = 4000.0;
// kCloseCount of levels to which restore_triangle_count() has added paths.
constexpr double kFairCount = 0.1;
constexpr float kRestoringFactor = 1.3F; // factor of MeshOptions::axis_error per try
constexpr double kMeanErrorPart = 0.3;   // mean error of an axis / MeshOptions::axis_error
constexpr float kMaxDeviations = 4.0F;   // max MeshOptions::deviation / axis_error
constexpr double kMinMove = 1e-12; // min product of a step and its effect to update derivatives
// Max ratio of the radius of widened wood to DetailLevel::error: the wood is then two pixels wide.
constexpr float kMaxRadiusErrors = 2.0F;

std::uint64_t triangles_of(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (const MeshPart& part : mesh.parts) {
        count += part.index_count / 3;
    }
    return count;
}

Thinning thinning_of(const DetailLevel& level) {
    return {.paths = level.paths,
            .foliage = level.foliage,
            .max_radius = kMaxRadiusErrors * level.error,
            .wood_scale = level.wood_scale,
            .foliage_scale = level.foliage_scale};
}

/// Whether all vertices of each part have one colour.
bool has_plain_parts(const Mesh& mesh) {
    if (mesh.colours.empty()) {
        return true;
    }
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        const ItemColour own = mesh.colours[indices[part.first_index]];
        for (std::uint64_t i = 1; i < part.index_count; ++i) {
            if (mesh.colours[indices[part.first_index + i]] != own) {
                return false;
            }
        }
    }
    return true;
}

/// Gives the materials of `mesh` the colours of the level; they replace the colours of vertices.
void colour_materials(const DetailLevel& level, Mesh& mesh) {
    if ((level.tint == glm::vec3(1.0F) && !level.colour) || !has_plain_parts(mesh)) {
        return;
    }
    mesh.colours.clear();
    for (Material& material : mesh.materials) {
        const glm::vec3 own = level.colour.value_or(glm::vec3(material.colour));
        material.colour = glm::vec4(glm::min(level.tint * own, 1.0F), material.colour.a);
    }
}

/// Whether a tint changes the colours of materials little.
bool is_moderate(const glm::vec3& tint) {
    return std::max({tint.x, tint.y, tint.z}) < kMaxModerateTint &&
           std::min({tint.x, tint.y, tint.z}) > 1.0F / kMaxModerateTint;
}

/// Plans and fits the levels of one plant. After a failure stop_ is set and all steps do nothing.
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
        wood_.tube_shape = skeleton.tube_shape;
        wood_.looks = skeleton.looks;
        foliage_ = skeleton;
        foliage_.segments = {};
        foliage_.segment_origins = {};
        fine_ = foliage_shapes(order, user_meshes, options.level);
        measure_paths();
    }

    std::optional<Stop> plan(const DetailChain& chain, DetailLevels& result) {
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
            if (!level.is_impostor &&
                (!chain.pictures || level.triangles > kMaxTrianglesBeforeCards)) {
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

    /// Sets the scales, tints and colours of the levels marked in `which`.
    std::optional<Stop>
    fit(const DetailChain& chain, const std::vector<bool>& which, DetailLevels& levels) {
        if (finest_triangles_ == 0) {
            measure_finest();
        }
        draw(wood_, options_, mesh_);
        draw(foliage_, options_, foliage_mesh_);
        if (stop_) {
            return stop_;
        }
        meter_.emplace(mesh_, foliage_mesh_, frame_, options_.threads);
        areas_ = meter_->measure(mesh_, foliage_mesh_, &third_);
        // Begins with the coarsest level, because fitting a level needs the unfitted plan of the
        // next finer level.
        for (std::size_t k = levels.levels.size(); --k > 0 && !stop_;) {
            DetailLevel& level = levels.levels[k];
            if (!which[k]) {
                continue;
            }
            if (level.is_impostor) {
                fit_impostor(level);
                continue;
            }
            const VisibleAreas own = fit_areas(levels.levels[k - 1], level);
            if (chain.pictures) {
                level.tint = tint_for(own);
                if (!is_moderate(level.tint)) {
                    level.tint = glm::vec3(1.0F);
                    level.colour = glm::vec3(areas_.mean_colour());
                    level.tint = tint_for(areas_of(level));
                }
            }
        }
        return stop_;
    }

private:
    void measure_finest() {
        count(skeleton_, options_);
        finest_triangles_ = triangles_of(mesh_);
        for (const glm::vec3& position : mesh_.positions) {
            frame_.add(position);
        }
        const glm::vec3 extent = frame_.high - frame_.low;
        extent_ = std::max({extent.x, extent.y, extent.z});
        measure_polygons();
    }

    /// Sets mean_distances_[n] to an estimate of the mean distance in m from all wood to the wood
    /// of the first n paths. The estimated distance of the wood of an omitted path is a quarter of
    /// the length of this path.
    void measure_paths() {
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

    /// Makes mesh_ with only those arrays on which the number of triangles depends.
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
        if (!level.is_thinned) {
            count(wood_, level.options);
            return triangles_of(mesh_);
        }
        Skeleton thin;
        thin_skeleton(wood_, order_, {.paths = level.paths, .foliage = 0}, {}, {}, thin, numbers_);
        count(thin, level.options);
        return triangles_of(mesh_);
    }

    /// Estimated number of triangles of an object or polygon; too high for polygons with coinciding
    /// corners.
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

    /// Makes `mesh` with the arrays that visible areas depend on.
    void draw(const Skeleton& skeleton, MeshOptions options, Mesh& mesh) {
        options.texture_coordinates = true;
        options.tangents = false;
        options.colours = false;
        options.segments = false;
        if (!stop_) {
            stop_ = make_mesh(skeleton, user_meshes_, options, mesh);
        }
    }
    VisibleAreas areas_of(const DetailLevel& level, bool third = false) {
        if (!level.is_thinned) {
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
        if (stop_) {
            return {};
        }
        colour_materials(level, mesh_);
        colour_materials(level, foliage_mesh_);
        return third ? meter_->measure_third(mesh_, foliage_mesh_)
                     : meter_->measure(mesh_, foliage_mesh_);
    }

    /// Scales wood and foliage until both cover the same areas as at the finest level, by Broyden's
    /// method ("A class of methods for solving nonlinear simultaneous equations", 1965). Returns
    /// the covered areas. `finer`: the next finer level.
    VisibleAreas fit_areas(const DetailLevel& finer, DetailLevel& level) {
        const bool is_fixed = !level.is_thinned && (level.options.method != MeshMethod::Tubes ||
                                                    skeleton_.l3d_compatible_surface);
        const DetailLevel planned = level;
        DetailLevel tried = level;
        VisibleAreas result;
        glm::dvec2 scales(1.0);
        glm::dvec2 step(0.0);
        glm::dvec2 before(0.0);
        // Inverse Jacobian of the covered areas with respect to the scales. The first guess: the
        // area of wood is linear in its scale, the area of foliage quadratic.
        glm::dmat2 inverse(1.0, 0.0, 0.0, 0.5);
        double best = std::numeric_limits<double>::infinity();
        bool third = !is_fixed; // measures a third of the views until the areas are close
        for (int i = 0; i < kFittingSteps && !stop_; ++i) {
            third = third && i + 2 < kFittingSteps;
            tried.wood_scale = static_cast<float>(scales.x);
            tried.foliage_scale = static_cast<float>(scales.y);
            if (i > 0 && !is_fixed) {
                restore_triangle_count(planned, finer, tried);
            }
            const VisibleAreas now = areas_of(tried, third);
            const VisibleAreas& fine = third ? third_ : areas_;
            const double off = difference(now, fine);
            if (!third && off < best) {
                best = off;
                level = tried;
                level.triangles = triangles_of(mesh_) + triangles_of(foliage_mesh_);
                result = now;
            }
            if (off < kCloseAreas || is_fixed) {
                if (!third) {
                    break;
                }
                third = false;
                step = glm::dvec2(0.0);
                continue;
            }
            const glm::dvec2 error(excess(now.wood, fine.wood), excess(now.foliage, fine.foliage));
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
            if (step == glm::dvec2(0.0)) {
                if (!third) {
                    break;
                }
                third = false;
            }
            scales += step;
            tried.is_thinned = true;
        }
        return result;
    }
    /// Searches the axis_error at which `tried` has `wanted` triangles. If the difference of a try
    /// from `wanted` is below `min_difference`, stores the try in `best` and its difference in
    /// `min_difference`.
    void seek_joints(double wanted, double& min_difference, DetailLevel tried, DetailLevel& best) {
        float low = 0.0F; // an axis_error with too many triangles; `high`: with too few
        float high = std::numeric_limits<float>::infinity();
        float& error = tried.options.axis_error;
        for (int i = 0; i < kMaxRestoringTries && !stop_; ++i) {
            tried.triangles = exact_triangles(tried);
            const auto now = static_cast<double>(tried.triangles);
            const double off = std::abs(now - wanted);
            if (off < min_difference) {
                min_difference = off;
                best = tried;
            }
            if (off <= kCloseCount * wanted || !(error > 0.0F)) {
                return;
            }
            (now < wanted ? high : low) = error;
            const bool is_between = low > 0.0F && high < std::numeric_limits<float>::infinity();
            error = is_between   ? 0.5F * (low + high)
                    : low > 0.0F ? kRestoringFactor * error
                                 : error / kRestoringFactor;
        }
    }

    /// Changes a level with widened wood until it has about the planned number of triangles.
    /// Widened wood has fewer joints, because a thicker branch may deviate more. This function adds
    /// joints again; if that does not suffice, it adds paths and foliage, at most as many as the
    /// level `before` has.
    void restore_triangle_count(const DetailLevel& planned,
                                const DetailLevel& before,
                                DetailLevel& level) {
        level.options.axis_error = planned.options.axis_error;
        level.paths = planned.paths;
        level.foliage = planned.foliage;
        if (!level.is_thinned) {
            return;
        }
        const auto wanted = static_cast<double>(planned.triangles);
        // Branches of equal shape lose a joint at the same axis_error, so the number of triangles
        // jumps and may miss the wanted number. A few more paths bring it closer to the wanted
        // number.
        const std::uint64_t max_paths =
            std::min(before.paths, level.paths + std::min(level.paths, kMaxAddedPaths));
        double min_difference = std::numeric_limits<double>::infinity();
        DetailLevel tried = level;
        for (; tried.paths <= max_paths && !stop_; ++tried.paths) {
            tried.options.axis_error = planned.options.axis_error;
            seek_joints(wanted, min_difference, tried, level);
            if (min_difference <=
                    (tried.paths == planned.paths ? kCloseCount : kFairCount) * wanted ||
                wanted > kMaxTrianglesForPaths) {
                break;
            }
        }
        if (static_cast<double>(level.triangles) > (1.0 - kCloseCount) * wanted) {
            return;
        }
        for (std::uint64_t high = before.paths; level.paths < high && !stop_;) {
            tried = level;
            tried.paths = level.paths + (high - level.paths + 1) / 2;
            tried.triangles = exact_triangles(tried);
            if (static_cast<double>(tried.triangles) <= wanted) {
                level = tried;
            } else {
                high = tried.paths - 1;
            }
        }
        if (level.foliage == 0) {
            return;
        }
        const std::vector<FoliageShape> shapes =
            foliage_shapes(order_, user_meshes_, level.options.level);
        auto now = static_cast<double>(level.triangles);
        while (level.foliage < before.foliage) {
            now += triangles_of_item(order_.foliage[level.foliage], shapes);
            if (now > wanted) {
                break;
            }
            ++level.foliage;
        }
    }

    /// Gives the impostor the area and colour of the finest level.
    void fit_impostor(DetailLevel& level) {
        draw(skeleton_, options_, mesh_);
        if (stop_) {
            return;
        }
        const ImpostorBaker baker(mesh_, level.pixels, level.triangles);
        const Mesh none;
        VisibleAreas own;
        // The secant method. The first secant goes through cover 0, which has area 0.
        glm::dvec2 before(0.0);
        level.cover = kFirstCover;
        Mesh cards;
        for (int i = 0; i < kFittingSteps; ++i) {
            cards = baker.make(level.cover, glm::vec3(1.0F));
            own = meter_->measure(none, cards);
            const double off = own.all() - areas_.all();
            if (std::abs(off) <= kCloseCover * areas_.all() || own.all() == before.y) {
                break;
            }
            const double slope = (own.all() - before.y) / (level.cover - before.x);
            before = glm::dvec2(level.cover, own.all());
            const double next = std::clamp(level.cover - off / slope, kMinCover, kMaxCover);
            if (next == level.cover || i + 1 == kFittingSteps) {
                break;
            }
            level.cover = next;
        }
        level.triangles = triangles_of(cards);
        level.tint = tint_for(own);
    }
    /// The tint that changes the mean colour `now` to the mean colour of the finest level.
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
    /// Difference between two measurements: the difference of the fractions of wood, which decide
    /// the colour, plus, with less weight, the difference of the covered areas.
    static double difference(const VisibleAreas& now, const VisibleAreas& wanted) {
        const double all = std::max(wanted.all(), 1.0);
        return std::abs(now.wood / std::max(now.all(), 1.0) - wanted.wood / all) +
               kAreaWeight * std::abs(now.all() / all - 1.0);
    }
    static double excess(double area, double wanted) {
        return wanted > 0.0 ? std::min(area / wanted - 1.0, kMaxExcess) : 0.0;
    }

    /// The exact number of triangles of a level.
    std::uint64_t exact_triangles(const DetailLevel& level) {
        if (!level.is_thinned) {
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

    /// Sets the size on screen and the errors of a level that has about `triangles` triangles.
    void set_error(double triangles, DetailLevel& level) const {
        const auto part = static_cast<float>(
            std::sqrt(std::max(triangles, 1.0) / static_cast<double>(finest_triangles_)));
        level.pixels = kFinestPixels * part;
        level.error = 0.5F * extent_ / level.pixels;
        level.options.axis_error = level.error;
    }

    /// Whether an impostor looks more like the plant than `level`, because the level has a few
    /// enlarged leaves or lacks too many branches.
    bool looks_poor(const DetailLevel& level) const {
        return !order_.foliage.empty() ||
               mean_distances_[level.paths] > kPoorPixels * 2.0 * static_cast<double>(level.error);
    }

    /// The impostor that follows the level `before`.
    DetailLevel cards_after(const DetailLevel& before) const {
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

    /// Excess, as a factor minus 1, of the ratio of triangles between two consecutive levels over
    /// its bounds; 0 if the ratio is within the bounds. `safe`: factor by which the bounds are
    /// narrowed.
    static double
    ratio_excess(const DetailLevel& before, const DetailLevel& next, double safe = 1.0) {
        const double max_factor =
            before.options.method == MeshMethod::Boxes ? kMaxFactorOfBoxes : kMaxFactor;
        const double factor = static_cast<double>(before.triangles) /
                              std::max(static_cast<double>(next.triangles), 1.0);
        return std::max({safe * kLowFactor / factor, safe * factor / max_factor, 1.0}) - 1.0;
    }

    /// The ratio of triangles of consecutive levels with which equal steps lead from `triangles` to
    /// the last level.
    double factor_from(double triangles) const {
        const double all = triangles / last_triangles_;
        int steps = 1;
        double max_ratio = kMaxFactor; // max ratio that `steps` steps can reach
        double usual =
            kUsualFactor * kRootFactor; // for more, a step more is nearer to kUsualFactor
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

    /// The level that follows `before`: a mesh, not an impostor.
    DetailLevel coarser(const DetailLevel& before) {
        const auto all = static_cast<double>(before.triangles);
        const bool is_boxes = before.options.method == MeshMethod::Boxes;
        const double wanted = all / factor_from(all);
        const double min = kSafeFactor * all / (is_boxes ? kMaxFactorOfBoxes : kMaxFactor);
        const double max = std::max(all / (kSafeFactor * kLowFactor), wanted);
        DetailLevel base = before;
        base.options.deviation = before.is_thinned ? 0.0F : options_.deviation;
        set_error(wanted, base);
        base.options.axis_error = std::max(base.options.axis_error, before.options.axis_error);
        auto wood = static_cast<double>(wood_triangles(base));
        double foliage = foliage_triangles(base);
        const auto is_done = [&](DetailLevel& level) {
            level.triangles = exact_triangles(level);
            return ratio_excess(before, level) == 0.0;
        };
        if (wood + foliage < min) {
            // Without these joints the level has too few triangles: keep more joints, or keep all
            // joints and use fewer sides where branches are thin.
            const float error = base.options.axis_error;
            seek(&MeshOptions::axis_error, before.options.axis_error, error, min - foliage,
                 max - foliage, base);
            if (is_done(base)) {
                return base;
            }
            DetailLevel sides_by_radius = base;
            sides_by_radius.options.axis_error = before.options.axis_error;
            seek(&MeshOptions::deviation, 0.0F, kMaxDeviations * error, min - foliage,
                 max - foliage, sides_by_radius);
            if (is_done(sides_by_radius)) {
                return sides_by_radius;
            }
            wood = static_cast<double>(wood_triangles(base));
            // Both levels have too many triangles, because straight wood loses nearly all joints at
            // one axis_error. Continue with the level that has fewer triangles.
            const auto sides_by_radius_wood = static_cast<double>(wood_triangles(sides_by_radius));
            if (sides_by_radius_wood < wood) {
                base = sides_by_radius;
                wood = sides_by_radius_wood;
            }
        }
        // Fewer sides of all branches, unless this alone leaves too few triangles.
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
            base = level;
            wood = level_wood;
            foliage = level_foliage;
            if (triangles <= max && is_done(base)) {
                return base;
            }
        }
        if (base.options.deviation == 0.0F && before.options.method == MeshMethod::Tubes) {
            // Fewer sides where branches are thin.
            DetailLevel sides_by_radius = base;
            seek(&MeshOptions::deviation, 0.0F, kMaxDeviations * base.error, min - foliage,
                 max - foliage, sides_by_radius);
            if (is_done(sides_by_radius)) {
                return sides_by_radius;
            }
        }
        if (before.options.method != MeshMethod::Tubes) {
            // Tubes have far fewer triangles than boxes, so their sides and joints come first.
            DetailLevel tubes = before;
            tubes.options.level = options_.level;
            make_plain(tubes.options);
            return coarser(tubes);
        }
        // Items of foliage and branches differ in size, so several wanted numbers of triangles are
        // tried. The first level within the bounds is taken, else the level nearest to them. If
        // only a little has to be left out, the first wanted number is the max.
        const double aim = wood + foliage <= kNearMax * max ? max : wanted;
        DetailLevel best = before;
        double min_difference = std::numeric_limits<double>::infinity();
        for (const bool fewer_sides : {false, true}) {
            for (const double part : kTriangleFactors) {
                DetailLevel level = base;
                level.options.level += fewer_sides ? 1 : 0;
                level = thinner(level, wood, foliage, part * aim);
                level.triangles = exact_triangles(level);
                const double off = ratio_excess(before, level, kSafeFactor);
                if (off < min_difference) {
                    min_difference = off;
                    best = level;
                }
                if (stop_ || min_difference == 0.0) {
                    return best;
                }
            }
        }
        return best;
    }

    /// Bisects an option between `low` and `high` until the wood has `min` to `max` triangles.
    /// Larger values of the option leave fewer triangles. If no value fits, the wood has more than
    /// `max` triangles.
    void seek(float MeshOptions::*option,
              float low,
              float high,
              double min,
              double max,
              DetailLevel& level) {
        for (int i = 0; i < kSeekSteps && !stop_; ++i) {
            level.options.*option = 0.5F * (low + high);
            const auto now = static_cast<double>(wood_triangles(level));
            if (now >= min && now <= max) {
                return;
            }
            (now < min ? high : low) = level.options.*option;
        }
        level.options.*option = low;
    }

    /// Changes `options` to tubes without bark noise, grooves, smooth joints and deviation.
    static void make_plain(MeshOptions& options) {
        options.method = MeshMethod::Tubes;
        options.bark_noise = 0.0F;
        options.grooves = 0.0F;
        options.smooth_joints = false;
        options.deviation = 0.0F;
    }

    /// Leaves out paths and foliage until about `wanted` triangles are left, in the proportion of
    /// the triangles `wood` and `foliage`.
    DetailLevel thinner(DetailLevel level, double wood, double foliage, double wanted) {
        level.is_thinned = true;
        most_paths_ = level.paths;
        const float deviation = level.options.deviation;
        make_plain(level.options);
        level.options.deviation = deviation > options_.deviation ? deviation : 0.0F;
        const double part = wanted / std::max(wood + foliage, 1.0);
        double left = 0.0;
        if (level.foliage > 0) {
            const std::vector<FoliageShape> shapes =
                foliage_shapes(order_, user_meshes_, level.options.level);
            std::uint64_t rank = 0;
            for (; rank < level.foliage; ++rank) {
                const double more = triangles_of_item(order_.foliage[rank], shapes);
                if (rank > 0 && left + 0.5 * more > part * foliage) {
                    break;
                }
                left += more;
            }
            level.foliage = rank;
        }
        if (level.paths > 0) {
            thin_paths(level, std::max(wanted - left, 0.0));
            raise_axis_error_for_paths(level, std::max(wanted - left, 0.0));
        }
        return level;
    }

    /// Leaves out more joints, so that more paths can stay, as long as this lowers the mean
    /// distance of the drawn wood from the plant's wood.
    void raise_axis_error_for_paths(DetailLevel& level, double wanted) {
        const auto cost = [this](const DetailLevel& candidate) {
            return mean_distances_[candidate.paths] +
                   kMeanErrorPart * static_cast<double>(candidate.options.axis_error);
        };
        DetailLevel tried = level;
        for (int i = 0; i < kMaxAxisErrorTries && !stop_ &&
                        mean_distances_[level.paths] >
                            kMeanErrorPart * static_cast<double>(tried.options.axis_error);
             ++i) {
            tried.options.axis_error *= 2.0F;
            tried.paths = most_paths_;
            thin_paths(tried, wanted);
            if (cost(tried) < cost(level)) {
                level = tried;
            }
        }
    }

    /// Sets the number of paths to the largest number, at least one, that has at most `wanted`
    /// triangles.
    void thin_paths(DetailLevel& level, double wanted) {
        std::uint64_t high = level.paths;
        std::uint64_t high_count = wood_triangles(level);
        if (static_cast<double>(high_count) <= wanted) {
            return;
        }
        std::uint64_t low = 0;
        std::uint64_t low_count = 0;
        for (int i = 0; i < kMaxTries && high - low > 1 && !stop_; ++i) {
            // Alternates linear interpolation and bisection.
            const double slope = (wanted - static_cast<double>(low_count)) /
                                 static_cast<double>(high_count - low_count);
            const auto step = static_cast<std::uint64_t>((i % 2 == 0 ? slope : 0.5) *
                                                         static_cast<double>(high - low));
            level.paths = low + std::clamp<std::uint64_t>(step, 1, high - low - 1);
            const std::uint64_t now = wood_triangles(level);
            if (static_cast<double>(now) <= wanted) {
                low = level.paths;
                low_count = now;
                if (static_cast<double>(now) >= kEnoughTriangles * wanted) {
                    return;
                }
            } else {
                high = level.paths;
                high_count = std::max(now, low_count + 1);
            }
        }
        if (low == 0) {
            level.paths = 1;
            raise_axis_error(level, wanted);
            return;
        }
        // Take the number of paths for which triangles / `wanted` is nearer to 1.
        const bool is_high =
            static_cast<double>(low_count) * static_cast<double>(high_count) < wanted * wanted;
        level.paths = is_high ? high : low;
    }

    /// Raises axis_error until the wood has at most `wanted` triangles.
    void raise_axis_error(DetailLevel& level, double wanted) {
        auto now = static_cast<double>(wood_triangles(level));
        for (int i = 0; i < kMaxAxisErrorRaises && now > wanted && !stop_; ++i) {
            if (level.options.axis_error > extent_) {
                break;
            }
            level.options.axis_error *= kAxisErrorRaise;
            now = static_cast<double>(wood_triangles(level));
        }
    }

    const Skeleton& skeleton_;
    const std::vector<UserMesh>& user_meshes_;
    const ThinningOrder& order_;
    MeshOptions options_;
    Skeleton wood_;                      // the skeleton with segments only
    Skeleton foliage_;                   // the skeleton without segments
    Mesh foliage_mesh_;                  // foliage drawn last; memory to reuse
    std::vector<FoliageShape> fine_;     // shapes of foliage at the finest level
    Mesh mesh_;                          // mesh that count() or draw() made last
    LargeVector<std::uint32_t> numbers_; // argument `segments` of thin_skeleton(), not used
    std::vector<double> mean_distances_; // m, by number of paths, see measure_paths()
    std::uint64_t most_paths_ = 0;       // number of paths of the level before thinner() changes it
    std::optional<AreaMeter> meter_;
    VisibleAreas areas_;                 // areas of the finest level
    VisibleAreas third_;                 // AreaMeter::measure_third() of the finest level
    Bounds frame_;                       // bounds of the finest level
    std::uint64_t finest_triangles_ = 0; // triangles of the finest level
    double last_triangles_ = 1.0;        // wanted triangles of the last level of the chain
    double triangles_per_ear_ = 1.0; // mean over polygons; a polygon of n corners has n - 2 ears
    float extent_ = 0.0F;            // m, longest edge of frame_
    std::optional<Stop> stop_;
};

/// Makes the impostor of a pose, with the arrays that `options` request.
std::optional<Stop> make_impostor(const Skeleton& skeleton,
                                  const std::vector<UserMesh>& user_meshes,
                                  const MeshOptions& options,
                                  const DetailLevel& level,
                                  Mesh& mesh) {
    MeshOptions bake_options = options;
    bake_options.texture_coordinates = true;
    bake_options.tangents = false;
    bake_options.colours = true;
    bake_options.segments = false;
    if (const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, bake_options, mesh)) {
        return stop;
    }
    return catch_out_of_memory(
        [&]() -> std::optional<Stop> {
            mesh = ImpostorBaker(mesh, level.pixels, level.triangles).make(level.cover, level.tint);
            if (!options.tangents) {
                mesh.tangents.clear();
            }
            if (options.colours) {
                mesh.colours.resize(mesh.positions.size());
                std::fill(mesh.colours.begin(), mesh.colours.end(), ItemColour{0});
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

/// Keeps `count` levels, at least 2: the first, the last, and the levels nearest to equal steps
/// between these two.
void spread_levels(std::size_t count, std::vector<DetailLevel>& levels) {
    if (levels.size() <= count) {
        return;
    }
    const std::size_t steps = count - 1;
    for (std::size_t k = 1; k < count; ++k) {
        levels[k] = levels[(2 * k * (levels.size() - 1) + steps) / (2 * steps)];
    }
    levels.resize(count);
}

/// Whether `which` marks a level other than the finest.
bool fits_any(const std::vector<bool>& which) {
    return which.size() > 1 && std::find(which.begin() + 1, which.end(), true) != which.end();
}

} // namespace

std::optional<Stop> plan_detail_levels(const Skeleton& skeleton,
                                       const std::vector<UserMesh>& user_meshes,
                                       const MeshOptions& options,
                                       const DetailChain& chain,
                                       DetailLevels& levels) {
    levels = {};
    if (chain.last == 0 || chain.count <= 1 || options.method == MeshMethod::Solid) {
        levels.levels.push_back({.options = options});
        return std::nullopt;
    }
    return catch_out_of_memory(
        [&] {
            const auto order = std::make_shared<const ThinningOrder>(thinning_order(skeleton));
            levels.order = order;
            Planner planner(skeleton, user_meshes, options, *order);
            if (const std::optional<Stop> stop = planner.plan(chain, levels)) {
                return std::optional(*stop);
            }
            spread_levels(chain.count, levels.levels);
            const std::size_t last = levels.levels.size() - 1;
            std::vector<bool> fitted_levels(levels.levels.size());
            for (std::size_t k = 0; k <= last && chain.first_fitted != kNoDetailLevel; ++k) {
                fitted_levels[k] = k >= std::min<std::size_t>(chain.first_fitted, last);
            }
            return fits_any(fitted_levels) ? planner.fit(chain, fitted_levels, levels)
                                           : std::nullopt;
        },
        [&] {
            levels = {};
            return Stop::OutOfMemory;
        });
}

std::optional<Stop> fit_detail_levels(const Skeleton& skeleton,
                                      const std::vector<UserMesh>& user_meshes,
                                      const MeshOptions& options,
                                      const DetailChain& chain,
                                      const std::vector<bool>& which,
                                      DetailLevels& levels) {
    if (!fits_any(which)) {
        return std::nullopt;
    }
    return catch_out_of_memory(
        [&] {
            return Planner(skeleton, user_meshes, options, *levels.order).fit(chain, which, levels);
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
    if (level.is_impostor) {
        return make_impostor(skeleton, user_meshes, all, level, mesh);
    }
    if (!level.is_thinned) {
        const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, all, mesh);
        colour_materials(level, mesh);
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
            colour_materials(level, mesh);
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
