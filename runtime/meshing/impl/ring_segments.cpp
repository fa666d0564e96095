// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/ring_segments.h"

#include "grammar/base/contract.h"
#include "runtime/base/workers.h"
#include "runtime/meshing/impl/axes.h"
#include "runtime/meshing/impl/axis_reader.h"
#include "runtime/meshing/impl/joint_curves.h"
#include "runtime/meshing/impl/tube_writer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace lsys {

namespace {

// Max number of joints between the bases of two consecutive segments: the two edges of a collar may
// each be cut for noise into at most sixteen pieces. find_places() multiplies it by the number of
// parts into which smooth joints, flares and wide collars first cut an edge.
constexpr std::size_t kMaxBetween = 32;
constexpr std::uint32_t kUnknown = kNoSegment;

/// Squared distance of a point from a segment's axis.
double squared_distance(const glm::vec3& point, const Segment& segment) {
    const glm::dvec3 from(segment.base);
    const glm::dvec3 way = glm::dvec3(tip(segment)) - from;
    const glm::dvec3 off = glm::dvec3(point) - from;
    const double square = glm::dot(way, way);
    const double part = square > 0.0 ? std::clamp(glm::dot(off, way) / square, 0.0, 1.0) : 0.0;
    const glm::dvec3 rest = off - part * way;
    return glm::dot(rest, rest);
}

/// A run with copies of its joints.
struct OwnRun {
    Run run;
    std::vector<Joint> joints;

    bool read(AxisReader& reader) {
        if (!reader.next(run)) {
            return false;
        }
        joints.assign(run.joints.begin(), run.joints.end());
        return true;
    }
};

class RingSegments {
public:
    RingSegments(const Skeleton& skeleton,
                 const MeshOptions& options,
                 std::span<VertexSegments> segments)
        : skeleton_(skeleton), options_(options), segments_(segments), workers_(options.threads),
          axes_(find_axes(skeleton, workers_)) {}

    void fill_all() {
        AxisReader reader(skeleton_, axes_, options_);
        OwnRun own;
        OwnRun next;
        for (std::uint32_t i = 0; i < skeleton_.segments.size(); ++i) {
            if (!begins_axis(axes_, skeleton_.segments[i], i)) {
                continue;
            }
            reader.start(i);
            bool more = own.read(reader);
            while (more) {
                more = next.read(reader);
                // A run ends before the next run, or at the end of the axis.
                read_chain(own.run.first_segment, more ? next.run.first_segment : kNoSegment);
                find_places(own.joints);
                write_run(own);
                std::swap(own, next);
            }
        }
        LSYS_CHECK(vertex_ == segments_.size(), vertex_, segments_.size());
    }

private:
    /// Sets chain_ to the segments from `first` on along the axis, up to `end`.
    void read_chain(std::uint32_t first, std::uint32_t end) {
        chain_.clear();
        for (std::uint32_t at = first; at < kForked && at != end; at = axes_.next[at]) {
            chain_.push_back(at);
        }
    }

    /// Finds the segment of each joint of a run. Joints and segments are in the same order; a joint
    /// lies exactly at the base of its segment, except joints that were inserted between two
    /// segments.
    void find_places(const std::vector<Joint>& joints) {
        const std::size_t last = joints.size() - 1;
        places_.assign(joints.size(), kUnknown);
        places_[0] = 0;
        const TubeShape& shape = skeleton_.tube_shape;
        const bool widens = shape.has_flare() || shape.collar > 0.0F;
        const std::size_t max_between = kMaxBetween * (widens ? kFlareParts + 1 : 1) *
                                        (options_.smooth_joints ? kMaxCurveParts : 1);
        std::size_t known = 0;
        std::uint32_t end = 0;
        for (std::uint32_t k = 1; k < chain_.size() && known + 1 < last; ++k) {
            const glm::vec3& base = skeleton_.segments[chain_[k]].base;
            const std::size_t stop = std::min(last, known + 2 + max_between);
            for (std::size_t j = known + 1; j < stop; ++j) {
                if (joints[j].centre == base) {
                    places_[j] = k;
                    known = j;
                    end = k;
                    break;
                }
            }
        }
        for (std::uint32_t k = end; k < chain_.size(); ++k) {
            if (tip(skeleton_.segments[chain_[k]]) == joints[last].centre) {
                end = k;
                break;
            }
        }
        segments_of_.assign(joints.size(), {chain_[0], chain_[0]});
        std::uint32_t before = 0;
        for (std::size_t j = 1; j < last; ++j) {
            if (places_[j] != kUnknown) {
                before = places_[j];
                segments_of_[j] = {chain_[drawn_before(before)], chain_[before]};
                continue;
            }
            std::size_t next_known = j + 1;
            while (next_known < last && places_[next_known] == kUnknown) {
                ++next_known;
            }
            const std::uint32_t after = next_known < last ? places_[next_known] : end + 1;
            const std::uint32_t nearest = find_nearest(joints[j].centre, before, after);
            segments_of_[j] = {chain_[nearest], chain_[nearest]};
        }
        segments_of_[last] = {chain_[end], chain_[end]};
    }

    /// The last segment before `place` whose length is not 0.
    [[nodiscard]] std::uint32_t drawn_before(std::uint32_t place) const {
        std::uint32_t before = place - 1;
        while (before > 0 && !(skeleton_.segments[chain_[before]].length > 0.0F)) {
            --before;
        }
        return before;
    }

    [[nodiscard]] std::uint32_t
    find_nearest(const glm::vec3& point, std::uint32_t first, std::uint32_t end) const {
        double min_distance = std::numeric_limits<double>::max();
        std::uint32_t nearest = first;
        for (std::uint32_t k = first; k < end; ++k) {
            const double away = squared_distance(point, skeleton_.segments[chain_[k]]);
            if (away < min_distance) {
                min_distance = away;
                nearest = k;
            }
        }
        return nearest;
    }

    void put(std::uint64_t count, const VertexSegments& segments) {
        LSYS_CHECK(count <= segments_.size() - vertex_, count, vertex_, segments_.size());
        std::fill_n(segments_.begin() + static_cast<std::ptrdiff_t>(vertex_), count, segments);
        vertex_ += count;
    }

    /// Writes the segments of the vertices of a run, in the order in which TubeWriter writes
    /// vertices.
    void write_run(const OwnRun& own) {
        const std::vector<Joint>& joints = own.joints;
        const std::size_t last = joints.size() - 1;
        put(own.run.begin == TubeEnd::Flat ? 1 : 0, segments_of_[0]);
        put(columns_of(joints[0].sides, options_), segments_of_[0]);
        for (std::size_t i = 1; i <= last; ++i) {
            const VertexSegments& at = segments_of_[i];
            const std::uint64_t columns = columns_of(joints[i].sides, options_);
            const bool bends = joints[i].rings > 1;
            if (bends) {
                put(columns, {at[0], at[0]});
                put((joints[i].rings - 2U) * columns, at);
                put(columns, {at[1], at[1]});
            } else {
                put(columns, at);
            }
            if (joints[i].colour != joints[i - 1].colour) { // duplicates the last ring
                put(columns, bends ? VertexSegments{at[1], at[1]} : at);
            }
        }
        const std::uint64_t columns = columns_of(joints[last].sides, options_);
        put(own.run.end == TubeEnd::Point ? 0 : closing_rings(own.run.end) * columns + 1,
            segments_of_[last]);
    }

    const Skeleton& skeleton_;
    const MeshOptions& options_;
    std::span<VertexSegments> segments_;
    Workers workers_;
    Axes axes_;
    std::vector<std::uint32_t> chain_;        // segments of the run, and undrawn ones after it
    std::vector<std::uint32_t> places_;       // by joint: index in chain_
    std::vector<VertexSegments> segments_of_; // by joint: segments of the edges beside it
    std::uint64_t vertex_ = 0;                // the next vertex whose segments are written
};

} // namespace

void fill_ring_segments(const Skeleton& skeleton,
                        const MeshOptions& options,
                        std::span<VertexSegments> segments) {
    RingSegments(skeleton, options, segments).fill_all();
}

} // namespace lsys
