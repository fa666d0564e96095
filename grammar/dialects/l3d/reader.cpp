#include "grammar/dialects/l3d/reader.h"

#include "grammar/ast/number.h"
#include "grammar/dialects/impl/line_reader.h"

#include <algorithm>
#include <string_view>

namespace lsys {

namespace {

constexpr std::size_t kNumbers = 3;

std::size_t length_up_to(std::string_view ahead, std::string_view stops) {
    return std::min(ahead.find_first_of(stops), ahead.size());
}

std::size_t word_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view(" \t\r\n\v\f#\0", 8));
}

std::size_t key_length(std::string_view ahead) {
    return ahead[0] == '@' ? 1 : length_up_to(ahead, std::string_view("=\n\0", 3));
}

std::size_t value_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view("\n\0", 2));
}

bool is_number(const LinePiece& word) {
    const bool has_sign = word.text.starts_with('-') || word.text.starts_with('+');
    const std::string_view digits = word.text.substr(has_sign ? 1 : 0);
    return !digits.empty() && literal_length(digits) == digits.size();
}

} // namespace

L3dFile read_l3d(FileId root, const ParseContext& context) {
    LineReader reader(whole_file(root, context), {" \t\r\n\v\f", '#'}, context);
    L3dFile file;
    while (file.numbers.size() < kNumbers) {
        const LinePiece word = reader.next(word_length);
        if (!is_number(word)) {
            reader.reject(word, {"a number"});
            return file;
        }
        file.numbers.push_back(word.span);
    }
    while (!reader.ahead().empty()) {
        const LinePiece key = reader.take(key_length(reader.rest()));
        if (key.text == "@") {
            file.has_mark = true;
            return file;
        }
        if (!reader.rest().starts_with('=')) {
            if (key.text.empty()) {
                reader.reject(reader.take(1), {"the end of the file", "an axiom",
                                               "the left side of a rule", "`@`"});
                return file;
            }
            file.axioms.push_back(key.span);
            continue;
        }
        static_cast<void>(reader.take(1));
        if (reader.rest().starts_with('\0')) {
            reader.reject(reader.take(1), {"the right side of a rule"});
            return file;
        }
        file.rules.push_back({key.span, reader.take(value_length(reader.rest())).span});
    }
    return file;
}

} // namespace lsys
