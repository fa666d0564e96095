// SPDX-License-Identifier: MIT
// Writes a Houdini rule text as .lsys text, and reports the parts that lsc does not support.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/dialects/houdini/expressions.h"
#include "grammar/dialects/houdini/session.h"
#include "grammar/dialects/houdini/settings.h"
#include "grammar/dialects/houdini/symbols.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

class HoudiniWriter {
public:
    HoudiniWriter(HoudiniSession& session, Translation& translation);

    /// Writes the system as .lsys statements. `turtle`: name of the profile in `#set turtle`.
    void write(std::string_view turtle);

private:
    /// A variant of a rule: the number of parameters of each symbol of the turtle in its head.
    using ParameterCounts = std::vector<std::uint32_t>;
    /// A module of a word in .lsys.
    struct Lowered {
        const HoudiniModule* module = nullptr;
        std::string name; // empty: the symbol
        std::vector<ForeignId> arguments;
    };
    using Word = std::vector<Lowered>;

    [[nodiscard]] std::string_view text(SourceSpan span) const {
        return session_.context.sources.text(span);
    }
    /// The value of a setting as written in the file, or `fallback`.
    [[nodiscard]] std::string number(std::string_view name, const char* fallback) const;

    void read_settings();
    void read_setting(const HoudiniSettingRow& row, SourceSpan key, SourceSpan value);
    /// Splits the number of generations: 4.25 is 5 generations, of which the last one has a quarter
    /// of its lengths, angles and widths.
    void read_generations();
    /// Whether a switch is on, as all are in a new node.
    [[nodiscard]] bool is_on(std::string_view name) const;
    /// Writes interpretations that scale each command by a random number from 1 - s to 1 + s, where
    /// s is the Random Scale. They change what is drawn and leave the word.
    void write_random_scale();
    void write_settings(std::string_view turtle);
    /// Defines the values b, c and d as constants, which the option -D can replace.
    void write_values();
    /// Whether an expression reads the variable; parameters of the same name do not count.
    [[nodiscard]] bool reads_variable(std::string_view value) const;
    /// Whether an expression calls the function.
    [[nodiscard]] bool calls(std::string_view function) const;

    void write_rule(const HoudiniRule& rule, std::size_t index);
    /// Writes a variant of a rule; is_last: for the last, fractional generation.
    void write_variant(const HoudiniRule& rule,
                       const ParameterCounts& counts,
                       const std::string& name,
                       bool is_last);
    /// `slot`: index in `counts` of the next symbol of the turtle; advanced past those written.
    void write_pattern(const std::vector<HoudiniModule>& modules,
                       const ParameterCounts& counts,
                       std::size_t& slot);
    void write_formals(const HoudiniModule& head, std::uint32_t count, bool has_age);
    /// Writes the rule that ages a symbol matched by no other rule.
    void write_ageing(const HoudiniRule& rule, std::size_t index);
    /// The variants of a rule.
    [[nodiscard]] std::vector<ParameterCounts> all_parameter_counts(const HoudiniRule& rule) const;
    /// Key of rules with equal symbols in predecessor and contexts, which compete.
    [[nodiscard]] std::string group_of(const HoudiniRule& rule) const;
    /// Finds pairs of rules that together are a random choice: the only two rules of a group, the
    /// first with a condition that probability_of() knows, the second without a condition.
    void find_random_pairs();
    /// Probability that the condition `rand(seed) < number` or `rand(seed) > number` holds, as an
    /// expression; empty for other conditions.
    [[nodiscard]] std::string probability_of(ForeignId condition) const;
    /// Returns false after reporting a head that .lsys cannot express.
    bool check_head(const HoudiniRule& rule);

    [[nodiscard]] Word lower_word(const std::vector<HoudiniModule>& word,
                                  const HoudiniScope& scope);
    /// Finds the local values, from index `first` on, that a word reads, and gives them names.
    void name_locals(const Word& word, std::size_t first, std::set<std::string> taken);
    void write_word(const Word& word);
    void write_module(const Lowered& lowered_module);
    /// Scales a command of the last, fractional generation: its parameter, or the values of the
    /// turtle before the command, restored behind it.
    void write_scaled(const Lowered& lowered_module);
    void write_expression(ForeignId expression, const HoudiniScope& scope);
    [[nodiscard]] Lowered lower_module(const HoudiniModule& module, const HoudiniScope& scope);
    /// Lowers a turtle symbol that .lsys spells in another way; returns false for other symbols.
    bool lower_special(Lowered& lowered_module, char symbol, const HoudiniScope& scope);
    /// Random ranges of the three turns of `~`, drawn when the derivation writes the module.
    [[nodiscard]] std::vector<ForeignId> random_turns(const HoudiniModule& module,
                                                      const HoudiniScope& scope);
    /// The arguments of a module in the axiom or a successor, without the first `skip`.
    [[nodiscard]] std::vector<ForeignId>
    arguments(const HoudiniModule& module, std::uint32_t skip, const HoudiniScope& scope);
    /// The value of an omitted parameter: its default for a turtle command, else 0.
    [[nodiscard]] ForeignId
    omitted_argument(const HoudiniModule& module, std::uint32_t index, SourceSpan place);
    void write_symbol(const HoudiniModule& module);
    /// Warns, once per symbol, that lsc ignores the effect of the symbol.
    void warn_ignored_effect(char symbol, SourceSpan place);

    void report_syntax(SourceSpan place, const std::string& message) const;
    void report_unsupported(SourceSpan place, const std::string& message) const;

    HoudiniSession& session_;
    ForeignExpressions& tree_;
    Translation& translation_;
    HoudiniSymbols symbols_;
    std::map<std::string_view, SourceSpan> settings_; // place of the value, by name of the setting
    HoudiniExpressions expressions_;
    std::map<std::string, bool> has_probability_; // by group: whether a rule has a probability
    // Probability in place of a condition with `rand`.
    std::map<const HoudiniRule*, std::string> probabilities_;
    std::map<std::string_view, bool> aged_; // symbols whose ageing rule is written
    /// Parameters that the variant of a rule lacks.
    std::vector<std::string_view> omitted_parameters_;
    std::string warned_;                  // symbols that have been reported
    std::uint32_t fresh_ = 0;             // count of generated parameter names
    std::uint32_t generations_ = 0;       // rounded up
    std::string fraction_;                // part of the last generation; empty: all of it
    bool is_last_ = false;                // writing the last, fractional generation
    std::size_t premise_local_count_ = 0; // locals of the premise; first in tree_.locals()
};

} // namespace lsys
