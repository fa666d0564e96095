// SPDX-License-Identifier: MIT
// FileBudget: the memory that a run may still use for maps, meshes and pictures, and the pictures
// decoded so far. One per run; readers of files count it down.
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

    /// Call when `bytes` bytes have been allocated.
    void take(std::uint64_t bytes) { left -= std::min(bytes, left); }
    /// Call when `bytes` bytes have been freed.
    void give_back(std::uint64_t bytes) { left += bytes; }
};

} // namespace lsys
