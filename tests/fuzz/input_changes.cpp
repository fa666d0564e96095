// SPDX-License-Identifier: MIT
#include "tests/fuzz/input_changes.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace {

/// A pseudo-random sequence (Steele, Lea and Flood 2014, SplitMix64).
class Choices {
public:
    explicit Choices(std::uint64_t seed) : state_(seed) {}
    std::size_t below(std::size_t count) {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t mixed = state_;
        mixed = (mixed ^ mixed >> 30U) * 0xBF58476D1CE4E5B9U;
        mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBU;
        return (mixed ^ mixed >> 31U) % count;
    }
    /// A part of a text, most often short.
    std::string_view part(std::string_view text) {
        const std::size_t begin = below(text.size() + 1);
        return text.substr(begin, 1 + below(below(4) == 0 ? text.size() + 1 : 12));
    }

private:
    std::uint64_t state_;
};

/// Numbers at the limits of what readers expect.
constexpr std::array<std::string_view, 16> kNumbers{
    "0",     "1",   "-1",  "2147483648", "4294967296", "18446744073709551616", "-0",    "1e39",
    "1e-46", "nan", "inf", "0.1",        ".",          "99999999999",          "1e999", "0x7f"};

void change(std::string& text, std::string_view other, Choices& choices) {
    const std::size_t at = choices.below(text.size() + 1);
    switch (choices.below(8)) {
    case 0:
        text.insert(at, 1, static_cast<char>(choices.below(256)));
        return;
    case 1:
        text.erase(at, 1 + choices.below(choices.below(4) == 0 ? text.size() + 1 : 4));
        return;
    case 2: {
        const std::string repeated(choices.part(text));
        text.insert(at, repeated);
        return;
    }
    case 3:
        text.insert(at, choices.part(other));
        return;
    case 4: { // replaces a number, where one is near
        const std::size_t begin = std::min(text.find_first_of("0123456789", at), text.size());
        const std::size_t end =
            std::min(text.find_first_not_of("0123456789.eE+-", begin), text.size());
        text.replace(begin, end - begin, kNumbers[choices.below(kNumbers.size())]);
        return;
    }
    case 5: { // inserts a part of the text after a line end, as the beginning of the next line
        const std::size_t line = std::min(text.find('\n', at), text.size());
        text.insert(line, "\n" + std::string(choices.part(text)));
        return;
    }
    default:
        if (at < text.size()) {
            const auto byte = static_cast<unsigned char>(text[at]);
            text[at] = static_cast<char>(choices.below(2) == 0 ? byte ^ 1U << choices.below(8)
                                                               : choices.below(256));
        }
    }
}

} // namespace

std::string changed_bytes(std::string_view text, std::string_view other, std::uint64_t seed) {
    Choices choices(seed);
    std::string changed(text);
    for (std::size_t count = 1 + choices.below(6); count > 0; --count) {
        change(changed, other, choices);
    }
    return changed;
}
