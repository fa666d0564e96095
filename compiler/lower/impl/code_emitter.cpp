#include "compiler/lower/impl/code_emitter.h"

#include "compiler/bytecode/verify.h"
#include "grammar/base/contract.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lsys {

namespace {

/// Maximum stack depth of operands computed from left to right. In deeper expressions the deeper
/// operand is computed first (Sethi and Ullman 1970), so that the depth grows with the logarithm of
/// the size of the expression.
constexpr std::uint8_t kMaxLeftToRightStack = 64;
static_assert(kMaxLeftToRightStack + 32 < kMaxStack);

bool is_commutative(Opcode opcode) {
    switch (opcode) {
    case Opcode::Add:
    case Opcode::Multiply:
    case Opcode::Equal:
    case Opcode::NotEqual:
    case Opcode::And:
    case Opcode::Or:
        return true;
    default:
        return false;
    }
}

} // namespace

CodeEmitter::CodeEmitter(const Program& program, const SourceMap& sources, Bytecode& bytecode)
    : program_(program), sources_(sources), bytecode_(bytecode) {
    const std::size_t count = program.values.size();
    stack_need_.resize(count, 1);
    for (std::size_t i = 0; i < count; ++i) { // children come before parents
        const Value& value = program.values[i];
        if (value.left == kNoValue) {
            continue;
        }
        const std::uint8_t left = stack_need_[static_cast<std::size_t>(value.left)];
        if (value.right == kNoValue) {
            stack_need_[i] = left;
            continue;
        }
        const std::uint8_t right = stack_need_[static_cast<std::size_t>(value.right)];
        const auto natural = static_cast<std::uint8_t>(std::max<int>(left, right + 1));
        const auto reversed = static_cast<std::uint8_t>(std::max<int>(right, left + 1));
        stack_need_[i] = natural <= kMaxLeftToRightStack ? natural : std::min(natural, reversed);
    }
}

bool CodeEmitter::right_first(const Value& value) const {
    const std::uint8_t left = stack_need_[static_cast<std::size_t>(value.left)];
    const std::uint8_t right = stack_need_[static_cast<std::size_t>(value.right)];
    return std::max<int>(left, right + 1) > kMaxLeftToRightStack && right > left;
}

std::uint32_t CodeEmitter::add_site(SourceSpan span) {
    const LineColumn place = sources_.file(span.file).line_column(span.begin);
    bytecode_.sites.push_back({span, place.line, place.column});
    return static_cast<std::uint32_t>(bytecode_.sites.size() - 1);
}

void CodeEmitter::instruction(Opcode opcode, std::uint32_t operand) {
    overflowed_ = overflowed_ || operand > kMaxOperand;
    bytecode_.instructions.push_back(encode(opcode, operand & kMaxOperand));
}

void CodeEmitter::begin_site(std::uint32_t site) {
    if (site == current_site_ || site == kNone) {
        return;
    }
    current_site_ = site;
    const auto here = static_cast<std::uint32_t>(bytecode_.instructions.size());
    std::vector<SiteRange>& ranges = bytecode_.site_ranges;
    if (!ranges.empty() && ranges.back().instruction == here) {
        ranges.back().site = site; // the last range is empty: reuse it
    } else {
        ranges.push_back({here, site});
    }
}

void CodeEmitter::leaf_or_operation(const Value& value, bool swapped, std::uint32_t site) {
    switch (value.opcode) {
    case Opcode::Literal:
        instruction(Opcode::Literal);
        bytecode_.instructions.push_back(std::bit_cast<std::uint32_t>(value.literal));
        return;
    case Opcode::Formal:
    case Opcode::Global:
    case Opcode::BranchDraw:
        instruction(value.opcode, value.index);
        return;
    case Opcode::Range:
        // Errors of a random range are reported at its braces, others at the whole argument.
        if (swapped) {
            instruction(Opcode::Swap);
        }
        begin_site(add_site(value.span));
        instruction(Opcode::Range, value.index);
        begin_site(site);
        return;
    default:
        if (value.opcode == Opcode::Steps) {
            bytecode_.uses_steps = true;
        }
        if (swapped && !is_commutative(value.opcode)) {
            instruction(Opcode::Swap);
        }
        instruction(value.opcode);
        return;
    }
}

void CodeEmitter::expression(ValueId root, std::uint32_t site) {
    frames_.push_back({root, false});
    while (!frames_.empty()) {
        Frame& frame = frames_.back();
        const Value& value = program_.value(frame.value);
        const bool binary = value.right != kNoValue;
        const bool swapped = binary && right_first(value);
        if (frame.operands_done || value.left == kNoValue) {
            leaf_or_operation(value, swapped, site);
            frames_.pop_back();
            continue;
        }
        frame.operands_done = true;
        if (!binary) {
            frames_.push_back({value.left, false});
        } else if (swapped) {
            frames_.push_back({value.left, false});
            frames_.push_back({value.right, false});
        } else {
            frames_.push_back({value.right, false});
            frames_.push_back({value.left, false});
        }
    }
}

std::uint32_t CodeEmitter::condition(ValueId value, SourceSpan span) {
    const auto first = static_cast<std::uint32_t>(bytecode_.instructions.size());
    const std::uint32_t site = add_site(span);
    begin_site(site);
    expression(value, site);
    instruction(Opcode::Test);
    instruction(Opcode::End);
    return first;
}

std::uint32_t CodeEmitter::arguments(std::span<const ValueId> values) {
    const auto first = static_cast<std::uint32_t>(bytecode_.instructions.size());
    for (const ValueId id : values) {
        const Value& value = program_.value(id);
        // A finite literal cannot fail and needs no place.
        const bool safe = value.opcode == Opcode::Literal && std::isfinite(value.literal);
        const std::uint32_t site = safe ? kNone : add_site(value.span);
        begin_site(site);
        expression(id, site);
        instruction(Opcode::Emit);
    }
    instruction(Opcode::End);
    return first;
}

} // namespace lsys
