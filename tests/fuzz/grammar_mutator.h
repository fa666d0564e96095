// SPDX-License-Identifier: MIT
// Structure-aware changes of .lsys texts, after which most texts still compile: tokens and whole
// statements are replaced, moved, repeated and taken from other texts or from random grammars of
// tests/reference. libFuzzer calls the mutators of grammar_mutator.cpp in targets that link it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// `text` with one to four changes that depend on `seed` alone.
[[nodiscard]] std::string changed_grammar(std::string_view text, std::uint64_t seed);

/// `text` with statements of `other` inserted or in place of its own.
[[nodiscard]] std::string
crossed_grammars(std::string_view text, std::string_view other, std::uint64_t seed);
