// SPDX-License-Identifier: MIT
// The part of CpfgWriter that finds what a model uses of its view file.
#include "grammar/dialects/cpfg/writer.h"

#include <charconv>
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

} // namespace lsys
