// SPDX-License-Identifier: MIT
#include "grammar/dialects/other_language.h"

#include "grammar/base/characters.h"
#include "grammar/dialects/dialect.h"
#include "grammar/dialects/impl/known_formats.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <vector>

namespace lsys {

namespace {

struct Line {
    std::string_view text; // the line without blanks at its ends
    std::uint32_t begin = 0;
};

/// The first lines that are not empty, enough to recognise any language.
std::vector<Line> lines_of(std::string_view text) {
    constexpr std::size_t kMaxLines = 2000;
    std::vector<Line> lines;
    for (std::size_t at = 0; at < text.size() && lines.size() < kMaxLines;) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(text.substr(at, end - at));
        if (!line.empty()) {
            lines.push_back({line, static_cast<std::uint32_t>(line.data() - text.data())});
        }
        at = end + 1;
    }
    return lines;
}

/// The length of the identifier at the start of `text`.
std::size_t word_length(std::string_view text) {
    std::size_t length = 0;
    while (length < text.size() && is_word_character(text[length])) {
        ++length;
    }
    return length;
}

/// Whether a line begins a statement that only .lsys has: `#n =`, `#name :`, `#set key`, or
/// `name :` and the other parts of a production.
bool is_lsys_statement(std::string_view line) {
    // A line number or the sign of a diff may stand before the statement.
    const std::size_t start = line.find_first_not_of("0123456789+-.:| \t");
    if (start != 0 && start != std::string_view::npos && line[start] == '#') {
        line.remove_prefix(start);
    }
    const bool has_hash = line.starts_with('#');
    const std::string_view rest = line.substr(has_hash ? 1 : 0);
    const std::size_t length = word_length(rest);
    const std::string_view word = rest.substr(0, length);
    const std::string_view behind = trimmed(rest.substr(length));
    if (length == 0) {
        return has_hash && rest.find(':') != std::string_view::npos && line.ends_with(';');
    }
    if (!has_hash) {
        const bool is_scope = behind.starts_with("::"); // of C++ or Rust
        return behind.starts_with(':') && !is_scope && line.ends_with(';') &&
               std::count(line.begin(), line.end(), ':') >= 2;
    }
    return behind.starts_with(':') || behind.starts_with('=') || word == "set" || word == "param" ||
           word == "object" || word == "decompose" || word == "interpret" || word == "module" ||
           line.ends_with(';');
}

/// The first line for which `matches` is true; null if there is none.
template <typename Matches>
const Line* find_line(const std::vector<Line>& lines, const Matches& matches) {
    const auto found = std::find_if(lines.begin(), lines.end(),
                                    [&](const Line& line) { return matches(line.text); });
    return found == lines.end() ? nullptr : &*found;
}

auto begins_with(std::string_view word) {
    return [word](std::string_view line) { return lowered(line.substr(0, word.size())) == word; };
}

std::optional<OtherLanguage> language_at(const Line* line, std::string name, std::string help) {
    if (line == nullptr) {
        return std::nullopt;
    }
    return OtherLanguage{std::move(name), std::move(help), line->begin,
                         line->begin + static_cast<std::uint32_t>(line->text.size())};
}

bool has_line(const std::vector<Line>& lines, std::string_view word) {
    return find_line(lines, begins_with(word)) != nullptr;
}

/// The .lsys equivalents of the statements of an L-Py model, with the names of the model.
std::string advice_for_lpy(const std::vector<Line>& lines, const Line& axiom) {
    std::string text = "give it a name that ends with `.lpy`, and lsc reads all but its Python; or "
                       "rewrite the model: `" +
                       std::string(axiom.text) +
                       "` is `#w : " + std::string(trimmed(axiom.text.substr(6))) + ";`";
    if (const Line* const length = find_line(lines, begins_with("derivation length:"))) {
        text += ", `" + std::string(length->text) +
                "` is `#n = " + std::string(trimmed(length->text.substr(18))) + ";`";
    }
    const Line* const rule = find_line(lines, [](std::string_view line) {
        return line.find("-->") != std::string_view::npos ||
               (line.ends_with(':') && line.find('(') != std::string_view::npos);
    });
    if (rule != nullptr) {
        const std::size_t end = std::min(rule->text.find("-->"),
                                         rule->text.size() - (rule->text.ends_with(':') ? 1U : 0U));
        text += ", and the production of `" + std::string(trimmed(rule->text.substr(0, end))) +
                "` is `#p1 : " + std::string(trimmed(rule->text.substr(0, end))) +
                " : condition : successor;`, with `*` for no condition";
    }
    return text;
}

/// Recognises files of programs that have parts of a grammar, and that lsc does not read: lpfg,
/// RubberPlant, and the panels of L-studio.
std::optional<OtherLanguage> recognise_program(const std::vector<Line>& lines) {
    const Line* const header = find_line(lines, begins_with("#include <lpfgall.h>"));
    const Line* const axiom = find_line(lines, begins_with("axiom:"));
    const bool produces = (axiom != nullptr || has_line(lines, "module ")) &&
                          (has_line(lines, "module ") || has_line(lines, "derivation length:")) &&
                          find_line(lines, [](std::string_view line) {
                              const bool has_end = line.ends_with(';') || line.ends_with('}');
                              return line.find("produce ") != std::string_view::npos && has_end;
                          }) != nullptr;
    if (header != nullptr || produces) {
        return language_at(
            axiom != nullptr    ? axiom
            : header != nullptr ? header
                                : &lines.front(),
            "an lpfg model",
            "lsc does not read lpfg; its productions are C++ and have to be rewritten");
    }
    const Line* const system = find_line(lines, [](std::string_view line) {
        return line.starts_with("lsystem ") && line.ends_with('{');
    });
    if (system != nullptr) {
        return language_at(system, "a file of RubberPlant",
                           "lsc does not read RubberPlant; write the lines in the book's notation, "
                           "`axiom: F`, `angle: 90` and `F -> F+F`, into a file `.ls`");
    }
    return lines.front().text.starts_with("panel name:")
               ? language_at(&lines.front(), "a panel of L-studio",
                             "a panel holds sliders; the grammar is another file of the object")
               : std::nullopt;
}

/// Recognises models of L-Py: programs with `Axiom:` and `production:`.
std::optional<OtherLanguage> recognise_lpy_lines(const std::vector<Line>& lines) {
    const Line* const axiom = find_line(lines, begins_with("axiom:"));
    const bool is_lpy = has_line(lines, "derivation length:") || has_line(lines, "production:") ||
                        has_line(lines, "endlsystem") || has_line(lines, "interpretation:") ||
                        find_line(lines, [](std::string_view line) {
                            return line.starts_with("produce ") || line.starts_with("nproduce ");
                        }) != nullptr;
    return axiom != nullptr && is_lpy
               ? language_at(axiom, "an L-Py model", advice_for_lpy(lines, *axiom))
               : std::nullopt;
}

/// Recognises formats that hold no grammar.
std::optional<OtherLanguage> recognise_format(const std::vector<Line>& lines) {
    const Line& first = lines.front();
    const std::string_view text = first.text;
    const char second = text.size() > 1 ? text[1] : lines.size() > 1 ? lines[1].text[0] : '\0';
    if ((text[0] == '{' && (second == '"' || second == '}')) ||
        (text[0] == '[' && (second == '{' || second == '"'))) {
        return language_at(&first, "JSON", "a grammar is text of its own; see `docs/manual.md`");
    }
    if (text.starts_with("[[") || find_line(lines, [](std::string_view line) {
                                      return line.starts_with("[[") && line.ends_with("]]");
                                  }) != nullptr) {
        return language_at(&first, "TOML",
                           "a scene has a name that ends with `.toml`: `lsc forest scene.toml`");
    }
    const bool has_heading = text.starts_with("# ") || text.starts_with("## ");
    const bool has_fence = find_line(lines, begins_with("```")) != nullptr;
    const Line* const mark = find_line(lines, [](std::string_view line) {
        return line.starts_with("```") || line.starts_with("## ") || line.starts_with("### ") ||
               line.starts_with("- ") || line.starts_with("| ");
    });
    if (has_fence || (has_heading && mark != nullptr)) {
        return language_at(&first, "Markdown", "save the grammar alone, as plain text");
    }
    std::vector<std::string_view> texts;
    for (const Line& line : lines) {
        texts.push_back(line.text);
    }
    if (const std::optional<KnownFormat> known = find_known_format(texts)) {
        return language_at(&lines[known->line], std::string(known->name),
                           "a grammar is plain text with statements such as `#w : F;`");
    }
    const Line* const scene = find_line(lines, [](std::string_view line) {
        return line.starts_with("#declare ") || line.starts_with("#macro ") ||
               line.starts_with("light_source") || line.starts_with("camera {") ||
               line.starts_with("global_settings");
    });
    if (scene != nullptr) {
        return language_at(scene, "a scene of POV-Ray",
                           "a grammar has statements such as `#w : F;`");
    }
    const Line* const import = find_line(lines, [](std::string_view line) {
        return (line.starts_with("import ") || line.starts_with("from ") ||
                line.starts_with("def ")) &&
               !line.ends_with(';');
    });
    if (import != nullptr) {
        return language_at(import, "a Python program",
                           "a grammar has statements such as `#w : F;`");
    }
    const Line* const code = find_line(lines, [](std::string_view line) {
        return line.starts_with("#include <") || line.starts_with("int main(") ||
               line.starts_with("void main(");
    });
    if (code != nullptr) {
        return language_at(code, "a C program", "a grammar has statements such as `#w : F;`");
    }
    const std::optional<KnownFormat> plain = find_plain_text(texts);
    return plain ? language_at(&lines[plain->line], std::string(plain->name),
                               "a grammar is plain text with statements such as `#w : F;`")
                 : std::nullopt;
}

/// Help text for a file in a dialect that lsc reads.
std::string reading_of(const DialectRow& row) {
    const std::string_view usual_extension = row.dialect == Dialect::Lparser ? ".ls" : ".l";
    const std::string_view extensions = row.extensions.empty() ? usual_extension : row.extensions;
    return "give it a name that ends with `" +
           std::string(extensions.substr(0, extensions.find(' '))) + "`, or write `--dialect " +
           std::string(row.name) + "`";
}

} // namespace

std::optional<OtherLanguage> recognise_other_language(std::string_view text) {
    const std::vector<Line> lines = lines_of(text);
    if (lines.empty()) {
        return std::nullopt;
    }
    if (std::optional<OtherLanguage> program = recognise_program(lines)) {
        return program;
    }
    if (find_line(lines, [](std::string_view line) { return is_lsys_statement(line); }) !=
        nullptr) {
        return std::nullopt;
    }
    if (const DialectRow& cpfg = row_of(Dialect::Cpfg); !cpfg.recognise(text).empty()) {
        return language_at(find_line(lines, begins_with("lsystem")), std::string(cpfg.title),
                           reading_of(cpfg));
    }
    if (std::optional<OtherLanguage> other = recognise_lpy_lines(lines)) {
        return other;
    }
    if (const DialectRow& lparser = row_of(Dialect::Lparser); !lparser.recognise(text).empty()) {
        return language_at(&lines.front(), std::string(lparser.title), reading_of(lparser));
    }
    for (const DialectRow& row : dialects()) {
        // Texts in the dialects abop and lpy are parsed as .lsys, whose messages explain their
        // lines one by one.
        const bool is_explained =
            row.recognise == nullptr || row.dialect == Dialect::Abop || row.dialect == Dialect::Lpy;
        if (!is_explained && !row.recognise(text).empty()) {
            return language_at(&lines.front(), std::string(row.title), reading_of(row));
        }
    }
    return recognise_format(lines);
}

bool is_other_program(std::string_view text) {
    const std::vector<Line> lines = lines_of(text);
    return !lines.empty() && recognise_program(lines).has_value();
}

bool is_unread_language(std::string_view text) {
    const std::vector<Line> lines = lines_of(text);
    return !lines.empty() &&
           find_line(lines, [](std::string_view line) { return is_lsys_statement(line); }) ==
               nullptr &&
           (recognise_lpy_lines(lines) || recognise_format(lines));
}

bool is_foreign_notation(std::string_view text) {
    const std::vector<Line> lines = lines_of(text);
    if (lines.empty()) {
        return false;
    }
    if (recognise_lpy_lines(lines)) {
        return true;
    }
    std::size_t count = 0;
    for (const Line& line : lines) {
        for (const std::string_view word :
             {"variables", "constants", "alphabet", "axiom", "start", "rules", "angle", "\u03c9"}) {
            const std::string_view rest =
                begins_with(word)(line.text) ? trimmed(line.text.substr(word.size())) : "";
            count += rest.starts_with(':') || rest.starts_with('=') ? 1U : 0U;
        }
        count += line.text.find("\u2192") != std::string_view::npos ? 1U : 0U;
    }
    return count >= 2;
}

} // namespace lsys
