// SPDX-License-Identifier: MIT
// TriangleList: the compressed indices of a mesh, three per triangle. Regular triangles are stored
// as bands between rings, and as fans. Plain indices of a tube take as much memory as its positions
// and normals; bands take a few bytes per axis. This saves time, because writing memory is most of
// the cost of a large mesh.
#pragma once

#include "runtime/base/large_vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

/// Consecutive vertices of a ring from vertex `first` on. With a seam, where the texture begins and
/// ends, there is one vertex more than sides; without a seam, the last side ends at the first
/// vertex.
struct RingCorners {
    std::uint32_t first = 0;
    std::uint32_t sides = 0; // at most 255
    bool seam = false;

    [[nodiscard]] std::uint32_t columns() const { return sides + (seam ? 1U : 0U); }
};

class TriangleList {
public:
    TriangleList() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): indices are a list of triangles
    TriangleList(LargeVector<std::uint32_t> indices) { append(std::move(indices)); }
    TriangleList(std::initializer_list<std::uint32_t> indices);

    /// Number of indices.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] std::uint64_t byte_count() const;

    /// Slow; for many indices use TriangleReader, read() or expanded().
    [[nodiscard]] std::uint32_t operator[](std::uint64_t index) const;
    /// Copies the indices from `first` on. Precondition: first + to.size() <= size().
    void read(std::uint64_t first, std::span<std::uint32_t> to) const;
    /// All indices as a plain list.
    [[nodiscard]] LargeVector<std::uint32_t> expanded() const;
    /// Compares indices, however they are stored.
    friend bool operator==(const TriangleList& a, const TriangleList& b);

    void push_back(std::uint32_t index);
    /// Appends a list of three indices per triangle.
    void append(LargeVector<std::uint32_t> indices);
    /// Appends `list`, with `first_vertex` added to its indices.
    void append(TriangleList list, std::uint32_t first_vertex);

    /// Appends two triangles per side between consecutive rings, `bands` + 1 rings from `low` on.
    void append_bands(const RingCorners& low, std::uint32_t bands);
    /// Appends the triangles between two rings with different numbers of sides.
    void append_uneven_band(const RingCorners& low, const RingCorners& high);
    /// Appends a triangle from each side of a ring to vertex `point`, or with `point_per_side` to
    /// the vertices from `point` on. `upwards`: the ring is counter-clockwise seen from the point.
    void
    append_fan(const RingCorners& ring, std::uint32_t point, bool point_per_side, bool upwards);

private:
    enum class Shape : std::uint8_t { Bands, UnevenBand, Fan };

    /// Triangles of one shape in a regular order.
    struct Patch {
        std::uint32_t end = 0;    // end of its indices, counted within the block
        std::uint32_t first = 0;  // first vertex of the ring, or of the lowest ring of bands
        std::uint32_t second = 0; // first vertex of the other or last ring; of a fan: the point
        Shape shape = Shape::Bands;
        std::uint8_t sides = 0;
        std::uint8_t second_sides = 0;
        bool seam : 1 = false;
        bool point_per_side : 1 = false;
        bool upwards : 1 = false;
    };

    /// Patches, or plain indices.
    struct Block {
        std::uint64_t begin = 0;        // number of the block's first index
        std::uint32_t first_vertex = 0; // added to all vertices of the block
        std::vector<Patch> patches;
        LargeVector<std::uint32_t> listed; // plain indices; empty if there are patches

        [[nodiscard]] std::uint64_t size() const {
            return patches.empty() ? listed.size() : patches.back().end;
        }
    };
    struct Pattern;

    /// Writes all indices of a patch that is a fan or an uneven band.
    static void write_whole_patch(const Patch& patch, std::uint32_t vertex, std::uint32_t* to);
    /// read() within the patches of one block.
    static void read_patches(const Block& block,
                             std::uint64_t first,
                             std::span<std::uint32_t> to,
                             Pattern& pattern);
    void append_patch(Patch patch, std::uint32_t indices); // `indices`: number of its indices

    std::vector<Block> blocks_; // none of them empty
    std::uint64_t size_ = 0;
};

/// Calls visit(first, indices) for chunks of indices that fit into a cache, in order. `first`:
/// number of the first index.
template <typename Visit>
void for_each_chunk(const TriangleList& list, const Visit& visit) {
    constexpr std::uint64_t kMax = 24576;
    std::vector<std::uint32_t> chunk(std::min(kMax, list.size()));
    for (std::uint64_t first = 0; first < list.size(); first += kMax) {
        const std::span<std::uint32_t> part =
            std::span(chunk).first(std::min(kMax, list.size() - first));
        list.read(first, part);
        visit(first, std::span<const std::uint32_t>(part));
    }
}

/// Random access to the indices of a TriangleList, fast for nearly sequential reads: expands up to
/// 3,072 indices at a time.
class TriangleReader {
public:
    explicit TriangleReader(const TriangleList& list) : list_(list) {}

    [[nodiscard]] std::uint32_t operator[](std::uint64_t index) {
        if (index - first_ >= count_) {
            fill(index);
        }
        return buffer_[index - first_];
    }

private:
    void fill(std::uint64_t first); // expands indices from `first` on

    const TriangleList& list_;
    std::uint64_t first_ = 0; // number of the index in buffer_[0]
    std::uint64_t count_ = 0; // number of indices in buffer_
    std::array<std::uint32_t, 3072> buffer_;
};

} // namespace lsys
