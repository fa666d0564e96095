// SPDX-License-Identifier: MIT
#include "grammar/dialects/carey/parameters.h"

#include "grammar/ast/reports.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/carey/writer.h"
#include "grammar/dialects/impl/letter_modules.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// A symbol and its number of parameters.
using SymbolForm = std::pair<char32_t, std::size_t>;

struct PlacedModule {
    SymbolForm form;
    SourceSpan span; // place of the module with its parameters
};

struct RuleWithModules {
    const CareyRule* rule = nullptr;
    std::vector<PlacedModule> left;  // modules of rule->left
    std::vector<PlacedModule> right; // modules of rule->right
};

class LeftParameterFinder {
public:
    LeftParameterFinder(const CareyFile& file, const ParseContext& context)
        : context_(context), quiet_{context.sources, context.names, ignored_, context.load} {
        for (const CareyRule& rule : file.rules) {
            rules_.push_back({&rule, modules_of(rule.left), modules_of(rule.right)});
        }
        index_rules();
        for (const CareySetting& setting : file.settings) {
            if (setting.key->name == "axiom") {
                enqueue_all(modules_of(setting.value));
            }
        }
        for (const RuleWithModules& rule : rules_) {
            enqueue_all(rule.right);
        }
    }

    LeftParameters find() {
        LeftParameters found;
        found.counts_by_rule.resize(rules_.size());
        while (!pending_.empty()) {
            const PlacedModule module = pending_.back();
            pending_.pop_back();
            for (const std::size_t i : by_last_[module.form.first]) {
                if (follow(rules_[i], module)) {
                    found.counts_by_rule[i].push_back(module.form.second);
                    found.has_counts = true;
                }
            }
        }
        for (std::vector<std::size_t>& counts : found.counts_by_rule) {
            std::sort(counts.begin(), counts.end());
        }
        return found;
    }

private:
    std::vector<PlacedModule> modules_of(SourceSpan text) {
        std::vector<PlacedModule> modules;
        const bool is_valid = read_letter_modules(text, quiet_, [&](const LetterModule& module) {
            const std::string_view arguments = context_.sources.text(module.arguments);
            const auto count =
                arguments.empty()
                    ? std::size_t{0}
                    : static_cast<std::size_t>(std::ranges::count(arguments, ',')) + 1;
            modules.push_back({{module.character, count}, join(module.span, module.arguments)});
        });
        return is_valid ? modules : std::vector<PlacedModule>();
    }

    static bool has_parameters(const PlacedModule& module) { return module.form.second != 0; }

    /// Without these indexes, many rules of one symbol would take quadratic time.
    void index_rules() {
        for (std::size_t i = 0; i < rules_.size(); ++i) {
            const std::vector<PlacedModule>& left = rules_[i].left;
            if (left.empty() || std::ranges::any_of(left, has_parameters)) {
                continue;
            }
            by_last_[left.back().form.first].push_back(i);
            if (takes_parameters(rules_[i])) { // follow() reports the others
                std::u32string symbols;
                for (const PlacedModule& module : left) {
                    symbols += module.form.first;
                }
                by_left_[symbols].push_back(i);
                left_sizes_.insert(left.size());
            }
        }
    }

    void enqueue(const PlacedModule& module) {
        if (has_parameters(module) && enqueued_.insert(module.form).second) {
            pending_.push_back(module);
        }
    }

    void enqueue_all(const std::vector<PlacedModule>& modules) {
        for (std::size_t i = 0; i < modules.size(); ++i) {
            if (!has_parameters(modules[i])) {
                continue;
            }
            enqueue(modules[i]);
            // If no more messages are stored, counts one per module, not one per rule.
            if (context_.diagnostics.admits(DiagnosticCode::ParameterStays)) {
                for (const std::size_t rule : matching_rules(modules, i)) {
                    note(rules_[rule], modules[i]);
                }
            }
        }
    }

    /// Rules whose left side matches the modules up to `last`. The parameters of `last` follow the
    /// matched text; they are then parameters of the last symbol of the rule's right side.
    [[nodiscard]] std::vector<std::size_t> matching_rules(const std::vector<PlacedModule>& modules,
                                                          std::size_t last) const {
        std::vector<std::size_t> found;
        for (const std::size_t size : left_sizes_) {
            if (size > last + 1) {
                break;
            }
            std::u32string symbols;
            bool is_plain = true;
            for (std::size_t i = last + 1 - size; i <= last; ++i) {
                symbols += modules[i].form.first;
                is_plain = is_plain && (i == last || !has_parameters(modules[i]));
            }
            const auto rules = is_plain ? by_left_.find(symbols) : by_left_.end();
            if (rules != by_left_.end()) {
                found.insert(found.end(), rules->second.begin(), rules->second.end());
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    /// Gives the parameters of a module to the last symbol of the rule's right side. Reports and
    /// returns false if that symbol cannot have parameters.
    bool follow(const RuleWithModules& rule, const PlacedModule& module) {
        if (takes_parameters(rule)) {
            enqueue({{rule.right.back().form.first, module.form.second}, module.span});
            return true;
        }
        const std::string problem =
            rule.right.empty() ? std::string("the symbol before it")
                               : "`" + shown(context_.sources.text(rule.right.back().span)) + "`";
        Diagnostic& error = context_.diagnostics.add(DiagnosticCode::ForeignFeature, module.span,
                                                     "the rule `" + text_of(rule) +
                                                         "` leaves this parameter after " +
                                                         problem + ", which cannot take it");
        error.labels.push_back({rule.rule->right, "replaces text, and the parameter stays"});
        error.help.emplace_back("give the symbol with the parameter a name that no rule rewrites");
        return false;
    }

    /// Whether the last module of the right side can take the parameters: it has none of its own
    /// and is not a bracket, `.` or `#`.
    static bool takes_parameters(const RuleWithModules& rule) {
        if (rule.right.empty() || rule.right.back().form.second != 0) {
            return false;
        }
        const char32_t symbol = rule.right.back().form.first;
        return symbol >= 0x80 ||
               std::string_view("[]{}.#").find(static_cast<char>(symbol)) == std::string_view::npos;
    }

    /// Adds the note [parameter-stays]: `rule` moves the parameters of `module` to another symbol.
    void note(const RuleWithModules& rule, const PlacedModule& module) {
        if (!context_.diagnostics.admits(DiagnosticCode::ParameterStays)) {
            return;
        }
        const std::string_view whole = context_.sources.text(module.span);
        const std::string parameters(whole.substr(std::min(whole.find('('), whole.size())));
        Diagnostic& note = context_.diagnostics.add(
            DiagnosticCode::ParameterStays, module.span,
            "rules replace text: `" + text_of(rule) + "` makes `" +
                shown(remove_blanks(context_.sources.text(rule.rule->right)) + parameters) +
                "` of this module");
        note.help.emplace_back("a symbol that no rule rewrites keeps its parameter");
    }

    [[nodiscard]] std::string text_of(const RuleWithModules& rule) const {
        return shown(remove_blanks(context_.sources.text(rule.rule->left)) + "=" +
                     remove_blanks(context_.sources.text(rule.rule->right)));
    }

    const ParseContext& context_;
    Diagnostics ignored_; // messages of quiet_, which CareyWriter reports
    ParseContext quiet_;  // context_ with messages in ignored_
    std::vector<RuleWithModules> rules_;
    std::map<char32_t, std::vector<std::size_t>> by_last_; // rules by the last symbol on the left
    std::map<std::u32string, std::vector<std::size_t>> by_left_; // rules that take parameters
    std::set<std::size_t> left_sizes_;  // numbers of symbols of the keys of by_left_
    std::set<SymbolForm> enqueued_;     // symbols with parameters that have been in pending_
    std::vector<PlacedModule> pending_; // modules whose parameters have not been followed yet
};

} // namespace

LeftParameters find_left_parameters(const CareyFile& file, const ParseContext& context) {
    return LeftParameterFinder(file, context).find();
}

} // namespace lsys
