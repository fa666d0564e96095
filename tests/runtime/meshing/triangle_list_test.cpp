// SPDX-License-Identifier: MIT
#include "runtime/meshing/triangle_list.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

using Indices = std::vector<std::uint32_t>;

/// Vertex of column `i` of a ring; columns wrap around.
std::uint32_t corner(const RingCorners& ring, std::uint32_t i) {
    return ring.first + (ring.seam ? i : i % ring.sides);
}

void put_bands(RingCorners low, std::uint32_t bands, Indices& to) {
    for (std::uint32_t band = 0; band < bands; ++band) {
        RingCorners high = low;
        high.first += low.columns();
        for (std::uint32_t i = 0; i < low.sides; ++i) {
            to.insert(to.end(), {corner(low, i), corner(low, i + 1), corner(high, i + 1),
                                 corner(low, i), corner(high, i + 1), corner(high, i)});
        }
        low = high;
    }
}

void put_fan(const RingCorners& ring,
             std::uint32_t point,
             bool has_point_per_side,
             bool upwards,
             Indices& to) {
    for (std::uint32_t i = 0; i < ring.sides; ++i) {
        const std::uint32_t a = corner(ring, i);
        const std::uint32_t b = corner(ring, i + 1);
        to.insert(to.end(),
                  {upwards ? a : b, upwards ? b : a, point + (has_point_per_side ? i : 0)});
    }
}

/// A random list with triangles of all kinds, and its expected indices.
std::pair<TriangleList, Indices> mixed_list(std::uint32_t seed) {
    test::RandomNumbers random(seed);
    TriangleList list;
    Indices indices;
    std::uint32_t vertex = 10;
    for (int i = 0; i < 60; ++i) {
        RingCorners ring{.first = vertex,
                         .sides = 3 + random.below(i % 7 == 0 ? 62 : 6),
                         .seam = random.below(2) == 1};
        switch (random.below(4)) {
        case 0: { // bands that are merged into one patch
            const std::uint32_t bands = 1 + random.below(4);
            put_bands(ring, bands, indices);
            for (std::uint32_t band = 0; band < bands; ++band) {
                list.append_bands(ring, 1);
                ring.first += ring.columns();
            }
            vertex = ring.first;
            break;
        }
        case 1: {
            const bool own = random.below(2) == 1;
            const bool upwards = random.below(2) == 1;
            const std::uint32_t point = random.below(1000);
            list.append_fan(ring, point, own, upwards);
            put_fan(ring, point, own, upwards, indices);
            vertex += random.below(3);
            break;
        }
        case 2: { // an uneven band whose rings have equally many sides, with two triangles per side
            RingCorners high = ring;
            high.first += ring.columns();
            TriangleList uneven;
            uneven.append_uneven_band(ring, high);
            CHECK(uneven.size() == std::uint64_t{6} * ring.sides);
            list.append(std::move(uneven), 0);
            for (std::uint32_t k = 0; k < ring.sides; ++k) {
                indices.insert(indices.end(),
                               {corner(ring, k), corner(ring, k + 1), corner(high, k),
                                corner(ring, k + 1), corner(high, k + 1), corner(high, k)});
            }
            break;
        }
        default: {
            LargeVector<std::uint32_t> listed;
            for (std::uint32_t k = 0; k < 3 * random.below(5); ++k) {
                listed.push_back(random.below(100'000));
            }
            indices.insert(indices.end(), listed.begin(), listed.end());
            list.append(std::move(listed));
            list.push_back(vertex);
            indices.push_back(vertex);
            break;
        }
        }
    }
    return {std::move(list), std::move(indices)};
}

} // namespace

TEST_CASE("triangles in compact form are read like listed ones", "[mesh]") {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        const auto [list, indices] = mixed_list(seed);
        REQUIRE(list.size() == indices.size());
        const LargeVector<std::uint32_t> all = list.expanded();
        REQUIRE(Indices(all.begin(), all.end()) == indices);
        CHECK(list == TriangleList(all));
        test::RandomNumbers random(seed);
        TriangleReader reader(list);
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < indices.size(); ++i) {
            wrong += list[i] == indices[i] && reader[i] == indices[i] ? 0U : 1U;
            const auto left = static_cast<std::uint32_t>(indices.size() - i);
            Indices part(random.below(std::min(left, 900U) + 1));
            list.read(i, part);
            wrong += std::equal(part.begin(), part.end(), indices.begin() + i) ? 0U : 1U;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("chunks contain all indices in order", "[mesh]") {
    TriangleList list;
    list.append_bands({.first = 0, .sides = 8}, 2000);
    list.append({7, 8, 9});
    LargeVector<std::uint32_t> joined;
    for_each_chunk(list, [&](std::uint64_t first, std::span<const std::uint32_t> part) {
        CHECK(first == joined.size());
        joined.insert(joined.end(), part.begin(), part.end());
    });
    CHECK(joined == list.expanded());
    for_each_chunk(TriangleList(), [](std::uint64_t, auto) { FAIL("there is nothing"); });
}

TEST_CASE("a ring of more sides is joined corner by corner", "[mesh]") {
    TriangleList list;
    list.append_uneven_band({.first = 0, .sides = 3}, {.first = 3, .sides = 4});
    CHECK(list == TriangleList{0, 4, 3, 0, 1, 4, 1, 5, 4, 1, 2, 5, 2, 6, 5, 2, 0, 6, 0, 3, 6});
}

TEST_CASE("a list can be appended with an offset of its vertices", "[mesh]") {
    auto [list, indices] = mixed_list(3);
    const auto [more, more_indices] = mixed_list(4);
    const TriangleList before = list;
    CHECK(list == before);
    list.append(more, 1000);
    for (const std::uint32_t index : more_indices) {
        indices.push_back(index + 1000);
    }
    const LargeVector<std::uint32_t> all = list.expanded();
    CHECK(Indices(all.begin(), all.end()) == indices);
    CHECK_FALSE(list == before);
    list.append(TriangleList(), 7);
    CHECK(list.size() == indices.size());
}

TEST_CASE("a tube of millions of rings takes few bytes", "[mesh]") {
    // More indices than 32 bits can count: two blocks, whose border lies within the tube.
    TriangleList list;
    constexpr std::uint32_t kBands = 1U << 20;
    RingCorners ring{.first = 5, .sides = 64};
    for (int i = 0; i < 12; ++i) {
        list.append_bands(ring, kBands);
        ring.first += kBands * ring.columns();
    }
    const std::uint64_t unit = std::uint64_t{6} * 64;
    REQUIRE(list.size() == 12 * unit * kBands);
    CHECK(list.byte_count() < 100);
    for (std::uint32_t part = 1; part < 12; ++part) {
        Indices wanted;
        put_bands({.first = 5 + (part * kBands - 1) * 64, .sides = 64}, 2, wanted);
        Indices read(2 * unit);
        list.read((std::uint64_t{part} * kBands - 1) * unit, read);
        CHECK(read == wanted);
    }
}

} // namespace lsys
