#include "compiler/instancing/impl/instancing_pass.h"
#include "compiler/program/module_text.h"
#include "grammar/base/contract.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace lsys {

namespace {

/// The shortest decimal that reads back as this binary32, as the author wrote it.
double as_written(float number) {
    return std::stod(fmt::format("{}", number));
}

class Lister {
public:
    Lister(const Program& program,
           const Branches& branches,
           const Names& names,
           const SourceMap& sources,
           float rho)
        : program_(program), branches_(branches), names_(names), sources_(sources),
          rho_(as_written(rho)) {}

    std::string run() {
        out_ = fmt::format("#w : @(0,0) {} $;\n", text_of(program_.axiom.span));
        std::size_t site = 0;
        const std::vector<double> chances = probabilities();
        for (std::uint32_t i = 0; i < program_.productions.size(); ++i) {
            const std::size_t begin = site;
            while (site < branches_.sites.size() && branches_.sites[site].production == i) {
                ++site;
            }
            forms(program_.productions[i], chances[i],
                  std::span(branches_.sites).subspan(begin, site - begin));
        }
        return std::move(out_);
    }

private:
    /// The share of each production in the weights of its group; without conditions this is its
    /// probability.
    [[nodiscard]] std::vector<double> probabilities() const {
        std::vector<double> sums(program_.group_count, 0.0);
        for (const Production& production : program_.productions) {
            sums[production.group] += production.stochastic ? as_written(production.weight) : 0.0;
        }
        std::vector<double> all;
        for (const Production& production : program_.productions) {
            const double sum = sums[production.group];
            all.push_back(production.stochastic && sum > 0.0 ? as_written(production.weight) / sum
                                                             : 1.0);
        }
        return all;
    }

    [[nodiscard]] std::string_view text_of(SourceSpan span) const {
        return sources_.file(span.file).text().substr(span.begin, span.end - span.begin);
    }

    void forms(const Production& production, double chance, std::span<const BranchSite> sites) {
        LSYS_CHECK(sites.size() <= kMaxListedBranches);
        const std::uint32_t count = 1U << sites.size();
        for (std::uint32_t form = 0; form < count; ++form) {
            std::uint32_t taken = 0;
            for (std::uint32_t c = 0; c < sites.size(); ++c) {
                taken += (form >> c & 1U) == 0 ? 1U : 0U;
            }
            const auto recorded = static_cast<std::uint32_t>(sites.size()) - taken;
            const double probability =
                chance * std::pow(rho_, taken) * std::pow(1.0 - rho_, recorded);
            const std::string_view name = names_.text(production.name);
            const bool rewrites = production.stage == Stage::Rewrite;
            out_ += rewrites ? fmt::format("#{}.{}", name, form)
                             : fmt::format("{} {}", keyword_of(production.stage), name);
            out_ += fmt::format(" : {} : ", text_of(production.predecessor.span));
            out_ += production.condition == kNoValue ? "*" : text_of(production.condition_span);
            if (rewrites || production.stochastic) {
                out_ += fmt::format(" ~ {:.9g}", probability);
            }
            out_ += " : ";
            successor(production.successor, form, sites);
            out_ += ";\n";
        }
    }

    void successor(const ProgramWord& word, std::uint32_t form, std::span<const BranchSite> sites) {
        const std::string_view text = sources_.file(word.file).text();
        std::vector<std::string> before(word.module_count);
        std::vector<std::string> after(word.module_count);
        for (const BranchSite& site : sites) {
            const bool takes = (form >> site.number & 1U) == 0;
            before[site.open] += fmt::format("{}({},#)", takes ? '<' : '@', site.id);
            after[site.close] = takes ? ">" : "$";
        }
        std::uint32_t end = word.span.begin; // end of the previous module
        for (std::uint32_t i = 0; i < word.module_count; ++i) {
            const ProgramModule module = program_.modules[word.first_module + i];
            if (i > 0 && module.begin > end) {
                out_ += ' ';
            }
            const std::string_view name = names_.text(program_.symbol(module.symbol).name);
            const SourceSpan written =
                module_name_span(sources_, word.file, module.begin, name, program_.written_names);
            const bool quoted = sources_.text(written).starts_with('`') && name != "`";
            end = written.end;
            if (program_.symbol(module.symbol).parameter_count != 0) {
                end = static_cast<std::uint32_t>(end_of_arguments(text, end));
            }
            out_ += before[i];
            // A symbol of the grammar that looks like one of instancing stands in back quotes.
            if (name == "$" && !quoted) {
                out_ += "`$`";
                out_ += text.substr(module.begin + 1, end - module.begin - 1);
            } else {
                out_ += text.substr(module.begin, end - module.begin);
            }
            out_ += after[i];
        }
    }

    const Program& program_;
    const Branches& branches_;
    const Names& names_;
    const SourceMap& sources_;
    double rho_;
    std::string out_;
};

} // namespace

std::string list_branches(const Program& program,
                          const Branches& branches,
                          const Names& names,
                          const SourceMap& sources,
                          float rho) {
    return Lister(program, branches, names, sources, rho).run();
}

} // namespace lsys
