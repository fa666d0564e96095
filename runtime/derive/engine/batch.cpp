// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/batch.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/curve.h"
#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/interpret.h"
#include "runtime/base/random.h"
#include "runtime/derive/engine/eval.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

/// Programs that need more rows than this (64 KiB per thread) are evaluated module by module.
constexpr std::size_t kMaxRows = 256;
/// Min modules of a batch that is run in rows, filled up with copies of its last module. Smaller
/// batches are evaluated module by module.
constexpr std::size_t kMinBatch = 24;
constexpr std::uint64_t kDrawsPerBlock = 4;

std::size_t rows_of(const BatchProgram& program) {
    return std::size_t{program.formal_rows} + program.stack_rows + program.slot_rows;
}

/// For each module of a batch: all bits set if the current value is computed for it, else 0.
using Mask = std::array<std::int32_t, kLanes>;

std::int32_t mask_of(bool is_set) {
    return is_set ? -1 : 0;
}

/// A batch to run.
struct BatchRun {
    const Bytecode& bytecode;
    const BatchInputs& inputs;
    const BatchProgram& program;
    const BatchModules& modules;
    Lanes* rows = nullptr; // the rows of formals already have their values
};

/// Calls visit(i) for every lane. For loops that have no vector form, in steps of eight, so that
/// the compiler unrolls them.
template <typename Visit>
[[gnu::always_inline]] inline void for_each_lane(Visit visit) {
    constexpr std::size_t kStep = 8;
    for (std::size_t first = 0; first < kLanes; first += kStep) {
        for (std::size_t i = 0; i < kStep; ++i) {
            visit(first + i);
        }
    }
}

/// The Domain (compiler/bytecode/interpret.h) whose values are rows of numbers. Both sides of a
/// choice are computed for all modules. The mask says which modules need the current side;
/// distributions and functions without a vector form are computed for these modules only.
class RowsOfNumbers : public UnknownDomain<Lanes> {
public:
    // NOLINTNEXTLINE: units_ is set with block_
    explicit RowsOfNumbers(const BatchRun& batch) : batch_(batch) { mask_.fill(mask_of(true)); }

    /// Whether any module has an invalid random range or distribution.
    [[nodiscard]] bool is_faulty() const {
        std::int32_t any = 0;
        for (const std::int32_t fault : faults_) {
            any |= fault;
        }
        return any != 0;
    }

    [[gnu::always_inline]] static Lanes literal(float value) {
        Lanes lanes;
        lanes.values.fill(value);
        return lanes;
    }
    [[nodiscard]] const Lanes& formal(std::uint32_t index) const { return batch_.rows[index]; }
    [[nodiscard]] Lanes global(std::uint32_t index) const {
        return literal(batch_.inputs.globals[index]);
    }
    [[nodiscard]] Lanes step() const {
        return literal(static_cast<float>(batch_.inputs.generation));
    }
    [[nodiscard]] Lanes steps() const { return literal(batch_.inputs.steps); }
    [[nodiscard]] Lanes branch_draw(std::uint32_t branch) {
        return units(kFirstBranchDraw + branch);
    }

    [[gnu::always_inline]] Lanes unary(Opcode opcode, const Lanes& x) const {
        switch (opcode) {
        case Opcode::Negate:
            return each(x, [](float value) { return -value; });
        case Opcode::Not:
            return each(x, [](float value) { return arithmetic::logical_not(value); });
        case Opcode::Abs:
            return each(x, [](float value) { return std::fabs(value); });
        case Opcode::Sign:
            return each(x, [](float value) { return arithmetic::sign(value); });
        case Opcode::Sqrt:
            return each(x, [](float value) { return std::sqrt(value); });
        default:
            return each_taken(x, x, [opcode](float value, float /*same*/) {
                return arithmetic::apply(opcode, value, 0.0F);
            });
        }
    }

    [[gnu::always_inline]] Lanes binary(Opcode opcode, const Lanes& x, const Lanes& y) const {
        switch (opcode) {
        case Opcode::Multiply:
            return each(x, y, [](float a, float b) { return a * b; });
        case Opcode::Divide:
            return each(x, y, [](float a, float b) { return a / b; });
        case Opcode::Add:
            return each(x, y, [](float a, float b) { return a + b; });
        case Opcode::Subtract:
            return each(x, y, [](float a, float b) { return a - b; });
        case Opcode::Less:
            return each(x, y, [](float a, float b) { return arithmetic::truth(a < b); });
        case Opcode::LessEqual:
            return each(x, y, [](float a, float b) { return arithmetic::truth(a <= b); });
        case Opcode::Greater:
            return each(x, y, [](float a, float b) { return arithmetic::truth(a > b); });
        case Opcode::GreaterEqual:
            return each(x, y, [](float a, float b) { return arithmetic::truth(a >= b); });
        case Opcode::Equal:
            return each(x, y, [](float a, float b) { return arithmetic::truth(a == b); });
        case Opcode::NotEqual:
            return each(x, y, [](float a, float b) { return arithmetic::truth(a != b); });
        case Opcode::And:
            return each(x, y, [](float a, float b) { return arithmetic::logical_and(a, b); });
        case Opcode::Or:
            return each(x, y, [](float a, float b) { return arithmetic::logical_or(a, b); });
        case Opcode::Min:
            return each(x, y, [](float a, float b) { return arithmetic::minimum(a, b); });
        case Opcode::Max:
            return each(x, y, [](float a, float b) { return arithmetic::maximum(a, b); });
        default:
            return each_taken(
                x, y, [opcode](float a, float b) { return arithmetic::apply(opcode, a, b); });
        }
    }

    [[nodiscard]] Lanes curve(std::uint32_t index, const Lanes& x) const {
        const std::span<const CurveKnot> points = batch_.bytecode.curves[index].points;
        return each_taken(
            x, x, [points](float value, float /*same*/) { return curve_value(points, value); });
    }
    [[gnu::always_inline]] static Lanes mix(const Lanes& x, const Lanes& y, const Lanes& t) {
        Lanes result;
        for (std::size_t i = 0; i < kLanes; ++i) {
            result.values[i] = arithmetic::mix(x.values[i], y.values[i], t.values[i]);
        }
        return result;
    }

    void first_side(const Lanes& condition) {
        outer_.push_back(mask_);
        for (std::size_t i = 0; i < kLanes; ++i) {
            mask_[i] &= mask_of(condition.values[i] != 0.0F);
        }
    }
    void second_side(const Lanes& condition) {
        for (std::size_t i = 0; i < kLanes; ++i) {
            mask_[i] = outer_.back()[i] & mask_of(condition.values[i] == 0.0F);
        }
    }
    [[gnu::always_inline]] Lanes choice(const Lanes& x, const Lanes& y, const Lanes& z) {
        mask_ = outer_.back();
        outer_.pop_back();
        Lanes result;
        for (std::size_t i = 0; i < kLanes; ++i) {
            result.values[i] = x.values[i] != 0.0F ? y.values[i] : z.values[i];
        }
        return result;
    }

    [[gnu::always_inline]] bool random_draw(
        Opcode opcode, Lanes& x, const Lanes& y, std::uint32_t index, const std::uint32_t* /*at*/) {
        const Lanes& u = units(batch_.inputs.first_draw + batch_.program.choice_draws + index);
        if (opcode == Opcode::Range) {
            draw_ranges(x, y, u);
        } else {
            draw_distribution(opcode, x, y, u);
        }
        return true;
    }
    bool take(const Lanes& x, const std::uint32_t* /*at*/) {
        for_each_lane([&](std::size_t i) { batch_.modules.out[i][taken_] = x.values[i]; });
        ++taken_;
        return true;
    }

private:
    template <typename Function>
    [[gnu::always_inline]] static Lanes each(const Lanes& x, Function function) {
        Lanes result;
        for (std::size_t i = 0; i < kLanes; ++i) {
            result.values[i] = function(x.values[i]);
        }
        return result;
    }
    template <typename Function>
    [[gnu::always_inline]] static Lanes each(const Lanes& x, const Lanes& y, Function function) {
        Lanes result;
        for (std::size_t i = 0; i < kLanes; ++i) {
            result.values[i] = function(x.values[i], y.values[i]);
        }
        return result;
    }
    /// each() for the lanes of mask_ alone; the other lanes become 0.
    template <typename Function>
    [[nodiscard]] Lanes each_taken(const Lanes& x, const Lanes& y, Function function) const {
        Lanes result;
        for (std::size_t i = 0; i < kLanes; ++i) {
            result.values[i] = mask_[i] != 0 ? function(x.values[i], y.values[i]) : 0.0F;
        }
        return result;
    }

    /// The draw with number `number` of each module.
    const Lanes& units(std::uint64_t number) {
        const std::uint64_t block = number / kDrawsPerBlock;
        if (block != block_) {
            block_ = block;
            const DrawKey key{batch_.inputs.seed, batch_.inputs.generation,
                              static_cast<std::uint32_t>(block), 0};
            draw_all_units(key, batch_.modules.positions.data(), kLanes, units_[0].values.data(),
                           kLanes);
        }
        return units_[number % kDrawsPerBlock];
    }

    /// Replaces `x` by draw_in_range(x, y, u).
    [[gnu::always_inline]] void draw_ranges(Lanes& x, const Lanes& y, const Lanes& u) {
        Lanes result;
        std::int32_t at_end = 0; // set if any result was rounded to the end of its range
        for (std::size_t i = 0; i < kLanes; ++i) {
            const float low = x.values[i];
            const float high = y.values[i];
            const float width = high - low; // not finite if `low` or `high` is not
            const float value = low + width * u.values[i];
            faults_[i] |= mask_[i] & ~(mask_of(width >= 0.0F) & mask_of(width < HUGE_VALF));
            at_end |= mask_of(value >= high);
            result.values[i] = value;
        }
        if (at_end != 0) {
            for (std::size_t i = 0; i < kLanes; ++i) {
                result.values[i] = draw_in_range(x.values[i], y.values[i], u.values[i]);
            }
        }
        x = result;
    }

    void draw_distribution(Opcode opcode, Lanes& x, const Lanes& y, const Lanes& u) {
        for (std::size_t i = 0; i < kLanes; ++i) {
            if (mask_[i] == 0) {
                continue;
            }
            if (check_distribution(opcode, x.values[i], y.values[i]) != DistributionFault::None) {
                faults_[i] = -1;
            } else {
                x.values[i] = draw_from(opcode, x.values[i], y.values[i], u.values[i]);
            }
        }
    }

    const BatchRun& batch_;
    std::size_t taken_ = 0; // parameters written
    Mask mask_;
    Mask faults_{}; // all bits set for a module with an invalid random range or distribution
    std::vector<Mask> outer_; // mask_ before each choice that is being computed, outermost first
    std::uint64_t block_ = ~std::uint64_t{0}; // block of draws in units_; ~0: none yet
    std::array<Lanes, kDrawsPerBlock> units_; // the draws of block_
};

/// Runs a batch; returns whether a random range or distribution is invalid.
[[gnu::always_inline]] inline bool run_inline(const BatchRun& batch) {
    RowsOfNumbers rows(batch);
    const WordTemplate& successor = batch.bytecode.productions[batch.program.production].successor;
    Lanes* const stack = batch.rows + batch.program.formal_rows;
    for (const std::uint32_t code : {successor.locals, successor.arguments}) {
        if (code != kNone) {
            static_cast<void>(interpret(batch.bytecode.instructions.data() + code, rows, stack,
                                        stack + batch.program.stack_rows));
        }
    }
    return rows.is_faulty();
}

bool run_plain(const BatchRun& batch) {
    return run_inline(batch);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] bool run_avx2(const BatchRun& batch) {
    return run_inline(batch);
}

const auto run_batch = __builtin_cpu_supports("avx2") != 0 ? run_avx2 : run_plain;
#else
constexpr auto run_batch = run_plain;
#endif

} // namespace

std::optional<BatchProgram>
batch_program(const Bytecode& bytecode, std::uint32_t production, bool gathers) {
    const WordTemplate& successor = bytecode.productions[production].successor;
    BatchProgram program;
    program.production = production;
    program.gathers = gathers;
    program.choice_draws = bytecode.productions[production].stochastic &&
                                   bytecode.settings.choice == ChoiceScope::Module
                               ? 1
                               : 0;
    const std::span<const std::uint32_t> words = bytecode.instructions;
    for (const std::uint32_t code : {successor.locals, successor.arguments}) {
        if (code == kNone) {
            continue;
        }
        for (const Instruction each : InstructionRange(words, code)) {
            if (each.opcode == Opcode::Formal) {
                program.formals.push_back(each.operand);
                program.formal_rows = std::max(program.formal_rows, each.operand + 1);
            }
        }
        program.stack_rows =
            std::max(program.stack_rows, static_cast<std::uint32_t>(stack_room(words, code)));
        program.slot_rows =
            std::max(program.slot_rows, static_cast<std::uint32_t>(slot_count(words, code)));
    }
    std::sort(program.formals.begin(), program.formals.end());
    program.formals.erase(std::unique(program.formals.begin(), program.formals.end()),
                          program.formals.end());
    if (rows_of(program) > kMaxRows) {
        return std::nullopt;
    }
    return program;
}

void Batches::add_copy(std::uint32_t index,
                       const float* formals,
                       std::uint64_t position,
                       float* out) {
    const std::size_t size = programs_[index].formal_rows;
    Queue& queue = queues_[index];
    queue.copies.resize(size * kLanes);
    // Runs a full batch before the next batch overwrites its copies.
    if (queue.count == kLanes) {
        make_room(index);
    }
    float* const copy = queue.copies.data() + queue.count * size;
    std::copy_n(formals, size, copy);
    add(index, copy, position, out);
}

void Batches::make_room(std::uint32_t index) {
    Queue& queue = queues_[index];
    if (queue.modules != nullptr) {
        run(index);
    } else {
        queue.modules = std::make_unique<BatchModules>();
        queue.count = 0;
    }
}

bool Batches::finish() {
    for (std::uint32_t i = 0; i < queues_.size(); ++i) {
        if (queues_[i].modules != nullptr) {
            run(i);
        }
    }
    return !faulty_;
}

void Batches::run(std::uint32_t index) {
    const BatchProgram& program = programs_[index];
    BatchModules& modules = *queues_[index].modules;
    const std::size_t count = std::exchange(queues_[index].count, 0);
    if (count < kMinBatch) {
        run_each(program, modules, count);
        return;
    }
    for (std::size_t i = count; i < kLanes; ++i) {
        modules.formals[i] = modules.formals[count - 1];
        modules.positions[i] = modules.positions[count - 1];
        modules.out[i] = modules.out[count - 1];
    }
    rows_.resize(std::max(rows_.size(), rows_of(program)));
    for (const std::uint32_t formal : program.formals) {
        Lanes& row = rows_[formal];
        for_each_lane([&](std::size_t i) { row.values[i] = modules.formals[i][formal]; });
    }
    faulty_ = run_batch({bytecode_, inputs_, program, modules, rows_.data()}) || faulty_;
}

void Batches::run_each(const BatchProgram& program,
                       const BatchModules& modules,
                       std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const EvalFrame frame{modules.formals[i], inputs_.globals,
                              static_cast<float>(inputs_.generation), inputs_.steps};
        RangeDraws draws =
            RangeDraws::of_module(inputs_.seed, inputs_.generation, modules.positions[i],
                                  inputs_.first_draw + program.choice_draws);
        EvalFault fault;
        faulty_ = !evaluate(bytecode_, bytecode_.productions[program.production].successor, frame,
                            &draws, modules.out[i], fault) ||
                  faulty_;
    }
}

} // namespace lsys
