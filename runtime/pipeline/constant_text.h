// SPDX-License-Identifier: MIT
// Texts that help to choose the value of a constant.
#pragma once

#include "runtime/pipeline/grammar.h"

#include <string>
#include <string_view>

namespace lsys {

/// The comment after the statement of a constant: the text after `//` on the line on which the
/// statement ends. Empty: none.
[[nodiscard]] std::string_view comment_of(const Constant& constant, const Grammar& grammar);

/// The comment after the statement of a constant, its value in the file and its range, in lines:
/// "part of the trunk without boughs", "0.4 in the file; from 0 to 1". `is_replaced`: the grammar
/// was compiled with another value than that of the file.
[[nodiscard]] std::string
describe_constant(const Constant& constant, const Grammar& grammar, bool is_replaced = false);

} // namespace lsys
