// SPDX-License-Identifier: MIT
// Hash functions, none of them for security. Their constants are part of files, pictures and
// printed numbers and must not change: checksums of .lsb and state files (combine, combine_bytes,
// finish), bark and leaf textures, positions of trees, ground noise, digests of forests and
// pictures.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace lsys {

/// 2^64 divided by the golden ratio, rounded to an odd number, and a prime near 2^32 divided by the
/// golden ratio. Their products with consecutive numbers are spread evenly (Knuth, The Art of
/// Computer Programming 3, 6.4).
inline constexpr std::uint64_t kGoldenRatio64 = 0x9E3779B97F4A7C15;
inline constexpr std::uint32_t kGoldenRatio32 = 0x9E3779B1;

/// Fibonacci hashing: the upper bits depend on all bits of the number.
[[nodiscard]] constexpr std::uint64_t golden_multiple(std::uint64_t number) {
    return number * kGoldenRatio64;
}
[[nodiscard]] constexpr std::uint32_t golden_multiple(std::uint32_t number) {
    return number * kGoldenRatio32;
}

/// The step of most finalizers; a bijection for an odd factor.
template <typename T>
[[nodiscard]] constexpr T xorshift_multiply(T bits, unsigned shift, T factor) {
    return (bits ^ bits >> shift) * factor;
}

/// The finalizer of MurmurHash3: every bit of the result depends on every bit of the number.
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t bits) {
    bits = xorshift_multiply<std::uint64_t>(bits, 33, 0xFF51AFD7ED558CCD);
    bits = xorshift_multiply<std::uint64_t>(bits, 33, 0xC4CEB9FE1A85EC53);
    return bits ^ bits >> 33;
}

/// Adds 64 bits, `word`, to a hash: a bijection of the state for a given word, and of the word for
/// a given state. Sequences that differ in one word never collide.
[[nodiscard]] constexpr std::uint64_t combine(std::uint64_t state, std::uint64_t word) {
    state = golden_multiple(state ^ word);
    return state ^ state >> 29;
}
/// Adds the number of bytes, then the bytes as little-endian words of eight.
[[nodiscard]] inline std::uint64_t combine_bytes(std::uint64_t state, std::string_view bytes) {
    const auto word_of = [](const char* at, std::size_t count) {
        std::uint64_t word = 0;
        if constexpr (std::endian::native == std::endian::little) {
            std::memcpy(&word, at, count);
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                word |= std::uint64_t{static_cast<unsigned char>(at[i])} << (8 * i);
            }
        }
        return word;
    };
    state = combine(state, bytes.size());
    for (; bytes.size() >= sizeof(std::uint64_t); bytes.remove_prefix(sizeof(std::uint64_t))) {
        state = combine(state, word_of(bytes.data(), sizeof(std::uint64_t)));
    }
    return bytes.empty() ? state : combine(state, word_of(bytes.data(), bytes.size()));
}
/// Adds numbers, truth values and enumerators, of up to 64 bits each; floating-point numbers by
/// their bits.
template <typename... Numbers>
[[nodiscard]] constexpr std::uint64_t combine_numbers(std::uint64_t state, Numbers... numbers) {
    const auto bits_of = [](auto number) {
        if constexpr (std::is_same_v<decltype(number), float>) {
            return std::uint64_t{std::bit_cast<std::uint32_t>(number)};
        } else if constexpr (std::is_same_v<decltype(number), double>) {
            return std::bit_cast<std::uint64_t>(number);
        } else {
            return static_cast<std::uint64_t>(number);
        }
    };
    ((state = combine(state, bits_of(numbers))), ...);
    return state;
}
/// Spreads the last combined words over all bits.
[[nodiscard]] constexpr std::uint64_t finish(std::uint64_t state) {
    state = golden_multiple(state ^ state >> 32);
    return state ^ state >> 32;
}

/// FNV-1a.
template <typename Bytes>
[[nodiscard]] constexpr std::uint64_t fnv1a(const Bytes& bytes) {
    std::uint64_t hash = 0xCBF29CE484222325;
    for (const auto byte : bytes) {
        static_assert(sizeof byte == 1);
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3;
    }
    return hash;
}

/// lowbias32 (Wellons, https://nullprogram.com/blog/2018/07/31/).
[[nodiscard]] constexpr std::uint32_t lowbias32(std::uint32_t bits) {
    bits = xorshift_multiply(bits, 16, 0x7FEB352DU);
    bits = xorshift_multiply(bits, 15, 0x846CA68BU);
    return bits ^ bits >> 16;
}
/// Last step of lattice32(), from the combined coordinates.
[[nodiscard]] constexpr std::uint32_t mix_lattice(std::uint32_t coordinates) {
    coordinates = xorshift_multiply(coordinates, 15, 0x2C1B3C6DU);
    coordinates = xorshift_multiply(coordinates, 12, 0x297A2D39U);
    return coordinates ^ coordinates >> 15;
}
/// Hash of a lattice point; with `layer`, of a point in one of many lattices.
[[nodiscard]] constexpr std::uint32_t lattice32(std::uint32_t x, std::uint32_t y) {
    return mix_lattice(golden_multiple(x) ^ y * 0x85EBCA77U);
}
[[nodiscard]] constexpr std::uint32_t
lattice32(std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
    return mix_lattice(golden_multiple(x) ^ y * 0x85EBCA77U ^ (layer + 1) * 0xC2B2AE3DU);
}

/// The upper 24 bits as a number in [0, 1).
[[nodiscard]] constexpr float unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) / 16777216.0F;
}

} // namespace lsys
