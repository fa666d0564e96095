// Workers: a team of threads for pieces of work, for folders that stand on the runtime.
#pragma once

#include "runtime/derive/workers.h" // IWYU pragma: export

#include <atomic>
#include <cstdint>
#include <new>

namespace lsys {

/// Workers::for_each() for pieces that may run out of memory: throws std::bad_alloc where one did,
/// once all are done.
template <typename Visit>
void for_each_piece(Workers& workers, std::uint64_t pieces, const Visit& visit) {
    std::atomic<bool> no_memory{false};
    workers.for_each(pieces, [&](std::uint64_t i) {
        try {
            visit(i);
        } catch (const std::bad_alloc&) {
            no_memory = true;
        }
    });
    if (no_memory) {
        throw std::bad_alloc();
    }
}

} // namespace lsys
