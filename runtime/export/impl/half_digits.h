// SPDX-License-Identifier: MIT
// HalfDigits: half floats (IEEE 754, binary16) as text with the fewest digits that read back as the
// same half float, for arrays of half floats in text formats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// The bits of the half float nearest to a value of 0 to 1; a tie goes to the even last bit.
[[nodiscard]] std::uint16_t half_bits(float value);
/// Precondition: bits of a finite positive half float or 0.
[[nodiscard]] float half_value(std::uint16_t bits);

class HalfDigits {
public:
    static constexpr std::size_t kMaxBytes = 11; // "-5.9605e-08"

    HalfDigits();
    /// Writes a value of -1 to 1; returns the end.
    [[nodiscard]] char* put(char* at, float value) const;

private:
    struct Text {
        std::array<char, 10> digits{};
        std::uint8_t count = 0; // of characters
    };
    std::vector<Text> texts_; // by the bits of 0 to 1
};

} // namespace lsys
