// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/contexts.h"

#include <algorithm>

namespace lsys {

ContextRole context_role(const BytecodeSymbol& symbol) {
    return symbol.kind == SymbolKind::BranchOpen    ? ContextRole::Open
           : symbol.kind == SymbolKind::BranchClose ? ContextRole::Close
           : symbol.ignored                         ? ContextRole::Ignored
                                                    : ContextRole::Module;
}

ContextTables::ContextTables(const Plan& plan)
    : has_structure_(plan.has_structure()),
      is_ring_(plan.bytecode().settings.word_shape == WordShape::Ring) {
    const Bytecode& bytecode = plan.bytecode();
    const TableRange stage = plan.productions();
    for (std::uint32_t p = stage.first; p < stage.first + stage.count; ++p) {
        const BytecodeProduction& production = bytecode.productions[p];
        needs_left_ = needs_left_ || production.has_left;
        needs_right_ = needs_right_ || production.has_right;
        for (std::uint32_t i = 0; i < production.right.count; ++i) {
            const PatternItem& item = bytecode.patterns[production.right.first + i];
            needs_jump_ = needs_jump_ || item.kind == PatternKind::Open;
        }
    }
    if (!needs_left_ && !needs_right_) {
        return;
    }
    roles_.reserve(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        roles_.push_back(context_role(bytecode.symbol(bytecode.symbol_of(code))));
    }
}

std::uint64_t ContextTables::held_bytes() const {
    return roles_.size() + left_.held_bytes() + next_.held_bytes() + jump_.held_bytes() +
           offsets_.max_reserved();
}

std::uint64_t ContextTables::held_bytes_after(const Word& word) const {
    const std::uint64_t count = word.module_count();
    const std::uint64_t table = (count + 1) * IndexTable::width(count);
    std::uint64_t bytes = roles_.size();
    if (has_structure_) {
        bytes += needs_left_ ? std::max(left_.held_bytes(), table) : 0;
        bytes += needs_right_ ? std::max(next_.held_bytes(), table) : 0;
        bytes += needs_jump_ ? std::max(jump_.held_bytes(), table) : 0;
    }
    return bytes + std::max<std::uint64_t>(offsets_.max_reserved(), count / kOffsetStride * 8 + 8);
}

bool ContextTables::prepare(const Plan& plan, const Word& word) {
    return word.visit([&](auto codes) { return build(plan, codes); });
}

template <typename C>
bool ContextTables::build(const Plan& plan, std::span<const C> word) {
    const C* const codes = word.data();
    count_ = word.size();
    needs_offsets_ = plan.reads_contexts() && plan.has_parameters();
    plain_ = !has_structure_ || (!is_ring_ && is_plain(codes));
    if (!plain_) {
        if ((needs_left_ && !left_.reserve(count_, count_)) ||
            (needs_right_ && !next_.reserve(count_ + 1, count_)) ||
            (needs_jump_ && !jump_.reserve(count_, count_))) {
            return false;
        }
        if (needs_left_) {
            const std::uint64_t last = build_left(codes, kNowhere);
            if (is_ring_) {
                build_left(codes, last);
            }
        }
        if (needs_right_) {
            build_right(codes, kNowhere);
            if (is_ring_) {
                build_right(codes, next_.get(0));
            }
        }
    }
    if (needs_offsets_) {
        if (!offsets_.reserve((count_ / kOffsetStride + 1) * sizeof(std::uint64_t))) {
            return false;
        }
        build_offsets(codes, plan);
    }
    return true;
}

template <typename C>
bool ContextTables::is_plain(const C* codes) const {
    return std::all_of(codes, codes + count_,
                       [this](C code) { return roles_[code] == ContextRole::Module; });
}

/// Scans the word once from the left; a stack holds the module to the left of each open `[`.
template <typename C>
std::uint64_t ContextTables::build_left(const C* codes, std::uint64_t left) {
    std::vector<std::uint64_t> open;
    for (std::uint64_t i = 0; i < count_; ++i) {
        left_.set(i, left);
        switch (roles_[codes[i]]) {
        case ContextRole::Module:
            left = i;
            break;
        case ContextRole::Ignored:
            break;
        case ContextRole::Open:
            open.push_back(left);
            break;
        case ContextRole::Close:
            left = kNowhere; // if the `]` is unmatched, no module before it is on the path
            if (!open.empty()) {
                left = open.back();
                open.pop_back();
            }
            break;
        }
    }
    return open.empty() ? left : open.front();
}

/// Scans the word once from the right. At a `]` the axis of a branch ends; before its `[` the next
/// module on the axis is the one after the branch. A `[` without its `]` is a branch that reaches
/// to the end of the word.
template <typename C>
void ContextTables::build_right(const C* codes, std::uint64_t next) {
    struct Closed {
        std::uint64_t next; // the next module on the axis behind the branch
        std::uint64_t gap;  // the gap after the `]`
    };
    std::vector<Closed> closed;
    std::uint64_t unignored = count_; // index of the next module or bracket that is not ignored
    next_.set(count_, next);
    for (std::uint64_t i = count_; i-- > 0;) {
        switch (roles_[codes[i]]) {
        case ContextRole::Module:
            next = i;
            unignored = i;
            break;
        case ContextRole::Ignored:
            if (needs_jump_) {
                jump_.set(i, unignored);
            }
            break;
        case ContextRole::Close:
            closed.push_back({next, i + 1});
            next = kNowhere;
            unignored = i;
            break;
        case ContextRole::Open: {
            Closed after{kNowhere, count_};
            if (!closed.empty()) {
                after = closed.back();
                closed.pop_back();
            }
            next = after.next;
            if (needs_jump_) {
                jump_.set(i, after.gap);
            }
            unignored = i;
            break;
        }
        }
        next_.set(i, next);
    }
}

template <typename C>
void ContextTables::build_offsets(const C* codes, const Plan& plan) {
    auto* const offsets = offsets_.as<std::uint64_t>();
    const std::vector<Row>& rows = plan.rows();
    std::uint64_t stored = 0;
    for (std::uint64_t i = 0; i < count_; ++i) {
        if (i % kOffsetStride == 0) {
            offsets[i / kOffsetStride] = stored;
        }
        stored += rows[codes[i]].stored;
    }
}

} // namespace lsys
