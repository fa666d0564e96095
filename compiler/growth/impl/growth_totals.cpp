// SPDX-License-Identifier: MIT
#include "compiler/growth/impl/growth_totals.h"

#include "compiler/growth/impl/count_math.h"
#include "compiler/growth/impl/growth_walk.h"

#include <algorithm>
#include <utility>

namespace lsys::analysis {

namespace {

constexpr std::uint64_t kMaxWork = 5'000'000; // max number of ClassTerms summed in all generations
constexpr std::size_t kMaxClasses = 100'000;

struct Bounds {
    GenerationSize low;
    GenerationSize high;
};

GenerationSize min_of(const GenerationSize& a, const GenerationSize& b) {
    const auto pick = [](const Count& x, const Count& y) { return less(y, x) ? y : x; };
    return {pick(a.modules, b.modules), pick(a.parameters, b.parameters),
            pick(a.segments, b.segments), pick(a.bytes, b.bytes)};
}

GenerationSize max_of(const GenerationSize& a, const GenerationSize& b) {
    const auto pick = [](const Count& x, const Count& y) { return less(x, y) ? y : x; };
    return {pick(a.modules, b.modules), pick(a.parameters, b.parameters),
            pick(a.segments, b.segments), pick(a.bytes, b.bytes)};
}

template <typename Terms>
Bounds sum(const Terms& terms, const std::vector<Bounds>& values) {
    Bounds total;
    for (const ClassTerm& term : terms) {
        const Bounds& value = values[static_cast<std::size_t>(term.target)];
        add_times(total.low, value.low, term.count);
        add_times(total.high, value.high, term.count);
    }
    return total;
}

/// For each class, bounds of the size that one of its modules has after g generations; g starts at
/// 0.
class TotalsTable {
public:
    explicit TotalsTable(ModuleClasses& classes) : classes_(classes), values_(classes.count()) {
        const Bytecode& bytecode = classes.bytecode();
        for (std::uint32_t i = 0; i < values_.size(); ++i) {
            const auto id = static_cast<ClassId>(i);
            GenerationSize size = size_of(bytecode, classes.code(id));
            values_[i].high = size;
            if (classes.covers_folded()) {
                size.parameters = {};
                size.bytes.value = code_width(bytecode.code_count());
            }
            values_[i].low = size;
            all_.push_back(id);
            if (!classes.expanded(id)) {
                continue; // a class that appears only in the last requested generation
            }
            const ClassExpansion expansion = classes.expand(id, 0);
            for (const ClassOutcome& outcome : classes.outcomes(expansion.outcomes)) {
                terms_ += outcome.terms.count;
            }
        }
        if (bytecode.settings.rewriting == RewritingMode::Sequential) {
            by_rule_.resize(bytecode.rewriting_rule_count());
            std::vector<std::uint32_t> rule_of(bytecode.symbols.size(), kNone);
            for (std::uint32_t p = 0; p < bytecode.productions_of(Stage::Rewrite).count; ++p) {
                const BytecodeProduction& production = bytecode.productions[p];
                rule_of[static_cast<std::size_t>(
                    bytecode.patterns[production.predecessor.first].symbol)] = production.rule;
            }
            for (const ClassId id : all_) {
                if (const std::uint32_t rule =
                        rule_of[static_cast<std::size_t>(classes.symbol(id))];
                    rule != kNone) {
                    by_rule_[rule].push_back(id);
                }
            }
        }
    }

    [[nodiscard]] std::uint64_t terms() const { return terms_; }
    [[nodiscard]] const std::vector<Bounds>& values() const { return values_; }

    /// Advances from the sizes after g generations to those after g + 1.
    void advance() {
        if (by_rule_.empty()) {
            rewrite(all_);
        }
        for (std::size_t rule = by_rule_.size(); rule-- > 0;) {
            rewrite(by_rule_[rule]);
        }
    }

private:
    /// Replaces the sizes of these classes by those one generation later, all at once: each is the
    /// range of the sums over the outcomes of the class.
    void rewrite(const std::vector<ClassId>& ids) {
        std::vector<std::pair<ClassId, Bounds>> new_bounds;
        new_bounds.reserve(ids.size());
        for (const ClassId id : ids) {
            if (!classes_.expanded(id)) {
                continue;
            }
            const ClassExpansion expansion = classes_.expand(id, 0);
            Bounds best;
            bool first = true;
            for (const ClassOutcome& outcome : classes_.outcomes(expansion.outcomes)) {
                const Bounds here = sum(classes_.terms(outcome.terms), values_);
                best.low = first ? here.low : min_of(best.low, here.low);
                best.high = first ? here.high : max_of(best.high, here.high);
                first = false;
            }
            new_bounds.emplace_back(id, best);
        }
        for (const auto& [id, bounds] : new_bounds) {
            values_[static_cast<std::size_t>(id)] = bounds;
        }
    }

    ModuleClasses& classes_;
    std::vector<Bounds> values_; // by class: size of the modules that one module has become
    std::vector<ClassId> all_;   // all classes
    /// Classes by rule, in sequential rewriting; else empty.
    std::vector<std::vector<ClassId>> by_rule_;
    std::uint64_t terms_ = 0; // number of terms of all outcomes of expanded classes
};

} // namespace

SizeBounds bound_totals(ModuleClasses& classes, std::uint32_t generations) {
    const Bytecode& bytecode = classes.bytecode();
    const bool has_sequence_rules =
        std::any_of(bytecode.productions.begin(), bytecode.productions.end(),
                    [](const BytecodeProduction& p) { return p.predecessor.count != 1; });
    if (classes.depends_on_age() || has_sequence_rules ||
        bytecode.settings.rewriting == RewritingMode::Cyclic) {
        return {};
    }
    const ClassExpansion start = classes.start();
    if (classes.count() > kMaxClasses) {
        return {};
    }
    TotalsTable table(classes);
    std::uint64_t work = classes.count() + table.terms();
    for (const ClassOutcome& axiom : classes.outcomes(start.outcomes)) {
        work += axiom.terms.count;
    }
    if (work * (std::uint64_t{generations} + 1) > kMaxWork) {
        return {};
    }
    SizeBounds bounds;
    for (std::uint32_t g = 0;; ++g) {
        const std::span<const ClassOutcome> axioms = classes.outcomes(start.outcomes);
        Bounds word = sum(classes.terms(axioms.front().terms), table.values());
        for (const ClassOutcome& axiom : axioms.subspan(1)) {
            const Bounds other = sum(classes.terms(axiom.terms), table.values());
            word = {min_of(word.low, other.low), max_of(word.high, other.high)};
        }
        bounds.low.push_back(word.low);
        bounds.high.push_back(word.high);
        if (g == generations) {
            return bounds;
        }
        table.advance();
    }
}

} // namespace lsys::analysis
