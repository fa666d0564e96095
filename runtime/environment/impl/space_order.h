// SPDX-License-Identifier: MIT
// The order of places along a space-filling curve: work on neighbours, one after the other, meets
// the same nodes of a tree.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/environment/environment.h"

#include <cstdint>
#include <span>

namespace lsys {

/// Indexes of the places by cells of a grid in Morton order (Morton 1966). Precondition: all
/// positions are finite. When cancelled, the order is arbitrary but still has all places.
[[nodiscard]] LargeVector<std::uint32_t> order_in_space(std::span<const SensePlace> places,
                                                        const EnvironmentContext& context);

/// Bytes per place of the result and of its construction.
inline constexpr std::uint64_t kSpaceOrderBytes = 52;

} // namespace lsys
