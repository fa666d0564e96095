// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/symbols.h"

#include "compiler/resolve/profiles.h"

#include <utility>

namespace lsys {

SymbolTable::SymbolTable(Resolution& resolution)
    : resolution_(resolution), latest_(resolution.names.count()),
      ignored_(resolution.names.count()), considered_(resolution.names.count()) {}

void SymbolTable::bind(NameId name, TurtleOperation object, std::string mesh_file) {
    bindings_[static_cast<std::uint32_t>(name)] = {object, std::move(mesh_file)};
}

void SymbolTable::set_sense(NameId name, Sense sense) {
    senses_[static_cast<std::uint32_t>(name)] = sense;
}

void SymbolTable::ignore(NameId name) {
    ignored_[index_of(name)] = true;
}

void SymbolTable::consider(NameId name) {
    considered_[index_of(name)] = true;
}

bool SymbolTable::is_ignored(NameId name) const {
    return others_ignored_ ? !considered_[index_of(name)] : ignored_[index_of(name)];
}

SymbolId SymbolTable::get(NameId name, std::uint32_t parameter_count) {
    Latest& latest = latest_[index_of(name)];
    if (latest.symbol != kNoSymbol && latest.parameter_count == parameter_count) {
        return latest.symbol;
    }
    const std::uint64_t key =
        (std::uint64_t{parameter_count} << 32) | static_cast<std::uint32_t>(name);
    const auto [found, is_new] = symbols_.try_emplace(key, kNoSymbol);
    if (is_new) {
        found->second = make(name, parameter_count);
    }
    latest = {parameter_count, found->second};
    return found->second;
}

SymbolId SymbolTable::make(NameId name, std::uint32_t parameter_count) {
    Program& program = resolution_.program;
    const std::string_view text = resolution_.text(name);
    Symbol symbol;
    symbol.name = name;
    symbol.parameter_count = parameter_count;
    symbol.kind = parameter_count == 0 ? kind_of(program.settings.turtle, text) : SymbolKind::Plain;
    symbol.ignored = is_ignored(name) && symbol.kind != SymbolKind::BranchOpen &&
                     symbol.kind != SymbolKind::BranchClose;
    const auto binding = bindings_.find(static_cast<std::uint32_t>(name));
    if (binding != bindings_.end()) {
        symbol.turtle = binding->second.object;
        symbol.mesh_file = binding->second.mesh_file;
    } else if (const TurtleCommand* command = find_turtle_command(program.settings.turtle, text)) {
        symbol.turtle = operation_of(*command, parameter_count);
    }
    if (const auto sense = senses_.find(static_cast<std::uint32_t>(name)); sense != senses_.end()) {
        symbol.sense = sense->second;
    }
    program.symbols.push_back(symbol);
    return static_cast<SymbolId>(program.symbols.size() - 1);
}

} // namespace lsys
