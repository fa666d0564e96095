// SPDX-License-Identifier: MIT
// The functions that authors of cpfg models draw as curves and call by number: `func(3, x)`. A view
// file beside the L-system lists their files (`function: leaf.func 100`) or a set of them with
// names (`function set: all.fset`). A curve is a B-spline in the plane with ascending x. cpfg
// computes a table of its values at equal steps of x from 0 to 1 and interpolates between them.
#pragma once

#include "grammar/base/result.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct CurvePoint {
    double x = 0.0;
    double y = 0.0;
};

struct CpfgCurve {
    std::string name;               // empty for a curve in a file of its own
    std::string file;               // name of the file without folder and extension; empty in a set
    std::vector<CurvePoint> points; // control polygon; x ascends
    std::size_t samples = 0;        // size of the table; less than 3: no table
};

/// The parts of a view file that affect the derivation.
struct CpfgView {
    std::string angle; // an expression of .lsys; empty: none is given
    std::vector<CpfgCurve> curves;
};

/// The text of a file beside the L-system, by its name. The Error is only the reason.
using FileBeside = std::function<Result<std::string>(std::string_view name)>;

/// Reads the angle and the curves of a view file and of the files that it names.
[[nodiscard]] CpfgView read_view(std::string_view text, const FileBeside& beside);

/// The table of a curve as cpfg computes it, with the errors of its search for x (up to 0.001).
/// Empty if cpfg has no table, or one too long for a `#curve`.
[[nodiscard]] std::vector<double> curve_table(const CpfgCurve& curve);

/// Names of the .lsys functions of one curve.
struct CpfgCurveNames {
    std::string function;
    std::string table;   // the `#curve` of the table, read at whole numbers
    std::string between; // the function that interpolates in the table
};
/// The statements that define the function of a curve.
[[nodiscard]] std::string curve_statements(const CpfgCurve& curve, const CpfgCurveNames& names);

/// The value of the curve at the .lsys expression `x`, clamped to the curve's ends. Piecewise
/// linear, within a thousandth of the curve's range of values.
[[nodiscard]] std::string curve_at(const CpfgCurve& curve, const std::string& x);

} // namespace lsys
