// SPDX-License-Identifier: MIT
// Makes random legal expressions of section 4 of the language reference: constant parts are finite,
// no divisor is a constant zero, and the bounds of constant ranges are in order.

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

// The names and functions that an expression may use where it stands.
struct Scope {
    std::vector<std::string> formals;
    bool in_production = false;    // step() and steps() may be used
    std::size_t range_percent = 0; // percentage of arguments with a range
    bool drawn_constants = true;   // constants with a random value may be used
};

// The constants that the grammar has defined so far.
struct Constants {
    std::map<std::string, float> values; // a drawn constant has an arbitrary value here
    std::set<std::string> drawn;
    Functions functions; // their bodies use no drawn constants
};

class ExpressionMaker {
public:
    ExpressionMaker(Random& random, const Constants& constants)
        : random_(random), constants_(constants) {}

    Expr argument(const Scope& scope);  // an argument of a module
    Expr condition(const Scope& scope); // a condition, often about the formals
    Expr local(const Scope& scope);     // a local value, never a constant
    Expr any(const Scope& scope, int depth);
    Expr literal();

    // Whether the expression has the same value at every use: it has no formals and draws nothing.
    [[nodiscard]] bool is_constant(const Expr& expr, const Scope& scope) const;
    [[nodiscard]] float constant_value(const Expr& expr) const;

private:
    // Whether the expression calls a function of the grammar.
    [[nodiscard]] bool calls_user(const Expr& expr) const;
    Expr leaf(const Scope& scope);
    Expr double_rounding_literal();
    Expr range_of(const Scope& scope, int depth);
    Expr comparison(const Scope& scope);
    // Returns `expr` if it is legal, else a literal. Precondition: the parts of `expr` are legal.
    Expr legal(const Expr& expr, const Scope& scope);

    Random& random_;
    const Constants& constants_;
};

} // namespace lsys::reference
