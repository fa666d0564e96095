// SPDX-License-Identifier: MIT
#include "viewer/scene/forest_stream.h"

#include "viewer/scene/forest_square.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace lsys::view {

ForestStream::ForestStream(const SquareLayout& layout,
                           float tallest,
                           std::function<double(const Region& region)> expected_trees,
                           std::uint64_t max_bytes)
    : layout_(layout), tallest_(tallest), expected_trees_(std::move(expected_trees)),
      max_bytes_(max_bytes) {}

double ForestStream::expected_bytes(const SquareId& id) const {
    const Region region = layout_.region_of(id);
    const double trees = region.width > 0.0 && region.depth > 0.0 ? expected_trees_(region) : 0.0;
    return trees * static_cast<double>(kBytesPerStreamedTree) +
           static_cast<double>(layout_.cell_count() * kBytesPerStreamedCell);
}

WantedSquares
ForestStream::wanted(const Camera& camera, float ground, std::uint32_t picture_height) const {
    const glm::dvec3 eye = eye_of(camera);
    const double above = std::max(eye.y - static_cast<double>(ground), 0.0);
    const double pixels_per_slope = // pixels of height / (height / distance)
        0.5 * picture_height /
        std::tan(0.5 * glm::radians(static_cast<double>(camera.field_of_view)));
    const double reach =
        static_cast<double>(tallest_) * pixels_per_slope / static_cast<double>(kMinStreamedPixels);
    const double usable = kWantedPart * static_cast<double>(max_bytes_);
    // The search for squares ends at this distance, because a circle of this radius exceeds the
    // budget even if all its squares are empty.
    const double empty_bytes = static_cast<double>(layout_.cell_count() * kBytesPerStreamedCell);
    const double most = std::sqrt(usable / empty_bytes) * layout_.side;
    const double away = std::min(reach, std::hypot(most, above));
    WantedSquares wanted;
    wanted.range = static_cast<float>(reach);
    if (away <= above) {
        return wanted;
    }
    const double radius = std::sqrt(away * away - above * above);
    const SquareId low = layout_.square_at(eye.x - radius, eye.z - radius);
    const SquareId high = layout_.square_at(eye.x + radius, eye.z + radius);
    std::vector<std::tuple<double, SquareId>> near;
    for (std::int32_t row = low.row; row <= high.row; ++row) {
        for (std::int32_t column = low.column; column <= high.column; ++column) {
            const SquareId id{row, column};
            const Region region = layout_.region_of(id);
            if (!(region.width > 0.0 && region.depth > 0.0)) {
                continue;
            }
            const double x = eye.x - std::clamp(eye.x, region.x, region.x + region.width);
            const double z = eye.z - std::clamp(eye.z, region.z, region.z + region.depth);
            if (const double distance = std::sqrt(x * x + z * z + above * above); distance < away) {
                near.emplace_back(distance, id);
            }
        }
    }
    std::sort(near.begin(), near.end());
    wanted.range = static_cast<float>(away);
    double bytes = 0.0;
    for (const auto& [distance, id] : near) {
        bytes += expected_bytes(id);
        if (bytes > usable) {
            wanted.range = static_cast<float>(distance);
            break;
        }
        wanted.squares.push_back(id);
    }
    return wanted;
}

} // namespace lsys::view
