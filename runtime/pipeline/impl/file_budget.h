// FileBudget: the memory that a run may still use for maps, meshes and their pictures, which are
// decoded once. Made per run; counted down by the readers of files.
#pragma once

#include "runtime/meshing/texture.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace lsys {

struct FileBudget {
    std::uint64_t left = 0;                                           // bytes
    std::map<std::string, std::shared_ptr<const Texture>> pictures{}; // by path

    /// Counts bytes held from now on.
    void take(std::uint64_t bytes) { left -= std::min(bytes, left); }
    /// Returns bytes that are no longer held.
    void give_back(std::uint64_t bytes) { left += bytes; }
};

} // namespace lsys
