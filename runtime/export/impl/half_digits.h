// HalfDigits: half floats (IEEE 754, binary16) as text with as few digits as read back as the same
// half float, for arrays whose type has no more digits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// The half float nearest to a value of 0 to 1, of two the one with an even last bit, as its bits.
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
        std::uint8_t count = 0;
    };
    std::vector<Text> texts_; // by the bits of 0 to 1
};

} // namespace lsys
