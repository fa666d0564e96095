// SPDX-License-Identifier: MIT
// Parser of the short texts that BytecodeBuilder takes: modules, productions, and expressions,
// which it compiles to instructions. A mistake in a text ends the test program.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::test {

/// Prints a message about `text` and ends the test program.
[[noreturn]] void mistake(std::string_view what, std::string_view text);

struct ModuleText {
    std::string name;
    std::vector<std::string> arguments;
};
/// Reads modules, such as "F(1)[+(30)A]".
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
/// Reads a production, such as "p : A(x) < B > C [ D ] : x > 0 ~ 0.5 : F(x, {1, 2}) B".
[[nodiscard]] ProductionText read_production(const std::string& text);

/// The name of a formal parameter without blanks.
[[nodiscard]] std::string formal_name(std::string_view text);

using Instructions = std::vector<std::uint32_t>;
using NameTable = std::map<std::string, std::uint32_t>;

/// The names that an expression may use. Compiling the expression adds its number of draws to
/// `draws`, and sets `uses_steps` if the expression calls steps().
struct ExpressionScope {
    const NameTable& formals;
    const NameTable& globals;
    std::uint32_t& draws;
    bool& uses_steps;
};
/// The instructions of an expression, whose constant parts are folded. A constant expression
/// becomes one Literal.
[[nodiscard]] Instructions compile_expression(const std::string& text,
                                              const ExpressionScope& scope);
/// The value of instructions that consist of one Literal; nullopt for other instructions.
[[nodiscard]] std::optional<float> constant_of(const Instructions& code);

} // namespace lsys::test
