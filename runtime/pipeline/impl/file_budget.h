// The memory that a run may use for what it reads from files: maps, meshes and their pictures,
// which are decoded once. Made for each run; read and counted down by what reads the files.
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

    /// Counts bytes that are held from now on.
    void take(std::uint64_t bytes) { left -= std::min(bytes, left); }
    /// Counts bytes that were taken and are held no more.
    void give_back(std::uint64_t bytes) { left += bytes; }
};

} // namespace lsys
