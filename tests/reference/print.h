// Text from the data of the oracle: a grammar as .lsys files in some legal layout, and a word as
// section 10 of the language reference writes it.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <string>
#include <vector>

namespace lsys::reference {

struct TextFile {
    std::string path;
    std::string text;
};

// The files of `grammar`. With `layout_seed` other than 0 the layout is random: blanks, line ends,
// comments, spellings of names and numbers, names run together; the meaning stays the same.
std::vector<TextFile> print_grammar(const Grammar& grammar, std::uint64_t layout_seed);

// `letters`: the word is that of a file with `#set names letters`.
std::string print_word(const Word& word, bool letters);

} // namespace lsys::reference
