#include "grammar/lsys/impl/plain_reader.h"

#include "grammar/lsys/impl/look_alikes.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lsys {

namespace {

bool is_word_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}

} // namespace

int PlainReader::read(std::uint32_t begin, char* buffer, int length, bool in_object) {
    const CodePoint point = decode_utf8(text_.substr(begin));
    const LookAlike* const look_alike = find_look_alike(point.value);
    std::string shown_to_scanner; // never longer than the character
    if (look_alike != nullptr) {
        replace(begin, point.length, point.value, look_alike->plain, look_alike->name);
        shown_to_scanner = look_alike->plain;
        if (in_object && look_alike->plain == "\"") {
            close_quotes(begin + point.length, buffer + point.length);
        }
    } else {
        const std::string plain = read_unknown(begin, point);
        map_.replace(begin, begin + point.length, plain);
        shown_to_scanner = plain.substr(0, 1);
    }
    const auto size = static_cast<int>(shown_to_scanner.size());
    LSYS_CHECK(size <= length && point.length == static_cast<std::uint32_t>(length), size, length);
    std::memcpy(buffer + length - size, shown_to_scanner.data(), shown_to_scanner.size());
    return length - size;
}

void PlainReader::read_quoted(std::uint32_t begin, std::uint32_t length) {
    const CodePoint point = decode_utf8(text_.substr(begin));
    if (const LookAlike* const look_alike = find_look_alike(point.value); look_alike != nullptr) {
        replace(begin, length, point.value, look_alike->plain, look_alike->name);
    }
}

void PlainReader::finish() {
    report_group();
    map_.finish();
}

void PlainReader::replace(std::uint32_t begin,
                          std::uint32_t length,
                          char32_t character,
                          std::string_view plain,
                          std::string_view name) {
    map_.replace(begin, begin + length, plain);
    if (group_.count == 0 || group_.end != begin || group_.plain.empty() != plain.empty()) {
        report_group();
        group_ = {begin, begin, {}, {}, name, 0};
    }
    constexpr std::uint32_t kMostNamed = 4;
    constexpr std::size_t kLongestGroup = 64;
    if (group_.count < kMostNamed) {
        group_.code_points += (group_.count == 0 ? "" : " ") + code_point_name(character);
    } else if (group_.count == kMostNamed) {
        group_.code_points += " ...";
    }
    group_.plain += plain;
    group_.end = begin + length;
    group_.name = group_.name == name ? name : std::string_view{};
    ++group_.count;
    if (group_.plain.size() >= kLongestGroup) {
        report_group();
    }
}

void PlainReader::report_group() {
    if (group_.count != 0 && diagnostics_ != nullptr &&
        diagnostics_->admits(DiagnosticCode::LookAlike)) {
        const bool is_blank = group_.plain.find_first_not_of(' ') == std::string::npos;
        const std::string what =
            group_.code_points + (group_.name.empty() ? "" : " (" + std::string(group_.name) + ")");
        const SourceSpan span{file_, group_.begin, group_.end};
        const std::string message =
            group_.plain.empty()  ? "an invisible character, " + what + ", has no meaning here"
            : is_blank            ? "this is no plain blank but " + what
            : group_.plain == ":" ? "this is " + what + "; parts are separated by `:`"
                                  : "this looks like `" + group_.plain + "` but is " + what;
        Diagnostic& diagnostic = diagnostics_->add(DiagnosticCode::LookAlike, span, message);
        diagnostic.fixes.push_back({group_.plain.empty() ? "remove it"
                                    : is_blank           ? "write a blank"
                                                         : "write `" + group_.plain + "`",
                                    {{span, group_.plain}},
                                    true});
        if (!std::exchange(explained_, true)) {
            diagnostic.notes.emplace_back(
                "text copied from a PDF or a word processor holds such characters; `lsc check "
                "--fix` replaces them all");
        }
    }
    group_ = {};
}

/// The quote that closes a name which began with a curly one may be curly too.
void PlainReader::close_quotes(std::uint32_t after, char* buffer) {
    for (std::uint32_t at = after;
         at < text_.size() && text_[at] != '\n' && text_[at] != '"' && text_[at] != '\0';) {
        const CodePoint point = decode_utf8(text_.substr(at));
        const LookAlike* const look_alike =
            point.value < 0x80 ? nullptr : find_look_alike(point.value);
        if (look_alike != nullptr && look_alike->plain == "\"") {
            replace(at, point.length, point.value, "\"", look_alike->name);
            buffer[at - after + point.length - 1] = '"';
            return;
        }
        at += point.length;
    }
}

bool PlainReader::is_word_at(std::uint32_t at) const {
    if (is_word_byte(text_[at])) {
        return true;
    }
    while (at > 0 && (static_cast<unsigned char>(text_[at]) & 0xC0u) == 0x80) {
        --at;
    }
    const CodePoint point = decode_utf8(text_.substr(at));
    return point.value >= 0x80 && is_foreign_letter(point.value);
}

/// Returns what the character is read as: a part of a name, or a blank.
std::string PlainReader::read_unknown(std::uint32_t begin, const CodePoint& point) {
    const bool is_letter = is_foreign_letter(point.value);
    std::uint32_t first = begin;
    std::uint32_t end = begin + point.length;
    if (is_letter) {
        constexpr std::uint32_t kLongestWord = 64; // for the message
        while (first > 0 && begin - first < kLongestWord && is_word_at(first - 1)) {
            --first;
        }
        while (end < text_.size() && end - begin < kLongestWord && is_word_at(end)) {
            ++end;
        }
    }
    const bool same_word = begin < word_end_;
    word_end_ = std::max(word_end_, end);
    if (!same_word && diagnostics_ != nullptr &&
        diagnostics_->admits(DiagnosticCode::UnknownCharacter)) {
        const std::string text(text_.substr(first, end - first));
        Diagnostic& diagnostic =
            diagnostics_->add(DiagnosticCode::UnknownCharacter, {file_, first, end},
                              is_letter ? "`" + text + "` is not a name"
                                        : "`" + text + "`, " + code_point_name(point.value) +
                                              ", has no meaning in a grammar");
        if (is_letter) {
            diagnostic.help.emplace_back(
                "names are made of the letters A to Z and a to z, digits and `_`");
        } else {
            diagnostic.help.emplace_back(
                "a symbol of another program can stand in back quotes among modules: `` `" + text +
                "` ``");
        }
    }
    if (!is_letter) {
        return " ";
    }
    return "_" + code_point_name(point.value).substr(2);
}

} // namespace lsys
