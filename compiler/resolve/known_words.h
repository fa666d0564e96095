// SPDX-License-Identifier: MIT
// The words that resolve() knows, for hints, completion and syntax files of editors.
#pragma once

#include <string_view>
#include <vector>

namespace lsys {

/// The functions of the language.
[[nodiscard]] std::vector<std::string_view> function_names();
/// The keys of `#material`, in the order in which messages list them, without the synonym `color`.
[[nodiscard]] std::vector<std::string_view> material_keys();
/// The keys of `#sense`, of all kinds.
[[nodiscard]] std::vector<std::string_view> sense_keys();

} // namespace lsys
