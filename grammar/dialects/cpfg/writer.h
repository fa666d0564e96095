// SPDX-License-Identifier: MIT
// Writes a parsed cpfg file as .lsys text.
//
// Conditions of .lsys draw no random numbers. A random number in a cpfg condition therefore becomes
// a parameter of an intermediate module, which is decomposed at once: `A(x) --> random1(x, {0,
// 1})`, `random1(x, u) : u < 0.5 --> ...`. All productions of such a predecessor
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
        bool is_written = false;
        bool in_group = false;
        ForeignId condition = kNoForeign;
        ForeignId weight = kNoForeign;
        std::vector<std::vector<ForeignId>> arguments; // one list per module of the successor
        std::size_t first_local = 0;                   // index of its first local value
        std::size_t end_local = 0;
        std::uint32_t first_draw = 0; // index of its first random number in its group
        std::uint32_t draws = 0;
    };

    // --- names
    void find_names();
    void keep_tilde(CpfgProduction& production) const;
    void check_module(CpfgModule& module);
    void add_surface(const CpfgModule& module);
    [[nodiscard]] std::string spelled(const std::string& name, bool has_arguments) const;
    [[nodiscard]] static std::string key_of(const CpfgProduction& production);

    // --- the header
    void write_settings(std::string_view turtle);
    void write_setting(const char* begin, ForeignId expression, const char* fallback);
    void write_depth(const char* begin, ForeignId expression, Stage stage);
    void read_view_file();
    void write_organs();
    [[nodiscard]] CpfgUses find_uses() const;
    void write_constants();
    void write_declarations();
    void write_names(const char* begin, const std::vector<CpfgModule>& list);
    [[nodiscard]] bool has(Stage stage) const;

    // --- productions
    void lower_header();
    void lower_productions();
    void lower(std::size_t index);
    void find_groups();
    void bind_group(const std::vector<std::size_t>& members);
    [[nodiscard]] bool can_bind(const std::vector<std::size_t>& members);
    void weigh_group(const std::vector<std::size_t>& members);
    [[nodiscard]] ForeignId weighted_condition(const std::vector<std::size_t>& members,
                                               std::size_t index);
    void find_local_names();
    [[nodiscard]] bool check(const CpfgProduction& production);
    void write_production(std::size_t index);
    void write_group(std::size_t index);
    void write_head(const CpfgProduction& production, const std::string& label);
    [[nodiscard]] bool may_decompose_axiom(const CpfgProduction& production) const;
    void write_condition(std::size_t index, const ForeignWriting& how);
    void write_weight(std::size_t index, const ForeignWriting& how);
    void write_successor(std::size_t index, const ForeignWriting& how);
    void write_name(const CpfgModule& module);
    void write_modules(const std::vector<CpfgModule>& list,
                       const std::vector<std::vector<ForeignId>>& arguments,
                       const ForeignWriting& how);
    [[nodiscard]] std::vector<std::vector<ForeignId>> terms_of(const std::vector<CpfgModule>& list);
    void write_pattern(const std::vector<CpfgModule>& list);
    /// Name of the intermediate module of group `index`, whose parameters are random numbers.
    [[nodiscard]] std::string random_module(std::size_t index) const;
    void warn_weight(const CpfgProduction& production);
    void write_parameters(const std::vector<std::string>& names,
                          const std::vector<std::string>& draws,
                          SourceSpan span);
    void append_names(ForeignId argument, std::vector<std::string>& names) const;
    [[nodiscard]] std::vector<std::string> formals_of(const CpfgProduction& production) const;
    /// Names of the parameters with the random numbers of a group.
    [[nodiscard]] static std::vector<std::string>
    draw_names(const std::vector<std::string>& formals, std::uint32_t count);
    [[nodiscard]] bool is_random_choice(const CpfgProduction& production) const;
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
    // Groups of productions among which a random number chooses; the key is the first production.
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
