// SPDX-License-Identifier: MIT
// The start of a derivation: constants and axiom get their values in the order of the text (sections
// 4, 5.9 and 6.2 of the language reference).

#pragma once

#include "tests/reference/system.h"

namespace lsys::reference {

class Start {
public:
    // Fills `system`, except for the members that settings decide.
    Start(const Grammar& grammar, const Request& request, System& system);

    // "Draws of all axioms are numbered, only the chosen one is evaluated."
    [[nodiscard]] Word axiom();
    // Value of `#n`.
    [[nodiscard]] std::uint32_t generations() const { return generations_; }

private:
    struct Axiom {
        const Statement* statement = nullptr;
        std::uint64_t first_range = 0; // range_number_ before its first draw
    };

    void read(const Statement& statement); // executes a statement
    void read_sense(const Statement& statement);
    void read_production(const Production& production);
    void number_rules();
    [[nodiscard]] const Axiom& choose_axiom() const;
    std::size_t number_of(const std::string& rule); // a new number at its first use
    float value_of(const Statement& statement);     // of a #define or #param

    const Request& request_;
    System& system_;
    Environment environment_;        // names and random numbers of expressions (evaluate.h)
    std::uint64_t range_number_ = 0; // count of draws so far, by #define, #param and #w
    std::uint32_t generations_ = 0;
    std::map<Stage, std::vector<const Production*>> productions_; // in file order
    bool considers_ = false;                                      // a #consider has been read
    std::vector<Axiom> axioms_;                                   // in the order of the text
};

} // namespace lsys::reference
