// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/match.h"

#include <algorithm>

namespace lsys {

template <typename C>
bool Matcher<C>::matches_predecessor(const BytecodeProduction& production,
                                     std::uint64_t index) const {
    const TableRange pattern = production.predecessor;
    if (pattern.count > word_.count - index) {
        return false;
    }
    for (std::uint32_t i = 1; i < pattern.count; ++i) {
        if (symbol_at(index + i) != plan_.bytecode().patterns[pattern.first + i].symbol) {
            return false;
        }
    }
    return true;
}

template <typename C>
bool Matcher<C>::matches_left(const BytecodeProduction& production, std::uint64_t index) {
    const TableRange pattern = production.left;
    left_.resize(pattern.count);
    for (std::uint32_t i = pattern.count; i-- > 0;) {
        index = contexts_->left_of(index);
        if (index == kNowhere ||
            symbol_at(index) != plan_.bytecode().patterns[pattern.first + i].symbol) {
            return false;
        }
        left_[i] = index;
    }
    return true;
}

template <typename C>
bool Matcher<C>::matches_right(const BytecodeProduction& production, std::uint64_t index) {
    const TableRange pattern = production.right;
    std::uint64_t gap = index + production.predecessor.count;
    right_.resize(pattern.count);
    branches_.clear();
    for (std::uint32_t i = 0; i < pattern.count; ++i) {
        const PatternItem& item = plan_.bytecode().patterns[pattern.first + i];
        switch (item.kind) {
        case PatternKind::Module: {
            const std::uint64_t found = contexts_->next_from(gap);
            if (found == kNowhere || symbol_at(found) != item.symbol) {
                return false;
            }
            right_[i] = found;
            gap = found + 1;
            break;
        }
        case PatternKind::Open:
            if (contexts_->plain()) {
                return false;
            }
            if (gap < word_.count && contexts_->role(word_.codes[gap]) == ContextRole::Ignored) {
                gap = contexts_->jump_from(gap);
            }
            if (gap == word_.count || contexts_->role(word_.codes[gap]) != ContextRole::Open) {
                return false;
            }
            branches_.push_back(contexts_->jump_from(gap));
            ++gap;
            break;
        case PatternKind::Close:
            gap = branches_.back();
            branches_.pop_back();
            break;
        }
    }
    return true;
}

template <typename C>
bool Matcher<C>::matches_contexts(const BytecodeProduction& production, std::uint64_t index) {
    return (!production.has_left || matches_left(production, index)) &&
           (!production.has_right || matches_right(production, index));
}

template <typename C>
std::uint64_t Matcher<C>::parameters_before(std::uint64_t index, ModulePlace near) const {
    const std::vector<Row>& rows = plan_.rows();
    // Most context modules are close to `near`. Counting parameters from there is then faster than
    // a lookup in the table of offsets.
    if (index >= near.index && index - near.index < ContextTables::kOffsetStride) {
        for (; near.index < index; ++near.index) {
            near.parameter += rows[word_.codes[near.index]].stored;
        }
        return near.parameter;
    }
    if (index < near.index && near.index - index < ContextTables::kOffsetStride / 4) {
        for (; near.index > index; --near.index) {
            near.parameter -= rows[word_.codes[near.index - 1]].stored;
        }
        return near.parameter;
    }
    std::uint64_t before = contexts_->offset_before(index);
    for (std::uint64_t i = index / ContextTables::kOffsetStride * ContextTables::kOffsetStride;
         i < index; ++i) {
        before += rows[word_.codes[i]].stored;
    }
    return before;
}

template <typename C>
void Matcher<C>::gather_formals(TableRange pattern,
                                const std::vector<std::uint64_t>& places,
                                ModulePlace near) {
    const Bytecode& bytecode = plan_.bytecode();
    for (std::uint32_t i = 0; i < pattern.count; ++i) {
        const PatternItem& item = bytecode.patterns[pattern.first + i];
        if (item.kind != PatternKind::Module) {
            continue;
        }
        const std::uint32_t count = bytecode.symbol(item.symbol).parameter_count;
        if (count == 0) {
            continue;
        }
        const bool folded = word_.codes[places[i]] >= bytecode.symbols.size();
        const float* const values =
            own_parameters({places[i], folded ? 0 : parameters_before(places[i], near)});
        std::copy(values, values + count, formals_.begin() + item.first_formal);
    }
}

template <typename C>
const float* Matcher<C>::formals(const Candidate& candidate, const ModulePlace& place) {
    if (!candidate.gathers) {
        return own_parameters(place);
    }
    const BytecodeProduction& production = plan_.bytecode().productions[candidate.production];
    formals_.resize(production.formal_count);
    predecessor_.resize(production.predecessor.count);
    for (std::uint32_t i = 0; i < production.predecessor.count; ++i) {
        predecessor_[i] = place.index + i;
    }
    gather_formals(production.predecessor, predecessor_, place);
    if (candidate.reads_context) {
        gather_formals(production.left, left_, place);
        gather_formals(production.right, right_, place);
    }
    return formals_.data();
}

template <typename C>
const float* Matcher<C>::formals_after_search(const Candidate& candidate,
                                              const ModulePlace& place) {
    if (candidate.reads_context) {
        static_cast<void>(
            matches_contexts(plan_.bytecode().productions[candidate.production], place.index));
    }
    return formals(candidate, place);
}

template class Matcher<std::uint8_t>;
template class Matcher<std::uint16_t>;
template class Matcher<std::uint32_t>;

} // namespace lsys
