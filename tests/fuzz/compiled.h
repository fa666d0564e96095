// One compilation of a text, as the fuzz targets want it: nothing is read from files.
#pragma once

#include "compiler/compile.h"
#include "grammar/dialects/dialect.h"

#include <optional>
#include <string>
#include <string_view>

/// What a text became.
struct CompiledText {
    bool has_errors = false;
    std::optional<lsys::Bytecode> bytecode;
    std::string translation; // of another dialect
};

[[nodiscard]] CompiledText
compile_text(std::string text, lsys::Dialect dialect, std::string_view system);

/// The word after up to four generations as text, within small limits; else how it ended.
[[nodiscard]] std::string derived_text(const lsys::Bytecode& bytecode);
