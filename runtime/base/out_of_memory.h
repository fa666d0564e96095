// SPDX-License-Identifier: MIT
// Conversion of exceptions for missing memory into a value. Within a library std::bad_alloc and
// std::length_error may be thrown anywhere; the public functions of the library that build large
// results catch the two exceptions by catch_out_of_memory() and return a status instead
// (runtime/README.md, "Memory").
#pragma once

#include <new>
#include <stdexcept>

namespace lsys {

/// Returns work(), or out_of_memory() if work ran out of memory; allocations of work are released
/// before out_of_memory() is called.
template <typename Work, typename OutOfMemory>
auto catch_out_of_memory(const Work& work, const OutOfMemory& out_of_memory) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return out_of_memory();
    } catch (const std::length_error&) { // thrown by strings and vectors above max_size()
        return out_of_memory();
    }
}

} // namespace lsys
