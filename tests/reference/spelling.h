// SPDX-License-Identifier: MIT
// Spelling of the parts of a grammar: names, numbers, expressions, and joined names. The printer
// (print.h) puts blanks and comments between the tokens made here.

#pragma once

#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

// [A-Za-z_][A-Za-z0-9_]*
bool is_identifier(const std::string& name);

// One of the characters that are module names without back quotes.
bool is_symbol(const std::string& name);

// A decimal number that rounds to `value`: with `random` one of many, else the shortest.
// Precondition: value is finite and not negative.
std::string spell_number(float value, Random* random);

// Appends the tokens of `expr`, with the parentheses that precedence requires and, with `random`,
// some more.
void spell_expression(const Expr& expr, Random* random, std::vector<std::string>& tokens);

// Chooses the modules that are joined with the next one of their list, as `AS(1)` for `A S(1)`:
// only where section 3 of the language reference reads the name split in exactly that way. A name
// counts as a possible part if it occurs anywhere, so that the reading stays the same under every
// interpretation of "elsewhere in the file".
class JoinedNames {
public:
    JoinedNames(const Grammar& grammar, Random& random);

    // Whether module `index` of `list` (the axiom, a successor, a context or the names of an
    // #ignore, by its address) is printed without a blank before module index + 1.
    [[nodiscard]] bool joined(const void* list, std::size_t index) const;

    // Names that are printed alone but would be read split; empty for a correct grammar.
    [[nodiscard]] std::set<std::string> ambiguous_names() const;

private:
    struct Word {
        std::string name;
        std::size_t count = 0;
        bool has_parameters = false;
    };
    struct List {
        const void* address = nullptr;
        std::vector<Word> words;
        bool names_only = false; // of an #ignore
    };

    static std::vector<List> lists_of(const File& file);
    [[nodiscard]] std::size_t ways(const std::string& text) const;
    [[nodiscard]] bool is_safe(const std::string& text);
    void join(const List& list, std::set<std::string>& used, bool late, Random& random);
    bool
    join_at(const List& list, std::size_t first, std::size_t last, std::set<std::string>& used);

    std::set<std::string> known_;
    std::set<std::string> names_; // all names that occur
    std::set<std::string> texts_; // of joined names
    std::map<const void*, std::set<std::size_t>> joined_;
};

} // namespace lsys::reference
