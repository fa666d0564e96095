// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/preprocessor.h"

#include "grammar/ast/include_chain.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

namespace {

/// Max bytes of all expanded macros. Only macros that each use another macro several times reach
/// this limit.
constexpr std::size_t kMaxExpanded = std::size_t{1} << 24;
constexpr int kMaxMacroDepth = 64;

bool is_name_start(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// The length of the name that `text` begins with.
std::size_t name_length(std::string_view text) {
    std::size_t length = 0;
    if (!text.empty() && is_name_start(text[0])) {
        while (length < text.size() && (is_name_start(text[length]) || is_digit(text[length]))) {
            ++length;
        }
    }
    return length;
}

struct Macro {
    std::string body;
    std::vector<std::string> parameters;
    bool is_function = false;
};

class Preprocessor {
public:
    Preprocessor(FileId root, const ParseContext& context, Translation& out)
        : context_(context), out_(out), chain_(context, root) {}

    void file(FileId id) {
        const std::string_view text = context_.sources.file(id).text();
        const std::size_t conditions = conditions_.size();
        std::size_t at = 0;
        while (at < text.size()) {
            std::size_t first = at;
            while (first < text.size() && is_blank(text[first])) {
                ++first;
            }
            if (first < text.size() && text[first] == '#' && is_directive(text.substr(first))) {
                at = directive(id, text, first);
            } else {
                at = line(id, text, at);
            }
        }
        while (conditions_.size() > conditions) {
            error({id, conditions_.back().begin, conditions_.back().begin + 1},
                  "this `#if` has no `#endif`");
            conditions_.pop_back();
        }
    }

private:
    struct Condition {
        bool holds = false;
        bool was_taken = false; // one of its branches has been taken
        std::uint32_t begin = 0;
    };

    void error(SourceSpan span, std::string message) {
        context_.diagnostics.add(DiagnosticCode::ForeignSyntax, span, std::move(message));
    }

    /// Whether all conditions around the current line hold.
    [[nodiscard]] bool active() const {
        return std::all_of(conditions_.begin(), conditions_.end(),
                           [](const Condition& each) { return each.holds; });
    }

    /// Whether a known directive follows the `#`. A `#` alone is a symbol of the turtle.
    static bool is_directive(std::string_view text) {
        const std::string_view rest = trimmed(text.substr(1));
        const std::string_view word = rest.substr(0, name_length(rest));
        constexpr std::string_view kWords[] = {"define", "undef",  "include", "if",
                                               "ifdef",  "ifndef", "else",    "elif",
                                               "endif",  "line",   "pragma",  "error"};
        return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
    }

    /// Length of one or two backslashes and the line end after them; 0 for other texts.
    static std::size_t splice_length(std::string_view text) {
        std::size_t length = std::min(text.find_first_not_of('\\'), text.size());
        if (length == 0 || length > 2) {
            return 0;
        }
        length += text.substr(length).starts_with("\r\n") ? 1U : 0U;
        return text.substr(length).starts_with("\n") ? length + 1 : 0;
    }

    /// Reads a directive with its continued lines; returns where the next line begins.
    std::size_t directive(FileId id, std::string_view text, std::size_t first) {
        std::string line;
        std::size_t at = first;
        while (at < text.size() && text[at] != '\n') {
            if (const std::size_t splice = splice_length(text.substr(at)); splice != 0) {
                at += splice;
                line += ' ';
            } else if (text.substr(at, 2) == "/*") {
                at = comment_end(id, text, at);
                line += ' ';
            } else if (text.substr(at, 2) == "//") {
                at = line_end(text, at);
            } else {
                const std::size_t length = std::max<std::size_t>(string_length(text, at), 1);
                line += text.substr(at, length);
                at += length;
            }
        }
        at += at < text.size() ? 1U : 0U;
        const SourceSpan span{
            id, static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(std::min(text.find_first_of("\r\n", first), text.size()))};
        std::string_view rest = trimmed(std::string_view(line).substr(1));
        const std::string_view word = rest.substr(0, name_length(rest));
        rest = trimmed(rest.substr(word.size()));
        execute(word, rest, span);
        return at;
    }

    void execute(std::string_view word, std::string_view rest, SourceSpan span) {
        const std::string name(rest.substr(0, name_length(rest)));
        if (word == "ifdef" || word == "ifndef") {
            const bool known = macros_.count(name) != 0;
            open(known == (word == "ifdef"), span);
        } else if (word == "if") {
            open(holds(rest), span);
        } else if (word == "else" || word == "elif" || word == "endif") {
            if (conditions_.empty()) {
                error(span, "`#" + std::string(word) + "` without its `#if`");
            } else if (word == "endif") {
                conditions_.pop_back();
            } else {
                Condition& condition = conditions_.back();
                condition.holds = !condition.was_taken && (word == "else" || holds(rest));
                condition.was_taken = condition.was_taken || condition.holds;
            }
        } else if (!active()) {
            return;
        } else if (word == "define") {
            define(name, rest, span);
        } else if (word == "undef") {
            macros_.erase(name);
        } else if (word == "include") {
            include(rest, span);
        }
    }

    void open(bool holds, SourceSpan span) { conditions_.push_back({holds, holds, span.begin}); }

    /// Returns true when `#if text` holds: a number that is not 0, `defined(NAME)`, or a name whose
    /// value is such a number; `!` negates.
    [[nodiscard]] bool holds(std::string_view text) const {
        text = trimmed(text);
        if (text.starts_with("!")) {
            return !holds(text.substr(1));
        }
        if (text.starts_with("defined")) {
            text = trimmed(text.substr(7));
            text = text.starts_with("(") ? trimmed(text.substr(1)) : text;
            return macros_.count(std::string(text.substr(0, name_length(text)))) != 0;
        }
        const auto macro = macros_.find(std::string(text.substr(0, name_length(text))));
        if (macro != macros_.end() && macro->second.body != text) {
            return holds(macro->second.body);
        }
        return !text.empty() && is_digit(text[0]) && text.find_first_not_of("0 \t\r") != text.npos;
    }

    void define(const std::string& name, std::string_view rest, SourceSpan span) {
        if (name.empty()) {
            error(span, "`#define` names no macro");
            return;
        }
        rest.remove_prefix(name.size());
        Macro macro;
        if (rest.starts_with("(")) {
            macro.is_function = true;
            const std::size_t close = rest.find(')');
            if (close == rest.npos) {
                error(span, "the parameters of this macro have no `)`");
                return;
            }
            std::string_view list = rest.substr(1, close - 1);
            while (!trimmed(list).empty()) {
                const std::size_t comma = std::min(list.find(','), list.size());
                macro.parameters.emplace_back(trimmed(list.substr(0, comma)));
                list.remove_prefix(std::min(comma + 1, list.size()));
            }
            rest.remove_prefix(close + 1);
        }
        macro.body = std::string(trimmed(rest));
        macros_[name] = std::move(macro);
    }

    void include(std::string_view rest, SourceSpan span) {
        const char close = rest.starts_with("<") ? '>' : '"';
        const std::size_t end = rest.size() < 2 ? rest.npos : rest.find(close, 1);
        if (rest.empty() || (rest[0] != '"' && rest[0] != '<') || end == rest.npos) {
            error(span, "`#include` names a file in quotes");
            return;
        }
        const FileId id = chain_.enter(rest.substr(1, end - 1), span);
        if (id != kNoFile) {
            file(id);
            chain_.leave();
        }
    }

    std::size_t comment_end(FileId id, std::string_view text, std::size_t at) {
        const std::size_t end = text.find("*/", at + 2);
        if (end == text.npos) {
            error({id, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + 2)},
                  "this comment has no `*/`");
            return text.size();
        }
        return end + 2;
    }

    static std::size_t line_end(std::string_view text, std::size_t at) {
        return std::min(text.find('\n', at), text.size());
    }

    /// Length of the string in quotes that begins at `at` and ends in the same line; else 0.
    static std::size_t string_length(std::string_view text, std::size_t at) {
        if (text[at] != '"') {
            return 0;
        }
        const std::size_t close = text.find_first_of("\"\n", at + 1);
        return close == text.npos || text[close] == '\n' ? 0 : close + 1 - at;
    }

    /// Warns of a `//` between symbols: its author may mean two rolls, but for cpfg, too, the rest
    /// of the line is a comment.
    void warn_rolls(FileId id, std::string_view text, std::size_t at) {
        const auto is_space = [&](std::size_t place) {
            return place >= text.size() || is_blank(text[place]) || text[place] == '\n';
        };
        const bool is_between = at != 0 && !is_space(at - 1) && !is_space(at + 2);
        constexpr std::string_view kEnds = ";*/"; // characters that end a statement or a comment
        if (!is_between || kEnds.find(text[at - 1]) != kEnds.npos || text[at + 2] == '/') {
            return;
        }
        const auto begin = static_cast<std::uint32_t>(at);
        Diagnostic& warning =
            context_.diagnostics.add(DiagnosticCode::ForeignIgnored,
                                     {id, begin, static_cast<std::uint32_t>(line_end(text, at))},
                                     "`//` begins a comment, here as in cpfg");
        warning.help.emplace_back("for two rolls write `/ /`");
    }

    /// Copies a line, without comments and with its macros replaced; returns where the next begins.
    std::size_t line(FileId id, std::string_view text, std::size_t at) {
        const bool keeps = active();
        while (at < text.size()) {
            const auto begin = static_cast<std::uint32_t>(at);
            if (text.substr(at, 2) == "/*") {
                at = comment_end(id, text, at);
                if (keeps) {
                    out_.put(" ", {id, begin, static_cast<std::uint32_t>(at)});
                }
                continue;
            }
            if (text.substr(at, 2) == "//") {
                if (keeps) {
                    warn_rolls(id, text, at);
                }
                at = line_end(text, at);
                continue;
            }
            std::size_t length = std::max(string_length(text, at), name_length(text.substr(at)));
            if (length == 0 && is_digit(text[at])) {
                while (at + length < text.size() &&
                       (is_name_start(text[at + length]) || is_digit(text[at + length]) ||
                        text[at + length] == '.')) {
                    ++length;
                }
            } else if (length != 0 && text[at] != '"') {
                length = name(id, text, at, length, keeps);
                at += length;
                continue;
            }
            length = std::max<std::size_t>(length, 1);
            const bool ends = text[at] == '\n';
            if (keeps && text[at] != '\r') {
                out_.copy({id, begin, static_cast<std::uint32_t>(at + length)}, context_.sources);
            }
            at += length;
            if (ends) {
                break;
            }
        }
        return at;
    }

    /// Copies a name of the text, or writes the expansion of the macro of that name. Returns the
    /// number of bytes read, with the arguments.
    std::size_t
    name(FileId id, std::string_view text, std::size_t at, std::size_t length, bool keeps) {
        const auto macro = macros_.find(std::string(text.substr(at, length)));
        const auto begin = static_cast<std::uint32_t>(at);
        std::vector<std::string> arguments;
        std::size_t used = length;
        const bool replaced = keeps && macro != macros_.end() &&
                              (!macro->second.is_function ||
                               read_arguments(text.substr(at + length), arguments, used));
        if (replaced) {
            std::string expanded;
            expand(macro->first, macro->second, arguments, 0, expanded);
            const SourceSpan span{id, begin, static_cast<std::uint32_t>(at + used)};
            expanded_ += expanded.size();
            if (expanded_ > kMaxExpanded) {
                if (!reported_) {
                    error(span, "the macros of this file write more than 16 million characters");
                }
                reported_ = true;
            } else {
                out_.put(expanded, span);
            }
        } else if (keeps) {
            out_.copy({id, begin, static_cast<std::uint32_t>(at + length)}, context_.sources);
        }
        return replaced ? used : length;
    }

    /// Reads `(a, b)` after the name of a macro; adds its length to `used`.
    static bool
    read_arguments(std::string_view text, std::vector<std::string>& arguments, std::size_t& used) {
        if (!text.starts_with("(")) {
            return false;
        }
        int depth = 0;
        std::string argument;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            depth += c == '(' ? 1 : 0;
            depth -= c == ')' ? 1 : 0;
            if (depth == 0 || (depth == 1 && c == ',')) {
                arguments.emplace_back(trimmed(argument));
                argument.clear();
                if (depth == 0) {
                    used += i + 1;
                    return true;
                }
            } else if (i > 0) {
                argument += c;
            }
        }
        return false;
    }

    /// Appends the expansion of a macro to `out`. `macro_name`: empty for an argument. `depth`:
    /// number of enclosing expansions.
    void expand(const std::string& macro_name,
                const Macro& macro,
                const std::vector<std::string>& arguments,
                int depth,
                std::string& out) {
        active_.push_back(macro_name);
        const std::string_view body = macro.body;
        for (std::size_t at = 0; at < body.size() && out.size() <= kMaxExpanded;) {
            std::size_t length = name_length(body.substr(at));
            if (length == 0) {
                do {
                    out += body[at];
                    ++at;
                } while (at < body.size() && is_digit(body[at - 1]) &&
                         (is_name_start(body[at]) || is_digit(body[at]) || body[at] == '.'));
                continue;
            }
            const std::string word(body.substr(at, length));
            const auto parameter =
                std::find(macro.parameters.begin(), macro.parameters.end(), word);
            const auto inner = macros_.find(word);
            std::vector<std::string> inner_arguments;
            std::size_t used = length;
            if (parameter != macro.parameters.end()) {
                const auto index = static_cast<std::size_t>(parameter - macro.parameters.begin());
                Macro argument_macro;
                argument_macro.body = index < arguments.size() ? arguments[index] : std::string();
                if (depth < kMaxMacroDepth) {
                    expand({}, argument_macro, {}, depth + 1, out);
                }
            } else if (inner != macros_.end() && depth < kMaxMacroDepth &&
                       std::find(active_.begin(), active_.end(), word) == active_.end() &&
                       (!inner->second.is_function ||
                        read_arguments(body.substr(at + length), inner_arguments, used))) {
                expand(word, inner->second, inner_arguments, depth + 1, out);
            } else {
                out += word;
                used = length;
            }
            at += used;
        }
        active_.pop_back();
    }

    const ParseContext& context_;
    Translation& out_;
    IncludeChain chain_;
    std::map<std::string, Macro> macros_;
    std::vector<Condition> conditions_; // one per #if without #endif yet, the innermost last
    std::vector<std::string> active_;   // macros that are being replaced
    std::size_t expanded_ = 0;          // bytes written by macros so far
    bool reported_ = false;             // the error about kMaxExpanded has been reported
};

} // namespace

Translation preprocess_cpfg(FileId root, const ParseContext& context) {
    Translation text(root);
    Preprocessor(root, context, text).file(root);
    return text;
}

} // namespace lsys
