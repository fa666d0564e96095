// SPDX-License-Identifier: MIT
// Open polygons of a SensingTurtle, in binary64. The turtle that draws has the same class in
// binary32, in polygons.h.
#pragma once

#include "runtime/turtle/impl/sensing_pose.h"

#include <cstddef>
#include <span>
#include <vector>

namespace lsys {

class SensingPolygons {
public:
    /// `corners_are_ends`: see TurtleTraits.
    explicit SensingPolygons(bool corners_are_ends) : corners_are_ends_(corners_are_ends) {}

    [[nodiscard]] bool any() const { return !open_.empty(); }
    void open() { open_.push_back({vertices_.size(), path_.size()}); }
    /// Adds the vertex that a `.` places.
    void vertex(const SensingVector& place) {
        if (open_.empty()) {
            return;
        }
        if (corners_are_ends_) {
            add_to_path(place);
        } else {
            vertices_.push_back(place);
        }
    }
    void begin_step(const SensingVector& place) {
        if (!open_.empty() && !corners_are_ends_) {
            add_to_path(place);
        }
    }
    void end_step(const SensingVector& place) {
        if (!open_.empty()) {
            add_to_path(place);
        }
    }
    /// Corners of the polygon begun last. Precondition: any(). Valid until the next change.
    [[nodiscard]] std::span<const SensingVector> corners() const;
    /// Precondition: any().
    void close() {
        vertices_.resize(open_.back().first_vertex);
        path_.resize(open_.back().first_on_path);
        open_.pop_back();
    }

private:
    struct Open {
        std::size_t first_vertex = 0;  // index in `vertices_`
        std::size_t first_on_path = 0; // index in `path_`
    };

    void add_to_path(const SensingVector& place) {
        if (path_.size() == open_.back().first_on_path || path_.back() != place) {
            path_.push_back(place);
        }
    }

    bool corners_are_ends_ = false;
    std::vector<Open> open_;              // the innermost last
    std::vector<SensingVector> vertices_; // of the open polygons, in the order of `open_`
    std::vector<SensingVector> path_;     // ends of steps, without repetitions
};

inline std::span<const SensingVector> SensingPolygons::corners() const {
    const Open& polygon = open_.back();
    if (vertices_.size() > polygon.first_vertex) {
        return std::span(vertices_).subspan(polygon.first_vertex);
    }
    std::span<const SensingVector> path = std::span(path_).subspan(polygon.first_on_path);
    const auto distance = [](const SensingVector& a, const SensingVector& b) {
        return length_of({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
    };
    constexpr double kClosed = 1e-5; // max distance of equal ends / length of first step
    if (path.size() > 2 &&
        distance(path.front(), path.back()) <= kClosed * distance(path[0], path[1])) {
        path = path.first(path.size() - 1);
    }
    return path;
}

/// Half the length of Newell's vector (Sutherland, Sproull & Schumacker 1974).
[[nodiscard]] inline double area_of(std::span<const SensingVector> corners) {
    SensingVector normal{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const SensingVector& a = corners[i];
        const SensingVector& b = corners[i + 1 < corners.size() ? i + 1 : 0];
        normal[0] += (a[1] - b[1]) * (a[2] + b[2]);
        normal[1] += (a[2] - b[2]) * (a[0] + b[0]);
        normal[2] += (a[0] - b[0]) * (a[1] + b[1]);
    }
    return 0.5 * length_of(normal);
}

[[nodiscard]] inline SensingVector mean_of(std::span<const SensingVector> corners) {
    SensingVector sum{};
    for (const SensingVector& corner : corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            sum[i] += corner[i];
        }
    }
    const auto count = static_cast<double>(corners.size());
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

} // namespace lsys
