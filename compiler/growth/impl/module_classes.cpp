// SPDX-License-Identifier: MIT
#include "compiler/growth/impl/module_classes.h"

#include "compiler/growth/condition_grid.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/contract.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace lsys::analysis {

namespace {

constexpr std::uint32_t kUnknownBits = 0xFFFFFFFFU; // bits of a NaN; parameters are never NaN
constexpr std::uint64_t kMaxGridWork = 65'536;      // max points times productions
constexpr std::size_t kMaxVariableModules = 65'536; // max variable modules per word

} // namespace

ModuleClasses::ModuleClasses(const Bytecode& bytecode, std::uint32_t steps)
    : bytecode_(&bytecode), index_(bytecode), steps_(steps),
      changed_parameters_(changed_parameters(bytecode)), fixed_ids_(bytecode.code_count(), kNone),
      evaluator_(bytecode.stack_depth, bytecode.local_count) {
    fill_causes();
}

void ModuleClasses::fill_causes() {
    causes_.resize(bytecode_->symbols.size());
    for (std::size_t s = 0; s < causes_.size(); ++s) {
        for (std::uint32_t i = 0; i < changed_parameters_[s]; ++i) {
            if (index_.is_relevant(static_cast<SymbolId>(s), i)) {
                causes_[s].push_back(static_cast<SymbolId>(s));
                break;
            }
        }
        for (const std::uint32_t p : index_.productions_of(static_cast<SymbolId>(s))) {
            const BytecodeProduction& production = bytecode_->productions[p];
            // A context without a condition decides nothing by its parameters.
            if (production.condition == kNone && production.weight_code == kNone) {
                continue;
            }
            for (const TableRange context : {production.left, production.right}) {
                for (std::uint32_t i = 0; i < context.count; ++i) {
                    const PatternItem& item = bytecode_->patterns[context.first + i];
                    if (item.kind == PatternKind::Module && may_change(item.symbol, 0)) {
                        causes_[s].push_back(item.symbol);
                    }
                }
            }
        }
    }
}

// --- classes

ClassId ModuleClasses::add_class(Code code, std::uint32_t first_value) {
    const auto id = static_cast<ClassId>(classes_.size());
    classes_.push_back({code, first_value});
    expansions_.emplace_back();
    return id;
}

ClassId ModuleClasses::fixed_class(Code code) {
    if (fixed_ids_[code] == kNone) {
        fixed_ids_[code] = static_cast<std::uint32_t>(add_class(code, kNone));
    }
    return static_cast<ClassId>(fixed_ids_[code]);
}

ClassId ModuleClasses::unknown_class(Code code) {
    const SymbolId symbol = bytecode_->symbol_of(code);
    const std::uint32_t values =
        bytecode_->stored_parameters(code) == 0 ? 0 : index_.relevant_count(symbol);
    if (values == 0) {
        return fixed_class(code);
    }
    if (unknown_ids_.empty()) {
        unknown_ids_.assign(bytecode_->code_count(), kNone);
    }
    if (unknown_ids_[code] == kNone) {
        const auto first = static_cast<std::uint32_t>(values_.size());
        values_.insert(values_.end(), values, KnownValue{});
        unknown_ids_[code] = static_cast<std::uint32_t>(add_class(code, first));
    }
    return static_cast<ClassId>(unknown_ids_[code]);
}

ClassId ModuleClasses::class_with_known_values(Code code, std::span<const KnownValue> values) {
    if (is_work_exhausted()) {
        return unknown_class(code);
    }
    std::vector<std::uint32_t> key{code};
    bool any_known = false;
    for (const KnownValue& value : values) {
        const bool usable = value.known && std::isfinite(value.value);
        any_known = any_known || usable;
        key.push_back(usable ? std::bit_cast<std::uint32_t>(value.value) : kUnknownBits);
    }
    if (!any_known) {
        return unknown_class(code);
    }
    if (const auto found = known_value_ids_.find(key); found != known_value_ids_.end()) {
        return found->second;
    }
    if (known_value_ids_.size() >= kMaxClassesWithKnownValues) {
        return unknown_class(code);
    }
    const auto first = static_cast<std::uint32_t>(values_.size());
    for (std::size_t i = 1; i < key.size(); ++i) {
        const bool known = key[i] != kUnknownBits;
        values_.push_back({known ? std::bit_cast<float>(key[i]) : 0.0F, known});
    }
    const ClassId id = add_class(code, first);
    known_value_ids_.emplace(std::move(key), id);
    return id;
}

std::vector<KnownValue> ModuleClasses::parameters(ClassId id) const {
    const Class& module = classes_[number(id)];
    const SymbolId symbol = bytecode_->symbol_of(module.code);
    std::vector<KnownValue> result(bytecode_->symbol(symbol).parameter_count);
    if (module.code >= bytecode_->symbols.size()) {
        const FoldedModule& folded = bytecode_->folded[module.code - bytecode_->symbols.size()];
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = {bytecode_->constants[folded.first_constant + i], true};
        }
    } else if (module.first_value != kNone) {
        std::uint32_t next = module.first_value;
        for (std::uint32_t i = 0; i < result.size(); ++i) {
            if (index_.is_relevant(symbol, i)) {
                result[i] = values_[next++];
            }
        }
    }
    return result;
}

// --- words

void ModuleClasses::count_word(const WordTemplate& word, CountedWord& out) {
    out.is_counted = true;
    out.locals = word.locals;
    work_ += word.codes.count;
    if (code_counts_.empty()) {
        code_counts_.assign(bytecode_->code_count(), 0);
    }
    if (index_.any_relevant() && word.arguments != kNone) {
        for_each_argument(*bytecode_, word,
                          [&](Code code, std::uint32_t argument, InstructionRange instructions) {
                              const auto symbol = static_cast<SymbolId>(code);
                              if (!index_.is_relevant(symbol, argument)) {
                                  return true;
                              }
                              bool first_relevant = true;
                              for (std::uint32_t i = 0; i < argument; ++i) {
                                  first_relevant = first_relevant && !index_.is_relevant(symbol, i);
                              }
                              if (first_relevant) {
                                  if (out.variable.size() == kMaxVariableModules) {
                                      return false;
                                  }
                                  out.variable.push_back(
                                      {code, static_cast<std::uint32_t>(argument_starts_.size())});
                              }
                              argument_starts_.push_back(instructions.first());
                              return true;
                          });
    }
    std::vector<Code> fixed_codes; // without duplicates
    std::size_t next_variable = 0;
    constexpr std::uint32_t kCodesPerLook = 1U << 14U; // codes between checks for cancellation
    for (std::uint32_t i = 0; i < word.codes.count; ++i) {
        if (i % kCodesPerLook == 0) {
            stop_if_cancelled();
        }
        const Code code = bytecode_->template_codes[word.codes.first + i];
        if (next_variable < out.variable.size() && out.variable[next_variable].code == code) {
            ++next_variable; // variable modules are listed in the order of the word
            continue;
        }
        if (code_counts_[code]++ == 0) {
            fixed_codes.push_back(code);
        }
    }
    for (const Code code : fixed_codes) {
        out.fixed.push_back({unknown_class(code), std::exchange(code_counts_[code], 0)});
    }
}

TableRange ModuleClasses::instantiate(const CountedWord& word, const ExpressionInputs& inputs) {
    std::vector<ClassTerm> terms = word.fixed;
    std::vector<KnownValue> values;
    work_ += word.fixed.size() + word.variable.size();
    for (const VariableModule& module : word.variable) {
        values.assign(index_.relevant_count(static_cast<SymbolId>(module.code)), KnownValue{});
        if (!is_work_exhausted()) {
            const auto symbol = static_cast<SymbolId>(module.code);
            std::uint32_t parameter = 0;
            for (std::size_t i = 0; i < values.size(); ++i, ++parameter) {
                while (!index_.is_relevant(symbol, parameter)) {
                    ++parameter;
                }
                if (!may_change(symbol, parameter)) {
                    values[i] = evaluator_.run(bytecode_->instructions,
                                               argument_starts_[module.first_argument + i], inputs,
                                               word.locals);
                }
            }
        }
        terms.push_back({class_with_known_values(module.code, values), 1});
    }
    std::sort(terms.begin(), terms.end(),
              [](const ClassTerm& a, const ClassTerm& b) { return a.target < b.target; });
    TableRange range{static_cast<std::uint32_t>(terms_.size()), 0};
    for (const ClassTerm& term : terms) {
        if (range.count != 0 && terms_.back().target == term.target) {
            terms_.back().count += term.count;
        } else {
            terms_.push_back(term);
            ++range.count;
        }
    }
    return range;
}

ClassExpansion ModuleClasses::start() {
    double sum = 0.0;
    for (const BytecodeAxiom& axiom : bytecode_->axioms) {
        sum += static_cast<double>(axiom.weight);
    }
    std::vector<ClassOutcome> outcomes;
    for (const BytecodeAxiom& axiom : bytecode_->axioms) {
        CountedWord word;
        count_word(axiom.word, word);
        ClassOutcome outcome;
        outcome.probability = static_cast<double>(axiom.weight) / sum;
        outcome.terms = instantiate(word, {{}, std::nullopt, steps_});
        outcomes.push_back(outcome);
    }
    ClassExpansion expansion;
    set_outcomes(outcomes, expansion);
    return expansion;
}

std::vector<ClassTerm> ModuleClasses::successor(ProductionId production) {
    CountedWord word;
    count_word(bytecode_->productions[static_cast<std::size_t>(production)].successor, word);
    const TableRange range = instantiate(word, {});
    const std::span<const ClassTerm> class_terms = terms(range);
    return {class_terms.begin(), class_terms.end()};
}

// --- matching

ExpressionInputs ModuleClasses::inputs(std::span<const KnownValue> formals) const {
    return {formals, index_.depends_on_age() ? std::optional(age_) : std::nullopt, steps_};
}

KnownValue ModuleClasses::condition(std::uint32_t production,
                                    std::span<const KnownValue> parameters) {
    return value_of(production, bytecode_->productions[production].condition, parameters);
}

/// The value of the condition or weight whose code begins at `first_instruction`; 1 if it is kNone.
KnownValue ModuleClasses::value_of(std::uint32_t production,
                                   std::uint32_t first_instruction,
                                   std::span<const KnownValue> parameters) {
    ++work_;
    if (first_instruction == kNone) {
        return {1.0F, true};
    }
    std::span<const KnownValue> formals = parameters;
    if (const std::uint32_t first = index_.first_formal(production); first != 0) {
        formals_.assign(first, KnownValue{});
        formals_.insert(formals_.end(), parameters.begin(), parameters.end());
        formals = formals_;
    }
    return evaluator_.run(bytecode_->instructions, first_instruction, inputs(formals));
}

/// The weight of a stochastic production; unknown if computing it is a run-time error.
KnownValue ModuleClasses::weight_of(std::uint32_t production,
                                    std::span<const KnownValue> parameters) {
    const BytecodeProduction& p = bytecode_->productions[production];
    if (p.weight_code == kNone) {
        return {p.weight, true};
    }
    const KnownValue weight = value_of(production, p.weight_code, parameters);
    return weight.known && weight.value >= 0.0F && std::isfinite(weight.value) ? weight
                                                                               : KnownValue{};
}

ModuleClasses::Matches ModuleClasses::match(SymbolId symbol,
                                            std::span<const KnownValue> point,
                                            std::span<const KnownValue> parameters) {
    enum class Holds : std::uint8_t { No, Maybe, Yes };
    const auto holds = [&](std::uint32_t p) {
        const BytecodeProduction& production = bytecode_->productions[p];
        const bool has_context = production.has_left || production.has_right;
        const KnownValue value = condition(p, has_context ? parameters : point);
        return !value.known          ? Holds::Maybe
               : value.value == 0.0F ? Holds::No
               : has_context         ? Holds::Maybe
                                     : Holds::Yes;
    };
    Matches matches;
    // By stochastic group in the list: whether it has a member that is certain to match and whose
    // weight is certain to be above 0.
    std::unordered_map<std::uint32_t, bool> groups;
    for (const std::uint32_t p : index_.productions_of(symbol)) {
        const BytecodeProduction& production = bytecode_->productions[p];
        const Holds first = holds(p);
        if (first == Holds::No) {
            continue;
        }
        const bool certain = first == Holds::Yes;
        // Whether the module is certain to be replaced if the condition holds. In a group some
        // weight must be known to be above 0.
        bool is_taken = true;
        if (!production.stochastic) {
            matches.list.push_back({p, 1.0});
        } else if (const auto added = groups.find(production.group); added != groups.end()) {
            is_taken = added->second;
        } else {
            const std::size_t begin = matches.list.size();
            double sum = 0.0;
            is_taken = false;
            for (const std::uint32_t q : index_.group(production.group)) {
                const Holds member = q == p ? first : holds(q);
                const KnownValue weight =
                    member == Holds::No ? KnownValue{0.0F, true} : weight_of(q, parameters);
                if (!weight.known || weight.value != 0.0F) {
                    const double share = weight.known ? static_cast<double>(weight.value) : 1.0;
                    matches.list.push_back({q, share});
                    matches.probabilities_known =
                        matches.probabilities_known && member == Holds::Yes && weight.known;
                    is_taken = is_taken || (member == Holds::Yes && weight.known);
                    sum += share;
                }
            }
            for (std::size_t i = begin; i < matches.list.size(); ++i) {
                matches.list[i].probability /= sum;
            }
            groups.emplace(production.group, is_taken);
        }
        if (certain && !is_taken) { // without a weight above 0 the module is copied
            matches.probabilities_known = matches.probabilities_known && matches.list.empty();
            matches.list.push_back({kNone, 1.0});
            return matches;
        }
        matches.probabilities_known = matches.probabilities_known && certain;
        if (certain) {
            return matches;
        }
    }
    matches.list.push_back({kNone, 1.0});
    return matches;
}

ModuleClasses::Matches ModuleClasses::match_everywhere(SymbolId symbol,
                                                       std::span<const KnownValue> parameters) {
    const std::span<const std::uint32_t> productions = index_.productions_of(symbol);
    const bool all_known = std::all_of(parameters.begin(), parameters.end(),
                                       [](const KnownValue& v) { return v.known; });
    const std::uint64_t max_points = kMaxGridWork / std::max<std::uint64_t>(1, productions.size());
    if (all_known || max_points < 2) {
        return match(symbol, parameters, parameters);
    }
    std::vector<ConditionView> conditions;
    for (const std::uint32_t p : productions) {
        const BytecodeProduction& production = bytecode_->productions[p];
        if (production.condition != kNone && !production.has_left && !production.has_right) {
            conditions.push_back({production.condition, index_.first_formal(p)});
        }
    }
    if (conditions.empty()) {
        return match(symbol, parameters, parameters);
    }
    work_ += 256 * conditions.size();
    const std::optional<ConditionGrid> grid = make_condition_grid(
        bytecode_->instructions, conditions, parameters, inputs({}), max_points);
    if (!grid) {
        return match(symbol, parameters, parameters);
    }
    std::vector<KnownValue> point(parameters.begin(), parameters.end());
    Matches all;
    for (std::uint64_t i = 0; i < grid->point_count(); ++i) {
        if (is_work_exhausted()) {
            return match(symbol, parameters, parameters);
        }
        grid->set_parameters(i, point);
        Matches here = match(symbol, point, parameters);
        if (i == 0) {
            all = std::move(here);
            continue;
        }
        all.probabilities_known =
            all.probabilities_known && here.probabilities_known && here.list == all.list;
        for (const Match& m : here.list) {
            const bool present =
                std::any_of(all.list.begin(), all.list.end(),
                            [&](const Match& known) { return known.production == m.production; });
            if (!present) {
                all.list.push_back(m);
            }
        }
    }
    return all;
}

bool ModuleClasses::is_identity(Code code, std::uint32_t production) const {
    const WordTemplate& word = bytecode_->productions[production].successor;
    if (word.codes.count != 1 || bytecode_->template_codes[word.codes.first] != code) {
        return false;
    }
    std::uint32_t at = word.arguments;
    for (std::uint32_t i = 0; i < bytecode_->stored_parameters(code); ++i, at += 2) {
        if (bytecode_->instructions[at] !=
                encode(Opcode::Formal, index_.first_formal(production) + i) ||
            opcode_of(bytecode_->instructions[at + 1]) != Opcode::Emit) {
            return false;
        }
    }
    return true;
}

bool ModuleClasses::is_unchanged(const ClassExpansion& expansion, Code code) const {
    constexpr std::uint32_t kMaxOutcomes = 16;
    if (expansion.outcomes.count > kMaxOutcomes || may_change(bytecode_->symbol_of(code), 0)) {
        return false;
    }
    const std::span<const ClassOutcome> all = outcomes(expansion.outcomes);
    return std::all_of(all.begin(), all.end(), [&](const ClassOutcome& outcome) {
        return outcome.production == kNoProduction ||
               is_identity(code, static_cast<std::uint32_t>(outcome.production));
    });
}

ClassExpansion ModuleClasses::expand_matches(const Matches& matches,
                                             ClassId self,
                                             std::span<const KnownValue> parameters) {
    ClassExpansion expansion;
    expansion.done = true;
    expansion.probabilities_known = matches.probabilities_known;
    std::vector<ClassOutcome> outcomes;
    std::vector<KnownValue> formals;
    for (const Match& m : matches.list) {
        ClassOutcome outcome;
        outcome.probability = m.probability;
        if (m.production == kNone) {
            outcome.terms = {static_cast<std::uint32_t>(terms_.size()), 1};
            terms_.push_back({self, 1});
            expansion.copies = true;
        } else {
            outcome.production = static_cast<ProductionId>(m.production);
            formals.assign(index_.first_formal(m.production), KnownValue{});
            formals.insert(formals.end(), parameters.begin(), parameters.end());
            // Without relevant parameters each successor is read only once, so it is not stored.
            CountedWord once;
            CountedWord& word = index_.any_relevant() ? words_[m.production] : once;
            if (!word.is_counted) {
                count_word(bytecode_->productions[m.production].successor, word);
            }
            outcome.terms = instantiate(word, inputs(formals));
        }
        outcomes.push_back(outcome);
    }
    set_outcomes(outcomes, expansion);
    return expansion;
}

void ModuleClasses::set_outcomes(const std::vector<ClassOutcome>& outcomes,
                                 ClassExpansion& expansion) {
    expansion.outcomes = {static_cast<std::uint32_t>(outcomes_.size()),
                          static_cast<std::uint32_t>(outcomes.size())};
    outcomes_.insert(outcomes_.end(), outcomes.begin(), outcomes.end());
    add_bounds(expansion);
}

void ModuleClasses::add_bounds(ClassExpansion& expansion) {
    if (expansion.outcomes.count == 1) {
        expansion.low = expansion.high = outcomes_[expansion.outcomes.first].terms;
        return;
    }
    struct Bounds {
        std::uint32_t low = 0;
        std::uint32_t high = 0;
        std::uint32_t outcome_count = 0; // number of outcomes that have the class
    };
    std::map<ClassId, Bounds> bounds;
    for (const ClassOutcome& outcome : outcomes(expansion.outcomes)) {
        for (const ClassTerm& term : terms(outcome.terms)) {
            Bounds& b = bounds[term.target];
            b.low = b.outcome_count == 0 ? term.count : std::min(b.low, term.count);
            b.high = std::max(b.high, term.count);
            ++b.outcome_count;
        }
    }
    expansion.low = {static_cast<std::uint32_t>(terms_.size()), 0};
    for (const auto& [target, b] : bounds) {
        if (b.outcome_count == expansion.outcomes.count) {
            terms_.push_back({target, b.low});
            ++expansion.low.count;
        }
    }
    expansion.high = {static_cast<std::uint32_t>(terms_.size()), 0};
    for (const auto& [target, b] : bounds) {
        terms_.push_back({target, b.high});
        ++expansion.high.count;
    }
}

const ClassExpansion& ModuleClasses::expand(ClassId id, std::uint32_t age) {
    if (index_.depends_on_age() && age != age_) {
        age_ = age;
        expansions_.assign(classes_.size(), ClassExpansion{});
        shared_.clear();
        outcomes_.clear();
        terms_.clear();
    }
    if (expansions_[number(id)].done) {
        return expansions_[number(id)];
    }
    const SymbolId symbol = this->symbol(id);
    const bool no_values = index_.relevant_count(symbol) == 0;
    ClassExpansion expansion;
    if (index_.productions_of(symbol).empty()) {
        expansion = expand_matches(Matches{{{kNone, 1.0}}, true}, id, {});
        expansion.unchanged = !may_change(symbol, 0);
    } else if (no_values || is_work_exhausted()) {
        // One expansion serves all codes of the symbol.
        ClassExpansion& shared = shared_[static_cast<std::uint32_t>(symbol)];
        if (!shared.done) {
            const std::vector<KnownValue> nothing(bytecode_->symbol(symbol).parameter_count);
            const Matches matches = match_everywhere(symbol, nothing);
            shared = expand_matches(matches, unknown_class(static_cast<Code>(symbol)), nothing);
        }
        expansion = shared;
        if (shared.copies && id != unknown_class(static_cast<Code>(symbol))) {
            if (is_work_exhausted()) {
                covers_folded_ = true; // the symbol's class now counts its folded modules
            } else {
                const std::vector<KnownValue> values = parameters(id);
                expansion = expand_matches(match_everywhere(symbol, values), id, values);
            }
        }
        expansion.unchanged = is_unchanged(expansion, code(id));
    } else {
        const std::vector<KnownValue> values = parameters(id);
        expansion = expand_matches(match_everywhere(symbol, values), id, values);
        expansion.unchanged = is_unchanged(expansion, code(id));
    }
    expansions_[number(id)] = expansion;
    return expansions_[number(id)];
}

} // namespace lsys::analysis
