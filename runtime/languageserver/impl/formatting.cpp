// SPDX-License-Identifier: MIT
// Formatting of a document, of a range, and of the statement that a typed `;` ends. A range gets
// the layout that it has in the formatted document.
#include "grammar/base/characters.h"
#include "grammar/format/format.h"
#include "runtime/languageserver/impl/workspace.h"

#include <algorithm>
#include <optional>
#include <string>

namespace lsys {

namespace {

bool is_blank(char c) {
    return kWhitespace.find(c) != std::string_view::npos;
}

/// The text as `lsc fmt` writes it; nullopt if it has syntax errors.
std::optional<std::string> formatted(Workspace& workspace, const Document& document, Places& at) {
    if (!document.has_lsys_text()) {
        throw RequestError(RpcError::RequestFailed, "only .lsys files are laid out");
    }
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader load =
        make_loader(workspace.host.project, workspace.host.project.limits.max_bytes);
    const FileId file = sources.add(document.path, at.text(document.path));
    const ParseContext context{sources, names, diagnostics, load};
    return check_is_lsys(file, context) ? format_lsys(file, context) : std::nullopt;
}

/// formatted() for a request that fails if the text has syntax errors.
std::string formatted_whole(Workspace& workspace, const Document& document, Places& at) {
    std::optional<std::string> text = formatted(workspace, document, at);
    if (!text) {
        throw RequestError(RpcError::RequestFailed, "a text with syntax errors is not laid out");
    }
    return std::move(*text);
}

/// The edits that turn the blanks of `before` between `begin` and `end` into those of `after`.
/// The texts differ in blanks only; otherwise there are no edits.
Json blank_edits(const TextPlace& range,
                 std::string_view before,
                 std::string_view after,
                 Places& at) {
    Json edits = Json::array();
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < before.size() || j < after.size()) {
        std::size_t i_end = i;
        std::size_t j_end = j;
        while (i_end < before.size() && is_blank(before[i_end])) {
            ++i_end;
        }
        while (j_end < after.size() && is_blank(after[j_end])) {
            ++j_end;
        }
        const std::string_view wanted = after.substr(j, j_end - j);
        if (before.substr(i, i_end - i) != wanted && range.begin <= i && i_end <= range.end) {
            edits.push_back({{"range", at.range({range.path, static_cast<std::uint32_t>(i),
                                                 static_cast<std::uint32_t>(i_end)})},
                             {"newText", wanted}});
        }
        if (i_end < before.size() && j_end < after.size() && before[i_end] != after[j_end]) {
            return Json::array();
        }
        i = i_end + 1;
        j = j_end + 1;
    }
    return edits;
}

} // namespace

Json format_document(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    Places at(workspace);
    const std::string after = formatted_whole(workspace, document, at);
    const std::string& before = at.text(document.path);
    Json edits = Json::array();
    if (after != before) {
        edits.push_back(changing_edit(document.path, before, after, at));
    }
    return edits;
}

Json format_range(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    Places at(workspace);
    const std::string after = formatted_whole(workspace, document, at);
    const Json& range = params.at("range");
    const TextPlace place{document.path, at.offset(document.path, range.at("start")),
                          at.offset(document.path, range.at("end"))};
    return blank_edits(place, at.text(document.path), after, at);
}

Json format_on_type(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    Places at(workspace);
    const std::uint32_t end = at.offset(document.path, params.at("position"));
    const std::shared_ptr<const NameIndex> names = workspace.names({document.path});
    const auto ended = std::find_if(
        names->statements.begin(), names->statements.end(), [&](const StatementOutline& statement) {
            return statement.place.path == document.path && statement.place.end == end;
        });
    if (ended == names->statements.end()) {
        return Json::array(); // the `;` is in a comment, or the statement has errors
    }
    const std::optional<std::string> after = formatted(workspace, document, at);
    if (!after) {
        return Json::array(); // other statements are unfinished
    }
    const std::string& before = at.text(document.path);
    std::size_t begin = ended->place.begin;
    while (begin > 0 && is_blank(before[begin - 1]) && before[begin - 1] != '\n') {
        --begin; // the indentation too
    }
    return blank_edits({document.path, static_cast<std::uint32_t>(begin), end}, before, *after, at);
}

} // namespace lsys
