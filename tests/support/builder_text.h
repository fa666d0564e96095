// SPDX-License-Identifier: MIT
// Parser of the short texts of BytecodeBuilder: modules, productions, and expressions compiled to
// instructions. A mistake in a text ends the test program.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::test {

[[noreturn]] void mistake(std::string_view what, std::string_view text);

struct ModuleText {
    std::string name;
    std::vector<std::string> arguments;
};
[[nodiscard]] std::vector<ModuleText> read_modules(std::string_view text);

struct ProductionText {
    std::string name;
    std::optional<std::string> left;
    std::string predecessor;
    std::optional<std::string> right;
    std::string condition; // empty: `*`
    std::optional<float> weight;
    std::string successor;
};
/// Reads "p : A(x) < B > C [ D ] : x > 0 ~ 0.5 : F(x, {1, 2}) B".
[[nodiscard]] ProductionText read_production(const std::string& text);

/// The name of a formal parameter without blanks.
[[nodiscard]] std::string formal_name(std::string_view text);

using Instructions = std::vector<std::uint32_t>;
using NameTable = std::map<std::string, std::uint32_t>;

/// The names in scope of an expression. Compiling the expression adds its draws to `draws` and sets
/// `uses_steps` if it calls steps().
struct ExpressionScope {
    const NameTable& formals;
    const NameTable& globals;
    std::uint32_t& draws;
    bool& uses_steps;
};
/// The instructions of an expression with constant parts folded; a constant is one Literal.
[[nodiscard]] Instructions compile_expression(const std::string& text,
                                              const ExpressionScope& scope);
/// The value of instructions that consist of one Literal.
[[nodiscard]] std::optional<float> constant_of(const Instructions& code);

} // namespace lsys::test
