// SPDX-License-Identifier: MIT
#include "runtime/derive/impl/traced_word.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr std::uint64_t kStride = 4096;

} // namespace

TracedWord::TracedWord(const Bytecode& bytecode, const Word& word)
    : bytecode_(bytecode), word_(word) {
    std::vector<std::uint32_t> stored(bytecode.code_count());
    for (Code code = 0; code < stored.size(); ++code) {
        stored[code] = bytecode.stored_parameters(code);
    }
    word.visit([&](auto codes) {
        std::uint64_t before = 0;
        for (std::uint64_t i = 0; i < codes.size(); ++i) {
            if (i % kStride == 0) {
                parameters_before_.push_back(before);
            }
            before += stored[codes[i]];
        }
    });
}

TracedModule TracedWord::module(std::uint64_t position) const {
    const Code code = word_.code(position);
    TracedModule module{bytecode_.symbol_of(code), {}};
    const std::uint32_t count = bytecode_.symbol(module.symbol).parameter_count;
    const float* values = nullptr;
    if (code >= bytecode_.symbols.size()) {
        values = bytecode_.constants.data() +
                 bytecode_.folded[code - bytecode_.symbols.size()].first_constant;
    } else {
        std::uint64_t before = parameters_before_[position / kStride];
        for (std::uint64_t i = position / kStride * kStride; i < position; ++i) {
            before += bytecode_.stored_parameters(word_.code(i));
        }
        values = word_.parameters().data() + before;
    }
    module.values.assign(values, values + count);
    return module;
}

bool TracedWord::is_ignored(std::uint64_t position) const {
    return bytecode_.symbol(symbol(position)).ignored;
}

std::optional<std::uint64_t> TracedWord::left_of(std::uint64_t position,
                                                 ContextTrace& trace) const {
    while (position > 0) {
        --position;
        switch (kind(position)) {
        case SymbolKind::BranchOpen:
            break;
        case SymbolKind::BranchClose: {
            std::uint64_t depth = 1;
            while (depth > 0) {
                if (position == 0) {
                    return std::nullopt;
                }
                --position;
                const SymbolKind found = kind(position);
                depth += found == SymbolKind::BranchClose ? 1U : 0U;
                depth -= found == SymbolKind::BranchOpen ? 1U : 0U;
            }
            ++trace.branches;
            break;
        }
        default:
            if (!is_ignored(position)) {
                return position;
            }
            ++trace.ignored;
        }
    }
    return std::nullopt;
}

std::uint64_t TracedWord::after_branch(std::uint64_t open) const {
    std::uint64_t depth = 0;
    for (std::uint64_t i = open; i < count(); ++i) {
        const SymbolKind found = kind(i);
        depth += found == SymbolKind::BranchOpen ? 1U : 0U;
        depth -= found == SymbolKind::BranchClose ? 1U : 0U;
        if (depth == 0) {
            return i + 1;
        }
    }
    return count();
}

std::optional<std::uint64_t> TracedWord::next_from(std::uint64_t gap, ContextTrace& trace) const {
    while (gap < count()) {
        switch (kind(gap)) {
        case SymbolKind::BranchOpen:
            gap = after_branch(gap);
            ++trace.branches;
            break;
        case SymbolKind::BranchClose:
            return std::nullopt;
        default:
            if (!is_ignored(gap)) {
                return gap;
            }
            ++trace.ignored;
            ++gap;
        }
    }
    return std::nullopt;
}

ContextTrace TracedWord::left(const BytecodeProduction& production, std::uint64_t position) const {
    ContextTrace trace;
    for (std::uint32_t i = production.left.count; i-- > 0;) {
        trace.item = i;
        const std::optional<std::uint64_t> found = left_of(position, trace);
        if (!found) {
            trace.end = ContextEnd::EndOfPath;
            return trace;
        }
        position = *found;
        trace.visited.push_back({position, i, module(position)});
        if (symbol(position) != bytecode_.patterns[production.left.first + i].symbol) {
            trace.end = ContextEnd::OtherModule;
            return trace;
        }
    }
    trace.end = ContextEnd::Fits;
    return trace;
}

ContextTrace TracedWord::right(const BytecodeProduction& production, std::uint64_t gap) const {
    ContextTrace trace;
    std::vector<std::uint64_t> after; // gaps after the open branches of the pattern
    for (std::uint32_t i = 0; i < production.right.count; ++i) {
        trace.item = i;
        const PatternItem& item = bytecode_.patterns[production.right.first + i];
        switch (item.kind) {
        case PatternKind::Module: {
            const std::optional<std::uint64_t> found = next_from(gap, trace);
            if (!found) {
                trace.end = ContextEnd::EndOfPath;
                return trace;
            }
            trace.visited.push_back({*found, i, module(*found)});
            if (symbol(*found) != item.symbol) {
                trace.end = ContextEnd::OtherModule;
                return trace;
            }
            gap = *found + 1;
            break;
        }
        case PatternKind::Open:
            while (gap < count() && kind(gap) != SymbolKind::BranchOpen &&
                   kind(gap) != SymbolKind::BranchClose && is_ignored(gap)) {
                ++gap;
                ++trace.ignored;
            }
            if (gap == count() || kind(gap) != SymbolKind::BranchOpen) {
                trace.end = ContextEnd::NoBranch;
                return trace;
            }
            after.push_back(after_branch(gap));
            ++gap;
            break;
        case PatternKind::Close:
            gap = after.back();
            after.pop_back();
            break;
        }
    }
    trace.end = ContextEnd::Fits;
    return trace;
}

std::optional<std::uint64_t> TracedWord::cut_of(std::uint64_t position) const {
    std::optional<std::uint64_t> cut;
    std::uint64_t depth = 0; // number of branches opened after the cut
    for (std::uint64_t i = 0; i <= position; ++i) {
        const SymbolKind found = kind(i);
        const bool cuts = bytecode_.symbol(symbol(i)).turtle == TurtleOperation::Cut;
        if (!cut && cuts) {
            cut = i;
            depth = 0;
        } else if (cut && !cuts && found == SymbolKind::BranchOpen) {
            ++depth;
        } else if (cut && !cuts && found == SymbolKind::BranchClose) {
            if (depth == 0) {
                cut.reset();
            } else {
                --depth;
            }
        }
    }
    return cut;
}

} // namespace lsys
