// SPDX-License-Identifier: MIT
#include "grammar/dialects/l3d/reader.h"

#include "grammar/dialects/impl/line_reader.h"
#include "grammar/dialects/impl/text.h"

#include <string_view>

namespace lsys {

namespace {

constexpr std::size_t kHeaderNumbers = 3;
constexpr std::string_view kLineEnds("\n\0", 2);

std::size_t word_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view(" \t\r\n\v\f#\0", 8));
}

std::size_t key_length(std::string_view ahead) {
    return ahead[0] == '@' ? 1 : length_up_to(ahead, std::string_view("=\n\0", 3));
}

} // namespace

L3dFile read_l3d(FileId root, const ParseContext& context) {
    LineReader reader(whole_file(root, context), {kL3dBlanks, '#'}, context);
    L3dFile file;
    while (file.numbers.size() < kHeaderNumbers) {
        const LinePiece word = reader.next(word_length);
        if (!reader.expect(is_number(word.text, "+-"), word, {"a number"})) {
            return file;
        }
        file.numbers.push_back(word.span);
    }
    while (!reader.ahead().empty()) {
        const LinePiece key = reader.take(key_length(reader.rest()));
        if (key.text == "@") {
            file.has_end_mark = true;
            return file;
        }
        if (!reader.rest().starts_with('=')) {
            const bool is_axiom = !key.text.empty();
            if (!reader.expect(
                    is_axiom, is_axiom ? key : reader.take(1),
                    {"the end of the file", "an axiom", "the left side of a rule", "`@`"})) {
                return file;
            }
            file.axioms.push_back(key.span);
            continue;
        }
        static_cast<void>(reader.take(1));
        const bool is_nul = reader.rest().starts_with('\0');
        const LinePiece value = reader.take(is_nul ? 1 : length_up_to(reader.rest(), kLineEnds));
        if (!reader.expect(!is_nul, value, {"the right side of a rule"})) {
            return file;
        }
        file.rules.push_back({key.span, value.span});
    }
    return file;
}

} // namespace lsys
