// SPDX-License-Identifier: MIT
#include "runtime/derive/impl/derivation_state.h"

#include <algorithm>

namespace lsys {

std::uint64_t Derivation::State::plan_bytes() const {
    return plan->held_bytes() + (decompose_plan ? decompose_plan->held_bytes() : 0) +
           (down ? down->held_bytes() : 0) + (up ? up->held_bytes() : 0);
}

std::optional<Stop> Derivation::State::sense_and_sweep(std::uint32_t word_age,
                                                       const Word*& current) {
    std::optional<Stop> stop = sense(word_age, current);
    if (!stop && down) {
        stop = sweep(*down, word_age, current);
    }
    if (!stop && up) {
        stop = sweep(*up, word_age, current);
    }
    return stop;
}

std::optional<Stop> Derivation::State::sense(std::uint32_t word_age, const Word*& current) {
    const bool asks = !is_sense.empty() && current->visit([this](auto codes) {
        return std::any_of(codes.begin(), codes.end(),
                           [this](auto code) -> bool { return is_sense[code]; });
    });
    if (!asks) {
        return std::nullopt;
    }
    if (is_cancelled()) {
        return Stop::Cancelled;
    }
    DerivationPass facts{.kind = DerivationPass::Kind::Sense, .generation = word_age};
    announce(facts, current);
    Word* changed = nullptr;
    std::optional<Stop> stop = make_changeable(current, changed);
    if (!stop) {
        stop = options.senses->sense(*changed, word_age, end);
    }
    if (!stop) {
        report(facts, changed);
        make_current(*changed, current);
    }
    return stop;
}

std::optional<Stop>
Derivation::State::sweep(Sweep& runner, std::uint32_t word_age, const Word*& current) {
    if (!runner.may_change(*current, word_age)) {
        return std::nullopt;
    }
    DerivationPass facts{.kind = runner.stage() == Stage::Down ? DerivationPass::Kind::Down
                                                               : DerivationPass::Kind::Up,
                         .generation = word_age,
                         .first_draw = runner.first_draw()};
    announce(facts, current);
    Word* changed = nullptr;
    std::optional<Stop> stop = make_changeable(current, changed);
    if (stop) {
        return stop;
    }
    const std::uint64_t others = word.held_bytes() + next.held_bytes() + spare.held_bytes() -
                                 changed->held_bytes() + plan_bytes() - runner.held_bytes();
    stop = runner.run(*changed, word_age, options, others);
    if (stop == Stop::Diagnosed) {
        end.error = runner.error();
        facts.fault = end.error.position;
        report(facts, changed);
    } else if (stop == Stop::Limit || stop == Stop::OutOfMemory) {
        end.limit = runner.limit();
        end.limit.generation = age;
        end.limit.modules = word_age == 0 ? 0 : word.module_count();
    } else if (!stop) {
        report(facts, changed);
        make_current(*changed, current);
    }
    return stop;
}

std::optional<Stop> Derivation::State::make_changeable(const Word* current, Word*& changed) {
    if (current == &next && !options.on_pass) {
        changed = &next;
        return std::nullopt;
    }
    Word& copy = target_of_pass(current);
    const Word& other = current == &word ? spare : word;
    report_limit(LimitKind::Memory, current->module_count(),
                 plan_bytes() + current->held_bytes() + other.held_bytes() +
                     copy.held_bytes_after(current->module_count(), current->parameter_count()));
    if (end.limit.predicted_bytes > options.limits.max_bytes) {
        return Stop::Limit;
    }
    if (!copy.resize(current->module_count(), current->parameter_count())) {
        return Stop::OutOfMemory;
    }
    std::copy(current->code_bytes().begin(), current->code_bytes().end(),
              copy.code_bytes().begin());
    std::copy(current->parameters().begin(), current->parameters().end(),
              copy.parameters().begin());
    std::copy(current->origins().begin(), current->origins().end(), copy.origins().begin());
    changed = &copy;
    return std::nullopt;
}

} // namespace lsys
