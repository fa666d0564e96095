// SPDX-License-Identifier: MIT
// Memory of the system: reserved pages, huge pages, and the memory of the machine and of the
// process.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lsys::platform {

/// Whether reserved pages take memory only when they are written.
#if defined(__EMSCRIPTEN__)
inline constexpr bool kReservesPages = false;
#else
inline constexpr bool kReservesPages = true;
#endif

inline constexpr std::size_t kPage = 4096;                     // bytes
inline constexpr std::size_t kHugePage = std::size_t{2} << 20; // bytes

/// Reserves `bytes` at an address that is a multiple of `alignment`, kPage or kHugePage. The bytes
/// are zero, and usable once committed. Returns null if the system refuses. Precondition: `bytes`
/// is a multiple of `alignment`.
[[nodiscard]] std::byte* reserve_memory(std::size_t bytes, std::size_t alignment);
/// Makes reserved bytes usable; committing bytes again has no effect. Returns false if the system
/// has no memory.
[[nodiscard]] bool commit_memory(std::byte* address, std::size_t bytes);
/// Returns memory of reserve_memory(), with the same `bytes`, to the system.
void release_memory(std::byte* address, std::size_t bytes) noexcept;

/// Requests huge pages for the whole huge pages within `bytes` from `address` on: fresh memory on
/// them is two to five times as fast to write as on small pages. If the system refuses, the memory
/// is only slower. Precondition: `address` is a multiple of kHugePage.
void advise_huge_pages(void* address, std::size_t bytes);

/// Allocates memory for the pages now, if the system can. Otherwise the first write to each page
/// causes a page fault, which allocates its memory. Precondition: `address` and `bytes` are
/// multiples of kPage.
void populate_pages(void* address, std::size_t bytes);

/// Lets the allocator keep up to 128 MiB of freed memory, and serve blocks of up to 32 MiB from it.
/// Otherwise work that allocates the same memory again and again, such as each picture of a
/// software renderer, would return this memory to the system, and cause page faults, each time. No
/// effect where the allocator has no such settings.
void keep_freed_memory();

/// Memory of the machine in bytes; 2^64 - 1 if unknown.
[[nodiscard]] std::uint64_t physical_memory();
/// Peak memory of this process so far, in bytes; 0 if unknown.
[[nodiscard]] std::uint64_t peak_memory();

} // namespace lsys::platform
