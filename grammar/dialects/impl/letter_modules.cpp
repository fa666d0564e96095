#include "grammar/dialects/impl/letter_modules.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/utf8.h"

#include <cstdint>

namespace lsys {

namespace {

constexpr std::string_view kSymbols = "+-/\\^&|$!\"'.[]{}%";

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// One past the `)` that closes the `(` at the start of `text`; 0: none does.
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
    const bool symbol = text.size() == 1 && kSymbols.find(text[0]) != std::string_view::npos;
    return letter || symbol ? text : '`' + text + '`';
}

bool read_letter_modules(SourceSpan text,
                         const ParseContext& context,
                         const std::function<void(const LetterModule&)>& visit) {
    const std::string_view whole = context.sources.text(text);
    bool fine = true;
    for (std::size_t at = 0; at < whole.size();) {
        if (is_blank(whole[at])) {
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
                                    point.value == '`' ? "a back quote is no symbol of a module"
                                                       : "this is no character of a module");
            fine = false;
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
    return fine;
}

void write_letter(const LetterModule& module,
                  const ParseContext& context,
                  Translation& translation) {
    const std::string spelled = spelled_letter(module.character);
    if (spelled.size() == 1) { // as it stands in the file
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
        std::size_t first = at;
        std::size_t last = end;
        while (first < last && is_blank(inner[first])) {
            ++first;
        }
        while (last > first && is_blank(inner[last - 1])) {
            --last;
        }
        std::string_view number = inner.substr(first, last - first);
        number.remove_prefix(!number.empty() && number[0] == '-' ? 1 : 0);
        if (number.empty() || literal_length(number) != number.size()) {
            const auto begin = static_cast<std::uint32_t>(arguments.begin + 1 + first);
            const auto length = static_cast<std::uint32_t>(last - first);
            context.diagnostics.add(
                DiagnosticCode::ForeignSyntax, {arguments.file, begin, begin + length},
                length == 0 ? std::string("a number is missing")
                            : "`" + shown(inner.substr(first, last - first)) + "` is no number");
            return false;
        }
        at = end + 1;
    }
    translation.copy(arguments, context.sources);
    return true;
}

} // namespace lsys
