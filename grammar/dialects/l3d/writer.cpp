// SPDX-License-Identifier: MIT
#include "grammar/dialects/l3d/writer.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/impl/text.h"
#include "grammar/dialects/l3d/reader.h"
#include "grammar/dialects/repeated_messages.h"

#include <algorithm>
#include <string>

namespace lsys {

namespace {

/// Commands whose parameter is an angle or a percentage with a default in the header.
constexpr std::string_view kWithHeaderDefault = "+-&^\\/<>";
/// Other commands with a parameter.
constexpr std::string_view kWithoutDefault = "FfGg=%*";

bool is_blank(char c) {
    return is_one_of(c, kL3dBlanks);
}

/// Whether `text` is a number, perhaps with a sign and with blanks around it.
bool is_parameter(std::string_view text) {
    return is_number(trimmed(text, kL3dBlanks), "+-");
}

/// Whether the number at the start of `text` is 1.
bool is_one(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t+");
    if (first == std::string_view::npos) {
        return false;
    }
    text.remove_prefix(first);
    const std::size_t length = literal_length(text);
    return length != 0 && read_literal(text.substr(0, length)).value == 1.0F;
}

} // namespace

void L3dWriter::warn(std::uint32_t begin, std::uint32_t end, const std::string& message) {
    if (!is_quiet_) {
        context_.diagnostics.add(DiagnosticCode::ForeignQuirk, {file_, begin, end}, message);
    }
}

/// Reports a parameter that reaches to the end of its text, which may be a mistake there.
void L3dWriter::warn_unclosed(std::uint32_t at) {
    if (!is_quiet_) {
        has_warned_digit_ = true; // no warning for the digits of this parameter
        mark_lost_statement(context_.diagnostics.add(DiagnosticCode::ForeignQuirk,
                                                     {file_, at, at + 1},
                                                     "this parameter has no `)` in its text"));
    }
}

SourceSpan L3dWriter::line(SourceSpan text) {
    file_ = text.file;
    const std::string_view whole = context_.sources.text(text);
    if (whole.ends_with('\r') && !context_.bug_compatible) {
        --text.end;
    }
    const std::size_t hash = whole.find('#');
    if (context_.bug_compatible || hash == std::string_view::npos) {
        return text;
    }
    const auto begin = static_cast<std::uint32_t>(text.begin + hash);
    warn(begin, text.end, "L3D reads this as commands; here it is a comment");
    const std::size_t end = whole.substr(0, hash).find_last_not_of(kL3dBlanks) + 1;
    return {text.file, text.begin, static_cast<std::uint32_t>(text.begin + end)};
}

SourceSpan L3dWriter::key(SourceSpan text) {
    file_ = text.file;
    const std::string_view whole = context_.sources.text(text);
    const std::size_t end = whole.find_last_not_of(kL3dBlanks) + 1;
    if (context_.bug_compatible || end == whole.size()) {
        return text;
    }
    const auto last = static_cast<std::uint32_t>(text.begin + end);
    warn(last, text.end,
         "L3D counts the blanks before `=` as part of the left side; lsc ignores them");
    return {text.file, text.begin, last};
}

void L3dWriter::write_key(SourceSpan text) {
    file_ = text.file;
    source_ = context_.sources.file(text.file).text();
    translation_.put("`", text);
    put_characters(text.begin, text.end);
    translation_.put("`", text);
}

std::uint32_t L3dWriter::put_character(std::uint32_t at, std::uint32_t end) {
    const char c = source_[at];
    const CodePoint point = decode_utf8(source_.substr(at, end - at));
    const SourceSpan span{file_, at, at + point.length};
    if (is_blank(c)) {
        translation_.put(" ", span);
    } else if (!point.valid || point.value < 0x20 || point.value == 0x7F) {
        if (context_.diagnostics.admits(DiagnosticCode::ForeignSyntax)) {
            context_.diagnostics.add(DiagnosticCode::ForeignSyntax, span,
                                     "this is not a character of a text");
        }
    } else {
        translation_.copy(span, context_.sources);
        translation_.put(c == '`' ? "`" : "", span);
    }
    return span.end;
}

void L3dWriter::put_characters(std::uint32_t at, std::uint32_t end) {
    while (at < end) {
        at = put_character(at, end);
    }
}

void L3dWriter::check_parameter(char command, Parameter parameter) {
    const std::string_view inner =
        source_.substr(parameter.open + 1, parameter.end - parameter.open - 2);
    if (!is_one_of(command, kWithHeaderDefault) && !is_one_of(command, kWithoutDefault)) {
        return;
    }
    if (!is_parameter(inner)) {
        warn(parameter.open + 1, parameter.end - 1,
             "only the number at the start of `" + shown(inner) + "` is read");
    } else if (is_one_of(command, kWithHeaderDefault) && is_one(inner) &&
               !context_.bug_compatible) {
        warn(parameter.open, parameter.end,
             "L3D treats a parameter of 1 as missing and uses the angle of the header; lsc uses 1");
    }
}

void L3dWriter::check_command(char command, std::uint32_t at) {
    if (is_quiet_) {
        return;
    }
    if (command == '|' && !has_warned_half_turn_ && !context_.bug_compatible) {
        has_warned_half_turn_ = true;
        warn(at, at + 1, "L3D turns by pi degrees (3.14) here; lsc turns by 180 degrees");
    } else if (command >= '0' && command <= '9' && !has_warned_digit_) {
        has_warned_digit_ = true;
        warn(at, at + 1, "L3D has no counts: a digit outside of parentheses does nothing");
    }
}

void L3dWriter::write(SourceSpan text) {
    file_ = text.file;
    source_ = context_.sources.file(text.file).text();
    const std::string_view whole = source_.substr(0, text.end);
    translation_.put("`", text);
    char command = '\0';   // the previous character; NUL at the start and after a parameter
    std::size_t close = 0; // the next `)`, or the end
    const auto next_close = [&](std::size_t from) {
        if (close < from) {
            close = std::min(whole.find(')', from), whole.size());
        }
        return close;
    };
    for (std::uint32_t at = text.begin; at < text.end;) {
        const char c = source_[at];
        const bool has_parameter =
            is_one_of(command, kWithHeaderDefault) || is_one_of(command, kWithoutDefault);
        if (is_blank(c) && has_parameter && !context_.bug_compatible) {
            const std::size_t open =
                std::min(whole.find_first_not_of(" \t\r\v\f", at), whole.size());
            const std::size_t end =
                open < whole.size() && whole[open] == '(' ? next_close(open) : whole.size();
            if (end < whole.size() && is_parameter(whole.substr(open + 1, end - open - 1))) {
                warn(at, static_cast<std::uint32_t>(open),
                     "in L3D a blank separates the command from its parameter; in lsc the "
                     "parameter belongs to the command");
                at = static_cast<std::uint32_t>(open);
                continue;
            }
        }
        if (c == '(' && command != '\0') {
            const bool is_closed = next_close(at) < whole.size();
            const auto end = static_cast<std::uint32_t>(is_closed ? close + 1 : text.end);
            if (is_closed) {
                check_parameter(command, {at, end});
            } else {
                warn_unclosed(at);
            }
            put_characters(at, end);
            at = end;
            command = '\0';
            continue;
        }
        check_command(c, at);
        at = put_character(at, text.end);
        command = c;
    }
    translation_.put("`", text);
}

} // namespace lsys
