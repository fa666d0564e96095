// SPDX-License-Identifier: MIT
// .lpy: the declarative part of L-Py. `Axiom:`, `derivation length:`, `module`, constants, and the
// rules of `production:`, `decomposition:` and `homomorphism:` whose right sides are lists of
// modules: `A --> FA`, or `A(x) :` and lines `produce FA`, perhaps under `if`, `elif` and `else`.
// Other lines are Python, which lsc does not run; each is reported. The statements are those of
// abop/reader.h; abop/writer.h writes them.
#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/dialects/abop/reader.h"
#include "grammar/dialects/abop/writer.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kNone = std::string_view::npos;

/// The rest of a line that begins with `key` in lower or upper case; nullopt for other lines.
std::optional<std::string_view> value_of(std::string_view line, std::string_view key) {
    return lowered(line.substr(0, key.size())) == key
               ? std::optional(trimmed(line.substr(key.size())))
               : std::nullopt;
}

bool is_name(std::string_view text) {
    return !text.empty() && is_letter(text[0]) &&
           std::all_of(text.begin(), text.end(), is_word_character);
}

/// Whether a text is arithmetic: numbers, names, operators and parentheses, no quotes or brackets.
bool is_arithmetic(std::string_view text) {
    constexpr std::string_view kSigns = "+-*/^(). \t,<>=!";
    return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
        return is_word_character(c) || is_one_of(c, kSigns);
    });
}

class LpyReader {
public:
    LpyReader(FileId root, const ParseContext& context)
        : root_(root), context_(context), source_(context.sources.file(root).text()) {
        file_.is_lpy = true;
        file_.text = std::string(source_);
        bool in_comment = false;
        for (char& c : file_.text) {
            in_comment = c != '\n' && (in_comment || c == '#');
            c = in_comment || c == '\r' ? ' ' : c;
        }
        if (source_.starts_with("\xEF\xBB\xBF")) {
            std::fill_n(file_.text.begin(), 3, ' ');
        }
    }

    AbopFile read() {
        const std::string_view text = file_.text;
        for (std::size_t at = 0; at < text.size() && !has_ended_;) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            // The text from this line on stores settings of L-Py's user interface, which lsc does
            // not read.
            if (source_.substr(at, end - at).starts_with("###### INITIALISATION")) {
                break;
            }
            const std::string_view line = text.substr(at, end - at);
            if (!trimmed(line).empty()) {
                read_line(trimmed(line), line[0] == ' ' || line[0] == '\t');
            }
            at = end + 1;
        }
        end_block();
        report_python();
        return std::move(file_);
    }

private:
    [[nodiscard]] SourceSpan span(std::string_view part) const {
        const auto begin = static_cast<std::uint32_t>(part.data() - file_.text.data());
        return {root_, begin, begin + static_cast<std::uint32_t>(part.size())};
    }

    /// Reports the lines of Python since the last other line, as one mistake.
    void report_python() {
        if (python_.empty()) {
            return;
        }
        Diagnostic& error = context_.diagnostics.add(
            DiagnosticCode::ForeignFeature, python_.front(),
            python_.size() == 1 ? "this line is Python, which lsc does not run"
                                : "these lines are Python, which lsc does not run");
        for (std::size_t i = 1; i < python_.size(); ++i) {
            error.labels.push_back({python_[i], "and this one"});
        }
        python_.clear();
    }

    void read_line(std::string_view line, bool is_indented) {
        const std::size_t before = python_.size();
        read_statement(line, is_indented);
        if (python_.size() == before) {
            report_python();
        }
    }

    void read_statement(std::string_view line, bool is_indented) {
        if (is_indented && block_) {
            read_block_line(line);
            return;
        }
        end_block();
        if (line.starts_with("endlsystem")) {
            has_ended_ = true;
        } else if (!read_setting(line) && !read_rule(line) && !read_constant(line)) {
            if (line.starts_with("import ") || line.starts_with("from ")) {
                context_.diagnostics.add(DiagnosticCode::ForeignIgnored, span(line),
                                         "this import of Python has no effect here");
            } else {
                python_.push_back(span(line));
            }
        }
    }

    void add_setting(AbopKey key, std::string_view line, std::string_view value) {
        const SourceSpan name = span(line.substr(0, line.find(':')));
        if (const AbopSetting* const first = file_.find(key)) {
            context_.diagnostics
                .add(DiagnosticCode::ForeignSyntax, name, "this statement occurs twice")
                .labels.push_back({first->name, "it is here already"});
            return;
        }
        file_.settings.push_back({key, name, span(value)});
    }

    bool read_setting(std::string_view line) {
        if (const auto axiom = value_of(line, "axiom:")) {
            add_setting(AbopKey::Axiom, line, *axiom);
        } else if (const auto length = value_of(line, "derivation length:")) {
            add_setting(AbopKey::Generations, line, *length);
        } else if (const auto ignored = value_of(line, "ignore:")) {
            add_setting(AbopKey::Ignore, line, *ignored);
        } else if (const auto considered = value_of(line, "consider:")) {
            add_setting(AbopKey::Consider, line, *considered);
        } else if (value_of(line, "production:")) {
            stage_ = AbopStage::Rewrite;
            in_rules_ = true;
        } else if (value_of(line, "decomposition:")) {
            stage_ = AbopStage::Decompose;
            in_rules_ = true;
        } else if (value_of(line, "homomorphism:") || value_of(line, "interpretation:")) {
            stage_ = AbopStage::Interpret;
            in_rules_ = true;
        } else if (const auto names = value_of(line, "module ")) {
            read_names(*names);
        } else if (value_of(line, "maximum depth:") || value_of(line, "group ")) {
            context_.diagnostics.add(DiagnosticCode::ForeignIgnored, span(line),
                                     "this statement has no effect here");
        } else {
            return false;
        }
        return true;
    }

    /// Reads `Apex(age), Leaf : scale = 1`.
    void read_names(std::string_view names) {
        names = names.substr(0, length_up_to(names, ":"));
        std::size_t depth = 0;
        std::string name;
        for (const char c : std::string(names) + ",") {
            depth += c == '(' ? 1U : 0U;
            depth -= c == ')' && depth != 0 ? 1U : 0U;
            if (depth == 0 && is_word_character(c)) {
                name += c;
            } else if (c == ',' && depth == 0) {
                if (name.size() > 1) {
                    file_.names.push_back(name);
                }
                name.clear();
            }
        }
    }

    bool read_rule(std::string_view line) {
        if (!in_rules_) {
            return false;
        }
        const std::size_t arrow = line.find("-->");
        if (arrow == kNone) {
            if (!line.ends_with(':') || line.starts_with("def ") || line.starts_with("class ")) {
                return false;
            }
            block_ = rule_of(trimmed(line.substr(0, line.size() - 1)));
            return true;
        }
        AbopRule rule = rule_of(trimmed(line.substr(0, arrow)));
        if (const std::size_t colon = file_.text_of(rule.head).find(':'); colon != kNone) {
            const std::string_view head = file_.text_of(rule.head);
            rule.condition = span(trimmed(head.substr(colon + 1)));
            rule.head = span(trimmed(head.substr(0, colon)));
        }
        rule.arrow = span(line.substr(arrow, 3));
        add_rule(rule, trimmed(line.substr(arrow + 3)));
        return true;
    }

    AbopRule rule_of(std::string_view head) {
        AbopRule rule;
        rule.head = rule.span = rule.arrow = span(head);
        rule.stage = stage_;
        return rule;
    }

    void add_rule(AbopRule rule, std::string_view successor) {
        rule.successor = span(successor);
        rule.span.end = std::max(rule.span.end, rule.successor.end);
        split_contexts(file_, rule);
        file_.rules.push_back(rule);
    }

    /// Reads a line of the rule `block_`: `produce FA`, `if x > 1:`, `else:`.
    void read_block_line(std::string_view line) {
        for (const std::string_view key : {"produce", "nproduce"}) {
            const auto modules = value_of(line, key);
            if (modules && (line.size() == key.size() || !is_word_character(line[key.size()]))) {
                AbopRule rule = *block_;
                rule.arrow = span(line.substr(0, key.size()));
                rule.condition = condition_;
                add_rule(rule, *modules);
                condition_.reset();
                has_produced_ = true;
                return;
            }
        }
        for (const std::string_view key : {"if ", "elif "}) {
            const auto condition = value_of(line, key);
            if (condition && condition->ends_with(':')) {
                const std::string_view test = trimmed(condition->substr(0, condition->size() - 1));
                // An `if` within another `if`, or after a `produce`, cannot be written as rules
                // with conditions.
                if (!condition_ && is_arithmetic(test) && has_produced_ == (key == "elif ")) {
                    condition_ = span(test);
                    return;
                }
            }
        }
        if (trimmed(line.substr(0, 4)) == "else" && line.ends_with(':') && !condition_ &&
            has_produced_) {
            return;
        }
        if (line == "pass") {
            return;
        }
        has_produced_ = true;
        python_.push_back(span(line));
    }

    void end_block() {
        if (block_ && !has_produced_) {
            context_.diagnostics.add(DiagnosticCode::ForeignSyntax, block_->head,
                                     "this rule has no line `produce`");
        }
        block_.reset();
        condition_.reset();
        has_produced_ = false;
    }

    bool read_constant(std::string_view line) {
        const std::size_t equals = line.find('=');
        if (equals == kNone || line.substr(equals, 2) == "==") {
            return false;
        }
        const std::string_view name = trimmed(line.substr(0, equals));
        const std::string_view value = trimmed(line.substr(equals + 1));
        if (!is_name(name) || !is_arithmetic(value)) {
            return false;
        }
        file_.constants.push_back({span(name), span(value)});
        return true;
    }

    FileId root_;
    const ParseContext& context_;
    std::string_view source_;
    AbopFile file_;
    AbopStage stage_ = AbopStage::Rewrite;
    bool in_rules_ = false;               // a line `production:` or the like has been read
    bool has_ended_ = false;              // a line `endlsystem` has been read
    std::optional<AbopRule> block_;       // the rule whose indented lines follow
    std::optional<SourceSpan> condition_; // condition of the next `produce`
    bool has_produced_ = false;           // a `produce`, or Python, of block_ has been read
    std::vector<SourceSpan> python_;      // lines of Python that are not reported yet
};

} // namespace

std::string_view recognise_lpy(std::string_view text) {
    bool has_axiom = false;
    bool has_rules = false;
    bool is_code = false; // the text is a program of lpfg
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(text.substr(at, end - at));
        at = end + 1;
        has_axiom = has_axiom || value_of(line, "axiom:");
        has_rules = has_rules || value_of(line, "production:");
        is_code = is_code || line.starts_with("#include") || line.starts_with("Lsystem");
    }
    return has_axiom && has_rules && !is_code ? "its lines `Axiom:` and `production:`"
                                              : std::string_view();
}

void translate_lpy(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const AbopFile file = LpyReader(translation.file(), context).read();
    if (!context.diagnostics.has_errors()) {
        AbopWriter(file, context, translation).write(row.turtle);
    }
}

} // namespace lsys
