// SPDX-License-Identifier: MIT
#include "grammar/dialects/lparser/reader.h"

#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kBlanks = " \t\r";

/// Keywords of the newer format; `lsys` is empty if lsc ignores the value.
struct Keyword {
    std::string_view name;
    std::string_view lsys;
};
constexpr std::array kKeywords{
    Keyword{"recursion", "#n = "}, Keyword{"angle", "#set angle "},
    Keyword{"thickness", "width"}, Keyword{"axiom", "axiom"},
    Keyword{"rule", "rule"},       Keyword{"color", "colour"},
    Keyword{"min_thickness", ""},  Keyword{"mutation", ""},
    Keyword{"shape", ""},          Keyword{"switch_yz", ""},
    Keyword{"poly_limit", ""},     Keyword{"trace", ""},
    Keyword{"no_wait", ""},        Keyword{"trope", ""},
    Keyword{"rand", ""},
};
constexpr auto kKeywordNames = [] {
    std::array<std::string_view, kKeywords.size()> names;
    std::transform(kKeywords.begin(), kKeywords.end(), names.begin(),
                   [](const Keyword& keyword) { return keyword.name; });
    return names;
}();

const Keyword* find_keyword(std::string_view line) {
    const std::size_t end = length_up_to(line, kBlanks);
    const auto* const found =
        std::find_if(kKeywords.begin(), kKeywords.end(),
                     [&](const Keyword& keyword) { return keyword.name == line.substr(0, end); });
    return found == kKeywords.end() || end == line.size() ? nullptr : &*found;
}

/// The lines of a file up to `@`, without comments and blanks at their ends.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        line = trimmed(line.substr(0, length_up_to(line, "#")));
        at = end + 1;
        if (line == "@") {
            break;
        }
        if (!line.empty()) {
            lines.push_back(line);
        }
    }
    return lines;
}

/// Lines of a file without keywords before the axiom: depth, angle, thickness.
constexpr std::size_t kHeaderLines = 3;

class LparserReader {
public:
    LparserReader(FileId root, const ParseContext& context)
        : root_(root), context_(context), text_(context.sources.file(root).text()) {}

    LparserFile read() {
        const std::vector<std::string_view> lines = lines_of(text_);
        const bool has_keywords = !lines.empty() && find_keyword(lines.front()) != nullptr;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            has_keywords ? read_keyword(lines[i]) : read_plain(lines[i], i);
            if (!has_keywords && i < kHeaderLines && context_.diagnostics.has_errors()) {
                break; // a lost line: all lines after it have moved
            }
        }
        if (!file_.axiom && !context_.diagnostics.has_errors()) {
            context_.diagnostics.add(DiagnosticCode::ForeignSyntax, {root_, 0, 0},
                                     "the file has no axiom");
        }
        return std::move(file_);
    }

private:
    [[nodiscard]] SourceSpan span(std::string_view part) const {
        const auto begin = static_cast<std::uint32_t>(part.data() - text_.data());
        return {root_, begin, begin + static_cast<std::uint32_t>(part.size())};
    }

    void
    read_number(std::string_view value, std::string_view what, std::optional<SourceSpan>& setting) {
        const SourceSpan place = span(value);
        if (is_number(value, "-")) {
            setting = place;
        } else if (!report_foreign_look_alike(place, context_)) {
            context_.diagnostics.add(DiagnosticCode::ForeignValue, place,
                                     "`" + shown(value) + "` is not a number, the " +
                                         std::string(what));
        }
    }

    void read_plain(std::string_view line, std::size_t index) {
        switch (index) {
        case 0:
            read_number(line, "recursion depth", file_.recursion);
            break;
        case 1:
            read_number(line, "basic angle", file_.angle);
            break;
        case 2:
            read_number(line, "thickness", file_.thickness);
            break;
        case 3:
            file_.axiom = span(line);
            break;
        default:
            read_rule(line);
        }
    }

    void read_rule(std::string_view line) {
        const std::size_t equals = line.find('=', 1);
        const std::string_view left = trimmed(line.substr(0, std::min(equals, line.size())));
        if (equals == std::string_view::npos || left.size() != 1) {
            const std::string_view place = equals == std::string_view::npos ? line : left;
            if (!std::exchange(has_other_, true) &&
                !report_foreign_look_alike(span(place), context_)) {
                context_.diagnostics.add(DiagnosticCode::ForeignSyntax, span(place),
                                         "a rule is one symbol, `=` and its replacement");
            }
            return;
        }
        file_.rules.push_back({span(left), span(trimmed(line.substr(equals + 1)))});
    }

    void read_keyword(std::string_view line) {
        const Keyword* const keyword = find_keyword(line);
        const std::size_t end = length_up_to(line, kBlanks);
        const std::string_view value = trimmed(line.substr(end));
        if (keyword == nullptr) {
            const SourceSpan place = span(line.substr(0, end));
            Diagnostic& error = context_.diagnostics.add(
                DiagnosticCode::ForeignKey, place,
                "`" + shown(line.substr(0, end)) + "` is not a keyword of Lparser with a value");
            suggest_key(error, place, line.substr(0, end), kKeywordNames);
        } else if (keyword->name == "recursion") {
            read_number(value, "recursion depth", file_.recursion);
        } else if (keyword->name == "angle") {
            read_number(value, "basic angle", file_.angle);
        } else if (keyword->name == "thickness") {
            read_number(value, "thickness", file_.thickness);
        } else if (keyword->name == "axiom") {
            file_.axiom = span(value);
        } else if (keyword->name == "rule") {
            read_rule(value);
        } else if (keyword->name == "trope") {
            read_number(value, "amount of `t`", file_.trope);
        } else if (keyword->name == "color") {
            file_.colours.push_back(span(value));
        } else if (keyword->name == "mutation" || keyword->name == "min_thickness" ||
                   keyword->name == "rand") {
            context_.diagnostics.add(DiagnosticCode::ForeignIgnored, span(line.substr(0, end)),
                                     "`" + std::string(keyword->name) + "` has no effect here");
        }
    }

    FileId root_;
    const ParseContext& context_;
    std::string_view text_;
    LparserFile file_;
    bool has_other_ = false; // a line that is no rule has been reported
};

} // namespace

LparserFile read_lparser(FileId root, const ParseContext& context) {
    return LparserReader(root, context).read();
}

std::string_view recognise_lparser(std::string_view text) {
    const std::vector<std::string_view> lines = lines_of(text);
    if (lines.size() < 4) {
        return {};
    }
    const bool has_keywords = std::any_of(lines.begin(), lines.end(), [](std::string_view line) {
        return line.starts_with("recursion ") || line.starts_with("rule ");
    });
    if (find_keyword(lines.front()) != nullptr && has_keywords) {
        return "its lines `recursion` and `rule`";
    }
    const auto numbers = std::count_if(lines.begin(), lines.begin() + 3,
                                       [](std::string_view line) { return is_number(line, "-"); });
    const auto rules = std::count_if(lines.begin() + 4, lines.end(), [](std::string_view line) {
        return line.size() > 1 && trimmed(line.substr(1)).starts_with('=');
    });
    // One of the three numbers and one of the rules may have a mistake.
    const bool has_numbers = numbers >= 2;
    const bool has_rules = rules + 1 >= static_cast<std::ptrdiff_t>(lines.size()) - 4;
    return has_numbers && has_rules ? "its beginning, a line for each of three numbers,"
                                    : std::string_view();
}

} // namespace lsys
