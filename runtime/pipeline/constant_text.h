// SPDX-License-Identifier: MIT
// Texts that help to choose the value of a constant.
#pragma once

#include "runtime/pipeline/grammar.h"

#include <string>

namespace lsys {

/// The comment after the statement of a constant, its value in the file and its range, in lines:
/// "part of the trunk without boughs", "0.4 in the file; from 0 to 1". The comment must begin with
/// `//` on the line on which the statement ends. `is_replaced`: the grammar was compiled with another
/// value than that of the file.
[[nodiscard]] std::string
describe_constant(const Constant& constant, const Grammar& grammar, bool is_replaced = false);

} // namespace lsys
