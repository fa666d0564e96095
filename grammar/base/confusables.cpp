// SPDX-License-Identifier: MIT
#include "grammar/base/confusables.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace lsys {

namespace {

// Sorted by character.
constexpr Confusable kTable[] = {
    {0x00A0, " ", "no-break space"},
    {0x00A6, "|", "broken bar"},
    {0x00A9, "(c)", "copyright sign"},
    {0x00AB, "\"", "angle quotation mark"},
    {0x00AD, "", "soft hyphen"},
    {0x00AE, "(r)", "registered sign"},
    {0x00B0, "", "degree sign"},
    {0x00B2, "^2", "superscript"},
    {0x00B3, "^3", "superscript"},
    {0x00B4, "'", "acute accent"},
    {0x00B7, "*", "middle dot"},
    {0x00B9, "^1", "superscript"},
    {0x00BA, "", "degree sign"},
    {0x00BB, "\"", "angle quotation mark"},
    {0x00BC, ".25", "fraction"},
    {0x00BD, ".5", "fraction"},
    {0x00BE, ".75", "fraction"},
    {0x00D7, "*", "multiplication sign"},
    {0x00F7, "/", "division sign"},
    {0x02B9, "'", "modifier prime"},
    {0x02BC, "'", "modifier apostrophe"},
    {0x02C4, "^", "modifier up arrowhead"},
    {0x02C6, "^", "modifier circumflex"},
    {0x02DA, "", "degree sign"},
    {0x02DC, "~", "small tilde"},
    {0x037E, ";", "Greek question mark"},
    {0x0391, "A", "Greek capital alpha"},
    {0x0392, "B", "Greek capital beta"},
    {0x0395, "E", "Greek capital epsilon"},
    {0x0396, "Z", "Greek capital zeta"},
    {0x0397, "H", "Greek capital eta"},
    {0x0399, "I", "Greek capital iota"},
    {0x039A, "K", "Greek capital kappa"},
    {0x039C, "M", "Greek capital mu"},
    {0x039D, "N", "Greek capital nu"},
    {0x039F, "O", "Greek capital omicron"},
    {0x03A1, "P", "Greek capital rho"},
    {0x03A4, "T", "Greek capital tau"},
    {0x03A5, "Y", "Greek capital upsilon"},
    {0x03A7, "X", "Greek capital chi"},
    {0x03BF, "o", "Greek small omicron"},
    {0x0405, "S", "Cyrillic capital dze"},
    {0x0406, "I", "Cyrillic capital i"},
    {0x0408, "J", "Cyrillic capital je"},
    {0x0410, "A", "Cyrillic capital a"},
    {0x0412, "B", "Cyrillic capital ve"},
    {0x0415, "E", "Cyrillic capital ie"},
    {0x041A, "K", "Cyrillic capital ka"},
    {0x041C, "M", "Cyrillic capital em"},
    {0x041D, "H", "Cyrillic capital en"},
    {0x041E, "O", "Cyrillic capital o"},
    {0x0420, "P", "Cyrillic capital er"},
    {0x0421, "C", "Cyrillic capital es"},
    {0x0422, "T", "Cyrillic capital te"},
    {0x0425, "X", "Cyrillic capital ha"},
    {0x0430, "a", "Cyrillic small a"},
    {0x0435, "e", "Cyrillic small ie"},
    {0x043E, "o", "Cyrillic small o"},
    {0x0440, "p", "Cyrillic small er"},
    {0x0441, "c", "Cyrillic small es"},
    {0x0443, "y", "Cyrillic small u"},
    {0x0445, "x", "Cyrillic small ha"},
    {0x0455, "s", "Cyrillic small dze"},
    {0x0456, "i", "Cyrillic small i"},
    {0x0458, "j", "Cyrillic small je"},
    {0x1680, " ", "Ogham space"},
    {0x180E, "", "Mongolian vowel separator"},
    {0x2000, " ", "en quad"},
    {0x2001, " ", "em quad"},
    {0x2002, " ", "en space"},
    {0x2003, " ", "em space"},
    {0x2004, " ", "three-per-em space"},
    {0x2005, " ", "four-per-em space"},
    {0x2006, " ", "six-per-em space"},
    {0x2007, " ", "figure space"},
    {0x2008, " ", "punctuation space"},
    {0x2009, " ", "thin space"},
    {0x200A, " ", "hair space"},
    {0x200B, "", "zero-width space"},
    {0x200C, "", "zero-width non-joiner"},
    {0x200D, "", "zero-width joiner"},
    {0x200E, "", "left-to-right mark"},
    {0x200F, "", "right-to-left mark"},
    {0x2010, "-", "hyphen"},
    {0x2011, "-", "no-break hyphen"},
    {0x2012, "-", "figure dash"},
    {0x2013, "-", "en dash"},
    {0x2014, "-", "em dash"},
    {0x2015, "-", "horizontal bar"},
    {0x2018, "'", "curly quote"},
    {0x2019, "'", "curly quote"},
    {0x201A, "'", "low quote"},
    {0x201B, "'", "curly quote"},
    {0x201C, "\"", "curly quote"},
    {0x201D, "\"", "curly quote"},
    {0x201E, "\"", "low quote"},
    {0x201F, "\"", "curly quote"},
    {0x2022, "*", "bullet"},
    {0x2024, ".", "one dot leader"},
    {0x2026, "...", "ellipsis"},
    {0x2028, " ", "line separator"},
    {0x2029, " ", "paragraph separator"},
    {0x202F, " ", "narrow no-break space"},
    {0x2032, "'", "prime"},
    {0x2033, "\"", "double prime"},
    {0x2035, "`", "reversed prime"},
    {0x2039, "<", "angle quotation mark"},
    {0x203A, ">", "angle quotation mark"},
    {0x2044, "/", "fraction slash"},
    {0x204E, "*", "low asterisk"},
    {0x205F, " ", "mathematical space"},
    {0x2060, "", "word joiner"},
    {0x2070, "^0", "superscript"},
    {0x2074, "^4", "superscript"},
    {0x2075, "^5", "superscript"},
    {0x2076, "^6", "superscript"},
    {0x2077, "^7", "superscript"},
    {0x2078, "^8", "superscript"},
    {0x2079, "^9", "superscript"},
    {0x207B, "^-", "superscript"},
    {0x2080, "0", "subscript"},
    {0x2081, "1", "subscript"},
    {0x2082, "2", "subscript"},
    {0x2083, "3", "subscript"},
    {0x2084, "4", "subscript"},
    {0x2085, "5", "subscript"},
    {0x2086, "6", "subscript"},
    {0x2087, "7", "subscript"},
    {0x2088, "8", "subscript"},
    {0x2089, "9", "subscript"},
    {0x2150, "(1/7)", "fraction"},
    {0x2151, "(1/9)", "fraction"},
    {0x2152, ".1", "fraction"},
    {0x2153, "(1/3)", "fraction"},
    {0x2154, "(2/3)", "fraction"},
    {0x2155, ".2", "fraction"},
    {0x2156, ".4", "fraction"},
    {0x2157, ".6", "fraction"},
    {0x2158, ".8", "fraction"},
    {0x2159, "(1/6)", "fraction"},
    {0x215A, "(5/6)", "fraction"},
    {0x215B, ".125", "fraction"},
    {0x215C, ".375", "fraction"},
    {0x215D, ".625", "fraction"},
    {0x215E, ".875", "fraction"},
    {0x2192, ":", "arrow"},
    {0x21D2, ":", "double arrow"},
    {0x21E8, ":", "arrow"},
    {0x2212, "-", "minus sign"},
    {0x2215, "/", "division slash"},
    {0x2216, "\\", "set minus"},
    {0x2217, "*", "asterisk operator"},
    {0x2219, "*", "bullet operator"},
    {0x2223, "|", "divides sign"},
    {0x2225, "||", "parallel sign"},
    {0x2227, "^", "wedge"},
    {0x2228, "||", "logical or"},
    {0x2236, ":", "ratio"},
    {0x223C, "~", "tilde operator"},
    {0x2260, "!=", "not-equal sign"},
    {0x2264, "<=", "less-or-equal sign"},
    {0x2265, ">=", "greater-or-equal sign"},
    {0x2266, "<=", "less-or-equal sign"},
    {0x2267, ">=", "greater-or-equal sign"},
    {0x22C5, "*", "dot operator"},
    {0x2303, "^", "up arrowhead"},
    {0x2329, "<", "angle bracket"},
    {0x232A, ">", "angle bracket"},
    {0x2500, "-", "box drawing line"},
    {0x2502, "|", "box drawing line"},
    {0x275D, "\"", "heavy quote"},
    {0x275E, "\"", "heavy quote"},
    {0x2768, "(", "ornamental parenthesis"},
    {0x2769, ")", "ornamental parenthesis"},
    {0x2795, "+", "heavy plus sign"},
    {0x2796, "-", "heavy minus sign"},
    {0x27E8, "<", "angle bracket"},
    {0x27E9, ">", "angle bracket"},
    {0x29F5, "\\", "reverse solidus operator"},
    {0x2A7D, "<=", "less-or-equal sign"},
    {0x2A7E, ">=", "greater-or-equal sign"},
    {0x3000, " ", "ideographic space"},
    {0x3001, ",", "ideographic comma"},
    {0x3002, ".", "ideographic full stop"},
    {0x3008, "<", "angle bracket"},
    {0x3009, ">", "angle bracket"},
    {0x301D, "\"", "quotation mark"},
    {0x301E, "\"", "quotation mark"},
    {0xFB00, "ff", "ligature ff"},
    {0xFB01, "fi", "ligature fi"},
    {0xFB02, "fl", "ligature fl"},
    {0xFB03, "ffi", "ligature ffi"},
    {0xFB04, "ffl", "ligature ffl"},
    {0xFB05, "st", "ligature st"},
    {0xFB06, "st", "ligature st"},
    {0xFEFF, "", "byte order mark"},
};
static_assert(std::is_sorted(std::begin(kTable),
                             std::end(kTable),
                             [](const auto& a, const auto& b) {
                                 return a.character < b.character;
                             }));

/// A character of confusables.def. A row has no pointers: the loader would have to relocate the
/// pointers of all rows at the start of the program.
struct Listed {
    char32_t character = 0;
    char ascii = '\0';
};

/// The characters of confusables.def, ascending.
constexpr auto kListed = [] {
#define LSYS_CONFUSABLES(ascii, ...) +std::size(std::initializer_list<char32_t>{__VA_ARGS__})
    constexpr std::size_t kCount = 0
#include "grammar/base/confusables.def"
        ;
#undef LSYS_CONFUSABLES
    std::array<Listed, kCount> listed{};
    std::size_t count = 0;
    const auto add = [&](const char(&ascii)[2], std::initializer_list<char32_t> characters) {
        for (const char32_t character : characters) {
            listed[count++] = {character, ascii[0]};
        }
    };
#define LSYS_CONFUSABLES(ascii, ...) add(ascii, {__VA_ARGS__});
#include "grammar/base/confusables.def"
#undef LSYS_CONFUSABLES
    std::sort(listed.begin(), listed.end(),
              [](const Listed& a, const Listed& b) { return a.character < b.character; });
    return listed;
}();

/// The row of a character in an ascending table; null if there is none.
template <typename Table>
auto find_row(const Table& table, char32_t character) {
    const auto found =
        std::lower_bound(std::begin(table), std::end(table), character,
                         [](const auto& row, char32_t wanted) { return row.character < wanted; });
    return found != std::end(table) && found->character == character ? &*found : nullptr;
}

constexpr char32_t kFirstFullWidth = 0xFF01; // `!`
constexpr char32_t kLastFullWidth = 0xFF5E;  // `~`

/// All ASCII characters: the memory of the one-character views that text_of() returns.
constexpr auto kAscii = [] {
    std::array<char, 128> ascii{};
    for (std::size_t i = 0; i < ascii.size(); ++i) {
        ascii[i] = static_cast<char>(i);
    }
    return ascii;
}();

std::string_view text_of(char ascii) {
    return {&kAscii[static_cast<unsigned char>(ascii)], 1};
}

} // namespace

std::optional<Confusable> find_confusable(char32_t character) {
    if (character >= kFirstFullWidth && character <= kLastFullWidth) {
        const char ascii = static_cast<char>('!' + (character - kFirstFullWidth));
        return Confusable{character, text_of(ascii), "full-width character"};
    }
    if (const Confusable* const named = find_row(kTable, character); named != nullptr) {
        return *named;
    }
    const Listed* const listed = find_row(kListed, character);
    return listed == nullptr ? std::nullopt
                             : std::optional(Confusable{character, text_of(listed->ascii), {}});
}

bool is_letter_beyond_ascii(char32_t character) {
    const bool is_symbol = character < 0xC0 || character == 0xD7 || character == 0xF7 ||
                           (character >= 0x2000 && character < 0x2C00) ||
                           (character >= 0x3000 && character < 0x3040) ||
                           (character >= 0xE000 && character < 0xF900) ||
                           (character >= 0xFE00 && character < 0xFE70) || character >= 0x1F000 ||
                           (character >= 0xFF00 && character < 0x10000);
    return !is_symbol;
}

std::string code_point_name(char32_t character) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    std::string digits;
    for (char32_t rest = character; rest != 0 || digits.size() < 4; rest >>= 4) {
        digits.insert(digits.begin(), kDigits[rest & 15u]);
    }
    return "U+" + digits;
}

} // namespace lsys
