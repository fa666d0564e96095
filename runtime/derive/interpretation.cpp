// SPDX-License-Identifier: MIT
#include "runtime/derive/interpretation.h"

#include "runtime/derive/engine/levels.h"
#include "runtime/derive/engine/stage_depth.h"
#include "runtime/derive/engine/start.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Values that the plan points to: it stores no copies of them.
struct PlanArguments {
    PlanArguments(const Bytecode& program, const InterpretInputs& given)
        : bytecode(program), inputs(given) {}

    const Bytecode& bytecode;
    InterpretInputs inputs;
    std::vector<float> globals;
};

LevelSteps steps_of(const Plan& plan, const InterpretInputs& inputs, const StageDepth& depth) {
    LevelSteps steps;
    steps.passes = &plan;
    steps.seed = inputs.seed;
    steps.first_age = inputs.generations;
    steps.last_age = inputs.generations;
    steps.depth = depth.passes;
    steps.checked = depth.checked;
    steps.first_pass_draw = kFirstInterpretDraw;
    return steps;
}

template <typename C, typename R>
class Interpreter final : public Interpretation {
public:
    Interpreter(std::unique_ptr<const PlanArguments> plan_arguments,
                std::unique_ptr<const Plan> plan,
                bool origins,
                Sink sink)
        : plan_arguments_(std::move(plan_arguments)), plan_(std::move(plan)),
          sink_(std::move(sink)), origins_(origins),
          levels_(steps_of(*plan_,
                           plan_arguments_->inputs,
                           stage_depth(plan_arguments_->bytecode, Stage::Interpret)),
                  {origins, plan_arguments_->inputs.max_bytes, 1,
                   max_stored(plan_arguments_->bytecode), plan_arguments_->inputs.cancelled},
                  [this](const LevelBlock<C>& block) { return emit(block); }) {}

    std::optional<Stop> feed(std::span<const Code> codes,
                             std::span<const float> parameters,
                             std::span<const Origin> origins) override {
        const float* next = parameters.data();
        while (!codes.empty()) {
            const auto block = levels_.first_block();
            if (block.codes == nullptr) {
                return Stop::Limit;
            }
            std::uint64_t count = 0;
            std::uint64_t stored = 0;
            while (count < codes.size() && count < levels_.room_codes()) {
                const std::uint64_t own = plan_->row(codes[count]).stored;
                if (stored + own > levels_.room_parameters()) {
                    break;
                }
                block.codes[count] = static_cast<C>(codes[count]);
                ++count;
                stored += own;
            }
            std::copy_n(next, stored, block.parameters);
            next += stored;
            if (origins_) {
                std::copy_n(origins.begin(), count, block.origins);
                origins = origins.subspan(count);
            }
            codes = codes.subspan(count);
            if (const std::optional<Stop> stop = levels_.push(count)) {
                error_ = std::move(levels_.error());
                return stop;
            }
        }
        return std::nullopt;
    }

    const RuntimeError& error() const override { return error_; }

private:
    static std::uint64_t max_stored(const Bytecode& bytecode) {
        std::uint64_t max_count = 0;
        for (const BytecodeSymbol& symbol : bytecode.symbols) {
            max_count = std::max<std::uint64_t>(max_count, symbol.parameter_count);
        }
        return max_count;
    }

    bool emit(const LevelBlock<C>& block) {
        std::size_t parameters = 0;
        for (const C code : block.codes) {
            parameters += plan_->row(code).stored;
        }
        emitted_.assign(block.codes.begin(), block.codes.end());
        return sink_(emitted_, {block.parameters, parameters},
                     {block.origins, origins_ ? emitted_.size() : 0});
    }

    std::unique_ptr<const PlanArguments> plan_arguments_;
    std::unique_ptr<const Plan> plan_;
    Sink sink_;
    bool origins_;
    Levels<C, R> levels_;
    std::vector<Code> emitted_; // codes of the block given to the sink, widened to Code
    RuntimeError error_;
};

} // namespace

std::unique_ptr<Interpretation> Interpretation::make(const Bytecode& bytecode,
                                                     const InterpretInputs& inputs,
                                                     bool origins,
                                                     Sink sink) {
    if (!bytecode.has(Stage::Interpret)) {
        return nullptr;
    }
    auto plan_arguments = std::make_unique<PlanArguments>(bytecode, inputs);
    // The derivation has already drawn the globals without an error.
    static_cast<void>(draw_globals(bytecode, inputs.seed, plan_arguments->globals));
    plan_arguments->globals.resize(bytecode.globals.size());
    auto plan = std::make_unique<Plan>(bytecode,
                                       PlanInputs{plan_arguments->globals.data(), inputs.seed,
                                                  static_cast<float>(inputs.generations)},
                                       true, Stage::Interpret);
    plan->prepare(inputs.generations);
    return visit_code_type(plan->code_width(), [&](auto code) {
        const std::uint32_t record_width = plan->record_width();
        return visit_record_type(record_width, [&](auto record) -> std::unique_ptr<Interpretation> {
            return std::make_unique<Interpreter<decltype(code), decltype(record)>>(
                std::move(plan_arguments), std::move(plan), origins, std::move(sink));
        });
    });
}

} // namespace lsys
