// SPDX-License-Identifier: MIT
// Brackets that only balance across productions: one production leaves a branch open that another
// closes. For each module and all generations, a fixed point over the productions bounds the number
// of brackets left open by the words that the module becomes, and the lowest bracket depth within
// these words. The bounds decide whether a `]` can ever lack its `[`.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

namespace lsys {

namespace {

constexpr std::int64_t kUnbounded = std::int64_t{1} << 40; // beyond the depth of any text
/// Number of changes of a module's bounds after which a bound that changes again becomes infinite.
constexpr std::uint32_t kMaxChanges = 16;

/// Bounds over all words that a module can become: min and max bracket depth at the end, and lowest
/// depth within, relative to the depth before the word.
struct Depth {
    std::int64_t low = 0;
    std::int64_t high = 0;
    std::int64_t lowest = 0;

    friend bool operator==(const Depth&, const Depth&) = default;
};

/// `value` limited to -kUnbounded ... kUnbounded.
std::int64_t bounded(std::int64_t value) {
    return std::clamp(value, -kUnbounded, kUnbounded);
}

/// The bounds of a word with the bounds `first`, followed by one with the bounds `second`.
Depth after(const Depth& first, const Depth& second) {
    return {bounded(first.low + second.low), bounded(first.high + second.high),
            std::min(first.lowest, bounded(first.low + second.lowest))};
}

/// The bounds of a word that has the bounds `a` or `b`.
Depth either(const Depth& a, const Depth& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high), std::min(a.lowest, b.lowest)};
}

class DepthAnalysis {
public:
    explicit DepthAnalysis(const Program& program)
        : program_(program), depth_(program.symbols.size()),
          change_counts_(program.symbols.size(), 0) {
        for (std::size_t s = 0; s < depth_.size(); ++s) {
            if (program.symbols[s].kind == SymbolKind::BranchOpen) {
                depth_[s] = {1, 1, 0};
            } else if (program.symbols[s].kind == SymbolKind::BranchClose) {
                depth_[s] = {-1, -1, -1};
            }
        }
    }

    [[nodiscard]] Depth depth_of(const ProgramWord& word) const {
        Depth total;
        for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
            total = after(total, depth_[static_cast<std::size_t>(symbol)]);
        });
        return total;
    }

    void run() {
        const GroupedLists writers = writers_of(program_);
        std::deque<std::uint32_t> work(program_.productions.size());
        std::iota(work.begin(), work.end(), 0U);
        std::vector<bool> queued(program_.productions.size(), true);
        while (!work.empty()) {
            const std::uint32_t p = work.front();
            work.pop_front();
            queued[p] = false;
            const auto s =
                static_cast<std::size_t>(program_.productions[p].predecessor.items.front().symbol);
            Depth next = either(depth_[s], depth_of(program_.productions[p].successor));
            if (next == depth_[s]) {
                continue;
            }
            if (++change_counts_[s] > kMaxChanges) { // assume that the bound changes without end
                next.low = next.low < depth_[s].low ? -kUnbounded : next.low;
                next.high = next.high > depth_[s].high ? kUnbounded : next.high;
                next.lowest = next.lowest < depth_[s].lowest ? -kUnbounded : next.lowest;
            }
            depth_[s] = next;
            for (const std::uint32_t user : writers[s]) {
                if (!queued[user]) {
                    queued[user] = true;
                    work.push_back(user);
                }
            }
        }
    }

private:
    const Program& program_;
    std::vector<Depth> depth_;                 // by symbol
    std::vector<std::uint32_t> change_counts_; // by symbol: number of changes of depth_
};

/// The number of `[` minus the number of `]`.
std::int64_t balance(const Program& program, const ProgramWord& word) {
    std::int64_t sum = 0;
    for_each_symbol(program, word, [&](std::size_t, SymbolId symbol) {
        const SymbolKind kind = program.symbol(symbol).kind;
        sum += kind == SymbolKind::BranchOpen ? 1 : kind == SymbolKind::BranchClose ? -1 : 0;
    });
    return sum;
}

} // namespace

void check_branch_depth(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    // The first production that leaves a branch open, and the first that closes more than it opens.
    const Production* opening = nullptr;
    const Production* closing = nullptr;
    for (const Production& production : program.productions) {
        if (production.predecessor.items.size() != 1) {
            return; // no bound on the depth if a predecessor has several modules
        }
        const std::int64_t sum = balance(program, production.successor);
        opening = sum > 0 && opening == nullptr ? &production : opening;
        closing = sum < 0 && closing == nullptr ? &production : closing;
    }
    const std::vector<Axiom>& axioms = program.axioms;
    const bool axiom_opens = std::any_of(axioms.begin(), axioms.end(), [&](const Axiom& axiom) {
        return balance(program, axiom.word) > 0;
    });
    if (closing == nullptr || (opening == nullptr && !axiom_opens)) {
        return;
    }
    DepthAnalysis analysis(program);
    analysis.run();
    if (std::any_of(axioms.begin(), axioms.end(),
                    [&](const Axiom& axiom) { return analysis.depth_of(axiom.word).lowest < 0; })) {
        return;
    }
    // The note below replaces the warnings about brackets of these two productions.
    diagnostics.reassign_severities([&](const Diagnostic& known) -> std::optional<Severity> {
        const auto is_of = [&](const Production* production) {
            return production != nullptr && known.span.file == production->span.file &&
                   known.span.begin >= production->span.begin &&
                   known.span.end <= production->span.end;
        };
        const bool is_explained =
            (known.code == DiagnosticCode::UnopenedBranch && is_of(closing)) ||
            (known.code == DiagnosticCode::UnclosedBranch && is_of(opening));
        return is_explained ? std::nullopt : std::optional(known.severity);
    });
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::BalancedAcross, closing->name_span,
        fmt::format(
            "the brackets of {} balance only with those of {}", quoted(input.name(closing->name)),
            opening != nullptr ? quoted(input.name(opening->name)) : std::string("the axiom")));
    diagnostic.labels.push_back(
        {opening != nullptr ? opening->name_span : program.axiom_span(), "leaves branches open"});
    diagnostic.notes.emplace_back("no word of this grammar has a `]` without its `[`");
}

} // namespace lsys
