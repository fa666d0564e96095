// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep_compiler.h"

#include "grammar/base/contract.h"
#include "runtime/derive/engine/eval.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr std::uint64_t kDrawsPerBlock = 4;
/// A node of this depth is stored, which limits the recursion of load().
constexpr std::uint32_t kMaxNodeDepth = 64;

/// Operations between two pauses. Without tail calls, as in builds without optimisation, each
/// operation takes stack, which a pause frees by returning to SweepMachine::run().
constexpr std::uint32_t kOperationsPerPause = 256;

} // namespace

SweepOperand SweepCode::draw(std::uint64_t number) {
    const auto block = static_cast<std::uint32_t>(number / kDrawsPerBlock);
    const auto found = std::find(draw_blocks.begin(), draw_blocks.end(), block);
    const auto row = static_cast<std::uint32_t>(found - draw_blocks.begin());
    if (found == draw_blocks.end()) {
        draw_blocks.push_back(block);
    }
    const auto word = static_cast<std::uint32_t>(number % kDrawsPerBlock);
    return {kDrawBase, (row * static_cast<std::uint32_t>(kDrawsPerBlock) + word) * kSweepLanes};
}

SweepCompiler::SweepCompiler(const Bytecode& bytecode, SweepCode& code, std::uint64_t first_draw)
    : bytecode_(bytecode), code_(code), first_draw_(first_draw) {}

void SweepCompiler::add_module(const PatternItem& item, std::uint32_t base) {
    sources_.push_back({item.first_formal, bytecode_.symbol(item.symbol).parameter_count, base});
}

std::uint32_t SweepCompiler::condition(std::uint32_t first) {
    const auto begin = static_cast<std::uint32_t>(code_.operations.size());
    std::vector<SweepNode> slots;
    run(first, slots);
    write_taken();
    return begin;
}

std::uint32_t SweepCompiler::successor(const WordTemplate& word) {
    const auto begin = static_cast<std::uint32_t>(code_.operations.size());
    std::vector<SweepNode> slots;
    for (const std::uint32_t first : {word.locals, word.arguments}) {
        if (first != kNone) {
            run(first, slots);
        }
    }
    write_taken();
    return begin;
}

void SweepCompiler::run(std::uint32_t first, std::vector<SweepNode>& slots) {
    slots.resize(std::max<std::size_t>(bytecode_.local_count, 1));
    std::vector<SweepNode> stack(std::max<std::size_t>(bytecode_.stack_depth, 1));
    const bool ended =
        interpret(bytecode_.instructions.data() + first, *this, stack.data(), slots.data());
    LSYS_CHECK(ended, first);
}

// Domain

SweepNode SweepCompiler::add(Kind kind,
                             Opcode opcode,
                             std::initializer_list<SweepNode> inputs,
                             SweepOperand operand) {
    Node node;
    node.kind = kind;
    node.opcode = opcode;
    node.operand = operand;
    for (const SweepNode each : inputs) {
        node.inputs[node.input_count++] = each.id;
        const Node& input = nodes_[each.id];
        node.depth = std::max(node.depth, input.is_stored ? 1 : input.depth + 1);
    }
    node.is_stored = node.depth >= kMaxNodeDepth;
    nodes_.push_back(node);
    return {static_cast<std::uint32_t>(nodes_.size() - 1)};
}

SweepNode SweepCompiler::leaf(SweepOperand operand) {
    return add(Kind::Operand, Opcode::End, {}, operand);
}

SweepNode SweepCompiler::literal(float value) {
    code_.constants.push_back(value);
    return leaf({kConstantBase, static_cast<std::uint32_t>(code_.constants.size() - 1)});
}

SweepNode SweepCompiler::formal(std::uint32_t index) {
    const auto source = std::find_if(sources_.begin(), sources_.end(), [index](const Source& each) {
        return index >= each.first && index - each.first < each.count;
    });
    LSYS_CHECK(source != sources_.end(), index);
    return leaf({source->base, index - source->first});
}

SweepNode SweepCompiler::branch_draw(std::uint32_t branch) {
    draws_ = true;
    return leaf(code_.draw(kFirstBranchDraw + branch));
}

SweepNode SweepCompiler::unary(Opcode opcode, SweepNode x) {
    return add(Kind::Unary, opcode, {x});
}

SweepNode SweepCompiler::binary(Opcode opcode, SweepNode x, SweepNode y) {
    return add(Kind::Binary, opcode, {x, y});
}

SweepNode SweepCompiler::curve(std::uint32_t index, SweepNode x) {
    return add(Kind::Curve, Opcode::Curve, {x}, {kConstantBase, index});
}

SweepNode SweepCompiler::mix(SweepNode x, SweepNode y, SweepNode t) {
    return add(Kind::Mix, Opcode::Mix, {x, y, t});
}

SweepNode SweepCompiler::choice(SweepNode x, SweepNode y, SweepNode z) {
    guard_ = guards_.back();
    guards_.pop_back();
    return add(Kind::Choice, Opcode::EndIf, {x, y, z});
}

void SweepCompiler::first_side(SweepNode condition) {
    guards_.push_back(guard_);
    guard_ = guard_ == kNone ? condition.id : binary(Opcode::And, {guard_}, condition).id;
}

void SweepCompiler::second_side(SweepNode condition) {
    const SweepNode is_other = unary(Opcode::Not, condition);
    const std::uint32_t outer = guards_.back();
    guard_ = outer == kNone ? is_other.id : binary(Opcode::And, {outer}, is_other).id;
}

std::optional<float> SweepCompiler::known(std::uint32_t id) const {
    const Node& node = nodes_[id];
    if (node.kind != Kind::Operand || node.operand.base != kConstantBase ||
        node.operand.index == kStepConstant) {
        return std::nullopt;
    }
    return code_.constants[node.operand.index];
}

bool SweepCompiler::random_draw(
    Opcode opcode, SweepNode& x, SweepNode y, std::uint32_t index, const std::uint32_t* /*at*/) {
    draws_ = true;
    const std::optional<float> low = known(x.id);
    const std::optional<float> high = known(y.id);
    const SweepOperand draw = code_.draw(first_draw_ + index);
    const bool is_valid =
        opcode == Opcode::Range && low && high && check_range(*low, *high) == Fault::None;
    if (is_valid) {
        x = add(Kind::Draw, opcode, {x, y}, draw);
        return true;
    }
    const SweepNode guard = guard_ == kNone ? literal(1.0F) : SweepNode{guard_};
    x = add(Kind::Draw, opcode, {x, y, guard}, draw);
    nodes_.back().is_checked = true;
    return true;
}

bool SweepCompiler::take(SweepNode x, const std::uint32_t* /*at*/) {
    taken_.push_back(x);
    return true;
}

// Operations

void SweepCompiler::write(SweepFunction function, SweepOperand x, SweepOperand y, Opcode opcode) {
    if (++written_ % kOperationsPerPause == 0) {
        code_.operations.push_back({sweep_functions::pause(), {}, {}, Opcode::End});
    }
    code_.operations.push_back({function, x, y, opcode});
}

SweepOperand SweepCompiler::store() {
    const SweepOperand slot{kSlotBase, slots_++};
    code_.slot_count = std::max(code_.slot_count, slots_);
    write(sweep_functions::store(), slot);
    return slot;
}

SweepOperand SweepCompiler::operand(std::uint32_t id) {
    if (nodes_[id].kind == Kind::Operand) {
        return nodes_[id].operand;
    }
    load(id);
    return store();
}

void SweepCompiler::count_uses() {
    for (const SweepNode root : taken_) {
        ++nodes_[root.id].uses;
    }
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.is_checked && node.uses == 0) {
            node.uses = 1; // its check may fail even if nothing reads its value
            node.is_stored = true;
        }
        for (std::uint32_t k = 0; node.uses != 0 && k < node.input_count; ++k) {
            ++nodes_[node.inputs[k]].uses;
        }
    }
}

void SweepCompiler::write_taken() {
    slots_ = 0;
    written_ = 0;
    count_uses();
    for (std::uint32_t id = 0; id < nodes_.size(); ++id) {
        if (nodes_[id].kind != Kind::Operand && nodes_[id].uses != 0 &&
            (nodes_[id].uses > 1 || nodes_[id].is_stored)) {
            load(id);
            const SweepOperand slot = store();
            nodes_[id].kind = Kind::Operand;
            nodes_[id].operand = slot;
        }
    }
    for (std::uint32_t i = 0; i < taken_.size(); ++i) {
        load(taken_[i].id);
        if (taken_.size() > 1) {
            write(sweep_functions::emit(), {kConstantBase, i});
        }
    }
    write(sweep_functions::end());
    code_.value_count = std::max(code_.value_count, static_cast<std::uint32_t>(taken_.size()));
    nodes_.clear();
    taken_.clear();
}

void SweepCompiler::load(std::uint32_t id) {
    const Node node = nodes_[id];
    const auto input = [&](std::size_t i) { return node.inputs[i]; };
    switch (node.kind) {
    case Kind::Operand:
        write(sweep_functions::load(), node.operand);
        break;
    case Kind::Unary:
        load(input(0));
        write(sweep_functions::unary(node.opcode), {}, {}, node.opcode);
        break;
    case Kind::Binary:
        load_binary(node);
        break;
    case Kind::Curve:
        load(input(0));
        write(sweep_functions::curve(), node.operand);
        break;
    case Kind::Mix: {
        const SweepOperand x = operand(input(0));
        const SweepOperand y = operand(input(1));
        load(input(2));
        write(sweep_functions::mix(), x, y);
        break;
    }
    case Kind::Choice: {
        const SweepOperand first = operand(input(1));
        const SweepOperand second = operand(input(2));
        load(input(0));
        write(sweep_functions::choose(), first, second);
        break;
    }
    case Kind::Draw:
        load_draw(node);
        break;
    }
}

void SweepCompiler::load_binary(const Node& node) {
    const auto [x, y, unused] = node.inputs;
    const bool has_x = nodes_[x].kind == Kind::Operand;
    const bool has_y = nodes_[y].kind == Kind::Operand;
    if (has_x && has_y) {
        write(sweep_functions::both(node.opcode), operand(x), operand(y), node.opcode);
    } else if (has_x) {
        load(y);
        write(sweep_functions::swapped(node.opcode), operand(x), {}, node.opcode);
    } else {
        const SweepOperand other = operand(y);
        load(x);
        write(sweep_functions::binary(node.opcode), other, {}, node.opcode);
    }
}

void SweepCompiler::load_draw(const Node& node) {
    const SweepOperand x = operand(node.inputs[0]);
    const SweepOperand guard = node.is_checked ? operand(node.inputs[2]) : SweepOperand{};
    load(node.inputs[1]);
    if (node.is_checked) {
        write(sweep_functions::check(), x, guard, node.opcode);
    }
    const bool is_range = node.opcode == Opcode::Range;
    write(is_range ? sweep_functions::range() : sweep_functions::draw(), x, node.operand,
          node.opcode);
}

} // namespace lsys
