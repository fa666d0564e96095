// The checks of what a grammar may say but hardly means, and of brackets. One function a topic,
// each in a file of its own; checks.cpp lists them. They keep quiet when in doubt: what is
// published and works must pass without a warning.
#pragma once

#include "compiler/lint/checks.h"

namespace lsys {

// One word or production at a time; these also look at programs with errors.
void check_cuts(const CheckInput& input, Diagnostics& diagnostics);
void check_branches(const CheckInput& input, Diagnostics& diagnostics);
void check_polygons(const CheckInput& input, Diagnostics& diagnostics);
void check_turtle_arguments(const CheckInput& input, Diagnostics& diagnostics);

// The whole program.
void check_unused_names(const CheckInput& input, Diagnostics& diagnostics);
void check_module_use(const CheckInput& input, Diagnostics& diagnostics);
void check_conditions(const CheckInput& input, Diagnostics& diagnostics);
void check_reachable_productions(const CheckInput& input, Diagnostics& diagnostics);
void check_probabilities(const CheckInput& input, Diagnostics& diagnostics);
void check_computed_equality(const CheckInput& input, Diagnostics& diagnostics);
void check_branch_depth(const CheckInput& input, Diagnostics& diagnostics);
void check_drawing(const CheckInput& input, Diagnostics& diagnostics);
void check_growth(const CheckInput& input, Diagnostics& diagnostics);

} // namespace lsys
