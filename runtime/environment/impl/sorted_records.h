// SPDX-License-Identifier: MIT
// Sorted records: places in the order of their voxels. A key has 128 bits, because three indexes of
// voxels have 33 bits each.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/base/workers.h"

#include <atomic>
#include <cstdint>

namespace lsys {

/// A key and the item that has it.
struct SortRecord {
    std::uint64_t high = 0; // more significant half of the key
    std::uint64_t low = 0;
    std::uint64_t item = 0;
};
using SortRecords = LargeVector<SortRecord>;

/// Sorts by the key; records with equal keys keep their order. `scratch` is resized to
/// records.size(). Returns false if it was cancelled; the order is then undefined.
[[nodiscard]] bool sort_records(SortRecords& records,
                                SortRecords& scratch,
                                Workers& workers,
                                const std::atomic<bool>& cancelled);

} // namespace lsys
