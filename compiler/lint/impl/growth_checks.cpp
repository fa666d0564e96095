// SPDX-License-Identifier: MIT
// Words that exceed the limit, or stop changing, before the requested generation.
#include "compiler/growth/growth.h"
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace lsys {

namespace {

constexpr std::size_t kMaxProductions = 10'000; // larger programs are not checked

/// Whether another message says why the axiom is never rewritten.
bool is_explained(const Diagnostics& diagnostics) {
    const std::vector<Diagnostic>& all = diagnostics.all();
    return std::any_of(all.begin(), all.end(), [](const Diagnostic& diagnostic) {
        return diagnostic.code == DiagnosticCode::NeverProduced ||
               diagnostic.code == DiagnosticCode::ArityMismatch;
    });
}

void report_empty_word(const CheckInput& input,
                       std::uint32_t generation,
                       SourceSpan place,
                       Diagnostics& diagnostics) {
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::FixedPoint, place,
                        fmt::format("from generation {} on the word is empty", generation));
    for (const Production& production : input.program.productions) {
        if (production.successor.module_count == 0 && production.stage == Stage::Rewrite) {
            diagnostic.labels.push_back({production.name_span, "has an empty successor"});
            diagnostic.help.push_back(fmt::format(
                "{} erases its module: write what it becomes between the last `:` and the `;`",
                quoted(input.name(production.name))));
            return;
        }
    }
}

} // namespace

void check_growth(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    const std::uint32_t generations =
        input.options.generations.value_or(program.generations.value_or(0));
    if (input.bytecode == nullptr || program.productions.empty()) {
        return;
    }
    const bool written = !input.options.generations && program.generations;
    const SourceSpan place = written ? program.generations_span : program.axiom_span();
    const GrowthEnd growth_end =
        find_growth_end(*input.bytecode, generations, input.options.max_modules);
    if (const std::optional<GrowthLimit>& limit = growth_end.limit) {
        const Count max_modules{input.options.max_modules, false, 0.0};
        const char* bound_text = limit->exact ? "" : "at least ";
        const bool axiom = !limit->at_largest.modules.at_most(input.options.max_modules);
        const std::uint32_t next = axiom ? 0 : limit->largest_fitting + 1;
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::WordTooLarge, place,
            fmt::format("the word of generation {} has {}{} modules, more than the limit of {}",
                        next, bound_text, to_text(limit->at_next.modules), to_text(max_modules)));
        if (!axiom) {
            diagnostic.notes.push_back(fmt::format("generation {} has {}{}", limit->largest_fitting,
                                                   bound_text, to_text(limit->at_largest.modules)));
        }
        if (limit->has_requested && generations != next) {
            diagnostic.notes.push_back(fmt::format("generation {} would have {}{}", generations,
                                                   bound_text,
                                                   to_text(limit->at_requested.modules)));
        }
        if (limit->dominant != kNoProduction) {
            const Production& production =
                program.productions[static_cast<std::size_t>(limit->dominant)];
            diagnostic.labels.push_back({production.name_span, "makes the most modules"});
        }
        // No limit is higher than the largest number of 64 bits.
        const bool may_be_raised =
            limit->at_next.modules.at_most(std::numeric_limits<std::uint64_t>::max());
        if (!axiom) {
            diagnostic.help.push_back(fmt::format(
                "the largest number of generations that fits is {}{}", limit->largest_fitting,
                may_be_raised ? "; `--max-modules` raises the limit" : ""));
        } else if (may_be_raised) {
            diagnostic.help.emplace_back("`--max-modules` raises the limit");
        }
        return;
    }
    // Skip very large programs.
    if (!written || program.productions.size() > kMaxProductions) {
        return;
    }
    // Do not report a single generation without change: authors use it to see that the growth has
    // ended.
    const std::optional<FixedPoint>& fixed_point = growth_end.fixed_point;
    if (!fixed_point || fixed_point->generation + 1 >= generations) {
        return;
    }
    const std::uint32_t last = fixed_point->generation;
    if (fixed_point->is_empty) {
        report_empty_word(input, last, place, diagnostics);
    } else if (last != 0 || !is_explained(diagnostics)) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::FixedPoint, place,
                            fmt::format("from generation {} on the word stays the same", last));
        diagnostic.help.push_back(fmt::format("`#n = {};` gives the same word", last));
    }
}

} // namespace lsys
