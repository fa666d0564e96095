// SPDX-License-Identifier: MIT
// Open polygons: polygons after their `{` and before their `}`. Brackets neither save nor end them.
// A polygon may begin within another; the corners of all open polygons are on one stack.
#pragma once

#include "runtime/derive/origin.h"
#include "runtime/turtle/impl/pose.h"

#include <glm/geometric.hpp>

#include <span>
#include <vector>

namespace lsys {

struct OpenPolygon {
    std::size_t first_vertex = 0;            // index in OpenPolygons::vertices_
    std::size_t first_on_path = 0;           // index in OpenPolygons::path_
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F}; // frame of the turtle at its `{`
    Origin origin;                           // origin of its `{`
    std::uint64_t position = 0;              // index of its `{` in the word
    Code code = 0;                           // code of its `{`
    std::uint32_t picture = kNoPicture;
};

class OpenPolygons {
public:
    /// `corners_are_ends`: see TurtleTraits.
    explicit OpenPolygons(bool corners_are_ends) : corners_are_ends_(corners_are_ends) {}

    [[nodiscard]] bool any() const { return !open_.empty(); }
    /// The polygon begun last. Precondition of top(), vertex(), corners() and close(): any().
    [[nodiscard]] const OpenPolygon& top() const { return open_.back(); }
    /// All open polygons, in the order in which they were begun.
    [[nodiscard]] std::span<const OpenPolygon> all() const { return open_; }
    /// Begins a polygon; sets its first_vertex and first_on_path.
    void open(OpenPolygon polygon) {
        polygon.first_vertex = vertices_.size();
        polygon.first_on_path = path_.size();
        open_.push_back(polygon);
    }
    /// Adds the vertex that a `.` places.
    void vertex(const Pose& pose) {
        if (corners_are_ends_) {
            add_to_path(position_of(pose));
        } else {
            vertices_.push_back(position_of(pose));
        }
    }
    /// Adds the start of a step to the path of the open polygon, if there is one.
    void begin_step(const Pose& pose) {
        if (!open_.empty() && !corners_are_ends_) {
            add_to_path(position_of(pose));
        }
    }
    /// Adds the end of a step to the path of the open polygon, if there is one.
    void end_step(const Pose& pose) {
        if (!open_.empty()) {
            add_to_path(position_of(pose));
        }
    }
    /// Corners of the polygon begun last: its vertices or, if it has none, the ends of its steps.
    /// Valid until the next change.
    [[nodiscard]] std::span<const glm::vec3> corners();
    /// Ends the polygon begun last, and drops its corners.
    void close() {
        vertices_.resize(open_.back().first_vertex);
        path_.resize(open_.back().first_on_path);
        open_.pop_back();
    }

private:
    void add_to_path(const glm::vec3& point) {
        if (path_.size() == open_.back().first_on_path || path_.back() != point) {
            path_.push_back(point);
        }
    }

    bool corners_are_ends_ = false;
    std::vector<OpenPolygon> open_;   // the innermost last
    std::vector<glm::vec3> vertices_; // of the open polygons, in the order of `open_`
    std::vector<glm::vec3> path_;     // ends of steps, without repetitions
};

inline std::span<const glm::vec3> OpenPolygons::corners() {
    const OpenPolygon& polygon = open_.back();
    if (vertices_.size() > polygon.first_vertex) {
        return std::span(vertices_).subspan(polygon.first_vertex);
    }
    std::span<const glm::vec3> path = std::span(path_).subspan(polygon.first_on_path);
    if (path.size() > 2) { // drop the last point if it equals the first up to rounding
        constexpr float kClosed = 1e-5F;
        const float gap = glm::distance(path.front(), path.back());
        if (gap <= kClosed * glm::distance(path[0], path[1])) {
            path = path.first(path.size() - 1);
        }
    }
    return path;
}

} // namespace lsys
