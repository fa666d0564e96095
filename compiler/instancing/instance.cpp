// SPDX-License-Identifier: MIT
#include "compiler/instancing/instance.h"

#include "compiler/instancing/impl/branches.h"
#include "compiler/instancing/impl/instancing_pass.h"
#include "compiler/lower/lower.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys {

std::optional<InstancedSystem> compile_instanced(Program program,
                                                 const Names& names,
                                                 const SourceMap& sources,
                                                 float rho,
                                                 Diagnostics& diagnostics) {
    const std::optional<Branches> branches = find_branches(program, names, diagnostics);
    if (!branches) {
        return std::nullopt;
    }
    if (program.settings.pipe.is_set() && rho > 0.0F && !branches->sites.empty()) {
        Diagnostic& refusal =
            diagnostics.add(DiagnosticCode::NotInstanceable, program.pipe_span,
                            "the pipe model cannot be used with instanced branches");
        refusal.notes.emplace_back("the width of a segment depends on all tips above it, "
                                   "which differ if its branches are replaced");
        refusal.help.emplace_back("let every tree be a whole hero: `rho = 0` for the species of a "
                                  "scene, `--rho 0` for all");
        return std::nullopt;
    }
    instance_branches(program, *branches, rho);
    std::optional<Bytecode> bytecode = lower(program, names, sources);
    if (!bytecode) {
        diagnostics.add(DiagnosticCode::NotInstanceable, program.axiom_span(),
                        "the instanced system is too large for its bytecode");
        return std::nullopt;
    }
    InstancedSystem system;
    system.bytecode = std::move(*bytecode);
    system.kind_count = branches->kinds.size();
    system.depends_on_vertical.push_back(false); // id 0, the axiom, is never replaced
    for (const BranchKind& kind : branches->kinds) {
        system.depends_on_vertical.push_back(kind.depends_on_vertical);
    }
    return system;
}

std::optional<std::uint64_t> list_instanced(const Program& program,
                                            const Names& names,
                                            const SourceMap& sources,
                                            float rho,
                                            const std::optional<FormPage>& page,
                                            const std::function<bool(std::string_view)>& put,
                                            Diagnostics& diagnostics) {
    const std::optional<Branches> branches = find_branches(program, names, diagnostics);
    if (!branches) {
        return std::nullopt;
    }
    std::vector<std::size_t> counts(program.productions.size(), 0);
    for (const BranchSite& site : branches->sites) {
        ++counts[site.production];
    }
    const FormPage shown = page.value_or(FormPage{});
    const auto max_count = std::max_element(counts.begin(), counts.end());
    const std::uint64_t last = last_form(max_count == counts.end() ? 0 : *max_count);
    if (shown.first > last) {
        return last;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (page || last_form(counts[i]) < shown.count) {
            continue;
        }
        const Production& production = program.productions[i];
        Diagnostic note = make_diagnostic(
            DiagnosticCode::TooManyForms, production.name_span,
            fmt::format("production `{}` has {} branches that can be taken, so 2^{} forms, of "
                        "which the first {} are listed",
                        names.text(production.name), counts[i], counts[i], shown.count));
        note.help.emplace_back(
            fmt::format("`--first {} --rows {}` lists the next ones", shown.count, shown.count));
        note.severity = Severity::Note;
        diagnostics.add(std::move(note));
    }
    list_branches(program, *branches, names, sources, rho, shown, put);
    return last;
}

} // namespace lsys
