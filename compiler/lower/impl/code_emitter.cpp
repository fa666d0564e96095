// SPDX-License-Identifier: MIT
#include "compiler/lower/impl/code_emitter.h"

#include "compiler/bytecode/instructions.h"
#include "compiler/bytecode/verify.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/contract.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lsys {

namespace {

/// Maximum stack depth of operands computed from left to right. In deeper expressions the deeper
/// operand is computed first (Sethi and Ullman 1970), so that the depth grows with the logarithm of
/// the size of the expression.
constexpr std::uint32_t kMaxLeftToRightStack = 64;
static_assert(kMaxLeftToRightStack + 32 < kUsualStack);

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
    for (std::size_t i = 0; i < count; ++i) { // operands have lower ids than their users
        const Value& value = program.values[i];
        if (value.left == kNoValue) {
            continue;
        }
        const std::uint32_t left = stack_need(value.left);
        if (value.right == kNoValue) {
            stack_need_[i] = left;
            continue;
        }
        const std::uint32_t right = stack_need(value.right);
        const std::uint32_t left_to_right_need = std::max(left, right + 1);
        switch (value.opcode) {
        case Opcode::If: // the stack holds the condition, then `left`, while `right` is computed
            stack_need_[i] = std::max({stack_need(value.third), left + 1, right + 2});
            break;
        case Opcode::Mix:
            stack_need_[i] = std::max(left_to_right_need, stack_need(value.third) + 2);
            break;
        case Opcode::SetLocal:
            stack_need_[i] = std::max(left, right);
            break;
        default:
            stack_need_[i] = left_to_right_need <= kMaxLeftToRightStack
                                 ? left_to_right_need
                                 : std::min(left_to_right_need, std::max(right, left + 1));
            break;
        }
    }
}

bool CodeEmitter::emits_right_first(const Value& value) const {
    const std::uint32_t left = stack_need(value.left);
    const std::uint32_t right = stack_need(value.right);
    return value.opcode != Opcode::SetLocal && value.opcode != Opcode::Mix &&
           std::max(left, right + 1) > kMaxLeftToRightStack && right > left;
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

void CodeEmitter::end_skip(std::size_t at) {
    const std::size_t words = bytecode_.instructions.size() - at - 1;
    overflowed_ = overflowed_ || words > kMaxOperand;
    bytecode_.instructions[at] = encode(opcode_of(bytecode_.instructions[at]),
                                        static_cast<std::uint32_t>(words) & kMaxOperand);
}

void CodeEmitter::begin_site(std::uint32_t site) {
    if (site == current_site_ || site == kNone) {
        return;
    }
    current_site_ = site;
    const auto here = static_cast<std::uint32_t>(bytecode_.instructions.size());
    std::vector<SiteRange>& ranges = bytecode_.site_ranges;
    if (!ranges.empty() && ranges.back().instruction == here) {
        ranges.back().site = site; // the last range has no instructions: reuse it
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
    case Opcode::Local:
    case Opcode::BranchDraw:
        instruction(value.opcode, value.index);
        return;
    case Opcode::Range:
    case Opcode::Normal:
    case Opcode::Poisson:
    case Opcode::Binomial:
        // Run-time errors of a draw are reported at the text of the draw, other errors at the text
        // of the whole argument or condition.
        if (swapped) {
            instruction(Opcode::Swap);
        }
        begin_site(add_site(value.span));
        instruction(value.opcode, value.index);
        begin_site(site);
        return;
    case Opcode::Curve:
        instruction(Opcode::Curve, value.index);
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
    stop_if_cancelled();
    frames_.push_back({root, Step::Operands, 0});
    while (!frames_.empty()) {
        const Frame frame = frames_.back();
        frames_.pop_back();
        const Value& value = program_.value(frame.value);
        switch (frame.step) {
        case Step::Operands:
            operands(frame.value, value, site);
            break;
        case Step::Operation:
            leaf_or_operation(value, value.right != kNoValue && emits_right_first(value), site);
            break;
        case Step::Store:
            instruction(Opcode::SetLocal, value.index);
            break;
        case Step::If:
        case Step::Else: {
            const bool is_if = frame.step == Step::If;
            instruction(is_if ? Opcode::If : Opcode::Else);
            const std::size_t skip = bytecode_.instructions.size() - 1;
            if (is_if) {
                frames_.push_back({frame.value, Step::Else, skip});
                frames_.push_back({value.left, Step::Operands, 0});
            } else {
                end_skip(frame.skip);
                frames_.push_back({frame.value, Step::EndIf, skip});
                frames_.push_back({value.right, Step::Operands, 0});
            }
            break;
        }
        case Step::EndIf:
            instruction(Opcode::EndIf);
            end_skip(frame.skip);
            break;
        }
    }
}

void CodeEmitter::operands(ValueId id, const Value& value, std::uint32_t site) {
    if (value.left == kNoValue) {
        leaf_or_operation(value, false, site);
        return;
    }
    const auto later = [&](ValueId operand) { frames_.push_back({operand, Step::Operands, 0}); };
    switch (value.opcode) {
    case Opcode::If:
        frames_.push_back({id, Step::If, 0});
        later(value.third);
        return;
    case Opcode::SetLocal:
        later(value.right);
        frames_.push_back({id, Step::Store, 0});
        later(value.left);
        return;
    default:
        break;
    }
    frames_.push_back({id, Step::Operation, 0});
    if (value.opcode == Opcode::Mix) {
        later(value.third);
    }
    const bool swapped = value.right != kNoValue && emits_right_first(value);
    if (value.right != kNoValue) {
        later(swapped ? value.left : value.right);
    }
    later(swapped ? value.right : value.left);
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

std::uint32_t CodeEmitter::locals(std::span<const LocalValue> values) {
    const auto first = static_cast<std::uint32_t>(bytecode_.instructions.size());
    for (std::uint32_t i = 0; i < values.size(); ++i) {
        if (program_.value(values[i].value).left == kNoValue) {
            continue; // a leaf is emitted at each use
        }
        const std::uint32_t site = add_site(program_.value(values[i].value).span);
        begin_site(site);
        expression(values[i].value, site);
        instruction(Opcode::SetLocal, i);
    }
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
