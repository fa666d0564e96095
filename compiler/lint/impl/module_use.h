// How each symbol of a program is used: what the checks of modules share. Made once by
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
    std::size_t index = 0; // in Program::modules
};

struct ModuleUse {
    Reachable reachable;
    /// By symbol: the first place in a word that can come about, and in any word.
    std::vector<ModuleMention> first_place;
    std::vector<ModuleMention> any_place;
    std::vector<std::uint32_t> first_production; // by symbol: that rewrites it, or kNone
    std::vector<bool> in_context;                // by symbol
    std::vector<bool> declared;                  // by symbol: #module
    std::unordered_map<std::uint32_t, std::vector<SymbolId>> by_name;
    bool draws = false; // some module that occurs draws
    /// Names about which something was said already.
    std::vector<bool> settled; // by symbol

    [[nodiscard]] const std::vector<SymbolId>& same_name(const Program& program,
                                                         SymbolId id) const {
        return by_name.at(static_cast<std::uint32_t>(program.symbol(id).name));
    }
};

/// A module that occurs, and that nothing rewrites, draws, reads or declares.
[[nodiscard]] bool is_idle(const CheckInput& input, const ModuleUse& use, SymbolId symbol);

void check_arities(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);
void check_unused_objects(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);
void check_idle_modules(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);
void check_dead_productions(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics);

} // namespace lsys
