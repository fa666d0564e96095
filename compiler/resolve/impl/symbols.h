// SPDX-License-Identifier: MIT
// The symbols of a Program by name and number of parameters, in order of first appearance.
#pragma once

#include "compiler/resolve/impl/resolution.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace lsys {

class SymbolTable {
public:
    explicit SymbolTable(Resolution& resolution);

    /// Makes modules of this name, with any number of parameters, draw `object`.
    void bind(NameId name, TurtleOperation object, std::string mesh_file);
    /// Makes modules of this name, with any number of parameters, ask an environment.
    void set_sense(NameId name, Sense sense);
    /// Makes contexts skip modules of this name, with any number of parameters.
    void ignore(NameId name);
    /// Exempts modules of this name from ignore_all_but_considered().
    void consider(NameId name);
    /// Makes contexts skip all modules except brackets and names given to consider().
    void ignore_all_but_considered() { others_ignored_ = true; }
    [[nodiscard]] bool is_ignored(NameId name) const;

    /// The symbol, made at the first call. Precondition: all calls of bind(), ignore() and
    /// consider() have been made.
    [[nodiscard]] SymbolId get(NameId name, std::uint32_t parameter_count);

private:
    struct Latest {
        std::uint32_t parameter_count = 0;
        SymbolId symbol = kNoSymbol;
    };
    struct Binding {
        TurtleOperation object = TurtleOperation::Nothing;
        std::string mesh_file;
    };
    SymbolId make(NameId name, std::uint32_t parameter_count);

    Resolution& resolution_;
    std::vector<Latest> latest_;                          // by name: the last symbol looked up
    std::unordered_map<std::uint64_t, SymbolId> symbols_; // by name and number of parameters
    std::unordered_map<std::uint32_t, Binding> bindings_; // by NameId; so are senses_
    std::unordered_map<std::uint32_t, Sense> senses_;
    std::vector<bool> ignored_; // by name: ignore() was called; considered_: consider() was
    std::vector<bool> considered_;
    bool others_ignored_ = false; // ignore_all_but_considered() was called
};

} // namespace lsys
