// Characters that PDF files and word processors put where a plain one is meant.
#pragma once

#include <string>
#include <string_view>

namespace lsys {

struct LookAlike {
    char32_t character = 0;
    std::string_view plain; // what is meant; empty: nothing
    std::string_view name;  // "minus sign"; empty for letters of other alphabets
};

/// Nullptr if `character` is none. Full-width forms are in the table as if written out.
[[nodiscard]] const LookAlike* find_look_alike(char32_t character);

/// Whether `character` is likely to be a letter, so that a word goes on with it.
[[nodiscard]] bool is_foreign_letter(char32_t character);

/// "U+2212".
[[nodiscard]] std::string code_point_name(char32_t character);

} // namespace lsys
