// SPDX-License-Identifier: MIT
// Lints: checks for likely mistakes, and checks of brackets. One function per topic, each in a file
// of its own; checks.cpp lists them. A lint that is not sure reports nothing: published grammars
// that work must pass without a warning.
#pragma once

#include "compiler/lint/checks.h"

namespace lsys {

// Checks of single words and productions, which also run on programs with errors.
void check_cuts(const CheckInput& input, Diagnostics& diagnostics);
void check_branches(const CheckInput& input, Diagnostics& diagnostics);
void check_polygons(const CheckInput& input, Diagnostics& diagnostics);
void check_turtle_arguments(const CheckInput& input, Diagnostics& diagnostics);

// Checks of whole programs.
void check_foreign_habits(const CheckInput& input, Diagnostics& diagnostics);
void check_unused_names(const CheckInput& input, Diagnostics& diagnostics);
void check_idle_senses(const CheckInput& input, Diagnostics& diagnostics);
void check_module_use(const CheckInput& input, Diagnostics& diagnostics);
void check_conditions(const CheckInput& input, Diagnostics& diagnostics);
void check_reachable_productions(const CheckInput& input, Diagnostics& diagnostics);
void check_probabilities(const CheckInput& input, Diagnostics& diagnostics);
void check_computed_equality(const CheckInput& input, Diagnostics& diagnostics);
void check_branch_depth(const CheckInput& input, Diagnostics& diagnostics);
void check_drawing(const CheckInput& input, Diagnostics& diagnostics);
void check_undrawn_edges(const CheckInput& input, Diagnostics& diagnostics);
void check_rolled_sides(const CheckInput& input, Diagnostics& diagnostics);
void check_endless_stages(const CheckInput& input, Diagnostics& diagnostics);
void check_growth(const CheckInput& input, Diagnostics& diagnostics);

} // namespace lsys
