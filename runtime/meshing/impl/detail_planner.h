// SPDX-License-Identifier: MIT
// Plans and fits the chain of meshes of a plant (detail_levels.h).
#pragma once

#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/impl/thinning.h"
#include "runtime/meshing/impl/visible_areas.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

inline constexpr double kLowFactor = 2.0; // min ratio of the triangles of a level to the next level
inline constexpr double kMaxFactor = 3.0; // max ratio
// Max ratio with MeshMethod::Boxes: one step of subdivision less leaves a quarter of the triangles.
inline constexpr double kMaxFactorOfBoxes = 4.5;

[[nodiscard]] std::uint64_t triangles_of(const Mesh& mesh);
[[nodiscard]] Thinning thinning_of(const DetailLevel& level);
/// Gives the materials of `mesh` the colours of the level; they replace the colours of vertices.
void colour_materials(const DetailLevel& level, Mesh& mesh);

/// Plans and fits the levels of one plant. After a failure stop_ is set and all steps do nothing.
class DetailPlanner {
public:
    DetailPlanner(const Skeleton& skeleton,
                  const std::vector<UserMesh>& user_meshes,
                  const MeshOptions& options,
                  const ThinningOrder& order);

    std::optional<Stop> plan(const DetailChain& chain, DetailLevels& result);

    /// Sets the scales, tints and colours of the levels marked in `which`.
    std::optional<Stop>
    fit(const DetailChain& chain, const std::vector<bool>& which, DetailLevels& levels);

private:
    void measure_finest();

    /// Sets mean_distances_[n] to an estimate of the mean distance in m from all wood to the wood
    /// of the first n paths. The estimated distance of the wood of an omitted path is a quarter of
    /// the length of this path.
    void measure_paths();

    /// Makes mesh_ with only those arrays on which the number of triangles depends.
    void count(const Skeleton& skeleton, MeshOptions options);

    std::uint64_t wood_triangles(const DetailLevel& level);

    /// Estimated number of triangles of an object or polygon; too high for polygons with coinciding
    /// corners.
    double triangles_of_item(std::uint32_t item, const std::vector<FoliageShape>& shapes) const;
    double foliage_triangles(const DetailLevel& level) const;
    void measure_polygons();

    /// Makes `mesh` with the arrays that visible areas depend on.
    void draw(const Skeleton& skeleton, MeshOptions options, Mesh& mesh);
    VisibleAreas areas_of(const DetailLevel& level, bool third = false);

    /// Scales wood and foliage until both cover the same areas as at the finest level, by Broyden's
    /// method ("A class of methods for solving nonlinear simultaneous equations", 1965). Returns
    /// the covered areas. `finer`: the next finer level.
    VisibleAreas fit_areas(const DetailLevel& finer, DetailLevel& level);
    /// Searches the axis_error at which `tried` has `wanted` triangles. If the difference of a try
    /// from `wanted` is below `min_difference`, stores the try in `best` and its difference in
    /// `min_difference`.
    void seek_joints(double wanted, double& min_difference, DetailLevel tried, DetailLevel& best);

    /// Changes a level with widened wood until it has about the planned number of triangles.
    /// Widened wood has fewer joints, because a thicker branch may deviate more. This function adds
    /// joints again; if that does not suffice, it adds paths and foliage, at most as many as the
    /// level `before` has.
    void restore_triangle_count(const DetailLevel& planned,
                                const DetailLevel& before,
                                DetailLevel& level);

    /// Gives the impostor the area and colour of the finest level.
    void fit_impostor(DetailLevel& level);
    /// The tint that changes the mean colour `now` to the mean colour of the finest level.
    glm::vec3 tint_for(const VisibleAreas& now) const;
    /// Difference between two measurements: the difference of the fractions of wood, which decide
    /// the colour, plus, with less weight, the difference of the covered areas.
    static double difference(const VisibleAreas& now, const VisibleAreas& wanted);
    static double excess(double area, double wanted);

    /// The exact number of triangles of a level.
    std::uint64_t exact_triangles(const DetailLevel& level);

    /// Sets the size on screen and the errors of a level that has about `triangles` triangles.
    void set_error(double triangles, DetailLevel& level) const;

    /// Whether an impostor looks more like the plant than `level`, because the level has a few
    /// enlarged leaves or lacks too many branches.
    bool looks_poor(const DetailLevel& level) const;

    /// The impostor that follows the level `before`.
    DetailLevel cards_after(const DetailLevel& before) const;

    /// Excess, as a factor minus 1, of the ratio of triangles between two consecutive levels over
    /// its bounds; 0 if the ratio is within the bounds. `safe`: factor by which the bounds are
    /// narrowed.
    static double
    ratio_excess(const DetailLevel& before, const DetailLevel& next, double safe = 1.0);

    /// The ratio of triangles of consecutive levels with which equal steps lead from `triangles` to
    /// the last level.
    double factor_from(double triangles) const;

    /// The level that follows `before`: a mesh, not an impostor.
    DetailLevel coarser(const DetailLevel& before);

    /// Bisects an option between `low` and `high` until the wood has `min` to `max` triangles.
    /// Larger values of the option leave fewer triangles. If no value fits, the wood has more than
    /// `max` triangles.
    void seek(float MeshOptions::*option,
              float low,
              float high,
              double min,
              double max,
              DetailLevel& level);

    /// Changes `options` to tubes without bark noise, grooves, smooth joints and deviation.
    static void make_plain(MeshOptions& options);

    /// Leaves out paths and foliage until about `wanted` triangles are left, in the proportion of
    /// the triangles `wood` and `foliage`.
    DetailLevel thinner(DetailLevel level, double wood, double foliage, double wanted);

    /// Leaves out more joints, so that more paths can stay, as long as this lowers the mean
    /// distance of the drawn wood from the plant's wood.
    void raise_axis_error_for_paths(DetailLevel& level, double wanted);

    /// Lowers the number of paths until the wood has about `wanted` triangles. If a single path has
    /// more, keeps it and calls raise_axis_error().
    void thin_paths(DetailLevel& level, double wanted);

    /// Raises axis_error until the wood has at most `wanted` triangles.
    void raise_axis_error(DetailLevel& level, double wanted);

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

} // namespace lsys
