// SPDX-License-Identifier: MIT
// Random legal expressions of section 4 of the language reference: constant parts are finite, no
// divisor is a constant zero, constant ranges have their bounds in order.

#pragma once

#include "tests/reference/evaluate.h"
#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

Expr number(float value);
Expr name(const std::string& text);
Expr unary(const std::string& text, Expr operand);
Expr binary(const std::string& text, Expr left, Expr right);
Expr call(const std::string& text, std::vector<Expr> arguments);
Expr range(Expr low, Expr high);

// Names and functions that an expression at a place may use.
struct Scope {
    std::vector<std::string> formals;
    bool in_production = false;    // step() and steps() are allowed
    std::size_t range_percent = 0; // percentage of arguments with a range
    bool drawn_constants = true;   // constants with a random value may be used
};

// The constants defined so far.
struct Constants {
    std::map<std::string, float> values; // drawn constants have an arbitrary value here
    std::set<std::string> drawn;
    Functions functions; // their bodies use no drawn constants
};

class ExpressionMaker {
public:
    ExpressionMaker(Random& random, const Constants& constants)
        : random_(random), constants_(constants) {}

    Expr argument(const Scope& scope);  // of a module
    Expr condition(const Scope& scope); // often about the formals
    Expr local(const Scope& scope);     // a local value, never a constant
    Expr any(const Scope& scope, int depth);
    Expr literal();

    // Whether the value is the same at every use: no formals, no draws.
    [[nodiscard]] bool is_constant(const Expr& expr, const Scope& scope) const;
    [[nodiscard]] float constant_value(const Expr& expr) const;

private:
    // Whether a function of the grammar is called.
    [[nodiscard]] bool calls_user(const Expr& expr) const;
    Expr leaf(const Scope& scope);
    Expr double_rounding_literal();
    Expr range_of(const Scope& scope, int depth);
    Expr comparison(const Scope& scope);
    // `expr` if it is legal, given that its parts are, else a literal.
    Expr legal(const Expr& expr, const Scope& scope);

    Random& random_;
    const Constants& constants_;
};

} // namespace lsys::reference
