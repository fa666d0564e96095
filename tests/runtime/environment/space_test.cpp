// SPDX-License-Identifier: MIT
// Environments of kind Space, compared with every marker against every place.
#include "runtime/base/random.h"
#include "runtime/environment/environment.h"
#include "tests/runtime/environment/clouds.h"
#include "tests/runtime/environment/solids.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

using environments::answers_of;
using environments::random_places;
using environments::same_bits;
using environments::TestRandom;

double squared(const Vector3& a) {
    return (a[0] * a[0] + a[1] * a[1]) + a[2] * a[2];
}

Vector3 unit(const Vector3& a) {
    const double length = std::sqrt(squared(a));
    return length > 0.0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : Vector3{};
}

/// A space by the words of the language: a list of markers, and loops over all of them.
class DirectSpace {
public:
    DirectSpace(const BytecodeEnvironment& declared, std::uint64_t seed, std::uint32_t number)
        : declared_(declared) {
        for (std::uint64_t i = 0; i < declared.count; ++i) {
            for (std::uint64_t m = 64 * i; m < 64 * i + 64; ++m) {
                const PhiloxBlock words = draw_block(seed, 0xFFFFFFFDu, m, number);
                Vector3 u{};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    u[axis] = static_cast<double>(words[axis] >> 8) * 0x1p-24;
                }
                if (holds(u)) {
                    markers.push_back(point(u));
                    break;
                }
            }
        }
    }

    std::vector<float> answer(const std::vector<SensePlace>& places) {
        const auto kill = static_cast<double>(declared_.kill);
        markers.erase(std::remove_if(markers.begin(), markers.end(),
                                     [&](const Vector3& marker) {
                                         return std::any_of(
                                             places.begin(), places.end(), [&](const auto& place) {
                                                 return squared(way(place, marker)) < kill * kill;
                                             });
                                     }),
                      markers.end());
        std::vector<double> counts(places.size());
        std::vector<Vector3> sums(places.size());
        for (const Vector3& marker : markers) {
            const std::size_t owner = nearest(places, marker);
            if (owner < places.size()) {
                const Vector3 towards = unit(way(places[owner], marker));
                counts[owner] += 1.0;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    sums[owner][axis] += towards[axis];
                }
            }
        }
        std::vector<float> answers;
        for (std::size_t i = 0; i < places.size(); ++i) {
            answers.push_back(static_cast<float>(counts[i]));
            Vector3 mean{};
            for (std::size_t axis = 0; axis < 3 && counts[i] > 0.0; ++axis) {
                mean[axis] = sums[i][axis] / counts[i];
            }
            for (const double component : unit(mean)) {
                answers.push_back(static_cast<float>(component) + 0.0F);
            }
        }
        return answers;
    }

    std::vector<Vector3> markers;

private:
    static Vector3 way(const SensePlace& place, const Vector3& marker) {
        return {marker[0] - place.position[0], marker[1] - place.position[1],
                marker[2] - place.position[2]};
    }

    [[nodiscard]] bool holds(const Vector3& u) const {
        const double x = 2.0 * u[0] - 1.0;
        const double y = 2.0 * u[1] - 1.0;
        const double z = 2.0 * u[2] - 1.0;
        switch (declared_.shape) {
        case SpaceShape::Ball:
            return squared({x, y, z}) <= 1.0;
        case SpaceShape::Dome:
            return squared({x, u[1], z}) <= 1.0;
        case SpaceShape::Cone:
            return x * x + z * z <= (1.0 - u[1]) * (1.0 - u[1]);
        default:
            return true;
        }
    }

    [[nodiscard]] Vector3 point(const Vector3& u) const {
        Vector3 result{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<double>(declared_.at[axis]);
            const auto size = static_cast<double>(declared_.size[axis]);
            const double low = axis == 1 ? at : at - size / 2.0;
            const double high = axis == 1 ? at + size : at + size / 2.0;
            result[axis] = low + u[axis] * (high - low);
        }
        return result;
    }

    [[nodiscard]] std::size_t nearest(const std::vector<SensePlace>& places,
                                      const Vector3& marker) const {
        const auto radius = static_cast<double>(declared_.radius);
        // Cosines of half of the angles of these tests, which are exact or rounded correctly.
        const double cosine = declared_.angle == 180.0F   ? 0.0
                              : declared_.angle == 120.0F ? 0.5
                              : declared_.angle == 90.0F  ? std::sqrt(0.5)
                                                          : -1.0;
        std::size_t found = places.size();
        double least = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Vector3 w = way(places[i], marker);
            const Vector3& h = places[i].heading;
            const bool seen =
                declared_.angle == 360.0F || squared(w) == 0.0 ||
                (h[0] * w[0] + h[1] * w[1]) + h[2] * w[2] >= cosine * std::sqrt(squared(w));
            if (squared(w) <= radius * radius && seen &&
                (found == places.size() || squared(w) < least)) {
                found = i;
                least = squared(w);
            }
        }
        return found;
    }

    BytecodeEnvironment declared_;
};

BytecodeEnvironment space_of(SpaceShape shape, std::uint32_t count) {
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Space;
    declared.shape = shape;
    declared.size = {4.0F, 3.0F, 5.0F};
    declared.at = {0.5F, -1.25F, 0.1F};
    declared.count = count;
    declared.radius = 1.0F;
    declared.angle = 360.0F;
    return declared;
}

struct Space {
    Space(BytecodeEnvironment statement, std::uint32_t threads)
        : declared(std::move(statement)), workers(threads), context{&workers, nullptr, ~0ULL},
          environment(make_space(declared, files, 3, context)) {
        REQUIRE_FALSE(environment->begin(11).has_value());
    }

    BytecodeEnvironment declared;
    EnvironmentFiles files;
    Workers workers;
    EnvironmentContext context;
    std::unique_ptr<Environment> environment;
};

std::size_t bits_of(const std::string& state) {
    std::size_t bits = 0;
    for (const char byte : state.substr(8)) {
        bits += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
    }
    return bits;
}

} // namespace

TEST_CASE("a space has the answers of every marker against every place, bit by bit") {
    constexpr std::array<SpaceShape, 4> kShapes{SpaceShape::Box, SpaceShape::Ball, SpaceShape::Dome,
                                                SpaceShape::Cone};
    constexpr std::array<float, 4> kAngles{360.0F, 180.0F, 120.0F, 90.0F};
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        TestRandom random(seed);
        BytecodeEnvironment declared = space_of(kShapes[seed % 4], 1 + random.below(200));
        declared.angle = kAngles[random.below(4)];
        declared.radius = static_cast<float>(random.between(0.2, 3.0));
        declared.kill = random.below(3) == 0 ? 0.0F : static_cast<float>(random.between(0.1, 0.6));
        std::vector<std::vector<SensePlace>> words;
        for (std::size_t generation = 0; generation < 3; ++generation) {
            words.push_back(random_places(random, 1 + random.below(40), 2.0));
        }
        DirectSpace direct(declared, 11, 3);
        std::vector<std::vector<float>> expected;
        for (const std::vector<SensePlace>& places : words) {
            expected.push_back(direct.answer(places));
        }
        INFO("seed " << seed);
        for (const std::uint32_t threads : {1U, 2U, 5U}) {
            Space space(declared, threads);
            for (std::size_t i = 0; i < words.size(); ++i) {
                REQUIRE(same_bits(answers_of(*space.environment, words[i]), expected[i]));
            }
            REQUIRE(bits_of(space.environment->state()) == direct.markers.size());
        }
    }
}

TEST_CASE("a marker belongs to the first of the places at the same distance") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, 50);
    declared.radius = 100.0F;
    Space space(declared, 2);
    const std::vector<SensePlace> places(20);
    const std::vector<float> answers = answers_of(*space.environment, places);
    CHECK(answers[0] == 50.0F);
    CHECK(answers[4] == 0.0F);
}

TEST_CASE("a marker exactly at the radius belongs, one exactly at the kill distance is left") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, 1);
    declared.size = {1e-30F, 1e-30F, 1e-30F}; // the marker is at the place `at`
    declared.at = {2.0F, 1.0F, 2.0F};
    declared.radius = 3.0F;
    declared.kill = 3.0F;
    Space space(declared, 1);
    const std::vector<float> answers = answers_of(*space.environment, std::vector<SensePlace>(1));
    CHECK(answers[0] == 1.0F);
    CHECK(answers[1] == Approx(2.0 / 3.0));
    CHECK(answers[2] == Approx(1.0 / 3.0));
}

TEST_CASE("a marker at a place belongs to it and adds no direction") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, 5);
    declared.size = {1e-30F, 1e-30F, 1e-30F};
    declared.at = {2.0F, 1.0F, 2.0F};
    declared.angle = 1.0F;
    Space space(declared, 1);
    std::vector<SensePlace> places(1);
    places[0] = {{2.0, 1.0, 2.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    CHECK(answers_of(*space.environment, places) == std::vector<float>{5, 0, 0, 0});
}

TEST_CASE("all markers within the kill distance are gone, and a word without places kills none") {
    BytecodeEnvironment declared = space_of(SpaceShape::Ball, 2000);
    declared.kill = 100.0F;
    Space space(declared, 2);
    static_cast<void>(answers_of(*space.environment, {}));
    CHECK(bits_of(space.environment->state()) == 2000);
    CHECK(answers_of(*space.environment, std::vector<SensePlace>(1)) ==
          std::vector<float>{0, 0, 0, 0});
    CHECK(bits_of(space.environment->state()) == 0);
}

TEST_CASE("a restored space continues like the one that was saved") {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        TestRandom random(seed);
        BytecodeEnvironment declared = space_of(SpaceShape::Cone, 500);
        declared.kill = 0.5F;
        Space space(declared, 2);
        static_cast<void>(answers_of(*space.environment, random_places(random, 10, 2.0)));
        const std::string state = space.environment->state();
        CHECK(bits_of(state) < 500);
        Space resumed(declared, 5);
        REQUIRE(resumed.environment->restore(state));
        REQUIRE(resumed.environment->state() == state);
        const std::vector<SensePlace> places = random_places(random, 10, 2.0);
        REQUIRE(same_bits(answers_of(*space.environment, places),
                          answers_of(*resumed.environment, places)));
    }
}

TEST_CASE("a space refuses the state of another") {
    const BytecodeEnvironment declared = space_of(SpaceShape::Cone, 500);
    Space space(declared, 1);
    const std::string state = space.environment->state();
    SECTION("other size") {
        BytecodeEnvironment other = declared;
        other.size[1] = 7.0F;
        CHECK_FALSE(Space(other, 1).environment->restore(state));
    }
    SECTION("other seed") {
        REQUIRE_FALSE(space.environment->begin(12).has_value());
        CHECK_FALSE(space.environment->restore(state));
    }
    SECTION("too short") {
        CHECK_FALSE(space.environment->restore(state.substr(1)));
        CHECK_FALSE(space.environment->restore(""));
    }
    SECTION("a marker beyond the count") {
        std::string more = state;
        more.back() = static_cast<char>(0xFF);
        CHECK_FALSE(space.environment->restore(more));
    }
}

TEST_CASE("a mesh holds the markers that are inside") {
    BytecodeEnvironment declared = space_of(SpaceShape::Mesh, 3000);
    declared.at = {10.0F, 0.0F, 0.0F};
    declared.radius = 100.0F;
    Workers workers(2);
    EnvironmentFiles files;
    files.meshes.push_back(environments::sphere_mesh({0.0, 0.0, 0.0}, 2.0, 24));
    const auto space = make_space(declared, files, 0, {&workers, nullptr, ~0ULL});
    REQUIRE_FALSE(space->begin(1).has_value());
    CHECK(bits_of(space->state()) == 3000);
    // All are within the radius of the sphere, and most are beyond 0.7 times it.
    std::vector<SensePlace> places(1);
    places[0].position = {10.0, 0.0, 0.0};
    CHECK(answers_of(*space, places)[0] == 3000.0F);
    declared.radius = 2.0F;
    CHECK(answers_of(*space, places)[0] == 3000.0F);
    declared.radius = 1.4F;
    CHECK(answers_of(*space, places)[0] == Approx(3000.0 * 0.343).epsilon(0.1));
}

TEST_CASE("a space refuses a mesh with a hole") {
    BytecodeEnvironment declared = space_of(SpaceShape::Mesh, 10);
    Workers workers(1);
    EnvironmentFiles files;
    files.meshes.push_back(environments::cube_mesh({0.0, 0.0, 0.0}, 1.0));
    files.meshes[0].triangles.pop_back();
    const auto failure = make_space(declared, files, 0, {&workers, nullptr, ~0ULL})->begin(1);
    REQUIRE(failure.has_value());
    CHECK(failure->stop == Stop::Diagnosed);
    CHECK(failure->text == "its mesh is not closed");
}

TEST_CASE("many markers are refused beyond the memory, and drawing them can be cancelled") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, kMaxMarkers);
    Workers workers(2);
    const EnvironmentFiles files;
    SECTION("limit") {
        const auto failure =
            make_space(declared, files, 0, {&workers, nullptr, 1U << 20})->begin(1);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Limit);
        CHECK(failure->bytes >= std::uint64_t{kMaxMarkers} * 16);
    }
    SECTION("cancelled") {
        declared.count = 1U << 20;
        const std::atomic<bool> cancelled{true};
        const auto failure =
            make_space(declared, files, 0, {&workers, &cancelled, ~0ULL})->begin(1);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Cancelled);
    }
}

} // namespace lsys
