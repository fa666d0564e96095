// SPDX-License-Identifier: MIT
// Derives words from texts with characters beyond ASCII. Inserts a few characters into the text, at
// places that depend on the text alone: typographic characters, letters, invisible characters and
// damaged UTF-8. If a text compiles, its formatted form must compile, too.
#include "grammar/base/source.h"
#include "grammar/format/format.h"
#include "tests/fuzz/compiled.h"

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::array<std::string_view, 48> kCharacters{
    "\u00e9", "\u00df", "\u03b4", "\u0410", "\u0456", "\u6f22", "\uff26", "\uff11",
    "\ufb01", "\ufb03", "\u2212", "\u2013", "\u00d7", "\u2217", "\u00b7", "\u2044",
    "\u2039", "\u203a", "\u2264", "\u2260", "\uff1a", "\uff1b", "\uff08", "\uff09",
    "\uff03", "\uff1d", "\uff0c", "\uff3b", "\uff5b", "\uff40", "\u201c", "\u201d",
    "\u00ab", "\u2035", "\u2019", "\u2026", "\u2192", "\u2228", "\u00b0", "\U0001f600",
    "\u00a0", "\u200b", "\ufeff", "\u00ad", "\u0301", "\xff",   "\xc3",   "\xe2\x88",
};

/// A pseudo-random sequence (xorshift) whose seed is a hash of a text.
class Choices {
public:
    explicit Choices(std::string_view text) {
        for (const char c : text) {
            state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
        }
    }
    std::size_t below(std::size_t count) {
        state_ ^= state_ << 13U;
        state_ ^= state_ >> 7U;
        state_ ^= state_ << 17U;
        return state_ % count;
    }

private:
    std::size_t state_ = 0xCBF29CE484222325U;
};

void put_characters(std::string& text, Choices& choices) {
    for (std::size_t count = 1 + choices.below(4); count > 0; --count) {
        const std::string_view character = kCharacters[choices.below(kCharacters.size())];
        const std::size_t at = choices.below(text.size() + 1);
        const std::size_t replaced = at < text.size() ? choices.below(2) : 0;
        text.replace(at, replaced, character);
        if (choices.below(4) == 0) {
            text.insert(at, character);
        }
    }
}

void try_text(const std::string& text) {
    const CompiledText compiled = compile_text(text, lsys::Dialect::Lsys, "");
    if (compiled.bytecode) {
        static_cast<void>(derived_text(*compiled.bytecode));
        const lsys::SourceFile file("fuzz", text); // removes a byte order mark
        const std::string formatted = lsys::format_text(file.text());
        if (compile_text(formatted, lsys::Dialect::Lsys, "").has_errors) {
            std::abort();
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr int kTries = 4;
    const std::string text(data, data + size);
    Choices choices(text);
    for (int i = 0; i < kTries; ++i) {
        std::string changed = text;
        put_characters(changed, choices);
        try_text(changed);
    }
    // Also tries a short part of the text by itself, in which each inserted character matters.
    std::string statement = text.substr(choices.below(text.size() + 1), 1 + choices.below(40));
    put_characters(statement, choices);
    try_text(statement);
    return 0;
}
