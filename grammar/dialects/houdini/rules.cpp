// SPDX-License-Identifier: MIT
// The part of HoudiniWriter that writes rules.
#include "grammar/ast/number.h"
#include "grammar/dialects/houdini/writer.h"

#include <set>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// Parameter counts of a turtle symbol in the axiom and the successors; if it occurs in neither,
/// its count in the head of the rule.
std::vector<std::uint32_t> counts_of(const HoudiniSymbol& symbol, std::uint32_t in_head) {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t k = 0; k <= HoudiniSymbols::kMaxParameters; ++k) {
        if ((symbol.counts >> k & 1U) != 0) {
            counts.push_back(k);
        }
    }
    return counts.empty() ? std::vector<std::uint32_t>{in_head} : counts;
}

} // namespace

/// Key of a group: rules with the same symbols in predecessor and contexts, which compete.
std::string HoudiniWriter::group_of(const HoudiniRule& rule) const {
    std::string group;
    for (const std::vector<HoudiniModule>* const modules : rule.head()) {
        for (const HoudiniModule& module : *modules) {
            group += text(module.symbol);
        }
        group += '\n';
    }
    return group;
}

std::string HoudiniWriter::probability_of(ForeignId condition) const {
    const ForeignNode& test = tree_[condition];
    if (test.kind != ForeignKind::Binary) {
        return {};
    }
    const ForeignNode& left = tree_[test.parts[0]];
    const ForeignNode& right = tree_[test.parts[1]];
    if (left.kind != ForeignKind::Call || left.text != "rand" ||
        right.kind != ForeignKind::Number || (test.text[0] != '<' && test.text[0] != '>')) {
        return {};
    }
    const float limit = read_literal(right.text).value;
    if (!(limit > 0.0F && limit < 1.0F)) {
        return {};
    }
    return test.text[0] == '<' ? right.text : "(1 - " + right.text + ")";
}

void HoudiniWriter::find_random_pairs() {
    std::map<std::string, std::vector<const HoudiniRule*>> groups;
    std::map<std::string_view, std::size_t> rule_counts; // by symbol
    for (const HoudiniRule& rule : session_.rules) {
        groups[group_of(rule)].push_back(&rule);
        ++rule_counts[text(rule.predecessor.front().symbol)];
    }
    for (const auto& [group, rules] : groups) {
        if (rules.size() != 2 || rule_counts[text(rules[0]->predecessor.front().symbol)] != 2 ||
            has_probability_[group] || rules[0]->condition == kNoForeign ||
            rules[1]->condition != kNoForeign) {
            continue;
        }
        const std::string chance = probability_of(rules[0]->condition);
        if (!chance.empty()) {
            probabilities_[rules[0]] = chance;
            probabilities_[rules[1]] = "(1 - " + chance + ")";
        }
    }
}

bool HoudiniWriter::check_head(const HoudiniRule& rule) {
    if (rule.predecessor.size() > 1) {
        report_syntax(rule.predecessor[1].symbol, "a rule replaces one symbol");
        return false;
    }
    bool is_valid = true;
    for (const std::vector<HoudiniModule>* const modules : rule.head()) {
        for (const HoudiniModule& module : *modules) {
            for (const ForeignId argument : module.arguments) {
                const ForeignNode& formal = session_.node(argument);
                if (formal.kind != ForeignKind::Name && formal.kind != ForeignKind::Missing) {
                    report_syntax(formal.span, "here a parameter is named");
                    is_valid = false;
                }
            }
        }
    }
    const HoudiniSymbol& symbol = symbols_.symbol(rule.predecessor.front());
    if (symbol.has_age && symbol.is_command) {
        report_unsupported(rule.span, "lsc does not know the age `g` of a turtle command");
        is_valid = false;
    }
    return is_valid;
}

/// All combinations of parameter counts of the turtle's symbols that stand in the rule's head.
std::vector<HoudiniWriter::ParameterCounts>
HoudiniWriter::all_parameter_counts(const HoudiniRule& rule) const {
    std::vector<ParameterCounts> variants{{}};
    for (const std::vector<HoudiniModule>* const modules : rule.head()) {
        for (const HoudiniModule& module : *modules) {
            const HoudiniSymbol& symbol = symbols_.symbol(module);
            if (!symbol.is_command) {
                continue;
            }
            std::vector<ParameterCounts> extended;
            for (const std::uint32_t count : counts_of(symbol, symbols_.count(module))) {
                for (const ParameterCounts& counts : variants) {
                    extended.push_back(counts);
                    extended.back().push_back(count);
                }
            }
            constexpr std::size_t kMax = 64; // max number of combinations
            if (extended.size() > kMax) {
                report_unsupported(rule.span,
                                   "turtle symbols occur here with too many different numbers "
                                   "of parameters");
                return {};
            }
            variants = std::move(extended);
        }
    }
    return variants;
}

void HoudiniWriter::write_rule(const HoudiniRule& rule, std::size_t index) {
    const std::vector<ParameterCounts> variants = all_parameter_counts(rule);
    for (std::size_t i = 0; i < variants.size(); ++i) {
        std::string name = "r" + std::to_string(index);
        name += variants.size() > 1 ? "_" + std::to_string(i + 1) : "";
        write_variant(rule, variants[i], name, false);
        if (!fraction_.empty()) {
            write_variant(rule, variants[i], name + "_last", true);
        }
    }
}

/// Writes the formals `(x, y)` of a module of a head; missing names are generated. `has_age`: the
/// age of the module is a further formal.
void HoudiniWriter::write_formals(const HoudiniModule& head, std::uint32_t count, bool has_age) {
    const SourceSpan place = head.arguments.empty() ? head.symbol : head.parentheses;
    for (std::uint32_t i = 0; i < count; ++i) {
        translation_.put(i == 0 ? "(" : ", ", place);
        const ForeignNode* const formal =
            i < head.arguments.size() ? &session_.node(head.arguments[i]) : nullptr;
        if (formal != nullptr && formal->kind == ForeignKind::Name) {
            translation_.copy(formal->span, session_.context.sources);
        } else {
            translation_.put("_" + std::to_string(++fresh_), place);
        }
    }
    for (std::size_t i = count; i < head.arguments.size(); ++i) {
        omitted_parameters_.push_back(text(session_.node(head.arguments[i]).span));
    }
    if (has_age) {
        translation_.put(count == 0 ? "(g" : ", g", place);
    }
    if (count != 0 || has_age) {
        translation_.put(")", place);
    }
}

void HoudiniWriter::write_pattern(const std::vector<HoudiniModule>& modules,
                                  const ParameterCounts& counts,
                                  std::size_t& slot) {
    for (const HoudiniModule& module : modules) {
        const HoudiniSymbol& symbol = symbols_.symbol(module);
        write_symbol(module);
        const std::uint32_t formal_count = symbol.max_count + (symbol.has_age ? 1U : 0U);
        write_formals(module, symbol.is_command ? counts[slot++] : formal_count, false);
    }
}

void HoudiniWriter::write_variant(const HoudiniRule& rule,
                                  const ParameterCounts& counts,
                                  const std::string& name,
                                  bool is_last) {
    std::size_t slot = 0;
    is_last_ = is_last;
    fresh_ = 0;
    omitted_parameters_.clear();
    translation_.put("#" + name + " : ", rule.span);
    if (!rule.left.empty()) {
        write_pattern(rule.left, counts, slot);
        translation_.put(" < ", rule.span);
    }
    const HoudiniModule& head = rule.predecessor.front();
    const HoudiniSymbol& symbol = symbols_.symbol(head);
    write_symbol(head);
    write_formals(head, symbol.is_command ? counts[slot++] : symbol.max_count, symbol.has_age);
    if (!rule.right.empty()) {
        translation_.put(" > ", rule.span);
        write_pattern(rule.right, counts, slot);
    }
    translation_.put(" : ", rule.span);
    const bool weighted = has_probability_[group_of(rule)];
    const std::string generation =
        (is_last ? "step() == " : "step() != ") + std::to_string(generations_ - 1U);
    if (const auto chance = probabilities_.find(&rule); chance != probabilities_.end()) {
        expressions_.warn_random(rule.span);
        translation_.put((fraction_.empty() ? "*" : generation) + " ~ " + chance->second,
                         rule.span);
    } else if (rule.condition != kNoForeign) {
        translation_.put(fraction_.empty() ? "" : generation + " && (", rule.span);
        write_expression(rule.condition, {HoudiniPlace::Condition, &rule, &omitted_parameters_});
        translation_.put(fraction_.empty() ? "" : ")", rule.span);
    } else if (!fraction_.empty()) {
        translation_.put(generation, rule.span);
    } else if (!weighted) {
        translation_.put("*", rule.span);
    }
    if (weighted) {
        translation_.put(" ~ ", rule.span);
        if (rule.probability != kNoForeign) {
            write_expression(rule.probability,
                             {HoudiniPlace::Probability, &rule, &omitted_parameters_});
        } else {
            translation_.put("1", rule.span);
        }
    }
    const std::size_t first = tree_.locals().size();
    const Word word =
        lower_word(rule.successor, {HoudiniPlace::Successor, &rule, &omitted_parameters_});
    std::set<std::string> taken{"value_b", "value_c", "value_d", "g"};
    taken.insert(rule.formals.begin(), rule.formals.end());
    for (std::size_t i = 0; i < premise_local_count_; ++i) {
        taken.insert(tree_.locals()[i].name);
    }
    name_locals(word, first, std::move(taken));
    tree_.write_locals(" : ", first, tree_.locals().size(), {}, translation_);
    translation_.put(" : ", rule.span);
    write_word(word);
    is_last_ = false;
    translation_.put(";\n", {rule.span.file, rule.span.end, rule.span.end});
}

void HoudiniWriter::write_expression(ForeignId expression, const HoudiniScope& scope) {
    tree_.write(expressions_.term(expression, scope), {.expands_locals = true}, translation_);
}

void HoudiniWriter::write_ageing(const HoudiniRule& rule, std::size_t index) {
    const HoudiniModule& head = rule.predecessor.front();
    const HoudiniSymbol& symbol = symbols_.symbol(head);
    if (!symbol.has_age || symbol.is_command || aged_[text(head.symbol)]) {
        return;
    }
    aged_[text(head.symbol)] = true;
    std::string formals;
    for (std::uint32_t i = 1; i <= symbol.max_count; ++i) {
        formals += "_" + std::to_string(i) + ", ";
    }
    translation_.put("#age" + std::to_string(index) + " : ", rule.span);
    write_symbol(head);
    translation_.put("(" + formals + "g) : * : ", head.symbol);
    write_symbol(head);
    translation_.put("(" + formals + "g + 1);\n", head.symbol);
}

} // namespace lsys
