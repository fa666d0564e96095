// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/known_values.h"

#include "grammar/base/exponentials.h"
#include "grammar/base/number_chars.h"

#include <array>
#include <cmath>
#include <string_view>
#include <system_error>
#include <vector>

namespace lsys {

namespace {

constexpr int kMaxDepth = 2'000; // the recursion ends here; the parser allows 1,000 levels

std::optional<double> number_in(std::string_view text) {
    double value = 0.0;
    const bool is_negative = text.starts_with('-');
    text.remove_prefix(is_negative ? 1 : 0);
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return is_negative ? -value : value;
}

std::optional<double> binary(std::string_view operation, double a, double b) {
    struct Row {
        std::string_view operation;
        double value;
    };
    const auto truth = [](bool holds) { return holds ? 1.0 : 0.0; };
    const std::array rows{
        Row{"+", a + b},
        Row{"-", a - b},
        Row{"*", a * b},
        Row{"/", a / b},
        Row{"<", truth(a < b)},
        Row{"<=", truth(a <= b)},
        Row{">", truth(a > b)},
        Row{">=", truth(a >= b)},
        Row{"==", truth(a == b)},
        Row{"!=", truth(a != b)},
        Row{"&&", truth(a != 0.0 && b != 0.0)},
        Row{"||", truth(a != 0.0 || b != 0.0)},
    };
    for (const Row& row : rows) {
        if (row.operation == operation) {
            return row.value;
        }
    }
    return operation == "^" ? std::optional(power(a, b)) : std::nullopt;
}

std::optional<double> function(std::string_view name, const std::vector<double>& arguments) {
    const double x = arguments.empty() ? 0.0 : arguments[0];
    if (arguments.size() == 1) {
        return name == "floor"  ? std::optional(std::floor(x))
               : name == "ceil" ? std::optional(std::ceil(x))
               : name == "abs"  ? std::optional(std::abs(x))
               : name == "int"  ? std::optional(std::trunc(x))
               : name == "sqrt" ? std::optional(std::sqrt(x))
                                : std::nullopt;
    }
    if (arguments.size() == 2 && name == "mod") {
        return std::fmod(x, arguments[1]);
    }
    return std::nullopt;
}

} // namespace

std::optional<double> KnownValues::of(ForeignId expression) {
    return of_node(tree_[expression], 0);
}

std::optional<double> KnownValues::of_node(const ForeignNode& node, int depth) {
    if (depth > kMaxDepth) {
        return std::nullopt;
    }
    std::optional<double> value;
    if (node.kind == ForeignKind::Number) {
        value = number_in(node.text);
    } else if (node.kind == ForeignKind::Local) {
        value = of_local(node.index, depth);
    } else if (node.kind == ForeignKind::Unary || node.kind == ForeignKind::Binary ||
               node.kind == ForeignKind::Call) {
        std::vector<double> parts;
        for (const ForeignId part : node.parts) {
            const std::optional<double> known = of_node(tree_[part], depth + 1);
            if (!known) {
                return std::nullopt;
            }
            parts.push_back(*known);
        }
        if (node.kind == ForeignKind::Unary) {
            value = node.text == "-" ? -parts[0] : parts[0] == 0.0 ? 1.0 : 0.0;
        } else if (node.kind == ForeignKind::Binary) {
            value = binary(node.text, parts[0], parts[1]);
        } else if (node.text == "if" && parts.size() == 3) {
            value = parts[0] != 0.0 ? parts[1] : parts[2];
        } else {
            value = function(node.text, parts);
        }
    }
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> KnownValues::of_local(std::uint32_t index, int depth) {
    if (const auto found = locals_.find(index); found != locals_.end()) {
        return found->second;
    }
    const std::optional<double> value = of_node(tree_[tree_.locals()[index].value], depth + 1);
    locals_[index] = value;
    return value;
}

} // namespace lsys
