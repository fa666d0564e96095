// SPDX-License-Identifier: MIT
#include "grammar/base/suggestions.h"

#include "grammar/base/diagnostic.h"

namespace lsys {

std::string Suggestions::nearest(std::string_view wanted,
                                 const std::vector<std::string_view>& candidates) {
    return claim(candidates.size()) ? std::string(nearest_name(wanted, candidates).value_or(""))
                                    : std::string();
}

} // namespace lsys
