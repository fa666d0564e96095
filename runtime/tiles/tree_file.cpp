// SPDX-License-Identifier: MIT
// Layout, little-endian, without gaps:
//   0  magic "lsctrees"
//   8  version            u32    12  bytes of a tree      u32
//  16  placement digest   u64    24  trees                u64
//  32  trees: x, y, z, yaw, scale binary32; number u32; species, age u16
//      checksum           u64, over header and trees
#include "runtime/tiles/tree_file.h"

#include "grammar/base/hash.h"
#include "runtime/tiles/impl/tree_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace lsys {

namespace {

static_assert(std::endian::native == std::endian::little,
              "trees are written as they are in memory");

constexpr std::string_view kMagic = "lsctrees";

struct Header {
    std::array<char, kMagic.size()> magic{};
    std::uint32_t version = kTreeFileVersion;
    std::uint32_t tree_bytes = sizeof(Tree);
    std::uint64_t placement_digest = 0;
    std::uint64_t trees = 0;
};
static_assert(sizeof(Header) == 32);
constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);

template <typename T>
std::string_view bytes_of(const T* values, std::size_t count) {
    return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

std::uint64_t checksum_of(std::string_view header, std::string_view trees) {
    constexpr std::uint64_t kInitialState = 0x6C73637472656573;
    return finish(combine_bytes(combine_bytes(kInitialState, header), trees));
}

bool fits(const Tree& tree, const TreeFileScene& scene) {
    return tree.species < scene.species && std::isfinite(tree.position.y) &&
           std::isfinite(tree.yaw) && std::isfinite(tree.scale) && tree.scale > 0.0F &&
           scene.region.contains(tree.position.x, tree.position.z);
}

} // namespace

bool write_tree_file(std::uint64_t placement_digest,
                     std::span<const Tree> trees,
                     const std::function<bool(std::string_view)>& flush) {
    Header header;
    std::copy(kMagic.begin(), kMagic.end(), header.magic.begin());
    header.placement_digest = placement_digest;
    header.trees = trees.size();
    const std::string_view head = bytes_of(&header, 1);
    const std::string_view body = bytes_of(trees.data(), trees.size());
    const std::uint64_t checksum = checksum_of(head, body);
    return flush(head) && (body.empty() || flush(body)) && flush(bytes_of(&checksum, 1));
}

Result<LargeVector<Tree>> read_tree_file(std::string_view bytes, const TreeFileScene& scene) {
    if (bytes.substr(0, kMagic.size()) != kMagic) {
        return Error{"not a file of trees; `lsc place` writes one"};
    }
    if (bytes.size() < sizeof(Header) + kChecksumBytes) {
        return Error{"the file of trees is cut off: its header is incomplete"};
    }
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.version != kTreeFileVersion || header.tree_bytes != sizeof(Tree)) {
        return Error{fmt::format("the file of trees has version {}, and this lsc reads version {}: "
                                 "place the trees again",
                                 header.version, kTreeFileVersion)};
    }
    const std::string_view body =
        bytes.substr(sizeof header, bytes.size() - sizeof header - kChecksumBytes);
    if (body.size() / sizeof(Tree) != header.trees || body.size() % sizeof(Tree) != 0) {
        return Error{fmt::format(
            "the file of trees is cut off or damaged: its header says {} trees", header.trees)};
    }
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, body.data() + body.size(), sizeof checksum);
    if (checksum != checksum_of(bytes.substr(0, sizeof header), body)) {
        return Error{"the file of trees is damaged: its checksum does not fit"};
    }
    if (header.placement_digest != scene.placement_digest) {
        return Error{"the trees were placed for another scene, or with other options: place them "
                     "again"};
    }
    LargeVector<Tree> trees;
    trees.resize(header.trees);
    if (!body.empty()) {
        std::memcpy(trees.data(), body.data(), body.size());
    }
    if (!std::all_of(trees.begin(), trees.end(),
                     [&](const Tree& tree) { return fits(tree, scene); }) ||
        !is_sorted_by_tile(TileGrid(scene.region), trees)) {
        return Error{"the file of trees is damaged: the scene has no such tree"};
    }
    return trees;
}

} // namespace lsys
