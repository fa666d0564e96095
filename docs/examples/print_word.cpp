// SPDX-License-Identifier: MIT
// Compiles a grammar and prints its word. Usage: print_word FILE [GENERATIONS]
#include <cstdlib>
#include <iostream>
#include <lsys/word.h>

int main(int count, char** arguments) {
    if (count < 2) {
        std::cerr << "usage: print_word FILE [GENERATIONS]\n";
        return 2;
    }
    const lsys::Outcome<lsys::Grammar> grammar = lsys::compile_file(arguments[1]);
    std::cerr << grammar.messages().text();
    if (!grammar) {
        return 1;
    }
    lsys::DeriveOptions options;
    if (count > 2) {
        options.generations = static_cast<std::uint32_t>(std::atoi(arguments[2]));
    }
    const lsys::Outcome<lsys::Word> word = lsys::derive(*grammar, options);
    std::cerr << word.messages().text();
    if (!word) {
        return 1;
    }
    word->write_text([](std::string_view piece) { return bool(std::cout << piece); });
    std::cout << '\n';
}
