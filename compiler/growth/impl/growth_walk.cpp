// SPDX-License-Identifier: MIT
#include "compiler/growth/impl/growth_walk.h"

#include "compiler/growth/impl/count_math.h"
#include "grammar/base/contract.h"
#include "grammar/base/exponentials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lsys::analysis {

namespace {

std::uint64_t low_64_bits(const Count& count) {
    return count.value.low;
}

Count count_of(std::uint64_t value) {
    return {value, false, 0.0};
}

/// a - b, at least 0. Counts above 2^128 - 1 are logarithms, which hide small differences: the
/// result is 0 if b is a logarithm, and a if only a is a logarithm.
Count subtract(const Count& a, const Count& b) {
    if (is_zero(b)) {
        return a;
    }
    if (b.exceeds || (!a.exceeds && a.value <= b.value)) {
        return {};
    }
    return a.exceeds ? a : Count{a.value - b.value, false, 0.0};
}

double as_double(const Count& count) {
    return count.exceeds ? power_of_two(std::min(count.log2, 1000.0)) : to_double(count.value);
}

} // namespace

bool same(const Count& a, const Count& b) {
    return a.exceeds == b.exceeds && (a.exceeds ? a.log2 == b.log2 : a.value == b.value);
}

bool same(const GenerationSize& a, const GenerationSize& b) {
    return same(a.modules, b.modules) && same(a.parameters, b.parameters) &&
           same(a.segments, b.segments) && same(a.bytes, b.bytes);
}

bool less(const Count& a, const Count& b) {
    if (a.exceeds || b.exceeds) {
        return a.approximate_log2() < b.approximate_log2();
    }
    return a.value < b.value;
}

GenerationSize size_of(const Bytecode& bytecode, Code code) {
    const std::uint32_t stored = bytecode.stored_parameters(code);
    const bool visible = draws(bytecode.symbol(bytecode.symbol_of(code)).turtle);
    return {count_of(1), count_of(stored), count_of(visible ? 1 : 0),
            count_of(code_width(bytecode.code_count()) + 4ULL * stored)};
}

GrowthWalk::GrowthWalk(ModuleClasses& classes) : classes_(&classes) {
    const ClassExpansion start = classes.start();
    reserve_counts();
    for (const ClassTerm& term : classes.terms(start.high)) {
        add_present(term.target);
        high_[static_cast<std::size_t>(term.target)] = count_of(term.count);
    }
    for (const ClassTerm& term : classes.terms(start.low)) {
        low_[static_cast<std::size_t>(term.target)] = count_of(term.count);
    }
    for (const ClassOutcome& outcome : classes.outcomes(start.outcomes)) {
        for (const ClassTerm& term : classes.terms(outcome.terms)) {
            expected_[static_cast<std::size_t>(term.target)] += outcome.probability * term.count;
        }
    }
    if (classes.bytecode().settings.rewriting != RewritingMode::Parallel) {
        list_rules();
    }
}

void GrowthWalk::list_rules() {
    const Bytecode& bytecode = classes_->bytecode();
    rules_.resize(bytecode.rewriting_rule_count());
    std::vector<std::map<ClassId, std::uint32_t>> max_counts; // by index in sequences_
    for (std::uint32_t p = 0; p < bytecode.productions_of(Stage::Rewrite).count; ++p) {
        const BytecodeProduction& production = bytecode.productions[p];
        Rule& rule = rules_[production.rule];
        if (production.predecessor.count == 1) {
            rule.symbol = bytecode.patterns[production.predecessor.first].symbol;
            continue;
        }
        if (rule.sequence == kNone) {
            rule.sequence = static_cast<std::uint32_t>(sequences_.size());
            std::map<SymbolId, std::uint32_t> uses;
            for (std::uint32_t i = 0; i < production.predecessor.count; ++i) {
                ++uses[bytecode.patterns[production.predecessor.first + i].symbol];
            }
            max_counts.emplace_back();
            sequences_.push_back({{uses.begin(), uses.end()}, {}, static_cast<ProductionId>(p)});
        }
        for (const ClassTerm& term : classes_->successor(static_cast<ProductionId>(p))) {
            std::uint32_t& count = max_counts[rule.sequence][term.target];
            count = std::max(count, term.count);
        }
    }
    for (std::size_t i = 0; i < sequences_.size(); ++i) {
        for (const auto& [target, count] : max_counts[i]) {
            sequences_[i].max_written.push_back({target, count});
        }
    }
    reserve_counts();
}

void GrowthWalk::reserve_counts() {
    const std::size_t count = classes_->count();
    if (low_.size() < count) {
        low_.resize(count);
        high_.resize(count);
        expected_.resize(count);
        is_present_.resize(count);
    }
}

void GrowthWalk::add_present(ClassId id) {
    const auto i = static_cast<std::size_t>(id);
    if (!is_present_[i]) {
        is_present_[i] = true;
        present_.push_back(id);
        if (!rules_.empty()) {
            by_symbol_[static_cast<std::uint32_t>(classes_->symbol(id))].push_back(id);
        }
    }
}

SymbolId GrowthWalk::cause_of_next() const {
    std::vector<bool> occurs(classes_->bytecode().symbols.size(), false);
    const auto is_there = [&](ClassId id) { return !is_zero(high_[static_cast<std::size_t>(id)]); };
    for (const ClassId id : present_) {
        const auto symbol = static_cast<std::size_t>(classes_->symbol(id));
        occurs[symbol] = occurs[symbol] || is_there(id);
    }
    for (std::size_t s = 0; s < occurs.size(); ++s) {
        if (occurs[s]) {
            for (const SymbolId cause : classes_->causes(static_cast<SymbolId>(s))) {
                if (occurs[static_cast<std::size_t>(cause)]) {
                    return cause;
                }
            }
        }
    }
    return kNoSymbol;
}

void GrowthWalk::rewrite(std::span<const ClassId> ids) {
    struct Taken {
        ClassId id;
        Count low;
        Count high;
        double expected;
    };
    std::vector<Taken> taken;
    taken.reserve(ids.size());
    for (const ClassId id : ids) {
        const auto i = static_cast<std::size_t>(id);
        if (!is_zero(high_[i])) {
            taken.push_back({id, std::exchange(low_[i], Count{}), std::exchange(high_[i], Count{}),
                             std::exchange(expected_[i], 0.0)});
        }
    }
    for (const Taken& t : taken) {
        const ClassExpansion expansion = classes_->expand(t.id, age_);
        reserve_counts();
        const std::span<const ClassTerm> high = classes_->terms(expansion.high);
        const std::span<const ClassTerm> low = classes_->terms(expansion.low);
        for (const ClassTerm& term : high) {
            add_present(term.target);
            add_times(high_[static_cast<std::size_t>(term.target)], t.high, term.count);
        }
        if (!is_zero(t.low)) {
            for (const ClassTerm& term : low) {
                add_times(low_[static_cast<std::size_t>(term.target)], t.low, term.count);
            }
        }
        work_ += high.size() + low.size();
        probabilities_known_ = probabilities_known_ && expansion.probabilities_known;
        if (probabilities_known_) {
            for (const ClassOutcome& outcome : classes_->outcomes(expansion.outcomes)) {
                for (const ClassTerm& term : classes_->terms(outcome.terms)) {
                    expected_[static_cast<std::size_t>(term.target)] +=
                        t.expected * outcome.probability * term.count;
                }
                work_ += outcome.terms.count;
            }
        }
    }
}

Count GrowthWalk::max_matches(const SequenceRule& rule) const {
    Count matches;
    bool first = true;
    for (const auto& [symbol, uses] : rule.uses) {
        Count present;
        if (const auto found = by_symbol_.find(static_cast<std::uint32_t>(symbol));
            found != by_symbol_.end()) {
            for (const ClassId id : found->second) {
                present = present + high_[static_cast<std::size_t>(id)];
            }
        }
        if (!present.exceeds) {
            present.value = divide(present.value, uses).quotient;
        }
        if (first || less(present, matches)) {
            matches = present;
        }
        first = false;
    }
    return matches;
}

void GrowthWalk::subtract_replaced(const SequenceRule& rule, const Count& matches) {
    if (is_zero(matches)) {
        return;
    }
    probabilities_known_ = false;
    for (const auto& [symbol, uses] : rule.uses) {
        for (const ClassId id : by_symbol_[static_cast<std::uint32_t>(symbol)]) {
            Count& low = low_[static_cast<std::size_t>(id)];
            low = subtract(low, matches * count_of(uses));
        }
    }
}

void GrowthWalk::add_written(const SequenceRule& rule, const Count& matches) {
    if (is_zero(matches)) {
        return;
    }
    reserve_counts();
    for (const ClassTerm& term : rule.max_written) {
        add_present(term.target);
        add_times(high_[static_cast<std::size_t>(term.target)], matches, term.count);
    }
    work_ += rule.max_written.size();
}

void GrowthWalk::apply_rule(const Rule& rule) {
    ++work_;
    if (rule.sequence != kNone) {
        const SequenceRule& sequence = sequences_[rule.sequence];
        const Count matches = max_matches(sequence);
        subtract_replaced(sequence, matches);
        add_written(sequence, matches);
        return;
    }
    const auto found = by_symbol_.find(static_cast<std::uint32_t>(rule.symbol));
    if (found != by_symbol_.end()) {
        const std::vector<ClassId> ids =
            found->second; // a copy, because rewrite() adds modules that this pass does not rewrite
        rewrite(ids);
    }
}

void GrowthWalk::index_by_symbol() {
    by_symbol_.clear();
    for (const ClassId id : present_) {
        by_symbol_[static_cast<std::uint32_t>(classes_->symbol(id))].push_back(id);
    }
}

void GrowthWalk::drop_absent() {
    const auto clear_if_absent = [&](ClassId id) {
        const auto i = static_cast<std::size_t>(id);
        if (is_zero(high_[i])) {
            is_present_[i] = false;
            return true;
        }
        return false;
    };
    present_.erase(std::remove_if(present_.begin(), present_.end(), clear_if_absent),
                   present_.end());
}

void GrowthWalk::advance() {
    switch (classes_->bytecode().settings.rewriting) {
    case RewritingMode::Parallel: {
        const std::vector<ClassId> ids = present_;
        rewrite(ids);
        break;
    }
    case RewritingMode::Leftmost: {
        index_by_symbol();
        std::vector<Count> matches;
        matches.reserve(sequences_.size());
        for (const SequenceRule& sequence : sequences_) {
            matches.push_back(max_matches(sequence));
        }
        for (std::size_t i = 0; i < sequences_.size(); ++i) {
            subtract_replaced(sequences_[i], matches[i]);
        }
        const std::vector<ClassId> ids = present_;
        rewrite(ids);
        for (std::size_t i = 0; i < sequences_.size(); ++i) {
            add_written(sequences_[i], matches[i]);
        }
        break;
    }
    case RewritingMode::Sequential:
        index_by_symbol();
        for (const Rule& rule : rules_) {
            apply_rule(rule);
        }
        break;
    case RewritingMode::Cyclic:
        if (!rules_.empty()) {
            index_by_symbol();
            apply_rule(rules_[age_ % rules_.size()]);
        }
        break;
    }
    drop_absent();
    ++age_;
}

GenerationSize GrowthWalk::total(const std::vector<Count>& counts, bool is_low) const {
    const Bytecode& bytecode = classes_->bytecode();
    GenerationSize sum;
    for (const ClassId id : present_) {
        GenerationSize size = size_of(bytecode, classes_->code(id));
        if (is_low && classes_->covers_folded()) {
            size.parameters = {};
            size.bytes = count_of(code_width(bytecode.code_count()));
        }
        // `size` is the size of one module, so its counts fit 64 bits.
        const Count& times = counts[static_cast<std::size_t>(id)];
        add_times(sum.modules, times, 1);
        add_times(sum.parameters, times, low_64_bits(size.parameters));
        add_times(sum.segments, times, low_64_bits(size.segments));
        add_times(sum.bytes, times, low_64_bits(size.bytes));
    }
    return sum;
}

double GrowthWalk::expected_modules() const {
    double sum = 0.0;
    for (const ClassId id : present_) {
        sum += expected_[static_cast<std::size_t>(id)];
    }
    return sum;
}

bool GrowthWalk::is_final() {
    if (classes_->depends_on_age()) {
        return false;
    }
    if (!sequences_.empty()) {
        index_by_symbol();
    }
    const bool none =
        std::all_of(sequences_.begin(), sequences_.end(),
                    [&](const SequenceRule& rule) { return is_zero(max_matches(rule)); });
    return none && std::all_of(present_.begin(), present_.end(), [&](ClassId id) {
               const ClassExpansion expansion = classes_->expand(id, age_);
               reserve_counts();
               return expansion.unchanged;
           });
}

bool GrowthWalk::is_linear() const {
    return sequences_.empty() && !classes_->depends_on_age();
}

ProductionId GrowthWalk::dominant() {
    std::map<ProductionId, double> modules_written;
    if (!sequences_.empty()) {
        index_by_symbol();
    }
    const std::vector<ClassId> ids = present_;
    for (const ClassId id : ids) {
        const ClassExpansion expansion = classes_->expand(id, age_);
        reserve_counts();
        const auto i = static_cast<std::size_t>(id);
        for (const ClassOutcome& outcome : classes_->outcomes(expansion.outcomes)) {
            if (outcome.production == kNoProduction) {
                continue;
            }
            double modules = 0.0;
            for (const ClassTerm& term : classes_->terms(outcome.terms)) {
                modules += term.count;
            }
            const double times = probabilities_known_ && expansion.probabilities_known
                                     ? expected_[i] * outcome.probability
                                     : as_double(high_[i]);
            modules_written[outcome.production] += times * modules;
        }
    }
    for (const SequenceRule& rule : sequences_) {
        // Which production of the rule rewrites a match is unknown: all modules that the matches
        // write are counted for the first production.
        double modules = 0.0;
        for (const ClassTerm& term : rule.max_written) {
            modules += term.count;
        }
        modules_written[rule.first] += as_double(max_matches(rule)) * modules;
    }
    const auto dominant =
        std::max_element(modules_written.begin(), modules_written.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return dominant == modules_written.end() ? kNoProduction : dominant->first;
}

void GrowthWalk::load(std::uint32_t age, std::span<const Count> low, std::span<const Count> high) {
    for (const ClassId id : present_) {
        const auto i = static_cast<std::size_t>(id);
        low_[i] = high_[i] = Count{};
        expected_[i] = 0.0;
        is_present_[i] = false;
    }
    present_.clear();
    by_symbol_.clear();
    probabilities_known_ = false;
    reserve_counts();
    age_ = age;
    for (std::size_t i = 0; i < high.size(); ++i) {
        if (!is_zero(high[i]) || !is_zero(low[i])) {
            add_present(static_cast<ClassId>(i));
            low_[i] = low[i];
            high_[i] = high[i];
        }
    }
}

} // namespace lsys::analysis
