// The message of a syntax error of a dialect: tokens that were expected, and the one found.
#pragma once

#include "grammar/ast/parse_context.h"

#include <string>
#include <string_view>

namespace lsys {

class SyntaxMessage {
public:
    SyntaxMessage(const ParseContext& context, SourceSpan place)
        : context_(context), place_(place) {}

    /// Adds an expected token, in words.
    void add_expected(std::string_view token);
    /// `saw`: the token found, in words.
    void report(std::string_view saw);

private:
    const ParseContext& context_;
    SourceSpan place_;
    std::string expected_;
    std::string last_;
    int count_ = 0;
};

} // namespace lsys
