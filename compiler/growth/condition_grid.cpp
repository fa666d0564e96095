// SPDX-License-Identifier: MIT
#include "compiler/growth/condition_grid.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/interpret.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace lsys::analysis {

namespace {

constexpr std::size_t kMaxAxes = 16;                // max number of parameters of a grid
constexpr std::int32_t kMaxOrderIndex = 0x7F7FFFFF; // order_index() of the largest finite binary32

/// One operation on the value x of a chain: `x opcode constant`, `constant opcode x`, `opcode x`.
struct MonotoneStep {
    Opcode opcode = Opcode::Negate;
    float constant = 0.0F;
    bool constant_first = false;
};

/// A value of the domain GridBuilder.
struct Node {
    enum class Kind : std::uint8_t {
        Constant,
        Chain,        // a monotone function of one parameter
        CellConstant, // constant in every cell
        Other,
    };
    Kind kind = Kind::Other;
    float value = 0.0F;              // Constant
    std::uint32_t parameter = 0;     // Chain
    std::vector<MonotoneStep> steps; // Chain: from the parameter to the value

    [[nodiscard]] bool is_cell_constant() const {
        return kind == Kind::Constant || kind == Kind::CellConstant;
    }
    [[nodiscard]] bool is_parameter() const { return kind == Kind::Chain && steps.empty(); }
};

bool is_comparison(Opcode opcode) {
    return opcode >= Opcode::Less && opcode <= Opcode::NotEqual;
}

Node constant(float value) {
    Node node;
    node.kind = std::isfinite(value) ? Node::Kind::Constant : Node::Kind::Other;
    node.value = value;
    return node;
}

/// A value that is constant in every cell.
Node cell_constant() {
    Node node;
    node.kind = Node::Kind::CellConstant;
    return node;
}

/// The value of a chain if its parameter is number_at(index).
float chain_at(const Node& chain, std::int32_t index) {
    float value = number_at(index);
    for (const MonotoneStep& step : chain.steps) {
        value = step.constant_first ? arithmetic::apply(step.opcode, step.constant, value)
                                    : arithmetic::apply(step.opcode, value, step.constant);
    }
    return value;
}

/// The domain of values that are monotone in one parameter or constant in every cell. Collects the
/// cuts: the numbers at which a cell begins.
class GridBuilder : public UnknownDomain<Node> {
public:
    GridBuilder(std::span<const std::uint32_t> instructions,
                std::span<const KnownValue> parameters,
                const ExpressionInputs& inputs)
        : instructions_(instructions), parameters_(parameters), inputs_(inputs) {}

    /// Adds the cuts of a condition; false if the condition has no grid.
    bool add(const ConditionView& condition);
    [[nodiscard]] std::optional<ConditionGrid> finish(std::uint64_t max_points);

    static Node literal(float value) { return constant(value); }
    [[nodiscard]] Node formal(std::uint32_t index) const;
    [[nodiscard]] Node step() const { return count(inputs_.step); }
    [[nodiscard]] Node steps() const { return count(inputs_.steps); }
    Node unary(Opcode opcode, const Node& x);
    Node binary(Opcode opcode, const Node& x, const Node& y);
    Node choice(const Node& x, const Node& y, const Node& z);
    bool take(Node x, const std::uint32_t* /*at*/) {
        has_grid_ = as_truth(x);
        return false;
    }

private:
    static Node count(const std::optional<std::uint32_t>& value) {
        return value ? constant(static_cast<float>(*value)) : Node{};
    }
    Node compare(Opcode opcode, const Node& x, const Node& y);
    bool as_truth(Node& node);
    void cut(const Node& chain, Opcode opcode, float constant);

    std::span<const std::uint32_t> instructions_;
    std::span<const KnownValue> parameters_;
    const ExpressionInputs& inputs_;
    std::uint32_t first_formal_ = 0; // first formal of the condition being added
    bool has_grid_ = false;
    std::map<std::uint32_t, std::vector<std::int32_t>>
        cuts_; // per parameter: order_index() of the first number of a cell
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_; // parameters compared
};

Node GridBuilder::formal(std::uint32_t index) const {
    const std::uint32_t parameter = index - first_formal_;
    if (index < first_formal_ || parameter >= parameters_.size()) {
        return {}; // a parameter of a context
    }
    if (parameters_[parameter].known) {
        return constant(parameters_[parameter].value);
    }
    Node node;
    node.kind = Node::Kind::Chain;
    node.parameter = parameter;
    return node;
}

/// Adds the cuts where the truth of `chain opcode constant` changes.
void GridBuilder::cut(const Node& chain, Opcode opcode, float constant) {
    std::vector<std::int32_t>& cuts = cuts_[chain.parameter];
    const bool below = opcode != Opcode::LessEqual && opcode != Opcode::Greater;
    const bool above = opcode != Opcode::Less && opcode != Opcode::GreaterEqual;
    if (chain.is_parameter()) {
        if (below) {
            cuts.push_back(order_index(constant));
        }
        if (above) {
            cuts.push_back(order_index(constant) + 1);
        }
        return;
    }
    const auto change = [&](auto&& holds) {
        std::int32_t low = -kMaxOrderIndex;
        std::int32_t high = kMaxOrderIndex;
        const bool at_low = holds(chain_at(chain, low));
        if (at_low == holds(chain_at(chain, high))) {
            return;
        }
        while (high - std::int64_t{low} > 1) {
            const auto middle = static_cast<std::int32_t>((std::int64_t{low} + high) / 2);
            (holds(chain_at(chain, middle)) == at_low ? low : high) = middle;
        }
        cuts.push_back(high);
    };
    if (below) {
        change([&](float value) { return value < constant; });
    }
    if (above) {
        change([&](float value) { return value <= constant; });
    }
}

/// Turns a value into a truth value that is constant in every cell; false if that fails.
bool GridBuilder::as_truth(Node& node) {
    if (node.kind == Node::Kind::Chain) {
        cut(node, Opcode::NotEqual, 0.0F);
        node.kind = Node::Kind::CellConstant;
    }
    return node.kind != Node::Kind::Other;
}

Node GridBuilder::unary(Opcode opcode, const Node& x) {
    if (x.kind == Node::Kind::Constant) {
        return constant(arithmetic::apply(opcode, x.value, 0.0F));
    }
    Node node = x;
    if (x.kind == Node::Kind::Chain) {
        const bool monotone = opcode == Opcode::Negate || opcode == Opcode::Floor ||
                              opcode == Opcode::Ceil || opcode == Opcode::Round;
        if (opcode == Opcode::Not) {
            as_truth(node);
        } else if (monotone) {
            node.steps.push_back({opcode, 0.0F, false});
        } else {
            return {};
        }
    }
    return node;
}

Node GridBuilder::compare(Opcode opcode, const Node& x, const Node& y) {
    if (x.kind == Node::Kind::Chain && y.kind == Node::Kind::Constant) {
        cut(x, opcode, y.value);
        return cell_constant();
    }
    if (x.kind == Node::Kind::Constant && y.kind == Node::Kind::Chain) {
        const Opcode mirrored = opcode == Opcode::Less           ? Opcode::Greater
                                : opcode == Opcode::LessEqual    ? Opcode::GreaterEqual
                                : opcode == Opcode::Greater      ? Opcode::Less
                                : opcode == Opcode::GreaterEqual ? Opcode::LessEqual
                                                                 : opcode;
        cut(y, mirrored, x.value);
        return cell_constant();
    }
    if (x.is_parameter() && y.is_parameter()) {
        if (x.parameter != y.parameter) {
            pairs_.emplace_back(x.parameter, y.parameter);
            cuts_[x.parameter];
            cuts_[y.parameter];
        }
        return cell_constant();
    }
    return {};
}

Node GridBuilder::binary(Opcode opcode, const Node& x, const Node& y) {
    using Kind = Node::Kind;
    if (x.kind == Kind::Constant && y.kind == Kind::Constant) {
        return constant(arithmetic::apply(opcode, x.value, y.value));
    }
    if (opcode == Opcode::And || opcode == Opcode::Or) {
        Node left = x;
        Node right = y;
        return as_truth(left) && as_truth(right) ? cell_constant() : Node{};
    }
    if (x.is_cell_constant() && y.is_cell_constant()) {
        return cell_constant();
    }
    if (is_comparison(opcode)) {
        return compare(opcode, x, y);
    }
    const bool left = x.kind == Kind::Chain && y.kind == Kind::Constant;
    const bool right = x.kind == Kind::Constant && y.kind == Kind::Chain;
    if (!left && !right) {
        return {};
    }
    // Rounding keeps order, so results stay monotone. A factor of 0 is excluded, since 0 times an
    // infinite value is NaN.
    const float constant = left ? y.value : x.value;
    const bool is_sum = opcode == Opcode::Add || opcode == Opcode::Subtract;
    const bool is_product = opcode == Opcode::Multiply || (opcode == Opcode::Divide && left);
    if (!is_sum && !(is_product && constant != 0.0F)) {
        return {};
    }
    Node node = left ? x : y;
    node.steps.push_back({opcode, constant, right});
    return node;
}

/// A choice is constant in every cell if its condition and both its values are.
Node GridBuilder::choice(const Node& x, const Node& y, const Node& z) {
    if (x.kind == Node::Kind::Constant) {
        return x.value != 0.0F ? y : z;
    }
    Node condition = x;
    return as_truth(condition) && y.is_cell_constant() && z.is_cell_constant() ? cell_constant()
                                                                               : Node{};
}

bool GridBuilder::add(const ConditionView& condition) {
    first_formal_ = condition.first_formal;
    has_grid_ = false;
    std::vector<Node> stack(stack_room(instructions_, condition.first_instruction));
    std::vector<Node> slots(slot_count(instructions_, condition.first_instruction));
    interpret(instructions_.data() + condition.first_instruction, *this, stack.data(),
              slots.data());
    return has_grid_;
}

/// A readable number of the cell number_at(first) to number_at(last): whole and near zero if
/// possible.
float readable_number(std::int32_t first, std::int32_t last) {
    if (first <= 0 && last >= 0) {
        return 0.0F;
    }
    const float nearest = number_at(first > 0 ? first : last);
    const float whole = first > 0 ? std::ceil(nearest) : std::floor(nearest);
    const float inside =
        whole == nearest && first != last ? whole + (first > 0 ? 1.0F : -1.0F) : whole;
    for (const float candidate : {inside, whole}) {
        if (const std::int32_t index = order_index(candidate); index >= first && index <= last) {
            return candidate;
        }
    }
    return number_at(static_cast<std::int32_t>((std::int64_t{first} + last) / 2));
}

std::optional<ConditionGrid> GridBuilder::finish(std::uint64_t max_points) {
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    if (cuts_.size() > kMaxAxes || (!pairs_.empty() && cuts_.size() > 3)) {
        return std::nullopt;
    }
    // Parameters that are compared with each other get the same cuts. If both values are in equal
    // cells, there are then samples for each result of the comparison: less, equal and greater.
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [a, b] : pairs_) {
            std::vector<std::int32_t> merged_cuts = cuts_[a];
            merged_cuts.insert(merged_cuts.end(), cuts_[b].begin(), cuts_[b].end());
            std::sort(merged_cuts.begin(), merged_cuts.end());
            merged_cuts.erase(std::unique(merged_cuts.begin(), merged_cuts.end()),
                              merged_cuts.end());
            changed = changed || merged_cuts.size() != cuts_[a].size() ||
                      merged_cuts.size() != cuts_[b].size();
            cuts_[a] = merged_cuts;
            cuts_[b] = std::move(merged_cuts);
        }
    }
    ConditionGrid grid;
    for (auto& [parameter, cuts] : cuts_) {
        GridAxis axis;
        axis.parameter = parameter;
        axis.compared = std::any_of(pairs_.begin(), pairs_.end(), [&axis](const auto& pair) {
            return pair.first == axis.parameter || pair.second == axis.parameter;
        });
        std::sort(cuts.begin(), cuts.end());
        cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
        std::int32_t first = -kMaxOrderIndex;
        const auto close = [&](std::int32_t last) {
            const auto cell = static_cast<std::uint32_t>(axis.cells.size());
            axis.cells.push_back({number_at(first), number_at(last)});
            if (!axis.compared) {
                axis.samples.push_back({readable_number(first, last), cell});
            } else {
                // Three samples per cell suffice for every order of up to three parameters.
                const auto middle = static_cast<std::int32_t>((std::int64_t{first} + last) / 2);
                axis.samples.push_back({number_at(first), cell});
                if (middle != first && middle != last) {
                    axis.samples.push_back({number_at(middle), cell});
                }
                if (last != first) {
                    axis.samples.push_back({number_at(last), cell});
                }
            }
            first = last + 1;
        };
        for (const std::int32_t start : cuts) {
            if (start > first && start <= kMaxOrderIndex) {
                close(start - 1);
            }
        }
        close(kMaxOrderIndex);
        grid.axes.push_back(std::move(axis));
        if (grid.point_count() > max_points) {
            return std::nullopt;
        }
    }
    return grid;
}

} // namespace

std::uint64_t ConditionGrid::point_count() const {
    std::uint64_t count = 1;
    for (const GridAxis& axis : axes) {
        if (axis.samples.size() > std::numeric_limits<std::uint64_t>::max() / count) {
            return std::numeric_limits<std::uint64_t>::max();
        }
        count *= axis.samples.size();
    }
    return count;
}

std::size_t ConditionGrid::sample_of(std::uint64_t point, std::size_t axis) const {
    for (std::size_t i = axes.size(); i-- > axis + 1;) {
        point /= axes[i].samples.size();
    }
    return point % axes[axis].samples.size();
}

void ConditionGrid::set_parameters(std::uint64_t point, std::span<KnownValue> parameters) const {
    for (std::size_t i = axes.size(); i-- > 0;) {
        const std::size_t count = axes[i].samples.size();
        parameters[axes[i].parameter] = {axes[i].samples[point % count].value, true};
        point /= count;
    }
}

std::optional<ConditionGrid> make_condition_grid(std::span<const std::uint32_t> instructions,
                                                 std::span<const ConditionView> conditions,
                                                 std::span<const KnownValue> parameters,
                                                 const ExpressionInputs& inputs,
                                                 std::uint64_t max_points) {
    GridBuilder builder(instructions, parameters, inputs);
    for (const ConditionView& condition : conditions) {
        if (!builder.add(condition)) {
            return std::nullopt;
        }
    }
    return builder.finish(max_points);
}

std::int32_t order_index(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto magnitude = static_cast<std::int32_t>(bits & 0x7FFFFFFFU);
    return (bits & 0x80000000U) != 0 ? -magnitude : magnitude;
}

float number_at(std::int32_t index) {
    const auto magnitude = static_cast<std::uint32_t>(index < 0 ? -index : index);
    return std::bit_cast<float>(index < 0 ? magnitude | 0x80000000U : magnitude);
}

} // namespace lsys::analysis
