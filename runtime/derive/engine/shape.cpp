// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/shape.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/interpret.h"

#include <cmath>

namespace lsys {

namespace {

/// A value on the stack of the abstract interpretation.
struct Term {
    ShapeKind kind = ShapeKind::Other;
    float constant = 0.0F;
    AffineTerm affine;
    bool scaled = false;              // has a factor; a second factor would round differently
    bool offset = false;              // has an offset
    std::size_t first_comparison = 0; // index in AffineDomain::comparisons_
    std::size_t comparison_count = 0;
};

Term constant_term(float value) {
    Term term;
    term.kind = ShapeKind::Constant;
    term.constant = value;
    return term;
}

/// The domain of affine terms and of comparisons of them with constants.
class AffineDomain : public UnknownDomain<Term> {
public:
    AffineDomain(const ShapeKnowledge& knowledge, std::vector<ValueShape>& shapes)
        : knowledge_(knowledge), shapes_(shapes) {}

    bool enter() { return ++count_ <= kMaxShapedInstructions; }
    static Term literal(float value) { return constant_term(value); }
    [[nodiscard]] Term formal(std::uint32_t formal) const {
        Term term;
        const std::uint32_t own = formal - knowledge_.own_first;
        if (formal >= knowledge_.own_first && own < knowledge_.own_count) {
            if (knowledge_.folded_arguments != nullptr) {
                return constant_term(knowledge_.folded_arguments[own]);
            }
            term.kind = ShapeKind::Affine;
            term.affine.input = own;
        }
        return term;
    }
    [[nodiscard]] Term global(std::uint32_t index) const {
        return constant_term(knowledge_.globals[index]);
    }
    [[nodiscard]] Term step() const {
        return knowledge_.step ? constant_term(*knowledge_.step) : Term{};
    }
    [[nodiscard]] Term steps() const { return constant_term(knowledge_.steps); }

    Term unary(Opcode opcode, const Term& x) {
        if (x.kind == ShapeKind::Constant) {
            return constant_term(arithmetic::apply(opcode, x.constant, 0.0F));
        }
        if (opcode == Opcode::Negate && x.kind == ShapeKind::Affine && !x.offset) {
            Term term =
                x; // only without an offset: if a sum x is +0, -x is -0, but a term gives +0
            term.affine.scale = -term.affine.scale;
            term.scaled = true;
            return term;
        }
        return opcode == Opcode::Not ? complement(x) : Term{};
    }

    Term binary(Opcode opcode, const Term& x, const Term& y) {
        if (x.kind == ShapeKind::Constant && y.kind == ShapeKind::Constant) {
            return constant_term(arithmetic::apply(opcode, x.constant, y.constant));
        }
        if (x.kind == ShapeKind::Affine && y.kind == ShapeKind::Constant) {
            return with_constant(opcode, x, y.constant, false);
        }
        if (x.kind == ShapeKind::Constant && y.kind == ShapeKind::Affine) {
            return with_constant(opcode, y, x.constant, true);
        }
        return opcode == Opcode::And ? conjunction(x, y) : Term{};
    }

    static Term mix(const Term& x, const Term& y, const Term& t) {
        const bool known = x.kind == ShapeKind::Constant && y.kind == ShapeKind::Constant &&
                           t.kind == ShapeKind::Constant;
        return known ? constant_term(arithmetic::mix(x.constant, y.constant, t.constant)) : Term{};
    }
    /// Conjunctions and negations written with if(). Comparisons stand for their truth value only:
    /// a condition holds for any number but 0.
    Term choice(const Term& x, const Term& y, const Term& z) {
        if (x.kind == ShapeKind::Constant) {
            return x.constant != 0.0F ? y : z;
        }
        if (is_truth(y, true) && is_truth(z, false)) {
            return x.kind == ShapeKind::Comparisons ? x : Term{};
        }
        if (is_truth(y, false) && is_truth(z, true)) {
            return complement(x);
        }
        return is_truth(z, false) ? conjunction(x, y) : Term{};
    }

    bool take(const Term& term, const std::uint32_t* /*at*/) {
        const auto first =
            comparisons_.begin() + static_cast<std::ptrdiff_t>(term.first_comparison);
        shapes_.push_back({term.kind,
                           term.constant,
                           term.affine,
                           {first, first + static_cast<std::ptrdiff_t>(term.comparison_count)}});
        return true;
    }

private:
    /// `x opcode constant`, or `constant opcode x` if swapped.
    Term with_constant(Opcode opcode, const Term& x, float constant, bool swapped) {
        Term term = x;
        if (!std::isfinite(constant)) {
            return {};
        }
        switch (opcode) {
        case Opcode::Multiply:
            if (!x.scaled && !x.offset) {
                term.affine.scale = constant;
                term.scaled = true;
                return term;
            }
            return {};
        case Opcode::Divide:
            if (!swapped && !x.scaled && !x.offset && has_exact_reciprocal(constant)) {
                term.affine.scale = 1.0F / constant;
                term.scaled = true;
                return term;
            }
            return {};
        case Opcode::Add:
            if (!x.offset) {
                term.affine.offset = constant;
                term.offset = true;
                return term;
            }
            return {};
        case Opcode::Subtract:
            if (!x.offset) {
                term.affine.scale = swapped ? -x.affine.scale : x.affine.scale;
                term.affine.offset = swapped ? constant : -constant;
                term.scaled = x.scaled || swapped;
                term.offset = true;
                return term;
            }
            return {};
        default:
            return comparison(opcode, x.affine, constant, swapped);
        }
    }

    /// Whether `x` is a finite constant with the truth value `truth`.
    static bool is_truth(const Term& x, bool truth) {
        return x.kind == ShapeKind::Constant && std::isfinite(x.constant) &&
               (x.constant != 0.0F) == truth;
    }

    /// The conjunction of x and y if both are comparisons stored one after the other, else unknown.
    static Term conjunction(const Term& x, const Term& y) {
        if (x.kind != ShapeKind::Comparisons || y.kind != ShapeKind::Comparisons ||
            x.first_comparison + x.comparison_count != y.first_comparison) {
            return {};
        }
        Term term = x;
        term.comparison_count += y.comparison_count;
        return term;
    }

    /// The negation of `x` if it is a single comparison, else unknown. The sides of a comparison
    /// are never NaN, so exactly one of <, = and > holds.
    Term complement(const Term& x) {
        if (x.kind != ShapeKind::Comparisons || x.comparison_count != 1) {
            return {};
        }
        Comparison opposite = comparisons_[x.first_comparison];
        opposite.accepted ^= Comparison::kLess | Comparison::kEqual | Comparison::kGreater;
        Term term = x;
        term.first_comparison = comparisons_.size();
        comparisons_.push_back(opposite);
        return term;
    }

    Term comparison(Opcode opcode, const AffineTerm& affine, float bound, bool swapped) {
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
        comparisons_.push_back({affine, bound, accepted});
        return term;
    }

    /// Whether dividing by `x` equals multiplying by 1 / x: for powers of two.
    static bool has_exact_reciprocal(float x) {
        int exponent = 0;
        return std::fabs(std::frexp(x, &exponent)) == 0.5F && std::isnormal(1.0F / x);
    }

    const ShapeKnowledge& knowledge_;
    std::vector<ValueShape>& shapes_;
    std::vector<Comparison> comparisons_;
    std::uint32_t count_ = 0; // number of instructions
};

} // namespace

std::vector<ValueShape> shapes_of(const Bytecode& bytecode,
                                  std::uint32_t locals,
                                  std::uint32_t first,
                                  const ShapeKnowledge& knowledge) {
    std::vector<ValueShape> shapes;
    AffineDomain domain(knowledge, shapes);
    std::vector<Term> slots(bytecode.local_count);
    for (const std::uint32_t code : {locals, first}) {
        if (code == kNone) {
            continue;
        }
        std::vector<Term> stack(stack_room(bytecode.instructions, code));
        if (!interpret(bytecode.instructions.data() + code, domain, stack.data(), slots.data())) {
            shapes.clear();
            break;
        }
    }
    return shapes;
}

bool contains(const Bytecode& bytecode, std::uint32_t first, Opcode opcode) {
    if (first == kNone) {
        return false;
    }
    for (const Instruction each : InstructionRange(bytecode.instructions, first)) {
        if (each.opcode == opcode) {
            return true;
        }
    }
    return false;
}

bool contains(const Bytecode& bytecode, const WordTemplate& word, Opcode opcode) {
    return contains(bytecode, word.locals, opcode) || contains(bytecode, word.arguments, opcode);
}

bool has_random_parameters(const Bytecode& bytecode, const WordTemplate& successor) {
    return successor.draw_count != 0 || contains(bytecode, successor, Opcode::BranchDraw);
}

bool uses_formal_outside(const Bytecode& bytecode,
                         std::uint32_t first,
                         std::uint32_t begin,
                         std::uint32_t end) {
    if (first == kNone) {
        return false;
    }
    for (const Instruction each : InstructionRange(bytecode.instructions, first)) {
        if (each.opcode == Opcode::Formal && (each.operand < begin || each.operand >= end)) {
            return true;
        }
    }
    return false;
}

} // namespace lsys
