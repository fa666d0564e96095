// SPDX-License-Identifier: MIT
// Values of `#set` from options: each pair of key and text becomes a statement in a file of its
// own, so that diagnostics have places.
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

/// Parses `KEY=VALUES` and trims key and values. Later steps check that the setting exists and that
/// the values fit.
[[nodiscard]] Result<SettingText> parse_setting(std::string_view text);

/// The values of a key; empty if `settings` does not have it.
[[nodiscard]] std::string_view values_of(std::string_view key,
                                         std::span<const SettingText> settings);

/// Whether the bytecode depends on the setting, so that the setting of a .lsb file cannot change.
[[nodiscard]] bool is_compiled_in(std::string_view key);

/// Makes one `#set` statement per setting. Diagnostics of a setting point into its own file of
/// `sources`, with the path `--set` and the text `KEY=VALUES`. Nothing if `settings` is empty.
[[nodiscard]] std::optional<Ast> parse_settings(std::span<const SettingText> settings,
                                                SourceMap& sources,
                                                Names& names,
                                                Diagnostics& diagnostics);

/// Changes settings of a compiled grammar that was read from `path`: numbers, `tropism`, `seed` and
/// `at_depth`. Error: a key that is_compiled_in(). Appends diagnostics with places in
/// `grammar.sources`.
[[nodiscard]] Result<void> change_compiled_settings(const std::string& path,
                                                    std::span<const SettingText> settings,
                                                    Grammar& grammar,
                                                    Diagnostics& diagnostics);

} // namespace lsys
