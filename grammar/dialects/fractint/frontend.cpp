// SPDX-License-Identifier: MIT
// .l collections of Fractint: many systems in a file, each `name { ... }` with an angle, an axiom
// and rules of one symbol, in any case of letters. Its turtle is the profile `fractint`.
#include "grammar/ast/reports.h"
#include "grammar/dialects/fractint/reader.h"
#include "grammar/dialects/fractint/writer.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::string_view kBlanks = " \t\r\x1A";

/// An entry of the file, and its name without the prefix `lsys:`.
struct NamedEntry {
    std::string name;
    const FractintEntry* entry = nullptr;
};

/// Systems among the entries, without comments and other formulas.
std::vector<NamedEntry> systems_of(const std::vector<FractintEntry>& entries,
                                   const SourceMap& sources) {
    std::vector<NamedEntry> systems;
    for (const FractintEntry& entry : entries) {
        std::string_view name = sources.text(entry.name);
        const std::string lower_name = lowered(name);
        constexpr std::array<std::string_view, 3> kOthers{"frm:", "ifs:", "par:"};
        if (lower_name.empty() || lower_name == "comment" ||
            std::any_of(kOthers.begin(), kOthers.end(),
                        [&](std::string_view kind) { return lower_name.starts_with(kind); })) {
            continue;
        }
        constexpr std::string_view kKind = "lsys:";
        name.remove_prefix(lower_name.starts_with(kKind) ? kKind.size() : 0);
        systems.push_back({std::string(name), &entry});
    }
    return systems;
}

/// Names of the systems for a message, with commas: `Koch1, Koch2`.
std::string list_text(const std::vector<NamedEntry>& systems) {
    constexpr std::size_t kMax = 200;
    std::string text;
    for (std::size_t i = 0; i < systems.size() && i < kMax; ++i) {
        text += (i == 0 ? "" : ", ") + shown(systems[i].name);
    }
    return systems.size() > kMax ? text + " and " + std::to_string(systems.size() - kMax) + " more"
                                 : text;
}

/// The system that the context names, or the only one; null after a report.
const NamedEntry*
choose(const std::vector<NamedEntry>& systems, FileId root, const ParseContext& context) {
    const SourceSpan start{root, 0, 0};
    if (systems.empty()) {
        if (!context.diagnostics.has_errors()) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, start,
                                    "this file has no system `name { ... }`");
        }
        return nullptr;
    }
    const std::string wanted = lowered(context.system);
    if (wanted.empty() && systems.size() == 1) {
        return &systems.front();
    }
    const NamedEntry* found = nullptr;
    for (const NamedEntry& system : systems) {
        if (!wanted.empty() && lowered(system.name) == wanted) {
            if (found == nullptr) {
                found = &system;
            } else {
                context.diagnostics
                    .add(DiagnosticCode::ForeignQuirk, system.entry->name,
                         "two systems have this name; Fractint takes the first")
                    .labels.push_back({found->entry->name, "this is the first"});
            }
        }
    }
    if (found != nullptr) {
        return found;
    }
    Diagnostic& error = context.diagnostics.add(
        DiagnosticCode::WhichSystem, systems.front().entry->name,
        wanted.empty() ? "this file holds " + std::to_string(systems.size()) +
                             " systems; choose one with --system NAME"
                       : "this file has no system `" + shown(context.system) + "`");
    if (!wanted.empty()) {
        std::vector<std::string> low;
        for (const NamedEntry& system : systems) {
            low.push_back(lowered(system.name));
        }
        const std::vector<std::string_view> candidates(low.begin(), low.end());
        if (const auto nearest = nearest_name(wanted, candidates)) {
            const auto at = std::find(candidates.begin(), candidates.end(), *nearest);
            const NamedEntry& system = systems[static_cast<std::size_t>(at - candidates.begin())];
            error.span = system.entry->name;
            error.help.push_back("did you mean `" + shown(system.name) + "`?");
        }
    }
    error.help.push_back("it holds " + list_text(systems));
    return nullptr;
}

} // namespace

std::string_view recognise_fractint(std::string_view text) {
    bool in_block = false;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        line = line.substr(0, line.find(';'));
        at = end + 1;
        if (const std::size_t open = line.find('{'); !in_block && open != std::string_view::npos) {
            in_block = true;
            line.remove_prefix(open + 1);
        }
        if (in_block) {
            constexpr std::string_view kAxiom = "axiom";
            line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
            if (line.size() > kAxiom.size() && lowered(line.substr(0, kAxiom.size())) == kAxiom &&
                (line[kAxiom.size()] == ' ' || line[kAxiom.size()] == '\t' ||
                 line[kAxiom.size()] == '=')) {
                return "an `Axiom` between braces";
            }
            in_block = line.find('}') == std::string_view::npos;
        }
    }
    return {};
}

std::vector<std::string> systems_in_fractint(std::string_view text) {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader nothing = [](const std::string&) -> Result<std::string> {
        return Error{"nothing is included"};
    };
    const FileId root = sources.add("", std::string(text));
    const ParseContext context{sources, names, diagnostics, nothing};
    const std::vector<FractintEntry> entries = read_fractint_entries(root, context);
    std::vector<std::string> found;
    for (NamedEntry& system : systems_of(entries, sources)) {
        found.push_back(std::move(system.name));
    }
    return found;
}

void translate_fractint(const DialectRow& row,
                        const ParseContext& context,
                        Translation& translation) {
    const FileId root = translation.file();
    const std::vector<FractintEntry> entries = read_fractint_entries(root, context);
    const std::vector<NamedEntry> systems = systems_of(entries, context.sources);
    const NamedEntry* const chosen = choose(systems, root, context);
    if (chosen == nullptr) {
        return;
    }
    const std::vector<FractintLine> lines = read_fractint_lines(*chosen->entry, context);
    FractintWriter(lines, chosen->entry->name, context, translation).write(row.turtle);
}

} // namespace lsys
