// SPDX-License-Identifier: MIT
// Semantic tokens, folding, and colours of materials and modules.
#include "grammar/ast/include_chain.h"
#include "runtime/languageserver/impl/workspace.h"
#include "runtime/names/source_tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// Token types of LSP, by SourceTokenKind. Editors colour comments themselves.
constexpr std::array kTokenTypes{"class",  "variable", "parameter", "function",
                                 "method", "keyword",  "property"};

/// The value of an expression that is a literal number from 0 to 1; nullopt: it is another
/// expression.
std::optional<float> written_part(const Ast& ast, ExpressionId id) {
    const bool is_number = id != kNoExpression && ast.expression(id).kind == ExpressionKind::Number;
    const float value = is_number ? ast.expression(id).value : -1.0F;
    return value >= 0.0F && value <= 1.0F ? std::optional(value) : std::nullopt;
}

/// Collects the colours of one file that are written as three numbers.
class ColourFinder {
public:
    ColourFinder(const ParsedGrammar& parsed, std::string path, Places& at)
        : parsed_(parsed), ast_(parsed.ast), path_(std::move(path)), at_(at) {}

    Json find() {
        for (const Statement& statement : ast_.statements) {
            if (statement.kind == StatementKind::Material) {
                find_in_values(ast_.materials[statement.index].values);
            } else if (statement.kind == StatementKind::Axiom) {
                find_in_modules(ast_.axioms[statement.index].modules);
            } else if (statement.kind == StatementKind::Production) {
                find_in_modules(ast_.productions[statement.index].successor);
            }
        }
        return std::move(colours_);
    }

private:
    void add(const std::array<ExpressionId, 3>& parts) {
        std::array<float, 3> colour{};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::optional<float> part = written_part(ast_, parts[i]);
            if (!part) {
                return;
            }
            colour[i] = *part;
        }
        const SourceSpan first = ast_.expression(parts[0]).span();
        const SourceSpan last = ast_.expression(parts[2]).span();
        if (first.file == kNoFile || first.file != last.file ||
            normalised_path(parsed_.sources.file(first.file).path()) != path_) {
            return;
        }
        colours_.push_back(
            {{"range", at_.range({path_, first.begin, last.end})},
             {"color",
              {{"red", colour[0]}, {"green", colour[1]}, {"blue", colour[2]}, {"alpha", 1}}}});
    }

    /// Adds the three numbers after each key `colour`.
    void find_in_values(ListRange values) {
        for (std::uint32_t i = values.first; i + 3 < values.first + values.count; ++i) {
            const SetValue& key = ast_.set_values[i];
            const std::string_view name =
                key.is_word && !key.is_file ? parsed_.names.text(key.word) : std::string_view();
            if (name == "colour" || name == "color") {
                add({ast_.set_values[i + 1].value, ast_.set_values[i + 2].value,
                     ast_.set_values[i + 3].value});
            }
        }
    }

    /// Adds the numbers of modules `'(r, g, b)`.
    void find_in_modules(ModuleList list) {
        for (ModuleCursor cursor(ast_, parsed_.names, parsed_.sources, list); !cursor.done();
             cursor.next()) {
            if (parsed_.names.text(cursor.name()) != "'") {
                continue;
            }
            const ListRange arguments = cursor.view().arguments;
            if (arguments.count == 3) {
                const auto id = [&](std::uint32_t i) {
                    return ast_.expression_lists[arguments.first + i];
                };
                add({id(0), id(1), id(2)});
            }
        }
    }

    const ParsedGrammar& parsed_;
    const Ast& ast_;
    std::string path_;
    Places& at_;
    Json colours_ = Json::array();
};

} // namespace

Json token_legend() {
    return {{"tokenTypes", kTokenTypes}, {"tokenModifiers", Json::array()}};
}

Json semantic_tokens(Workspace& workspace, const Json& params) {
    const std::string path = workspace.document(params.at("textDocument").at("uri")).path;
    Places at(workspace);
    const std::shared_ptr<const NameIndex> index = workspace.names({path});
    Json data = Json::array();
    std::uint32_t line = 0;
    std::uint32_t character = 0;
    for (const SourceToken& token : source_tokens(*index, path, at.text(path))) {
        if (token.kind == SourceTokenKind::Comment) {
            continue;
        }
        const TextPosition begin = at.position(path, token.begin);
        const TextPosition end = at.position(path, token.end);
        if (begin.line != end.line) {
            continue; // a token is in one line
        }
        data.push_back(begin.line - line);
        data.push_back(begin.line == line ? begin.character - character : begin.character);
        data.push_back(end.character - begin.character);
        data.push_back(static_cast<std::uint32_t>(token.kind));
        data.push_back(0);
        line = begin.line;
        character = begin.character;
    }
    return {{"data", std::move(data)}};
}

Json folding_ranges(Workspace& workspace, const Json& params) {
    const std::string path = workspace.document(params.at("textDocument").at("uri")).path;
    Places at(workspace);
    Json ranges = Json::array();
    const auto add = [&](std::uint32_t begin, std::uint32_t end, const char* kind) {
        const Json range = at.range({path, begin, end});
        const Json& first = range.at("start").at("line");
        const Json& last = range.at("end").at("line");
        if (first != last) {
            ranges.push_back({{"startLine", first}, {"endLine", last}});
            if (*kind != '\0') {
                ranges.back()["kind"] = kind;
            }
        }
    };
    const std::string& text = at.text(path);
    std::uint32_t done = 0; // end of the last statement; comments lie between statements
    const auto add_comments = [&](std::uint32_t end) {
        for (std::size_t begin = text.find("/*", done); begin < end;) {
            const std::size_t close = text.find("*/", begin + 2);
            if (close == std::string::npos) {
                return;
            }
            add(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(close + 2),
                "comment");
            begin = text.find("/*", close + 2);
        }
    };
    const std::shared_ptr<const NameIndex> index = workspace.names({path});
    for (const StatementOutline& statement : index->statements) {
        if (statement.place.path == path) {
            add_comments(statement.place.begin);
            add(statement.place.begin, statement.place.end, "");
            done = std::max(done, statement.place.end);
        }
    }
    add_comments(static_cast<std::uint32_t>(text.size()));
    return ranges;
}

Json document_colours(Workspace& workspace, const Json& params) {
    const std::string path = workspace.document(params.at("textDocument").at("uri")).path;
    Places at(workspace);
    const std::shared_ptr<const IndexedGrammar> grammar = workspace.grammar(path);
    return grammar ? ColourFinder(grammar->parsed, path, at).find() : Json::array();
}

Json colour_presentations(Workspace& workspace, const Json& params) {
    const auto part = [&](const char* name) {
        const double value = params.at("color").at(name).get<double>();
        return std::round(std::clamp(value, 0.0, 1.0) * 1000.0) / 1000.0;
    };
    // The numbers of a module are separated by commas, those of a `#material` by blanks.
    const std::string path = workspace.document(params.at("textDocument").at("uri")).path;
    Places at(workspace);
    const std::uint32_t begin = at.offset(path, params.at("range").at("start"));
    const std::uint32_t end = at.offset(path, params.at("range").at("end"));
    const std::string_view replaced =
        std::string_view(at.text(path)).substr(begin, std::max(begin, end) - begin);
    const std::string_view separator = replaced.find(',') != std::string_view::npos ? ", " : " ";
    return Json::array({Json{{"label", fmt::format("{}{}{}{}{}", part("red"), separator,
                                                   part("green"), separator, part("blue"))}}});
}

} // namespace lsys
