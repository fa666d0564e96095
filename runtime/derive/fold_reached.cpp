// SPDX-License-Identifier: MIT
#include "runtime/derive/fold_reached.h"

#include "runtime/derive/engine/eval.h"
#include "runtime/derive/engine/folded_index.h"
#include "runtime/derive/engine/shape.h"
#include "runtime/derive/engine/start.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Larger programs are not folded: folding would take more time than it saves.
constexpr std::size_t kMaxProductions = 4096;
constexpr std::uint32_t kMaxAxiomParameters = 4096;
constexpr std::uint32_t kMaxCodes = 4096;
/// Max applications of productions to modules.
constexpr std::uint64_t kMaxTrials = std::uint64_t{1} << 16;

class Folder {
public:
    /// The folded program begins with `axiom` alone.
    Folder(const Bytecode& bytecode,
           const BytecodeAxiom& axiom,
           std::vector<float> globals,
           std::uint32_t generations)
        : program_(bytecode), globals_(std::move(globals)), generations_(generations),
          index_(program_), seen_(program_.code_count(), false) {
        program_.axioms.assign(1, axiom);
        const std::uint32_t width = code_width(bytecode.code_count());
        max_codes_ = std::min(width == 1 ? 256U : 65'536U, kMaxCodes);
        by_symbol_.resize(bytecode.symbols.size());
        decompositions_.resize(bytecode.symbols.size());
        for (std::uint32_t i = 0; i < bytecode.productions.size(); ++i) {
            const BytecodeProduction& production = bytecode.productions[i];
            const SymbolId symbol = bytecode.patterns[production.predecessor.first].symbol;
            if (production.stage != Stage::Interpret) { // words of #interpret are never stored
                (production.stage == Stage::Rewrite
                     ? by_symbol_
                     : decompositions_)[static_cast<std::size_t>(symbol)]
                    .push_back(i);
            }
        }
    }

    std::optional<Bytecode> run(const std::vector<float>& axiom_parameters) {
        const Code before = program_.code_count();
        WordTemplate& axiom = program_.axioms.front().word;
        note_modules(axiom, axiom_parameters.data());
        if (!ok_) {
            return std::nullopt;
        }
        fold_axiom(axiom, axiom_parameters.data());
        decompose();
        for (std::uint32_t age = 0; age < generations_ && !next_.empty() && ok_; ++age) {
            const std::vector<Code> now = std::exchange(next_, {});
            for (const Code code : now) {
                apply(by_symbol_, code);
            }
            decompose();
        }
        const bool any = program_.code_count() > before || axiom_is_folded_;
        return ok_ && any ? std::optional(std::move(program_)) : std::nullopt;
    }

private:
    using Table = std::vector<std::vector<std::uint32_t>>; // productions by symbol

    /// Applies #decompose to the new modules until no further ones appear.
    void decompose() {
        for (std::size_t i = 0; i < next_.size() && ok_; ++i) {
            apply(decompositions_, next_[i]);
        }
    }

    /// Notes the modules that the productions can write for a module.
    void apply(const Table& table, Code code) {
        const auto symbol = static_cast<std::size_t>(program_.symbol_of(code));
        std::vector<float> own;
        if (code >= program_.symbols.size()) {
            const float* const first =
                program_.constants.data() +
                program_.folded[code - program_.symbols.size()].first_constant;
            own.assign(first, first + program_.symbols[symbol].parameter_count);
        }
        const bool own_known = own.size() == program_.symbols[symbol].parameter_count;
        for (const std::uint32_t index : table[symbol]) {
            ok_ = ok_ && ++trials_ <= kMaxTrials;
            if (!ok_) {
                return;
            }
            const BytecodeProduction& production = program_.productions[index];
            const std::uint32_t own_first =
                program_.patterns[production.predecessor.first].first_formal;
            const std::uint32_t own_end = own_first + program_.symbols[symbol].parameter_count;
            const auto reads_others = [&](std::uint32_t first) {
                return uses_formal_outside(program_, first, own_first, own_end);
            };
            const bool formals_known = own_known && own_first == 0 &&
                                       !reads_others(production.condition) &&
                                       !reads_others(production.successor.locals) &&
                                       !reads_others(production.successor.arguments);
            if (formals_known && !may_match(production, own.data())) {
                continue;
            }
            expand(production, own.data(), formals_known);
        }
    }

    [[nodiscard]] bool may_match(const BytecodeProduction& production, const float* own) const {
        if (production.condition == kNone ||
            contains(program_, production.condition, Opcode::Step)) {
            return true;
        }
        float value = 0.0F;
        EvalFault fault;
        return !evaluate(program_, production.condition, frame(own), nullptr, &value, fault) ||
               value != 0.0F;
    }

    void expand(const BytecodeProduction& production, const float* own, bool formals_known) {
        const WordTemplate& successor = production.successor;
        if (successor.parameter_count == 0) {
            note_modules(successor, nullptr);
            return;
        }
        std::vector<float> values(successor.parameter_count);
        EvalFault fault;
        const bool known = formals_known && !has_random_parameters(program_, successor) &&
                           !contains(program_, successor, Opcode::Step) &&
                           evaluate(program_, successor, frame(own), nullptr, values.data(), fault);
        note_modules(successor, known ? values.data() : nullptr);
    }

    /// Notes the modules of a template, folded if `arguments` are known.
    void note_modules(const WordTemplate& words, const float* arguments) {
        for (std::uint32_t i = 0; i < words.codes.count && ok_; ++i) {
            Code code = program_.template_codes[words.codes.first + i];
            const std::uint32_t stored = program_.stored_parameters(code);
            if (stored != 0 && arguments != nullptr) {
                code = fold(static_cast<SymbolId>(code), arguments);
                arguments += stored;
            }
            if (ok_ && !seen_[code]) {
                seen_[code] = true;
                next_.push_back(code);
            }
        }
    }

    Code fold(SymbolId symbol, const float* arguments) {
        const Code known = index_.find(symbol, arguments);
        if (known != kNone) {
            return known;
        }
        const Code code = program_.code_count();
        if (code >= max_codes_) {
            ok_ = false;
            return 0;
        }
        program_.folded.push_back({symbol, static_cast<std::uint32_t>(program_.constants.size())});
        program_.constants.insert(program_.constants.end(), arguments,
                                  arguments + program_.symbol(symbol).parameter_count);
        seen_.push_back(false);
        index_.add(code);
        return code;
    }

    /// Replaces the modules of the axiom by their folded codes.
    void fold_axiom(WordTemplate& axiom, const float* arguments) {
        axiom_is_folded_ = axiom.parameter_count != 0;
        for (std::uint32_t i = 0; i < axiom.codes.count; ++i) {
            Code& code = program_.template_codes[axiom.codes.first + i];
            const std::uint32_t stored = program_.stored_parameters(code);
            if (stored != 0) {
                code = index_.find(static_cast<SymbolId>(code), arguments);
                arguments += stored;
            }
        }
        axiom.arguments = kNone;
        axiom.parameter_count = 0;
        axiom.draw_count = 0;
    }

    [[nodiscard]] EvalFrame frame(const float* own) const {
        return {own, globals_.data(), 0.0F, static_cast<float>(generations_)};
    }

    Bytecode program_;
    std::vector<float> globals_;
    std::uint32_t generations_;
    FoldedIndex index_;
    std::vector<bool> seen_;       // by code
    std::vector<Code> next_;       // modules that occur first at the next age
    Table by_symbol_;              // productions of rewriting
    Table decompositions_;         // productions of #decompose
    std::uint32_t max_codes_ = 0;  // max codes of the folded program
    std::uint64_t trials_ = 0;     // applications of productions so far
    bool axiom_is_folded_ = false; // the axiom stored parameters before it was folded
    bool ok_ = true;               // no limit was exceeded
};

} // namespace

std::optional<Bytecode>
fold_reached(const Bytecode& bytecode, std::uint64_t seed, std::uint32_t generations) {
    const bool stores =
        std::any_of(bytecode.symbols.begin(), bytecode.symbols.end(),
                    [](const BytecodeSymbol& symbol) { return symbol.parameter_count != 0; });
    // Answers and sweeps change parameters, which a folded module does not store.
    if (!stores || bytecode.has_senses() || bytecode.has_sweeps() ||
        bytecode.settings.rewriting != RewritingMode::Parallel ||
        code_width(bytecode.code_count()) > 2 || bytecode.productions.size() > kMaxProductions ||
        chosen_axiom(bytecode, seed).word.parameter_count > kMaxAxiomParameters) {
        return std::nullopt;
    }
    std::vector<float> globals;
    std::vector<float> axiom;
    if (draw_globals(bytecode, seed, globals) || axiom_parameters(bytecode, seed, globals, axiom)) {
        return std::nullopt; // the derivation will report the error
    }
    return Folder(bytecode, chosen_axiom(bytecode, seed), std::move(globals), generations)
        .run(axiom);
}

} // namespace lsys
