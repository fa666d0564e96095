// The text form of a Program: `lsc dump --stage program`.
#pragma once

#include "compiler/program/program.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string dump_program(const Program& program, const Names& names);

} // namespace lsys
