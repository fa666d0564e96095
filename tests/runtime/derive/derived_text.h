// SPDX-License-Identifier: MIT
// Derives grammars that are given as text, by all methods of the runtime.
#pragma once

#include "tests/compiler/compile_text.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace lsys::test {

inline Bytecode compiled(const std::string& text) {
    Compiled c = compile_text(text);
    CAPTURE(text, c.reports());
    REQUIRE(c.outcome.bytecode);
    return std::move(*c.outcome.bytecode);
}

inline std::string word_of(const std::string& text, std::uint32_t generations) {
    return derived_every_way(compiled(text), generations, 7);
}

} // namespace lsys::test
