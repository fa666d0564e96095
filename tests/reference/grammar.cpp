// SPDX-License-Identifier: MIT
#include "tests/reference/grammar.h"

namespace lsys::reference {

namespace {

void collect(const Grammar& grammar, std::size_t file, std::vector<const Statement*>& out) {
    for (const Statement& statement : grammar.files[file].statements) {
        if (statement.kind == StatementKind::IncludeFile) {
            collect(grammar, statement.file, out);
        } else {
            out.push_back(&statement);
        }
    }
}

// Names are separated by back quotes, the only printable character that a name cannot have.
std::string shape_of(const Pattern& pattern) {
    std::string shape;
    for (const ModulePattern& module : pattern) {
        shape += module.name + "`" + std::to_string(module.formals.size()) + "`";
    }
    return shape;
}

} // namespace

std::vector<const Statement*> statements_in_order(const Grammar& grammar) {
    std::vector<const Statement*> out;
    collect(grammar, 0, out);
    return out;
}

bool is_sense_name(const std::string& name) {
    return name.size() > 1 && name[0] == '?';
}

std::optional<std::string> setting(const Grammar& grammar, const std::string& key) {
    for (const Statement* statement : statements_in_order(grammar)) {
        if (statement->kind == StatementKind::Set && statement->name == key) {
            return statement->text;
        }
    }
    return std::nullopt;
}

// Prefix of rules and groups: productions of different stages are never in one group or rule.
static std::string stage_of(const Production& production) {
    return production.stage == Stage::Rewrite     ? ""
           : production.stage == Stage::Decompose ? "`decompose`"
           : production.stage == Stage::Interpret ? "`interpret`"
           : production.stage == Stage::Down      ? "`down`"
                                                  : "`up`";
}

std::string group_of(const Production& production) {
    std::string group = stage_of(production);
    if (production.left) {
        group += shape_of(*production.left) + "`left`";
    }
    group += shape_of(production.predecessor);
    if (production.right) {
        group += "`right`" + shape_of(*production.right);
    }
    return group;
}

std::string rule_of(const Production& production) {
    return stage_of(production) + shape_of(production.predecessor);
}

} // namespace lsys::reference
