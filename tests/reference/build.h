// SPDX-License-Identifier: MIT
// Short ways to write a grammar of reference/grammar.h in a test. letters(), letter_pattern() and
// letter_system() read texts as literature prints systems: every character except a blank is a
// module.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <string>
#include <vector>

namespace lsys::reference {

// The modules of a text such as "F[+F]F", without parameters.
std::vector<ModuleUse> letters(const std::string& text);
Pattern letter_pattern(const std::string& text);

// A system of single characters, from its axiom and its productions, such as "F=F+F" or
// "A<B>C[D]=E". A production has contexts if `<` or `>` comes before its `=`.
Grammar letter_system(const std::string& axiom, const std::vector<std::string>& productions);

void add_axiom(Grammar& grammar, const std::vector<ModuleUse>& modules);
void add_setting(Grammar& grammar, const std::string& key, const std::string& value);
void add_ignored(Grammar& grammar, const std::vector<std::string>& names);
void add_production(Grammar& grammar, Production production);

// The word after `generations`, as text without separators.
std::string text_after(const Grammar& grammar, std::uint32_t generations);

// The number of modules of each generation from 0 to `generations`.
std::vector<std::size_t> counts(const Grammar& grammar, std::uint32_t generations);

} // namespace lsys::reference
