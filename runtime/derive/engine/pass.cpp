// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/pass.h"

#include "grammar/base/contract.h"
#include "runtime/base/saturating.h"
#include "runtime/derive/engine/count.h"
#include "runtime/derive/engine/depth_limit.h"
#include "runtime/derive/engine/faults.h"
#include "runtime/derive/engine/write.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// Programs with more codes are counted module by module.
constexpr Code kCensusCodes = 4096;
/// If all rows are Fixed: min modules of a word that all threads count and write. For a shorter
/// word it is faster to take the sizes from the census and to write in order on one thread. With
/// random draws in batches a module costs more, so that kMinSharedWord is the min instead.
constexpr std::uint64_t kMinParallelCount = 1U << 22;
/// Threads end at about the same time if each has several chunks, none of them too small.
constexpr std::uint64_t kChunksPerThread = 6;
constexpr std::uint64_t kMinChunk = 1U << 14;
/// Min modules of a word that several threads share: one thread rewrites a shorter word in less
/// time than two threads need to synchronize.
constexpr std::uint64_t kMinSharedWord = 1U << 17;
/// Threads are started a few generations before they are needed, because a start takes as long as
/// rewriting a word of kMinWordForThreads modules: at the first word with that many modules and at
/// least 1 / kMinGrowth more than the word before. A word that grows less may never need threads.
constexpr std::uint64_t kMinWordForThreads = 1U << 13;
constexpr std::uint64_t kMinGrowth = 8;
/// Modules between two reports of progress.
constexpr std::uint64_t kProgressStride = std::uint64_t{1} << 24;

/// A mask is faster if at most one in this many modules is active. Modules of rows that are not
/// Fixed cost more.
constexpr std::uint64_t kModulesPerActiveFixed = 8;   // if all rows are Fixed
constexpr std::uint64_t kModulesPerActiveDynamic = 2; // if some row is not Fixed

} // namespace

Passes::Passes(const Plan& plan, const DeriveOptions& options)
    : plan_(plan), options_(options), workers_(options.threads), contexts_(plan) {}

std::uint64_t Passes::held_bytes() const {
    return contexts_.held_bytes() + records_.max_reserved() + chunks_.capacity() * sizeof(Chunk) +
           census_.capacity() * sizeof(std::uint64_t);
}

bool Passes::cancelled() const {
    return options_.cancelled != nullptr && options_.cancelled->load(std::memory_order_relaxed);
}

void Passes::report_progress(std::uint32_t generation, std::uint64_t modules) {
    const std::uint64_t before = written_.fetch_add(modules, std::memory_order_relaxed);
    if (!options_.progress || before / kProgressStride == (before + modules) / kProgressStride) {
        return;
    }
    const std::unique_lock<std::mutex> only_one(progress_mutex_, std::try_to_lock);
    if (only_one.owns_lock()) {
        options_.progress(generation + 1, before + modules);
    }
}

bool Passes::may_rewrite_any(const Word& word) const {
    return visit_view(word, [this](const auto& view) { return may_rewrite(plan_, view); });
}

std::optional<Stop>
Passes::run(const Word& in, Word& out, const PassKeys& keys, std::uint64_t other_bytes) {
    other_bytes_ = other_bytes;
    written_.store(0, std::memory_order_relaxed);
    limit_ = {};
    limit_.generation = keys.generation;
    limit_.modules = in.module_count();
    return visit_view(in, [&]<typename C>(const WordView<C>& view) {
        return visit_record_type(plan_.record_width(), [&](auto record) {
            return run_typed<C, decltype(record)>(view, in, out, keys);
        });
    });
}

std::optional<Stop> Passes::report_out_of_memory(const Word& in, std::uint64_t bytes) {
    census_known_ = false;
    limit_.kind = LimitKind::Memory;
    limit_.predicted_modules = std::max(modules_, in.module_count());
    limit_.predicted_bytes = bytes;
    limit_.exact = false;
    return Stop::OutOfMemory;
}

template <typename C, typename R>
std::optional<Stop>
Passes::run_typed(const WordView<C>& word, const Word& in, Word& out, const PassKeys& keys) {
    modules_ = 0;
    parameters_ = 0;
    const bool dynamic = !plan_.all_fixed();
    const std::uint64_t record_bytes = dynamic ? word.count * sizeof(R) : 0;
    const bool searches = dynamic && plan_.needs_contexts();
    const std::uint64_t tables = searches ? contexts_.held_bytes_after(in) : 0;
    const std::uint64_t before =
        other_bytes_ + in.held_bytes() + out.held_bytes() + saturating_add(record_bytes, tables);
    if (before > options_.limits.max_bytes) {
        limit_.kind = LimitKind::Memory;
        limit_.predicted_modules = word.count;
        limit_.predicted_bytes = before;
        limit_.exact = false;
        return Stop::Limit;
    }
    if (!records_.reserve(record_bytes + sizeof(R)) ||
        (searches && !contexts_.prepare(plan_, in))) {
        return report_out_of_memory(in, before);
    }
    make_chunks(word);
    mask_.prepare(plan_, contexts());

    const std::uint64_t min_shared_count =
        plan_.has_batched_draws() ? kMinSharedWord : kMinParallelCount;
    by_census_ = !dynamic && plan_.rows().size() <= kCensusCodes &&
                 (workers_.count() == 1 || word.count < min_shared_count);
    if (by_census_) {
        take_census(word);
    } else {
        census_known_ = false;
        place_chunks(word, !in.parameters().empty());
        if (const std::optional<Stop> stop = count<C, R>(word, keys)) {
            return stop;
        }
    }
    if (!check_limits(in, out, keys)) {
        limit_.production = dominant_production(word, keys);
        return Stop::Limit;
    }
    if (!out.resize(modules_, parameters_)) {
        return report_out_of_memory(in, limit_.predicted_bytes);
    }
    if (const std::optional<Stop> stop = write<C, R>(word, out, keys)) {
        census_known_ = false;
        return stop;
    }
    if (by_census_) {
        advance_census();
    }
    return std::nullopt;
}

template <typename C>
void Passes::make_chunks(const WordView<C>& word) {
    std::uint64_t size = std::max(options_.chunk_modules, 1U);
    const std::uint64_t previous = std::exchange(previous_modules_, word.count);
    if (workers_.count() > 1 && size > kMinChunk) {
        if (word.count >= kMinWordForThreads && previous != 0 &&
            word.count >= previous + previous / kMinGrowth) {
            workers_.start();
        }
        size =
            word.count < kMinSharedWord
                ? kMinSharedWord
                : std::clamp(word.count / (workers_.count() * kChunksPerThread), kMinChunk, size);
    }
    chunks_.assign((word.count + size - 1) / size, {});
    for (std::uint64_t i = 0; i < chunks_.size(); ++i) {
        chunks_[i].begin.index = i * size;
        chunks_[i].end = std::min(word.count, (i + 1) * size);
    }
}

template <typename C>
void Passes::place_chunks(const WordView<C>& word, bool stores) {
    if (!stores || workers_.count() == 1 || chunks_.size() == 1) {
        return;
    }
    const Row* const rows = plan_.rows().data();
    workers_.for_each(chunks_.size(), [&](std::uint64_t index) {
        Chunk& chunk = chunks_[index];
        std::uint64_t stored = 0;
        for (std::uint64_t i = chunk.begin.index; i < chunk.end; ++i) {
            stored += rows[word.codes[i]].stored;
        }
        chunk.parameters = stored;
    });
    std::uint64_t before = 0;
    for (Chunk& chunk : chunks_) {
        chunk.begin.parameter = before;
        before += std::exchange(chunk.parameters, 0);
    }
}

template <typename C>
bool Passes::is_mask_faster(const WordView<C>& word, const Chunk& chunk) const {
    if (!mask_.usable()) {
        return false;
    }
    std::array<ActiveBits, ActiveMask::kModules / ActiveMask::kBlock>
        bits; // NOLINT: written by fill()
    const std::uint64_t count =
        std::min<std::uint64_t>(chunk.end - chunk.begin.index, ActiveMask::kModules);
    const std::uint64_t part =
        plan_.all_fixed() ? kModulesPerActiveFixed : kModulesPerActiveDynamic;
    return mask_.fill(word.codes, word.count, chunk.begin.index, count, bits.data()) <=
           count / part;
}

template <typename C, typename R>
std::optional<Stop> Passes::count(const WordView<C>& word, const PassKeys& keys) {
    // A match of several modules may reach into the next chunk, which then begins after the match.
    const bool in_order = workers_.count() == 1 || plan_.predecessor_count() > 1;
    const auto count_chunk = [&](std::uint64_t index) {
        if (cancelled()) {
            return;
        }
        Chunk& chunk = chunks_[index];
        Chooser<C> chooser(plan_, keys, word, contexts());
        R* const records = records_at<R>(chunk.begin.index);
        chunk.masked = is_mask_faster(word, chunk);
        const CountResult result =
            chunk.masked
                ? count_active(plan_, chooser, mask_, word, chunk.begin, chunk.end, records)
                : count_modules(plan_, chooser, word, {chunk.begin, chunk.end}, records);
        chunk.modules = result.modules;
        chunk.parameters = result.parameters;
        chunk.fault = result.fault;
        chunk.fault_index = result.end.index;
        chunk.end = result.end.index;
        if (in_order && index + 1 < chunks_.size()) {
            chunks_[index + 1].begin = result.end;
        }
    };
    if (in_order) {
        for (std::uint64_t i = 0; i < chunks_.size(); ++i) {
            count_chunk(i);
            if (chunks_[i].fault) {
                break;
            }
        }
    } else {
        workers_.for_each(chunks_.size(), count_chunk);
    }
    if (cancelled()) {
        return Stop::Cancelled;
    }
    for (const Chunk& chunk : chunks_) {
        if (chunk.fault) {
            return report_fault(word, keys, {}, chunk.fault_index + 1);
        }
    }
    for (Chunk& chunk : chunks_) {
        chunk.out_module = modules_;
        chunk.out_parameter = parameters_;
        modules_ = saturating_add(modules_, chunk.modules);
        parameters_ = saturating_add(parameters_, chunk.parameters);
    }
    return std::nullopt;
}

template <typename C, typename R>
std::optional<Stop> Passes::write(const WordView<C>& word, Word& out, const PassKeys& keys) {
    C* const codes = out.codes<C>().data();
    float* const parameters = out.parameters().data();
    const bool in_order = workers_.count() == 1 || chunks_.size() == 1 || by_census_;
    C* const codes_end = codes + modules_ + kWordSlack / sizeof(C);
    float* const parameters_end = parameters + parameters_ + kWordSlack / sizeof(float);
    WriteRequest<C> next; // if chunks are written in order: starts where the last one ended
    next.codes = codes;
    next.parameters = parameters;
    Origin* const origins = out.keeps_origins() ? out.origins().data() : nullptr;
    next.origins = origins;
    std::uint64_t rewritten = 0; // modules of the word that are not copied, by the census
    if (by_census_) {
        for (Code code = 0; code < census_.size(); ++code) {
            rewritten += plan_.row(code).copies ? 0 : census_[code];
        }
    }
    const bool census_masked = mask_.usable() && rewritten <= word.count / kModulesPerActiveFixed;
    const auto write_chunk = [&](std::uint64_t index) {
        if (cancelled()) {
            return;
        }
        Chunk& chunk = chunks_[index];
        WriteRequest<C> request;
        request.begin = chunk.begin;
        request.codes = codes + chunk.out_module;
        request.parameters = parameters + chunk.out_parameter;
        request.origins = origins == nullptr ? nullptr : origins + chunk.out_module;
        request.mask = chunk.masked ? &mask_ : nullptr;
        request.writes_parameters = chunk.parameters != 0;
        const bool last = index + 1 == chunks_.size();
        request.codes_limit = in_order || last ? codes_end : request.codes + chunk.modules;
        request.parameters_limit =
            in_order || last ? parameters_end : request.parameters + chunk.parameters;
        if (by_census_) {
            request.begin = next.begin;
            request.codes = next.codes;
            request.parameters = next.parameters;
            request.origins = next.origins;
            request.mask = census_masked ? &mask_ : nullptr;
            request.writes_parameters = parameters_ != 0;
        }
        request.end = chunk.end;
        const C* const begin = request.codes;
        chunk.begin = request.begin;
        Matcher<C> matcher(plan_, word, contexts());
        chunk.fault = !write_modules(plan_, keys, matcher, word, request,
                                     static_cast<const R*>(records_at<R>(chunk.begin.index)));
        if (in_order) {
            next = request;
        }
        report_progress(keys.generation, static_cast<std::uint64_t>(request.codes - begin));
    };
    if (in_order) {
        for (std::uint64_t i = 0; i < chunks_.size() && !(i > 0 && chunks_[i - 1].fault); ++i) {
            write_chunk(i);
        }
    } else {
        workers_.for_each(chunks_.size(), write_chunk);
    }
    if (cancelled()) {
        return Stop::Cancelled;
    }
    for (const Chunk& chunk : chunks_) {
        if (chunk.fault) {
            return report_fault(word, keys, chunk.begin, chunk.end);
        }
    }
    return std::nullopt;
}

template <typename C>
std::optional<Stop> Passes::report_fault(const WordView<C>& word,
                                         const PassKeys& keys,
                                         ModulePlace begin,
                                         std::uint64_t end) {
    std::optional<RuntimeError> error = find_fault(plan_, keys, word, contexts(), begin, end);
    LSYS_CHECK(error.has_value(), begin.index, end);
    error_ = std::move(*error);
    return Stop::Diagnosed;
}

bool Passes::check_limits(const Word& in, const Word& out, const PassKeys& keys) {
    const std::uint64_t held = saturating_add(other_bytes_ + held_bytes() + in.held_bytes(),
                                              out.held_bytes_after(modules_, parameters_));
    limit_.generation = keys.generation;
    limit_.predicted_modules = modules_;
    limit_.predicted_bytes = held;
    const bool too_many = modules_ > options_.limits.max_modules;
    limit_.kind = too_many ? LimitKind::Modules : LimitKind::Memory;
    return !too_many && held <= options_.limits.max_bytes;
}

template <typename C>
std::uint32_t Passes::dominant_production(const WordView<C>& word, const PassKeys& keys) const {
    std::vector<std::uint64_t> uses(plan_.entries().size(), 0);
    if (census_known_) {
        std::copy(census_.begin(), census_.end(), uses.begin());
    } else {
        Chooser<C> chooser(plan_, keys, word, contexts());
        for (ModulePlace place; place.index < word.count;) {
            const C code = word.codes[place.index];
            const Row& row = plan_.row(code);
            std::uint32_t record = 0;
            if (row.kind != RowKind::Fixed) {
                const bool counted = chooser.choose(place, row, record);
                LSYS_CHECK(counted, place.index); // count() has already evaluated all conditions
            }
            ++uses[record == 0 ? code : row.base + record];
            const std::uint32_t modules =
                record == 0 ? 1 : plan_.replaced_modules(plan_.entries()[row.base + record]);
            for (std::uint32_t i = 0; i < modules; ++i, ++place.index) {
                place.parameter += plan_.row(word.codes[place.index]).stored;
            }
        }
    }
    std::vector<std::uint64_t> added(plan_.bytecode().productions.size(), 0);
    std::uint32_t dominant = kNone;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const Entry& entry = plan_.entries()[i];
        const std::uint32_t used = plan_.replaced_modules(entry);
        if (entry.candidate == kNone || entry.code_count <= used) {
            continue;
        }
        const std::uint32_t production = plan_.candidate(entry.candidate).production;
        added[production] = saturating_add(added[production],
                                           saturating_multiply(uses[i], entry.code_count - used));
    }
    for (std::uint32_t production = 0; production < added.size(); ++production) {
        if (added[production] > (dominant == kNone ? 0 : added[dominant])) {
            dominant = production;
        }
    }
    return dominant;
}

template <typename C>
void Passes::take_census(const WordView<C>& word) {
    if (!census_known_) {
        census_.assign(plan_.rows().size(), 0);
        for (std::uint64_t i = 0; i < word.count; ++i) {
            ++census_[word.codes[i]];
        }
        census_known_ = true;
    }
    for (Code code = 0; code < census_.size(); ++code) {
        const Row& row = plan_.row(code);
        modules_ = saturating_add(modules_, saturating_multiply(census_[code], row.code_count));
        parameters_ =
            saturating_add(parameters_, saturating_multiply(census_[code], row.parameter_count));
    }
}

void Passes::advance_census() {
    std::vector<std::uint64_t> next(census_.size(), 0);
    for (Code code = 0; code < census_.size(); ++code) {
        if (census_[code] == 0) {
            continue;
        }
        const Entry& entry = plan_.entries()[code];
        if (entry.candidate == kNone) {
            next[code] += census_[code];
            continue;
        }
        for (std::uint32_t i = 0; i < entry.code_count; ++i) {
            next[plan_.pool_code(entry.first_code + i)] += census_[code];
        }
    }
    census_ = std::move(next);
}

} // namespace lsys
