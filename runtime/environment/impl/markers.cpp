// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/markers.h"

#include "grammar/base/contract.h"
#include "runtime/base/random.h"

#include <algorithm>
#include <vector>

namespace lsys {

namespace {

/// Generation number of the draws of markers.
constexpr std::uint32_t kMarkerGeneration = 0xFFFFFFFDu;
constexpr std::uint32_t kCellBits = 5; // a grid has 32 cells along each axis

/// Moves bit i of five bits to bit 3 i.
std::uint32_t spread_bits(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x100F;
    bits = (bits | bits << 4) & 0x10C3;
    return (bits | bits << 2) & 0x1249;
}

/// Morton code of the grid cell of a marker: interleaves the bits of the three cell indexes.
std::uint32_t cell_of(const Marker& marker) {
    std::uint32_t cell = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::uint32_t>(
            marker.units[axis] * static_cast<float>(std::uint32_t{1} << kCellBits));
        cell |= spread_bits(index) << axis;
    }
    return cell;
}

} // namespace

MarkerShape::MarkerShape(const BytecodeEnvironment& declared,
                         const EnvironmentMesh* mesh,
                         const TriangleTree* crown)
    : shape_(declared.shape), crown_(crown) {
    LSYS_CHECK((shape_ == SpaceShape::Mesh) == (mesh != nullptr && crown != nullptr));
    Vector3 high{};
    if (mesh != nullptr) {
        low_ = mesh->vertices[mesh->triangles[0][0]];
        high = low_;
        for (const std::array<std::uint32_t, 3>& corners : mesh->triangles) {
            for (const std::uint32_t vertex : corners) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    low_[axis] = std::min(low_[axis], mesh->vertices[vertex][axis]);
                    high[axis] = std::max(high[axis], mesh->vertices[vertex][axis]);
                }
            }
        }
    } else {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<double>(declared.at[axis]);
            const auto size = static_cast<double>(declared.size[axis]);
            low_[axis] = axis == 1 ? at : at - 0.5 * size;
            high[axis] = axis == 1 ? at + size : at + 0.5 * size;
        }
    }
    extent_ = minus(high, low_);
}

bool MarkerShape::holds(const std::array<float, 3>& units) const {
    if (shape_ == SpaceShape::Box) {
        return true;
    }
    if (shape_ == SpaceShape::Mesh) {
        return crown_->is_inside(position(units));
    }
    const double x = 2.0 * static_cast<double>(units[0]) - 1.0;
    const double z = 2.0 * static_cast<double>(units[2]) - 1.0;
    auto y = static_cast<double>(units[1]);
    if (shape_ == SpaceShape::Cone) {
        return x * x + z * z <= (1.0 - y) * (1.0 - y);
    }
    if (shape_ == SpaceShape::Ball) {
        y = 2.0 * y - 1.0;
    }
    return (x * x + y * y) + z * z <= 1.0;
}

std::optional<LargeVector<Marker>> draw_markers(const MarkerShape& shape,
                                                std::uint32_t count,
                                                const MarkerKey& key,
                                                const EnvironmentContext& context) {
    constexpr std::uint32_t kPieceMarkers = 1U << 10; // markers per piece of work
    constexpr std::uint32_t kMissing = ~std::uint32_t{0};
    LargeVector<Marker> markers(count);
    const std::uint64_t pieces = (std::uint64_t{count} + kPieceMarkers - 1) / kPieceMarkers;
    context.workers->for_each(pieces, [&](std::uint64_t piece) {
        if (is_cancelled(context.cancelled)) {
            return;
        }
        const std::uint64_t end = std::min<std::uint64_t>(count, (piece + 1) * kPieceMarkers);
        for (std::uint64_t i = piece * kPieceMarkers; i < end; ++i) {
            markers[i].index = kMissing;
            for (std::uint64_t m = kMarkerTries * i; m < kMarkerTries * (i + 1); ++m) {
                const PhiloxBlock draws = draw_block(key.seed, kMarkerGeneration, m, key.number);
                const std::array<float, 3> units{unit_interval(draws[0]), unit_interval(draws[1]),
                                                 unit_interval(draws[2])};
                if (shape.holds(units)) {
                    markers[i] = {units, static_cast<std::uint32_t>(i)};
                    break;
                }
            }
        }
    });
    if (is_cancelled(context.cancelled)) {
        return std::nullopt;
    }
    markers.erase(std::remove_if(markers.begin(), markers.end(),
                                 [](const Marker& marker) { return marker.index == kMissing; }),
                  markers.end());
    return markers;
}

LargeVector<std::uint32_t> order_in_space(const LargeVector<Marker>& markers) {
    std::vector<std::uint32_t> next((std::size_t{1} << (3 * kCellBits)) + 1, 0);
    for (const Marker& marker : markers) {
        ++next[cell_of(marker) + 1];
    }
    for (std::size_t cell = 1; cell < next.size(); ++cell) {
        next[cell] += next[cell - 1];
    }
    LargeVector<std::uint32_t> order(markers.size());
    for (std::size_t i = 0; i < markers.size(); ++i) {
        order[next[cell_of(markers[i])]++] = static_cast<std::uint32_t>(i);
    }
    return order;
}

} // namespace lsys
