// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/detail_planner.h"
#include "runtime/meshing/impl/impostor.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr int kFittingSteps = 12;     // max tries of fit_areas() and fit_impostor()
constexpr double kCloseAreas = 0.004; // value of DetailPlanner::difference() that ends the fitting
constexpr double kAreaWeight = 0.1;   // weight of the covered area in DetailPlanner::difference()
constexpr double kMinScale = 0.2;     // min DetailLevel::wood_scale and foliage_scale
constexpr double kMaxScale = 6.0;
constexpr double kMaxStep = 1.8;   // max factor by which a scale changes from one try to the next
constexpr double kMaxExcess = 3.0; // max excess of an area relative to the wanted one
constexpr double kMinTint = 0.25;  // min component of DetailLevel::tint
constexpr double kMaxTint = 4.0;
constexpr float kMaxModerateTint = 1.6F; // beyond this tint all materials get one colour
constexpr double kCloseTint = 0.002;     // a tint nearer to 1 than this counts as 1
constexpr double kMinCover = 0.25;       // min DetailLevel::cover
constexpr double kMaxCover = 1.75;
constexpr double kFirstCover = 0.6;    // first try of DetailLevel::cover
constexpr double kCloseCover = 0.005;  // relative error of the area that ends the fitting of cover
constexpr double kCloseCount = 0.04;   // accepted relative difference from the planned triangles
constexpr int kMaxRestoringTries = 14; // max tries of seek_joints()
constexpr std::uint64_t kMaxAddedPaths = 8; // by restore_triangle_count()
// Max triangles of levels to which restore_triangle_count() adds paths.
constexpr double kMaxTrianglesForPaths = 4000.0;
// As kCloseCount, for levels to which restore_triangle_count() has added paths.
constexpr double kFairCount = 0.1;
constexpr float kRestoringFactor = 1.3F; // factor of MeshOptions::axis_error per try
constexpr double kMinMove = 1e-12; // derivatives are not updated if step * effect is below this

/// Whether a tint changes the colours of materials little.
bool is_moderate(const glm::vec3& tint) {
    return std::max({tint.x, tint.y, tint.z}) < kMaxModerateTint &&
           std::min({tint.x, tint.y, tint.z}) > 1.0F / kMaxModerateTint;
}

} // namespace

std::optional<Stop>
DetailPlanner::fit(const DetailChain& chain, const std::vector<bool>& which, DetailLevels& levels) {
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

void DetailPlanner::draw(const Skeleton& skeleton, MeshOptions options, Mesh& mesh) {
    options.texture_coordinates = true;
    options.tangents = false;
    options.colours = false;
    options.segments = false;
    if (!stop_) {
        stop_ = make_mesh(skeleton, user_meshes_, options, mesh);
    }
}

VisibleAreas DetailPlanner::areas_of(const DetailLevel& level, bool third) {
    if (!level.is_thinned) {
        draw(wood_, level.options, mesh_);
        draw(foliage_, level.options, foliage_mesh_);
    } else {
        Skeleton thin;
        thin_skeleton(skeleton_, order_, thinning_of(level), fine_,
                      foliage_shapes(order_, user_meshes_, level.options.level), thin, numbers_);
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

VisibleAreas DetailPlanner::fit_areas(const DetailLevel& finer, DetailLevel& level) {
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

void DetailPlanner::seek_joints(double wanted,
                                double& min_difference,
                                DetailLevel tried,
                                DetailLevel& best) {
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

void DetailPlanner::restore_triangle_count(const DetailLevel& planned,
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
        if (min_difference <= (tried.paths == planned.paths ? kCloseCount : kFairCount) * wanted ||
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

void DetailPlanner::fit_impostor(DetailLevel& level) {
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

glm::vec3 DetailPlanner::tint_for(const VisibleAreas& now) const {
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

double DetailPlanner::difference(const VisibleAreas& now, const VisibleAreas& wanted) {
    const double all = std::max(wanted.all(), 1.0);
    return std::abs(now.wood / std::max(now.all(), 1.0) - wanted.wood / all) +
           kAreaWeight * std::abs(now.all() / all - 1.0);
}

double DetailPlanner::excess(double area, double wanted) {
    return wanted > 0.0 ? std::min(area / wanted - 1.0, kMaxExcess) : 0.0;
}

} // namespace lsys
