// Recognition of texts that are no grammar in the language of their file: a cpfg model, JSON or
// Markdown named `.lsys`. They get one message, which names the language, instead of one for each
// line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lsys {

struct OtherLanguage {
    std::string name;        // "a cpfg L-system"
    std::string help;        // what to do
    std::uint32_t begin = 0; // first byte of the line that shows the language
    std::uint32_t end = 0;
};

/// The language of a text without any statement of .lsys; nullopt if no line shows it.
[[nodiscard]] std::optional<OtherLanguage> recognise_other_language(std::string_view text);
/// Whether a text without a telling name is in the notation of papers or of L-Py, which no dialect
/// reads, but messages explain.
[[nodiscard]] bool is_foreign_notation(std::string_view text);

} // namespace lsys
