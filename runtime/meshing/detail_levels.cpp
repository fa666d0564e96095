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
#include <optional>
#include <vector>

namespace lsys {

namespace {

// Triangles of a level in those of the next one.
constexpr double kUsualFactor = 2.45;
constexpr double kRootFactor = 1.5652; // its square root
constexpr double kLowFactor = 2.0;
constexpr double kLeastFactor = 1.8; // where fewer joints alone would go beyond kMaxFactor
constexpr double kMaxFactor = 3.0;
constexpr double kMaxFactorOfBoxes = 4.5; // a step of their subdivision has a quarter
constexpr std::uint32_t kMaxSideLevel = 8;
constexpr int kMaxTries = 24;
constexpr double kEnough = 0.96; // of the wanted triangles end the search for a number of paths
constexpr int kFittingSteps = 12;
constexpr double kCloseAreas = 0.004; // ends the fitting of areas: part of wood, and a part of all
constexpr double kAreaWeight = 0.1;
constexpr double kMinScale = 0.2; // of what is fitted
constexpr double kMaxScale = 6.0;
constexpr double kMaxStep = 1.8;   // factor of a scale from one try to the next
constexpr double kMaxExcess = 3.0; // of an area, as a part of the wanted one
constexpr double kMinTint = 0.25;
constexpr double kMaxTint = 4.0;
constexpr float kMaxModerate = 1.6F; // beyond it, all materials get one colour
constexpr double kCloseTint = 0.002; // is left as it is
constexpr double kMinCover = 0.25;   // of impostors
constexpr double kMaxCover = 1.75;
constexpr double kFirstCover = 0.6;
constexpr double kCloseCover = 0.005;   // ends the fitting of the area of an impostor
constexpr double kLastTriangles = 45.0; // aimed at, of chains without an impostor
constexpr double kPoorFactor = 1.5;     // of a step that leaves out more
// Triangles of most impostors, at least, and of the level before them, at most.
constexpr std::uint64_t kLeastOfImpostor = 18;
constexpr std::uint64_t kMaxBeforeImpostor = 16 * kLeastOfImpostor / 5;
constexpr int kMaxEqualSteps = 3; // near the end of the chain
constexpr int kRootSteps = 40;
constexpr int kSeekSteps = 8;
constexpr int kStraighterTries = 6;
constexpr double kMeanErrorPart = 0.3; // of the error allowed to axes, on average
constexpr float kMinErrorPart = 0.1F;
constexpr float kMaxDeviations = 4.0F;   // of sides, in errors of joints
constexpr double kMinMove = 1e-12;       // of a step that teaches derivatives
constexpr float kMaxRadiusErrors = 2.0F; // radius of widened wood in errors: it is two pixels wide

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
        const std::uint16_t own = mesh.colours[indices[part.first_index]];
        for (std::uint64_t i = 1; i < part.index_count; ++i) {
            if (mesh.colours[indices[part.first_index + i]] != own) {
                return false;
            }
        }
    }
    return true;
}

/// Gives materials the colours of a level, which then replace those of vertices.
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

/// Whether a tint leaves materials about as they are.
bool is_moderate(const glm::vec3& tint) {
    return std::max({tint.x, tint.y, tint.z}) < kMaxModerate &&
           std::min({tint.x, tint.y, tint.z}) > 1.0F / kMaxModerate;
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
        measure_paths();
    }

    std::optional<Stop> plan(const DetailChain& chain, DetailLevels& result) {
        DetailLevel level{
            .options = options_, .paths = order_.path_count(), .foliage = order_.foliage.size()};
        measure_finest();
        level.triangles = finest_;
        result.levels.push_back(level);
        last_ = chain.pictures ? static_cast<double>(kLeastOfImpostor) : kLastTriangles;
        const std::uint64_t end = chain.pictures ? kMaxBeforeImpostor : kMinDetailTriangles;
        while (result.levels.size() <= chain.last && level.triangles > end && !stop_) {
            const DetailLevel next = coarser(level);
            if (next.triangles >= level.triangles) {
                break;
            }
            level = next;
            result.levels.push_back(level);
        }
        if (chain.pictures && result.levels.size() <= chain.last &&
            level.triangles > kImpostorTriangles) {
            DetailLevel& impostor = result.levels.emplace_back();
            impostor = {.options = options_, .impostor = true};
            impostor.triangles = kImpostorTriangles;
            set_error(static_cast<double>(impostor.triangles), impostor);
            impostor.options = options_; // its pictures show the finest level
        }
        return stop_;
    }

    /// Fits the marked levels to the finest one.
    std::optional<Stop>
    fit(const DetailChain& chain, const std::vector<bool>& which, DetailLevels& levels) {
        if (finest_ == 0) {
            measure_finest();
        }
        draw(wood_, options_, mesh_);
        draw(foliage_, options_, foliage_mesh_);
        if (stop_) {
            return stop_;
        }
        meter_.emplace(mesh_, foliage_mesh_, frame_, options_.threads);
        areas_ = meter_->measure(mesh_, foliage_mesh_);
        for (std::size_t k = 1; k < levels.levels.size() && !stop_; ++k) {
            DetailLevel& level = levels.levels[k];
            if (!which[k]) {
                continue;
            }
            if (level.impostor) {
                fit_impostor(level);
                continue;
            }
            const VisibleAreas own = fit_areas(level);
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
        finest_ = triangles_of(mesh_);
        for (const glm::vec3& position : mesh_.positions) {
            frame_.add(position);
        }
        const glm::vec3 extent = frame_.high - frame_.low;
        extent_ = std::max({extent.x, extent.y, extent.z});
        measure_polygons();
    }

    /// Sets the loss of each number of paths: how far wood that is left out lies from its parent, on
    /// average over all wood, each path reaching away by a quarter of its length.
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
        losses_.assign(order_.path_count() + 1, 0.0);
        for (std::size_t rank = areas.size(); rank-- > 0 && all > 0.0;) {
            losses_[rank] = losses_[rank + 1] + 0.25 * lengths[rank] * areas[rank] / all;
        }
    }

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
        if (stop_) {
            return {};
        }
        colour_materials(level, mesh_);
        colour_materials(level, foliage_mesh_);
        return meter_->measure(mesh_, foliage_mesh_);
    }

    /// Scales wood and foliage until they cover what they cover at the finest level, by Broyden's
    /// method ("A class of methods for solving nonlinear simultaneous equations", 1965). Returns
    /// what they cover then.
    VisibleAreas fit_areas(DetailLevel& level) {
        const bool is_fixed = !level.thinned && (level.options.method != MeshMethod::Tubes ||
                                                 skeleton_.l3d_compatible_surface);
        DetailLevel tried = level;
        VisibleAreas result;
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
                level.triangles = triangles_of(mesh_) + triangles_of(foliage_mesh_);
                result = now;
            }
            if (off < kCloseAreas || is_fixed) {
                break;
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
        return result;
    }
    /// Gives the impostor the area and colour of the finest level.
    void fit_impostor(DetailLevel& level) {
        draw(skeleton_, options_, mesh_);
        if (stop_) {
            return;
        }
        const ImpostorBaker baker(mesh_, level.pixels);
        const Mesh none;
        VisibleAreas own;
        // By the secant through the cover before; at first through no cover, which has no area.
        glm::dvec2 before(0.0);
        level.cover = kFirstCover;
        for (int i = 0; i < kFittingSteps; ++i) {
            const Mesh cards = baker.make(level.cover, glm::vec3(1.0F));
            level.triangles = triangles_of(cards);
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
        level.tint = tint_for(own);
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
        const auto part =
            static_cast<float>(std::sqrt(std::max(triangles, 1.0) / static_cast<double>(finest_)));
        level.pixels = kFinestPixels * part;
        level.error = 0.5F * extent_ / level.pixels;
        level.options.axis_error = level.error;
    }

    /// The factor from a level to the next that leads to the last triangles in equal steps.
    double factor_from(double triangles) const {
        const double all = triangles / last_;
        int steps = 1;
        double most = kMaxFactor; // that so many steps can be
        double usual =
            kUsualFactor * kRootFactor; // above it, one step more is nearer to kUsualFactor
        while (most < all || usual < all) {
            ++steps;
            most *= kMaxFactor;
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

    DetailLevel coarser(const DetailLevel& before) {
        const auto all = static_cast<double>(before.triangles);
        const bool is_boxes = before.options.method == MeshMethod::Boxes;
        const double wanted = all / factor_from(all);
        const double min = all / (is_boxes ? kMaxFactorOfBoxes : kMaxFactor);
        const double max = std::max(all / kLowFactor, wanted);
        DetailLevel base = before;
        base.options.deviation = before.thinned ? 0.0F : options_.deviation;
        set_error(wanted, base);
        base.options.axis_error = std::max(base.options.axis_error, before.options.axis_error);
        auto wood = static_cast<double>(wood_triangles(base));
        double foliage = foliage_triangles(base);
        if (wood + foliage < min) {
            // Fewer joints alone leave too little: keep more of them, or all and fewer sides where
            // branches are thin.
            const float error = base.options.axis_error;
            seek(&MeshOptions::axis_error, before.options.axis_error, error, min - foliage,
                 max - foliage, base);
            wood = static_cast<double>(wood_triangles(base));
            if (wood + foliage < min) {
                base.options.axis_error = before.options.axis_error;
                seek(&MeshOptions::deviation, 0.0F, kMaxDeviations * error, min - foliage,
                     max - foliage, base);
                wood = static_cast<double>(wood_triangles(base));
            }
            if (wood + foliage >= min && wood + foliage <= all / kLeastFactor) {
                base.triangles = exact_triangles(base);
                return base;
            }
        }
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
            base = level;
            wood = level_wood;
            foliage = level_foliage;
            if (triangles <= max) {
                base.triangles = exact_triangles(base);
                return base;
            }
        }
        if (before.options.method != MeshMethod::Tubes) {
            // Tubes have far fewer triangles than boxes, so their sides and joints come first.
            DetailLevel tubes = before;
            tubes.options.level = options_.level;
            make_plain(tubes.options);
            return coarser(tubes);
        }
        DetailLevel level = thinner(base, wood, foliage, wanted);
        level.triangles = exact_triangles(level);
        // Items of foliage differ: those that are left may be the large ones.
        while (static_cast<double>(level.triangles) * kPoorFactor > all && level.foliage > 1) {
            level.foliage -= 1 + level.foliage / 8;
            level.triangles = exact_triangles(level);
        }
        if (static_cast<double>(level.triangles) * kPoorFactor > all) {
            ++level.options.level;
            level.triangles = exact_triangles(level);
        }
        if (static_cast<double>(level.triangles) < min) {
            const double rest = static_cast<double>(level.triangles - wood_triangles(level));
            seek(&MeshOptions::axis_error, kMinErrorPart * level.error, level.options.axis_error,
                 min - rest, max - rest, level);
            level.triangles = exact_triangles(level);
        }
        return level;
    }

    /// Sets an option that leaves the less wood the larger it is, between `low` and `high`, so that
    /// wood has `min` to `max` triangles.
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
    }

    /// Tubes without the detail of their bark.
    static void make_plain(MeshOptions& options) {
        options.method = MeshMethod::Tubes;
        options.bark_noise = 0.0F;
        options.grooves = 0.0F;
        options.smooth_joints = false;
        options.deviation = 0.0F;
    }

    /// Leaves out paths and foliage until about `wanted` triangles are left, in the proportion of
    /// `wood` and `foliage`.
    DetailLevel thinner(DetailLevel level, double wood, double foliage, double wanted) {
        level.thinned = true;
        most_paths_ = level.paths;
        make_plain(level.options);
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
            straighten_for_paths(level, std::max(wanted - left, 0.0));
        }
        return level;
    }

    /// Takes more joints from branches as long as the branches kept instead are worth it.
    void straighten_for_paths(DetailLevel& level, double wanted) {
        const auto cost = [this](const DetailLevel& of) {
            return losses_[of.paths] + kMeanErrorPart * static_cast<double>(of.options.axis_error);
        };
        DetailLevel tried = level;
        for (int i = 0;
             i < kStraighterTries && !stop_ &&
             losses_[level.paths] > kMeanErrorPart * static_cast<double>(tried.options.axis_error);
             ++i) {
            tried.options.axis_error *= 2.0F;
            tried.paths = most_paths_;
            thin_paths(tried, wanted);
            if (cost(tried) < cost(level)) {
                level = tried;
            }
        }
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
        // Of the numbers of paths around, the one nearer to `wanted` in proportion.
        const bool is_high =
            static_cast<double>(low_count) * static_cast<double>(high_count) < wanted * wanted;
        level.paths = is_high ? high : std::max<std::uint64_t>(low, 1);
        if (low == 0 && !is_high) {
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
    std::vector<double> losses_;   // in m, by number of paths
    std::uint64_t most_paths_ = 0; // of the level that is thinned
    std::optional<AreaMeter> meter_;
    VisibleAreas areas_; // of the finest level
    Bounds frame_;
    std::uint64_t finest_ = 0;       // triangles
    double last_ = 1.0;              // triangles at the end of the chain
    double triangles_per_ear_ = 1.0; // of polygons, which have corners - 2 ears
    float extent_ = 0.0F;
    std::optional<Stop> stop_;
};

/// The impostor of a pose, with the arrays that are asked for.
std::optional<Stop> make_impostor(const Skeleton& skeleton,
                                  const std::vector<UserMesh>& user_meshes,
                                  const MeshOptions& options,
                                  const DetailLevel& level,
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
            mesh = ImpostorBaker(mesh, level.pixels).make(level.cover, level.tint);
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

/// Whether a level other than the finest is marked.
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
    if (chain.last == 0 || options.method == MeshMethod::Solid) {
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
            const std::size_t last = levels.levels.size() - 1;
            std::vector<bool> which(levels.levels.size());
            for (std::size_t k = 0; k <= last && chain.first_fitted != kNoDetailLevel; ++k) {
                which[k] = k >= std::min<std::size_t>(chain.first_fitted, last);
            }
            return fits_any(which) ? planner.fit(chain, which, levels) : std::nullopt;
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
    if (level.impostor) {
        return make_impostor(skeleton, user_meshes, all, level, mesh);
    }
    if (!level.thinned) {
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
