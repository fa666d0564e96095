// SPDX-License-Identifier: MIT
// The lines of a view file of cpfg that say how the turtle draws: tropisms, widths of lines and
// colours, as settings of .lsys.
#pragma once

#include "grammar/base/source.h"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The commands of a model whose effect depends on its view file.
struct CpfgUses {
    bool sets_widths = false;      // `#(w)` or `!(w)`
    bool steps_widths = false;     // `#` or `!`
    bool steps_colours = false;    // `;` or `,`
    bool has_elasticity = false;   // `_`
    bool changes_tropisms = false; // `@Ti`, `@Td` or `@Ts`
    bool has_any_texture = false;  // `@Tx(n)` with a computed n
    bool sets_textures = false;    // `@Tx`
    bool has_any_colour = false;   // a computed colour, which may have any index
    std::set<unsigned> colours{};  // constant colours, 0 to 255
    std::set<unsigned> textures{}; // constant n of `@Tx(n)`, textures of surfaces
    bool reads_places = false;     // `?P`
};

/// `texture: F: bark.rgb E: m S`.
struct CpfgTexture {
    std::string file;             // empty: its format is not read
    bool replaces_colour = false; // decal; else it is multiplied by the colour
    bool is_whole = false;        // S: one picture for a whole surface, not for each patch
    double ratio = 1.0;           // R: stretches the picture along a branch
};

/// Settings of .lsys, each with its place, and messages about lines that have no effect here.
struct CpfgLooks {
    struct Text {
        std::string text;
        SourceSpan span;
    };
    std::vector<Text> statements;
    std::vector<Text> left_out;        // messages about lines that have no effect
    std::vector<CpfgTexture> textures; // `@Tx(1)` sets the first one
    /// Colour at the start of the word; nullopt: the view file sets none.
    std::optional<unsigned> first_colour;
};

/// Reads the lines of a view file about widths, colours and tropisms. `view`: the file with the
/// text; kNoFile: there is no view file.
[[nodiscard]] CpfgLooks read_looks(FileId view, std::string_view text, const CpfgUses& uses);

/// Colour at the start of the word unless a view file sets it, as in cpfg.
inline constexpr unsigned kFirstCpfgColour = 128;

} // namespace lsys
