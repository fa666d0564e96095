#include "runtime/derive/engine/shape.h"

#include "compiler/bytecode/arithmetic.h"

#include <bit>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

/// A value on the stack of the run on unknown inputs.
struct Term {
    ShapeKind kind = ShapeKind::Other;
    float constant = 0.0F;
    AffineTerm lane;
    bool scaled = false; // the lane multiplies, so a further factor would round differently
    bool offset = false; // the lane adds
    std::size_t first_comparison = 0;
    std::size_t comparison_count = 0;
};

Term constant_term(float value) {
    Term term;
    term.kind = ShapeKind::Constant;
    term.constant = value;
    return term;
}

class Shaper {
public:
    explicit Shaper(const ShapeKnowledge& knowledge) : knowledge_(knowledge) {}

    void push_formal(std::uint32_t formal) {
        Term term;
        const std::uint32_t own = formal - knowledge_.own_first;
        if (formal >= knowledge_.own_first && own < knowledge_.own_count) {
            if (knowledge_.own_constants != nullptr) {
                term = constant_term(knowledge_.own_constants[own]);
            } else {
                term.kind = ShapeKind::Affine;
                term.lane.input = own;
            }
        }
        stack_.push_back(term);
    }
    void push_constant(float value) { stack_.push_back(constant_term(value)); }
    void push_unknown() { stack_.emplace_back(); }

    void unary(Opcode opcode) {
        const Term x = pop();
        if (x.kind == ShapeKind::Constant) {
            push_constant(arithmetic::apply(opcode, x.constant, 0.0F));
        } else if (opcode == Opcode::Negate && x.kind == ShapeKind::Affine && !x.offset) {
            Term term = x; // with an offset, a sum of +0 would have to become -0
            term.lane.scale = -term.lane.scale;
            term.scaled = true;
            stack_.push_back(term);
        } else {
            push_unknown();
        }
    }

    void binary(Opcode opcode) {
        const Term y = pop();
        const Term x = pop();
        if (x.kind == ShapeKind::Constant && y.kind == ShapeKind::Constant) {
            push_constant(arithmetic::apply(opcode, x.constant, y.constant));
        } else if (x.kind == ShapeKind::Affine && y.kind == ShapeKind::Constant) {
            stack_.push_back(with_constant(opcode, x, y.constant, false));
        } else if (x.kind == ShapeKind::Constant && y.kind == ShapeKind::Affine) {
            stack_.push_back(with_constant(opcode, y, x.constant, true));
        } else if (opcode == Opcode::And && x.kind == ShapeKind::Comparisons &&
                   y.kind == ShapeKind::Comparisons &&
                   x.first_comparison + x.comparison_count == y.first_comparison) {
            Term term = x;
            term.comparison_count += y.comparison_count;
            stack_.push_back(term);
        } else {
            push_unknown();
        }
    }

    void range() {
        stack_.pop_back();
        stack_.back() = {};
    }
    void swap() { std::swap(stack_[stack_.size() - 1], stack_[stack_.size() - 2]); }

    ValueShape take() {
        const Term term = pop();
        ValueShape shape;
        shape.kind = term.kind;
        shape.constant = term.constant;
        shape.affine = term.lane;
        const auto begin =
            comparisons_.begin() + static_cast<std::ptrdiff_t>(term.first_comparison);
        shape.comparisons.assign(begin, begin + static_cast<std::ptrdiff_t>(term.comparison_count));
        return shape;
    }

private:
    Term pop() {
        const Term term = stack_.back();
        stack_.pop_back();
        return term;
    }

    /// `lane opcode constant`, or `constant opcode lane` if swapped.
    Term with_constant(Opcode opcode, const Term& lane, float constant, bool swapped) {
        Term term = lane;
        if (!std::isfinite(constant)) {
            return {};
        }
        switch (opcode) {
        case Opcode::Multiply:
            if (!lane.scaled && !lane.offset) {
                term.lane.scale = constant;
                term.scaled = true;
                return term;
            }
            return {};
        case Opcode::Divide:
            if (!swapped && !lane.scaled && !lane.offset && has_exact_reciprocal(constant)) {
                term.lane.scale = 1.0F / constant;
                term.scaled = true;
                return term;
            }
            return {};
        case Opcode::Add:
            if (!lane.offset) {
                term.lane.offset = constant;
                term.offset = true;
                return term;
            }
            return {};
        case Opcode::Subtract:
            if (!lane.offset) {
                term.lane.scale = swapped ? -lane.lane.scale : lane.lane.scale;
                term.lane.offset = swapped ? constant : -constant;
                term.scaled = lane.scaled || swapped;
                term.offset = true;
                return term;
            }
            return {};
        default:
            return comparison(opcode, lane.lane, constant, swapped);
        }
    }

    Term comparison(Opcode opcode, const AffineTerm& lane, float bound, bool swapped) {
        std::uint32_t accepted = 0;
        switch (opcode) {
        case Opcode::Less:
            accepted = swapped ? Comparison::kGreater : Comparison::kLess;
            break;
        case Opcode::LessEqual:
            accepted = (swapped ? Comparison::kGreater : Comparison::kLess) | Comparison::kEqual;
            break;
        case Opcode::Greater:
            accepted = swapped ? Comparison::kLess : Comparison::kGreater;
            break;
        case Opcode::GreaterEqual:
            accepted = (swapped ? Comparison::kLess : Comparison::kGreater) | Comparison::kEqual;
            break;
        case Opcode::Equal:
            accepted = Comparison::kEqual;
            break;
        case Opcode::NotEqual:
            accepted = Comparison::kLess | Comparison::kGreater;
            break;
        default:
            return {};
        }
        Term term;
        term.kind = ShapeKind::Comparisons;
        term.first_comparison = comparisons_.size();
        term.comparison_count = 1;
        comparisons_.push_back({lane, bound, accepted});
        return term;
    }

    /// Then dividing and multiplying by the reciprocal are one operation.
    static bool has_exact_reciprocal(float x) {
        int exponent = 0;
        return std::fabs(std::frexp(x, &exponent)) == 0.5F && std::isnormal(1.0F / x);
    }

    const ShapeKnowledge& knowledge_;
    std::vector<Term> stack_;
    std::vector<Comparison> comparisons_;
};

} // namespace

std::vector<ValueShape>
shapes_of(const Bytecode& bytecode, std::uint32_t first, const ShapeKnowledge& knowledge) {
    std::vector<ValueShape> shapes;
    Shaper shaper(knowledge);
    const std::uint32_t* at = bytecode.instructions.data() + first;
    for (std::uint32_t count = 0; count < kMaxShapedInstructions; ++count, ++at) {
        const auto opcode = static_cast<Opcode>(*at & 0xFF);
        const std::uint32_t operand = *at >> 8;
        switch (opcode) {
        case Opcode::Literal:
            shaper.push_constant(std::bit_cast<float>(*++at));
            break;
        case Opcode::Formal:
            shaper.push_formal(operand);
            break;
        case Opcode::Global:
            shaper.push_constant(knowledge.globals[operand]);
            break;
        case Opcode::Step:
            if (knowledge.step) {
                shaper.push_constant(*knowledge.step);
            } else {
                shaper.push_unknown();
            }
            break;
        case Opcode::Steps:
            shaper.push_constant(knowledge.steps);
            break;
        case Opcode::Swap:
            shaper.swap();
            break;
        case Opcode::Range:
            shaper.range();
            break;
        case Opcode::BranchDraw:
            shaper.push_unknown();
            break;
        case Opcode::Emit:
        case Opcode::Test:
            shapes.push_back(shaper.take());
            break;
        case Opcode::End:
            return shapes;
        default:
            if (info(opcode).pops == 2) {
                shaper.binary(opcode);
            } else {
                shaper.unary(opcode);
            }
            break;
        }
    }
    return {};
}

bool contains(const Bytecode& bytecode, std::uint32_t first, Opcode opcode) {
    for (const std::uint32_t* at = bytecode.instructions.data() + first;; ++at) {
        const auto found = static_cast<Opcode>(*at & 0xFF);
        if (found == opcode) {
            return true;
        }
        if (found == Opcode::End) {
            return false;
        }
        if (found == Opcode::Literal) {
            ++at;
        }
    }
}

bool is_drawn(const Bytecode& bytecode, const WordTemplate& successor) {
    return successor.draw_count != 0 ||
           (successor.arguments != kNone &&
            contains(bytecode, successor.arguments, Opcode::BranchDraw));
}

bool uses_formal_outside(const Bytecode& bytecode,
                         std::uint32_t first,
                         std::uint32_t begin,
                         std::uint32_t end) {
    if (first == kNone) {
        return false;
    }
    for (const std::uint32_t* at = bytecode.instructions.data() + first;; ++at) {
        const auto opcode = static_cast<Opcode>(*at & 0xFF);
        const std::uint32_t operand = *at >> 8;
        if (opcode == Opcode::Formal && (operand < begin || operand >= end)) {
            return true;
        }
        if (opcode == Opcode::End) {
            return false;
        }
        if (opcode == Opcode::Literal) {
            ++at;
        }
    }
}

} // namespace lsys
