// SPDX-License-Identifier: MIT
#include "runtime/meshing/triangle_list.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kMaxPatchSides = 255;
// Max indices of a unit of a patch: one band, or the whole of any other shape.
constexpr std::size_t kMaxUnitIndices = std::size_t{6} * kMaxPatchSides;
constexpr std::uint32_t kMaxBands = 1U << 20; // per call of append_bands()
constexpr std::uint32_t kMaxBlockIndices = std::numeric_limits<std::uint32_t>::max();

} // namespace

/// The triangles of a band whose lower ring begins with vertex 0.
struct TriangleList::Pattern {
    std::uint32_t sides = 0;
    bool seam = false;
    std::array<std::uint32_t, kMaxUnitIndices> offsets;

    void set(std::uint32_t new_sides, bool new_seam) {
        if (sides == new_sides && seam == new_seam) {
            return;
        }
        sides = new_sides;
        seam = new_seam;
        const std::uint32_t columns = sides + (seam ? 1U : 0U);
        std::uint32_t* to = offsets.data();
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t after = i + 1 == sides && !seam ? 0 : i + 1;
            for (const std::uint32_t corner :
                 {i, after, columns + after, i, columns + after, columns + i}) {
                *to++ = corner;
            }
        }
    }
};

TriangleList::TriangleList(std::initializer_list<std::uint32_t> indices) {
    append(LargeVector<std::uint32_t>(indices.begin(), indices.end()));
}

std::uint64_t TriangleList::byte_count() const {
    std::uint64_t bytes = 0;
    for (const Block& block : blocks_) {
        bytes += block.patches.size() * sizeof(Patch) + block.listed.size() * sizeof(std::uint32_t);
    }
    return bytes;
}

std::uint32_t TriangleList::operator[](std::uint64_t index) const {
    std::uint32_t value = 0;
    read(index, std::span(&value, 1));
    return value;
}

/// Writes the triangles of a patch whose shape is not Shape::Bands.
void TriangleList::write_whole_patch(const Patch& patch, std::uint32_t vertex, std::uint32_t* to) {
    const std::uint32_t sides = patch.sides;
    const std::uint32_t low = vertex + patch.first;
    const std::uint32_t high = vertex + patch.second;
    const auto corner = [&](std::uint32_t ring, std::uint32_t of, std::uint32_t i) {
        return ring + (i == of && !patch.seam ? 0 : i);
    };
    if (patch.shape == Shape::Fan) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t after = corner(low, sides, i + 1);
            *to++ = patch.upwards ? low + i : after;
            *to++ = patch.upwards ? after : low + i;
            *to++ = high + (patch.point_per_side ? i : 0);
        }
        return;
    }
    // The corners i of the low ring and j of the high ring advance around the axis. The next
    // triangle has the side of the ring whose next corner comes first.
    const std::uint32_t high_sides = patch.second_sides;
    std::uint32_t i = 0;
    std::uint32_t j = 0;
    while (i < sides || j < high_sides) {
        *to++ = corner(low, sides, i);
        if ((i + 1) * high_sides <= (j + 1) * sides && i < sides) {
            ++i;
            *to++ = corner(low, sides, i);
            *to++ = corner(high, high_sides, j);
        } else {
            *to++ = corner(high, high_sides, j + 1);
            *to++ = corner(high, high_sides, j);
            ++j;
        }
    }
}

void TriangleList::read_patches(const Block& block,
                                std::uint64_t first,
                                std::span<std::uint32_t> to,
                                Pattern& pattern) {
    auto patch = std::upper_bound(
        block.patches.begin(), block.patches.end(), first,
        [](std::uint64_t index, const Patch& candidate) { return index < candidate.end; });
    std::array<std::uint32_t, kMaxUnitIndices> part;
    for (; !to.empty(); ++patch) {
        const std::uint64_t begin = patch == block.patches.begin() ? 0 : std::prev(patch)->end;
        const bool bands = patch->shape == Shape::Bands;
        const std::uint64_t unit = bands ? std::uint64_t{6} * patch->sides : patch->end - begin;
        const std::uint32_t columns = patch->sides + (patch->seam ? 1U : 0U);
        if (bands) {
            pattern.set(patch->sides, patch->seam);
        }
        const auto write = [&](std::uint64_t number, std::uint32_t* out) {
            if (!bands) {
                write_whole_patch(*patch, block.first_vertex, out);
                return;
            }
            const std::uint32_t base =
                block.first_vertex + patch->first + static_cast<std::uint32_t>(number) * columns;
            const std::uint32_t* const offsets = pattern.offsets.data();
            for (std::size_t i = 0; i < unit; ++i) {
                out[i] = base + offsets[i];
            }
        };
        while (first < patch->end && !to.empty()) {
            const std::uint64_t number = (first - begin) / unit;
            const std::uint64_t skipped = (first - begin) % unit;
            const std::size_t count = std::min<std::size_t>(to.size(), unit - skipped);
            if (count == unit) {
                write(number, to.data());
            } else {
                write(number, part.data());
                std::copy_n(part.data() + skipped, count, to.data());
            }
            to = to.subspan(count);
            first += count;
        }
    }
}

void TriangleList::read(std::uint64_t first, std::span<std::uint32_t> to) const {
    LSYS_CHECK(first <= size_ && to.size() <= size_ - first, first, to.size(), size_);
    if (to.empty()) {
        return;
    }
    Pattern pattern;
    auto block = std::prev(std::upper_bound(
        blocks_.begin(), blocks_.end(), first,
        [](std::uint64_t index, const Block& candidate) { return index < candidate.begin; }));
    for (; !to.empty(); ++block) {
        const std::uint64_t from = first - block->begin;
        const std::size_t count = std::min<std::size_t>(to.size(), block->size() - from);
        if (block->patches.empty()) {
            const std::uint32_t* const listed = block->listed.data() + from;
            for (std::size_t i = 0; i < count; ++i) {
                to[i] = block->first_vertex + listed[i];
            }
        } else {
            read_patches(*block, from, to.first(count), pattern);
        }
        to = to.subspan(count);
        first += count;
    }
}

LargeVector<std::uint32_t> TriangleList::expanded() const {
    LargeVector<std::uint32_t> indices;
    indices.resize(size_);
    read(0, indices);
    return indices;
}

bool operator==(const TriangleList& a, const TriangleList& b) {
    if (a.size() != b.size()) {
        return false;
    }
    TriangleReader of_a(a);
    TriangleReader of_b(b);
    for (std::uint64_t i = 0; i < a.size(); ++i) {
        if (of_a[i] != of_b[i]) {
            return false;
        }
    }
    return true;
}

void TriangleList::push_back(std::uint32_t index) {
    if (blocks_.empty() || !blocks_.back().patches.empty() || blocks_.back().first_vertex != 0) {
        append(LargeVector<std::uint32_t>{index});
        return;
    }
    blocks_.back().listed.push_back(index);
    ++size_;
}

void TriangleList::append(LargeVector<std::uint32_t> indices) {
    if (indices.empty()) {
        return;
    }
    const std::uint64_t count = indices.size();
    blocks_.push_back({.begin = size_, .patches = {}, .listed = std::move(indices)});
    size_ += count;
}

void TriangleList::append(TriangleList list, std::uint32_t first_vertex) {
    for (Block& block : list.blocks_) {
        block.begin += size_;
        block.first_vertex += first_vertex;
        blocks_.push_back(std::move(block));
    }
    size_ += list.size_;
}

void TriangleList::append_patch(Patch patch, std::uint32_t indices) {
    if (blocks_.empty() || blocks_.back().patches.empty() ||
        indices > kMaxBlockIndices - blocks_.back().patches.back().end) {
        blocks_.push_back({.begin = size_, .patches = {}, .listed = {}});
    }
    std::vector<Patch>& patches = blocks_.back().patches;
    patch.end = (patches.empty() ? 0 : patches.back().end) + indices;
    patches.push_back(patch);
    size_ += indices;
}

void TriangleList::append_bands(const RingCorners& low, std::uint32_t bands) {
    LSYS_CHECK(low.sides > 0 && low.sides <= kMaxPatchSides && bands <= kMaxBands, low.sides,
               bands);
    if (bands == 0) {
        return;
    }
    const std::uint32_t indices = bands * 6 * low.sides;
    const std::uint32_t behind = low.first + bands * low.columns();
    if (!blocks_.empty() && !blocks_.back().patches.empty()) {
        Patch& patch = blocks_.back().patches.back();
        if (patch.shape == Shape::Bands && patch.second == low.first && patch.sides == low.sides &&
            patch.seam == low.seam &&
            indices <= kMaxBlockIndices - patch.end) { // continues the patch
            patch.second = behind;
            patch.end += indices;
            size_ += indices;
            return;
        }
    }
    append_patch({.first = low.first,
                  .second = behind,
                  .sides = static_cast<std::uint8_t>(low.sides),
                  .seam = low.seam},
                 indices);
}

void TriangleList::append_uneven_band(const RingCorners& low, const RingCorners& high) {
    LSYS_CHECK(std::max(low.sides, high.sides) <= kMaxPatchSides && low.seam == high.seam,
               low.sides, high.sides);
    append_patch({.first = low.first,
                  .second = high.first,
                  .shape = Shape::UnevenBand,
                  .sides = static_cast<std::uint8_t>(low.sides),
                  .second_sides = static_cast<std::uint8_t>(high.sides),
                  .seam = low.seam},
                 3 * (low.sides + high.sides));
}

void TriangleList::append_fan(const RingCorners& ring,
                              std::uint32_t point,
                              bool point_per_side,
                              bool upwards) {
    LSYS_CHECK(ring.sides > 0 && ring.sides <= kMaxPatchSides, ring.sides);
    append_patch({.first = ring.first,
                  .second = point,
                  .shape = Shape::Fan,
                  .sides = static_cast<std::uint8_t>(ring.sides),
                  .seam = ring.seam,
                  .point_per_side = point_per_side,
                  .upwards = upwards},
                 3 * ring.sides);
}

void TriangleReader::fill(std::uint64_t first) {
    first_ = first;
    count_ = std::min<std::uint64_t>(buffer_.size(), list_.size() - first);
    list_.read(first, std::span(buffer_).first(count_));
}

} // namespace lsys
