// SPDX-License-Identifier: MIT
// The words of the language with their meanings, for hovers and completion.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct StatementHelp {
    std::string_view name;    // `#define`
    std::string_view form;    // `#define NAME expr;`
    std::string_view meaning; // one line
};
[[nodiscard]] std::span<const StatementHelp> statement_helps();
[[nodiscard]] const StatementHelp* find_statement_help(std::string_view name);

struct FunctionHelp {
    std::string_view name;
    std::string_view parameters; // "x, y"
    std::string_view meaning;
};
/// The functions of the language.
[[nodiscard]] std::span<const FunctionHelp> function_helps();
[[nodiscard]] const FunctionHelp* find_function_help(std::string_view name);

struct SettingHelp {
    std::string name;
    std::string meaning;             // "an angle in degrees; default 90"
    std::vector<std::string> values; // words that it takes; empty for numbers
};
/// The settings, in the order of settings.def.
[[nodiscard]] std::vector<SettingHelp> setting_helps();
[[nodiscard]] std::optional<SettingHelp> find_setting_help(std::string_view name);

} // namespace lsys
