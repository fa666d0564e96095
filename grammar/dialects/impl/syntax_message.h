// SPDX-License-Identifier: MIT
// Messages for syntax errors of a dialect. They name the expected tokens and the one found, or the
// likely cause: a character that looks like another, a misspelt keyword, or an arrow of another
// language.
#pragma once

#include "grammar/ast/parse_context.h"

#include <span>
#include <string>
#include <string_view>

namespace lsys {

/// Words of a dialect, for messages about its lines.
struct DialectWords {
    std::string_view name; // name of the dialect: "cpfg"
    /// Keywords in lower case, which stand before a `:` or alone.
    std::span<const std::string_view> keys;
    std::string_view arrow; // between the sides of a rule
};

class SyntaxMessage {
public:
    /// `words`: null if the dialect has no keywords.
    SyntaxMessage(const ParseContext& context, SourceSpan place, const DialectWords* words)
        : context_(context), place_(place), words_(words) {}

    /// Adds an expected token, in words.
    void add_expected(std::string_view token);
    /// `found`: the token found, in words.
    void report(std::string_view found);

private:
    /// Reports a character that looks like an ASCII character; returns false for others.
    [[nodiscard]] bool report_look_alike();
    /// Reports a line that begins with a misspelt keyword; returns false for other lines.
    [[nodiscard]] bool report_key();
    /// Reports an arrow of another language at the place or before it; returns false if there is
    /// none.
    [[nodiscard]] bool report_arrow();

    const ParseContext& context_;
    SourceSpan place_;
    const DialectWords* words_;
    std::string expected_; // expected tokens except the last one, with commas
    std::string last_;     // the expected token added last
    int count_ = 0;        // number of expected tokens
};

/// Reports the character at the start of `place` with a fix, if it looks like an ASCII character;
/// returns whether it does.
bool report_foreign_look_alike(SourceSpan place, const ParseContext& context);
/// Adds "did you mean `name`?" with a fix, if a name is similar.
void suggest_key(Diagnostic& diagnostic,
                 SourceSpan place,
                 std::string_view written,
                 std::span<const std::string_view> names);

} // namespace lsys
