// SPDX-License-Identifier: MIT
#include "runtime/derive/impl/derivation_state.h"

namespace lsys {

namespace {

/// Makes the origin of each module its index.
void number_modules(Word& numbered, std::uint32_t age_of_word) {
    std::uint32_t index = 0;
    for (Origin& origin : numbered.origins()) {
        origin = {index++, age_of_word | kFollowed};
    }
}

} // namespace

void Derivation::State::announce(DerivationPass& facts, const Word* current) {
    if (!options.on_pass) {
        return;
    }
    Word& in = current == &word ? word : current == &next ? next : spare;
    number_modules(in, facts.generation);
    facts.in = current;
    facts.out = nullptr;
    options.on_pass(facts);
}

void Derivation::State::report(DerivationPass& facts, const Word* written) const {
    if (options.on_pass) {
        facts.out = written;
        options.on_pass(facts);
    }
}

std::optional<Stop> Derivation::State::pass(Passes& runner,
                                            const PassKeys& keys,
                                            DerivationPass facts,
                                            const Word*& current) {
    facts.generation = keys.generation;
    facts.first_draw = keys.first_draw;
    announce(facts, current);
    Word& out = target_of_pass(current);
    const Word& other = current == &word ? spare : word;
    const std::optional<Stop> stop =
        runner.run(*current, out, keys, plan_bytes() + other.held_bytes());
    if (stop == Stop::Diagnosed) {
        end.error = runner.error();
    } else if (stop == Stop::Limit || stop == Stop::OutOfMemory) {
        end.limit = runner.limit();
        end.limit.modules = word.module_count();
    } else if (!stop) {
        report(facts, &out);
        make_current(out, current);
    }
    return stop;
}

std::optional<Stop>
Derivation::State::rewrite(std::uint64_t first_draw, std::uint32_t rule, const Word*& current) {
    return pass(*passes, {options.seed, age, first_draw}, {.rule = rule}, current);
}

std::optional<Stop> Derivation::State::rewrite_sequentially(const Word*& current) {
    std::optional<Stop> stop;
    for (std::uint32_t rule = 0; rule < rules && !stop; ++rule) {
        plan->select_rule(rule);
        if (passes->may_rewrite_any(*current)) {
            stop = rewrite(kDrawsOfPass * rule, rule, current);
        }
    }
    return stop;
}

std::optional<Stop> Derivation::State::rewrite_by_mode(const Word*& current) {
    if (rules == 0) {
        return std::nullopt;
    }
    plan->prepare(age);
    switch (bytecode.settings.rewriting) {
    case RewritingMode::Parallel:
    case RewritingMode::Leftmost:
        return rewrite(0, kNone, current);
    case RewritingMode::Sequential:
        return rewrite_sequentially(current);
    case RewritingMode::Cyclic:
        plan->select_rule(age % rules);
        return passes->may_rewrite_any(*current) ? rewrite(0, age % rules, current) : std::nullopt;
    }
    return std::nullopt;
}

std::optional<Stop> Derivation::State::prune(const Word*& current) {
    if (!pruner.can_cut()) {
        return std::nullopt;
    }
    const PrunedSize size = pruned_size(pruner, *current);
    if (size.modules == current->module_count()) {
        return std::nullopt;
    }
    DerivationPass facts{.kind = DerivationPass::Kind::Cut, .generation = age};
    announce(facts, current);
    Word& out = target_of_pass(current);
    report_limit(LimitKind::Memory, size.modules,
                 plan->held_bytes() + word.held_bytes() + spare.held_bytes() +
                     out.held_bytes_after(size.modules, size.parameters));
    end.limit.exact = false;
    if (end.limit.predicted_bytes > options.limits.max_bytes) {
        return Stop::Limit;
    }
    if (!out.resize(size.modules, size.parameters)) {
        return Stop::OutOfMemory;
    }
    write_pruned(pruner, *current, out);
    report(facts, &out);
    make_current(out, current);
    passes->discard_census();
    return std::nullopt;
}

std::optional<Stop> Derivation::State::step() {
    if (is_cancelled()) {
        return Stop::Cancelled;
    }
    const Word* current = &word;
    std::optional<Stop> stop = prune(current);
    if (!stop) {
        stop = rewrite_by_mode(current);
    }
    if (!stop) {
        stop = decompose(age + 1, current);
    }
    if (!stop) {
        stop = sense_and_sweep(age + 1, current);
    }
    if (stop) {
        passes->discard_census();
        return stop;
    }
    if (current == &next) {
        std::swap(word, next);
    }
    ++age;
    if (options.progress) {
        options.progress(age, word.module_count());
    }
    return std::nullopt;
}

} // namespace lsys
