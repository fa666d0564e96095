// Writes a parsed cpfg file as .lsys text.
//
// A random range of .lsys draws a number at each place where it is written. So a random number that
// is used twice, or on which a decision depends, becomes a parameter of an intermediate module,
// which is decomposed at once: `A(x) --> random1(x, {0, 1})`, `random1(x, u) --> ...`.
#pragma once

#include "grammar/dialects/cpfg/curves.h"
#include "grammar/dialects/cpfg/expressions.h"
#include "grammar/dialects/cpfg/session.h"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys {

class CpfgWriter {
public:
    CpfgWriter(CpfgSession& session, Translation& out);

    /// `turtle`: the profile.
    void write(std::string_view turtle);

private:
    enum class Binding : std::uint8_t {
        None,
        Own,   // the production matches, then its random numbers are drawn
        Group, // random numbers are drawn, then one of the productions of the module is chosen
    };
    struct BoundDraws {
        Binding binding = Binding::None;
        int first_draw = 0; // in a group: index of the first number of this production
        int draws = 0;      // count of random numbers of the module
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
    void write_setting(const char* begin, int expression, const char* fallback);
    void write_depth(const char* begin, int expression, Stage stage);
    void read_view_file();
    void write_declarations();
    void write_names(const char* begin, const std::vector<CpfgModule>& list);
    [[nodiscard]] bool has(Stage stage) const;

    // --- productions
    void find_bindings();
    void bind_group(const std::vector<std::size_t>& members);
    [[nodiscard]] bool check(const CpfgProduction& production);
    void write_production(std::size_t index);
    void write_bound_production(std::size_t index);
    void write_group(std::size_t index);
    void write_head(const CpfgProduction& production, const std::string& label);
    void write_condition(const CpfgProduction& production);
    void write_weight(const CpfgProduction& production);
    void write_weighted_condition(const CpfgProduction& production, std::size_t index);
    void write_name(const CpfgModule& module);
    void write_modules(const std::vector<CpfgModule>& list);
    void write_pattern(const std::vector<CpfgModule>& list);
    [[nodiscard]] std::string drawing_module(std::size_t index) const;
    [[nodiscard]] std::vector<std::string> read_formals(const CpfgProduction& production);
    void begin_bound(const CpfgProduction& production, int first_draw);
    void write_formals(const std::vector<std::string>& names, int draws, SourceSpan span);
    void write_draws(const std::vector<std::string>& names, int count, SourceSpan span);
    [[nodiscard]] std::vector<std::string> formals_of(const CpfgProduction& production) const;
    [[nodiscard]] bool is_random_choice(const CpfgProduction& production) const;
    [[nodiscard]] bool is_always(const CpfgProduction& production) const;
    [[nodiscard]] const CpfgExpression& expression(int index) const {
        return session_.expressions[static_cast<std::size_t>(index)];
    }

    CpfgSession& session_;
    const ParseContext& context_;
    Translation& out_;
    SourceSpan header_; // for text without a place of its own
    CpfgView view_;
    CpfgExpressions expressions_;
    std::vector<BoundDraws> bindings_;                       // by production
    std::map<std::size_t, std::vector<std::size_t>> groups_; // by the first of its productions
    std::set<Stage> bound_;                                  // stages with bindings
    std::set<std::string> used_;                             // names of all modules
    std::set<std::string> matched_;                          // names in predecessors and contexts
    std::set<std::string> surfaces_;
    std::map<std::string, int> alternatives_;
};

} // namespace lsys
