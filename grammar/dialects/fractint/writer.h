// SPDX-License-Identifier: MIT
// Writes an entry of a Fractint collection as .lsys text, and reports its mistakes.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/dialects/fractint/reader.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

class FractintWriter {
public:
    FractintWriter(const std::vector<FractintLine>& lines,
                   SourceSpan name,
                   const ParseContext& context,
                   Translation& translation)
        : lines_(lines), name_(name), context_(context), translation_(translation) {}

    /// Writes the system as .lsys statements. `turtle`: name of the turtle profile.
    void write(std::string_view turtle);

private:
    /// All lines that replace one symbol.
    struct Rule {
        char symbol = 0;
        SourceSpan key;
        std::vector<const FractintLine*> lines;
    };

    void write_angle(const FractintLine& line);
    void write_rule(const Rule& rule, std::size_t number);
    /// Writes the words of a line, without the `=` between its sides, as modules.
    void write_text(const FractintLine& line);
    void write_word(SourceSpan word);
    /// Writes the number at the start of `rest`, after a command; returns its length in bytes. A
    /// prefix `I` inverts the number, `Q` takes its square root.
    std::uint32_t write_number(SourceSpan command, std::string_view rest);
    void write_symbol(SourceSpan symbol);
    /// Adds the line to the rule of its symbol, after check_key() and check_texts().
    void add_rule(const FractintLine& line, std::vector<Rule>& rules);
    /// Returns false after reporting a key that is not one symbol, or a symbol that cannot have a
    /// rule.
    bool check_key(const FractintLine& line);
    /// Reports the words of a line that Fractint does not read.
    void check_texts(const FractintLine& line);
    /// Warns that Fractint reads the text in an unexpected way.
    void warn_quirk(SourceSpan place, const std::string& message);
    void report_syntax(SourceSpan place, const std::string& message);

    const std::vector<FractintLine>& lines_;
    SourceSpan name_; // place of the name of the system
    const ParseContext& context_;
    Translation& translation_;
    bool has_repeated_key_ = false; // a second `Angle` or `Axiom` has been reported
    bool has_unknown_key_ = false;  // a line begins with a word that is not a key
};

} // namespace lsys
