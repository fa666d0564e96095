// SPDX-License-Identifier: MIT
// Tree files: the placed trees of a scene. With a tree file, a forest that must be placed as a
// whole is placed once, and its tiles are made by many processes. A file contains the trees in the
// order of sort_by_tile() and a digest of all that their placement depends on; tree_file.cpp
// describes the layout. Written by `lsc place`, read by `lsc tiles` and `lsc serve`.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"
#include "runtime/terrain/region.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace lsys {

inline constexpr std::uint32_t kTreeFileVersion = 1;

/// The scene that the trees in a file must belong to.
struct TreeFileScene {
    std::uint64_t placement_digest = 0; // see runtime/pipeline/forest.h
    Region region;
    std::size_t species = 0; // number of species
};

/// Passes the bytes of a tree file to `flush`, in order and in few pieces, without copying the
/// trees. Returns false as soon as `flush` does. Precondition: `trees` are sorted by
/// sort_by_tile().
[[nodiscard]] bool write_tree_file(std::uint64_t placement_digest,
                                   std::span<const Tree> trees,
                                   const std::function<bool(std::string_view)>& flush);
/// Reads a tree file. Errors: the bytes are no tree file; another version; truncated or damaged
/// bytes; trees of another scene. The message does not name the file. Throws std::bad_alloc.
[[nodiscard]] Result<LargeVector<Tree>> read_tree_file(std::string_view bytes,
                                                       const TreeFileScene& scene);

} // namespace lsys
