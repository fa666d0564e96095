// SPDX-License-Identifier: MIT
// Writes a parsed cpfg file as .lsys text.
//
// Conditions of .lsys draw no random numbers. A random number in a cpfg condition therefore becomes
// a parameter of an intermediate module, which is decomposed at once: `A(x) --> random1(x, {0,
// 1})`, `random1(x, u) : u < 0.5 --> ...`. All productions of the predecessor `A(x)`
// are a group, which shares the module.
#pragma once

#include "grammar/dialects/cpfg/curves.h"
#include "grammar/dialects/cpfg/expressions.h"
#include "grammar/dialects/cpfg/looks.h"
#include "grammar/dialects/cpfg/organs.h"
#include "grammar/dialects/cpfg/session.h"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lsys {

class CpfgWriter {
public:
    CpfgWriter(CpfgSession& session, Translation& out);

    /// Writes the system as .lsys statements. `turtle`: name of the turtle profile.
    void write(std::string_view turtle);

private:
    /// A production translated to .lsys.
    struct Lowered {
        bool is_written = false; // false: left out
        bool in_group = false;   // write_group() writes it with others
        ForeignId condition = kNoForeign;
        ForeignId weight = kNoForeign;
        std::vector<std::vector<ForeignId>> arguments; // one list per module of the successor
        std::size_t first_local = 0;                   // its first local value, in tree_.locals()
        std::size_t end_local = 0;                     // one past its last local value
        std::uint32_t first_draw = 0; // index of its first random number in its group
        std::uint32_t draws = 0;      // count of its random numbers
    };

    // --- names
    /// Collects the names of all modules, and of the modules in predecessors and contexts.
    void collect_names();
    /// Removes the leading `~` of `~s(x) --> ~s(y)`, so that the production rewrites the `s` after
    /// a `~` and keeps the `~`.
    void keep_tilde(CpfgProduction& production) const;
    /// Reports a module that .lsys cannot express or draw; removes its texts.
    void check_module(CpfgModule& module);
    /// Records the symbol after a `~` as a surface.
    void add_surface(const CpfgModule& module);
    /// The .lsys module of a symbol.
    [[nodiscard]] std::string spelled(const std::string& name, bool has_arguments) const;
    /// Names and parameter counts of the predecessor.
    [[nodiscard]] static std::string key_of(const CpfgProduction& production);

    // --- the header
    void write_settings(std::string_view turtle);
    /// Writes `begin` and the value of `expression`, or `fallback` if there is no expression.
    void write_setting(const char* begin, ForeignId expression, const char* fallback);
    /// Writes the number of passes of a stage. Random numbers in conditions of this stage double
    /// the number; random numbers in conditions of Rewrite add one pass of Decompose.
    void write_depth(const char* begin, ForeignId expression, Stage stage);
    /// Reads the view file, and the colours beside it.
    void read_view_file();
    void write_organs();
    /// Sets `is_whole` of the surfaces on which one picture is stretched over all patches. Call it
    /// after the textures have been read. `commands`: the textures that the turtle sets.
    void find_whole_surfaces(const CpfgUses& commands);
    /// Looks for the commands of the model whose effect depends on its view file.
    [[nodiscard]] CpfgUses find_uses() const;
    /// Writes functions, arrays and the variables of `Start:`, which settings may read.
    void write_constants();
    /// Declares the modules that no production rewrites and that draw nothing.
    void write_declarations();
    /// Writes an `#ignore` or `#consider` of the symbols of `list`.
    void write_names(const char* begin, const std::vector<CpfgModule>& list);
    /// Whether some production is of this stage.
    [[nodiscard]] bool has(Stage stage) const;

    // --- productions
    /// Translates the settings and the axiom.
    void lower_header();
    void lower_productions();
    /// Translates a production to .lsys. Precondition: CpfgExpressions::begin() was called for it.
    void lower(std::size_t index);
    /// Finds the modules whose conditions or choices are random. The productions of such a module
    /// become one production that draws the random numbers, and decompositions that choose by the
    /// numbers.
    void find_groups();
    /// Translates the productions again, with their random numbers as parameters.
    void bind_group(const std::vector<std::size_t>& members);
    /// Returns whether the productions can be a group; reports an error if not.
    [[nodiscard]] bool can_bind(const std::vector<std::size_t>& members);
    /// Makes the choice by weights part of the conditions.
    void weigh_group(const std::vector<std::size_t>& members);
    /// The condition under which production `index` of a group is chosen: its own condition holds,
    /// and the last random number, times the sum of the weights of all matching productions, is
    /// less than the sum of their weights up to and including production `index`. The last
    /// production of the group needs only its own condition.
    [[nodiscard]] ForeignId weighted_condition(const std::vector<std::size_t>& members,
                                               std::size_t index);
    /// Chooses names of local values that differ from constants, formals and draws.
    void name_local_values();
    /// Reports productions that .lsys cannot express; returns false for them.
    [[nodiscard]] bool check_production(const CpfgProduction& production);
    void write_production(std::size_t index);
    void write_group(std::size_t index);
    /// Writes the head of a production: `#p1 : left < module > right : `.
    void write_head(const CpfgProduction& production, const std::string& label);
    /// Whether the production could decompose a module of the axiom. cpfg decomposes the words of
    /// productions, but not the axiom.
    [[nodiscard]] bool may_decompose_axiom(const CpfgProduction& production) const;
    void write_condition(std::size_t index, const ForeignWriting& how);
    void write_weight(std::size_t index, const ForeignWriting& how);
    void write_successor(std::size_t index, const ForeignWriting& how);
    /// Writes the .lsys name of a symbol, for which messages show the name in the file.
    void write_name(const CpfgModule& module);
    void write_modules(const std::vector<CpfgModule>& list,
                       const std::vector<std::vector<ForeignId>>& arguments,
                       const ForeignWriting& how);
    /// The arguments of the modules in .lsys.
    [[nodiscard]] std::vector<std::vector<ForeignId>> terms_of(const std::vector<CpfgModule>& list);
    /// Writes a predecessor or context, whose parameters are names.
    void write_pattern(const std::vector<CpfgModule>& list);
    /// Name of the intermediate module of the group with key `index` in groups_.
    [[nodiscard]] std::string random_module(std::size_t index) const;
    /// Warns of a weight that is ignored, and of a choice that cpfg makes differently.
    void warn_weight(const CpfgProduction& production);
    /// Writes parameters and the random numbers of a group in parentheses; nothing if there are
    /// none.
    void write_parameters(const std::vector<std::string>& names,
                          const std::vector<std::string>& draws,
                          SourceSpan span);
    void append_names(ForeignId argument, std::vector<std::string>& names) const;
    [[nodiscard]] std::vector<std::string> formals_of(const CpfgProduction& production) const;
    /// Names of the parameters that hold the random numbers of a group.
    [[nodiscard]] static std::vector<std::string>
    draw_names(const std::vector<std::string>& formals, std::uint32_t count);
    /// Returns true if the production is chosen at random among others.
    [[nodiscard]] bool is_random_choice(const CpfgProduction& production) const;
    /// Returns true if a condition always holds.
    [[nodiscard]] bool is_always(ForeignId condition) const;
    [[nodiscard]] const ForeignNode& expression(ForeignId id) const { return tree_[id]; }

    CpfgSession& session_;
    const ParseContext& context_;
    Translation& out_;
    SourceSpan header_; // place of text that has no place of its own
    CpfgView view_;
    CpfgLooks looks_;
    std::string materials_; // #material statements of the colours that are used
    CpfgExpressions expressions_;
    ForeignExpressions& tree_;
    // Expressions of settings in .lsys.
    ForeignId length_ = kNoForeign; // derivation length
    ForeignId seed_ = kNoForeign;
    ForeignId decompose_depth_ = kNoForeign;
    ForeignId interpret_depth_ = kNoForeign;
    std::vector<std::vector<ForeignId>> axiom_; // arguments per module
    std::vector<Lowered> lowered_;              // one per production
    // Indices of productions among which a random number chooses; the key is the first of them.
    std::map<std::size_t, std::vector<std::size_t>> groups_;
    std::set<Stage> bound_;                        // stages with groups
    std::set<std::string> used_;                   // names of all modules
    std::set<std::pair<std::string, bool>> forms_; // names of modules; true: with arguments
    std::set<std::string> matched_;                // names in predecessors and contexts
    std::map<std::string, SourceSpan> surfaces_;   // letters behind `~`, with the first place
    CpfgOrgans organs_;
    std::optional<SourceSpan> environment_;   // the first `?E`
    std::map<std::string, int> alternatives_; // count of rewriting productions, by key_of()
};

} // namespace lsys
