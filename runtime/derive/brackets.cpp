#include "runtime/derive/brackets.h"

namespace lsys {

bool has_unmatched_close(const Bytecode& bytecode, TableRange codes) {
    std::int64_t depth = 0;
    for (std::uint32_t i = codes.first; i < codes.first + codes.count; ++i) {
        const SymbolKind kind =
            bytecode.symbol(bytecode.symbol_of(bytecode.template_codes[i])).kind;
        depth += kind == SymbolKind::BranchOpen ? 1 : kind == SymbolKind::BranchClose ? -1 : 0;
        if (depth < 0) {
            return true;
        }
    }
    return false;
}

bool rewrites_bracket(const Bytecode& bytecode, const BytecodeProduction& production) {
    for (std::uint32_t i = 0; i < production.predecessor.count; ++i) {
        const PatternItem& item = bytecode.patterns[production.predecessor.first + i];
        const SymbolKind kind = bytecode.symbol(item.symbol).kind;
        if (kind == SymbolKind::BranchOpen || kind == SymbolKind::BranchClose) {
            return true;
        }
    }
    return false;
}

BracketCounter::BracketCounter(const Bytecode& bytecode) {
    change_.reserve(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        const SymbolKind kind = bytecode.symbol(bytecode.symbol_of(code)).kind;
        has_close_ = has_close_ || kind == SymbolKind::BranchClose;
        const int change = kind == SymbolKind::BranchOpen    ? 1
                           : kind == SymbolKind::BranchClose ? -1
                                                             : 0;
        change_.push_back(static_cast<std::int8_t>(change));
    }
}

/// The first axiom with a `]` without its `[`, or nullptr.
const BytecodeAxiom* unbalanced_axiom(const Bytecode& bytecode) {
    const auto found = std::find_if(bytecode.axioms.begin(), bytecode.axioms.end(),
                                    [&](const BytecodeAxiom& axiom) {
                                        return has_unmatched_close(bytecode, axiom.word.codes);
                                    });
    return found == bytecode.axioms.end() ? nullptr : &*found;
}

ProductionId only_unbalanced_production(const Bytecode& bytecode) {
    if (unbalanced_axiom(bytecode) != nullptr) {
        return kNoProduction;
    }
    ProductionId found = kNoProduction;
    for (std::uint32_t i = 0; i < bytecode.productions.size(); ++i) {
        if (bytecode.productions[i].stage == Stage::Interpret) {
            break; // writes no word
        }
        if (rewrites_bracket(bytecode, bytecode.productions[i])) {
            return kNoProduction;
        }
        if (has_unmatched_close(bytecode, bytecode.productions[i].successor.codes)) {
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
    error.production = only_unbalanced_production(bytecode);
    const BytecodeAxiom* const axiom = unbalanced_axiom(bytecode);
    error.site = error.production == kNoProduction
                     ? (axiom != nullptr ? *axiom : bytecode.axioms.front()).site
                     : bytecode.productions[static_cast<std::size_t>(error.production)].name_site;
    error.generation = age;
    error.position = position;
    error.symbol = bytecode.symbol_of(code);
    return error;
}

} // namespace lsys
