// SPDX-License-Identifier: MIT
#include "runtime/derive/impl/explain_module.h"

#include "runtime/base/random.h"
#include "runtime/derive/engine/glibc_rule_draws.h"
#include "runtime/derive/impl/traced_expression.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lsys {

namespace {

Stage stage_of(DerivationPass::Kind kind) {
    switch (kind) {
    case DerivationPass::Kind::Decompose:
        return Stage::Decompose;
    case DerivationPass::Kind::Interpret:
        return Stage::Interpret;
    case DerivationPass::Kind::Down:
        return Stage::Down;
    case DerivationPass::Kind::Up:
        return Stage::Up;
    case DerivationPass::Kind::Cut:
    case DerivationPass::Kind::Sense:
    case DerivationPass::Kind::Rewrite:
        break;
    }
    return Stage::Rewrite;
}

class Explainer {
public:
    Explainer(const TracedPass& pass, std::uint64_t position)
        : pass_(pass), bytecode_(pass.bytecode), position_(position) {
        trace_.kind = pass.facts.kind;
        trace_.rule = pass.facts.rule;
        trace_.pass = pass.facts.number;
        trace_.generation = pass.facts.generation;
        trace_.position = position;
        trace_.module = pass.word.module(position);
    }

    ModuleTrace run(const std::vector<std::uint32_t>& productions) {
        for (const std::uint32_t production : productions) {
            if (!attempt(production)) {
                trace_.fate = Fate::Failed;
                return std::move(trace_);
            }
        }
        if (!compute_weights()) {
            trace_.fate = Fate::Failed;
            return std::move(trace_);
        }
        if (matching_.size() > 1) {
            choose();
        }
        if (!matching_.empty()) {
            write(trace_.attempts[matching_[taken_]]);
        } else {
            trace_.written = {trace_.module};
        }
        return std::move(trace_);
    }

private:
    [[nodiscard]] const BytecodeProduction& production(std::uint32_t index) const {
        return bytecode_.productions[index];
    }
    [[nodiscard]] const BytecodeProduction& production_of(const Attempt& attempt) const {
        return production(static_cast<std::uint32_t>(attempt.production));
    }
    [[nodiscard]] SymbolId pattern_symbol(TableRange pattern, std::uint32_t item) const {
        return bytecode_.patterns[pattern.first + item].symbol;
    }

    /// Tries a production. Returns false if its condition has no valid value.
    bool attempt(std::uint32_t index) {
        const BytecodeProduction& tried = production(index);
        const SymbolId head = pattern_symbol(tried.predecessor, 0);
        const BytecodeSymbol& own = bytecode_.symbol(trace_.module.symbol);
        if (head != trace_.module.symbol && bytecode_.symbol(head).name != own.name) {
            ++trace_.other_names;
            return true;
        }
        Attempt& attempt = trace_.attempts.emplace_back();
        attempt.production = static_cast<ProductionId>(index);
        if (head != trace_.module.symbol) {
            attempt.verdict = Verdict::OtherCount;
            return true;
        }
        if (pass_.facts.rule != kNone && tried.rule != pass_.facts.rule) {
            attempt.verdict = Verdict::OtherRule;
            return true;
        }
        if (!matching_.empty()) {
            const BytecodeProduction& first = production_of(trace_.attempts[matching_[0]]);
            if (!first.stochastic || !tried.stochastic || tried.group != first.group) {
                attempt.verdict = Verdict::NotTried;
                return true;
            }
        }
        if (!match_neighbours(tried, attempt)) {
            return true;
        }
        if (tried.condition != kNone) {
            attempt.condition = trace_condition(frame_of(attempt), tried.condition);
            if (!attempt.condition->is_finite) {
                attempt.verdict = Verdict::Fault;
                return false;
            }
            if (attempt.condition->value == 0.0F) {
                attempt.verdict = Verdict::Condition;
                return true;
            }
        }
        attempt.verdict = matching_.empty() ? Verdict::Applies : Verdict::NotDrawn;
        matching_.push_back(trace_.attempts.size() - 1);
        return true;
    }

    /// Matches the modules of the predecessor after the first one, and the contexts. Stores the
    /// visited modules and, if something differs, the verdict in `attempt`.
    bool match_neighbours(const BytecodeProduction& tried, Attempt& attempt) const {
        for (std::uint32_t i = 1; i < tried.predecessor.count; ++i) {
            const std::uint64_t at = position_ + i;
            if (at < pass_.word.count()) {
                attempt.predecessor.push_back({at, i, pass_.word.module(at)});
            }
            if (at >= pass_.word.count() ||
                pass_.word.symbol(at) != pattern_symbol(tried.predecessor, i)) {
                attempt.verdict = Verdict::Predecessor;
                return false;
            }
        }
        if (tried.has_left) {
            attempt.left = pass_.neighbours.left(tried, position_);
            if (attempt.left.end != ContextEnd::Fits) {
                attempt.verdict = Verdict::LeftContext;
                return false;
            }
        }
        if (tried.has_right) {
            attempt.right = pass_.neighbours.right(tried, position_ + tried.predecessor.count);
            if (attempt.right.end != ContextEnd::Fits) {
                attempt.verdict = Verdict::RightContext;
                return false;
            }
        }
        return true;
    }

    /// The inputs of the expressions of an attempt; `formals_` holds the values of the formals.
    TracedFrame frame_of(const Attempt& attempt) {
        const BytecodeProduction& tried = production_of(attempt);
        formals_.assign(std::max(tried.formal_count, 1U), 0.0F);
        const auto bind = [&](TableRange pattern, std::uint32_t item, const TracedModule& module) {
            std::copy(module.values.begin(), module.values.end(),
                      formals_.begin() + bytecode_.patterns[pattern.first + item].first_formal);
        };
        bind(tried.predecessor, 0, trace_.module);
        for (const VisitedModule& visited : attempt.predecessor) {
            bind(tried.predecessor, visited.item, visited.module);
        }
        for (const VisitedModule& visited : attempt.left.visited) {
            bind(tried.left, visited.item, visited.module);
        }
        for (const VisitedModule& visited : attempt.right.visited) {
            bind(tried.right, visited.item, visited.module);
        }
        const auto index = static_cast<std::size_t>(attempt.production);
        const std::vector<ProductionNames>& names = pass_.inputs.names;
        return {bytecode_,
                {formals_.data(), pass_.inputs.globals.data(),
                 static_cast<float>(pass_.facts.generation), pass_.inputs.steps},
                index < names.size() ? &names[index] : nullptr};
    }

    /// Computes the weights of the matching productions, and drops productions whose computed
    /// weight is 0. Returns false if a weight is invalid.
    bool compute_weights() {
        weights_.clear();
        if (matching_.empty() || !production_of(trace_.attempts[matching_[0]]).stochastic) {
            return true;
        }
        std::vector<std::size_t> kept;
        float sum = 0.0F;
        for (const std::size_t i : matching_) {
            Attempt& attempt = trace_.attempts[i];
            const BytecodeProduction& each = production_of(attempt);
            float weight = each.weight;
            if (each.weight_code != kNone) {
                attempt.weight = trace_condition(frame_of(attempt), each.weight_code);
                weight = attempt.weight->value;
                if (!attempt.weight->is_finite || weight < 0.0F || !std::isfinite(sum + weight)) {
                    attempt.verdict = Verdict::Fault;
                    return false;
                }
            }
            sum += weight;
            if (each.weight_code != kNone && weight == 0.0F) {
                attempt.verdict = Verdict::NoWeight;
                continue;
            }
            kept.push_back(i);
            weights_.push_back(weight);
        }
        matching_ = std::move(kept);
        if (matching_.size() == 1) {
            trace_.attempts[matching_[0]].verdict = Verdict::Applies;
        }
        return true;
    }

    /// The choice among the matching productions, whose weights are known.
    void choose() {
        ChoiceTrace& choice = trace_.choice.emplace();
        choice.rule = production_of(trace_.attempts[matching_[0]]).rule;
        choice.by_generation = bytecode_.settings.choice == ChoiceScope::Generation;
        draw(choice);
        float sum = 0.0F;
        for (std::size_t i = 0; i < matching_.size(); ++i) {
            choice.alternatives.push_back(
                {trace_.attempts[matching_[i]].production, weights_[i], 0.0F});
            sum += weights_[i];
        }
        float cumulative = 0.0F;
        taken_ = choice.alternatives.size();
        for (std::size_t i = 0; i < choice.alternatives.size(); ++i) {
            ChoiceTrace::Alternative& alternative = choice.alternatives[i];
            cumulative += alternative.weight / sum;
            alternative.cumulative = cumulative;
            if (taken_ == choice.alternatives.size() && cumulative > choice.unit) {
                taken_ = i;
            }
        }
        taken_ = std::min(taken_, choice.alternatives.size() - 1);
        choice.taken = taken_;
        for (std::size_t i = 0; i < matching_.size(); ++i) {
            trace_.attempts[matching_[i]].verdict =
                i == taken_ ? Verdict::Applies : Verdict::NotDrawn;
        }
    }

    void draw(ChoiceTrace& choice) const {
        const std::uint64_t seed = pass_.inputs.seed;
        const std::uint32_t generation = pass_.facts.generation;
        if (!choice.by_generation) {
            choice.number = pass_.facts.first_draw;
            choice.position = position_;
            choice.unit = DrawSource(seed, generation, position_).draw(choice.number);
            return;
        }
        choice.by_glibc = bytecode_.settings.random == RandomSource::Glibc;
        if (choice.by_glibc) {
            choice.number = std::uint64_t{generation} * bytecode_.rule_count + choice.rule;
            choice.unit = GlibcRuleDraws(bytecode_, seed).draw(choice.rule, generation);
            return;
        }
        choice.position = ~std::uint64_t{0} - choice.rule;
        choice.unit = unit_interval(draw_block(seed, generation, choice.position, 0)[0]);
    }

    void write(const Attempt& taken) {
        const BytecodeProduction& applied = production_of(taken);
        trace_.production = taken.production;
        trace_.replaced = applied.predecessor.count;
        const bool draws_choice =
            applied.stochastic && bytecode_.settings.choice == ChoiceScope::Module;
        const std::uint64_t first = pass_.facts.first_draw + (draws_choice ? 1 : 0);
        const RangeDraws draws =
            RangeDraws::of_module(pass_.inputs.seed, pass_.facts.generation, position_, first);
        SuccessorTrace successor =
            trace_successor(frame_of(taken), applied.successor, draws, first);
        trace_.locals = std::move(successor.locals);
        trace_.ranges = std::move(successor.ranges);
        trace_.fault = std::move(successor.fault);
        trace_.fate = trace_.fault.empty() ? Fate::Rewritten : Fate::Failed;
        if (trace_.fate == Fate::Failed) {
            return;
        }
        const float* next = successor.arguments.data();
        for (std::uint32_t i = 0; i < applied.successor.codes.count; ++i) {
            const Code code = bytecode_.template_codes[applied.successor.codes.first + i];
            TracedModule& module = trace_.written.emplace_back();
            module.symbol = bytecode_.symbol_of(code);
            const std::uint32_t count = bytecode_.symbol(module.symbol).parameter_count;
            if (code < bytecode_.symbols.size()) {
                module.values.assign(next, next + count);
                next += count;
            } else {
                const float* const constants =
                    bytecode_.constants.data() +
                    bytecode_.folded[code - bytecode_.symbols.size()].first_constant;
                module.values.assign(constants, constants + count);
            }
        }
    }

    const TracedPass& pass_;
    const Bytecode& bytecode_;
    std::uint64_t position_;
    ModuleTrace trace_;
    std::vector<std::size_t> matching_; // indexes in ModuleTrace::attempts
    std::vector<float> weights_;        // by index in matching_; empty without weights
    std::size_t taken_ = 0;             // index in matching_
    std::vector<float> formals_;
};

} // namespace

std::vector<std::uint32_t> productions_of_pass(const Bytecode& bytecode,
                                               const DerivationPass& facts) {
    std::vector<std::uint32_t> productions;
    const TableRange stage = bytecode.productions_of(stage_of(facts.kind));
    const bool alone = bytecode.settings.rewriting == RewritingMode::Sequential;
    for (std::uint32_t i = stage.first; i < stage.first + stage.count; ++i) {
        // In sequential rewriting the other rules have passes of their own.
        if (!alone || facts.rule == kNone || bytecode.productions[i].rule == facts.rule) {
            productions.push_back(i);
        }
    }
    return productions;
}

ModuleTrace explain_module(const TracedPass& pass,
                           const std::vector<std::uint32_t>& productions,
                           std::uint64_t position) {
    return Explainer(pass, position).run(productions);
}

} // namespace lsys
