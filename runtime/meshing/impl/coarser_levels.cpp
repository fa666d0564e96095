// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/detail_planner.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lsys {

namespace {

constexpr double kSafeFactor = 1.04;       // narrows the bounds of triangle counts, where possible
constexpr std::uint32_t kMaxSideLevel = 8; // max increase of MeshOptions::level
constexpr int kMaxTries = 24;              // max steps of the search for a number of paths
constexpr double kEnoughTriangles = 0.96;  // fraction of the wanted triangles that suffices
// A mesh of at most this multiple of the max triangles of the next level is thinned to that max.
constexpr double kNearMax = 1.35;
// Factors of the wanted number of triangles, tried one after the other.
constexpr std::array<double, 6> kTriangleFactors{1.0, 0.9, 1.1, 0.82, 1.18, 0.72};
constexpr int kSeekSteps = 8;            // max bisections in DetailPlanner::seek()
constexpr int kMaxAxisErrorTries = 6;    // max tries of raise_axis_error_for_paths()
constexpr int kMaxAxisErrorRaises = 48;  // max steps of raise_axis_error()
constexpr float kAxisErrorRaise = 1.15F; // factor of MeshOptions::axis_error per raise
constexpr double kMeanErrorPart = 0.3;   // mean error of an axis / MeshOptions::axis_error
constexpr float kMaxDeviations = 4.0F;   // max MeshOptions::deviation / axis_error

} // namespace

DetailLevel DetailPlanner::coarser(const DetailLevel& before) {
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
        // axis_error leaves out so many joints that the level has too few triangles: keep more
        // joints, or keep all joints and use fewer sides where branches are thin.
        const float error = base.options.axis_error;
        seek(&MeshOptions::axis_error, before.options.axis_error, error, min - foliage,
             max - foliage, base);
        if (is_done(base)) {
            return base;
        }
        DetailLevel sides_by_radius = base;
        sides_by_radius.options.axis_error = before.options.axis_error;
        seek(&MeshOptions::deviation, 0.0F, kMaxDeviations * error, min - foliage, max - foliage,
             sides_by_radius);
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

void DetailPlanner::seek(
    float MeshOptions::*option, float low, float high, double min, double max, DetailLevel& level) {
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

void DetailPlanner::make_plain(MeshOptions& options) {
    options.method = MeshMethod::Tubes;
    options.bark_noise = 0.0F;
    options.grooves = 0.0F;
    options.smooth_joints = false;
    options.deviation = 0.0F;
}

DetailLevel DetailPlanner::thinner(DetailLevel level, double wood, double foliage, double wanted) {
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

void DetailPlanner::raise_axis_error_for_paths(DetailLevel& level, double wanted) {
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

void DetailPlanner::thin_paths(DetailLevel& level, double wanted) {
    std::uint64_t high = level.paths;
    std::uint64_t high_count = wood_triangles(level);
    if (static_cast<double>(high_count) <= wanted) {
        return;
    }
    std::uint64_t low = 0;
    std::uint64_t low_count = 0;
    for (int i = 0; i < kMaxTries && high - low > 1 && !stop_; ++i) {
        // Alternates linear interpolation and bisection.
        const double slope =
            (wanted - static_cast<double>(low_count)) / static_cast<double>(high_count - low_count);
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

void DetailPlanner::raise_axis_error(DetailLevel& level, double wanted) {
    auto now = static_cast<double>(wood_triangles(level));
    for (int i = 0; i < kMaxAxisErrorRaises && now > wanted && !stop_; ++i) {
        if (level.options.axis_error > extent_) {
            break;
        }
        level.options.axis_error *= kAxisErrorRaise;
        now = static_cast<double>(wood_triangles(level));
    }
}

} // namespace lsys
