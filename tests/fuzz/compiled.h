// SPDX-License-Identifier: MIT
// Compilation of a text for the fuzz targets; no files are read.
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

/// The word after up to four generations as text, derived within small limits; without a word, the
/// reason.
[[nodiscard]] std::string derived_text(const lsys::Bytecode& bytecode);
