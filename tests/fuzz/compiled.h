// SPDX-License-Identifier: MIT
// Compiles texts for the fuzz targets; reads no files.
#pragma once

#include "compiler/compile.h"
#include "grammar/dialects/dialect.h"

#include <optional>
#include <string>
#include <string_view>

/// Result of a compilation.
struct CompiledText {
    bool has_errors = false;
    std::optional<lsys::Bytecode> bytecode;
    std::string translation; // the .lsys text, if the text is in another dialect
};

[[nodiscard]] CompiledText
compile_text(std::string text, lsys::Dialect dialect, std::string_view system);

/// Derives up to four generations within small limits. Returns the word as text, or, if there is no
/// word, the reason.
[[nodiscard]] std::string derived_text(const lsys::Bytecode& bytecode);
