// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/normalizer.h"

#include "grammar/base/characters.h"
#include "grammar/base/confusables.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsys {

namespace {

/// Whether `c` is a continuation byte of UTF-8.
bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) == 0x80;
}

constexpr std::string_view kSuperscript = "superscript";
constexpr std::string_view kFraction = "fraction";
constexpr std::string_view kDegreeSign = "degree sign";

/// The decimals of a fraction character after an integer: `.3333333` for one third, with the digits
/// that binary32 keeps.
std::string_view decimals_of(std::string_view fraction) {
    return fraction == "(1/3)"   ? ".3333333"
           : fraction == "(2/3)" ? ".6666667"
           : fraction == "(1/6)" ? ".1666667"
           : fraction == "(5/6)" ? ".8333333"
           : fraction == "(1/7)" ? ".1428571"
                                 : ".1111111";
}

/// Whether the last character of `text` is a superscript.
bool ends_with_superscript(std::string_view text) {
    std::size_t at = text.size();
    while (at > 0 && is_continuation(text[at - 1])) {
        --at;
    }
    if (at == 0 || at == text.size()) {
        return false;
    }
    const std::optional<Confusable> confusable =
        find_confusable(decode_utf8(text.substr(at - 1)).value);
    return confusable && confusable->name == kSuperscript;
}

} // namespace

std::string normalized_form(char32_t point) {
    if (const std::optional<Confusable> confusable = find_confusable(point)) {
        return std::string(confusable->ascii);
    }
    return is_letter_beyond_ascii(point) ? "_" + code_point_name(point).substr(2) : " ";
}

void Normalizer::replace_all(std::span<const StrayCharacter> strays) {
    // Offsets have 32 bits, and a letter may grow to 2.5 times its bytes: from two to `_00E9`.
    const bool may_grow = text_.size() <= kMaxSourceBytes / 2;
    for (const StrayCharacter& stray : strays) {
        const CodePoint point = decode_utf8(text_.substr(stray.begin));
        const std::optional<Confusable> confusable = find_confusable(point.value);
        if (confusable && confusable->name == kSuperscript && !stray.in_value) {
            report_superscript(stray.begin, point);
            map_.replace(stray.begin, stray.begin + point.length, " ");
        } else if (confusable) {
            const bool continues = confusable->name == kSuperscript &&
                                   ends_with_superscript(text_.substr(0, stray.begin));
            const bool is_mixed = confusable->ascii.starts_with('(') && stray.begin > 0 &&
                                  is_digit(text_[stray.begin - 1]);
            replace_confusable(stray.begin, point,
                               is_mixed ? decimals_of(confusable->ascii)
                                        : confusable->ascii.substr(continues ? 1 : 0),
                               confusable->name);
        } else if (!stray.in_quotes) {
            report_unknown(stray.begin, point);
            const std::string ascii = normalized_form(point.value);
            map_.replace(stray.begin, stray.begin + point.length,
                         may_grow ? ascii : ascii.substr(0, 1));
        }
    }
    report_group();
    map_.finish();
}

void Normalizer::replace_confusable(std::uint32_t begin,
                                    const CodePoint& point,
                                    std::string_view ascii,
                                    std::string_view name) {
    map_.replace(begin, begin + point.length, ascii);
    if (diagnostics_ == nullptr) {
        return;
    }
    if (group_.count == 0 || group_.end != begin || group_.ascii.empty() != ascii.empty()) {
        report_group();
        group_ = {begin, begin, {}, {}, name, 0};
    }
    constexpr std::uint32_t kMaxNamedPoints = 4;
    constexpr std::size_t kMaxGroupLength = 64;
    if (group_.count < kMaxNamedPoints) {
        group_.code_points += (group_.count == 0 ? "" : " ") + code_point_name(point.value);
    } else if (group_.count == kMaxNamedPoints) {
        group_.code_points += " ...";
    }
    group_.ascii += ascii;
    group_.end = begin + point.length;
    group_.name = group_.name == name ? name : std::string_view{};
    ++group_.count;
    if (group_.ascii.size() >= kMaxGroupLength) {
        report_group();
    }
}

void Normalizer::report_group() {
    if (group_.count != 0 && diagnostics_->admits(DiagnosticCode::LookAlike)) {
        const bool is_blank = group_.ascii.find_first_not_of(' ') == std::string::npos;
        const std::string what =
            group_.code_points + (group_.name.empty() ? "" : " (" + std::string(group_.name) + ")");
        const SourceSpan span{file_, group_.begin, group_.end};
        const std::string message =
            group_.name == kDegreeSign    ? "angles are in degrees, without a sign; this is " + what
            : group_.name == kSuperscript ? "a power is written with `^`; this is " + what
            : group_.name == kFraction    ? "a fraction is written with digits; this is " + what
            : group_.ascii.empty() ? "an invisible character, " + what + ", has no meaning here"
            : is_blank             ? "this is not a plain blank but " + what
            : group_.ascii == ":"  ? "this is " + what + "; parts are separated by `:`"
                                   : "this looks like `" + group_.ascii + "` but is " + what;
        Diagnostic& diagnostic = diagnostics_->add(DiagnosticCode::LookAlike, span, message);
        add_fix(diagnostic,
                group_.ascii.empty() ? "remove it"
                : is_blank           ? "write a blank"
                                     : "write `" + group_.ascii + "`",
                span, group_.ascii, true);
        if (!std::exchange(explained_, true)) {
            diagnostic.notes.emplace_back(
                "text copied from a PDF or a word processor holds such characters; `lsc check "
                "--fix` replaces them all");
        }
    }
    group_ = {};
}

void Normalizer::report_superscript(std::uint32_t begin, const CodePoint& point) {
    report_group();
    if (diagnostics_ == nullptr || !diagnostics_->admits(DiagnosticCode::LookAlike)) {
        return;
    }
    Diagnostic& diagnostic = diagnostics_->add(
        DiagnosticCode::LookAlike, {file_, begin, begin + point.length},
        "a module has no power; this is " + code_point_name(point.value) + " (superscript)");
    diagnostic.help.emplace_back("repeat the module: `F F`");
}

bool Normalizer::is_word_at(std::uint32_t at) const {
    if (is_word_character(text_[at])) {
        return true;
    }
    while (at > 0 && is_continuation(text_[at])) {
        --at;
    }
    const CodePoint point = decode_utf8(text_.substr(at));
    return point.value >= 0x80 && is_letter_beyond_ascii(point.value);
}

bool Normalizer::report_greek(std::uint32_t begin, TextPart word, const CodePoint& point) {
    constexpr std::array<std::string_view, 25> kGreek{
        "alpha", "beta",   "gamma",   "delta", "epsilon", "zeta",    "eta",  "theta", "iota",
        "kappa", "lambda", "mu",      "nu",    "xi",      "omicron", "pi",   "rho",   "sigma",
        "sigma", "tau",    "upsilon", "phi",   "chi",     "psi",     "omega"};
    constexpr char32_t kFirst = 0x3B1;
    if (point.value < kFirst || point.value >= kFirst + kGreek.size() || word.begin != begin ||
        word.end != begin + point.length) {
        return false;
    }
    if (reported_greek_.find(point.value) != std::u32string::npos) {
        return true;
    }
    reported_greek_ += point.value;
    if (!diagnostics_->admits(DiagnosticCode::UnknownCharacter)) {
        return true;
    }
    const std::string_view letter = text_.substr(begin, point.length);
    const std::string name(kGreek[point.value - kFirst]);
    Diagnostic& diagnostic =
        diagnostics_->add(DiagnosticCode::UnknownCharacter, {file_, word.begin, word.end},
                          "`" + std::string(letter) + "` is not a name");
    const std::size_t before = begin == 0 ? 0 : text_.find_last_not_of(kWhitespace, begin - 1);
    const std::size_t after =
        std::min(text_.find_first_not_of(kWhitespace, word.end), text_.size());
    if (name == "epsilon" && before != std::string_view::npos && text_[before] == ':' &&
        text_.substr(after, 1) == ";") {
        diagnostic.message = "the empty word is written by writing nothing";
        add_fix(diagnostic, "remove it", diagnostic.span, "", false);
        return true;
    }
    diagnostic.help.emplace_back("names are made of the letters A to Z and a to z, digits and `_`");
    Fix fix{"write `" + name + "` at every place", {}, false};
    for (std::size_t at = begin; at != std::string_view::npos && fix.edits.size() < 32;
         at = text_.find(letter, at + letter.size())) {
        const auto place = static_cast<std::uint32_t>(at);
        fix.edits.push_back({{file_, place, place + point.length}, name});
    }
    diagnostic.fixes.push_back(std::move(fix));
    return true;
}

void Normalizer::report_unknown(std::uint32_t begin, const CodePoint& point) {
    if (diagnostics_ == nullptr) {
        return;
    }
    const bool is_letter = is_letter_beyond_ascii(point.value);
    std::uint32_t first = begin;
    std::uint32_t end = begin + point.length;
    if (is_letter) {
        constexpr std::uint32_t kMaxWordLength = 64; // limits the word that the message quotes
        while (first > 0 && begin - first < kMaxWordLength && is_word_at(first - 1)) {
            --first;
        }
        while (end < text_.size() && end - begin < kMaxWordLength && is_word_at(end)) {
            ++end;
        }
        while (is_continuation(text_[first])) { // the limit cut a character
            ++first;
        }
        while (end < text_.size() && is_continuation(text_[end])) {
            ++end;
        }
    }
    if (report_greek(begin, {first, end}, point)) {
        return;
    }
    const bool same_word = begin < word_end_;
    word_end_ = std::max(word_end_, end);
    if (!same_word && diagnostics_->admits(DiagnosticCode::UnknownCharacter)) {
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
}

} // namespace lsys
