// SPDX-License-Identifier: MIT
#include "runtime/repair/chosen_fixes.h"

#include "runtime/repair/edited_file.h"

#include <algorithm>
#include <iterator>

namespace lsys::repair {

namespace {

/// The edited places of a file: begin to end, as byte offsets.
using TakenPlaces = std::map<std::uint32_t, std::uint32_t>;

/// Whether an edit of `span` overlaps an edited place or begins at the same offset as one.
bool is_taken(const TakenPlaces& taken, SourceSpan span) {
    const auto after = taken.lower_bound(span.begin);
    if (after != taken.end() && (after->first < span.end || after->first == span.begin)) {
        return true;
    }
    return after != taken.begin() && std::prev(after)->second > span.begin;
}

} // namespace

ChosenFixes choose_fixes(const Diagnostics& diagnostics,
                         const SourceMap& sources,
                         FixChoice choice,
                         const FixFilter& is_allowed) {
    ChosenFixes chosen;
    std::map<std::string, TakenPlaces> taken;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        const auto fix =
            std::find_if(diagnostic.fixes.begin(), diagnostic.fixes.end(), [&](const Fix& each) {
                return (each.machine_applicable || choice == FixChoice::Offered) &&
                       !each.edits.empty();
            });
        if (fix == diagnostic.fixes.end() || !is_allowed(diagnostic, *fix)) {
            continue;
        }
        // Keyed by path, since a file that is included twice has two ids and one text.
        const bool conflict = std::any_of(fix->edits.begin(), fix->edits.end(), [&](const Edit& e) {
            return is_taken(taken[sources.file(e.span.file).path()], e.span);
        });
        if (conflict) {
            continue;
        }
        for (const Edit& edit : fix->edits) {
            const std::string& path = sources.file(edit.span.file).path();
            taken[path].emplace(edit.span.begin, edit.span.end);
            chosen.edits[path].push_back(&edit);
        }
        chosen.diagnostics.push_back(&diagnostic);
        chosen.fixes.push_back(&*fix);
    }
    for (auto& [path, edits] : chosen.edits) {
        std::sort(edits.begin(), edits.end(),
                  [](const Edit* a, const Edit* b) { return a->span.begin < b->span.begin; });
    }
    return chosen;
}

std::string apply_edits(std::string_view text, const std::vector<const Edit*>& edits) {
    const bool has_crlf = has_carriage_returns(text);
    std::string result;
    result.reserve(text.size() + edits.size());
    std::size_t at = 0;
    for (const Edit* edit : edits) {
        result += text.substr(at, edit->span.begin - at);
        for (const char c : edit->replacement) {
            if (c == '\n' && has_crlf) {
                result += '\r';
            }
            result += c;
        }
        at = edit->span.end;
    }
    result += text.substr(at);
    return result;
}

} // namespace lsys::repair
