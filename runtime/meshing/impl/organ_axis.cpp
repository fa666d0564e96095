// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/organ_axis.h"

#include "runtime/base/exact_functions.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr double kTurnPerStep = std::numbers::pi / 18.0; // 10 degrees
constexpr std::uint32_t kMaxSteps = 24;
constexpr std::uint32_t kRadiusSteps = 12; // min steps where the radius follows a curve

/// Hermite curve from one point to the next.
struct HermiteCurve {
    glm::dvec3 from{};
    glm::dvec3 chord{};
    glm::dvec3 slope_from{}; // derivative at t = 0
    glm::dvec3 slope_to{};   // derivative at t = 1

    [[nodiscard]] glm::dvec3 point(double t) const {
        const glm::dvec3 square = 3.0 * chord - 2.0 * slope_from - slope_to;
        const glm::dvec3 cube = -2.0 * chord + slope_from + slope_to;
        return from + t * (slope_from + t * (square + t * cube));
    }
    [[nodiscard]] glm::dvec3 slope(double t) const {
        const glm::dvec3 square = 3.0 * chord - 2.0 * slope_from - slope_to;
        const glm::dvec3 cube = -2.0 * chord + slope_from + slope_to;
        return slope_from + t * (2.0 * square + 3.0 * t * cube);
    }
};

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return exact_atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// `v`, across the unit vector `from`, turned by the shortest rotation from `from` to `to`.
glm::dvec3 transported(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) {
    const double cosine = glm::dot(from, to);
    if (cosine < -1.0 + 1e-12) {
        return v; // half a turn about v itself
    }
    const glm::dvec3 turned = v - glm::dot(v, to) / (1.0 + cosine) * (from + to);
    // Removes rounding errors: across `to`, and of unit length.
    return glm::normalize(turned - glm::dot(turned, to) * to);
}

AxisStation station_of(const OrganPoint& point, double part) {
    const glm::dquat frame(point.frame);
    AxisStation station;
    station.position = glm::dvec3(point.position);
    station.heading = glm::normalize(frame * glm::dvec3(0.0, 1.0, 0.0));
    station.right = glm::normalize(frame * glm::dvec3(1.0, 0.0, 0.0));
    station.up = glm::normalize(frame * glm::dvec3(0.0, 0.0, 1.0));
    station.width = static_cast<double>(point.width);
    station.part = part;
    return station;
}

/// The radius between two points over the fraction of the way: a cubic Hermite curve as in cpfg.
class RadiusCurve {
public:
    RadiusCurve(const OrganPoint& a, const OrganPoint& b, double chord) {
        from_ = 0.5 * static_cast<double>(a.width);
        rise_ = 0.5 * static_cast<double>(b.width) - from_;
        const double scale = b.radii.per_chord ? chord : 1.0;
        is_even_ = !read(a.radii.part_after, a.radii.radius_after, scale, begin_);
        is_even_ = !read(b.radii.part_before, b.radii.radius_before, scale, end_) && is_even_;
    }
    [[nodiscard]] bool is_even() const { return is_even_; }
    /// Fraction of the way in x, radius (m) in y.
    [[nodiscard]] glm::dvec2 at(double t) const {
        const glm::dvec2 whole(1.0, rise_);
        const glm::dvec2 square = 3.0 * whole - 2.0 * begin_ - end_;
        const glm::dvec2 cube = begin_ + end_ - 2.0 * whole;
        return glm::dvec2(0.0, from_) + t * (begin_ + t * (square + t * cube));
    }

private:
    /// Returns false for a tangent (0, 0); `tangent` is then that of a straight line.
    bool read(float part, float radius, double scale, glm::dvec2& tangent) const {
        const bool is_given = part != 0.0F || radius != 0.0F;
        tangent = is_given ? glm::dvec2(part, static_cast<double>(radius) * scale)
                           : glm::dvec2(1.0, rise_);
        return is_given;
    }

    double from_ = 0.0; // radius at the first point, m
    double rise_ = 0.0;
    glm::dvec2 begin_{};
    glm::dvec2 end_{};
    bool is_even_ = true;
};

/// Number of steps for a bend by `turn` and a roll by `roll`, in radians.
std::uint32_t step_count(double turn, double roll, std::uint32_t level, std::uint32_t min_steps) {
    // Angles of rounding errors need no step.
    const double steps = std::ceil((turn + std::abs(roll)) / kTurnPerStep - 1e-6);
    const auto wanted = static_cast<std::uint32_t>(std::clamp(steps, 1.0, double{kMaxSteps}));
    const std::uint32_t fine = std::max(wanted, min_steps);
    return std::max(1U, level < 32 ? fine >> level : 0U);
}

} // namespace

std::vector<AxisStation> stations_between(const OrganPoint& a,
                                          const OrganPoint& b,
                                          std::uint32_t level,
                                          std::uint32_t min_steps) {
    const AxisStation begin = station_of(a, 0.0);
    const AxisStation end = station_of(b, 1.0);
    HermiteCurve curve;
    curve.from = begin.position;
    curve.chord = end.position - begin.position;
    const double length = glm::length(curve.chord);
    curve.slope_from = length * static_cast<double>(a.tangent_after) * begin.heading;
    curve.slope_to = length * static_cast<double>(b.tangent_before) * end.heading;
    const double turn =
        angle_between(begin.heading, curve.chord) + angle_between(curve.chord, end.heading);
    // The remaining roll depends on the number of steps only through rounding errors and the shape
    // of the curve, so the roll for a single step, a rough value, decides that number.
    const glm::dvec3 rough = transported(begin.right, begin.heading, end.heading);
    const double rough_roll = exact_atan2(glm::dot(end.right, glm::cross(rough, end.heading)),
                                          glm::dot(end.right, rough));
    const RadiusCurve radii(a, b, length);
    const std::uint32_t steps = step_count(turn, rough_roll, level,
                                           std::max(min_steps, radii.is_even() ? 1 : kRadiusSteps));
    std::vector<AxisStation> stations{begin};
    for (std::uint32_t i = 1; i <= steps; ++i) {
        const AxisStation& before = stations.back();
        AxisStation station;
        const double even = static_cast<double>(i) / steps;
        const glm::dvec2 curved = radii.at(even);
        station.part = radii.is_even() ? even : curved.x;
        station.position = curve.point(station.part);
        const glm::dvec3 slope = curve.slope(station.part);
        const double speed = glm::length(slope);
        station.heading = i == steps              ? end.heading
                          : speed > 1e-9 * length ? slope / speed
                                                  : before.heading;
        station.right = transported(before.right, before.heading, station.heading);
        station.up = glm::cross(station.right, station.heading);
        station.width = radii.is_even() ? begin.width + station.part * (end.width - begin.width)
                                        : std::max(0.0, 2.0 * curved.y);
        stations.push_back(station);
    }
    const AxisStation& last = stations.back();
    const double roll = exact_atan2(glm::dot(end.right, last.up), glm::dot(end.right, last.right));
    for (AxisStation& station : stations) {
        const ExactSineCosine turned = exact_sine_cosine(station.part * roll);
        const glm::dvec3 right = station.right;
        station.right = turned.cosine * right + turned.sine * station.up;
        station.up = turned.cosine * station.up - turned.sine * right;
    }
    stations.back() = end; // without rounding errors, so that neighbouring stretches share a ring
    return stations;
}

} // namespace lsys
