// SPDX-License-Identifier: MIT
#include "grammar/dialects/abop/text.h"

#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kNone = std::string_view::npos;

constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kGreek{{
    {"\u03B1", "alpha"},   {"\u03B2", "beta"},  {"\u03B3", "gamma"},   {"\u03B4", "delta"},
    {"\u03B5", "epsilon"}, {"\u03B6", "zeta"},  {"\u03B7", "eta"},     {"\u03B8", "theta"},
    {"\u03B9", "iota"},    {"\u03BA", "kappa"}, {"\u03BB", "lambda"},  {"\u03BC", "mu"},
    {"\u03BD", "nu"},      {"\u03BE", "xi"},    {"\u03BF", "omicron"}, {"\u03C0", "pi"},
    {"\u03C1", "rho"},     {"\u03C3", "sigma"}, {"\u03C4", "tau"},     {"\u03C5", "upsilon"},
    {"\u03C6", "phi"},     {"\u03C7", "chi"},   {"\u03C8", "psi"},     {"\u03C9", "omega"},
}};

bool is_blank(char c) {
    return is_one_of(c, " \t\r\n");
}

/// Whether the text after a `//` reads as a comment: it has three small letters in a row.
bool is_comment_text(std::string_view text) {
    constexpr std::size_t kMaxRead = 200;
    std::size_t letters = 0;
    for (const char c : text.substr(0, kMaxRead)) {
        letters = c >= 'a' && c <= 'z' ? letters + 1 : 0;
        if (letters == 3) {
            return true;
        }
    }
    return false;
}

/// The length of the comment at the start of `rest`, the rest of a line; 0 if none begins there.
/// `is_first`: only blanks stand before `rest` in the line; `is_indented`: at least one blank
/// stands there; `has_blank`: a blank stands directly before `rest`, or `rest` begins the file.
std::size_t comment_length(std::string_view rest, bool is_first, bool is_indented, bool has_blank) {
    if (rest.starts_with("//")) {
        const bool is_spaced = rest.size() == 2 || is_blank(rest[2]);
        const bool is_comment =
            is_first ? !is_indented || is_spaced : has_blank && is_spaced && is_comment_text(rest);
        return is_comment ? rest.size() : 0;
    }
    if (rest[0] == '#' && is_first) {
        const std::string word = lowered(rest.substr(0, 9));
        const bool is_statement = word.starts_with("#define") || word.starts_with("#ignore") ||
                                  word.starts_with("#consider");
        return is_statement ? 0 : rest.size();
    }
    return rest[0] == '#' && has_blank && rest.size() > 1 && is_blank(rest[1]) ? rest.size() : 0;
}

} // namespace

std::string without_comments(FileId file, std::string_view text, const ParseContext* context) {
    std::string out(text);
    const auto blank = [&](std::size_t at, std::size_t end) {
        for (; at < end; ++at) {
            out[at] = out[at] == '\n' ? '\n' : ' ';
        }
    };
    blank(0, text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    bool is_first = true; // no character but blanks in this line so far
    bool is_indented = false;
    std::size_t end = 0; // end of the line
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        end = at < end ? end : std::min(text.find('\n', at), text.size());
        if (text.substr(at, 2) == "/*") {
            std::size_t close = text.find("*/", at + 2);
            if (close == kNone) {
                if (context != nullptr) {
                    const auto place = static_cast<std::uint32_t>(at);
                    context->diagnostics.add(DiagnosticCode::ForeignSyntax,
                                             {file, place, place + 2}, "`/*` is never closed");
                }
                close = end; // the comment ends with its line, so that the lines after it are read
            }
            const std::size_t after = close == end ? end : close + 2;
            blank(at, after);
            at = after;
            continue;
        }
        if (c == '/' || c == '#') {
            const bool has_blank = at == 0 || is_blank(out[at - 1]);
            const std::size_t length =
                comment_length(text.substr(at, end - at), is_first, is_indented, has_blank);
            blank(at, at + length);
            // Both characters of a `//` that is no comment are symbols.
            const std::size_t step = text.substr(at, 2) == "//" ? 2 : 1;
            at += std::max(length, step);
            is_first = false;
            continue;
        }
        out[at] = c == '\r' ? ' ' : c;
        is_first = c == '\n' || (is_first && is_blank(c));
        is_indented = c != '\n' && (is_indented || is_blank(c));
        ++at;
    }
    return out;
}

SourceSpan trimmed_span(std::string_view text, SourceSpan span) {
    while (span.begin < span.end && is_blank(text[span.begin])) {
        ++span.begin;
    }
    while (span.begin < span.end && is_blank(text[span.end - 1])) {
        --span.end;
    }
    return span;
}

std::size_t closing_parenthesis(std::string_view text, std::size_t at, std::size_t end) {
    std::size_t depth = 0;
    for (; at < end; ++at) {
        depth += text[at] == '(' ? 1U : 0U;
        if (text[at] == ')' && --depth == 0) {
            return at;
        }
    }
    return kNone;
}

std::string_view greek_letter(std::string_view text) {
    for (const auto& [letter, name] : kGreek) {
        if (text.starts_with(letter)) {
            return name;
        }
    }
    return {};
}

} // namespace lsys
