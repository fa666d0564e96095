#include "runtime/cli/fixes.h"

#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace lsys::lsc {

namespace {

/// A mistake may hide another, so the text is compiled again after each round; a grammar that needs
/// more rounds than this keeps its last diagnostics.
constexpr int kMaxRounds = 100;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The places of one file that are taken: begin to end.
using TakenPlaces = std::map<std::uint32_t, std::uint32_t>;

/// Whether an edit of `span` would overlap what is taken or touch an insertion there.
bool is_taken(const TakenPlaces& taken, SourceSpan span) {
    const auto after = taken.lower_bound(span.begin);
    if (after != taken.end() && (after->first < span.end || after->first == span.begin)) {
        return true;
    }
    return after != taken.begin() && std::prev(after)->second > span.begin;
}

const Fix* first_applicable(const Diagnostic& diagnostic) {
    for (const Fix& fix : diagnostic.fixes) {
        if (fix.machine_applicable && !fix.edits.empty()) {
            return &fix;
        }
    }
    return nullptr;
}

std::string describe(const Diagnostic& diagnostic, const Fix& fix, const SourceMap& sources) {
    const SourceSpan span = fix.edits.front().span;
    const SourceFile& file = sources.file(span.file);
    const LineColumn place = file.line_column(span.begin);
    return fmt::format("{}:{}:{}: fixed: {} [{}]", file.path(), place.line, place.column, fix.title,
                       info(diagnostic.code).name);
}

/// Without symbolic links and `..`; empty if there is no such file.
std::filesystem::path real_path(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path real = std::filesystem::canonical(path, error);
    return error ? std::filesystem::path() : real;
}

} // namespace

FixScope::FixScope(const std::string& path, std::span<const std::string> named)
    : root_(shown_path(path)) {
    const std::filesystem::path folder =
        path == "-" ? std::filesystem::path() : std::filesystem::path(path).parent_path();
    folder_ = real_path(folder.empty() ? "." : folder);
    for (const std::string& each : named) {
        named_.insert(real_path(each));
    }
}

bool FixScope::contains(const std::string& path) const {
    if (path == root_) {
        return true;
    }
    const std::filesystem::path real = real_path(path);
    if (real.empty() || folder_.empty()) {
        return false;
    }
    const auto [inner, rest] =
        std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end());
    return inner == folder_.end() || named_.contains(real);
}

FileEdits choose_edits(const Diagnostics& diagnostics,
                       const SourceMap& sources,
                       const FixScope& scope,
                       FixedGrammar& fixed) {
    FileEdits chosen;
    std::map<std::string, TakenPlaces> taken;
    std::map<std::string, bool> known; // paths, and whether the scope has them
    fixed.left.clear();
    const auto is_left = [&](const Edit& edit) {
        const std::string& path = sources.file(edit.span.file).path();
        auto found = known.find(path);
        if (found == known.end()) {
            found = known.emplace(path, scope.contains(path)).first;
        }
        if (!found->second) {
            fixed.left.insert(path);
        }
        return !found->second;
    };
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        const Fix* const fix = first_applicable(diagnostic);
        if (fix == nullptr || std::any_of(fix->edits.begin(), fix->edits.end(), is_left)) {
            continue;
        }
        // A file that is included twice is one text, so paths decide, not ids.
        const bool conflict = std::any_of(fix->edits.begin(), fix->edits.end(), [&](const Edit& e) {
            return is_taken(taken[sources.file(e.span.file).path()], e.span);
        });
        if (conflict) {
            continue;
        }
        for (const Edit& edit : fix->edits) {
            const std::string& path = sources.file(edit.span.file).path();
            taken[path].emplace(edit.span.begin, edit.span.end);
            chosen[path].push_back(&edit);
        }
        ++fixed.fix_count;
        if (fixed.lines.size() < kMaxFixLines) {
            fixed.lines.push_back(describe(diagnostic, *fix, sources));
        }
    }
    for (auto& [path, edits] : chosen) {
        std::sort(edits.begin(), edits.end(),
                  [](const Edit* a, const Edit* b) { return a->span.begin < b->span.begin; });
    }
    return chosen;
}

std::string apply_edits(std::string_view text, const std::vector<const Edit*>& edits) {
    const std::size_t first_end = text.find('\n');
    const bool has_crlf =
        first_end != std::string_view::npos && first_end > 0 && text[first_end - 1] == '\r';
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

Result<Done> fix_text(const std::string& path,
                      const GrammarText& original,
                      const GrammarOptions& options,
                      const FixScope& scope,
                      const Project& project,
                      FixedGrammar& fixed) {
    const std::string root = shown_path(path);
    std::map<std::string, std::string>& changed = fixed.changed;
    for (int round = 0;; ++round) {
        const FileLoader from_disk = make_loader(project, project.limits.max_bytes);
        const FileLoader load = [&](const std::string& wanted) -> Result<std::string> {
            const auto known = changed.find(wanted);
            return known != changed.end() ? Result<std::string>(known->second) : from_disk(wanted);
        };
        const auto mended = changed.find(root);
        const std::string& bytes = mended != changed.end() ? mended->second : original.bytes;
        Result<CompiledText> compiled = compile_text(path, {bytes, original.dialect}, options,
                                                     project.limits.max_modules, load);
        if (!compiled) {
            return compiled.error();
        }
        fixed.compiled = std::move(compiled.value());
        if (fixed.compiled.definition_error) {
            return *fixed.compiled.definition_error;
        }
        Diagnostics& diagnostics = fixed.compiled.diagnostics;
        const SourceMap& sources = *fixed.compiled.grammar.sources;
        diagnostics.sort_by_place();
        if (round == kMaxRounds || project.is_cancelled()) {
            return Done{};
        }
        const FileEdits edits = choose_edits(diagnostics, sources, scope, fixed);
        if (edits.empty()) {
            return Done{};
        }
        for (std::uint32_t i = 0; i < sources.file_count(); ++i) {
            const SourceFile& file = sources.file(static_cast<FileId>(i));
            if (const auto found = edits.find(file.path()); found != edits.end()) {
                std::string text(file.has_byte_order_mark() ? kByteOrderMark : "");
                text += apply_edits(file.text(), found->second);
                changed[file.path()] = std::move(text);
            }
        }
    }
}

} // namespace lsys::lsc
