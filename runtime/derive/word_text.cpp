// SPDX-License-Identifier: MIT
#include "runtime/derive/word_text.h"

#include "grammar/base/names.h"
#include "grammar/base/number_chars.h"

#include <algorithm>
#include <cstring>

namespace lsys {

namespace {

constexpr std::string_view kSymbols = "+-/\\^&|$!\"'.[]{}%";
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;
/// Limits for printing two modules at a time.
constexpr std::size_t kMaxPairedCodes = 64;  // max codes of the program
constexpr std::size_t kMinPairedWord = 4096; // min modules of the word
/// Room for the longest binary32 as text and a comma or parenthesis.
constexpr std::size_t kNumberBytes = 24;

bool is_one_character(std::string_view name) {
    // Names are valid UTF-8: all bytes but the first of a character begin with the bits 10.
    return !name.empty() && std::all_of(name.begin() + 1, name.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) == 0x80;
    });
}

char* put_number(char* at, float value) {
    return number_to_chars(at, at + kNumberBytes, value).ptr;
}

} // namespace

std::string spelled_name(std::string_view name, bool letters) {
    const bool symbol = name.size() == 1 && kSymbols.find(name[0]) != std::string_view::npos;
    const std::string_view word = is_sense_name(name) ? name.substr(1) : name;
    const bool letter = word.size() == 1 && is_identifier(word) && word[0] != '_';
    if (symbol || (letters ? letter : is_identifier(word))) {
        return std::string(name);
    }
    return '`' + std::string(name) + '`';
}

void append_number(float value, std::string& out) {
    std::array<char, kNumberBytes> text{};
    out.append(text.data(), put_number(text.data(), value));
}

WordPrinter::WordPrinter(const Bytecode& bytecode) {
    const bool letters = bytecode.settings.print_letters;
    const bool characters = bytecode.settings.print_characters;
    one_text_ = characters && std::all_of(bytecode.symbols.begin(), bytecode.symbols.end(),
                                          [](const BytecodeSymbol& symbol) {
                                              return symbol.parameter_count == 0 &&
                                                     is_one_character(symbol.name);
                                          });
    spellings_.resize(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        const BytecodeSymbol& symbol = bytecode.symbol(bytecode.symbol_of(code));
        Spelling& spelling = spellings_[code];
        std::string text = one_text_ ? symbol.name : spelled_name(symbol.name, letters);
        if (characters && symbol.name == "`") {
            text = one_text_ ? "``" : "````";
        }
        if (characters && !one_text_ && text.front() == '`') {
            text.insert(0, 1,
                        ' '); // separates two adjacent back quotes, which would read as one text
        }
        const bool identifier = !letters && (is_identifier(text) || is_sense_name(text));
        spelling.starts_identifier = identifier;
        spelling.ends_identifier = identifier && symbol.parameter_count == 0;
        if (code < bytecode.symbols.size()) {
            spelling.parameter_count = symbol.parameter_count;
        } else {
            const std::uint32_t first =
                bytecode.folded[code - bytecode.symbols.size()].first_constant;
            for (std::uint32_t i = 0; i < symbol.parameter_count; ++i) {
                text += i == 0 ? '(' : ',';
                append_number(bytecode.constants[first + i], text);
            }
            text += ')';
        }
        spelling.length = static_cast<std::uint32_t>(text.size());
        if (text.size() <= kShort) {
            std::copy(text.begin(), text.end(), spelling.head.begin());
        } else {
            spelling.long_text = static_cast<std::uint32_t>(long_texts_.size());
            long_texts_.push_back(std::move(text));
        }
    }
    buffer_.resize(kBufferBytes);
    if (std::all_of(spellings_.begin(), spellings_.end(), [](const Spelling& spelling) {
            return spelling.length == 1 && spelling.parameter_count == 0 &&
                   !spelling.ends_identifier;
        })) {
        for (const Spelling& spelling : spellings_) {
            letters_.push_back(spelling.head[0]);
        }
    }
}

bool WordPrinter::write_letters(std::span<const std::uint8_t> codes, const Sink& sink) {
    const char* const letters = letters_.data();
    while (!codes.empty()) {
        const std::size_t count = std::min(codes.size(), buffer_.size());
        char* const to = buffer_.data();
        for (std::size_t i = 0; i < count; ++i) {
            to[i] = letters[codes[i]];
        }
        if (!sink({to, count})) {
            return false;
        }
        codes = codes.subspan(count);
    }
    return true;
}

void WordPrinter::make_pairs() {
    const std::size_t codes = spellings_.size();
    pairs_.resize(2 * codes * codes);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        Pair& pair = pairs_[i];
        bool after_identifier = i >= codes * codes;
        std::string text;
        bool plain = true;
        for (const std::size_t code : {i / codes % codes, i % codes}) {
            const Spelling& spelling = spellings_[code];
            plain = plain && spelling.parameter_count == 0 && spelling.length <= kShort;
            text += after_identifier && spelling.starts_identifier ? " " : "";
            text.append(spelling.head.data(), plain ? spelling.length : 0);
            after_identifier = spelling.ends_identifier;
        }
        if (plain && text.size() <= pair.text.size()) {
            std::copy(text.begin(), text.end(), pair.text.begin());
            pair.length = static_cast<std::uint8_t>(text.size());
        }
    }
}

template <typename C>
bool WordPrinter::write(const C* codes,
                        std::size_t count,
                        const float* parameters,
                        const Sink& sink) {
    char* const begin = buffer_.data();
    char* const full = begin + buffer_.size() - 2 * kShort - kNumberBytes;
    char* at = begin;
    bool after_identifier = after_identifier_;
    const std::size_t size = spellings_.size();
    if (pairs_.empty() && count >= kMinPairedWord && size <= kMaxPairedCodes) {
        make_pairs();
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!pairs_.empty()) {
            while (i + 1 < count && at < full) {
                const std::size_t row = (after_identifier ? size : 0) + codes[i];
                const Pair& pair = pairs_[row * size + codes[i + 1]];
                if (pair.length == 0) {
                    break;
                }
                std::memcpy(at, pair.text.data(), kShort - 1);
                at += pair.length;
                after_identifier = spellings_[codes[i + 1]].ends_identifier;
                i += 2;
            }
            if (i == count) {
                break;
            }
        }
        if (at >= full) {
            if (!sink({begin, static_cast<std::size_t>(at - begin)})) {
                return false;
            }
            at = begin;
        }
        const Spelling& spelling = spellings_[codes[i]];
        *at = ' ';
        at += after_identifier && spelling.starts_identifier ? 1 : 0;
        after_identifier = spelling.ends_identifier;
        if (spelling.length <= kShort) {
            std::memcpy(at, spelling.head.data(), kShort);
            at += spelling.length;
        } else {
            if (!sink({begin, static_cast<std::size_t>(at - begin)}) ||
                !sink(long_texts_[spelling.long_text])) {
                return false;
            }
            at = begin;
        }
        for (std::uint32_t p = 0; p < spelling.parameter_count; ++p) {
            if (at >= full) {
                if (!sink({begin, static_cast<std::size_t>(at - begin)})) {
                    return false;
                }
                at = begin;
            }
            *at++ = p == 0 ? '(' : ',';
            at = put_number(at, *parameters++);
        }
        *at = ')';
        at += spelling.parameter_count != 0 ? 1 : 0;
    }
    after_identifier_ = after_identifier;
    return at == begin || sink({begin, static_cast<std::size_t>(at - begin)});
}

void WordPrinter::append(std::span<const Code> codes,
                         std::span<const float> parameters,
                         std::string& out) {
    static_cast<void>(
        write(codes.data(), codes.size(), parameters.data(), [&out](std::string_view text) {
            out += text;
            return true;
        }));
}

bool WordPrinter::print(const Word& word, const Sink& flush) {
    if (!one_text_ || word.module_count() == 0) {
        return print_modules(word, flush);
    }
    return flush(quote()) && print_modules(word, flush) && flush(quote());
}

bool WordPrinter::print_modules(const Word& word, const Sink& flush) {
    after_identifier_ = false;
    const float* const parameters = word.parameters().data();
    if (!letters_.empty() && word.code_width() == 1) {
        return write_letters(word.codes<std::uint8_t>(), flush);
    }
    return word.visit(
        [&](auto codes) { return write(codes.data(), codes.size(), parameters, flush); });
}

} // namespace lsys
