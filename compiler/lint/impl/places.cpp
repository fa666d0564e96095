// SPDX-License-Identifier: MIT
#include "compiler/lint/impl/places.h"

#include "compiler/program/module_text.h"

namespace lsys {

namespace {

/// The places of the arguments in the parentheses whose `(` is at offset `open`.
std::vector<SourceSpan> read_call(std::string_view text, FileId file, std::size_t open) {
    std::vector<SourceSpan> arguments;
    std::uint32_t depth = 0;
    std::size_t first = open + 1;
    const auto close_argument = [&](std::size_t end) {
        std::size_t begin = skip_blanks(text, first);
        while (end > begin && (text[end - 1] == ' ' || text[end - 1] == '\t' ||
                               text[end - 1] == '\n' || text[end - 1] == '\r')) {
            --end;
        }
        if (begin < end) {
            arguments.push_back(
                {file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
        }
        first = end + 1;
    };
    for (std::size_t at = open; at < text.size();) {
        const std::size_t next = skip_blanks(text, at);
        if (next != at) {
            at = next;
            continue;
        }
        const char c = text[at];
        if (c == '(' || c == '{') {
            ++depth;
        } else if (c == ')' || c == '}') {
            if (--depth == 0) {
                close_argument(at);
                return arguments;
            }
        } else if (c == ',' && depth == 1) {
            close_argument(at);
            first = at + 1;
        } else if (c == ';') {
            break;
        }
        ++at;
    }
    return arguments;
}

} // namespace

SourceSpan module_span(const CheckInput& input, const ProgramWord& word, std::size_t index) {
    SourceSpan span = module_name_span(input, word, index);
    const Symbol& symbol = input.program.symbol(input.program.modules[index].symbol);
    if (symbol.parameter_count != 0) {
        span.end = static_cast<std::uint32_t>(
            end_of_arguments(input.sources.file(word.file).text(), span.end));
    }
    return span;
}

std::vector<SourceSpan>
argument_spans(const CheckInput& input, const ProgramWord& word, std::size_t index) {
    const std::string_view text = input.sources.file(word.file).text();
    const std::size_t open = skip_blanks(text, module_name_span(input, word, index).end);
    if (open >= text.size() || text[open] != '(') {
        return {};
    }
    return read_call(text, word.file, open);
}

SourceSpan item_span(const Production& production, const ProgramPatternItem& item) {
    return {production.predecessor.span.file, item.begin, item.end};
}

bool is_meant_as_probability(const CheckInput& input, const Production& production) {
    if (production.condition == kNoValue || production.stochastic) {
        return false;
    }
    const std::string_view text = input.sources.text(production.condition_span);
    return text.size() >= 2 && text.find_first_not_of("0123456789.") == std::string_view::npos &&
           (text.starts_with("0.") || text.starts_with('.')) &&
           text.find_first_of("123456789") != std::string_view::npos;
}

std::string zero_arguments(std::uint32_t count) {
    std::string text = "(0";
    for (std::uint32_t i = 1; i < count; ++i) {
        text += ", 0";
    }
    return text + ')';
}

} // namespace lsys
