// SPDX-License-Identifier: MIT
// Linear buckling of spring-joint plants. Let w be the absolute rotation of a body and w_p that of
// its parent. The second derivative of the energy at rest is the sum of k |w - w_p|^2 for the
// joints (k: spring constant) and of w . G w for the weight, which has no coupling between bodies
// (see impl/joints.cpp). G is -m g y about the level axes, where m is the mass of the body and its
// descendants, and y the height of their centre above the base of the body: a load to the side
// bends a plant but never makes it buckle, a load above can. Elimination from the tips to the root,
// P = k + G + sum of R of the children, R = k - k P^-1 k, tests whether the sum is positive
// definite: it is if every P is positive definite (Sylvester). Bisection over the multiple of the
// weight finds the factor.
#include "runtime/physics/stability.h"

#include "runtime/physics/impl/bodies.h"
#include "runtime/physics/impl/symmetric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lsys {

namespace {

constexpr double kGreenhill = 7.837347; // (9/4) j^2, j the first zero of the Bessel function J_-1/3
constexpr int kHalvings = 60;
constexpr double kMaxFactor = 1e9;
constexpr std::uint32_t kRounds = 400; // max rounds of settle() per trial

/// Whether the plant, in its pose at rest, does not buckle under `gravity`. `added`: memory to
/// reuse; by body, the sum of R of its children.
bool is_stable(const Bodies& plant, double gravity, bool own_load, std::vector<Symmetric>& added) {
    const std::size_t count = plant.bodies.size();
    added.assign(count, Symmetric{});
    for (std::size_t b = count; b-- > 0;) {
        const Body& body = plant.bodies[b];
        const glm::dvec3 arm = own_load ? body.mass * body.centre : body.moment;
        Symmetric sum = added[b];
        sum.xx -= arm.y * gravity;
        sum.zz -= arm.y * gravity;
        const Symmetric without_spring = sum;
        sum.add_diagonal(body.spring);
        if (sum.trace() <= 0.0 || !is_positive(sum)) {
            if (sum.trace() == 0.0 && body.spring == 0.0 && body.mass == 0.0) {
                continue; // neither mass nor load nor spring
            }
            return false;
        }
        if (body.parent != kNoSegment && !own_load) {
            // k - k P^-1 k = k P^-1 (P - k), where k is the spring and P is `sum`.
            const Rows inverted = rows_of(inverse(sum));
            added[body.parent] +=
                scaled(symmetric_product(inverted, rows_of(without_spring)), body.spring);
        }
    }
    return true;
}

/// Measures the trunk: the segments of bracket order 0 of the first plant.
void measure_trunk(const Skeleton& rest, double gravity, Stability& out) {
    double bending = 0.0; // integral of E I over the length
    double mass = 0.0;
    double widths = 0.0;
    std::vector<bool> is_trunk(rest.segments.size(), false);
    for (std::size_t i = 0; i < rest.segments.size(); ++i) {
        const Segment& segment = rest.segments[i];
        is_trunk[i] = segment.order == 0 &&
                      (segment.parent == kNoSegment ? i == 0 : is_trunk[segment.parent]);
        if (!is_trunk[i]) {
            continue;
        }
        const auto length = static_cast<double>(segment.length);
        bending += static_cast<double>(segment.spring) * length * length;
        mass += static_cast<double>(segment.mass);
        widths += length * static_cast<double>(segment.base_radius + segment.tip_radius);
        out.trunk_length += length;
    }
    const double length = out.trunk_length;
    if (!(length > 0.0)) {
        return;
    }
    out.trunk_width = widths / length;
    const double factor = kGreenhill * bending / (mass * gravity * length * length * length);
    if (mass > 0.0 && gravity > 0.0 && std::isfinite(factor)) {
        out.trunk_factor = factor;
    }
}

} // namespace

Stability stability_of(const Skeleton& rest, const PhysicsOptions& options) {
    const Bodies plant =
        make_bodies(rest, static_cast<double>(std::max(options.surface_mass, 0.0F)));
    const auto gravity = static_cast<double>(options.gravity);
    const bool own_load = options.load == LoadRule::Own;
    Stability out;
    if (!own_load) {
        measure_trunk(rest, gravity, out);
    }
    std::vector<Symmetric> work;
    const auto stands = [&](double factor) {
        return is_stable(plant, factor * gravity, own_load, work);
    };
    if (!(gravity > 0.0) || stands(kMaxFactor)) {
        out.load_factor = std::numeric_limits<double>::infinity();
        return out;
    }
    double low = 1e-12; // bounds of the factor, bisected on a logarithmic scale
    double high = kMaxFactor;
    if (!stands(low)) {
        return out;
    }
    for (int i = 0; i < kHalvings && high / low > 1.0 + 1e-12; ++i) {
        const double middle = std::sqrt(low * high);
        (stands(middle) ? low : high) = middle;
    }
    out.load_factor = low;
    return out;
}

double bent_height(const Skeleton& rest, const PhysicsOptions& options, std::uint32_t max_rounds) {
    if (rest.segments.empty()) {
        return 1.0;
    }
    const auto ground = static_cast<double>(rest.segments[0].base.y);
    const double height = static_cast<double>(measure(rest).bounds.high.y) - ground;
    if (!(height > 0.0)) {
        return 1.0;
    }
    PlantPhysics physics(rest, options);
    static_cast<void>(physics.settle(1e-5, max_rounds));
    Skeleton bent;
    physics.pose(bent);
    return (static_cast<double>(measure(bent).bounds.high.y) - ground) / height;
}

Skeleton stiffened(const Skeleton& rest, Stiffening way, double factor) {
    constexpr auto kMax = static_cast<double>(std::numeric_limits<float>::max());
    const bool widens = way == Stiffening::Widths;
    const double square = widens ? factor * factor : 1.0;
    const double spring_factor = widens ? square * square : factor;
    const auto times = [kMax](float value, double by) {
        return static_cast<float>(std::min(static_cast<double>(value) * by, kMax));
    };
    Skeleton out = rest;
    for (Segment& segment : out.segments) {
        segment.spring = times(segment.spring, spring_factor);
        segment.mass = times(segment.mass, square);
        if (widens) {
            segment.base_radius = times(segment.base_radius, factor);
            segment.tip_radius = times(segment.tip_radius, factor);
        }
    }
    return out;
}

std::optional<double>
standing_factor(const Skeleton& rest, const PhysicsOptions& options, Stiffening way) {
    const auto stands = [&](double factor) {
        return bent_height(stiffened(rest, way, factor), options, kRounds) >= kStandingHeight;
    };
    if (stands(1.0)) {
        return 1.0;
    }
    const bool widens = way == Stiffening::Widths;
    const double max_factor = widens ? 1e3 : kMaxFactor;
    const double buckling = stability_of(rest, options).load_factor;
    double low = 1.0;
    if (buckling > 0.0 && buckling < 1.0) { // with a smaller factor the plant buckles
        low = widens ? 1.0 / std::sqrt(buckling) : 1.0 / buckling;
    }
    const double growth = widens ? 1.3 : 2.0;
    double high = low * growth;
    while (!stands(high)) {
        low = high;
        high *= growth;
        if (!(high <= max_factor)) {
            return std::nullopt;
        }
    }
    while (high / low > 1.2) {
        const double middle = std::sqrt(low * high);
        (stands(middle) ? high : low) = middle;
    }
    return high;
}

bool has_automatic_springs(const Skeleton& rest, double elasticity) {
    return std::all_of(rest.segments.begin(), rest.segments.end(), [&](const Segment& segment) {
        const auto width =
            static_cast<double>(segment.base_radius) + static_cast<double>(segment.tip_radius);
        const auto length = static_cast<double>(segment.length);
        const double expected =
            elasticity * std::numbers::pi / 64.0 * width * width * width * width / length;
        return !(length > 0.0) ||
               std::abs(static_cast<double>(segment.spring) - expected) <= 1e-4 * expected;
    });
}

} // namespace lsys
