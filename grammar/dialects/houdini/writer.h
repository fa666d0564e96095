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
    [[nodiscard]] std::string number(std::string_view name, const char* fallback) const;

    void read_settings();
    void read_setting(const HoudiniSettingRow& row, SourceSpan key, SourceSpan value);
    void read_generations();
    [[nodiscard]] bool is_on(std::string_view name) const;
    void write_random_scale();
    void write_settings(std::string_view turtle);
    void write_values();
    [[nodiscard]] bool reads_variable(std::string_view value) const;
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
    void write_ageing(const HoudiniRule& rule, std::size_t index);
    [[nodiscard]] std::vector<ParameterCounts> all_parameter_counts(const HoudiniRule& rule) const;
    /// Key of rules with equal symbols in predecessor and contexts, which compete.
    [[nodiscard]] std::string group_of(const HoudiniRule& rule) const;
    void find_random_pairs();
    [[nodiscard]] std::string probability_of(ForeignId condition) const;
    bool check_head(const HoudiniRule& rule);

    [[nodiscard]] Word lower_word(const std::vector<HoudiniModule>& word,
                                  const HoudiniScope& scope);
    /// Finds which local values from index `first` on a word reads, and gives them names.
    void name_locals(const Word& word, std::size_t first, std::set<std::string> taken);
    void write_word(const Word& word);
    void write_module(const Lowered& made);
    /// Scales a command of the last, fractional generation: its parameter, or the values of the
    /// turtle before the command, restored behind it.
    void write_scaled(const Lowered& made);
    void write_expression(ForeignId expression, const HoudiniScope& scope);
    [[nodiscard]] Lowered lower_module(const HoudiniModule& module, const HoudiniScope& scope);
    bool lower_special(Lowered& made, char symbol, const HoudiniScope& scope);
    [[nodiscard]] std::vector<ForeignId> random_turns(const HoudiniModule& module,
                                                      const HoudiniScope& scope);
    [[nodiscard]] std::vector<ForeignId>
    arguments(const HoudiniModule& module, std::uint32_t skip, const HoudiniScope& scope);
    [[nodiscard]] ForeignId
    omitted_argument(const HoudiniModule& module, std::uint32_t index, SourceSpan place);
    void write_symbol(const HoudiniModule& module);
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
