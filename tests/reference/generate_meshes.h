// SPDX-License-Identifier: MIT
// Random meshes and pictures of grammars that sense.

#pragma once

#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <string>

namespace lsys::reference {

enum class MeshUse {
    Obstacle, // of `solid`: open or closed, some faces may have reversed winding
    Crown,    // of `space`: closed
    Organ     // of `#object`: small
};

// Each adds a file to the grammar and returns its path.
std::string add_mesh(Grammar& grammar, Random& random, MeshUse use);
std::string add_picture(Grammar& grammar, Random& random);

} // namespace lsys::reference
