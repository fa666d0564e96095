// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/active_mask.h"

#include "runtime/derive/engine/instantiate.h"

#include <algorithm>
#include <array>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace lsys {

namespace {

/// Programs with more codes are rewritten without a mask.
constexpr Code kMaxCodes = 4096;
constexpr std::size_t kBankCodes = 16;

/// Scalar version of mask_blocks_avx2() for any code width and machine.
template <typename C>
ActiveBits mask_block(const ActiveMask::Tables& tables,
                      const C* codes,
                      std::uint64_t length,
                      std::uint64_t first,
                      std::size_t count) {
    ActiveBits bits;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t index = first + i;
        const std::uint8_t centre = tables.centre[codes[index]];
        std::uint8_t groups = centre & static_cast<std::uint8_t>(~ActiveMask::kStores);
        if (tables.looks_left) {
            groups &= index == 0 ? tables.at_begin : tables.left[codes[index - 1]];
        }
        if (tables.looks_right) {
            groups &= index + 1 == length ? tables.at_end : tables.right[codes[index + 1]];
        }
        bits.active |= std::uint64_t{groups != 0} << i;
        bits.stores |= std::uint64_t{(centre & ActiveMask::kStores) != 0} << i;
    }
    return bits;
}

#if defined(__x86_64__)
#define LSYS_MASK_AVX2 1

/// Looks up 32 codes in a table of `banks` banks, each of 16 bytes.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i
look_up(const std::uint8_t* table, std::size_t banks, __m256i codes) {
    const auto bank = [table](std::size_t i) __attribute__((target("avx2"), always_inline)) {
        return _mm256_broadcastsi128_si256(
            _mm_loadu_si128(reinterpret_cast<const __m128i*>(table + kBankCodes * i)));
    };
    if (banks == 1) {
        return _mm256_shuffle_epi8(bank(0), codes);
    }
    // Sets the high bit of codes of other banks, for which the shuffle then yields 0.
    const __m256i spread = _mm256_set1_epi8(0x70);
    __m256i found = _mm256_setzero_si256();
    for (std::size_t i = 0; i < banks; ++i) {
        const __m256i base = _mm256_set1_epi8(static_cast<char>(kBankCodes * i));
        const __m256i within = _mm256_adds_epu8(_mm256_xor_si256(codes, base), spread);
        found = _mm256_or_si256(found, _mm256_shuffle_epi8(bank(i), within));
    }
    return found;
}

[[gnu::target("avx2"), gnu::always_inline]] inline __m256i load(const std::uint8_t* at) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
}

/// Masks `blocks` times 64 modules whose neighbours may be read. Tables hold 16 bytes per bank.
[[gnu::target("avx2,popcnt")]] std::uint64_t mask_blocks_avx2(const ActiveMask::Tables& tables,
                                                              const std::uint8_t* codes,
                                                              std::size_t blocks,
                                                              ActiveBits* bits) {
    std::uint64_t count = 0;
    const __m256i no_store = _mm256_set1_epi8(0x7F);
    for (std::size_t block = 0; block < blocks; ++block) {
        ActiveBits found;
        for (std::size_t half = 0; half < 2; ++half) {
            const std::uint8_t* const at = codes + ActiveMask::kBlock * block + 32 * half;
            const __m256i centre = look_up(tables.centre.data(), tables.banks, load(at));
            __m256i groups = _mm256_and_si256(centre, no_store);
            if (tables.looks_left) {
                groups = _mm256_and_si256(groups,
                                          look_up(tables.left.data(), tables.banks, load(at - 1)));
            }
            if (tables.looks_right) {
                groups = _mm256_and_si256(groups,
                                          look_up(tables.right.data(), tables.banks, load(at + 1)));
            }
            const __m256i none = _mm256_cmpeq_epi8(groups, _mm256_setzero_si256());
            const auto active = ~static_cast<std::uint32_t>(_mm256_movemask_epi8(none));
            const auto stores = static_cast<std::uint32_t>(_mm256_movemask_epi8(centre));
            found.active |= std::uint64_t{active} << (32 * half);
            found.stores |= std::uint64_t{stores} << (32 * half);
        }
        bits[block] = found;
        count += static_cast<std::uint64_t>(_mm_popcnt_u64(found.active));
    }
    return count;
}

const bool has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("popcnt") != 0;
#endif

} // namespace

void ActiveMask::prepare(const Plan& plan, const ContextTables* contexts) {
    const Code codes = plan.bytecode().code_count();
    usable_ = codes <= kMaxCodes && plan.predecessor_count() == 1;
    if (!usable_) {
        return;
    }
    rows_ = plan.rows().data();
    has_choices_ = false;
    tables_.banks = (std::size_t{codes} + kBankCodes - 1) / kBankCodes;
    const std::size_t size = tables_.banks * kBankCodes;
    tables_.centre.assign(size, 0);
    tables_.left.assign(size, kAnyNeighbours);
    tables_.right.assign(size, kAnyNeighbours);
    tables_.at_begin = kAnyNeighbours;
    tables_.at_end = kAnyNeighbours;
    tables_.looks_left = false;
    tables_.looks_right = false;

    // Rows with the same pair of guards form a group. There are at most six groups; the remaining
    // rows accept any neighbours.
    std::array<std::pair<std::uint32_t, std::uint32_t>, 6> groups;
    std::size_t group_count = 0;
    const auto group_of = [&](const Row& row) -> std::uint8_t {
        if (row.kind != RowKind::General || contexts == nullptr ||
            (row.left_guard == kNone && row.right_guard == kNone)) {
            return kAnyNeighbours;
        }
        const std::pair guards{row.left_guard, row.right_guard};
        const auto end = groups.begin() + group_count;
        auto at = std::find(groups.begin(), end, guards);
        if (at == end) {
            if (group_count == groups.size()) {
                return kAnyNeighbours;
            }
            *at = guards;
            ++group_count;
        }
        return static_cast<std::uint8_t>(kAnyNeighbours << 1 << (at - groups.begin()));
    };
    std::uint32_t same = 0; // parameters of each module that has any; kNone: not all the same
    for (Code code = 0; code < codes; ++code) {
        const Row& row = plan.row(code);
        if (row.stored != 0) {
            same = same == 0 || same == row.stored ? row.stored : kNone;
        }
        has_choices_ = has_choices_ || row.kind == RowKind::Choice;
        std::uint8_t& centre = tables_.centre[code];
        centre = row.kind == RowKind::Fixed && row.copies ? 0 : group_of(row);
        centre |= row.stored != 0 ? kStores : 0;
    }
    stored_each_ = same == kNone ? 0 : same == 0 ? 1 : same;
    for (std::size_t i = 0; i < group_count; ++i) {
        const auto [left, right] = groups[i];
        const auto bit = static_cast<std::uint8_t>(kAnyNeighbours << 1 << i);
        const bool is_ring = plan.bytecode().settings.word_shape == WordShape::Ring;
        tables_.at_begin |= left == kNone || is_ring ? bit : 0;
        tables_.at_end |= right == kNone || is_ring ? bit : 0;
        tables_.looks_left = tables_.looks_left || left != kNone;
        tables_.looks_right = tables_.looks_right || right != kNone;
        for (Code code = 0; code < codes; ++code) {
            // A context search skips brackets and ignored modules, so these may hide any neighbour.
            const bool is_skipped = contexts->role(code) != ContextRole::Module;
            const std::uint8_t* const guards = plan.guards();
            if (left == kNone || is_skipped || guards[left + code] != 0) {
                tables_.left[code] |= bit;
            }
            if (right == kNone || is_skipped || guards[right + code] != 0) {
                tables_.right[code] |= bit;
            }
        }
    }
}

template <typename C>
std::uint64_t ActiveMask::fill(const C* codes,
                               std::uint64_t length,
                               std::uint64_t first,
                               std::size_t count,
                               ActiveBits* bits) const {
    std::uint64_t active = 0;
    std::size_t done = 0;
#if defined(LSYS_MASK_AVX2)
    if constexpr (sizeof(C) == 1) {
        if (has_avx2) {
            if (first == 0 && tables_.looks_left) {
                done = std::min(count, kBlock);
                bits[0] = mask_block(tables_, codes, length, 0, done);
                active += count_bits(bits[0].active);
            }
            // The last module of a word has no right neighbour; mask_block() handles its block.
            const std::uint64_t last = std::min<std::uint64_t>(first + count, length - 1);
            if (done == 0 || done == kBlock) {
                const std::size_t blocks = last > first + done ? (last - first - done) / kBlock : 0;
                active +=
                    mask_blocks_avx2(tables_, codes + first + done, blocks, bits + done / kBlock);
                done += blocks * kBlock;
            }
        }
    }
#endif
    while (done < count) {
        const std::size_t size = std::min(count - done, kBlock);
        ActiveBits& block = bits[done / kBlock];
        block = mask_block(tables_, codes, length, first + done, size);
        active += count_bits(block.active);
        done += size;
    }
    return active;
}

#define LSYS_FILL_MASK(C)                                                                          \
    template std::uint64_t ActiveMask::fill<C>(const C*, std::uint64_t, std::uint64_t,             \
                                               std::size_t, ActiveBits*) const;
LSYS_FOR_CODES(LSYS_FILL_MASK)
#undef LSYS_FILL_MASK

} // namespace lsys
