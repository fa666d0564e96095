// SPDX-License-Identifier: MIT
#include "grammar/base/text_form.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lsys {

namespace {

struct Signature {
    std::string_view bytes; // bytes with which such files begin
    std::string_view description;
};
constexpr std::array kSignatures{
    Signature{"\x89PNG", "a PNG picture"},
    Signature{"\xFF\xD8\xFF", "a JPEG picture"},
    Signature{"GIF8", "a GIF picture"},
    Signature{"%PDF-", "a PDF document"},
    Signature{"PK\x03\x04", "a ZIP archive"},
    Signature{"\x1F\x8B", "a file packed by gzip"},
    Signature{"\x7F"
              "ELF",
              "a program"},
    Signature{"glTF", "a glTF model"},
    Signature{"BLENDER", "a file of Blender"},
    Signature{"Kaydara FBX", "an FBX model"},
};

constexpr std::size_t kSampleBytes = 4096;

bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f' && c != '\v';
}

NonText other_encoding(std::string_view form) {
    return {std::string(form) + " text", "a grammar is UTF-8 text; save the file in that encoding"};
}

/// Whether `sample` looks like UTF-16: byte `first` is NUL, and so are at least 80 % of bytes
/// `first` + 2, `first` + 4, ...; few of the other bytes are NUL.
bool has_alternate_nuls(std::string_view sample, std::size_t first) {
    if (sample.size() <= first || sample[first] != '\0') {
        return false;
    }
    std::size_t nuls = 0;
    std::size_t others = 0;
    for (std::size_t i = 0; i < sample.size(); ++i) {
        if (sample[i] == '\0') {
            ++(i % 2 == first ? nuls : others);
        }
    }
    const std::size_t places = (sample.size() + 1 - first) / 2;
    return places >= 4 && nuls * 10 >= places * 8 && others * 10 <= places;
}

} // namespace

std::optional<NonText> recognise_non_text(std::string_view bytes) {
    if (bytes.starts_with(std::string_view("\xFF\xFE\0\0", 4)) ||
        bytes.starts_with(std::string_view("\0\0\xFE\xFF", 4))) {
        return other_encoding("UTF-32");
    }
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
        return other_encoding("UTF-16");
    }
    for (const Signature& signature : kSignatures) {
        if (bytes.starts_with(signature.bytes)) {
            return NonText{std::string(signature.description), "a grammar is UTF-8 text"};
        }
    }
    const std::string_view sample = bytes.substr(0, kSampleBytes);
    if (has_alternate_nuls(sample, 1) || has_alternate_nuls(sample, 0)) {
        return other_encoding("UTF-16");
    }
    constexpr std::ptrdiff_t kFewControls = 16;
    const std::ptrdiff_t controls = std::count_if(sample.begin(), sample.end(), is_control);
    if (controls > kFewControls && controls * 20 > static_cast<std::ptrdiff_t>(sample.size())) {
        return NonText{"binary data", "a grammar is UTF-8 text"};
    }
    return std::nullopt;
}

} // namespace lsys
