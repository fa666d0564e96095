// SPDX-License-Identifier: MIT
// Semantic tokens, folding, and the colours of materials.
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

const Document& lsys_document(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    if (!document.is_lsys && !document.path.ends_with(".lsys")) {
        throw RequestError(RpcError::RequestFailed, "the document is no .lsys file");
    }
    return document;
}

/// The three numbers after the key `colour` at `index`, or nothing.
std::optional<std::array<float, 3>>
colour_at(const Ast& ast, std::uint32_t index, std::uint32_t end) {
    std::array<float, 3> colour{};
    for (std::uint32_t i = 0; i < 3; ++i) {
        if (index + i >= end || ast.set_values[index + i].value == kNoExpression) {
            return std::nullopt;
        }
        const Expression& value = ast.expression(ast.set_values[index + i].value);
        if (value.kind != ExpressionKind::Number || value.value < 0.0F || value.value > 1.0F) {
            return std::nullopt;
        }
        colour[i] = value.value;
    }
    return colour;
}

} // namespace

Json token_legend() {
    return {{"tokenTypes", kTokenTypes}, {"tokenModifiers", Json::array()}};
}

Json semantic_tokens(Workspace& workspace, const Json& params) {
    const std::string path = lsys_document(workspace, params).path;
    Places at(workspace);
    const NameIndex index = workspace.index({path}, {});
    Json data = Json::array();
    std::uint32_t line = 0;
    std::uint32_t character = 0;
    for (const SourceToken& token : source_tokens(index, path, at.text(path))) {
        if (token.kind == SourceTokenKind::Comment) {
            continue;
        }
        const Json range = at.range({path, token.begin, token.end});
        const auto begin_line = range.at("start").at("line").get<std::uint32_t>();
        const auto begin = range.at("start").at("character").get<std::uint32_t>();
        const auto end = range.at("end").at("character").get<std::uint32_t>();
        data.push_back(begin_line - line);
        data.push_back(begin_line == line ? begin - character : begin);
        data.push_back(end - begin);
        data.push_back(static_cast<std::uint32_t>(token.kind));
        data.push_back(0);
        line = begin_line;
        character = begin;
    }
    return {{"data", std::move(data)}};
}

Json folding_ranges(Workspace& workspace, const Json& params) {
    const std::string path = lsys_document(workspace, params).path;
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
    for (const StatementOutline& statement : workspace.index({path}, {}).statements) {
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
    const std::string path = lsys_document(workspace, params).path;
    Places at(workspace);
    ParsedGrammar parsed;
    const FileLoader none = [](const std::string& /*path*/) {
        return Result<std::string>(Error{"not read"});
    };
    parse_grammar(path, at.text(path), none, parsed);
    Json colours = Json::array();
    for (const MaterialNode& material : parsed.ast.materials) {
        const std::uint32_t end = material.values.first + material.values.count;
        for (std::uint32_t i = material.values.first; i < end; ++i) {
            const SetValue& key = parsed.ast.set_values[i];
            if (!key.is_word || key.is_file) {
                continue;
            }
            const std::string_view name = parsed.names.text(key.word);
            const auto colour = name == "colour" || name == "color"
                                    ? colour_at(parsed.ast, i + 1, end)
                                    : std::nullopt;
            if (colour) {
                colours.push_back(
                    {{"range", at.range({path, parsed.ast.set_values[i + 1].span.begin,
                                         parsed.ast.set_values[i + 3].span.end})},
                     {"color",
                      {{"red", (*colour)[0]},
                       {"green", (*colour)[1]},
                       {"blue", (*colour)[2]},
                       {"alpha", 1}}}});
            }
        }
    }
    return colours;
}

Json colour_presentations(Workspace& /*workspace*/, const Json& params) {
    const auto part = [&](const char* name) {
        const double value = params.at("color").at(name).get<double>();
        return std::round(std::clamp(value, 0.0, 1.0) * 1000.0) / 1000.0;
    };
    return Json::array(
        {Json{{"label", fmt::format("{} {} {}", part("red"), part("green"), part("blue"))}}});
}

} // namespace lsys
