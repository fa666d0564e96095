// SPDX-License-Identifier: MIT
// Passes: one pass reads a word and writes another, in chunks that any number of threads count and
// then write; limits are checked in between. A generation is one pass, or one pass per rule.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/engine/active_mask.h"
#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/match.h"
#include "runtime/derive/engine/plan.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace lsys {

class Passes {
public:
    Passes(const Plan& plan, const DeriveOptions& options);

    /// Rewrites `in` into `out` by the current rows of the plan. After a Stop `in` is unchanged and
    /// error() or limit() has the facts. `other_bytes` counts towards the limit on memory.
    [[nodiscard]] std::optional<Stop>
    run(const Word& in, Word& out, const PassKeys& keys, std::uint64_t other_bytes);
    /// Whether the current rows of the plan may rewrite some module of `word`.
    [[nodiscard]] bool may_rewrite_any(const Word& word) const;
    /// Must be called if the next word given to run() is not the word that run() wrote last.
    void discard_census() { census_known_ = false; }

    [[nodiscard]] const RuntimeError& error() const { return error_; }
    [[nodiscard]] const LimitReport& limit() const { return limit_; }
    [[nodiscard]] std::uint64_t held_bytes() const;

private:
    /// Modules [begin, end) of the word for one thread, and the place of their successors.
    struct Chunk {
        ModulePlace begin;
        std::uint64_t end = 0;
        std::uint64_t modules = 0;    // number of modules written
        std::uint64_t parameters = 0; // number of parameters written
        std::uint64_t out_module = 0; // index of the first module written
        std::uint64_t out_parameter = 0;
        bool masked = false;           // counted and written by its mask
        bool fault = false;            // a module has no valid condition, weight or parameter
        std::uint64_t fault_index = 0; // index of that module, set by count()
    };

    template <typename C, typename R>
    [[nodiscard]] std::optional<Stop>
    run_typed(const WordView<C>& word, const Word& in, Word& out, const PassKeys& keys);
    /// Divides the word into chunks of DeriveOptions::chunk_modules, into smaller ones if several
    /// threads would have few of them, and into one chunk if the word is too short for a second
    /// thread.
    template <typename C>
    void make_chunks(const WordView<C>& word);
    /// Finds the first parameter of each chunk if several threads read chunks. `stores`: whether
    /// the word has parameters.
    template <typename C>
    void place_chunks(const WordView<C>& word, bool stores);
    /// Whether the mask takes less time, judged by the share of active modules among the first ones
    /// of the chunk.
    template <typename C>
    [[nodiscard]] bool is_mask_faster(const WordView<C>& word, const Chunk& chunk) const;
    /// Counts the modules and parameters that each chunk writes, and records the choices.
    template <typename C, typename R>
    [[nodiscard]] std::optional<Stop> count(const WordView<C>& word, const PassKeys& keys);
    template <typename C, typename R>
    [[nodiscard]] std::optional<Stop>
    write(const WordView<C>& word, Word& out, const PassKeys& keys);
    /// Makes the census unless it is known, and computes the sizes of the next word from it.
    template <typename C>
    void take_census(const WordView<C>& word);
    /// Replaces the census by the census of the written word: multiplies it by the growth matrix.
    void advance_census();
    /// Sets the values of limit_ for the word to write; returns false if it exceeds a limit.
    [[nodiscard]] bool check_limits(const Word& in, const Word& out, const PassKeys& keys);
    /// The production whose applications add most modules to the word.
    template <typename C>
    [[nodiscard]] std::uint32_t dominant_production(const WordView<C>& word,
                                                    const PassKeys& keys) const;
    [[nodiscard]] const ContextTables* contexts() const {
        return plan_.needs_contexts() ? &contexts_ : nullptr;
    }
    /// Sets error_ to the first fault of the modules from `begin` to `end`.
    template <typename C>
    [[nodiscard]] std::optional<Stop> report_fault(const WordView<C>& word,
                                                   const PassKeys& keys,
                                                   ModulePlace begin,
                                                   std::uint64_t end);
    /// Sets limit_ to a lack of memory for `bytes` bytes.
    [[nodiscard]] std::optional<Stop> report_out_of_memory(const Word& in, std::uint64_t bytes);
    [[nodiscard]] bool cancelled() const;
    /// Adds written modules; calls DeriveOptions::progress now and then.
    void report_progress(std::uint32_t generation, std::uint64_t modules);
    template <typename R>
    [[nodiscard]] R* records_at(std::uint64_t index) {
        return records_.as<R>() + index;
    }

    const Plan& plan_;
    const DeriveOptions& options_;
    Workers workers_;
    ContextTables contexts_;
    ActiveMask mask_;
    std::vector<Chunk> chunks_;
    std::uint64_t previous_modules_ = 0; // length of the word that the last pass read; 0: none
    Arena records_;                     // records of a chunk begin at the index of its first module
    std::vector<std::uint64_t> census_; // number of modules of each code in the word
    bool census_known_ = false;         // the census is that of the word that run() gets next
    bool by_census_ = false;            // this pass takes sizes from the census and writes in order
    std::uint64_t modules_ = 0;         // modules of the word to write
    std::uint64_t parameters_ = 0;      // parameters of the word to write
    std::uint64_t other_bytes_ = 0;     // argument of run()
    std::atomic<std::uint64_t> written_{0}; // modules written so far, for progress
    std::mutex progress_mutex_;
    RuntimeError error_;
    LimitReport limit_;
};

} // namespace lsys
