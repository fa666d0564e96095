// Values of `#set` from options: a list of keys and texts as statements with places of their own.
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

/// Parses `KEY=VALUES`; both are trimmed, and what they hold is checked later.
[[nodiscard]] Result<SettingText> parse_setting(std::string_view text);

/// The values of a key; empty: `settings` lacks it.
[[nodiscard]] std::string_view values_of(std::string_view key,
                                         std::span<const SettingText> settings);

/// Whether a setting decides how a grammar is compiled: bytecode fits no other value.
[[nodiscard]] bool is_compiled_in(std::string_view key);

/// One `#set` statement per setting. Each is a file `--set` of `sources` with the text
/// `KEY=VALUES`, where its diagnostics point to. None if `settings` is empty.
[[nodiscard]] std::optional<Ast> parse_settings(std::span<const SettingText> settings,
                                                SourceMap& sources,
                                                Names& names,
                                                Diagnostics& diagnostics);

/// Changes settings of a compiled grammar, read from `path`: numbers, `tropism`, `seed` and
/// `at_depth`. Error: other keys, which decided how it was compiled. Appends diagnostics, whose
/// places are in `grammar.sources`.
[[nodiscard]] Result<void> change_compiled_settings(const std::string& path,
                                                    std::span<const SettingText> settings,
                                                    Grammar& grammar,
                                                    Diagnostics& diagnostics);

} // namespace lsys
