// SPDX-License-Identifier: MIT
// The words of the language by kind, from the tables of the compiler: for files with which editors
// colour grammars (editors/syntax).
#pragma once

#include <string>
#include <vector>

namespace lsys {

struct LanguageWords {
    std::vector<std::string> statements; // after `#`, without labels of productions: "define"
    std::vector<std::string> functions;
    std::vector<std::string> settings;      // keys of `#set`
    std::vector<std::string> values;        // words that are values of settings
    std::vector<std::string> material_keys; // keys of `#material`
    std::vector<std::string> sense_keys;    // keys of `#sense`
    std::vector<std::string> sense_kinds;   // kinds of environments, and shapes
    std::vector<std::string> objects;       // names after `#object NAME`
    std::vector<std::string> commands;      // turtle commands of the default profile with letters
};

/// Each list is sorted and has no word twice.
[[nodiscard]] LanguageWords language_words();

} // namespace lsys
