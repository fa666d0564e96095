// SPDX-License-Identifier: MIT
#include "compiler/bytecode/impl/verify_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

std::optional<std::string> curves_problem(const Bytecode& bytecode) {
    for (std::size_t i = 0; i < bytecode.curves.size(); ++i) {
        const std::vector<CurveKnot>& points = bytecode.curves[i].points;
        if (points.size() < 2 || !is_printable(bytecode.curves[i].name)) {
            return fmt::format("curve {} has {} points", i, points.size());
        }
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (!std::isfinite(points[k].x) || !std::isfinite(points[k].y) ||
                (k > 0 && !(points[k - 1].x < points[k].x))) {
                return fmt::format("point {} of curve {} is out of place", k, i);
            }
        }
    }
    return std::nullopt;
}

std::optional<std::string> contours_problem(const Bytecode& bytecode) {
    for (std::size_t i = 0; i < bytecode.contours.size(); ++i) {
        const BytecodeContour& contour = bytecode.contours[i];
        if (contour.points.size() < kMinContourPoints ||
            contour.points.size() > kMaxContourPoints || contour.name.empty() ||
            !is_printable(contour.name)) {
            return fmt::format("contour {} has {} points", i, contour.points.size());
        }
        for (const ContourPoint& point : contour.points) {
            if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
                return fmt::format("a point of contour {} is not finite", i);
            }
        }
    }
    return std::nullopt;
}

std::optional<std::string> materials_problem(const Bytecode& bytecode) {
    const auto in_unit = [](float value) { return value >= 0.0F && value <= 1.0F; };
    const auto is_picture = [&](const BytecodePicture& picture) {
        return is_printable(picture.path) && is_site(bytecode, picture.site);
    };
    std::uint64_t next = 0;
    for (const BytecodeMaterial& material : bytecode.materials) {
        if (material.index < next || material.index > kMaxColourIndex) {
            return fmt::format("a material of colour index {} is out of place", material.index);
        }
        next = std::uint64_t{material.index} + 1;
        if (!std::all_of(material.colour.begin(), material.colour.end(), in_unit) ||
            !in_unit(material.roughness) || !in_unit(material.translucency)) {
            return fmt::format("a number of material {} is not from 0 to 1", material.index);
        }
        if (!is_picture(material.picture) || !is_picture(material.normal)) {
            return fmt::format("a picture of material {} has no place", material.index);
        }
    }
    return std::nullopt;
}

} // namespace lsys
