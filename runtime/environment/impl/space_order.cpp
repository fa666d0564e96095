// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/space_order.h"

#include "runtime/environment/impl/frame.h"
#include "runtime/environment/impl/sorted_records.h"

#include <algorithm>
#include <atomic>

namespace lsys {

namespace {

constexpr std::uint32_t kCellBits = 11;  // per axis; so a key is sorted by three digits of 11 bits
constexpr std::size_t kPiece = 1U << 14; // places of one piece of work

static_assert(kSpaceOrderBytes == 2 * sizeof(SortRecord) + sizeof(std::uint32_t));

/// Moves bit i of 11 bits to bit 3 i.
std::uint64_t spread_bits(std::uint64_t bits) {
    bits = (bits | bits << 16) & 0x00FF0000FF;
    bits = (bits | bits << 8) & 0x0F00F00F00F;
    bits = (bits | bits << 4) & 0x0C30C30C30C3;
    return (bits | bits << 2) & 0x249249249249;
}

/// Number of the cell of `point` among 2^11 along each axis of the box.
std::uint64_t cell_of(const Vector3& point, const PointBox& box) {
    constexpr double kCells = std::uint32_t{1} << kCellBits;
    std::uint64_t cell = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // Halves, because the length of the box may be beyond binary64.
        const double extent = 0.5 * box.high[axis] - 0.5 * box.low[axis];
        const double part = extent > 0.0 ? (0.5 * point[axis] - 0.5 * box.low[axis]) / extent : 0.0;
        const auto index = static_cast<std::uint64_t>(std::clamp(part * kCells, 0.0, kCells - 1.0));
        cell |= spread_bits(index) << axis;
    }
    return cell;
}

} // namespace

LargeVector<std::uint32_t> order_in_space(std::span<const SensePlace> places,
                                          const EnvironmentContext& context) {
    static const std::atomic<bool> kNever{false};
    PointBox box;
    for (const SensePlace& place : places) {
        box.add(place.position);
    }
    SortRecords records(places.size());
    const auto for_each_piece = [&](const auto& work) {
        context.workers->for_each((places.size() + kPiece - 1) / kPiece, [&](std::uint64_t piece) {
            const std::size_t end = std::min<std::size_t>(places.size(), (piece + 1) * kPiece);
            for (std::size_t i = piece * kPiece; i < end; ++i) {
                work(i);
            }
        });
    };
    for_each_piece([&](std::size_t i) { records[i] = {0, cell_of(places[i].position, box), i}; });
    SortRecords scratch;
    static_cast<void>(sort_records(records, scratch, *context.workers,
                                   context.cancelled != nullptr ? *context.cancelled : kNever));
    LargeVector<std::uint32_t> order(places.size());
    for_each_piece([&](std::size_t i) { order[i] = static_cast<std::uint32_t>(records[i].item); });
    return order;
}

} // namespace lsys
