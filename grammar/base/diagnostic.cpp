// SPDX-License-Identifier: MIT
#include "grammar/base/diagnostic.h"

#include "grammar/base/contract.h"
#include "grammar/base/impl/edit_distance.h"
#include "grammar/base/names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace lsys {

namespace {

constexpr DiagnosticInfo kInfos[] = {
#define LSYS_DIAGNOSTIC(identifier, severity, name, meaning) {Severity::severity, name, meaning},
#include "grammar/base/diagnostics.def"
#undef LSYS_DIAGNOSTIC
};

bool equals_without_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower_case(x) == lower_case(y); });
}

} // namespace

const DiagnosticInfo& info(DiagnosticCode code) {
    const auto index = static_cast<std::size_t>(code);
    LSYS_CHECK(index < std::size(kInfos), index);
    return kInfos[index];
}

std::uint32_t diagnostic_code_count() {
    return static_cast<std::uint32_t>(std::size(kInfos));
}

std::optional<DiagnosticCode> find_diagnostic_code(std::string_view name) {
    for (std::size_t i = 0; i < std::size(kInfos); ++i) {
        if (kInfos[i].name == name) {
            return static_cast<DiagnosticCode>(i);
        }
    }
    return std::nullopt;
}

std::string_view severity_name(Severity severity) {
    switch (severity) {
    case Severity::Note:
        return "note";
    case Severity::Warning:
        return "warning";
    case Severity::Error:
        return "error";
    }
    return "error";
}

Diagnostic make_diagnostic(DiagnosticCode code, SourceSpan span, std::string message) {
    Diagnostic diagnostic;
    diagnostic.code = code;
    diagnostic.severity = info(code).severity;
    diagnostic.span = span;
    diagnostic.message = std::move(message);
    return diagnostic;
}

void add_fix(Diagnostic& diagnostic,
             std::string title,
             SourceSpan span,
             std::string replacement,
             bool is_machine_applicable) {
    diagnostic.fixes.push_back(
        {std::move(title), {{span, std::move(replacement)}}, is_machine_applicable});
}

bool has_certain_fix(const Diagnostic& diagnostic) {
    return std::any_of(diagnostic.fixes.begin(), diagnostic.fixes.end(),
                       [](const Fix& fix) { return fix.machine_applicable && !fix.edits.empty(); });
}

void offer_fixes(Diagnostic& diagnostic) {
    for (Fix& fix : diagnostic.fixes) {
        fix.machine_applicable = false;
    }
}

Diagnostic& Diagnostics::add(Diagnostic diagnostic) {
    ++counts_[static_cast<std::size_t>(diagnostic.severity)];
    if (all_.size() >= kMaxStored) {
        return overflow_ = std::move(diagnostic);
    }
    return all_.emplace_back(std::move(diagnostic));
}

Diagnostic& Diagnostics::add(DiagnosticCode code, SourceSpan span, std::string message) {
    return add(make_diagnostic(code, span, std::move(message)));
}

bool Diagnostics::admits(DiagnosticCode code) {
    if (all_.size() < kMaxStored) {
        return true;
    }
    ++counts_[static_cast<std::size_t>(info(code).severity)];
    return false;
}

void Diagnostics::sort_by_place() {
    const auto key = [](const Diagnostic& d) {
        return std::array<std::uint64_t, 3>{static_cast<std::uint64_t>(d.span.file), d.span.begin,
                                            2U - static_cast<std::uint64_t>(d.severity)};
    };
    std::stable_sort(all_.begin(), all_.end(),
                     [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
    const auto same = [](const Diagnostic& a, const Diagnostic& b) {
        return a.code == b.code && a.span == b.span && a.message == b.message;
    };
    std::size_t kept_count = 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (kept_count != 0 && same(all_[kept_count - 1], all_[i])) {
            --counts_[static_cast<std::size_t>(all_[i].severity)];
            continue;
        }
        if (kept_count != i) {
            all_[kept_count] = std::move(all_[i]);
        }
        ++kept_count;
    }
    all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(kept_count), all_.end());
}

bool Diagnostics::has_doubtful_error_from(std::size_t first) const {
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(std::min(first, all_.size()));
    return std::any_of(begin, all_.end(), [](const Diagnostic& diagnostic) {
        return diagnostic.severity == Severity::Error && !has_certain_fix(diagnostic);
    });
}

void Diagnostics::offer_fixes_from(std::size_t first) {
    for (std::size_t i = first; i < all_.size(); ++i) {
        offer_fixes(all_[i]);
    }
}

void Diagnostics::drop_repairs(std::string_view pattern) {
    for (Diagnostic& diagnostic : all_) {
        std::erase_if(diagnostic.fixes, [](const Fix& fix) {
            return !std::all_of(fix.edits.begin(), fix.edits.end(), [](const Edit& edit) {
                return edit.replacement.size() > 1 && is_identifier(edit.replacement) &&
                       edit.replacement.find('_') == std::string::npos;
            });
        });
        offer_fixes(diagnostic);
        std::erase_if(diagnostic.help, [pattern](const std::string& help) {
            return help.find(pattern) != std::string::npos;
        });
    }
}

void Diagnostics::promote_unstored_warnings() {
    std::uint64_t& warnings = counts_[static_cast<std::size_t>(Severity::Warning)];
    const auto stored = static_cast<std::uint64_t>(
        std::count_if(all_.begin(), all_.end(), [](const Diagnostic& diagnostic) {
            return diagnostic.severity == Severity::Warning;
        }));
    counts_[static_cast<std::size_t>(Severity::Error)] += warnings - stored;
    warnings = stored;
}

std::optional<std::string_view> nearest_name(std::string_view wanted,
                                             const std::vector<std::string_view>& candidates) {
    // A name that differs only in letter case is always chosen. Otherwise a third of the letters of
    // the shorter name may differ, and none if the shorter name has one or two letters. Names of
    // more than kMaxLength letters are compared without case only, because the time of edit
    // distances grows with the square of the length.
    constexpr std::size_t kMaxLength = EditDistance::kMaxLength;
    const EditDistance edits(wanted.substr(0, kMaxLength));
    std::optional<std::string_view> best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string_view candidate : candidates) {
        const std::size_t longer = std::max(candidate.size(), wanted.size());
        const std::size_t shorter = std::min(candidate.size(), wanted.size());
        const std::size_t limit = shorter < 3 ? 0 : 2 * (shorter / 3);
        if (candidate == wanted || 2 * (longer - shorter) > limit) {
            continue;
        }
        if (equals_without_case(wanted, candidate)) {
            return candidate;
        }
        // Skips names no nearer than the best so far; for most, lower_bound() already shows it.
        const std::size_t farthest = std::min(limit, best_distance - 1);
        if (longer > kMaxLength || edits.lower_bound(candidate) > farthest) {
            continue;
        }
        if (const std::size_t distance = edits.distance(candidate); distance <= farthest) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

} // namespace lsys
