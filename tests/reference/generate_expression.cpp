// SPDX-License-Identifier: MIT
#include "tests/reference/generate_expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

namespace lsys::reference {

Expr number(float value) {
    if (std::signbit(value)) {
        return unary("-", number(-value));
    }
    return {ExprKind::Number, value, "", {}};
}

Expr name(const std::string& text) {
    return {ExprKind::Name, 0, text, {}};
}

Expr unary(const std::string& text, Expr operand) {
    return {ExprKind::Unary, 0, text, {std::move(operand)}};
}

Expr binary(const std::string& text, Expr left, Expr right) {
    return {ExprKind::Binary, 0, text, {std::move(left), std::move(right)}};
}

Expr call(const std::string& text, std::vector<Expr> arguments) {
    return {ExprKind::Call, 0, text, std::move(arguments)};
}

Expr range(Expr low, Expr high) {
    return {ExprKind::Range, 0, "", {std::move(low), std::move(high)}};
}

bool ExpressionMaker::is_constant(const Expr& expr, const Scope& scope) const {
    if (draws(expr) ||
        (expr.kind == ExprKind::Call && (expr.text == "step" || expr.text == "steps"))) {
        return false;
    }
    if (expr.kind == ExprKind::Name) {
        const bool formal =
            std::find(scope.formals.begin(), scope.formals.end(), expr.text) != scope.formals.end();
        return !formal && constants_.drawn.count(expr.text) == 0;
    }
    return std::all_of(expr.parts.begin(), expr.parts.end(),
                       [&](const Expr& part) { return is_constant(part, scope); });
}

bool ExpressionMaker::calls_user(const Expr& expr) const {
    return (expr.kind == ExprKind::Call && constants_.functions.count(expr.text) != 0) ||
           std::any_of(expr.parts.begin(), expr.parts.end(),
                       [&](const Expr& part) { return calls_user(part); });
}

float ExpressionMaker::constant_value(const Expr& expr) const {
    Environment environment;
    environment.constants = &constants_.values;
    environment.functions = &constants_.functions;
    return evaluate(expr, environment);
}

Expr ExpressionMaker::legal(const Expr& expr, const Scope& scope) {
    const bool divides = expr.text == "/" || expr.text == "mod";
    if (divides && is_constant(expr.parts[1], scope) && constant_value(expr.parts[1]) == 0) {
        return literal();
    }
    // A call of a function that does not use its parameters is a constant for the compiler, so that
    // bounds with such a call could be illegal.
    const bool is_clear = std::none_of(expr.parts.begin(), expr.parts.end(),
                                       [&](const Expr& part) { return calls_user(part); });
    if (draws(expr) && !is_clear) {
        return literal();
    }
    if (expr.kind == ExprKind::Range) {
        if (!is_constant(expr.parts[0], scope) || !is_constant(expr.parts[1], scope)) {
            return expr;
        }
        const float low = constant_value(expr.parts[0]);
        const float high = constant_value(expr.parts[1]);
        if (!std::isfinite(high - low)) {
            return literal();
        }
        return low <= high ? expr : range(expr.parts[1], expr.parts[0]);
    }
    if (draws(expr)) { // check that the constant arguments of a distribution are in their bounds
        std::vector<float> arguments;
        for (const Expr& part : expr.parts) {
            arguments.push_back(is_constant(part, scope) ? constant_value(part) : 1);
        }
        try {
            distribution_value(expr.text, arguments, 0.5F);
        } catch (const BadRange&) {
            return literal();
        }
        return expr;
    }
    if (expr.text == "if" && is_constant(expr.parts[0], scope)) {
        return literal(); // the compiler would drop the side that is not taken
    }
    if (is_constant(expr, scope) && !std::isfinite(constant_value(expr))) {
        return literal();
    }
    return expr;
}

// A decimal number that is so close to the middle between two binary32 numbers that rounding it to
// binary64 first gives the wrong one of the two.
Expr ExpressionMaker::double_rounding_literal() {
    const auto mantissa = static_cast<float>(random_.below(1U << 23U));
    const float below = 1 + mantissa * 0x1p-23F;
    const float above = std::nextafter(below, 4.0F);
    const double middle = (static_cast<double>(below) + static_cast<double>(above)) / 2;
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.24f", middle); // exact, ends with a 5
    std::string text = buffer.data();
    Expr expr = number(0);
    if (random_.percent(50)) {
        expr.number = above;
        expr.text = text + "00000000000000000001";
    } else {
        text.back() = '4';
        expr.number = below;
        expr.text = text + "99999999999999999999";
    }
    return expr;
}

Expr ExpressionMaker::literal() {
    static const std::vector<float> kUsual = {0, 1, 2,    3,  4,     5,  0.5F, 0.1F, 0.25F,
                                              2, 1, 1.5F, 10, 22.5F, 30, 45,   90,   0.7F};
    static const std::vector<float> kSpecial = {
        180,   270,           360,    112.5F,          1e-3F,       1000, 16777216,
        1e10F, 3.4028235e38F, 1e-45F, 1.17549435e-38F, 0.33333334F, 100,  7,
        450};
    if (random_.percent(75)) {
        return number(random_.pick(kUsual));
    }
    if (random_.percent(40)) {
        return number(random_.pick(kSpecial));
    }
    if (random_.percent(25)) {
        return double_rounding_literal();
    }
    // Random digits with a decimal point between them.
    std::string text;
    const int digits = random_.between(1, 9);
    const int point = random_.between(0, digits);
    for (int i = 0; i < digits; ++i) {
        text += i == point ? "." : "";
        text += static_cast<char>('0' + random_.between(0, 9));
    }
    if (random_.percent(20)) {
        text += "e" + std::to_string(random_.between(-6, 3));
    }
    Expr expr = number(0);
    expr.text = text;
    std::from_chars(text.data(), text.data() + text.size(), expr.number);
    return expr;
}

Expr ExpressionMaker::leaf(const Scope& scope) {
    if (!scope.formals.empty() && random_.percent(55)) {
        return name(random_.pick(scope.formals));
    }
    std::vector<std::string> usable;
    for (const auto& [constant, value] : constants_.values) {
        const bool hidden =
            std::find(scope.formals.begin(), scope.formals.end(), constant) != scope.formals.end();
        if (!hidden && (scope.drawn_constants || constants_.drawn.count(constant) == 0)) {
            usable.push_back(constant);
        }
    }
    if (!usable.empty() && random_.percent(45)) {
        return name(random_.pick(usable));
    }
    if (scope.in_production && random_.percent(15)) {
        return call(random_.percent(65) ? "step" : "steps", {});
    }
    return literal();
}

Expr ExpressionMaker::range_of(const Scope& scope, int depth) {
    // Ranges whose width is exact, but for which min + draw * width is rounded to max for many
    // draws.
    static const std::vector<std::pair<float, float>> kNarrow = {{16777215.0F, 16777216.0F},
                                                                 {1.0F, 1.0000001F},
                                                                 {-1.0F, -0.99999994F},
                                                                 {0.0F, 1e-45F},
                                                                 {-1e-45F, 0.0F},
                                                                 {1e10F, 1.0000001e10F},
                                                                 {16777212.0F, 16777216.0F}};
    switch (random_.below(10)) {
    case 7: {
        const Expr mean = any(scope, depth - 1);
        const Expr deviation = random_.percent(80) ? call("abs", {leaf(scope)}) : literal();
        return legal(call("normal", {mean, deviation}), scope);
    }
    case 8: {
        const Expr mean = random_.percent(50) ? number(static_cast<float>(random_.below(701)))
                                              : call("abs", {any(scope, depth - 1)});
        return legal(call("poisson", {mean}), scope);
    }
    case 9: {
        const Expr trials = random_.percent(70)
                                ? number(static_cast<float>(random_.below(60)))
                                : call("floor", {call("abs", {any(scope, depth - 1)})});
        const Expr probability = random_.percent(30)
                                     ? call("mod", {call("abs", {leaf(scope)}), number(1)})
                                     : call("abs", {call("sin", {leaf(scope)})});
        return legal(call("binomial", {trials, probability}), scope);
    }
    case 6: {
        const auto& [low, high] = random_.pick(kNarrow);
        return range(number(low), number(high));
    }
    case 0: {
        const Expr low = any(scope, depth - 1);
        return legal(range(low, binary("+", low, literal())), scope);
    }
    case 1: {
        const Expr low = any(scope, depth - 1);
        const Expr high = any(scope, depth - 1);
        return legal(range(low, high), scope);
    }
    case 2: {
        const Expr bound = call("abs", {leaf(scope)});
        return legal(range(unary("-", bound), bound), scope);
    }
    case 3: {
        const Expr bound = leaf(scope);
        return legal(range(bound, bound), scope);
    }
    default: {
        const Expr low = literal();
        const Expr high = literal();
        return legal(range(low, high), scope);
    }
    }
}

Expr ExpressionMaker::any(const Scope& scope, int depth) {
    static const std::vector<std::string> kBinary = {"+", "-", "*",  "/",  "+",  "-",  "*",  "^",
                                                     "<", ">", "<=", ">=", "==", "!=", "&&", "||"};
    static const std::vector<std::string> kFunctions = {"sin",   "cos",  "tan",   "asin", "acos",
                                                        "atan",  "sqrt", "exp",   "log",  "abs",
                                                        "floor", "ceil", "round", "sign"};
    static const std::vector<std::string> kFunctions2 = {"atan2", "pow", "min", "max", "mod"};
    if (depth <= 0 || random_.percent(20)) {
        return leaf(scope);
    }
    if (scope.range_percent > 0 && random_.percent(8)) {
        return range_of(scope, depth);
    }
    if (!constants_.functions.empty() && random_.percent(12)) {
        auto function = constants_.functions.begin();
        std::advance(function,
                     static_cast<std::ptrdiff_t>(random_.below(constants_.functions.size())));
        std::vector<Expr> arguments;
        do {
            arguments.push_back(any(scope, depth - 1));
        } while (arguments.size() < function->second.formals.size());
        return legal(call(function->first, arguments), scope);
    }
    if (random_.percent(12)) {
        const Expr first = random_.percent(50) ? comparison(scope) : any(scope, depth - 1);
        const Expr second = any(scope, depth - 1);
        const Expr third = any(scope, depth - 1);
        static const std::vector<std::string> kFunctions3 = {"if", "if", "if", "clamp", "mix"};
        return legal(call(random_.pick(kFunctions3), {first, second, third}), scope);
    }
    switch (random_.below(10)) {
    case 0:
        return legal(unary("-", any(scope, depth - 1)), scope);
    case 1:
        return legal(unary("!", any(scope, depth - 1)), scope);
    case 2:
    case 3: {
        const std::string& function = random_.pick(kFunctions);
        return legal(call(function, {any(scope, depth - 1)}), scope);
    }
    case 4: {
        const std::string& function = random_.pick(kFunctions2);
        const Expr first = any(scope, depth - 1);
        const Expr second = any(scope, depth - 1);
        return legal(call(function, {first, second}), scope);
    }
    default: {
        const std::string& text = random_.pick(kBinary);
        const Expr left = any(scope, depth - 1);
        const Expr right = any(scope, depth - 1);
        return legal(binary(text, left, right), scope);
    }
    }
}

Expr ExpressionMaker::argument(const Scope& scope) {
    if (random_.percent(scope.range_percent)) {
        return range_of(scope, 2);
    }
    const std::size_t style = random_.below(100);
    if (style < 30 || scope.formals.empty()) {
        return style % 4 == 0 ? any(scope, 2) : leaf(scope);
    }
    if (style < 50) {
        return name(random_.pick(scope.formals));
    }
    if (style < 80) {
        static const std::vector<std::string> kUsual = {"-", "+", "-", "+", "*"};
        const std::string& text = random_.pick(kUsual);
        const Expr formal = name(random_.pick(scope.formals));
        return legal(binary(text, formal, literal()), scope);
    }
    return any(scope, random_.between(2, 4));
}

Expr ExpressionMaker::local(const Scope& scope) {
    const Expr value = argument(scope);
    if (!is_constant(value, scope)) {
        return value;
    }
    return scope.range_percent > 0 ? range(number(0), number(1)) : call("step", {});
}

Expr ExpressionMaker::comparison(const Scope& scope) {
    static const std::vector<std::string> kComparisons = {"<", ">", "<=", ">=", "==", "!="};
    if (scope.in_production && random_.percent(20)) {
        const Expr phase = call("mod", {call("step", {}), number(random_.percent(50) ? 2 : 3)});
        const std::string text = random_.percent(50) ? "==" : "!=";
        return binary(text, phase, number(random_.percent(50) ? 0 : 1));
    }
    const Expr left = random_.percent(70) ? leaf(scope) : any(scope, 2);
    const Expr right = random_.percent(60) ? literal() : any(scope, 2);
    const std::string& text = random_.pick(kComparisons);
    return legal(binary(text, left, right), scope);
}

Expr ExpressionMaker::condition(const Scope& scope) {
    const std::size_t style = random_.below(100);
    if (style < 60) {
        return comparison(scope);
    }
    if (style < 70) {
        return legal(unary("!", comparison(scope)), scope);
    }
    if (style < 90) {
        const std::string joint = random_.percent(50) ? "&&" : "||";
        const Expr left = comparison(scope);
        const Expr right = comparison(scope);
        return legal(binary(joint, left, right), scope);
    }
    return any(scope, 3);
}

} // namespace lsys::reference
