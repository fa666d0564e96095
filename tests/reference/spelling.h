// SPDX-License-Identifier: MIT
// Spells the parts of a grammar: names, numbers, expressions, and joined names. The printer
// (print.h) puts blanks and comments between these tokens.

#pragma once

#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

// Whether `name` has the form [A-Za-z_][A-Za-z0-9_]*.
bool is_identifier(const std::string& name);

// Whether `name` is one of the characters that are names of modules without back quotes.
bool is_symbol(const std::string& name);

// A decimal number that rounds to `value`: with `random` one of many spellings, else the shortest.
// Precondition: `value` is finite and not negative.
std::string spell_number(float value, Random* random);

// Appends the tokens of `expr`, with the parentheses that precedence requires; with `random` also
// some that it does not require.
void spell_expression(const Expr& expr, Random* random, std::vector<std::string>& tokens);

// Chooses the modules that are printed without a blank before the next module of their list, as
// `AS(1)` for `A S(1)`. A module is chosen only if section 3 of the language reference splits the
// joined name in exactly this way. A name counts as a possible part if it occurs anywhere in the
// grammar, so that the result is the same under every interpretation of "elsewhere in the file".
class JoinedNames {
public:
    JoinedNames(const Grammar& grammar, Random& random);

    // Whether module `index` of `list` is printed without a blank before module `index` + 1.
    // `list`: address of the axiom, a successor, a context, or the names of an #ignore.
    [[nodiscard]] bool joined(const void* list, std::size_t index) const;

    // Names that are printed with blanks around them but would be split; empty for a correct
    // grammar.
    [[nodiscard]] std::set<std::string> ambiguous_names() const;

private:
    struct Word {
        std::string name;
        std::size_t count = 0; // of parameters
        bool has_parameters = false;
    };
    struct List {
        const void* address = nullptr;
        std::vector<Word> words;
        bool names_only = false; // of an #ignore
    };

    // The lists of a file in which names can be joined.
    static std::vector<List> lists_of(const File& file);
    // Number of ways to split `text` into two or more names of the grammar.
    [[nodiscard]] std::size_t ways(const std::string& text) const;
    [[nodiscard]] bool is_safe(const std::string& text); // whether it may become a joined name
    // Joins random neighbours in a list. `late`: begins at the end of the list. `used`: names that
    // stand alone in the file, with their numbers of parameters.
    void join(const List& list, std::set<std::string>& used, bool late, Random& random);
    // Joins the words `first` to `last` of a list to one name, if this is safe; returns whether it
    // did.
    bool
    join_at(const List& list, std::size_t first, std::size_t last, std::set<std::string>& used);

    std::set<std::string> known_; // declared or rewritten names, and commands of the turtle
    std::set<std::string> names_; // all names in the grammar
    std::set<std::string> texts_; // texts of joined names
    // By list: indices of words joined to the next word.
    std::map<const void*, std::set<std::size_t>> joined_;
};

} // namespace lsys::reference
