// SPDX-License-Identifier: MIT
// The part of CpfgWriter that reads the view file, and finds what a model uses of it.
#include "grammar/ast/reports.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/cpfg/materials.h"
#include "grammar/dialects/cpfg/view_files.h"
#include "grammar/dialects/cpfg/writer.h"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

CpfgUses CpfgWriter::find_uses() const {
    CpfgUses uses;
    const auto is_any = [&](const char* name, bool has_arguments) {
        return forms_.count({name, has_arguments}) != 0;
    };
    uses.sets_widths = is_any("#", true) || is_any("!", true);
    uses.steps_widths = is_any("#", false) || is_any("!", false);
    uses.steps_colours = is_any(";", false) || is_any(",", false);
    uses.has_elasticity = used_.count("_") != 0;
    uses.reads_places = used_.count("?P") != 0;
    for (const char* const name : {"@Ti", "@Td", "@Ts"}) {
        uses.changes_tropisms = uses.changes_tropisms || used_.count(name) != 0;
    }
    const auto visit = [&](const std::vector<CpfgModule>& list) {
        for (const CpfgModule& module : list) {
            const bool is_texture = module.name == "@Tx";
            const bool is_colour = module.name == ";" || module.name == ",";
            uses.sets_textures = uses.sets_textures || is_texture;
            if (!(is_texture || is_colour) || module.arguments.empty()) {
                continue;
            }
            const ForeignNode& index = expression(module.arguments[0]);
            unsigned number = 0;
            const auto [end, error] =
                std::from_chars(index.text.data(), index.text.data() + index.text.size(), number);
            if (index.kind == ForeignKind::Number && error == std::errc() &&
                end == index.text.data() + index.text.size()) {
                (is_texture ? uses.textures : uses.colours).insert(number);
            } else {
                (is_texture ? uses.has_any_texture : uses.has_any_colour) = true;
            }
        }
    };
    visit(session_.axiom);
    for (const CpfgProduction& production : session_.productions) {
        visit(production.successor);
    }
    return uses;
}

void CpfgWriter::read_view_file() {
    const std::string_view path = context_.sources.file(out_.file()).path();
    const std::size_t dot = path.rfind('.');
    if (dot == path.npos || dot < folder_of_path(path).size()) {
        return;
    }
    const std::string folder(folder_of_path(path));
    CpfgFiles files = find_cpfg_files(path, context_);
    const FileBeside beside = [&](std::string_view name) {
        return context_.load(folder + std::string(name));
    };
    const FileId view =
        files.has_view ? context_.sources.add(files.view_path, files.view) : kNoFile;
    view_ = read_view(files.view, beside);
    organs_ = read_organs(view, files.view, beside);
    const CpfgUses commands = find_uses();
    CpfgUses uses = commands;
    for (const auto& [letter, span] : surfaces_) {
        const auto surface = organs_.surfaces.find(letter);
        if (surface != organs_.surfaces.end() && surface->second.texture.value_or(0) != 0) {
            uses.textures.insert(*surface->second.texture);
        }
    }
    looks_ = read_looks(view, files.view, uses);
    find_whole_surfaces(commands);
    materials_ =
        material_statements(files.colours, uses, looks_.first_colour.value_or(kFirstCpfgColour));
    if (!materials_.empty() && !looks_.first_colour) {
        looks_.statements.push_back(
            {"#set colour " + std::to_string(kFirstCpfgColour) + ";\n", {view, 0, 0}});
    }
    if (!files.colours.empty() && materials_.empty()) {
        expressions_.warn_left_out(header_, "colours",
                                   "`" + shown(files.colours_path) +
                                       "` holds neither 256 colours nor materials");
    }
    materials_ +=
        texture_statements(files.colours, uses, looks_.textures,
                           looks_.first_colour.value_or(materials_.empty() ? 0 : kFirstCpfgColour));
    for (const CpfgLooks::Text& line : looks_.left_out) {
        expressions_.warn_left_out(line.span, "view " + line.text, line.text);
    }
}

void CpfgWriter::find_whole_surfaces(const CpfgUses& commands) {
    const auto is_whole = [&](std::size_t number) {
        return number >= 1 && number <= looks_.textures.size() &&
               looks_.textures[number - 1].is_whole;
    };
    bool turtle_is_whole = commands.sets_textures;
    for (std::size_t number = 1; number <= looks_.textures.size(); ++number) {
        const bool may_be_set =
            commands.has_any_texture || commands.textures.count(static_cast<unsigned>(number)) != 0;
        turtle_is_whole = turtle_is_whole && (is_whole(number) || !may_be_set);
    }
    for (auto& [letter, surface] : organs_.surfaces) {
        surface.is_whole = surface.texture ? is_whole(*surface.texture) : turtle_is_whole;
    }
}

} // namespace lsys
