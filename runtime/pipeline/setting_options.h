// Values of `#set` from options: pairs of key and text become statements, with files of their own
// for the places of diagnostics.
#pragma once

#include "compiler/program/compile_options.h"
#include "grammar/ast/ast.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"
#include "runtime/pipeline/grammar.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lsys {

/// Parses `KEY=VALUES` and trims both; whether the setting exists and fits is checked later.
[[nodiscard]] Result<SettingText> parse_setting(std::string_view text);

/// The values of a key; empty: `settings` lacks it.
[[nodiscard]] std::string_view values_of(std::string_view key,
                                         std::span<const SettingText> settings);

/// Whether a setting is compiled into the bytecode, which then fits no other value.
[[nodiscard]] bool is_compiled_in(std::string_view key);

/// One `#set` statement per setting. Diagnostics of a setting point into its own file of `sources`,
/// which has the path `--set` and the text `KEY=VALUES`. None if `settings` is empty.
[[nodiscard]] std::optional<Ast> parse_settings(std::span<const SettingText> settings,
                                                SourceMap& sources,
                                                Names& names,
                                                Diagnostics& diagnostics);

/// Changes settings of a compiled grammar, read from `path`: numbers, `tropism`, `seed` and
/// `at_depth`. Error: other keys, which are compiled in. Appends diagnostics, whose places are in
/// `grammar.sources`.
[[nodiscard]] Result<void> change_compiled_settings(const std::string& path,
                                                    std::span<const SettingText> settings,
                                                    Grammar& grammar,
                                                    Diagnostics& diagnostics);

} // namespace lsys
