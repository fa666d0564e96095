// SPDX-License-Identifier: MIT
#include "tests/reference/evaluate.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace lsys::reference {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegreesPerRadian = 180.0 / kPi;
constexpr double kRadiansPerDegree = kPi / 180.0;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float rounded(double value) {
    return static_cast<float>(value);
}

float truth(bool value) {
    return value ? 1.0F : 0.0F;
}

bool holds(float value) {
    return value != 0.0F;
}

// Whether `degrees` is exactly a multiple of 90; `quarter` receives the multiple, modulo 4.
bool is_right_angle(float degrees, int& quarter) {
    const double reduced = std::fmod(static_cast<double>(degrees), 360.0);
    if (std::fmod(reduced, 90.0) != 0.0) {
        return false; // NaN and infinite angles end here too
    }
    quarter = (static_cast<int>(reduced / 90.0) + 4) % 4;
    return true;
}

double in_radians(float degrees) {
    return std::fmod(static_cast<double>(degrees), 360.0) * kRadiansPerDegree;
}

float sine(float degrees) {
    int quarter = 0;
    if (is_right_angle(degrees, quarter)) {
        constexpr float kExact[] = {0, 1, 0, -1};
        return kExact[quarter];
    }
    return rounded(std::sin(in_radians(degrees)));
}

float cosine(float degrees) {
    int quarter = 0;
    if (is_right_angle(degrees, quarter)) {
        constexpr float kExact[] = {1, 0, -1, 0};
        return kExact[quarter];
    }
    return rounded(std::cos(in_radians(degrees)));
}

float tangent(float degrees) {
    int quarter = 0;
    if (is_right_angle(degrees, quarter)) {
        constexpr float kExact[] = {0, kInfinity, 0, -kInfinity};
        return kExact[quarter];
    }
    return rounded(std::tan(in_radians(degrees)));
}

float sign_of(float x) {
    if (x > 0) {
        return 1;
    }
    if (x < 0) {
        return -1;
    }
    return x;
}

[[noreturn]] void unknown(const std::string& name) {
    std::fputs(("reference: no meaning for " + name + "\n").c_str(), stderr);
    std::abort();
}

} // namespace

float range_value(float min, float max, float u) {
    const float width = max - min;
    if (!std::isfinite(min) || !std::isfinite(max) || !std::isfinite(width) || min > max) {
        throw BadRange{};
    }
    const float offset = width * u;
    const float value = min + offset;
    if (min < max && value >= max) {
        return std::nextafter(max, -kInfinity);
    }
    return value;
}

bool draws(const Expr& expr) {
    return expr.kind == ExprKind::Range ||
           (expr.kind == ExprKind::Call &&
            (expr.text == "normal" || expr.text == "poisson" || expr.text == "binomial"));
}

namespace {

// The quantile `p` of the standard normal distribution, by bisection, because the standard library
// has the error function, but not its inverse.
long double inverse_normal(long double p) {
    long double below = -10;
    long double above = 10;
    for (int i = 0; i < 200; ++i) {
        const long double middle = (below + above) / 2;
        const long double probability = std::erfc(-middle / std::sqrt(2.0L)) / 2;
        (probability < p ? below : above) = middle;
    }
    return (below + above) / 2;
}

// The logarithm of the number of ways to choose k of n.
long double log_choose(long double n, long double k) {
    return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

// The smallest k below `end` for which probability(0) + ... + probability(k) exceeds u; `end` if
// there is none.
template <typename Probability>
float least_exceeding(float u, int end, Probability probability) {
    long double sum = 0;
    for (int k = 0; k < end; ++k) {
        sum += probability(static_cast<long double>(k));
        if (sum > static_cast<long double>(u)) {
            return static_cast<float>(k);
        }
    }
    return static_cast<float>(end);
}

} // namespace

float distribution_value(const std::string& name, const std::vector<float>& arguments, float u) {
    const float a = arguments[0];
    if (name == "poisson") {
        if (!(a >= 0 && a <= 700)) {
            throw BadRange{};
        }
        const auto mean = static_cast<long double>(a);
        return least_exceeding(u, 10000, [&](long double k) {
            return mean == 0 ? (k == 0 ? 1.0L : 0.0L)
                             : std::exp(k * std::log(mean) - mean - std::lgamma(k + 1));
        });
    }
    const float b = arguments[1];
    if (name == "normal") {
        if (!std::isfinite(a) || !std::isfinite(b) || b < 0) {
            throw BadRange{};
        }
        const long double z = inverse_normal(static_cast<long double>(u) + 0x1p-25L);
        const double distance = static_cast<double>(b) * static_cast<double>(z);
        return rounded(static_cast<double>(a) + distance);
    }
    if (!(a >= 0 && a <= 10000 && std::floor(a) == a && b >= 0 && b <= 1)) {
        throw BadRange{};
    }
    const auto trials = static_cast<long double>(a);
    const auto p = static_cast<long double>(b);
    if (p == 0 || p == 1) {
        return p == 0 ? 0 : a;
    }
    return least_exceeding(u, static_cast<int>(a), [&](long double k) {
        return std::exp(log_choose(trials, k) + k * std::log(p) + (trials - k) * std::log1p(-p));
    });
}

float apply_operator(const std::string& name, const std::vector<float>& operands) {
    const float a = operands[0];
    if (operands.size() == 1) {
        return name == "-" ? -a : truth(a == 0.0F);
    }
    const float b = operands[1];
    if (name == "+") {
        return a + b;
    }
    if (name == "-") {
        return a - b;
    }
    if (name == "*") {
        return a * b;
    }
    if (name == "/") {
        return a / b;
    }
    if (name == "^") {
        return rounded(std::pow(static_cast<double>(a), static_cast<double>(b)));
    }
    if (name == "<") {
        return truth(a < b);
    }
    if (name == "<=") {
        return truth(a <= b);
    }
    if (name == ">") {
        return truth(a > b);
    }
    if (name == ">=") {
        return truth(a >= b);
    }
    if (name == "==") {
        return truth(a == b);
    }
    if (name == "!=") {
        return truth(a != b);
    }
    if (name == "&&") {
        return truth(holds(a) && holds(b));
    }
    if (name == "||") {
        return truth(holds(a) || holds(b));
    }
    unknown(name);
}

float apply_function(const std::string& name, const std::vector<float>& operands) {
    const float a = operands[0];
    const auto wide = static_cast<double>(a);
    if (operands.size() == 3) {
        if (name == "clamp") {
            const float raised = operands[1] > a ? operands[1] : a;
            return operands[2] < raised ? operands[2] : raised;
        }
        if (name == "mix") {
            const double way = static_cast<double>(operands[1]) - wide;
            return rounded(wide + way * static_cast<double>(operands[2]));
        }
        unknown(name);
    }
    if (operands.size() == 2) {
        const float b = operands[1];
        if (name == "atan2") {
            return rounded(std::atan2(wide, static_cast<double>(b)) * kDegreesPerRadian);
        }
        if (name == "pow") {
            return rounded(std::pow(wide, static_cast<double>(b)));
        }
        if (name == "min") {
            return b < a ? b : a;
        }
        if (name == "max") {
            return b > a ? b : a;
        }
        if (name == "mod") {
            return rounded(std::fmod(wide, static_cast<double>(b)));
        }
        unknown(name);
    }
    if (name == "sin") {
        return sine(a);
    }
    if (name == "cos") {
        return cosine(a);
    }
    if (name == "tan") {
        return tangent(a);
    }
    if (name == "asin") {
        return rounded(std::asin(wide) * kDegreesPerRadian);
    }
    if (name == "acos") {
        return rounded(std::acos(wide) * kDegreesPerRadian);
    }
    if (name == "atan") {
        return rounded(std::atan(wide) * kDegreesPerRadian);
    }
    if (name == "sqrt") {
        return std::sqrt(a);
    }
    if (name == "exp") {
        return rounded(std::exp(wide));
    }
    if (name == "log") {
        return rounded(std::log(wide));
    }
    if (name == "abs") {
        return std::fabs(a);
    }
    if (name == "floor") {
        return std::floor(a);
    }
    if (name == "ceil") {
        return std::ceil(a);
    }
    if (name == "round") {
        return std::round(a);
    }
    if (name == "sign") {
        return sign_of(a);
    }
    unknown(name);
}

namespace {

std::size_t ranges_in(const Expr& expr) {
    std::size_t count = draws(expr) ? 1 : 0;
    for (const Expr& part : expr.parts) {
        count += ranges_in(part);
    }
    return count;
}

// Draws the random numbers of an expression that is not evaluated, because the numbers of later
// draws follow theirs.
void skip_ranges(const Expr& expr, const Environment& environment) {
    for (std::size_t i = ranges_in(expr); i > 0; --i) {
        environment.draw();
    }
}

} // namespace

float curve_value(const std::vector<std::pair<float, float>>& points, float t) {
    const std::size_t count = points.size();
    const auto x = [&](std::size_t i) { return static_cast<double>(points[i].first); };
    const auto y = [&](std::size_t i) { return static_cast<double>(points[i].second); };
    if (std::isnan(t)) {
        return t;
    }
    std::vector<double> secant;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        secant.push_back((y(i + 1) - y(i)) / (x(i + 1) - x(i)));
    }
    std::vector<double> slope{secant.front()};
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const bool turns = secant[i - 1] * secant[i] <= 0.0;
        slope.push_back(turns ? 0.0 : (secant[i - 1] + secant[i]) / 2.0);
    }
    slope.push_back(secant.back());
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (secant[i] == 0.0) {
            slope[i] = slope[i + 1] = 0.0;
            continue;
        }
        const double alpha = slope[i] / secant[i];
        const double beta = slope[i + 1] / secant[i];
        if (alpha * alpha + beta * beta > 9.0) {
            const double factor = 3.0 / std::sqrt(alpha * alpha + beta * beta);
            slope[i] *= factor;
            slope[i + 1] *= factor;
        }
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (t <= points[i].first) {
            return points[i].second;
        }
        if (t >= points[i + 1].first) {
            continue;
        }
        const double width = x(i + 1) - x(i);
        const double part = (static_cast<double>(t) - x(i)) / width;
        const double rest = 1.0 - part;
        return rounded(
            (1.0 + 2.0 * part) * rest * rest * y(i) + part * part * (3.0 - 2.0 * part) * y(i + 1) +
            (part * rest * rest * width * slope[i] - part * part * rest * width * slope[i + 1]));
    }
    return points.back().second;
}

float evaluate(const Expr& expr, const Environment& environment) {
    if (expr.kind == ExprKind::Number) {
        return expr.number;
    }
    if (expr.kind == ExprKind::Name) {
        if (const auto formal = environment.formals.find(expr.text);
            formal != environment.formals.end()) {
            return formal->second;
        }
        if (const auto constant = environment.constants->find(expr.text);
            constant != environment.constants->end()) {
            return constant->second;
        }
        unknown(expr.text);
    }
    if (expr.kind == ExprKind::Call && expr.text == "step") {
        return environment.step;
    }
    if (expr.kind == ExprKind::Call && expr.text == "steps") {
        return environment.steps;
    }
    if (expr.kind == ExprKind::Call && expr.text == "if") {
        if (holds(evaluate(expr.parts[0], environment))) {
            const float value = evaluate(expr.parts[1], environment);
            skip_ranges(expr.parts[2], environment);
            return value;
        }
        skip_ranges(expr.parts[1], environment);
        return evaluate(expr.parts[2], environment);
    }
    // Every operand is evaluated, even the second operand of && and ||, because ranges in it draw
    // numbers.
    std::vector<float> operands;
    for (const Expr& part : expr.parts) {
        operands.push_back(evaluate(part, environment));
    }
    if (expr.kind == ExprKind::Range) {
        const float u = environment.draw();
        return range_value(operands[0], operands[1], u);
    }
    if (draws(expr)) {
        const float u = environment.draw();
        return distribution_value(expr.text, operands, u);
    }
    if (expr.kind == ExprKind::Call) {
        if (environment.functions != nullptr && environment.functions->count(expr.text) != 0) {
            const UserFunction& function = environment.functions->at(expr.text);
            if (function.formals.empty()) {
                return curve_value(function.points, operands[0]);
            }
            Environment inner;
            inner.constants = environment.constants;
            inner.functions = environment.functions;
            for (std::size_t i = 0; i < operands.size(); ++i) {
                inner.formals[function.formals[i]] = operands[i];
            }
            return evaluate(function.body, inner);
        }
        return apply_function(expr.text, operands);
    }
    return apply_operator(expr.text, operands);
}

} // namespace lsys::reference
