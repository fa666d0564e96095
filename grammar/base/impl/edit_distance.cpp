// SPDX-License-Identifier: MIT
#include "grammar/base/impl/edit_distance.h"

#include <algorithm>
#include <utility>

namespace lsys {

EditDistance::EditDistance(std::string_view wanted) : wanted_(wanted) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        places_[lower_case(wanted[i])] |= std::uint64_t{1} << i;
    }
}

std::size_t EditDistance::lower_bound(std::string_view name) const {
    // One column of the table of distances per letter of `name`, as bits: whether a cell is more or
    // less than its neighbour above (H. Hyyrö 2003, "A bit-vector algorithm for computing
    // Levenshtein and Damerau edit distances").
    const std::uint64_t last = std::uint64_t{1} << (wanted_.size() - 1);
    std::uint64_t more = ~std::uint64_t{0};
    std::uint64_t less = 0;
    std::uint64_t diagonal = 0; // the cell equals its neighbour above to the left
    std::uint64_t earlier_places = 0;
    std::size_t edits = wanted_.size();
    for (const char c : name) {
        const std::uint64_t places = places_[lower_case(c)];
        const std::uint64_t exchanged = ((~diagonal & places) << 1U) & earlier_places;
        diagonal = (((places & more) + more) ^ more) | places | less | exchanged;
        std::uint64_t right_more = less | ~(diagonal | more);
        std::uint64_t right_less = diagonal & more;
        edits += (right_more & last) != 0 ? 1U : 0U;
        edits -= (right_less & last) != 0 ? 1U : 0U;
        right_more = right_more << 1U | 1U;
        right_less <<= 1U;
        more = right_less | ~(diagonal | right_more);
        less = right_more & diagonal;
        earlier_places = places;
    }
    return 2 * edits;
}

std::size_t EditDistance::distance(std::string_view name) const {
    using Row = std::array<std::size_t, kMaxLength + 1>;
    Row before{};
    Row previous{};
    Row current{};
    for (std::size_t j = 0; j <= name.size(); ++j) {
        previous[j] = 2 * j;
    }
    for (std::size_t i = 1; i <= wanted_.size(); ++i) {
        const char letter = wanted_[i - 1];
        current[0] = 2 * i;
        for (std::size_t j = 1; j <= name.size(); ++j) {
            const std::size_t replace = letter == name[j - 1]                           ? 0U
                                        : lower_case(letter) == lower_case(name[j - 1]) ? 1U
                                                                                        : 2U;
            current[j] = std::min({previous[j] + 2, current[j - 1] + 2, previous[j - 1] + replace});
            if (i > 1 && j > 1 && letter == name[j - 2] && wanted_[i - 2] == name[j - 1]) {
                current[j] = std::min(current[j], before[j - 2] + 2);
            }
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[name.size()];
}

} // namespace lsys
