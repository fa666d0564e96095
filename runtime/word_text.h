// A word as text (LANGUAGE.md section 10): what is printed parses again as the axiom of the same
// file.
#pragma once

#include "compiler/bytecode.h"
#include "runtime/word.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Prints modules of one word in order; may be fed in pieces.
class WordPrinter {
public:
    explicit WordPrinter(const Bytecode& bytecode);
    /// Appends the text of `codes`; `parameters` holds exactly what they store.
    void append(std::span<const Code> codes, std::span<const float> parameters, std::string& out);
    /// Appends a whole word, handing text to `flush` in pieces; false as soon as flush returns
    /// false.
    [[nodiscard]] bool print(const Word& word, const std::function<bool(std::string_view)>& flush);

private:
    struct Spelling {
        std::string text; // folded arguments included
        bool starts_identifier = false;
        bool ends_identifier = false; // an identifier without parameters
        std::uint32_t parameter_count = 0;
    };
    std::vector<Spelling> spellings_; // by code
    bool after_identifier_ = false;
};

} // namespace lsys
