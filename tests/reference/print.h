// SPDX-License-Identifier: MIT
// Prints data of the oracle: a grammar as .lsys files in any legal layout, and a word in the form
// that section 10 of the language reference defines.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <string>
#include <vector>

namespace lsys::reference {

// Line and column, counted from 1, at which a module of the axiom or of a successor begins in the
// text. Columns are counted in code points.
struct WrittenModule {
    const ModuleUse* module = nullptr; // in the grammar
    std::size_t line = 0;
    std::size_t column = 0;
};

struct TextFile {
    std::string path;
    std::string shown; // path in messages of `lsc`, relative to the file that includes it
    std::string text;
    std::vector<WrittenModule> modules; // in the order in which the text has them
};

// The files of `grammar`. With a `layout_seed` other than 0, the layout is random: blanks, line
// ends, comments, spellings of names and numbers, and names that are joined. The meaning of the
// grammar is the same in all layouts.
std::vector<TextFile> print_grammar(const Grammar& grammar, std::uint64_t layout_seed);

// `letters`: the grammar has `#set names letters`.
std::string print_word(const Word& word, bool letters);

} // namespace lsys::reference
