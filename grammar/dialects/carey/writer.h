// SPDX-License-Identifier: MIT
// Writes the texts of a .rules file as .lsys modules, and reports their mistakes.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/dialects/carey/reader.h"
#include "grammar/dialects/impl/letter_modules.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The axiom, or a side of a rule.
enum class CareyText : std::uint8_t { Axiom, Left, Right };

/// `text` without blanks; left sides are compared in this form.
[[nodiscard]] std::string remove_blanks(std::string_view text);

class CareyWriter {
public:
    CareyWriter(const CareyFile& file, const ParseContext& context, Translation& translation);

    /// Writes the modules of an axiom or a side of a rule.
    void write(SourceSpan text, CareyText kind);

private:
    /// Returns false after reporting a character that cannot be a symbol.
    bool check_symbol(const LetterModule& module);
    void write_arguments(const LetterModule& module, CareyText kind);
    /// Reports a left side that matches within parentheses, because the forest generator replaces
    /// text.
    void check_arguments(const LetterModule& module);

    const ParseContext& context_;
    Translation& translation_;
    std::vector<std::string> left_sides_; // each left side once, without blanks
};

} // namespace lsys
