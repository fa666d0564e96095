// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/values.h"

#include "compiler/bytecode/arithmetic.h"
#include "grammar/base/contract.h"
#include "grammar/base/hash.h"

#include <bit>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

Value node_of(Opcode opcode, SourceSpan span, ValueId left, ValueId right) {
    Value node;
    node.opcode = opcode;
    node.span = span;
    node.left = left;
    node.right = right;
    return node;
}

} // namespace

ValueBuilder::ValueBuilder(ChunkedVector<Value>& values)
    : values_(values), literals_(1024, kNoValue) {
    LSYS_CHECK(values.empty(), values.size());
    Value poison;
    poison.literal = std::nanf("");
    values_.push_back(poison);
}

ValueId ValueBuilder::add(const Value& value) {
    LSYS_CHECK(values_.size() < static_cast<std::size_t>(kNoValue), values_.size());
    values_.push_back(value);
    return static_cast<ValueId>(values_.size() - 1);
}

std::size_t ValueBuilder::slot_of(std::uint32_t bits) const {
    const std::size_t mask = literals_.size() - 1;
    std::size_t slot = (golden_multiple(std::uint64_t{bits}) >> 32) & mask;
    while (literals_[slot] != kNoValue &&
           std::bit_cast<std::uint32_t>((*this)[literals_[slot]].literal) != bits) {
        slot = (slot + 1) & mask;
    }
    return slot;
}

void ValueBuilder::grow_table() {
    const std::vector<ValueId> old =
        std::exchange(literals_, std::vector<ValueId>(literals_.size() * 2, kNoValue));
    for (const ValueId id : old) {
        if (id != kNoValue) {
            literals_[slot_of(std::bit_cast<std::uint32_t>((*this)[id].literal))] = id;
        }
    }
}

ValueId ValueBuilder::literal(float value, SourceSpan span) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    std::size_t slot = slot_of(bits);
    if (literals_[slot] != kNoValue) {
        return literals_[slot];
    }
    if (++literal_count_ * 2 > literals_.size()) {
        grow_table();
        slot = slot_of(bits);
    }
    Value node;
    node.opcode = Opcode::Literal;
    node.span = span;
    node.literal = value;
    literals_[slot] = add(node);
    return literals_[slot];
}

ValueId ValueBuilder::leaf(Opcode opcode, std::uint32_t index, SourceSpan span) {
    Value node;
    node.opcode = opcode;
    node.span = span;
    node.index = index;
    return add(node);
}

ValueId ValueBuilder::draw(
    Opcode opcode, ValueId first, ValueId second, std::uint32_t number, SourceSpan span) {
    if (first == kPoison || second == kPoison) {
        return kPoison;
    }
    Value node = node_of(opcode, span, first, second);
    node.index = number;
    return add(node);
}

ValueId ValueBuilder::operation(Opcode opcode, ValueId left, ValueId right, SourceSpan span) {
    if (left == kPoison || right == kPoison) {
        return kPoison;
    }
    const bool binary = info(opcode).pops == 2;
    if (is_literal(left) && (!binary || is_literal(right))) {
        const float x = (*this)[left].literal;
        return literal(arithmetic::apply(opcode, x, binary ? (*this)[right].literal : 0.0F), span);
    }
    return add(node_of(opcode, span, left, binary ? right : kNoValue));
}

ValueId ValueBuilder::mix(ValueId from, ValueId to, ValueId fraction, SourceSpan span) {
    if (from == kPoison || to == kPoison || fraction == kPoison) {
        return kPoison;
    }
    if (is_literal(from) && is_literal(to) && is_literal(fraction)) {
        return literal(
            arithmetic::mix((*this)[from].literal, (*this)[to].literal, (*this)[fraction].literal),
            span);
    }
    Value node = node_of(Opcode::Mix, span, from, to);
    node.third = fraction;
    return add(node);
}

ValueId ValueBuilder::choice(ValueId condition, ValueId yes, ValueId no, SourceSpan span) {
    if (condition == kPoison || yes == kPoison || no == kPoison) {
        return kPoison;
    }
    if (is_literal(condition)) {
        return (*this)[condition].literal != 0.0F ? yes : no;
    }
    Value node = node_of(Opcode::If, span, yes, no);
    node.third = condition;
    return add(node);
}

ValueId ValueBuilder::curve(std::uint32_t index,
                            std::span<const CurveKnot> points,
                            ValueId x,
                            SourceSpan span) {
    if (x == kPoison) {
        return kPoison;
    }
    if (is_literal(x)) {
        return literal(curve_value(points, (*this)[x].literal), span);
    }
    Value node;
    node.opcode = Opcode::Curve;
    node.span = span;
    node.index = index;
    node.left = x;
    return add(node);
}

ValueId ValueBuilder::with_local(std::uint32_t slot, ValueId value, ValueId body, SourceSpan span) {
    if (value == kPoison || body == kPoison) {
        return kPoison;
    }
    Value node;
    node.opcode = Opcode::SetLocal;
    node.span = span;
    node.index = slot;
    node.left = value;
    node.right = body;
    return add(node);
}

ValueId ValueBuilder::leaf_at(ValueId id, SourceSpan span) {
    if (id == kPoison) {
        return kPoison;
    }
    const Value& value = (*this)[id];
    return value.opcode == Opcode::Literal ? id : leaf(value.opcode, value.index, span);
}

} // namespace lsys
