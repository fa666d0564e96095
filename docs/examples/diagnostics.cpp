// SPDX-License-Identifier: MIT
// Compiles a text from memory and lists its mistakes as data, as an editor would.
// Usage: diagnostics < FILE
#include <iostream>
#include <iterator>
#include <lsys/grammar.h>
#include <string>

int main() {
    const std::string text(std::istreambuf_iterator<char>(std::cin), {});
    const lsys::Outcome<lsys::Grammar> grammar = lsys::compile_text(text, "buffer.lsys");
    for (const lsys::Diagnostic& diagnostic : grammar.messages().all()) {
        if (diagnostic.place) {
            std::cout << diagnostic.place->line << ':' << diagnostic.place->column << '-'
                      << diagnostic.place->end_column << ' ';
        }
        std::cout << '[' << diagnostic.code << "] " << diagnostic.message << '\n';
        for (const lsys::Fix& fix : diagnostic.fixes) {
            std::cout << "  " << (fix.certain ? "repair: " : "perhaps: ") << fix.title << '\n';
        }
    }
    return grammar ? 0 : 1;
}
