// SPDX-License-Identifier: MIT
// The part of CpfgExpressions for arrays and for loops, which fill them.
#include "grammar/ast/reports.h"
#include "grammar/base/contract.h"
#include "grammar/base/number_chars.h"
#include "grammar/dialects/cpfg/expressions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace lsys {

std::optional<std::size_t> CpfgExpressions::known_place(const Array& array,
                                                        const ForeignNode& node) {
    std::size_t place = 0;
    for (std::size_t i = 0; i < node.parts.size(); ++i) {
        const std::optional<double> index = known_values_.of(term(node.parts[i]));
        if (!index || *index < 0.0 || *index >= static_cast<double>(array.sizes[i])) {
            return std::nullopt;
        }
        place = place * static_cast<std::size_t>(array.sizes[i]) + static_cast<std::size_t>(*index);
    }
    return place;
}

ForeignId CpfgExpressions::element(const ForeignNode& node) {
    const auto found = arrays_.find(node.text);
    if (found == arrays_.end()) {
        return unsupported(node.span, "`" + shown(node.text) + "` is not an array");
    }
    Array& array = found->second;
    if (array.is_broken) {
        return tree_.number("0", node.token);
    }
    if (array.sizes.size() != node.parts.size()) {
        return unsupported(node.span, "`" + shown(node.text) + "` has " +
                                          std::to_string(array.sizes.size()) + " dimensions");
    }
    if (in_header_ && !in_step_) { // the present value: elements may change later
        const std::optional<std::size_t> place = known_place(array, node);
        return place ? array.values[*place]
                     : unsupported(node.span, "an element whose index is not known before the word "
                                              "is derived");
    }
    ForeignId index = kNoForeign;
    for (std::size_t i = 0; i < node.parts.size(); ++i) {
        ForeignId part = term(node.parts[i]);
        const std::optional<double> known = known_values_.of(part);
        if (known && *known >= 0.0 && *known < 1e6) {
            part = tree_.number(std::to_string(static_cast<int>(*known)), node.token);
        } else {
            part = tree_.call("floor", {part}, node.token);
        }
        if (node.parts.size() > 1) { // clamp each index to its dimension
            const std::string last = std::to_string(array.sizes[i] - 1);
            part = tree_.call("clamp",
                              {part, tree_.number("0", node.token), tree_.number(last, node.token)},
                              node.token);
        }
        if (i == 0) {
            index = part;
            continue;
        }
        const ForeignId size = tree_.number(std::to_string(array.sizes[i]), node.token);
        index = tree_.binary("+", tree_.binary("*", index, size, node.token), part, node.token);
    }
    if (array.values.size() == 1) {
        return array.values[0];
    }
    if (array.name.empty()) {
        array.name = unique_name(cpfg_name_of(node.text, "array"), function_names_);
    }
    return tree_.call(array.name, {index}, node.token);
}

void CpfgExpressions::define_array(const CpfgStatement& statement) {
    constexpr int kMaxElements = 256;
    const ForeignNode target = tree_[statement.target];
    arrays_[target.text].is_broken = true; // until the definition has been read
    Array array;
    int count = 1;
    for (const ForeignId part : target.parts) {
        const std::optional<double> size = known_values_.of(term(part));
        const int value = size && *size >= 1.0 && *size <= kMaxElements
                              ? static_cast<int>(*size) // as cpfg, which cuts off the fraction
                              : 0;
        if (value <= 0 || value > kMaxElements / count) {
            static_cast<void>(
                unsupported(target.span, "an array whose size is not a number from 1 to 256"));
            return;
        }
        array.sizes.push_back(value);
        count *= value;
    }
    for (const ForeignId value : statement.values) {
        const ForeignId element = term(value);
        if (tree_.has_draw(element)) {
            static_cast<void>(unsupported(statement.span, "random numbers in an array"));
            return;
        }
        array.values.push_back(element);
    }
    array.values.resize(static_cast<std::size_t>(count), tree_.number("0", statement.span));
    arrays_[target.text] = std::move(array);
}

ForeignId CpfgExpressions::folded(ForeignId value) {
    const std::optional<double> known =
        loops_ != 0 ? known_values_.of(value) : std::optional<double>();
    if (!known) {
        return value;
    }
    return number_node(*known, tree_[value].span);
}

ForeignId CpfgExpressions::number_node(double value, SourceSpan span) {
    std::array<char, 64> buffer{};
    const auto [end, error] = number_to_chars(buffer.data(), buffer.data() + buffer.size(),
                                              value == 0.0 ? 0.0 : value); // no -0
    LSYS_CHECK(error == std::errc());
    const auto length = static_cast<std::size_t>(end - buffer.data());
    return tree_.number(std::string_view(buffer.data(), length), span);
}

void CpfgExpressions::loop(const CpfgStatement& statement) {
    constexpr std::size_t kMaxStatements = 100'000; // run by all loops of the file
    ++loops_;
    for (bool is_first = statement.tests_last;; is_first = false) {
        const std::optional<double> test =
            is_first ? std::optional(1.0) : known_values_.of(term(statement.value));
        if (!test) {
            static_cast<void>(unsupported(statement.span,
                                          "a loop whose end depends on the parameters of modules, "
                                          "on the step or on random numbers"));
            break;
        }
        if (*test == 0.0) {
            break;
        }
        if (++loop_statements_ > kMaxStatements) { // counts the round, since a block may be empty
            static_cast<void>(
                unsupported(statement.span, "loops of more than 100000 statements in all"));
            break;
        }
        const std::uint64_t errors = session_.context.diagnostics.count(Severity::Error);
        run(statement.block);
        if (session_.context.diagnostics.count(Severity::Error) != errors) {
            break; // each further round would repeat the errors
        }
    }
    --loops_;
}

void CpfgExpressions::assign_element(const CpfgStatement& statement) {
    set_element(tree_[statement.target], folded(term(statement.value)), statement.span);
}

/// Sets an element of an array. Elements change only in `Start:`, at indices that are known.
void CpfgExpressions::set_element(const ForeignNode& target, ForeignId value, SourceSpan span) {
    const auto found = arrays_.find(target.text);
    if (found != arrays_.end() && found->second.is_broken) {
        return;
    }
    if (!in_header_ || in_step_ || found == arrays_.end() ||
        found->second.sizes.size() != target.parts.size()) {
        static_cast<void>(
            unsupported(span, "an element of an array that is changed while the word is derived"));
        return;
    }
    const std::optional<std::size_t> place = known_place(found->second, target);
    if (!place || tree_.has_draw(value)) {
        static_cast<void>(unsupported(span, place ? "random numbers in an array"
                                                  : "an element whose index is not known before "
                                                    "the word is derived"));
        return;
    }
    found->second.values[*place] = value;
}

} // namespace lsys
