// SPDX-License-Identifier: MIT
#include "compiler/instancing/impl/instancing_pass.h"
#include "compiler/program/module_text.h"
#include "grammar/base/exponentials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kFormBits = 64; // bits of a form number: one per branch of the production
/// Bytes of a piece of text passed to `put`.
constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

/// The binary64 number nearest to the shortest decimal that reads back as this binary32.
double as_written(float number) {
    return std::stod(fmt::format("{}", number));
}

class Lister {
public:
    Lister(const Program& program,
           const Branches& branches,
           const Names& names,
           const SourceMap& sources,
           float rho,
           const FormPage& page,
           const std::function<bool(std::string_view)>& put)
        : program_(program), branches_(branches), names_(names), sources_(sources),
          rho_(as_written(rho)), page_(page), put_(put) {}

    void run() {
        for (const Axiom& axiom : program_.axioms) {
            const std::string weight =
                axiom.has_weight ? fmt::format(" ~ {}", text_of(axiom.weight_span)) : "";
            out_ += fmt::format("#w{} : @(0,0) {} $;\n", weight, text_of(axiom.word.span));
        }
        std::size_t site = 0;
        const std::vector<double> probability = probabilities();
        bool wanted = true; // put_() has not ended the list
        for (std::uint32_t i = 0; i < program_.productions.size() && wanted; ++i) {
            const std::size_t begin = site;
            while (site < branches_.sites.size() && branches_.sites[site].production == i) {
                ++site;
            }
            wanted = forms(program_.productions[i], probability[i],
                           std::span(branches_.sites).subspan(begin, site - begin));
        }
        if (wanted) {
            static_cast<void>(put_(out_));
        }
    }

private:
    /// Weight of each production divided by the sum of the weights of its group: the probability
    /// if there are no conditions. NaN if a weight of the group is not constant.
    [[nodiscard]] std::vector<double> probabilities() const {
        std::vector<double> sums(program_.context_group_count, 0.0);
        for (const Production& production : program_.productions) {
            sums[production.group] += production.stochastic ? as_written(production.weight) : 0.0;
        }
        std::vector<double> all;
        for (const Production& production : program_.productions) {
            const double sum = sums[production.group];
            all.push_back(!production.stochastic ? 1.0 : as_written(production.weight) / sum);
        }
        return all;
    }

    [[nodiscard]] std::string_view text_of(SourceSpan span) const {
        return sources_.file(span.file).text().substr(span.begin, span.end - span.begin);
    }

    /// Whether form `form` takes branch `number` from a record. The form number has 64 bits, so
    /// every form that can be listed takes the branches from number 64 on.
    [[nodiscard]] static bool takes(std::uint64_t form, std::size_t number) {
        return number >= kFormBits || (form >> number & 1U) == 0;
    }

    /// Lists the forms of one production. Returns false if `put` ended the list.
    bool
    forms(const Production& production, double probability, std::span<const BranchSite> sites) {
        const std::uint64_t last = last_form(sites.size());
        if (page_.first > last || page_.count == 0) {
            return true;
        }
        const std::uint64_t end = page_.first + std::min(page_.count - 1, last - page_.first);
        for (std::uint64_t form = page_.first;; ++form) {
            std::size_t taken = 0;
            for (std::size_t c = 0; c < sites.size(); ++c) {
                taken += takes(form, c) ? 1U : 0U;
            }
            // Probability of this form among the forms of the production.
            const double part = power(rho_, static_cast<double>(taken)) *
                                power(1.0 - rho_, static_cast<double>(sites.size() - taken));
            const std::string_view name = names_.text(production.name);
            const bool rewrites = production.stage == Stage::Rewrite;
            out_ += rewrites ? fmt::format("#{}.{}", name, form)
                             : fmt::format("{} {}", keyword_of(production.stage), name);
            out_ += " : ";
            // A production with a context occurs only in a system whose plants are instanced as a
            // whole.
            out_ += production.has_left ? fmt::format("{} < ", text_of(production.left.span)) : "";
            out_ += text_of(production.predecessor.span);
            out_ +=
                production.has_right ? fmt::format(" > {}", text_of(production.right.span)) : "";
            out_ += " : ";
            out_ += production.condition == kNoValue ? "*" : text_of(production.condition_span);
            if (rewrites || production.stochastic) {
                out_ += std::isnan(probability)
                            ? fmt::format(" ~ {:.9g}*({})", part, text_of(production.weight_span))
                            : fmt::format(" ~ {:.9g}", probability * part);
            }
            for (std::size_t i = 0; i < production.locals.size(); ++i) {
                out_ += i == 0 ? " : let " : ", ";
                out_ += text_of(production.locals[i].span);
            }
            out_ += " : ";
            successor(production.successor, form, sites);
            out_ += ";\n";
            if (out_.size() >= kPieceBytes) {
                if (!put_(out_)) {
                    return false;
                }
                out_.clear();
            }
            if (form == end) {
                return true;
            }
        }
    }

    void successor(const ProgramWord& word, std::uint64_t form, std::span<const BranchSite> sites) {
        const std::string_view text = sources_.file(word.file).text();
        std::vector<std::string> before(word.module_count);
        std::vector<std::string> after(word.module_count);
        for (const BranchSite& site : sites) {
            const bool uses_instance = takes(form, site.number);
            before[site.open] += fmt::format("{}({},#)", uses_instance ? '<' : '@', site.kind_id);
            after[site.close] = uses_instance ? ">" : "$";
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
            const bool is_quoted = sources_.text(written).starts_with('`') && name != "`";
            end = written.end;
            if (program_.symbol(module.symbol).parameter_count != 0) {
                end = static_cast<std::uint32_t>(end_of_arguments(text, end));
            }
            out_ += before[i];
            // A module with the name of an instancing operation is written in back quotes.
            if (name == "$" && !is_quoted) {
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
    FormPage page_;
    const std::function<bool(std::string_view)>& put_;
    std::string out_;
};

} // namespace

std::uint64_t last_form(std::size_t branch_count) {
    return branch_count >= kFormBits ? ~std::uint64_t{0} : (std::uint64_t{1} << branch_count) - 1;
}

void list_branches(const Program& program,
                   const Branches& branches,
                   const Names& names,
                   const SourceMap& sources,
                   float rho,
                   const FormPage& page,
                   const std::function<bool(std::string_view)>& put) {
    Lister(program, branches, names, sources, rho, page, put).run();
}

} // namespace lsys
