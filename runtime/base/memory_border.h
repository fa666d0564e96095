// The border at which running out of memory becomes a value. Within a library std::bad_alloc and
// std::length_error may be thrown anywhere; its public functions that build large results catch
// both here and return a status instead (runtime/README.md, "Memory").
#pragma once

#include <new>
#include <stdexcept>

namespace lsys {

/// Returns work(), or no_memory() if work ran out of memory. What work had allocated is released
/// before no_memory() is called.
template <typename Work, typename NoMemory>
auto catch_no_memory(const Work& work, const NoMemory& no_memory) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return no_memory();
    } catch (const std::length_error&) { // thrown by strings and vectors that cannot be as long
        return no_memory();
    }
}

} // namespace lsys
