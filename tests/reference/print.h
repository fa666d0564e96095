// SPDX-License-Identifier: MIT
// Text from the data of the oracle: a grammar as .lsys files in any legal layout, and a word in the
// form of section 10 of the language reference.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <string>
#include <vector>

namespace lsys::reference {

// The line and column at which a module of the axiom or of a successor begins, counted from 1;
// columns in code points.
struct WrittenModule {
    const ModuleUse* module = nullptr; // in the grammar
    std::size_t line = 0;
    std::size_t column = 0;
};

struct TextFile {
    std::string path;
    std::string shown; // path in messages of `lsc`, relative to the file that includes it
    std::string text;
    std::vector<WrittenModule> modules; // in the order of the text
};

// The files of `grammar`. With `layout_seed` other than 0 the layout is random: blanks, line ends,
// comments, spellings of names and numbers, names run together; the meaning stays the same.
std::vector<TextFile> print_grammar(const Grammar& grammar, std::uint64_t layout_seed);

// `letters`: the word is that of a file with `#set names letters`.
std::string print_word(const Word& word, bool letters);

} // namespace lsys::reference
