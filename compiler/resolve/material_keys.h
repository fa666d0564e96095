// SPDX-License-Identifier: MIT
// The keys of `#material`.
#pragma once

#include <string_view>
#include <vector>

namespace lsys {

/// All keys, in the order in which messages list them, without the synonym `color`.
[[nodiscard]] std::vector<std::string_view> material_keys();

} // namespace lsys
