// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/constants.h"

#include "grammar/base/contract.h"

namespace lsys {

ConstantTable::ConstantTable(Resolution& resolution)
    : resolution_(resolution), entry_of_(resolution.names.count(), kNone) {
    for (std::size_t i = 0; i < resolution.ast.statements.size(); ++i) {
        const Statement& statement = resolution.ast.statements[i];
        if (statement.kind == StatementKind::Define) {
            const DefineNode& node = resolution.ast.defines[statement.index];
            declare(node.name, node.name_span, i);
        } else if (statement.kind == StatementKind::Param) {
            const ParamNode& node = resolution.ast.params[statement.index];
            declare(node.name, node.name_span, i);
        }
    }
}

void ConstantTable::declare(NameId name, SourceSpan span, std::size_t statement) {
    std::uint32_t& entry = entry_of_[index_of(name)];
    if (entry == kNone) {
        entry = static_cast<std::uint32_t>(entries_.size());
        entries_.push_back({span, ConstantState::Later, kNone, statement});
    }
}

ConstantState ConstantTable::state(NameId name) const {
    const std::uint32_t entry = entry_of_[index_of(name)];
    if (entry == kNone) {
        return ConstantState::Unknown;
    }
    return entries_[entry].statement < visible_until_ ? entries_[entry].state
                                                      : ConstantState::Later;
}

SourceSpan ConstantTable::definition_span(NameId name) const {
    const std::uint32_t entry = entry_of_[index_of(name)];
    LSYS_CHECK(entry != kNone, index_of(name));
    return entries_[entry].span;
}

Constant& ConstantTable::constant(NameId name) {
    const std::uint32_t entry = entry_of_[index_of(name)];
    LSYS_CHECK(entry != kNone && entries_[entry].state == ConstantState::Known, index_of(name));
    return resolution_.program.constants[entries_[entry].constant];
}

void ConstantTable::define(const Constant& constant) {
    Entry& entry = entries_[entry_of_[index_of(constant.name)]];
    entry.state = ConstantState::Known;
    entry.constant = static_cast<std::uint32_t>(resolution_.program.constants.size());
    resolution_.program.constants.push_back(constant);
}

void ConstantTable::fail(NameId name) {
    entries_[entry_of_[index_of(name)]].state = ConstantState::Failed;
}

std::vector<std::string_view> ConstantTable::known_names() const {
    std::vector<std::string_view> names;
    names.reserve(resolution_.program.constants.size());
    for (const Constant& constant : resolution_.program.constants) {
        names.push_back(resolution_.text(constant.name));
    }
    return names;
}

} // namespace lsys
