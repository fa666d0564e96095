// SPDX-License-Identifier: MIT
// Matcher: finds the contexts and formals of one module of a word, to choose a production and to
// evaluate its arguments. Each thread has its own.
#pragma once

#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/origin.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace lsys {

/// A word, or a block of a streamed word, as input of a pass. Positions count from
/// `first_position`, which is 0 for a whole word.
template <typename C>
struct WordView {
    const C* codes = nullptr;
    const float* parameters = nullptr;
    std::uint64_t count = 0; // number of modules
    std::uint64_t first_position = 0;
    const Origin* origins = nullptr; // one per module, if they are kept
};

/// Calls visit with the WordView of a whole word.
template <typename Visit>
decltype(auto) visit_view(const Word& word, Visit&& visit) {
    return word.visit([&](auto codes) {
        using C = std::remove_const_t<typename decltype(codes)::element_type>;
        return visit(WordView<C>{codes.data(), word.parameters().data(), word.module_count(), 0,
                                 word.keeps_origins() ? word.origins().data() : nullptr});
    });
}

/// A module of a WordView, with the number of parameters stored before it.
struct ModulePlace {
    std::uint64_t index = 0;
    std::uint64_t parameter = 0;
};

template <typename C>
class Matcher {
public:
    /// `contexts` may be null if no active production has a context.
    Matcher(const Plan& plan, const WordView<C>& word, const ContextTables* contexts)
        : plan_(plan), word_(word), contexts_(contexts) {}

    /// The parameters of a module, stored in the word or constant.
    [[nodiscard]] const float* own_parameters(const ModulePlace& place) const {
        const Row& row = plan_.row(word_.codes[place.index]);
        return row.constants == kNone ? word_.parameters + place.parameter
                                      : plan_.bytecode().constants.data() + row.constants;
    }
    /// Whether the modules after `index` match the predecessor's modules after its first.
    [[nodiscard]] bool matches_predecessor(const BytecodeProduction& production,
                                           std::uint64_t index) const;
    /// Whether the contexts of `production` match around the predecessor at `index`. Stores the
    /// matched modules for formals().
    [[nodiscard]] bool matches_contexts(const BytecodeProduction& production, std::uint64_t index);
    /// All formals of the candidate's production for the module at `place`. Precondition if some
    /// formals belong to contexts: the last matches_contexts() was for the group of this production
    /// and this place.
    [[nodiscard]] const float* formals(const Candidate& candidate, const ModulePlace& place);
    /// formals() after a new search for the contexts, for calls without matches_contexts().
    [[nodiscard]] const float* formals_after_search(const Candidate& candidate,
                                                    const ModulePlace& place);

private:
    [[nodiscard]] bool matches_left(const BytecodeProduction& production, std::uint64_t index);
    [[nodiscard]] bool matches_right(const BytecodeProduction& production, std::uint64_t index);
    [[nodiscard]] SymbolId symbol_at(std::uint64_t index) const {
        return plan_.bytecode().symbol_of(word_.codes[index]);
    }
    /// The number of parameters stored before module `index`.
    [[nodiscard]] std::uint64_t parameters_before(std::uint64_t index, ModulePlace near) const;
    /// Copies the parameters of matched modules to formals_. `places`: the module matched by each
    /// item of `pattern`; `near`: a place from which parameters are counted.
    void
    gather_formals(TableRange pattern, const std::vector<std::uint64_t>& places, ModulePlace near);

    const Plan& plan_;
    const WordView<C>& word_;
    const ContextTables* contexts_;
    std::vector<std::uint64_t> left_;        // module matched by each item of the left context
    std::vector<std::uint64_t> right_;       // module matched by each item of the right context
    std::vector<std::uint64_t> predecessor_; // module matched by each item of the predecessor
    std::vector<std::uint64_t> branches_;    // gaps after the branches that the search has entered
    std::vector<float> formals_;             // result of formals(), if they are gathered
};

} // namespace lsys
