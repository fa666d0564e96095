// SPDX-License-Identifier: MIT
#include "grammar/dialects/repeated_messages.h"

#include "grammar/base/characters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr const char* kLostStatement = "lost_statement"; // name of a fact

/// The text without quoted names and digits.
std::string shape_of(std::string_view message) {
    std::string shape;
    bool is_quoted = false;
    for (const char c : message) {
        is_quoted = is_quoted != (c == '`');
        if (!is_quoted && !is_digit(c)) {
            shape += c;
        }
    }
    return shape;
}

using Key = std::tuple<DiagnosticCode, Severity, std::string>;

/// Indices of the diagnostics from `first` on that have the same text, or if `by_shape`, of the
/// warnings whose texts have the same shape_of(). Notes and diagnostics without a place are left
/// out.
std::map<Key, std::vector<std::size_t>>
group(const std::vector<Diagnostic>& all, std::size_t first, bool by_shape) {
    std::map<Key, std::vector<std::size_t>> groups;
    for (std::size_t i = first; i < all.size(); ++i) {
        const Diagnostic& diagnostic = all[i];
        const bool is_merged = diagnostic.span.file != kNoFile &&
                               diagnostic.severity != Severity::Note &&
                               (!by_shape || diagnostic.severity == Severity::Warning);
        if (is_merged) {
            groups[{diagnostic.code, diagnostic.severity,
                    by_shape ? shape_of(diagnostic.message) : diagnostic.message}]
                .push_back(i);
        }
    }
    return groups;
}

bool is_before(const SourceSpan& a, const SourceSpan& b) {
    return std::pair(a.file, a.begin) < std::pair(b.file, b.begin);
}

/// Merges the groups of at least `min_count` diagnostics.
void merge_groups(Diagnostics& diagnostics,
                  std::size_t first,
                  bool by_shape,
                  std::size_t min_count) {
    std::vector<Diagnostic> all = diagnostics.all();
    std::vector<bool> is_dropped(all.size(), false);
    for (auto& [key, indices] : group(all, first, by_shape)) {
        if (indices.size() < min_count) {
            continue;
        }
        std::stable_sort(indices.begin(), indices.end(), [&](std::size_t a, std::size_t b) {
            return is_before(all[a].span, all[b].span);
        });
        Diagnostic& first_message = all[indices.front()];
        for (std::size_t i = 1; i < indices.size(); ++i) {
            const Diagnostic& other = all[indices[i]];
            is_dropped[indices[i]] = true;
            if (other.span != all[indices[i - 1]].span) {
                first_message.labels.push_back(
                    {other.span, by_shape ? other.message : "here, too"});
            }
        }
    }
    Diagnostics merged;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!is_dropped[i]) {
            merged.add(std::move(all[i]));
        }
    }
    diagnostics = std::move(merged);
}

} // namespace

void merge_repeated_messages(Diagnostics& diagnostics, std::size_t first) {
    const std::uint64_t count = diagnostics.count(Severity::Error) +
                                diagnostics.count(Severity::Warning) +
                                diagnostics.count(Severity::Note);
    if (first >= diagnostics.all().size() || count != diagnostics.all().size()) {
        return; // messages beyond Diagnostics::kMaxStored have no text
    }
    merge_groups(diagnostics, first, false, 2);
    merge_groups(diagnostics, first, true, 2);
}

void mark_lost_statement(Diagnostic& diagnostic) {
    diagnostic.facts.push_back({kLostStatement, true});
}

void drop_follow_ups(Diagnostics& diagnostics) {
    const bool is_doubtful =
        std::ranges::any_of(diagnostics.all(), [](const Diagnostic& diagnostic) {
            return std::ranges::any_of(
                diagnostic.facts, [](const Fact& fact) { return fact.name == kLostStatement; });
        });
    if (!is_doubtful) {
        return;
    }
    constexpr std::array kFollowing{DiagnosticCode::NeverProduced,  DiagnosticCode::IdleModule,
                                    DiagnosticCode::UnusedConstant, DiagnosticCode::UnclosedBranch,
                                    DiagnosticCode::UnopenedBranch, DiagnosticCode::StrayVertex};
    diagnostics.reassign_severities([&](const Diagnostic& diagnostic) {
        const bool follows = diagnostic.severity == Severity::Warning &&
                             std::ranges::find(kFollowing, diagnostic.code) != kFollowing.end();
        return follows ? std::optional<Severity>() : std::optional(diagnostic.severity);
    });
}

} // namespace lsys
