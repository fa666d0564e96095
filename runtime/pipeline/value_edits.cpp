// SPDX-License-Identifier: MIT
#include "runtime/pipeline/value_edits.h"

#include "grammar/ast/ast.h"
#include "grammar/dialects/dialect.h"
#include "runtime/pipeline/setting_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kSpaces = " \t";

/// Replaces the bytes [begin, end) of the file by a text.
struct TextEdit {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::string text;
};

/// The line end to insert at `offset`, "\r\n" or "\n": the next line end of the text, or the first
/// one if none follows. "\n" for a text of one line.
std::string_view line_end_at(std::string_view text, std::size_t offset) {
    std::size_t newline = text.find('\n', offset);
    if (newline == std::string_view::npos) {
        newline = text.find('\n');
    }
    return newline != std::string_view::npos && newline > 0 && text[newline - 1] == '\r' ? "\r\n"
                                                                                         : "\n";
}

/// Whether the rest of a line after a statement is blank or comments that end on the same line.
bool is_blank_or_comment(std::string_view rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kSpaces), rest.size()));
    if (rest.empty() || rest.starts_with("//")) {
        return true;
    }
    const std::size_t end = rest.find("*/", 2);
    return rest.starts_with("/*") && end != std::string_view::npos &&
           is_blank_or_comment(rest.substr(end + 2));
}

/// Collects and applies the edits of one grammar.
class ValueWriter {
public:
    ValueWriter(const std::string& path, const std::string& bytes, const FileLoader& load)
        : path_(path), bytes_(bytes), root_(sources_.add(path, bytes)),
          ast_(parse_lsys(root_, {sources_, names_, diagnostics_, load})),
          text_(sources_.file(root_).text()) {}

    Result<std::string> write(const StatementValues& values) {
        if (diagnostics_.has_errors()) {
            return Error{fmt::format("`{}` has errors", path_)};
        }
        if (values.generations) {
            write_generations(*values.generations);
        }
        for (const Definition& definition : values.definitions) {
            write_definition(definition);
        }
        for (const SettingText& setting : values.settings) {
            write_setting(setting);
        }
        if (error_) {
            return *error_;
        }
        return result();
    }

private:
    void fail(std::string message) {
        if (!error_) {
            error_ = Error{std::move(message)};
        }
    }

    void replace(SourceSpan span, const std::string& what, std::string text) {
        if (span.file != root_) {
            fail(fmt::format("`{}` stands in the included file `{}`; change it there", what,
                             sources_.file(span.file).path()));
        } else if (sources_.text(span) != text) {
            edits_.push_back({span.begin, span.end, std::move(text)});
        }
    }

    void write_generations(std::uint32_t generations) {
        if (ast_.generations.empty()) {
            add_first(fmt::format("#n = {};", generations));
            return;
        }
        replace(ast_.expression(ast_.generations.front().value).span(), "#n",
                fmt::format("{}", generations));
    }

    void write_definition(const Definition& definition) {
        const std::string text = fmt::format("{}", definition.value);
        for (const Statement& statement : ast_.statements) {
            if (statement.kind == StatementKind::Define) {
                const DefineNode& node = ast_.defines[statement.index];
                if (names_.text(node.name) == definition.name) {
                    replace(ast_.expression(node.value).span(), "#define " + definition.name, text);
                    return;
                }
            } else if (statement.kind == StatementKind::Param) {
                const ParamNode& node = ast_.params[statement.index];
                if (names_.text(node.name) == definition.name) {
                    replace(ast_.expression(node.value).span(), "#param " + definition.name, text);
                    return;
                }
            }
        }
        fail(fmt::format("`{}` has no #define or #param `{}`", path_, definition.name));
    }

    void write_setting(const SettingText& setting) {
        const std::set<std::string, std::less<>> used = words_of(setting);
        const Statement* set_statement = nullptr;
        for (const Statement& statement : ast_.statements) {
            if (statement.kind == StatementKind::Set) {
                const SetNode& node = ast_.sets[statement.index];
                const bool is_in_scope = setting.key != "names" || node.key_span.file == root_;
                if (names_.text(node.key) == setting.key && is_in_scope) {
                    set_statement = &statement;
                }
            } else if (set_statement != nullptr && defines_one_of(statement, used)) {
                fail(
                    fmt::format("`#set {}` uses a constant that is defined after it", setting.key));
            }
        }
        if (set_statement == nullptr) {
            add_line(fmt::format("#set {} {};", setting.key, setting.values), used);
            return;
        }
        const SetNode& node = ast_.sets[set_statement->index];
        if (node.values.count == 0) {
            fail(fmt::format("`#set {}` has no value", setting.key));
            return;
        }
        const SourceSpan first = ast_.set_values[node.values.first].span;
        const SourceSpan last = ast_.set_values[node.values.first + node.values.count - 1].span;
        replace(join(first, last), "#set " + setting.key, setting.values);
    }

    /// The identifiers in the values of a setting, which include the constants that it uses.
    [[nodiscard]] static std::set<std::string, std::less<>> words_of(const SettingText& setting) {
        SourceMap sources;
        Names names;
        Diagnostics diagnostics;
        std::set<std::string, std::less<>> words;
        const std::optional<Ast> ast =
            parse_settings(std::span(&setting, 1), sources, names, diagnostics);
        for (const SetValue& value : ast->set_values) {
            if (value.is_word) {
                words.emplace(names.text(value.word));
            }
        }
        for (const Expression& expression : ast->expressions) {
            if (expression.kind == ExpressionKind::Name) {
                words.emplace(names.text(expression.name));
            }
        }
        return words;
    }

    [[nodiscard]] bool defines_one_of(const Statement& statement,
                                      const std::set<std::string, std::less<>>& words) const {
        return (statement.kind == StatementKind::Define &&
                words.contains(names_.text(ast_.defines[statement.index].name))) ||
               (statement.kind == StatementKind::Param &&
                words.contains(names_.text(ast_.params[statement.index].name)));
    }

    /// Adds a line after the last `#set` and after the definitions of `words`, which the line uses.
    void add_line(const std::string& line, const std::set<std::string, std::less<>>& words) {
        const Statement* before = nullptr;
        for (const Statement& statement : ast_.statements) {
            if (statement.span.file != root_) {
                before = defines_one_of(statement, words) ? include_of(statement) : before;
                continue;
            }
            if (statement.kind == StatementKind::Set || defines_one_of(statement, words)) {
                before = &statement;
            }
        }
        if (before == nullptr) {
            add_first(line);
        } else {
            add_after(before->span.end, line);
        }
    }

    /// Adds a line before the first statement of the root file.
    void add_first(const std::string& line) {
        for (const Statement& statement : ast_.statements) {
            if (statement.span.file == root_) {
                add_before(statement.span.begin, line);
                return;
            }
        }
        add_before(text_.size(), line);
    }

    /// The `#include` of the root file through which `statement`, in an included file, was read.
    [[nodiscard]] const Statement* include_of(const Statement& statement) const {
        const Statement* include = nullptr;
        for (const Statement& each : ast_.statements) {
            if (&each == &statement) {
                break;
            }
            if (each.kind == StatementKind::Include && each.span.file == root_) {
                include = &each;
            }
        }
        return include;
    }

    void add_before(std::size_t place, const std::string& line) {
        const std::size_t newline =
            place == 0 ? std::string_view::npos : text_.rfind('\n', place - 1);
        const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
        const bool is_alone =
            text_.substr(begin, place - begin).find_first_not_of(kSpaces) == std::string_view::npos;
        edits_.push_back({is_alone ? begin : place, is_alone ? begin : place,
                          line + std::string(line_end_at(text_, place))});
    }

    void add_after(std::size_t place, const std::string& line) {
        std::size_t end = std::min(text_.find('\n', place), text_.size());
        if (end > place && text_[end - 1] == '\r') {
            --end;
        }
        const std::size_t at = is_blank_or_comment(text_.substr(place, end - place)) ? end : place;
        edits_.push_back({at, at, std::string(line_end_at(text_, place)) + line});
    }

    [[nodiscard]] std::string result() {
        std::stable_sort(edits_.begin(), edits_.end(),
                         [](const TextEdit& a, const TextEdit& b) { return a.begin < b.begin; });
        std::string text(std::string_view(bytes_).starts_with(kByteOrderMark) ? kByteOrderMark
                                                                              : std::string_view());
        std::size_t copied = 0;
        for (const TextEdit& edit : edits_) {
            text += text_.substr(copied, edit.begin - copied);
            text += edit.text;
            copied = edit.end;
        }
        text += text_.substr(copied);
        return text;
    }

    const std::string& path_;
    const std::string& bytes_;
    SourceMap sources_;
    Names names_;
    Diagnostics diagnostics_;
    FileId root_;
    Ast ast_;
    std::string_view text_;
    std::vector<TextEdit> edits_;
    std::optional<Error> error_;
};

} // namespace

Result<std::string> with_values(const std::string& path,
                                const std::string& bytes,
                                const StatementValues& values,
                                const FileLoader& load) {
    return values.empty() ? Result<std::string>(bytes)
                          : ValueWriter(path, bytes, load).write(values);
}

} // namespace lsys
