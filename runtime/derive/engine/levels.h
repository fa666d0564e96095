// SPDX-License-Identifier: MIT
// Levels: derives a word depth first without storing any word. Each level holds a block of modules
// of one generation and rewrites it, piece by piece, into the block of the level below. Each level
// counts its modules, so the position of the next module is known.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/prune.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

/// The steps between levels: generations of rewriting, and passes of a later stage over the word of
/// each age.
struct LevelSteps {
    const Plan* rewriting = nullptr; // may be null if first_age is last_age
    const Plan* passes = nullptr;    // plan of a later stage; null if `depth` is 0
    std::uint64_t seed = 0;
    std::uint32_t first_age = 0;
    std::uint32_t last_age = 0;
    std::uint32_t depth = 0;           // passes over the word of each age
    bool checked = false;              // error if a module still matches after the last pass
    std::uint64_t first_pass_draw = 0; // number of the first draw of the first pass
    bool prunes = false;               // before each generation, `%` modules cut off branches

    /// Number of steps, which is also the index of the last level.
    [[nodiscard]] std::uint64_t count() const {
        return (std::uint64_t{last_age} - first_age + 1) * depth + (last_age - first_age);
    }
    /// Age of the words of a level.
    [[nodiscard]] std::uint32_t age_of(std::uint64_t level) const {
        return first_age + static_cast<std::uint32_t>(level / (std::uint64_t{depth} + 1));
    }
    /// Whether the step after `level` is a generation, not a pass of the later stage.
    [[nodiscard]] bool rewrites(std::uint64_t level) const {
        return level % (std::uint64_t{depth} + 1) == depth;
    }
    /// Keys of the draws of the step after `level`.
    [[nodiscard]] PassKeys keys_of(std::uint64_t level) const {
        const std::uint64_t pass = level % (std::uint64_t{depth} + 1);
        return rewrites(level)
                   ? PassKeys{seed, age_of(level), 0, false}
                   : PassKeys{seed, age_of(level),
                              first_pass_draw + (std::uint64_t{kMaxSequentialDraws} + 1) * pass,
                              true};
    }
};

/// A run of modules of the last level.
template <typename C>
struct LevelBlock {
    std::span<const C> codes;
    const float* parameters = nullptr;
    const Origin* origins = nullptr;  // null unless LevelOptions::origins
    std::uint64_t first_position = 0; // position of the first module in the last word
};

struct LevelOptions {
    bool origins = false; // whether to write the origin of each module
    std::uint64_t max_bytes = ~std::uint64_t{0};
    std::uint64_t min_codes = 0;                  // min room of a block, in modules
    std::uint64_t min_parameters = 0;             // min room of a block, in parameters
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
};

/// R: uint8_t or uint32_t, the wider of the plans' record_width().
template <typename C, typename R>
class Levels {
public:
    /// Receives blocks of the last level; returns false to stop.
    using Sink = std::function<bool(const LevelBlock<C>&)>;

    Levels(const LevelSteps& steps, const LevelOptions& options, Sink sink);

    /// Modules and parameters that a block has room for.
    [[nodiscard]] std::uint64_t room_codes() const { return room_codes_; }
    [[nodiscard]] std::uint64_t room_parameters() const { return room_parameters_; }
    /// Memory of a block.
    struct Block {
        C* codes = nullptr;
        float* parameters = nullptr;
        Origin* origins = nullptr;
    };
    /// The block of the first level, to be filled; null pointers if the limit on memory is reached.
    [[nodiscard]] Block first_block();
    /// Rewrites the `count` modules in the first block through all levels.
    [[nodiscard]] std::optional<Stop> push(std::uint64_t count);

    [[nodiscard]] RuntimeError& error() { return error_; }
    [[nodiscard]] std::uint64_t held_bytes() const { return held_bytes_; }

private:
    struct Level {
        std::unique_ptr<C[]> codes; // uninitialised
        std::unique_ptr<float[]> parameters;
        std::unique_ptr<Origin[]> origins;
        std::uint64_t count = 0;          // modules in the block
        ModulePlace next;                 // the next module to rewrite
        std::uint64_t first_position = 0; // position of the block in its level's word
        bool settled = false;             // no further pass of this age changes the block
        bool pruned = false;              // cuts have been made
    };

    /// Allocates the block of one more level; returns false at the limit on memory.
    [[nodiscard]] bool add_level();
    /// Rewrites as much of a level's block as fits into the block of the level below.
    [[nodiscard]] bool descend(std::uint64_t index);
    /// Checks a block after its last pass: if a production still matches, fails with TooDeep.
    [[nodiscard]] bool check_decomposed(std::uint64_t index);
    /// Passes the block of the last level to the sink; returns false if the sink stops.
    [[nodiscard]] bool pass_to_sink(Level& level);
    /// Moves a whole block to the level below without rewriting it.
    void pass_down(Level& level, Level& below);
    /// Makes the cuts of a block before a generation rewrites it.
    void prune(std::uint64_t index);
    /// Makes the block of a level the word that the choosers read.
    void set_view(const Level& level, const PassKeys& keys);
    /// Sets error_ and stop_; returns false.
    [[nodiscard]] bool fail(RuntimeError error);

    LevelSteps steps_;
    LevelOptions options_;
    Sink sink_;
    std::uint64_t last_ = 0; // index of the last level
    WordView<C> view_;       // the block being rewritten
    PassKeys keys_;
    std::deque<Chooser<C>> choosers_; // one for rewriting, one for passes; refer to view_ and keys_
    std::vector<Level> levels_;
    std::deque<Pruner> pruners_; // by generation, if LevelSteps::prunes
    std::vector<R> records_;     // of the block being rewritten, see count_modules()
    std::uint64_t room_codes_ = 0;
    std::uint64_t room_parameters_ = 0;
    std::uint64_t held_bytes_ = 0;
    std::optional<Stop> stop_;
    RuntimeError error_;
};

} // namespace lsys
