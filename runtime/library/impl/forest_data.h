// SPDX-License-Identifier: MIT
// The data behind Forest and Instances of the public headers.
#pragma once

#include "runtime/forest/instance_list.h"
#include "runtime/library/impl/data.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/scene_overrides.h"

#include <lsys/forest.h>
#include <optional>
#include <string>
#include <vector>

namespace lsys::v0 {

/// The inputs of a forest. Writers of files that need other heroes or years grow the forest again
/// from these inputs.
struct ForestSource {
    std::vector<std::string> files;
    SceneOverrides overrides;
    std::optional<std::vector<Tree>> placed_trees; // unset: the scene places its trees
    Policy policy{};                               // with which the files were read
    std::vector<std::string>
        inputs{}; // paths of the files that were read, which no export replaces
};

struct LoadedForest {
    LoadedScene loaded;
    GrownForest grown;
};

struct Forest::Data {
    ForestSource source;
    LoadedForest forest;
    std::vector<Species> species;
};

struct Instances::Data {
    InstanceList list;
    std::vector<Mesh> meshes;
    std::vector<InstanceGroup> groups;
    std::uint32_t threads = 0;
};

} // namespace lsys::v0
