// SPDX-License-Identifier: MIT
// Resolves #n, #define and #param.
#pragma once

#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/resolution.h"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace lsys {

/// Reports a second statement of a kind that may occur only once; returns the message. `what`: the
/// kind in the message "a second ...". `second`, `first`: places of the two statements.
Diagnostic& report_duplicate(Resolution& resolution,
                             SourceSpan second,
                             SourceSpan first,
                             const std::string& what);

/// The exact value of a literal of digits only, if it fits 64 bits. Read from the text, since
/// binary32 cannot represent all whole numbers above 2^24.
[[nodiscard]] std::optional<std::uint64_t> exact_whole_number(const Resolution& resolution,
                                                              ExpressionId expression);

class DefinitionResolver {
public:
    DefinitionResolver(Resolution& resolution,
                       ConstantTable& constants,
                       ExpressionResolver& expressions);

    void generations(const GenerationsNode& node, SourceSpan statement);
    void define(const DefineNode& node);
    void param(const ParamNode& node);
    /// Names of -D without a #define or #param.
    [[nodiscard]] std::vector<std::string> unknown_definitions() const;

    /// Index of the next draw among the draws of #define, #param and #w.
    [[nodiscard]] std::uint32_t draw_position() const { return draw_position_; }
    void advance_draw_position(std::uint32_t count) { draw_position_ += count; }

private:
    /// Returns false after reporting that the name has a definition already.
    [[nodiscard]] bool check_first_definition(NameId name, SourceSpan span);
    /// Adds a constant. Its value is that of -D if given, else a global if the value is random,
    /// else the literal `value`.
    void add(Constant constant, ValueId value, bool is_random);
    /// Reports a value of a #param outside of its bounds.
    void check_bounds(const ParamNode& node, const Constant& constant);

    Resolution& resolution_;
    ConstantTable& constants_;
    ExpressionResolver& expressions_;
    std::unordered_map<std::string, float> replacements_; // values of -D, by name
    std::optional<SourceSpan> first_generations_;         // place of the first #n
    std::uint32_t draw_position_ = 0;
};

} // namespace lsys
