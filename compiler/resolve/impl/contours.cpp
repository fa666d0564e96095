// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/contours.h"

#include "compiler/resolve/impl/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys {

std::optional<std::vector<ContourPoint>> ContourResolver::read_points(const CurveNode& node) {
    const std::uint32_t count = node.coordinates.count / 2;
    if (count < kMinContourPoints || count > kMaxContourPoints) {
        resolution_.diagnostics.add(DiagnosticCode::BadContour, node.name_span,
                                    fmt::format("a contour has {} to {} points, not {}",
                                                kMinContourPoints, kMaxContourPoints, count));
        return std::nullopt;
    }
    std::vector<ContourPoint> points(count);
    for (std::uint32_t i = 0; i < 2 * count; ++i) {
        const ExpressionId root = resolution_.ast.expression_lists[node.coordinates.first + i];
        const std::optional<float> number =
            expressions_.constant_value(expressions_.resolve(root, ExpressionPlace::Contour));
        if (!number) {
            return std::nullopt; // already reported
        }
        if (!std::isfinite(*number)) {
            resolution_.diagnostics.add(DiagnosticCode::BadContour,
                                        resolution_.ast.expression(root).span(),
                                        fmt::format("{} is not a coordinate", *number));
            return std::nullopt;
        }
        (i % 2 == 0 ? points[i / 2].x : points[i / 2].y) = *number;
    }
    const auto is_first = [&](const ContourPoint& point) { return point == points.front(); };
    if (std::ranges::all_of(points, is_first)) {
        resolution_.diagnostics
            .add(DiagnosticCode::BadContour, node.name_span, "all points of the contour are equal")
            .help.emplace_back("a point that stands twice is a corner; the next point differs");
        return std::nullopt;
    }
    return points;
}

void ContourResolver::contour(const CurveNode& node) {
    expressions_.begin_statement();
    std::optional<std::vector<ContourPoint>> points = read_points(node);
    const auto [first, is_new] = first_.try_emplace(node.name, node.name_span);
    if (!is_new) {
        report_duplicate(resolution_, node.name_span, first->second,
                         fmt::format("contour `{}`", resolution_.text(node.name)));
    } else if (points) {
        resolution_.program.contours.push_back({node.name, node.name_span, std::move(*points)});
    }
}

} // namespace lsys
