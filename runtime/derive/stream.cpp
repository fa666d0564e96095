// SPDX-License-Identifier: MIT
#include "runtime/derive/stream.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/derive/brackets.h"
#include "runtime/derive/engine/levels.h"
#include "runtime/derive/engine/origins.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/stage_depth.h"
#include "runtime/derive/engine/start.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kProgressStride = std::uint64_t{1} << 24;

/// Rewrites the axiom through all levels, and passes the modules of the last level to the consumer.
template <typename C, typename R>
class Streamer {
public:
    Streamer(const Bytecode& bytecode,
             const LevelSteps& steps,
             const DeriveOptions& options,
             const StreamConsumer& consumer)
        : plan_(*steps.rewriting), options_(options), consumer_(consumer), brackets_(bytecode),
          bytecode_(bytecode), axiom_(chosen_axiom(bytecode, options.seed)),
          levels_(steps,
                  {options.origins, options.limits.max_bytes, axiom_.word.codes.count,
                   axiom_.word.parameter_count, options.cancelled},
                  [this](const LevelBlock<C>& block) { return emit(block); }) {}

    StreamOutcome run(const std::vector<float>& axiom_parameters) {
        const auto first = levels_.first_block();
        std::optional<Stop> stop = Stop::Limit;
        if (first.codes != nullptr) {
            copy_axiom_codes(bytecode_, axiom_, first.codes);
            std::copy(axiom_parameters.begin(), axiom_parameters.end(), first.parameters);
            if (options_.origins) {
                copy_axiom_origins(axiom_, first.origins);
            }
            stop = levels_.push(axiom_.word.codes.count);
        }
        if (outcome_.end.stop) {
            return std::move(outcome_); // ended by emit()
        }
        outcome_.end.stop = stop;
        if (stop == Stop::Diagnosed) {
            outcome_.end.error = std::move(levels_.error());
        } else if (stop == Stop::Limit) {
            report_limit(LimitKind::Memory, outcome_.modules);
            outcome_.end.limit.predicted_bytes = levels_.held_bytes();
        }
        return std::move(outcome_);
    }

private:
    void report_limit(LimitKind kind, std::uint64_t predicted) {
        LimitReport& limit = outcome_.end.limit;
        limit.kind = kind;
        limit.generation = options_.generations;
        limit.modules = outcome_.modules;
        limit.predicted_modules = predicted;
        limit.exact = false;
        limit.streamed = true;
        outcome_.end.stop = Stop::Limit;
    }

    /// Passes a block of the last word to the consumer.
    bool emit(const LevelBlock<C>& block) {
        const std::uint64_t count = block.codes.size();
        if (count > options_.limits.max_modules - outcome_.modules) {
            report_limit(LimitKind::Modules, outcome_.modules + count);
            return false;
        }
        const std::optional<std::uint64_t> unmatched = brackets_.feed(block.codes.data(), count);
        if (unmatched) {
            outcome_.end.error =
                unmatched_bracket(bytecode_, block.codes[*unmatched],
                                  block.first_position + *unmatched, options_.generations);
            outcome_.end.stop = Stop::Diagnosed;
            return false;
        }
        std::uint64_t parameters = 0;
        if (plan_.has_parameters()) {
            for (const C code : block.codes) {
                parameters += plan_.row(code).stored;
            }
        }
        emitted_.assign(block.codes.begin(), block.codes.end());
        const std::size_t origins = options_.origins ? emitted_.size() : 0;
        if (!consumer_({emitted_, {block.parameters, parameters}, {block.origins, origins}})) {
            outcome_.end.stop = Stop::Cancelled;
            return false;
        }
        const std::uint64_t before = outcome_.modules;
        outcome_.modules += count;
        outcome_.parameters += parameters;
        if (options_.progress && before / kProgressStride != outcome_.modules / kProgressStride) {
            options_.progress(options_.generations, outcome_.modules);
        }
        return true;
    }

    const Plan& plan_;
    const DeriveOptions& options_;
    const StreamConsumer& consumer_;
    BracketCounter brackets_;
    const Bytecode& bytecode_;
    const BytecodeAxiom& axiom_;
    Levels<C, R> levels_;
    std::vector<Code> emitted_; // codes of the block given to the consumer, widened to Code
    StreamOutcome outcome_;
};

StreamOutcome
stream(const Bytecode& bytecode, const DeriveOptions& options, const StreamConsumer& consumer) {
    StreamOutcome outcome;
    std::vector<float> globals;
    std::vector<float> axiom;
    std::optional<RuntimeError> wrong = draw_globals(bytecode, options.seed, globals);
    if (!wrong) {
        wrong = axiom_parameters(bytecode, options.seed, globals, axiom);
    }
    if (wrong) {
        outcome.end.error = std::move(*wrong);
        outcome.end.stop = Stop::Diagnosed;
        return outcome;
    }
    const PlanInputs inputs{globals.data(), options.seed, static_cast<float>(options.generations)};
    const Plan plan(bytecode, inputs, false);
    std::optional<Plan> decomposing;
    LevelSteps steps;
    steps.rewriting = &plan;
    steps.seed = options.seed;
    steps.last_age = options.generations;
    steps.prunes = bytecode.has_cuts();
    const StageDepth depth = stage_depth(bytecode, Stage::Decompose);
    if (depth.passes != 0) {
        decomposing.emplace(bytecode, inputs, false, Stage::Decompose);
        steps.passes = &*decomposing;
        steps.depth = depth.passes;
        steps.checked = depth.checked;
        steps.first_pass_draw = kFirstDecomposeDraw;
    }
    const std::uint32_t record_width =
        std::max(plan.record_width(), decomposing ? decomposing->record_width() : 1);
    return visit_code_type(plan.code_width(), [&](auto code) {
        return visit_record_type(record_width, [&](auto record) {
            return Streamer<decltype(code), decltype(record)>(bytecode, steps, options, consumer)
                .run(axiom);
        });
    });
}

} // namespace

std::optional<std::string> streaming_obstacle(const Bytecode& bytecode) {
    if (bytecode.settings.rewriting != RewritingMode::Parallel) {
        return "`rewriting " + std::string(name_of(bytecode.settings.rewriting)) +
               "` needs the whole word";
    }
    if (bytecode.has_senses()) {
        const auto asking =
            std::find_if(bytecode.symbols.begin(), bytecode.symbols.end(),
                         [](const BytecodeSymbol& symbol) { return symbol.senses(); });
        return "`" + asking->name + "` senses, which needs the whole word";
    }
    for (const Stage stage : {Stage::Down, Stage::Up}) {
        if (bytecode.has(stage)) {
            const std::uint32_t first = bytecode.productions_of(stage).first;
            return "production `" + bytecode.productions[first].name + "` of `" +
                   keyword_of(stage) + "` sweeps the whole word";
        }
    }
    for (const BytecodeProduction& production : bytecode.productions) {
        if (production.has_left || production.has_right) {
            return "production `" + production.name + "` has a context, which needs the whole word";
        }
    }
    return std::nullopt;
}

StreamOutcome derive_streamed(const Bytecode& bytecode,
                              const DeriveOptions& options,
                              const StreamConsumer& consumer) {
    return catch_out_of_memory([&] { return stream(bytecode, options, consumer); },
                               [&] {
                                   StreamOutcome outcome;
                                   outcome.end.stop = Stop::OutOfMemory;
                                   outcome.end.limit.kind = LimitKind::Memory;
                                   outcome.end.limit.generation = options.generations;
                                   outcome.end.limit.streamed = true;
                                   return outcome;
                               });
}

} // namespace lsys
