// SPDX-License-Identifier: MIT
// Symbols, definitions, references and renaming.
#include "compiler/bytecode/environment_keys.h"
#include "compiler/resolve/profiles.h"
#include "grammar/ast/include_chain.h"
#include "grammar/base/names.h"
#include "grammar/base/paths.h"
#include "runtime/languageserver/impl/workspace.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// Kinds of symbols of LSP.
enum class SymbolKindNumber : int {
    File = 1,
    Class = 5,
    Property = 7,
    Method = 6,
    Constructor = 9,
    Function = 12,
    Variable = 13,
    Constant = 14,
    Object = 19,
};

SymbolKindNumber symbol_kind(StatementKind kind) {
    switch (kind) {
    case StatementKind::Define:
        return SymbolKindNumber::Constant;
    case StatementKind::Param:
        return SymbolKindNumber::Variable;
    case StatementKind::Function:
    case StatementKind::Curve:
        return SymbolKindNumber::Function;
    case StatementKind::Module:
        return SymbolKindNumber::Class;
    case StatementKind::Object:
    case StatementKind::Sense:
    case StatementKind::Contour:
        return SymbolKindNumber::Object;
    case StatementKind::Include:
        return SymbolKindNumber::File;
    case StatementKind::Axiom:
        return SymbolKindNumber::Constructor;
    case StatementKind::Production:
        return SymbolKindNumber::Method;
    case StatementKind::Generations:
    case StatementKind::Material:
    case StatementKind::Set:
    case StatementKind::Ignore:
        break;
    }
    return SymbolKindNumber::Property;
}

/// Whether the statement has a place in the outline: it defines a name.
bool is_shown(const StatementOutline& statement) {
    return !statement.name.empty() && statement.kind != StatementKind::Set;
}

/// The name at a position, and all its uses in the project.
struct NameAt {
    std::shared_ptr<const NameIndex> index;
    std::vector<std::string> roots;
    const NameUse* use = nullptr; // a use in `index`; null: no name
    std::string path;             // path of the document

    /// All uses of the name, definitions too, in ascending order.
    [[nodiscard]] std::vector<const NameUse*> uses() const {
        std::vector<const NameUse*> all;
        for (const NameUse& each : index->uses) {
            if (use != nullptr && NameIndex::are_same(each, *use)) {
                all.push_back(&each);
            }
        }
        return all;
    }
};

void find_name(Workspace& workspace, const Json& params, Places& at, NameAt& found) {
    found.path = workspace.document(params.at("textDocument").at("uri")).path;
    const std::uint32_t offset = at.offset(found.path, params.at("position"));
    found.roots = workspace.roots_of(found.path);
    found.index = workspace.names(found.roots);
    found.use = found.index->at(found.path, offset);
}

[[noreturn]] void refuse(const std::string& reason) {
    throw RequestError(RpcError::RequestFailed, reason);
}

std::string quoted(const std::string& name) {
    return "`" + name + "`";
}

/// The reason why the name cannot be renamed; empty if it can be renamed.
std::string reason_against(const NameAt& at) {
    const NameUse& use = *at.use;
    const std::vector<const NameUse*> uses = at.uses();
    const bool is_defined = std::any_of(uses.begin(), uses.end(),
                                        [](const NameUse* each) { return each->is_definition; });
    if (use.kind == NameKind::Module) {
        const bool is_bound = std::any_of(
            at.index->statements.begin(), at.index->statements.end(), [&](const auto& statement) {
                return statement.kind == StatementKind::Object && statement.name == use.name;
            });
        if (is_turtle_sense(use.name)) {
            return quoted(use.name) + " asks the turtle";
        }
        if (!is_bound && find_turtle_command(at.index->profile, use.name) != nullptr) {
            return quoted(use.name) + " is a command of the turtle";
        }
        const auto part = std::find_if(uses.begin(), uses.end(),
                                       [](const NameUse* each) { return each->is_part; });
        if (part != uses.end()) {
            return quoted(use.name) + " is written together with other names in " +
                   quoted(std::string(name_of_path((*part)->place.path))) +
                   "; separate them by blanks first";
        }
        return {};
    }
    if (is_defined) {
        return {};
    }
    return use.kind == NameKind::Function ? quoted(use.name) + " is a function of the language"
                                          : quoted(use.name) + " is not defined";
}

/// Whether renaming keeps the meaning: whether every name has the same kind and scope before and
/// after it.
bool is_kept(const NameIndex& before,
             const NameIndex& after,
             const NameUse& renamed,
             const std::string& new_name) {
    std::map<TextPlace, std::size_t> scopes_before;
    std::map<TextPlace, std::size_t> scopes_after;
    if (before.uses.size() != after.uses.size()) {
        return false;
    }
    for (std::size_t i = 0; i < before.uses.size(); ++i) {
        const NameUse& old = before.uses[i];
        const NameUse& now = after.uses[i];
        const std::string& wanted = NameIndex::are_same(old, renamed) ? new_name : old.name;
        const std::size_t old_scope =
            scopes_before.try_emplace(old.scope, scopes_before.size()).first->second;
        const std::size_t new_scope =
            scopes_after.try_emplace(now.scope, scopes_after.size()).first->second;
        if (now.name != wanted || now.kind != old.kind || now.is_definition != old.is_definition ||
            now.is_part != old.is_part || now.place.path != old.place.path ||
            old_scope != new_scope) {
            return false;
        }
    }
    return true;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

} // namespace

Json document_symbols(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    Places at(workspace);
    Json symbols = Json::array();
    const std::shared_ptr<const NameIndex> names = workspace.names({document.path});
    for (const StatementOutline& statement : names->statements) {
        if (statement.place.path != document.path || !is_shown(statement)) {
            continue;
        }
        Json symbol{{"name", statement.name},
                    {"kind", static_cast<int>(symbol_kind(statement.kind))}};
        if (workspace.editor.nested_symbols) {
            symbol["detail"] = statement.detail;
            symbol["range"] = at.range(statement.place);
            symbol["selectionRange"] = at.range(statement.name_place);
        } else {
            symbol["location"] = at.location(statement.place);
        }
        symbols.push_back(std::move(symbol));
    }
    return symbols;
}

Json workspace_symbols(Workspace& workspace, const Json& params) {
    constexpr std::size_t kMaxSymbols = 1000;
    const std::string query = lower(params.at("query").get<std::string>());
    Places at(workspace);
    Json symbols = Json::array();
    for (const std::string& path : workspace.known_grammars({})) {
        const std::shared_ptr<const NameIndex> names = workspace.names({path});
        for (const StatementOutline& statement : names->statements) {
            if (statement.place.path != path || !is_shown(statement) ||
                statement.kind == StatementKind::Include ||
                lower(statement.name).find(query) == std::string::npos) {
                continue;
            }
            symbols.push_back({{"name", statement.name},
                               {"kind", static_cast<int>(symbol_kind(statement.kind))},
                               {"location", at.location(statement.name_place)},
                               {"containerName", std::string(name_of_path(path))}});
            if (symbols.size() == kMaxSymbols) {
                return symbols;
            }
        }
    }
    return symbols;
}

Json go_to_definition(Workspace& workspace, const Json& params) {
    Places at(workspace);
    NameAt found;
    find_name(workspace, params, at, found);
    Json locations = Json::array();
    for (const NameUse* each : found.uses()) {
        if (each->is_definition) {
            locations.push_back(at.location(each->place));
        }
    }
    if (found.use != nullptr) {
        return locations;
    }
    // The name may be the file of an `#include`.
    const std::uint32_t offset = at.offset(found.path, params.at("position"));
    for (const StatementOutline& statement : found.index->statements) {
        if (statement.kind == StatementKind::Include && statement.name_place.path == found.path &&
            statement.name_place.begin <= offset && offset <= statement.name_place.end) {
            locations.push_back(
                at.location({normalised_path(path_beside(found.path, statement.name)), 0, 0}));
        }
    }
    return locations;
}

Json find_references(Workspace& workspace, const Json& params) {
    const bool with_definitions = params.at("context").at("includeDeclaration").get<bool>();
    Places at(workspace);
    NameAt found;
    find_name(workspace, params, at, found);
    Json locations = Json::array();
    for (const NameUse* each : found.uses()) {
        if (with_definitions || !each->is_definition) {
            locations.push_back(at.location(each->place));
        }
    }
    return locations;
}

Json highlight_name(Workspace& workspace, const Json& params) {
    Places at(workspace);
    NameAt found;
    find_name(workspace, params, at, found);
    Json highlights = Json::array();
    for (const NameUse* each : found.uses()) {
        if (each->place.path == found.path) {
            highlights.push_back({{"range", at.range(each->place)},
                                  {"kind", each->is_definition ? 3 : 2}}); // write, read
        }
    }
    return highlights;
}

Json prepare_rename(Workspace& workspace, const Json& params) {
    Places at(workspace);
    NameAt found;
    find_name(workspace, params, at, found);
    if (found.use == nullptr) {
        return nullptr;
    }
    if (const std::string reason = reason_against(found); !reason.empty()) {
        refuse(reason);
    }
    return {{"range", at.range(found.use->place)}, {"placeholder", found.use->name}};
}

Json rename_name(Workspace& workspace, const Json& params) {
    const auto new_name = params.at("newName").get<std::string>();
    Places at(workspace);
    NameAt found;
    find_name(workspace, params, at, found);
    if (found.use == nullptr) {
        refuse("there is no name at this place");
    }
    const NameUse use = *found.use;
    if (const std::string reason = reason_against(found); !reason.empty()) {
        refuse(reason);
    }
    if (!is_identifier(new_name)) {
        refuse(quoted(new_name) +
               " is not a name: a name has letters, digits and `_`, and begins with no digit");
    }
    if (new_name == use.name) {
        return {{"changes", Json::object()}};
    }
    if (use.kind == NameKind::Module &&
        find_turtle_command(found.index->profile, new_name) != nullptr) {
        refuse(quoted(new_name) + " is a command of the turtle");
    }
    if (use.kind == NameKind::Environment && is_turtle_sense('?' + new_name)) {
        refuse(quoted('?' + new_name) + " asks the turtle");
    }
    for (const NameUse& each : found.index->uses) {
        if (each.kind == use.kind && each.name == new_name && each.scope == use.scope) {
            refuse(quoted(new_name) + " exists already");
        }
    }
    Json changes = Json::object();
    std::map<std::string, std::string> changed;
    // Replace from the last place to the first, so that the places before stay valid.
    const std::vector<const NameUse*> uses = found.uses();
    for (auto each = uses.rbegin(); each != uses.rend(); ++each) {
        const TextPlace& place = (*each)->place;
        std::string& text = changed.try_emplace(place.path, at.text(place.path)).first->second;
        text.replace(place.begin, place.end - place.begin, new_name);
        changes[workspace.uri_of(place.path)].push_back(
            {{"range", at.range(place)}, {"newText", new_name}});
    }
    if (!is_kept(*found.index, workspace.names_if(found.roots, changed), use, new_name)) {
        refuse("with the name " + quoted(new_name) + " the grammar would have another meaning");
    }
    return {{"changes", std::move(changes)}};
}

} // namespace lsys
