#include "runtime/random.h"

#include <cmath>
#include <limits>

namespace lsys {

float DrawSource::draw(std::uint64_t number) {
    const std::uint64_t block = number / 4;
    if (block != block_) {
        words_ = draw_block(seed_, generation_, position_, static_cast<std::uint32_t>(block));
        block_ = block;
    }
    return unit_interval(words_[number % 4]);
}

float draw_in_range(float minimum, float maximum, float u) {
    const float width = maximum - minimum;
    const float offset = width * u;
    const float result = minimum + offset;
    if (result >= maximum && minimum < maximum) {
        return std::nextafter(maximum, -std::numeric_limits<float>::infinity());
    }
    return result;
}

} // namespace lsys
