// SPDX-License-Identifier: MIT
// The text form of a Program: `lsc dump --stage program`.
#pragma once

#include "compiler/program/program.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string dump_program(const Program& program, const Names& names);
/// dump_program() without the names of productions, which do not affect words: two programs with
/// equal dumps derive the same words.
[[nodiscard]] std::string dump_without_labels(const Program& program, const Names& names);

} // namespace lsys
