// SPDX-License-Identifier: MIT
// The environment of kind `program` of these tests, answering_program.cpp.

#pragma once

#include "tests/reference/environments/place.h"

#include <cstdint>

namespace lsys::reference {

// Up to four numbers for each place, computed from all data of a query.
Answers program_answers(std::uint32_t generation, const std::vector<Place>& places);

} // namespace lsys::reference
