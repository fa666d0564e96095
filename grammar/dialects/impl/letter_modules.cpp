// SPDX-License-Identifier: MIT
#include "grammar/dialects/impl/letter_modules.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"

#include <cstdint>

namespace lsys {

namespace {

constexpr std::string_view kSymbols = "+-/\\^&|$!\"'.[]{}%";

/// One past the `)` that closes the `(` at the start of `text`; 0 if no `)` closes it.
std::size_t closed_at(std::string_view text) {
    std::uint32_t depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        depth += text[i] == '(' ? 1U : 0U;
        if (text[i] == ')' && --depth == 0) {
            return i + 1;
        }
    }
    return 0;
}

} // namespace

std::string spelled_letter(char32_t character) {
    std::string text;
    append_utf8(character, text);
    const bool letter = text.size() == 1 &&
                        ((text[0] >= 'A' && text[0] <= 'Z') || (text[0] >= 'a' && text[0] <= 'z'));
    const bool symbol = text.size() == 1 && is_one_of(text[0], kSymbols);
    return letter || symbol ? text : '`' + text + '`';
}

bool read_letter_modules(SourceSpan text,
                         const ParseContext& context,
                         const std::function<void(const LetterModule&)>& visit) {
    const std::string_view whole = context.sources.text(text);
    bool is_valid = true;
    for (std::size_t at = 0; at < whole.size();) {
        if (is_one_of(whole[at], kWhitespace)) {
            ++at;
            continue;
        }
        const CodePoint point = decode_utf8(whole.substr(at));
        const auto begin = static_cast<std::uint32_t>(text.begin + at);
        LetterModule module;
        module.character = point.value;
        module.span = {text.file, begin, begin + point.length};
        module.arguments = {text.file, module.span.end, module.span.end};
        at += point.length;
        if (!point.valid || point.value < 0x20 || point.value == 0x7F || point.value == '`') {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, module.span,
                                    point.value == '`'
                                        ? "a back quote is not the symbol of a module"
                                        : "this is not a character of a module");
            is_valid = false;
            continue;
        }
        if (at < whole.size() && whole[at] == '(') {
            const std::size_t length = closed_at(whole.substr(at));
            if (length == 0) {
                context.diagnostics.add(DiagnosticCode::ForeignSyntax,
                                        {text.file, module.span.end, module.span.end + 1},
                                        "`(` is never closed");
                return false;
            }
            module.arguments.end += static_cast<std::uint32_t>(length);
            at += length;
        }
        visit(module);
    }
    return is_valid;
}

void write_letter(const LetterModule& module,
                  const ParseContext& context,
                  Translation& translation) {
    const std::string spelled = spelled_letter(module.character);
    if (spelled.size() == 1) { // spelled as in the file
        translation.copy(module.span, context.sources);
    } else {
        translation.put(spelled, module.span);
    }
}

bool write_plain_arguments(SourceSpan arguments,
                           const ParseContext& context,
                           Translation& translation) {
    const std::string_view whole = context.sources.text(arguments);
    const std::string_view inner = whole.substr(1, whole.size() - 2);
    for (std::size_t at = 0; at <= inner.size();) {
        const std::size_t end = std::min(inner.find(',', at), inner.size());
        const std::string_view number = trimmed(inner.substr(at, end - at), kWhitespace);
        if (!is_number(number, "-")) {
            const auto begin =
                static_cast<std::uint32_t>(arguments.begin + 1 + (number.data() - inner.data()));
            const auto length = static_cast<std::uint32_t>(number.size());
            const SourceSpan place{arguments.file, begin, begin + length};
            if (report_foreign_look_alike(place, context)) {
                return false;
            }
            context.diagnostics.add(DiagnosticCode::ForeignValue, place,
                                    number.empty() ? std::string("a number is missing")
                                                   : "`" + shown(number) + "` is not a number");
            return false;
        }
        at = end + 1;
    }
    translation.copy(arguments, context.sources);
    return true;
}

} // namespace lsys
