// SPDX-License-Identifier: MIT
// Words that authors bring from other languages, and their equivalents in .lsys. Checks for
// unknown words search this table before they look for similar names. Rows: synonyms.def.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace lsys {

enum class SynonymKind : std::uint8_t { Operator, Name, Function, Statement, Setting, Module };

/// A row of synonyms.def.
struct Synonym {
    SynonymKind kind{};
    std::string_view word;     // a function may include its parameters
    std::string_view source;   // where the word is from; may be empty
    std::string_view spelling; // the equivalent in .lsys; empty: there is none
    std::string_view advice;   // replacement or explanation; may be empty
};

/// Whether .lsys has a function of this name.
using FunctionTest = std::function<bool(std::string_view name)>;

/// The row of a word; null if there is none. Letter case is ignored, except for words of one
/// letter. Rows whose spelling calls a function for which `exists` is false are skipped.
[[nodiscard]] const Synonym*
find_synonym(SynonymKind kind, std::string_view word, const FunctionTest& exists);
/// The row of an operator, statement or setting. No spelling of these rows calls a function, so
/// none is skipped.
[[nodiscard]] const Synonym* find_synonym(SynonymKind kind, std::string_view word);

/// A help text: "`and` of Python is `&&` here". `word`: as the author wrote it.
[[nodiscard]] std::string help_for(const Synonym& synonym, std::string_view word);

} // namespace lsys
