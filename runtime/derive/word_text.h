// A word as text (docs/language.md section 10): what is printed parses again as the axiom of the
// same file.
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

/// A name as it is written in a list of modules: back quotes where it is no symbol of the
/// language, or, with `names letters`, no single letter.
[[nodiscard]] std::string spelled_name(std::string_view name, bool letters);
/// A number as a word shows it.
void append_number(float value, std::string& out);

/// Prints modules of one word in order; may be fed in pieces.
class WordPrinter {
public:
    explicit WordPrinter(const Bytecode& bytecode);
    /// What comes next is not behind what was printed before.
    void begin() { after_identifier_ = false; }
    /// What stands before and behind a word that is not empty: with `names characters` it is one
    /// text in back quotes. print() writes it, append() does not.
    [[nodiscard]] std::string_view quote() const { return one_text_ ? "`" : ""; }
    /// Appends the text of `codes`; `parameters` holds exactly what they store.
    void append(std::span<const Code> codes, std::span<const float> parameters, std::string& out);
    /// Hands the text of a whole word to `flush` in pieces; false as soon as flush returns false.
    [[nodiscard]] bool print(const Word& word, const std::function<bool(std::string_view)>& flush);

private:
    static constexpr std::size_t kShort = 16;

    struct Spelling {
        std::array<char, kShort> head{}; // the text, if it is short
        std::uint32_t length = 0;
        std::uint32_t long_text = 0; // otherwise, in long_texts_
        std::uint32_t parameter_count = 0;
        bool starts_identifier = false;
        bool ends_identifier = false; // an identifier without parameters
    };
    /// Two neighbours as one short text. Length 0: they are written one after the other.
    struct Pair {
        std::array<char, kShort - 1> text{};
        std::uint8_t length = 0;
    };
    using Sink = std::function<bool(std::string_view)>;

    void make_pairs();
    [[nodiscard]] bool print_modules(const Word& word, const Sink& flush);
    [[nodiscard]] bool write_letters(std::span<const std::uint8_t> codes, const Sink& sink);

    template <typename C>
    [[nodiscard]] bool
    write(const C* codes, std::size_t count, const float* parameters, const Sink& sink);

    std::vector<Spelling> spellings_; // by code; folded arguments included
    std::vector<std::string> long_texts_;
    std::vector<char> letters_; // by code, if each code is one character and that is all
    std::vector<Pair> pairs_;   // by after_identifier_, first and second code; empty: not made
    std::vector<char> buffer_;
    bool after_identifier_ = false;
    bool one_text_ = false;
};

} // namespace lsys
