// SPDX-License-Identifier: MIT
#include "compiler/instancing/impl/branches.h"

#include "compiler/program/append_bytes.h"
#include "grammar/base/contract.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace lsys {

namespace {

/// Whether the drawing of a symbol, or of a word that it can become, depends on the vertical, and
/// whether its rewriting is random.
struct Effects {
    bool depends_on_vertical = false;
    bool is_random = false;

    /// Adds the effects of `other`. Returns whether that changed something.
    bool add(const Effects& other) {
        const bool grows =
            (other.depends_on_vertical && !depends_on_vertical) || (other.is_random && !is_random);
        depends_on_vertical = depends_on_vertical || other.depends_on_vertical;
        is_random = is_random || other.is_random;
        return grows;
    }
};

class BranchFinder {
public:
    BranchFinder(const Program& program, const Names& names, Diagnostics& diagnostics)
        : program_(program), names_(names), diagnostics_(diagnostics),
          rules_of_(program.symbols.size()), effects_(program.symbols.size()) {}

    std::optional<Branches> run() {
        if (const std::optional<std::string> reason = reason_for_whole_plants()) {
            note_whole_plants(*reason);
            return std::move(branches_);
        }
        report_system_obstacles();
        for (const Production& production : program_.productions) {
            if (production.stage == Stage::Rewrite) {
                rules_of_[predecessor_index(production)].push_back(&production.predecessor);
            }
        }
        find_effects();
        for (const Axiom& axiom : program_.axioms) {
            read_word(axiom.word, "axiom", kNone);
        }
        branches_.sites.clear(); // branches of an axiom are never replaced
        // Branches written by a decomposition get no id, because their key does not contain the
        // number of passes left for their modules. Interpreted branches are never rewritten.
        for (std::uint32_t i = 0; i < program_.productions.size(); ++i) {
            const Production& production = program_.productions[i];
            read_word(production.successor, "successor",
                      production.stage == Stage::Rewrite ? i : kNone);
        }
        branches_.axiom_is_random = program_.axioms.size() > 1 || !program_.globals.empty();
        for (const Axiom& axiom : program_.axioms) {
            for_each_symbol(program_, axiom.word, [&](std::size_t, SymbolId symbol) {
                branches_.axiom_is_random =
                    branches_.axiom_is_random || effects_of(symbol).is_random;
            });
            branches_.axiom_is_random = branches_.axiom_is_random || axiom.word.draw_count != 0;
        }
        if (!instanceable_) {
            return std::nullopt;
        }
        note_variety();
        return std::move(branches_);
    }

private:
    /// The reason why no branch of the system can be reused in another place: its growth depends on
    /// the rest of the plant. Nullopt if branches can be reused.
    [[nodiscard]] std::optional<std::string> reason_for_whole_plants() const {
        for (const Symbol& symbol : program_.symbols) {
            if (symbol.sense != Sense::Nothing) {
                return fmt::format("modules `{}` sense where they are", names_.text(symbol.name));
            }
        }
        for (const Production& production : program_.productions) {
            if (production.stage == Stage::Down || production.stage == Stage::Up) {
                return fmt::format("production `{}` of `{}` sweeps the whole plant",
                                   names_.text(production.name), keyword_of(production.stage));
            }
        }
        return std::nullopt;
    }

    void note_whole_plants(const std::string& reason) {
        diagnostics_
            .add(DiagnosticCode::NoVariety, program_.axiom_span(),
                 fmt::format("{}, so heroes share no branches", reason))
            .notes.emplace_back("each tree of a forest is a copy of a whole hero");
    }

    /// Reports a system to which instancing adds no variety.
    void note_variety() {
        const bool is_random = branches_.axiom_is_random ||
                               std::any_of(branches_.kinds.begin(), branches_.kinds.end(),
                                           [](const BranchKind& kind) { return kind.is_random; });
        if (!is_random) {
            diagnostics_
                .add(DiagnosticCode::NoVariety, program_.axiom_span(),
                     "nothing that this system derives is left to chance, so all its plants are "
                     "equal")
                .help.emplace_back(
                    "let chance in: a random range, `+({20, 30})`, or two productions "
                    "of a module with probabilities, `* ~ 0.5`");
        } else if (branches_.kinds.empty()) {
            diagnostics_
                .add(DiagnosticCode::NoVariety, program_.axiom_span(),
                     "no branch of this system holds a module with a production")
                .notes.emplace_back("nothing can be put in place of anything, so its plants are "
                                    "copies of the heroes");
        }
    }

    /// A `[` whose `]` has not been read yet.
    struct OpenBranch {
        std::uint32_t index = 0;    // index of the `[` among the modules of the word
        std::uint32_t site = kNone; // index in found_
        std::uint32_t polygons = 0; // number of polygons open at the `[`
        bool valid = false;         // some production can rewrite a module of the branch
        Effects effects;
        std::string key; // made of the modules read so far; equal branches have equal keys
        std::vector<std::uint32_t> formals; // formals used so far
        std::vector<std::uint32_t> locals;  // local values used so far
    };
    /// A closed branch, valid or not.
    struct FoundBranch {
        BranchSite site;
        std::uint32_t kind = 0; // index in found_kinds_
        bool valid = false;
    };
    /// A set of equal branches, valid or not.
    struct FoundKind {
        std::vector<std::uint32_t> formals;
        std::vector<std::uint32_t> locals;
        Effects effects;
        std::uint32_t id = 0; // 0 until a valid branch of this kind is found
    };

    /// Reports a reason why the system cannot be instanced.
    Diagnostic& refuse(SourceSpan span, std::string message) {
        instanceable_ = false;
        return diagnostics_.add(DiagnosticCode::NotInstanceable, span, std::move(message));
    }

    void report_system_obstacles() {
        if (program_.settings.choice == ChoiceScope::Generation) {
            refuse(program_.axiom_span(), "a system with `choice generation` cannot be instanced")
                .notes.emplace_back("the branches of one generation all choose alike, which "
                                    "branches that are put together from others would not");
        }
        if (std::any_of(program_.symbols.begin(), program_.symbols.end(), [](const auto& symbol) {
                return info(symbol.turtle).has(TurtleInfo::DependsOnPlace);
            })) {
            refuse(program_.axiom_span(), "a system that aims at points cannot be instanced")
                .notes.emplace_back("a branch moved to another place would aim at another point");
        }
        for (const Production& production : program_.productions) {
            const std::string_view name = names_.text(production.name);
            const bool rewrites_brackets = std::any_of(
                production.predecessor.items.begin(), production.predecessor.items.end(),
                [&](const ProgramPatternItem& item) {
                    return program_.symbol(item.symbol).kind == SymbolKind::BranchOpen;
                });
            if (rewrites_brackets) {
                refuse(production.predecessor.span,
                       fmt::format("production `{}` rewrites a branch with what is around it, so "
                                   "its system cannot be instanced",
                                   name));
            }
            if (production.has_left || production.has_right) {
                refuse(production.has_left ? production.left.span : production.right.span,
                       fmt::format("production `{}` has a context, so its system cannot be "
                                   "instanced",
                                   name))
                    .notes.emplace_back("a branch with a context depends on its neighbours, which "
                                        "differ in another place");
            }
        }
    }

    [[nodiscard]] static std::size_t predecessor_index(const Production& production) {
        return static_cast<std::size_t>(production.predecessor.items.front().symbol);
    }

    /// Whether a predecessor of a production of Stage::Rewrite matches the symbols at module
    /// `index` of a word. Predecessors have no brackets, so a match stays within its branch.
    [[nodiscard]] bool is_rewritten(const ProgramWord& word, std::uint32_t index) const {
        const SymbolId symbol = program_.modules[word.first_module + index].symbol;
        const auto& rules = rules_of_[static_cast<std::size_t>(symbol)];
        return std::any_of(rules.begin(), rules.end(), [&](const ProgramPattern* pattern) {
            if (pattern->items.size() > word.module_count - index) {
                return false;
            }
            for (std::uint32_t i = 1; i < pattern->items.size(); ++i) {
                if (program_.modules[word.first_module + index + i].symbol !=
                    pattern->items[i].symbol) {
                    return false;
                }
            }
            return true;
        });
    }

    [[nodiscard]] const Effects& effects_of(SymbolId symbol) const {
        return effects_[static_cast<std::size_t>(symbol)];
    }

    /// Computes effects_ as a least fixed point: a symbol has the effects of the symbols that its
    /// productions write.
    void find_effects() {
        for (std::size_t i = 0; i < program_.symbols.size(); ++i) {
            const TurtleOperation turtle = program_.symbols[i].turtle;
            effects_[i].depends_on_vertical =
                info(turtle).has(TurtleInfo::DependsOnVertical) ||
                ((program_.settings.has_tropism || has_tropisms(program_.settings.tropisms)) &&
                 draws(turtle));
        }
        std::vector<std::uint32_t> rule_sizes(program_.rule_count, 0);
        for (const Production& production : program_.productions) {
            ++rule_sizes[production.rule];
        }
        for (const Production& production : program_.productions) {
            Effects& effects = effects_[predecessor_index(production)];
            effects.is_random = effects.is_random || production.successor.draw_count != 0 ||
                                (production.stochastic && rule_sizes[production.rule] > 1);
        }
        const GroupedLists writers = writers_of(program_);
        std::vector<std::uint32_t> changed(program_.symbols.size());
        std::iota(changed.begin(), changed.end(), 0U);
        while (!changed.empty()) {
            const std::uint32_t symbol = changed.back();
            changed.pop_back();
            for (const std::uint32_t p : writers[symbol]) {
                const std::size_t predecessor = predecessor_index(program_.productions[p]);
                if (effects_[predecessor].add(effects_[symbol])) {
                    changed.push_back(static_cast<std::uint32_t>(predecessor));
                }
            }
        }
    }

    [[nodiscard]] SourceSpan span_of(const ProgramWord& word, std::uint32_t index) const {
        const std::uint32_t begin = program_.modules[word.first_module + index].begin;
        return {word.file, begin, begin + 1};
    }

    /// Finds the branches of a word. `where`: "axiom" or "successor", for messages. `production`:
    /// the production to which the branches of the word belong; kNone if they get no ids.
    void read_word(const ProgramWord& word, const char* where, std::uint32_t production) {
        open_.clear();
        found_.clear();
        local_count_ =
            production == kNone
                ? 0
                : static_cast<std::uint32_t>(program_.productions[production].locals.size());
        std::uint32_t index = 0;
        std::uint32_t polygons = 0;
        std::size_t argument = word.first_argument;
        for_each_symbol(program_, word, [&](std::size_t, SymbolId id) {
            const Symbol& symbol = program_.symbol(id);
            const std::size_t arguments = argument;
            argument += symbol.parameter_count;
            switch (symbol.kind) {
            case SymbolKind::BranchOpen:
                open_.push_back({});
                open_.back().index = index;
                open_.back().site = static_cast<std::uint32_t>(found_.size());
                open_.back().polygons = polygons;
                found_.push_back({});
                break;
            case SymbolKind::BranchClose:
                if (open_.empty()) {
                    refuse(span_of(word, index),
                           fmt::format("`]` closes no branch of this {}, so the system cannot be "
                                       "instanced",
                                       where));
                } else {
                    close(word, index, production, polygons);
                }
                break;
            case SymbolKind::PolygonOpen:
                ++polygons;
                add_module(word, index, arguments);
                break;
            case SymbolKind::PolygonClose:
                if (polygons == 0) {
                    refuse_open_polygon(word, index, where);
                }
                polygons -= polygons > 0 ? 1U : 0U;
                if (!open_.empty() && polygons < open_.back().polygons) {
                    refuse_crossing_polygon(word, open_.back().index);
                    open_.back().polygons = polygons;
                }
                add_module(word, index, arguments);
                break;
            case SymbolKind::Plain:
                add_module(word, index, arguments);
                break;
            }
            ++index;
        });
        if (!open_.empty()) {
            refuse(span_of(word, open_.back().index),
                   fmt::format("`[` is closed nowhere in this {}, so the system cannot be "
                               "instanced",
                               where));
        }
        if (polygons != 0) {
            refuse_open_polygon(word, 0, where);
        }
        if (production != kNone) {
            give_ids();
        }
    }

    void refuse_open_polygon(const ProgramWord& word, std::uint32_t index, const char* where) {
        refuse(span_of(word, index),
               fmt::format("a polygon begins and ends in different words, as in this {}, so the "
                           "system cannot be instanced",
                           where));
    }

    void refuse_crossing_polygon(const ProgramWord& word, std::uint32_t index) {
        refuse(span_of(word, index),
               "a polygon goes across the border of this branch, so the system cannot be "
               "instanced");
    }

    void add_module(const ProgramWord& word, std::uint32_t index, std::size_t first_argument) {
        if (open_.empty()) {
            return;
        }
        const SymbolId id = program_.modules[word.first_module + index].symbol;
        OpenBranch& open = open_.back();
        append_bytes(open.key, id);
        for (std::uint32_t i = 0; i < program_.symbol(id).parameter_count; ++i) {
            add_value(program_.arguments[first_argument + i], open);
        }
        open.valid = open.valid || is_rewritten(word, index);
        open.effects.add(effects_of(id));
    }

    /// Appends an expression to the key in prefix order.
    void add_value(ValueId root, OpenBranch& open) {
        values_.assign(1, root);
        while (!values_.empty()) {
            const Value& value = program_.value(values_.back());
            values_.pop_back();
            append_bytes(open.key, value.opcode);
            switch (value.opcode) {
            case Opcode::Literal:
                append_bytes(open.key, std::bit_cast<std::uint32_t>(value.literal));
                break;
            case Opcode::Formal:
                open.formals.push_back(value.index);
                append_bytes(open.key, value.index);
                break;
            case Opcode::Local:
                if (value.index < local_count_) {
                    open.locals.push_back(value.index);
                }
                append_bytes(open.key, value.index);
                break;
            case Opcode::Global:
            case Opcode::Curve:
            case Opcode::SetLocal:
                append_bytes(open.key, value.index);
                break;
            case Opcode::Range:
            case Opcode::Normal:
            case Opcode::Poisson:
            case Opcode::Binomial:
                open.effects.is_random = true; // the number of a draw is not part of the key
                break;
            default:
                break;
            }
            for (const ValueId operand : value.operands()) {
                if (operand != kNoValue) {
                    values_.push_back(operand);
                }
            }
        }
    }

    /// Ends the innermost open branch at the `]` with index `index` of the word. `polygons`: number
    /// of polygons open there.
    void close(const ProgramWord& word,
               std::uint32_t index,
               std::uint32_t production,
               std::uint32_t polygons) {
        OpenBranch open = std::move(open_.back());
        open_.pop_back();
        if (open.valid && (open.polygons != 0 || polygons != 0)) {
            refuse_crossing_polygon(word, open.index);
        }
        for (std::vector<std::uint32_t>* const used : {&open.formals, &open.locals}) {
            std::sort(used->begin(), used->end());
            used->erase(std::unique(used->begin(), used->end()), used->end());
        }
        const auto [known, is_new] = kind_of_key_.emplace(
            std::move(open.key), static_cast<std::uint32_t>(found_kinds_.size()));
        if (is_new) {
            found_kinds_.push_back({open.formals, open.locals, open.effects, 0});
        }
        FoundBranch& found = found_[open.site];
        found.site.production = production;
        found.site.open = open.index;
        found.site.close = index;
        found.kind = known->second;
        found.valid = open.valid;
        if (open_.empty()) {
            return;
        }
        OpenBranch& outer = open_.back();
        constexpr SymbolId kNestedBranch{0xFFFFFFFEu}; // not a symbol: a nested branch
        append_bytes(outer.key, kNestedBranch);
        append_bytes(outer.key, known->second);
        outer.valid = outer.valid || open.valid;
        outer.effects.add(open.effects);
        outer.formals.insert(outer.formals.end(), open.formals.begin(), open.formals.end());
        outer.locals.insert(outer.locals.end(), open.locals.begin(), open.locals.end());
    }

    /// Adds the valid branches of the current word to branches_, with the ids of their kinds.
    void give_ids() {
        std::uint32_t number = 0;
        for (FoundBranch& found : found_) {
            if (!found.valid) {
                continue;
            }
            FoundKind& kind = found_kinds_[found.kind];
            if (kind.id == 0) {
                kind.id = static_cast<std::uint32_t>(branches_.kinds.size()) + 1;
                branches_.kinds.push_back(
                    {static_cast<std::uint32_t>(branches_.sites.size()), kind.formals, kind.locals,
                     kind.effects.depends_on_vertical, kind.effects.is_random});
            }
            found.site.kind_id = kind.id;
            found.site.number = number++;
            branches_.sites.push_back(found.site);
        }
    }

    const Program& program_;
    const Names& names_;
    Diagnostics& diagnostics_;
    std::vector<std::vector<const ProgramPattern*>> rules_of_; // predecessors per first symbol
    std::vector<Effects> effects_;                             // per symbol
    std::vector<OpenBranch> open_;   // branches around the current item, outermost first
    std::vector<FoundBranch> found_; // branches of the current word, in order of their `[`
    std::vector<FoundKind> found_kinds_;
    std::unordered_map<std::string, std::uint32_t> kind_of_key_; // index in found_kinds_
    std::vector<ValueId> values_;                                // stack of add_value()
    std::uint32_t local_count_ = 0; // number of local values of the current production
    Branches branches_;
    bool instanceable_ = true; // no obstacle has been reported
};

} // namespace

std::optional<Branches>
find_branches(const Program& program, const Names& names, Diagnostics& diagnostics) {
    LSYS_CHECK(program.is_valid);
    return BranchFinder(program, names, diagnostics).run();
}

} // namespace lsys
