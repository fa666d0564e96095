// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/levels.h"

#include "grammar/base/contract.h"
#include "runtime/derive/engine/count.h"
#include "runtime/derive/engine/depth_limit.h"
#include "runtime/derive/engine/faults.h"
#include "runtime/derive/engine/instantiate.h"
#include "runtime/derive/engine/write.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// Room of a block, unless templates need more.
constexpr std::uint64_t kMaxBlock = 4096; // max modules
constexpr std::uint64_t kMinBlock = 32;   // min modules
/// Bytes of the blocks of all levels together, unless templates need more.
constexpr std::uint64_t kBlocksBytes = std::uint64_t{8} << 20;

} // namespace

template <typename C, typename R>
Levels<C, R>::Levels(const LevelSteps& steps, const LevelOptions& options, Sink sink)
    : steps_(steps), options_(options), sink_(std::move(sink)), last_(steps.count()) {
    std::uint64_t max_codes = options.min_codes;
    std::uint64_t max_parameters = options.min_parameters;
    bool has_parameters = false;
    for (const Plan* const plan : {steps.rewriting, steps.passes}) {
        if (plan == nullptr) {
            continue;
        }
        has_parameters = has_parameters || plan->has_parameters();
        for (const Entry& entry : plan->entries()) {
            max_codes = std::max<std::uint64_t>(max_codes, entry.code_count);
            max_parameters = std::max<std::uint64_t>(max_parameters, entry.parameter_count);
        }
    }
    for (const Plan* const plan : {steps.rewriting, steps.passes}) {
        const Plan* const either = steps.rewriting != nullptr ? steps.rewriting : steps.passes;
        choosers_.emplace_back(plan != nullptr ? *plan : *either, keys_, view_, nullptr);
    }
    const std::uint64_t block =
        std::clamp(kBlocksBytes / (last_ + 1) / (sizeof(C) + sizeof(float)), kMinBlock, kMaxBlock);
    room_codes_ = std::max(block, max_codes);
    room_parameters_ = std::max(has_parameters ? block : 0, max_parameters);
    records_.resize(room_codes_);
}

template <typename C, typename R>
typename Levels<C, R>::Block Levels<C, R>::first_block() {
    if (levels_.empty() && !add_level()) {
        return {};
    }
    Level& first = levels_.front();
    return {first.codes.get(), first.parameters.get(), first.origins.get()};
}

template <typename C, typename R>
std::optional<Stop> Levels<C, R>::push(std::uint64_t count) {
    levels_.front().count = count;
    std::uint64_t at = 0;
    while (!stop_) {
        if (options_.cancelled != nullptr && options_.cancelled->load(std::memory_order_relaxed)) {
            stop_ = Stop::Cancelled;
            break;
        }
        if (at == last_ && levels_[at].count != 0) {
            if (!check_decomposed(at) || !pass_to_sink(levels_[at])) {
                break;
            }
            levels_[at].next.index = levels_[at].count;
        } else if (at < last_ && !levels_[at].pruned && levels_[at].count != 0) {
            if (!check_decomposed(at)) {
                break;
            }
            prune(at);
        }
        Level& level = levels_[at];
        if (level.next.index == level.count) {
            level.first_position += level.count;
            level.count = 0;
            level.next = {};
            level.settled = false;
            level.pruned = false;
            if (at == 0) {
                break;
            }
            --at;
            continue;
        }
        if (at + 1 == levels_.size() && !add_level()) {
            break;
        }
        if (!descend(at)) {
            break;
        }
        if (levels_[at + 1].count != 0) {
            ++at;
        }
    }
    return stop_;
}

template <typename C, typename R>
bool Levels<C, R>::fail(RuntimeError error) {
    error_ = std::move(error);
    stop_ = Stop::Diagnosed;
    return false;
}

template <typename C, typename R>
void Levels<C, R>::set_view(const Level& level, const PassKeys& keys) {
    view_ = {level.codes.get(), level.parameters.get(), level.count, level.first_position,
             level.origins.get()};
    keys_ = keys;
}

template <typename C, typename R>
void Levels<C, R>::prune(std::uint64_t index) {
    Level& level = levels_[index];
    level.pruned = true;
    if (!steps_.prunes || !steps_.rewrites(index)) {
        return;
    }
    const std::uint32_t generation = steps_.age_of(index) - steps_.first_age;
    while (pruners_.size() <= generation) {
        pruners_.emplace_back(steps_.rewriting->bytecode());
    }
    Pruner& pruner = pruners_[generation];
    C* const codes = level.codes.get();
    if (!pruner.may_prune(codes, level.count)) {
        return;
    }
    std::uint64_t kept = 0;
    float* to = level.parameters.get();
    pruner.each_kept(codes, level.count, [&](std::uint64_t i, std::uint64_t parameter) {
        const float* const from = level.parameters.get() + parameter;
        to = std::copy(from, from + pruner.stored(codes[i]), to);
        codes[kept] = codes[i];
        if (level.origins != nullptr) {
            level.origins[kept] = level.origins[i];
        }
        ++kept;
    });
    level.count = kept;
}

template <typename C, typename R>
void Levels<C, R>::pass_down(Level& level, Level& below) {
    std::swap(level.codes, below.codes);
    std::swap(level.parameters, below.parameters);
    std::swap(level.origins, below.origins);
    below.count = level.count;
    below.settled = true;
    level.next.index = level.count;
}

template <typename C, typename R>
bool Levels<C, R>::descend(std::uint64_t index) {
    Level& level = levels_[index];
    Level& below = levels_[index + 1];
    const bool rewrites = steps_.rewrites(index);
    const Plan& plan = rewrites ? *steps_.rewriting : *steps_.passes;
    set_view(level, steps_.keys_of(index));
    if (!rewrites && level.next.index == 0 && (level.settled || !may_rewrite(plan, view_))) {
        pass_down(level, below);
        return true;
    }
    Chooser<C>& chooser = choosers_[rewrites ? 0 : 1];
    const ModulePlace begin = level.next;
    const CountRequest request{begin, level.count, room_codes_, room_parameters_};
    const CountResult counted = count_modules(plan, chooser, view_, request, records_.data());
    WriteRequest<C> write;
    write.begin = begin;
    write.end = counted.end.index;
    write.codes = below.codes.get();
    write.codes_limit = write.codes + room_codes_ + kWordSlack / sizeof(C);
    write.writes_parameters = counted.parameters != 0;
    write.parameters = below.parameters.get();
    write.parameters_limit = write.parameters + room_parameters_ + kWordSlack / sizeof(float);
    write.origins = below.origins.get();
    const bool written = write_modules(plan, keys_, chooser.matcher(), view_, write,
                                       static_cast<const R*>(records_.data()));
    if (counted.fault || !written) {
        std::optional<RuntimeError> error = find_fault(plan, keys_, view_, nullptr, begin,
                                                       counted.end.index + (counted.fault ? 1 : 0));
        LSYS_CHECK(error.has_value(), index, view_.first_position);
        return fail(std::move(*error));
    }
    level.next = counted.end;
    below.count = counted.modules;
    below.settled = false;
    return true;
}

template <typename C, typename R>
bool Levels<C, R>::check_decomposed(std::uint64_t index) {
    if (!steps_.checked || !steps_.rewrites(index)) {
        return true;
    }
    const Level& level = levels_[index];
    PassKeys keys = steps_.keys_of(index);
    keys.first_draw = steps_.keys_of(index - 1).first_draw;
    keys.keeps_age = true;
    set_view(level, keys);
    if (level.settled || !may_rewrite(*steps_.passes, view_)) {
        return true;
    }
    const std::optional<ModulePlace> place = find_match(*steps_.passes, choosers_[1], view_);
    return !place || fail(too_deep(*steps_.passes, choosers_[1], keys_, view_, *place));
}

template <typename C, typename R>
bool Levels<C, R>::pass_to_sink(Level& level) {
    if (!sink_({{level.codes.get(), level.count},
                level.parameters.get(),
                level.origins.get(),
                level.first_position})) {
        stop_ = Stop::Cancelled;
        return false;
    }
    return true;
}

template <typename C, typename R>
bool Levels<C, R>::add_level() {
    const std::uint64_t code_bytes = room_codes_ * sizeof(C) + kWordSlack;
    const std::uint64_t parameter_bytes = room_parameters_ * sizeof(float) + kWordSlack;
    const std::uint64_t origin_bytes = options_.origins ? room_codes_ * sizeof(Origin) : 0;
    held_bytes_ += sizeof(Level) + code_bytes + parameter_bytes + origin_bytes;
    if (held_bytes_ > options_.max_bytes) {
        stop_ = Stop::Limit;
        return false;
    }
    Level& level = levels_.emplace_back();
    level.codes = std::make_unique_for_overwrite<C[]>(code_bytes / sizeof(C));
    level.parameters = std::make_unique_for_overwrite<float[]>(parameter_bytes / sizeof(float));
    if (options_.origins) {
        level.origins = std::make_unique_for_overwrite<Origin[]>(room_codes_);
    }
    // Wide loads read past the last parameter, where they need finite numbers.
    std::fill_n(level.parameters.get(), parameter_bytes / sizeof(float), 0.0F);
    return true;
}

#define LSYS_LEVELS(C, R) template class Levels<C, R>;
LSYS_FOR_CODES_AND_RECORDS(LSYS_LEVELS)
#undef LSYS_LEVELS

} // namespace lsys
