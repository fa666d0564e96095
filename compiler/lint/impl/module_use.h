// SPDX-License-Identifier: MIT
// The use of each symbol of a program, shared by the checks of modules. Made once by
// check_module_use().
#pragma once

#include "compiler/lint/checks.h"
#include "compiler/lint/impl/reachable.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace lsys {

/// A module in the axiom or in a successor.
struct ModuleMention {
    const ProgramWord* word = nullptr;
    std::size_t index = 0; // index in Program::modules
};

struct ModuleUse {
    Reachable reachable;
    /// Per symbol: the first place in an axiom or in the successor of a usable production, and the
    /// first place in any word. A null `word` means no place.
    std::vector<ModuleMention> first_place;
    std::vector<ModuleMention> any_place;
    std::vector<std::uint32_t> first_production; // per symbol: the first that rewrites it, or kNone
    std::vector<bool> in_context;                // per symbol: some context names it
    std::vector<bool> declared;                  // per symbol: a #module declares it
    std::unordered_map<std::uint32_t, std::vector<SymbolId>> by_name; // by NameId
    bool draws = false;         // some module that occurs draws
    std::vector<bool> reported; // per symbol: a message about its name has been reported

    /// The symbols with the name of `id`, one for each number of parameters; `id` is one of them.
    [[nodiscard]] const std::vector<SymbolId>& same_name(const Program& program,
                                                         SymbolId id) const {
        return by_name.at(static_cast<std::uint32_t>(program.symbol(id).name));
    }
};

/// Whether the module occurs but is not rewritten, drawn, named in a context or declared.
[[nodiscard]] bool is_idle(const CheckInput& input, const ModuleUse& use, SymbolId symbol);

void check_arities(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);
void check_unused_objects(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);
void check_idle_modules(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);
void check_dead_productions(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);

} // namespace lsys
