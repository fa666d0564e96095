// SPDX-License-Identifier: MIT
// ContextTables: tables of the next module towards the root and the next module along the axis for
// each place of a word. A lookup takes constant time, however long a branch or run of ignored
// modules is. Built per word if an active production has a context. A word without brackets and
// ignored modules needs no table: its neighbours are adjacent.
//
// Gap g is the place before module g; the gap whose number is the word's length is the end.
#pragma once

#include "runtime/derive/engine/plan.h"
#include "runtime/derive/word.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Index of a module that does not exist.
inline constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

/// The role of a code in a context search; brackets come last.
enum class ContextRole : std::uint8_t { Module, Ignored, Open, Close };
[[nodiscard]] ContextRole context_role(const BytecodeSymbol& symbol);

/// Indices into a word, of 4 bytes each if the word is short enough.
class IndexTable {
public:
    /// Bytes of an index.
    [[nodiscard]] static std::uint64_t width(std::uint64_t word_length) {
        return word_length < 0xFFFFFFFFu ? sizeof(std::uint32_t) : sizeof(std::uint64_t);
    }
    /// Makes room for `count` indices into a word of `word_length` modules. Returns false if there
    /// is no memory.
    [[nodiscard]] bool reserve(std::uint64_t count, std::uint64_t word_length) {
        wide_ = width(word_length) == sizeof(std::uint64_t);
        return arena_.reserve(count * width(word_length));
    }
    /// Entry `at`: an index or kNowhere.
    [[nodiscard]] std::uint64_t get(std::uint64_t at) const {
        if (wide_) {
            return arena_.as<std::uint64_t>()[at];
        }
        const std::uint32_t index = arena_.as<std::uint32_t>()[at];
        return index == 0xFFFFFFFFu ? kNowhere : index;
    }
    void set(std::uint64_t at, std::uint64_t index) {
        if (wide_) {
            arena_.as<std::uint64_t>()[at] = index;
        } else {
            arena_.as<std::uint32_t>()[at] = static_cast<std::uint32_t>(index);
        }
    }
    [[nodiscard]] std::uint64_t held_bytes() const { return arena_.max_reserved(); }

private:
    Arena arena_;
    bool wide_ = false; // indices have 8 bytes
};

class ContextTables {
public:
    explicit ContextTables(const Plan& plan);

    /// held_bytes() after prepare(word).
    [[nodiscard]] std::uint64_t held_bytes_after(const Word& word) const;
    /// Builds the tables of `word` that the active productions need. Returns false if there is no
    /// memory.
    [[nodiscard]] bool prepare(const Plan& plan, const Word& word);
    [[nodiscard]] std::uint64_t held_bytes() const;

    /// Whether the word has neither brackets nor ignored modules.
    [[nodiscard]] bool plain() const { return plain_; }
    [[nodiscard]] ContextRole role(Code code) const { return roles_[code]; }
    /// The module left of module `index` on the path to the root, or kNowhere.
    [[nodiscard]] std::uint64_t left_of(std::uint64_t index) const {
        return plain_ ? index - 1 : left_.get(index); // 0 - 1 is kNowhere
    }
    /// The first module on the axis at or after `gap`, or kNowhere.
    [[nodiscard]] std::uint64_t next_from(std::uint64_t gap) const {
        if (plain_) {
            return gap < count_ ? gap : kNowhere;
        }
        return next_.get(gap);
    }
    /// For a `[`, the gap after its branch; for an ignored module, the gap after the run of ignored
    /// modules. Available if a right context has brackets and the word is not plain().
    [[nodiscard]] std::uint64_t jump_from(std::uint64_t index) const { return jump_.get(index); }
    static constexpr std::uint64_t kOffsetStride = 64;
    /// The number of parameters stored before module m, where m is `index` rounded down to a
    /// multiple of kOffsetStride. Available if a formal of a context is used.
    [[nodiscard]] std::uint64_t offset_before(std::uint64_t index) const {
        return offsets_.as<std::uint64_t>()[index / kOffsetStride];
    }

private:
    template <typename C>
    [[nodiscard]] bool is_plain(const C* codes) const;
    /// Builds left_, the table of left_of(). `left`: the module left of the word. Returns the last
    /// module on its main axis.
    template <typename C>
    std::uint64_t build_left(const C* codes, std::uint64_t left);
    /// Builds next_ and jump_, the tables of next_from() and jump_from(). `next`: the module after
    /// the word.
    template <typename C>
    void build_right(const C* codes, std::uint64_t next);
    /// Builds offsets_, the table of offset_before().
    template <typename C>
    void build_offsets(const C* codes, const Plan& plan);
    /// prepare() for codes of type C.
    template <typename C>
    [[nodiscard]] bool build(const Plan& plan, std::span<const C> word);

    std::vector<ContextRole> roles_; // by code
    IndexTable left_;                // by module
    IndexTable next_;                // by gap
    IndexTable jump_;                // by module
    Arena offsets_;                  // one per kOffsetStride modules, see offset_before()
    std::uint64_t count_ = 0;        // modules of the word
    bool plain_ = true;
    bool has_structure_ = false; // Plan::has_structure(): the word may have brackets
    bool is_ring_ = false;       // contexts go on from one end of the word to the other
    // Tables that the active productions need:
    bool needs_left_ = false;
    bool needs_right_ = false;
    bool needs_jump_ = false;
    bool needs_offsets_ = false;
};

} // namespace lsys
