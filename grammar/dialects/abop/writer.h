// SPDX-License-Identifier: MIT
// Writes a text in the notation of "The Algorithmic Beauty of Plants" as .lsys text.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/dialects/abop/reader.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

class AbopWriter {
public:
    AbopWriter(const AbopFile& file, const ParseContext& context, Translation& out);

    /// Writes all statements. `turtle`: name of the profile in `#set turtle`.
    void write(std::string_view turtle);

private:
    /// Place of modules: axiom or successor; predecessor or context; list of #ignore or #consider.
    enum class Place : std::uint8_t { Word, Pattern, List };
    struct Symbol {
        SourceSpan span;
        std::string name; // name in .lsys, in back quotes where necessary
        SourceSpan inner; // between the parentheses; empty: there are none
        bool has_arguments = false;
    };

    struct Parentheses {
        std::size_t close = 0; // offset of the `)`
        bool is_empty = true;
        bool has_comma = false; // between two arguments
    };

    [[nodiscard]] std::string_view text(SourceSpan span) const { return file_.text_of(span); }
    /// The span of bytes [begin, end) of the file without blanks at its ends.
    [[nodiscard]] SourceSpan trimmed_part(std::size_t begin, std::size_t end) const;
    void report(SourceSpan place, const std::string& message);

    /// Sets long_names_: a predecessor of several letters and digits is one symbol wherever it
    /// occurs. If several such symbols begin at one place, the longest is read.
    void find_long_names();
    /// Writes `before` and the value of a setting; nothing if the file has no such setting.
    void write_setting(AbopKey key, std::string_view before);
    /// Whether the text, with its comments, has the character of a symbol that changes widths.
    [[nodiscard]] bool sets_widths() const;
    /// Whether the left side of a rule is one symbol that rules may replace; reports others.
    [[nodiscard]] bool check_predecessor(const AbopRule& rule);
    void write_rule(const AbopRule& rule, std::size_t index);
    /// Writes `~` and a probability.
    void write_chance(SourceSpan chance);
    /// The label if it can be the name of a production, else `rN`.
    [[nodiscard]] std::string label_of(const AbopRule& rule, std::size_t index);
    /// Writes the `#object` and `#interpret` statements by which symbols such as `F_l` and `~L`
    /// draw.
    void write_drawings();

    void write_modules(SourceSpan list, Place place);
    /// Reads the symbol at `at`, with its arguments.
    [[nodiscard]] bool read_symbol(SourceSpan list, std::size_t& at, Symbol& symbol);
    /// Bytes of the symbol of several characters at the start of `ahead`; 1 if there is none.
    [[nodiscard]] std::size_t long_name_length(std::string_view ahead) const;
    /// Sets Symbol::name to the .lsys name of the symbol `written`.
    void name_symbol(Symbol& symbol, std::string_view written);
    void write_arguments(const Symbol& symbol, Place place);
    [[nodiscard]] std::vector<SourceSpan> arguments_of(const Symbol& symbol) const;
    [[nodiscard]] bool write_formal(SourceSpan formal, SourceSpan symbol);

    /// Finds the parentheses of an expression; reports those that do not match.
    [[nodiscard]] bool find_parentheses(SourceSpan expression);
    /// `is_condition`: a single `=` is a comparison.
    void write_expression(SourceSpan expression, bool is_condition);
    /// Writes the name at `at`; returns the position after it, npos after a mistake.
    [[nodiscard]] std::size_t write_name(SourceSpan expression, std::size_t at);
    /// Writes the start of `random()`, `random(high)` or `random(low, high)` as a range; the `)`
    /// ends the range. Returns the position after the `(`.
    [[nodiscard]] std::size_t write_random(SourceSpan name, std::size_t open);
    /// Writes the operator at `at`; returns the position after it, npos after a mistake.
    [[nodiscard]] std::size_t write_operator(std::size_t at, std::size_t end, bool is_condition);

    const AbopFile& file_;
    const ParseContext& context_;
    Translation& out_;
    std::set<std::string_view> constants_;           // names of constants
    std::set<std::string, std::less<>> long_names_;  // symbols of several characters
    std::map<std::string, SourceSpan> leaves_;       // surfaces `~X`
    std::map<std::string, SourceSpan> segments_;     // name and formals of symbols drawn as F or f
    std::set<std::string> labels_;                   // names in use by productions
    std::set<std::string, std::less<>> formals_;     // formals of the rule that is being written
    std::map<std::size_t, Parentheses> parentheses_; // parentheses of expressions, by offset
    std::set<std::size_t> range_ends_;               // offsets of `)` that end random ranges
    std::optional<SourceSpan> sphere_;               // the first `@O(d)`
    std::optional<SourceSpan> reported_head_;        // the last head with a reported mistake
    // Nesting depth of settings whose values are being written in place of their names.
    std::uint32_t depth_ = 0;
};

} // namespace lsys
