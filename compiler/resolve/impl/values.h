// SPDX-License-Identifier: MIT
// Makes the values of a Program: shares equal literals and folds constants with the arithmetic of
// the runtime.
#pragma once

#include "compiler/program/program.h"
#include "grammar/base/chunked_vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

class ValueBuilder {
public:
    /// Adds kPoison to `values`. `values` must be empty, and only this object may change it.
    explicit ValueBuilder(ChunkedVector<Value>& values);

    [[nodiscard]] ValueId literal(float value, SourceSpan span);
    /// A value without operands: Formal, Global, Local, Step, Steps.
    [[nodiscard]] ValueId leaf(Opcode opcode, std::uint32_t index, SourceSpan span);
    /// A range or distribution. It is never folded, since each run draws a new number. `second` is
    /// kNoValue for a distribution of one argument.
    [[nodiscard]] ValueId
    draw(Opcode opcode, ValueId first, ValueId second, std::uint32_t number, SourceSpan span);
    /// An operation on one or two values: a literal if all operands are literals, kPoison if an
    /// operand is kPoison.
    [[nodiscard]] ValueId operation(Opcode opcode, ValueId left, ValueId right, SourceSpan span);
    /// arithmetic::mix() of three values.
    [[nodiscard]] ValueId mix(ValueId from, ValueId to, ValueId fraction, SourceSpan span);
    /// `yes` if the condition is not 0, else `no`. A literal condition selects one of the two at
    /// once.
    [[nodiscard]] ValueId choice(ValueId condition, ValueId yes, ValueId no, SourceSpan span);
    /// The value of curve `index` with these points at `x`.
    [[nodiscard]] ValueId
    curve(std::uint32_t index, std::span<const CurveKnot> points, ValueId x, SourceSpan span);
    /// The value of `body`, computed after slot `slot` has been set to `value`.
    [[nodiscard]] ValueId
    with_local(std::uint32_t slot, ValueId value, ValueId body, SourceSpan span);
    /// A copy of `leaf` with another span.
    [[nodiscard]] ValueId leaf_at(ValueId leaf, SourceSpan span);

    [[nodiscard]] std::size_t size() const { return values_.size(); }
    [[nodiscard]] const Value& operator[](ValueId id) const {
        return values_[static_cast<std::size_t>(id)];
    }
    [[nodiscard]] bool is_leaf(ValueId id) const { return (*this)[id].left == kNoValue; }
    [[nodiscard]] bool is_literal(ValueId id) const {
        return id != kPoison && (*this)[id].opcode == Opcode::Literal;
    }

private:
    ValueId add(const Value& value);
    /// Enlarges literals_.
    void grow_table();
    /// Index in literals_ of the literal with these bits, or of the unused entry for it.
    [[nodiscard]] std::size_t slot_of(std::uint32_t bits) const;

    ChunkedVector<Value>& values_;
    std::vector<ValueId> literals_; // hash table with open addressing, by the bits of the literal
    std::size_t literal_count_ = 0; // entries in use of literals_
};

} // namespace lsys
