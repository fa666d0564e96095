// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/depth_limit.h"
#include "runtime/derive/impl/derivation_state.h"

namespace lsys {

namespace {

/// The error for the first module that a production of the plan's stage still matches, if any.
std::optional<RuntimeError>
unfinished(const Plan& stage_plan, const Word& in, const PassKeys& keys) {
    return visit_view(in, [&](const auto& view) -> std::optional<RuntimeError> {
        Chooser chooser(stage_plan, keys, view, nullptr);
        const std::optional<ModulePlace> place = find_match(stage_plan, chooser, view);
        if (!place) {
            return std::nullopt;
        }
        return too_deep(stage_plan, chooser, keys, view, *place);
    });
}

} // namespace

std::optional<Stop> Derivation::State::decompose(std::uint32_t word_age, const Word*& current) {
    if (!decompose_plan) {
        return std::nullopt;
    }
    decompose_plan->prepare(word_age);
    decompose_passes->discard_census();
    PassKeys keys{options.seed, word_age, kFirstDecomposeDraw, true};
    for (std::uint32_t done = 0; decompose_passes->may_rewrite_any(*current); ++done) {
        std::optional<RuntimeError> matching = unfinished(*decompose_plan, *current, keys);
        if (!matching) {
            break;
        }
        if (done == depth.passes) {
            return depth.checked ? fail(std::move(*matching)) : std::nullopt;
        }
        const DerivationPass facts{.kind = DerivationPass::Kind::Decompose, .number = done};
        if (const std::optional<Stop> stop = pass(*decompose_passes, keys, facts, current)) {
            end.limit.generation = age;
            // While the axiom is decomposed, no word is complete yet.
            end.limit.modules = word_age == 0 ? 0 : end.limit.modules;
            return stop;
        }
        keys.first_draw += kDrawsOfPass;
        passes->discard_census();
    }
    return std::nullopt;
}

std::optional<Stop> Derivation::State::interpret() {
    const StageDepth drawn = stage_depth(bytecode, Stage::Interpret);
    if (drawn.passes == 0) {
        return std::nullopt;
    }
    Plan drawing(bytecode, plan_inputs(), true, Stage::Interpret);
    drawing.prepare(age);
    Passes runner(drawing, options);
    PassKeys keys{options.seed, age, kFirstInterpretDraw, true};
    const Word* current = &word;
    for (std::uint32_t done = 0; runner.may_rewrite_any(*current); ++done) {
        std::optional<RuntimeError> matching = unfinished(drawing, *current, keys);
        if (!matching) {
            break;
        }
        if (done == drawn.passes) {
            if (drawn.checked) {
                return fail(std::move(*matching));
            }
            break;
        }
        const DerivationPass facts{.kind = DerivationPass::Kind::Interpret, .number = done};
        if (const std::optional<Stop> stop = pass(runner, keys, facts, current)) {
            return stop;
        }
        keys.first_draw += kDrawsOfPass;
    }
    if (current == &next) {
        std::swap(word, next);
    }
    return std::nullopt;
}

} // namespace lsys
