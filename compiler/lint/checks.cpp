// SPDX-License-Identifier: MIT
#include "compiler/lint/checks.h"

#include "compiler/lint/impl/lints.h"
#include "grammar/base/cancellation.h"

namespace lsys {

namespace {

struct ListedCheck {
    Check check;
    bool needs_valid; // true: run the check only if Program::is_valid
};

// Diagnostics at the same place appear in the order of this list.
constexpr ListedCheck kChecks[] = {
    {check_probability_sums, false},
    {check_formal_names, false},
    {check_ignored_contexts, false},
    {check_extra_parameters, false},
    {check_cuts, false},
    {check_branches, false},
    {check_polygons, false},
    {check_turtle_arguments, false},
    {check_foreign_habits, true},
    {check_unused_names, true},
    {check_idle_senses, true},
    {check_module_use, true},
    {check_reachable_productions, true},
    {check_conditions, true},
    {check_probabilities, true},
    {check_computed_equality, true},
    {check_branch_depth, true},
    {check_drawing, true},
    {check_undrawn_edges, true},
    {check_rolled_sides, true},
    {check_endless_stages, true},
    {check_growth, true},
};

} // namespace

void run_checks(const CheckInput& input, Diagnostics& diagnostics) {
    for (const ListedCheck& listed : kChecks) {
        stop_if_cancelled();
        if (input.program.is_valid || !listed.needs_valid) {
            listed.check(input, diagnostics);
        }
    }
}

SourceSpan module_name_span(const CheckInput& input, const ProgramWord& word, std::size_t index) {
    const ProgramModule module = input.program.modules[index];
    return module_name_span(input.sources, word.file, module.begin,
                            input.names.text(input.program.symbol(module.symbol).name),
                            input.program.written_names);
}

} // namespace lsys
