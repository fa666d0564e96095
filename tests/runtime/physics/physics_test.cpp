// SPDX-License-Identifier: MIT
// The physics of plants against closed forms and independent solutions.
#include "runtime/physics/physics.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

constexpr double kGravity = 9.81;
constexpr double kPi = std::numbers::pi;

PhysicsOptions in_vacuum() {
    PhysicsOptions options;
    options.air_density = 0.0F;
    options.ground = false;
    options.threads = 1;
    return options;
}

/// The angle of a segment from +Y towards +X, radians.
double lean_of(const Segment& segment) {
    const glm::dvec3 up = glm::dquat(segment.frame) * glm::dvec3(0.0, 1.0, 0.0);
    return std::atan2(up.x, up.y);
}

/// The root of `f`, which increases from below 0 at `low` to above 0 at `high`, by bisection.
double root(double low, double high, const std::function<double(double)>& f) {
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0.0 ? low : high) = middle;
    }
    return low;
}

} // namespace

TEST_CASE("a cantilever under its weight comes to rest at the closed form") {
    for (const double lean : {0.1, 0.5, 1.2, 2.0, 3.0}) {
        for (const double spring : {5.0, 20.0, 200.0, 1e5}) {
            Skeleton plant;
            add_segment(plant, kNoSegment, leaning(static_cast<float>(lean)),
                        rod(1.5F, 0.03F, static_cast<float>(spring), 2.0F));
            PlantPhysics physics(plant, in_vacuum());
            REQUIRE(physics.settle(1e-9, 1000));
            Skeleton bent;
            physics.pose(bent);
            const double angle = lean_of(bent.segments[0]);
            // Equilibrium: k theta = m g l / 2 sin(angle). Weak springs may have several solutions.
            const double moment = 2.0 * kGravity * 1.5 / 2.0;
            CAPTURE(lean, spring, angle);
            CHECK(spring * (angle - lean) ==
                  Approx(moment * std::sin(angle)).epsilon(1e-5).margin(1e-5 + 1e-6 * spring));
            if (spring > moment) {
                const double expected = root(0.0, 2.0 * kPi, [&](double a) {
                    return spring * (a - lean) - moment * std::sin(a);
                });
                CHECK(angle == Approx(expected).margin(2e-6));
            }
        }
    }
}

TEST_CASE("steps of a damped cantilever converge to the pose of settle()") {
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(0.7F), rod(1.0F, 0.02F, 10.0F, 1.0F));
    for (const float step : {1.0F / 240.0F, 1.0F / 60.0F, 0.1F}) {
        PhysicsOptions options = in_vacuum();
        options.time_step = step;
        PlantPhysics physics(plant, options);
        while (physics.time() < 20.0) {
            physics.step();
        }
        Skeleton bent;
        physics.pose(bent);
        const double expected =
            root(0.0, kPi, [](double a) { return 10.0 * (a - 0.7) - 4.905 * std::sin(a); });
        CHECK(lean_of(bent.segments[0]) == Approx(expected).margin(2e-6));
    }
}

TEST_CASE("a chain of two comes to rest at the solution of Newton's method") {
    struct Case {
        double lean_1, lean_2, k_1, k_2, m_1, m_2, l_1, l_2;
    };
    for (const Case& c : {Case{0.3, 0.9, 50.0, 10.0, 2.0, 1.0, 1.0, 0.8},
                          Case{1.0, -0.4, 80.0, 5.0, 1.0, 0.5, 1.0, 1.0},
                          Case{1.5, 1.6, 500.0, 90.0, 3.0, 2.0, 2.0, 1.0}}) {
        Skeleton plant;
        const auto narrow = [](double x) { return static_cast<float>(x); };
        const std::uint32_t first =
            add_segment(plant, kNoSegment, leaning(narrow(c.lean_1)),
                        rod(narrow(c.l_1), 0.02F, narrow(c.k_1), narrow(c.m_1)));
        add_segment(plant, first, leaning(narrow(c.lean_2)),
                    rod(narrow(c.l_2), 0.01F, narrow(c.k_2), narrow(c.m_2)));
        PlantPhysics physics(plant, in_vacuum());
        REQUIRE(physics.settle(1e-10, 1000));
        Skeleton bent;
        physics.pose(bent);

        // The energy is k1 (a - a0)^2 / 2 + k2 (b - a - b0 + a0)^2 / 2 + p cos a + q cos b.
        const double p = kGravity * (c.m_1 * c.l_1 / 2.0 + c.m_2 * c.l_1);
        const double q = kGravity * c.m_2 * c.l_2 / 2.0;
        double a = c.lean_1;
        double b = c.lean_2;
        for (int i = 0; i < 100; ++i) {
            const double joint = c.k_2 * (b - a - c.lean_2 + c.lean_1);
            const double f = c.k_1 * (a - c.lean_1) - joint - p * std::sin(a);
            const double g = joint - q * std::sin(b);
            const double f_a = c.k_1 + c.k_2 - p * std::cos(a);
            const double g_b = c.k_2 - q * std::cos(b);
            const double determinant = f_a * g_b - c.k_2 * c.k_2;
            REQUIRE(determinant > 0.0);
            a -= (f * g_b + c.k_2 * g) / determinant;
            b -= (g * f_a + c.k_2 * f) / determinant;
        }
        CHECK(lean_of(bent.segments[0]) == Approx(a).margin(3e-6));
        CHECK(lean_of(bent.segments[1]) == Approx(b).margin(3e-6));
    }
}

TEST_CASE("a rod in wind comes to rest at the closed form, downwind") {
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(0.0F), rod(2.0F, 0.05F, 3.0F, 1.0F));
    PhysicsOptions options;
    options.gravity = 0.0F;
    options.wind.velocity = {6.0F, 0.0F, 0.0F};
    options.threads = 1;
    PlantPhysics physics(plant, options);
    REQUIRE(physics.settle(1e-9, 1000));
    Skeleton bent;
    physics.pose(bent);
    const double pressure = 0.5 * 1.1 * 1.225 * 36.0;
    const double expected = root(0.0, kPi / 2.0, [&](double a) {
        const double area = 0.2 * std::cos(a) + kPi * 0.0025 * std::sin(a);
        return 3.0 * a - pressure * area * std::cos(a);
    });
    CHECK(expected > 0.3);
    CHECK(lean_of(bent.segments[0]) == Approx(expected).margin(2e-6));

    // After a long time in the wind, stepwise simulation gives the same pose.
    for (const float gust : {0.0F, 0.4F}) {
        options.wind.gust = gust;
        PlantPhysics blown(plant, options);
        while (blown.time() < 30.0) {
            blown.step();
        }
        std::array<double, 200> leans{};
        for (double& lean : leans) {
            blown.step();
            blown.pose(bent);
            lean = lean_of(bent.segments[0]);
        }
        const auto [min_lean, max_lean] = std::minmax_element(leans.begin(), leans.end());
        if (gust == 0.0F) {
            CHECK(*min_lean == Approx(expected).margin(2e-6));
            CHECK(*max_lean - *min_lean <= 1e-6);
        } else {
            CHECK(*max_lean - *min_lean > 0.05);
            CHECK(*min_lean > 0.0);
        }
    }
}

TEST_CASE("leaves and polygons of any size catch the wind with half of their area") {
    // The end of the rod catches wind with the area of its base; massless sheets only add area.
    Skeleton plant;
    Segment tapered = rod(2.0F, 0.05F, 3.0F, 1.0F);
    tapered.tip_radius = 0.02F;
    add_segment(plant, kNoSegment, leaning(0.0F), tapered);
    PhysicsOptions options;
    options.gravity = 0.0F;
    options.wind.velocity = {6.0F, 0.0F, 0.0F};
    options.surface_mass = 0.0F;
    options.threads = 1;
    const auto has_lean = [&](double sheets) {
        PlantPhysics physics(plant, options);
        REQUIRE(physics.settle(1e-9, 1000));
        Skeleton bent;
        physics.pose(bent);
        const double pressure = 0.5 * 1.1 * 1.225 * 36.0;
        const double centre = 0.5 * 0.0057 / 0.0039; // of a truncated cone, l / 4 times a fraction
        const double expected = root(0.0, kPi / 2.0, [&](double a) {
            const double area = 0.14 * std::cos(a) + kPi * 0.0025 * std::sin(a) + 0.5 * sheets;
            return 3.0 * a - pressure * area * centre * std::cos(a);
        });
        CHECK(lean_of(bent.segments[0]) == Approx(expected).margin(2e-6));
    };
    has_lean(0.0);
    PlacedObject leaf;
    leaf.kind = TurtleOperation::Leaf;
    leaf.size = -0.5F;
    leaf.parent = 0;
    plant.objects.push_back(leaf);
    has_lean(0.25);
    plant.corners = {{0.0F, 2.0F, 0.0F}, {0.6F, 2.0F, 0.0F}, {0.0F, 2.4F, 0.0F}};
    plant.polygons.push_back({.first_corner = 0, .corner_count = 3, .parent = 0});
    has_lean(0.25 + 0.12);
}

TEST_CASE("a free rod swings with the period of a compound pendulum") {
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(static_cast<float>(kPi - 0.05)),
                rod(1.0F, 0.001F, 0.0F, 1.0F));
    PhysicsOptions options = in_vacuum();
    options.damping = 0.0F;
    options.time_step = 1e-4F;
    PlantPhysics physics(plant, options);
    std::vector<double> crossings;
    double before = 1.0;
    Skeleton bent;
    while (physics.time() < 5.0) {
        physics.step();
        physics.pose(bent);
        const auto side = static_cast<double>(tip(bent.segments[0]).x);
        if (before > 0.0 && side <= 0.0) {
            crossings.push_back(physics.time());
        }
        before = side;
    }
    REQUIRE(crossings.size() == 3);
    const double period = 2.0 * kPi * std::sqrt(2.0 / (3.0 * kGravity));
    CHECK(crossings[1] - crossings[0] == Approx(period).epsilon(1e-3));
    CHECK(crossings[2] - crossings[1] == Approx(period).epsilon(1e-3));
}

TEST_CASE("two rods swing by Lagrange's equations, and finer steps have smaller errors") {
    // Two equal rods of mass 1 and length 1 on springs, in a plane; angles are from +Y.
    constexpr double kSpring = 4.0;
    constexpr double kDamper = 0.05;
    const std::array<double, 2> rest = {1.2, 2.2};
    using State = std::array<double, 4>; // angles, rates
    const auto rates = [&](const State& s) {
        const double c = 0.5 * std::cos(s[0] - s[1]);
        const double n = 0.5 * std::sin(s[0] - s[1]);
        const double joint = kSpring * (s[1] - s[0] - rest[1] + rest[0]) + kDamper * (s[3] - s[2]);
        const double f = -n * s[3] * s[3] + 1.5 * kGravity * std::sin(s[0]) -
                         kSpring * (s[0] - rest[0]) - kDamper * s[2] + joint;
        const double g = n * s[2] * s[2] + 0.5 * kGravity * std::sin(s[1]) - joint;
        const double a = 1.0 / 3.0 + 1.0;
        const double b = 1.0 / 3.0;
        const double determinant = a * b - c * c;
        return State{s[2], s[3], (b * f - c * g) / determinant, (a * g - c * f) / determinant};
    };
    State exact = {rest[0], rest[1], 0.0, 0.0};
    const double h = 1e-4;
    const auto ahead = [](const State& s, const State& rate, double time) {
        State out{};
        for (std::size_t i = 0; i < 4; ++i) {
            out[i] = s[i] + time * rate[i];
        }
        return out;
    };
    for (int i = 0; i < 6000; ++i) { // 0.6 s by the Runge-Kutta method
        const State k1 = rates(exact);
        const State k2 = rates(ahead(exact, k1, h / 2.0));
        const State k3 = rates(ahead(exact, k2, h / 2.0));
        const State k4 = rates(ahead(exact, k3, h));
        for (std::size_t j = 0; j < 4; ++j) {
            exact[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
        }
    }
    REQUIRE(std::abs(exact[0] - rest[0]) > 0.5);

    Skeleton plant;
    const std::uint32_t first =
        add_segment(plant, kNoSegment, leaning(1.2F), rod(1.0F, 1e-4F, 4.0F, 1.0F));
    add_segment(plant, first, leaning(2.2F), rod(1.0F, 1e-4F, 4.0F, 1.0F));
    double last_error = 1e9;
    for (const float step : {4e-3F, 1e-3F, 2.5e-4F}) {
        PhysicsOptions options = in_vacuum();
        options.damping = static_cast<float>(kDamper);
        options.time_step = step;
        PlantPhysics physics(plant, options);
        const int steps = static_cast<int>(std::lround(0.6 / static_cast<double>(step)));
        for (int i = 0; i < steps; ++i) {
            physics.step();
        }
        Skeleton bent;
        physics.pose(bent);
        const double error =
            std::hypot(std::remainder(lean_of(bent.segments[0]) - exact[0], 2.0 * kPi),
                       std::remainder(lean_of(bent.segments[1]) - exact[1], 2.0 * kPi));
        CAPTURE(step, error, last_error);
        CHECK(error < 0.35 * last_error); // the method is of first order, and the step is a quarter
        last_error = error;
    }
    CHECK(last_error < 5e-3);
}

TEST_CASE("with short steps and without damping, a tree keeps its energy") {
    std::mt19937 numbers(3);
    const Skeleton plant = random_plant(numbers, 12, 0.3);
    std::vector<double> lost;
    for (const float step : {1e-3F, 2.5e-4F}) {
        PhysicsOptions options = in_vacuum();
        options.damping = 0.0F;
        options.time_step = step;
        options.surface_mass = 0.0F;
        PlantPhysics physics(plant, options);
        double deepest = 0.0;
        Skeleton bent;
        while (physics.time() < 0.5) {
            physics.step();
            physics.pose(bent);
            deepest = std::min(deepest, potential(plant, bent, kGravity).energy);
        }
        CHECK(deepest < -10.0);
        lost.push_back(physics.energy() / deepest);
    }
    CAPTURE(lost[0], lost[1]);
    CHECK(lost[1] < 0.05);
    CHECK(lost[1] < 0.35 * lost[0]);
}

TEST_CASE("a body that turns freely keeps its angular momentum") {
    // Three point masses on a joint without a spring. Gravity sets them in motion and is then
    // switched off.
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(0.3F), rod(1.0F, 0.0F, 0.0F, 0.0F));
    for (const glm::vec3& place :
         {glm::vec3(1.0F, 0.2F, 0.0F), glm::vec3(0.1F, 0.3F, 1.2F), glm::vec3(0.3F, 1.5F, 0.2F)}) {
        PlacedObject point;
        point.kind = TurtleOperation::Sphere;
        point.position = place;
        point.size = 1e-3F;
        point.parent = 0;
        plant.objects.push_back(point);
    }
    PhysicsOptions options = in_vacuum();
    options.damping = 0.0F;
    options.time_step = 1e-3F;
    PlantPhysics physics(plant, options);
    for (int i = 0; i < 800; ++i) {
        physics.step();
    }
    options.gravity = 0.0F;
    options.time_step = 2.5e-4F;
    physics.set(options);
    Skeleton before;
    Skeleton after;
    const auto momentum = [&] {
        glm::dvec3 sum(0.0);
        physics.pose(before);
        for (int i = 0; i < 8; ++i) {
            physics.step();
        }
        physics.pose(after);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from(before.objects[i].position);
            const glm::dvec3 to(after.objects[i].position);
            sum += glm::cross(0.5 * (from + to), (to - from) / 2e-3);
        }
        return sum;
    };
    const glm::dvec3 first = momentum();
    const glm::vec3 axis_first = heading(after.segments[0].frame);
    double farthest = 0.0;
    double turned = 0.0;
    for (int i = 0; i < 500; ++i) { // 1 s
        farthest = std::max(farthest, glm::length(momentum() - first));
        turned = std::max(turned, static_cast<double>(
                                      glm::length(heading(after.segments[0].frame) - axis_first)));
    }
    CAPTURE(glm::length(first), farthest, turned);
    CHECK(turned > 0.5);
    CHECK(farthest < 0.02 * glm::length(first));
}

TEST_CASE("without wind and gravity nothing moves") {
    std::mt19937 numbers(11);
    const Skeleton plant = random_plant(numbers, 200, 2.0);
    PhysicsOptions options;
    options.gravity = 0.0F;
    options.threads = 2;
    PlantPhysics physics(plant, options);
    Skeleton bent;
    for (int i = 0; i < 50; ++i) {
        physics.step();
    }
    physics.pose(bent);
    CHECK(same(plant, bent));
    CHECK(physics.settle(0.0, 1));
    physics.pose(bent);
    CHECK(same(plant, bent));
    CHECK(physics.energy() == 0.0);

    options.gravity = 9.81F;
    physics.set(options);
    physics.step();
    physics.pose(bent);
    CHECK_FALSE(same(plant, bent));
    physics.reset();
    physics.pose(bent);
    CHECK(same(plant, bent));
}

TEST_CASE("objects and polygons of a segment move with it") {
    Skeleton plant;
    const std::uint32_t trunk =
        add_segment(plant, kNoSegment, leaning(0.4F), rod(2.0F, 0.05F, 40.0F, 3.0F));
    const std::uint32_t apart =
        add_segment(plant, trunk, leaning(1.0F), rod(1.0F, 0.02F, 9.0F, 1.0F));
    plant.segments[apart].base += glm::vec3(0.3F, 0.4F, 0.5F);
    plant.segments[apart].linked = false;
    PlacedObject leaf;
    leaf.kind = TurtleOperation::Leaf;
    leaf.position = tip(plant.segments[apart]);
    leaf.frame = leaning(0.2F);
    leaf.parent = apart;
    plant.objects.push_back(leaf);
    leaf.parent = kNoSegment;
    plant.objects.push_back(leaf);
    plant.corners = {{0.0F, 2.0F, 0.0F}, {0.3F, 2.0F, 0.1F}, {0.0F, 2.4F, 0.2F}};
    plant.polygons.push_back({.first_corner = 0, .corner_count = 3, .parent = trunk});
    PlantPhysics physics(plant, {});
    REQUIRE(physics.settle(1e-7, 500));
    Skeleton bent;
    physics.pose(bent);

    const auto seen_from = [](const Skeleton& s, std::uint32_t segment, const glm::vec3& point) {
        return glm::conjugate(s.segments[segment].frame) * (point - s.segments[segment].base);
    };
    const auto near = [](const glm::vec3& a, const glm::vec3& b) {
        return glm::length(a - b) < 1e-5F;
    };
    CHECK(glm::length(bent.segments[apart].base - plant.segments[apart].base) > 0.1F);
    CHECK(bent.segments[trunk].base == plant.segments[trunk].base);
    CHECK(near(seen_from(bent, trunk, bent.segments[apart].base),
               seen_from(plant, trunk, plant.segments[apart].base)));
    CHECK(near(seen_from(bent, apart, bent.objects[0].position),
               seen_from(plant, apart, plant.objects[0].position)));
    CHECK(near(heading(glm::conjugate(bent.segments[apart].frame) * bent.objects[0].frame),
               heading(glm::conjugate(plant.segments[apart].frame) * plant.objects[0].frame)));
    CHECK(bent.objects[1].position == plant.objects[1].position);
    CHECK(bent.objects[1].frame == plant.objects[1].frame);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(near(seen_from(bent, trunk, bent.corners[c]),
                   seen_from(plant, trunk, plant.corners[c])));
    }
    CHECK(near(heading(glm::conjugate(bent.segments[trunk].frame) * bent.polygons[0].frame),
               heading(glm::conjugate(plant.segments[trunk].frame) * plant.polygons[0].frame)));
}

TEST_CASE("the weight of leaves depends on their size") {
    // A rod without mass and a leaf at its tip; the leaf's centre of mass is half its length
    // farther out.
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(1.0F), rod(1.0F, 0.01F, 2.0F, 0.0F));
    PlacedObject leaf;
    leaf.kind = TurtleOperation::Leaf;
    leaf.position = tip(plant.segments[0]);
    leaf.frame = plant.segments[0].frame;
    leaf.size = 0.5F;
    leaf.parent = 0;
    plant.objects.push_back(leaf);
    PhysicsOptions options = in_vacuum();
    PlantPhysics physics(plant, options);
    REQUIRE(physics.settle(1e-9, 100));
    Skeleton bent;
    physics.pose(bent);
    const double moment = 0.2 * 0.25 * kGravity * 1.25;
    CHECK(lean_of(bent.segments[0]) == Approx(root(0.0, kPi, [&](double a) {
                                           return 2.0 * (a - 1.0) - moment * std::sin(a);
                                       })).margin(2e-6));
    options.surface_mass = 0.0F;
    physics.set(options);
    REQUIRE(physics.settle(1e-9, 100));
    physics.pose(bent);
    CHECK(lean_of(bent.segments[0]) == Approx(1.0).margin(1e-6));
}
