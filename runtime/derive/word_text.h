// SPDX-License-Identifier: MIT
// A word as text (docs/language.md section 10), which parses again as the axiom of the same file.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/word.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A name as written in a list of modules: in back quotes unless it is a symbol of the language, an
/// identifier or, with `names letters`, a single letter.
[[nodiscard]] std::string spelled_name(std::string_view name, bool letters);
/// Appends a number as printed in words: the shortest text that reads back equal.
void append_number(float value, std::string& out);

/// Prints the modules of one word in order; the word may come in pieces.
class WordPrinter {
public:
    explicit WordPrinter(const Bytecode& bytecode);
    /// Starts a new word: the next module does not follow the last one printed.
    void begin() { after_identifier_ = false; }
    /// The text before and after a word that is not empty: a back quote if words are printed as one
    /// text (`names characters`). print() writes these quotes, append() does not.
    [[nodiscard]] std::string_view quote() const { return one_text_ ? "`" : ""; }
    /// Appends the text of `codes`, whose parameters are `parameters`.
    void append(std::span<const Code> codes, std::span<const float> parameters, std::string& out);
    /// Passes the text of a whole word to `flush` in pieces. Returns false as soon as `flush`
    /// returns false.
    [[nodiscard]] bool print(const Word& word, const std::function<bool(std::string_view)>& flush);

private:
    static constexpr std::size_t kShort = 16; // bytes of Spelling::head

    struct Spelling {
        std::array<char, kShort> head{}; // the text if it fits
        std::uint32_t length = 0;        // bytes of the text
        std::uint32_t long_text = 0;     // index of a longer text in long_texts_
        std::uint32_t parameter_count = 0;
        bool starts_identifier = false;
        bool ends_identifier =
            false; // the text ends with an identifier, since no parameters follow
    };
    /// The text of two adjacent modules; length 0 if they are printed one by one.
    struct Pair {
        std::array<char, kShort - 1> text{};
        std::uint8_t length = 0;
    };
    using Sink = std::function<bool(std::string_view)>;

    /// Makes pairs_.
    void make_pairs();
    /// print() without the quotes around the word.
    [[nodiscard]] bool print_modules(const Word& word, const Sink& flush);
    /// Prints words whose modules are one character each, by a table.
    [[nodiscard]] bool write_letters(std::span<const std::uint8_t> codes, const Sink& sink);

    template <typename C>
    [[nodiscard]] bool
    write(const C* codes, std::size_t count, const float* parameters, const Sink& sink);

    std::vector<Spelling> spellings_; // by code; folded arguments included
    std::vector<std::string> long_texts_;
    std::vector<char> letters_; // by code, if every module is one character
    std::vector<Pair> pairs_;   // by after_identifier_, first and second code; empty: none made yet
    std::vector<char> buffer_;  // text that is not flushed yet
    bool after_identifier_ = false; // the module printed last ends with an identifier
    bool one_text_ = false;         // words are printed as one text in back quotes, see quote()
};

} // namespace lsys
