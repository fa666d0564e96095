// SPDX-License-Identifier: MIT
#include "runtime/derive/brackets.h"

#include <algorithm>

namespace lsys {

namespace {

/// The change that a module makes to the number of open brackets closed by `close`: 1, -1 or 0.
int change_of(SymbolKind kind, SymbolKind close) {
    const SymbolKind open =
        close == SymbolKind::BranchClose ? SymbolKind::BranchOpen : SymbolKind::PolygonOpen;
    return kind == open ? 1 : kind == close ? -1 : 0;
}

/// The first axiom with a closing bracket without its partner, or nullptr.
const BytecodeAxiom* unbalanced_axiom(const Bytecode& bytecode, SymbolKind close) {
    const auto found = std::find_if(
        bytecode.axioms.begin(), bytecode.axioms.end(), [&](const BytecodeAxiom& axiom) {
            return has_unmatched_close(bytecode, axiom.word.codes, close);
        });
    return found == bytecode.axioms.end() ? nullptr : &*found;
}

} // namespace

bool has_unmatched_close(const Bytecode& bytecode, TableRange codes, SymbolKind close) {
    std::int64_t depth = 0;
    for (std::uint32_t i = codes.first; i < codes.first + codes.count; ++i) {
        const SymbolKind kind =
            bytecode.symbol(bytecode.symbol_of(bytecode.template_codes[i])).kind;
        depth += change_of(kind, close);
        if (depth < 0) {
            return true;
        }
    }
    return false;
}

bool rewrites_bracket(const Bytecode& bytecode, const BytecodeProduction& production) {
    for (std::uint32_t i = 0; i < production.predecessor.count; ++i) {
        const PatternItem& item = bytecode.patterns[production.predecessor.first + i];
        if (bytecode.symbol(item.symbol).kind != SymbolKind::Plain) {
            return true;
        }
    }
    return false;
}

BracketCounter::BracketCounter(const Bytecode& bytecode) {
    changes_.reserve(bytecode.code_count());
    branch_changes_.reserve(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        const BytecodeSymbol& symbol = bytecode.symbol(bytecode.symbol_of(code));
        Change change;
        change.branches = static_cast<std::int8_t>(change_of(symbol.kind, SymbolKind::BranchClose));
        change.polygons =
            static_cast<std::int8_t>(change_of(symbol.kind, SymbolKind::PolygonClose));
        change.cuts = symbol.turtle == TurtleOperation::Cut;
        has_branch_close_ = has_branch_close_ || change.branches < 0;
        has_polygon_close_ = has_polygon_close_ || change.polygons < 0;
        changes_.push_back(change);
        branch_changes_.push_back(change.branches);
    }
}

ProductionId only_unbalanced_production(const Bytecode& bytecode, SymbolKind close) {
    if (unbalanced_axiom(bytecode, close) != nullptr) {
        return kNoProduction;
    }
    ProductionId found = kNoProduction;
    for (std::uint32_t i = 0; i < bytecode.productions.size(); ++i) {
        if (bytecode.productions[i].stage == Stage::Interpret) {
            break; // #interpret and later stages write no brackets
        }
        if (rewrites_bracket(bytecode, bytecode.productions[i])) {
            return kNoProduction;
        }
        if (has_unmatched_close(bytecode, bytecode.productions[i].successor.codes, close)) {
            if (found != kNoProduction) {
                return kNoProduction;
            }
            found = static_cast<ProductionId>(i);
        }
    }
    return found;
}

RuntimeError
unmatched_bracket(const Bytecode& bytecode, Code code, std::uint64_t position, std::uint32_t age) {
    RuntimeError error;
    error.kind = RuntimeErrorKind::Unbalanced;
    error.symbol = bytecode.symbol_of(code);
    const SymbolKind close = bytecode.symbol(error.symbol).kind;
    error.production = only_unbalanced_production(bytecode, close);
    const BytecodeAxiom* const axiom = unbalanced_axiom(bytecode, close);
    error.site = error.production == kNoProduction
                     ? (axiom != nullptr ? *axiom : bytecode.axioms.front()).site
                     : bytecode.productions[static_cast<std::size_t>(error.production)].name_site;
    error.generation = age;
    error.position = position;
    return error;
}

} // namespace lsys
