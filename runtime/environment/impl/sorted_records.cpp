// SPDX-License-Identifier: MIT
// Radix sort from the least significant digit (Knuth, The Art of Computer Programming, volume 3,
// section 5.2.5). Digits that are equal in all records are skipped.
#include "runtime/environment/impl/sorted_records.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kMaxDigitBits = 11; // 2,048 counters stay in the first-level cache
constexpr std::size_t kMinChunk = 1U << 14; // records
constexpr std::size_t kMaxChunks = 16;

using Counters = std::array<std::size_t, std::size_t{1} << kMaxDigitBits>;

/// A digit of the key.
struct Digit {
    bool is_high = false;    // whether the digit belongs to SortRecord::high
    std::uint32_t shift = 0; // lowest bit of the digit in its half
    std::uint32_t bits = 0;  // number of bits

    [[nodiscard]] std::size_t of(const SortRecord& record) const {
        const std::uint64_t half = is_high ? record.high : record.low;
        return (half >> shift) & ((std::uint64_t{1} << bits) - 1);
    }
};

/// Appends the digits of one half of the key, of which `varying` are the bits that differ.
void append_digits(bool is_high, std::uint64_t varying, std::vector<Digit>& digits) {
    if (varying == 0) {
        return;
    }
    const auto first = static_cast<std::uint32_t>(std::countr_zero(varying));
    const auto bits = static_cast<std::uint32_t>(std::bit_width(varying)) - first;
    const std::uint32_t count = (bits + kMaxDigitBits - 1) / kMaxDigitBits;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t from = bits * i / count;
        digits.push_back({is_high, first + from, bits * (i + 1) / count - from});
    }
}

class Sorter {
public:
    Sorter(std::size_t count, Workers& workers)
        : workers_(workers), count_(count),
          chunks_(std::clamp<std::size_t>(count / kMinChunk, 1, kMaxChunks)), counters_(chunks_) {}

    [[nodiscard]] std::vector<Digit> digits(const SortRecords& records) {
        std::vector<SortRecord> differences(chunks_);
        for_each_chunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
            SortRecord all;
            for (std::size_t i = begin; i < end; ++i) {
                all.high |= records[i].high ^ records[0].high;
                all.low |= records[i].low ^ records[0].low;
            }
            differences[chunk] = all;
        });
        SortRecord varying;
        for (const SortRecord& difference : differences) {
            varying.high |= difference.high;
            varying.low |= difference.low;
        }
        std::vector<Digit> digits;
        append_digits(false, varying.low, digits);
        append_digits(true, varying.high, digits);
        return digits;
    }

    void sort_by(const Digit& digit, const SortRecords& from, SortRecords& to) {
        for_each_chunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
            Counters& counters = counters_[chunk];
            counters.fill(0);
            for (std::size_t i = begin; i < end; ++i) {
                ++counters[digit.of(from[i])];
            }
        });
        std::size_t next = 0;
        for (std::size_t value = 0; value < std::size_t{1} << digit.bits; ++value) {
            for (Counters& counters : counters_) {
                const std::size_t count = counters[value];
                counters[value] = next;
                next += count;
            }
        }
        for_each_chunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
            Counters& counters = counters_[chunk];
            for (std::size_t i = begin; i < end; ++i) {
                to[counters[digit.of(from[i])]++] = from[i];
            }
        });
    }

private:
    template <typename Work>
    void for_each_chunk(const Work& work) {
        workers_.for_each(chunks_, [&](std::uint64_t chunk) {
            work(chunk, count_ * chunk / chunks_, count_ * (chunk + 1) / chunks_);
        });
    }

    Workers& workers_;
    std::size_t count_;              // records
    std::size_t chunks_;             // number of chunks
    std::vector<Counters> counters_; // by chunk
};

} // namespace

bool sort_records(SortRecords& records,
                  SortRecords& scratch,
                  Workers& workers,
                  const std::atomic<bool>& cancelled) {
    if (records.size() < 2) {
        return !cancelled;
    }
    scratch.resize(records.size());
    Sorter sorter(records.size(), workers);
    for (const Digit& digit : sorter.digits(records)) {
        if (cancelled) {
            return false;
        }
        sorter.sort_by(digit, records, scratch);
        records.swap(scratch);
    }
    return !cancelled;
}

} // namespace lsys
