// SPDX-License-Identifier: MIT
#include "grammar/dialects/impl/syntax_message.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/confusables.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace lsys {

namespace {

/// The line of a place, without blanks at its ends.
SourceSpan line_of(SourceSpan place, const SourceMap& sources) {
    const std::string_view text = sources.file(place.file).text();
    const std::size_t newline =
        place.begin == 0 ? std::string_view::npos : text.rfind('\n', place.begin - 1);
    const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    const std::string_view line =
        trimmed(text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin));
    const auto first = static_cast<std::uint32_t>(line.data() - text.data());
    return {place.file, first, first + static_cast<std::uint32_t>(line.size())};
}

} // namespace

bool report_foreign_look_alike(SourceSpan place, const ParseContext& context) {
    const std::string_view text = context.sources.file(place.file).text();
    if (place.begin >= text.size()) {
        return false;
    }
    const CodePoint point = decode_utf8(text.substr(place.begin));
    const std::optional<Confusable> confusable =
        point.value < 0x80 ? std::nullopt : find_confusable(point.value);
    if (!confusable) {
        return false;
    }
    const SourceSpan character{place.file, place.begin, place.begin + point.length};
    const std::string ascii(confusable->ascii);
    const std::string what =
        code_point_name(point.value) +
        (confusable->name.empty() ? "" : " (" + std::string(confusable->name) + ")");
    Diagnostic& diagnostic =
        context.diagnostics.add(DiagnosticCode::LookAlike, character,
                                ascii.empty()  ? "this is " + what + ", which has no meaning here"
                                : ascii == " " ? "this is not a plain blank but " + what
                                               : "this looks like `" + ascii + "` but is " + what);
    add_fix(diagnostic,
            ascii.empty()  ? "remove it"
            : ascii == " " ? "write a blank"
                           : "write `" + ascii + "`",
            character, ascii, true);
    return true;
}

void suggest_key(Diagnostic& diagnostic,
                 SourceSpan place,
                 std::string_view written,
                 std::span<const std::string_view> names) {
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    if (const auto nearest = nearest_name(lowered(written), candidates)) {
        add_fix(diagnostic, "did you mean `" + std::string(*nearest) + "`?", place,
                std::string(*nearest), false);
    }
}

void SyntaxMessage::add_expected(std::string_view token) {
    if (count_++ != 0) {
        expected_ += expected_.empty() ? last_ : ", " + last_;
    }
    last_ = token;
}

bool SyntaxMessage::report_look_alike() {
    return report_foreign_look_alike(place_, context_);
}

bool SyntaxMessage::report_key() {
    if (words_ == nullptr) {
        return false;
    }
    const SourceSpan line = line_of(place_, context_.sources);
    const std::string_view text = context_.sources.text(line);
    const std::string_view word = trimmed(text.substr(0, text.find(':')));
    const bool may_be_key = word.size() > 2 && std::all_of(word.begin(), word.end(), [](char c) {
                                return is_word_character(c) || c == ' ';
                            });
    const std::vector<std::string_view> keys(words_->keys.begin(), words_->keys.end());
    const auto nearest =
        may_be_key ? nearest_name(lowered(word), keys) : std::optional<std::string_view>();
    if (!nearest || *nearest == lowered(word)) {
        return false;
    }
    const SourceSpan place{line.file, line.begin,
                           line.begin + static_cast<std::uint32_t>(word.size())};
    Diagnostic& diagnostic = context_.diagnostics.add(DiagnosticCode::ForeignKey, place,
                                                      "`" + shown(word) + "` is not a word of " +
                                                          std::string(words_->name));
    suggest_key(diagnostic, place, word, words_->keys);
    return true;
}

bool SyntaxMessage::report_arrow() {
    constexpr std::array<std::string_view, 5> kArrows{"-->", "->", "=>", "==>", ":="};
    if (words_ == nullptr || words_->arrow.empty()) {
        return false;
    }
    const std::string_view text = context_.sources.file(place_.file).text();
    constexpr std::string_view kParts = "-=>:";
    std::uint32_t begin = place_.begin;
    while (begin > 0 && kParts.find(text[begin - 1]) != std::string_view::npos) {
        --begin;
    }
    std::uint32_t end = place_.begin;
    while (end < text.size() && kParts.find(text[end]) != std::string_view::npos) {
        ++end;
    }
    const std::string_view arrow = text.substr(begin, end - begin);
    if (arrow == words_->arrow ||
        std::find(kArrows.begin(), kArrows.end(), arrow) == kArrows.end()) {
        return false;
    }
    const SourceSpan place{place_.file, begin, end};
    Diagnostic& diagnostic = context_.diagnostics.add(
        DiagnosticCode::ForeignSyntax, place,
        "`" + std::string(arrow) + "` is not an arrow of " + std::string(words_->name));
    add_fix(diagnostic, std::string(words_->name) + " writes `" + std::string(words_->arrow) + "`",
            place, std::string(words_->arrow), false);
    return true;
}

void SyntaxMessage::report(std::string_view found) {
    if (report_look_alike() || report_arrow() || report_key()) {
        return;
    }
    constexpr int kMaxNamed = 5;
    const std::string_view text = context_.sources.text(place_);
    const bool is_text = place_.begin != place_.end && text.find('\n') == std::string_view::npos;
    const std::string what = is_text ? "`" + shown(text) + "`" : std::string(found);
    context_.diagnostics.add(DiagnosticCode::ForeignSyntax, place_,
                             count_ != 0 && count_ <= kMaxNamed
                                 ? "expected " + expected_ + (expected_.empty() ? "" : " or ") +
                                       last_ + ", found " + what
                                 : what + " cannot stand here");
}

} // namespace lsys
