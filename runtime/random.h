// Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3"),
// and the counters of LANGUAGE.md section 6. A draw is a pure function of seed, generation,
// position and its number, so results depend on no thread, chunk or order.
#pragma once

#include <array>
#include <cstdint>

namespace lsys {

using PhiloxBlock = std::array<std::uint32_t, 4>;

/// Ten rounds of Philox4x32.
[[nodiscard]] PhiloxBlock philox4x32(PhiloxBlock counter, std::array<std::uint32_t, 2> key);

/// Generation number of draws that happen once, when a derivation starts.
inline constexpr std::uint32_t kStartGeneration = 0xFFFFFFFFu;

/// The draws of one rewritten module.
class DrawSource {
public:
    DrawSource(std::uint64_t seed, std::uint32_t generation, std::uint64_t position)
        : seed_(seed), position_(position), generation_(generation) {}

    /// Draw `number` as u in [0, 1): word number mod 4 of block number / 4, its high 24 bits times
    /// 2^-24.
    [[nodiscard]] float draw(std::uint64_t number);

private:
    static constexpr std::uint64_t kNoBlock = ~std::uint64_t{0};

    std::uint64_t seed_;
    std::uint64_t position_;
    std::uint64_t block_ = kNoBlock; // the one in words_
    std::uint32_t generation_;
    PhiloxBlock words_{};
};

/// A random word as u in [0, 1): its high 24 bits times 2^-24.
[[nodiscard]] constexpr float unit_interval(std::uint32_t word) {
    return static_cast<float>(word >> 8) * 0x1p-24F;
}

/// `{minimum, maximum}` at u (LANGUAGE.md section 4). Precondition: minimum <= maximum, finite
/// width.
[[nodiscard]] float draw_in_range(float minimum, float maximum, float u);

} // namespace lsys
