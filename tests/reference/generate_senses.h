// SPDX-License-Identifier: MIT
// Environments of random grammars: `#sense` statements with their meshes and pictures, and the
// modules that make a word a plant with places worth sensing.

#pragma once

#include "tests/reference/generate_expression.h"
#include "tests/reference/generate_plan.h"
#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <string>
#include <utility>
#include <vector>

namespace lsys::reference {

// Adds environments, sense modules, and modules that move and turn the turtle to a plan.
void add_senses(Plan& plan, bool letters_files, Random& random);

// An environment of a random kind, whose files are added to `grammar`. Values are near the sizes of
// random plants, a few metres.
Statement sense_statement(const std::string& name,
                          Grammar& grammar,
                          const Constants& constants,
                          Random& random);

// A length in metres, or the size of an object, and an angle in degrees. Some use one of `formals`.
Expr length_argument(const std::vector<std::string>& formals, Random& random);
Expr turn_argument(const std::vector<std::string>& formals, Random& random);

// Settings, each a key with its value, that change places or must not change them.
std::vector<std::pair<std::string, std::string>> plant_settings(Random& random);

// Adds a mesh that `#object` can draw. Returns its path.
std::string add_object_mesh(Grammar& grammar, Random& random);

} // namespace lsys::reference
