// SPDX-License-Identifier: MIT
// Surfaces and contours of a cpfg model: the lines `surface:`, `contour:` and `contour sides:` of
// its view file, and the contour files (.con), which hold control points of a uniform cubic
// B-spline.
#pragma once

#include "grammar/base/source.h"
#include "grammar/dialects/cpfg/curves.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// `surface: l leaf.s 0.5 4 6 2`: file, scale, steps of a patch, texture.
struct CpfgSurface {
    std::string file;
    SourceSpan span; // of the name of the file, in the view file
    double scale = 1.0;
    std::uint32_t row_steps = 0; // 0: the file states the steps
    std::uint32_t column_steps = 0;
    std::optional<std::uint32_t> texture; // 0: none; nullopt: that of the turtle
    bool is_whole = false;                // one picture for the whole surface, not for each patch
    std::optional<std::string> failure;   // why the file cannot be read
};

/// `contour: 2 leaf.con`.
struct CpfgContour {
    std::string file;
    SourceSpan span; // of the name of the file, in the view file
    /// Points around the turtle, relative to the width: x to the right, y up; closed if the last
    /// equals the first. Empty for a file that cannot be read.
    std::vector<CurvePoint> points;
    std::string failure; // why there are no points
};

struct CpfgOrgans {
    std::map<std::string, CpfgSurface> surfaces;   // by the letter behind `~`
    std::map<std::uint32_t, CpfgContour> contours; // by number
    std::uint32_t sides = 0;                       // number of sides of a contour; 0: not given
};

/// Reads the surfaces and contours of a view file. `file`: the file with the text `view`.
[[nodiscard]] CpfgOrgans read_organs(FileId file, std::string_view view, const FileBeside& beside);

/// The points of a contour file at `sides` equal distances along the contour, as cpfg places them;
/// empty if the text is no contour.
[[nodiscard]] std::vector<CurvePoint> contour_points(std::string_view text, std::uint32_t sides);

/// The statement `#contour contourNUMBER ...;`, which the module `@#(NUMBER)` of the turtle profile
/// finds by its name.
[[nodiscard]] std::string contour_statement(std::uint32_t number,
                                            const std::vector<CurvePoint>& points);

/// The object of a surface in quotes: `"leaf.s"`, or `"leaf.s#0.5 steps 4 6 texture 2 whole"`.
[[nodiscard]] std::string object_text(const CpfgSurface& surface);

} // namespace lsys
