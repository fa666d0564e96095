// SPDX-License-Identifier: MIT
// Properties of each symbol of a Houdini rule text: parameter counts, whether rules rewrite it,
// whether rules read its age. Houdini uses 0 for omitted parameters; in .lsys, modules with
// different numbers of parameters are different modules.
#pragma once

#include "grammar/dialects/houdini/session.h"

#include <cstdint>
#include <map>
#include <string_view>

namespace lsys {

struct HoudiniSymbol {
    bool is_command = false; // turtle command: an omitted parameter has its own default
    bool is_rewritten = false;
    bool has_age = false;        // one of its rules reads `g`
    std::uint64_t counts = 0;    // bit k: the axiom or a successor has the symbol with k parameters
    std::uint32_t max_count = 0; // max parameters in words and heads
};

class HoudiniSymbols {
public:
    explicit HoudiniSymbols(const HoudiniSession& session);

    /// The facts of the symbol of a module.
    [[nodiscard]] const HoudiniSymbol& symbol(const HoudiniModule& module) const;
    /// Parameters of a module, without omitted ones at the end.
    [[nodiscard]] std::uint32_t count(const HoudiniModule& module) const;
    [[nodiscard]] bool occurs(std::string_view symbol) const { return symbols_.contains(symbol); }

    /// Whether the axiom or a successor has the symbol with `count` parameters.
    [[nodiscard]] bool occurs_with(std::string_view symbol, std::uint32_t count) const {
        const auto found = symbols_.find(symbol);
        return found != symbols_.end() && (found->second.counts >> count & 1U) != 0;
    }

    static constexpr std::uint32_t kMaxParameters = 60;

private:
    /// symbol(), made at the first call.
    HoudiniSymbol& symbol_of(const HoudiniModule& module);
    /// Adds the symbols of modules with their numbers of parameters. `is_word`: of the axiom or a
    /// successor, not of a head.
    void count_symbols(const std::vector<HoudiniModule>& modules, bool is_word);
    /// Whether an expression of the rule reads the age `g`.
    [[nodiscard]] bool reads_age(const HoudiniRule& rule) const;

    const HoudiniSession& session_;
    std::map<std::string_view, HoudiniSymbol> symbols_;
};

/// Returns true when the predecessor or a context of the rule has a parameter of that name.
[[nodiscard]] bool names_parameter(const HoudiniRule& rule, std::string_view name);

} // namespace lsys
