// SPDX-License-Identifier: MIT
#include "runtime/derive/derive.h"

#include "grammar/base/contract.h"
#include "runtime/derive/brackets.h"
#include "runtime/derive/impl/derivation_state.h"

#include <optional>
#include <utility>

namespace lsys {

std::optional<Stop> Derivation::State::check_brackets() {
    BracketCounter counter(bytecode);
    const std::optional<std::uint64_t> found =
        word.visit([&](auto codes) { return counter.feed(codes.data(), codes.size()); });
    return found ? fail(unmatched_bracket(bytecode, word.code(*found), *found, age)) : std::nullopt;
}

Derivation::Derivation(const Bytecode& bytecode, DeriveOptions options)
    : state_(std::make_unique<State>(bytecode, std::move(options))) {}

Derivation::~Derivation() = default;
Derivation::Derivation(Derivation&&) noexcept = default;
Derivation& Derivation::operator=(Derivation&&) noexcept = default;

std::optional<Stop> Derivation::start() {
    return state_->run([this]() -> std::optional<Stop> {
        std::optional<Stop> stop = state_->make_plans();
        state_->age = 0;
        if (!stop) {
            stop = state_->make_axiom();
        }
        return stop ? stop : state_->complete_axiom();
    });
}

std::optional<Stop> Derivation::resume(Word word, std::uint32_t age, std::string_view sense_state) {
    LSYS_CHECK(word.code_width() == state_->word.code_width(), word.code_width());
    return state_->run([&] {
        std::optional<Stop> stop = state_->make_plans();
        if (!stop) {
            stop = state_->adopt_saved_word(std::move(word), age);
        }
        return stop ? stop : state_->adopt_sense_state(sense_state);
    });
}

std::string Derivation::sense_state() const {
    const WordSense* const senses = state_->options.senses;
    return senses == nullptr || state_->is_sense.empty() ? std::string() : senses->state();
}

std::optional<Stop> Derivation::step() {
    LSYS_CHECK(state_->passes.has_value());
    return state_->run([this] { return state_->step(); });
}

std::optional<Stop> Derivation::run_to(std::uint32_t age) {
    std::optional<Stop> stop;
    while (!stop && state_->age < age) {
        stop = step();
    }
    return stop;
}

std::optional<Stop> Derivation::derive() {
    std::optional<Stop> stop = start();
    if (!stop) {
        stop = run_to(state_->options.generations);
    }
    return stop ? stop : check_brackets();
}

std::optional<Stop> Derivation::interpret() {
    LSYS_CHECK(state_->passes.has_value());
    return state_->run([this] { return state_->interpret(); });
}

bool Derivation::follow() {
    const std::span<Origin> origins = state_->word.origins();
    LSYS_CHECK(origins.size() == state_->word.module_count(), origins.size());
    if (origins.size() > kNone) {
        return false;
    }
    for (std::uint32_t i = 0; i < origins.size(); ++i) {
        origins[i] = {i, state_->age | kFollowed};
    }
    return true;
}

std::optional<Stop> Derivation::check_brackets() {
    return state_->run([this] { return state_->check_brackets(); });
}

const Word& Derivation::word() const {
    return state_->word;
}
std::uint32_t Derivation::age() const {
    return state_->age;
}
const DerivationEnd& Derivation::end() const {
    return state_->end;
}
const std::vector<float>& Derivation::globals() const {
    return state_->globals;
}
Word Derivation::take_word() {
    return std::exchange(state_->word, Word(state_->word.code_width()));
}

} // namespace lsys
