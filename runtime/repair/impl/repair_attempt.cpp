// SPDX-License-Identifier: MIT
#include "runtime/repair/impl/repair_attempt.h"

#include "grammar/base/characters.h"
#include "grammar/rendering/render_diagnostic.h"
#include "runtime/program/host.h"
#include "runtime/repair/impl/mistyped_signs.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys::repair {

namespace {

/// Max number of rounds. Each round compiles the text again, because a mistake may hide others.
constexpr int kMaxRounds = 100;

std::string describe(const Diagnostic& diagnostic, const Fix& fix, const SourceMap& sources) {
    const SourceSpan span = fix.edits.front().span;
    const SourceFile& file = sources.file(span.file);
    const LineColumn place = file.line_column(span.begin);
    return fmt::format("{}:{}:{}: fixed: {} [{}]", file.path(), place.line, place.column, fix.title,
                       info(diagnostic.code).name);
}

/// Appends the fix as a line of JSON.
void append_record(const Diagnostic& diagnostic,
                   const Fix& fix,
                   const SourceMap& sources,
                   std::string& out) {
    Diagnostic record = make_diagnostic(diagnostic.code, fix.edits.front().span,
                                        fmt::format("fixed: {}", fix.title));
    record.severity = Severity::Note;
    record.fixes = {fix};
    record.facts = {{"applied", true}};
    RenderOptions options;
    options.format = MessageFormat::Json;
    render(record, sources, options, out);
}

/// Whether the mistake may be one mistyped character: the fix exchanges two characters (`=>` may
/// mean `>=` or `==`), removes one, or replaces one by something other than a single sign. False
/// for a doubled character, which was typed too often.
bool may_be_slip(std::string_view text, const Edit& edit) {
    const std::uint32_t at = edit.span.begin;
    if (edit.replacement.size() == 2 && edit.span.end - at == 2 &&
        edit.replacement[0] == text[at + 1] && edit.replacement[1] == text[at]) {
        return true;
    }
    if (edit.span.end - at != 1 || kWhitespace.find(text[at]) != std::string_view::npos) {
        return false;
    }
    const bool is_doubled = (at > 0 && text[at - 1] == text[at]) ||
                            (edit.span.end < text.size() && text[edit.span.end] == text[at]);
    const bool is_sign = edit.replacement.size() == 1 && !is_word_character(edit.replacement[0]);
    return !is_doubled && !is_sign;
}

/// Whether a repair of this code is applied regardless of other errors in its statement.
bool is_independent(DiagnosticCode code) {
    return code == DiagnosticCode::LookAlike;
}

} // namespace

Result<void> compile_changed(const RepairSubject& subject,
                             const std::map<std::string, std::string>& changed,
                             CompiledText& compiled) {
    const FileLoader from_disk = make_include_loader(subject.project);
    const FileLoader load = [&](const std::string& wanted) -> Result<std::string> {
        const auto known = changed.find(wanted);
        return known != changed.end() ? Result<std::string>(known->second) : from_disk(wanted);
    };
    const auto fixed_text = changed.find(shown_path(subject.path));
    const std::string& bytes =
        fixed_text != changed.end() ? fixed_text->second : subject.text.bytes;
    Result<CompiledText> result =
        compile_text(subject.path, {bytes, subject.text.dialect}, subject.options,
                     subject.project.limits.max_modules, load);
    if (!result) {
        return result.error();
    }
    compiled = std::move(result.value());
    if (compiled.definition_error) {
        return *compiled.definition_error;
    }
    return {};
}

Result<void> RepairAttempt::run() {
    for (int round = 0;; ++round) {
        CompiledText& compiled = fixed_.compiled;
        if (Result<void> done = compile_changed(subject_, fixed_.changed, compiled); !done) {
            return done;
        }
        fixed_.out_of_scope.clear();
        read_files();
        read_syntax_errors();
        if (round == 0) {
            read_original_errors();
        }
        compiled.diagnostics.sort_by_place();
        if (round == kMaxRounds || excludes_all_ || subject_.project.is_cancelled()) {
            return {};
        }
        const ChosenFixes chosen =
            choose_fixes(compiled.diagnostics, *compiled.grammar.sources, subject_.choice,
                         [&](const Diagnostic& diagnostic, const Fix& fix) {
                             return may_apply(diagnostic, fix);
                         });
        if (chosen.fixes.empty()) {
            return {};
        }
        apply(chosen);
    }
}

/// Adds the files that are read for the first time in this round to files_.
void RepairAttempt::read_files() {
    const SourceMap& sources = *fixed_.compiled.grammar.sources;
    std::map<std::string, std::vector<TextPlace>> statements;
    for (const SourceSpan& span : fixed_.compiled.statements) {
        const std::string& path = sources.file(span.file).path();
        if (files_.find(path) == files_.end()) {
            statements[path].push_back({span.begin, span.end});
        }
    }
    for (std::uint32_t i = 0; i < sources.file_count(); ++i) {
        const SourceFile& file = sources.file(static_cast<FileId>(i));
        if (files_.find(file.path()) == files_.end()) {
            files_.emplace(file.path(),
                           EditedFile(file.text(), std::move(statements[file.path()])));
        }
    }
}

/// Sets with_syntax_errors_. Precondition: the diagnostics are not sorted yet.
void RepairAttempt::read_syntax_errors() {
    with_syntax_errors_.clear();
    const std::vector<Diagnostic>& all = fixed_.compiled.diagnostics.all();
    for (std::size_t i = 0; i < std::min(fixed_.compiled.syntax_diagnostic_count, all.size());
         ++i) {
        if (all[i].severity == Severity::Error) {
            for (StatementKey& key : statements_at(all[i].span)) {
                with_syntax_errors_.insert(std::move(key));
            }
        }
    }
}

void RepairAttempt::read_original_errors() {
    for (const Diagnostic& diagnostic : fixed_.compiled.diagnostics.all()) {
        ++original_counts_[diagnostic.code];
        if (diagnostic.severity == Severity::Error) {
            for (const StatementKey& key : statements_at(diagnostic.span)) {
                original_errors_[key].emplace(diagnostic.code, diagnostic.message);
            }
        }
    }
}

bool RepairAttempt::may_apply(const Diagnostic& diagnostic, const Fix& fix) {
    if (diagnostic.severity != Severity::Error && fixed_.compiled.diagnostics.has_errors()) {
        return false;
    }
    if (subject_.project.levels.level_of(diagnostic) == MessageLevel::Allow) {
        return false;
    }
    const SourceMap& sources = *fixed_.compiled.grammar.sources;
    for (const Edit& edit : fix.edits) {
        const std::string& path = sources.file(edit.span.file).path();
        if (!subject_.scope.contains(path)) {
            fixed_.out_of_scope.insert(path);
            return false;
        }
    }
    if (subject_.choice == FixChoice::Offered) {
        const SourceSpan first = fix.edits.front().span;
        const std::string& path = sources.file(first.file).path();
        if (repaired_places_.count(
                {path, files_.at(path).original_place(first.begin), diagnostic.code}) != 0) {
            return false;
        }
    }
    if (is_independent(diagnostic.code)) {
        return true;
    }
    const std::vector<StatementKey> keys = statements_of(fix);
    return std::none_of(keys.begin(), keys.end(),
                        [&](const StatementKey& key) { return excluded_.count(key) != 0; });
}

void RepairAttempt::apply(const ChosenFixes& chosen) {
    const SourceMap& sources = *fixed_.compiled.grammar.sources;
    for (std::size_t i = 0; i < chosen.fixes.size(); ++i) {
        const Fix& fix = *chosen.fixes[i];
        ++fixed_.fix_count;
        if (fixed_.lines.size() < kMaxFixLines) {
            fixed_.lines.push_back(describe(*chosen.diagnostics[i], fix, sources));
        }
        const SourceSpan first = fix.edits.front().span;
        const std::string& path = sources.file(first.file).path();
        const std::string_view text = sources.file(first.file).text();
        const AppliedFix applied{chosen.diagnostics[i]->code, path,
                                 files_.at(path).original_place(first.begin),
                                 fix.edits.size() == 1 && first.begin == first.end
                                     ? added_sign(fix.edits.front().replacement)
                                     : '\0',
                                 may_be_slip(text, fix.edits.front())};
        append_record(*chosen.diagnostics[i], fix, sources, fixed_.records);
        repaired_places_.emplace(path, applied.place, applied.code);
        for (const StatementKey& key : statements_of(fix)) {
            applied_[key].push_back(applied);
        }
    }
    std::set<std::string> done; // paths done, since a file may be included twice
    for (std::uint32_t i = 0; i < sources.file_count(); ++i) {
        const SourceFile& file = sources.file(static_cast<FileId>(i));
        const auto found = chosen.edits.find(file.path());
        if (found != chosen.edits.end() && done.insert(file.path()).second) {
            std::string text(file.has_byte_order_mark() ? kByteOrderMark : "");
            text += apply_edits(file.text(), found->second);
            fixed_.changed[file.path()] = std::move(text);
            files_.at(file.path()).add_round(file.text(), found->second);
        }
    }
}

std::vector<StatementKey> RepairAttempt::statements_at(SourceSpan span) const {
    std::vector<StatementKey> keys;
    if (span.file == kNoFile) {
        return keys;
    }
    const std::string& path = (*fixed_.compiled.grammar.sources).file(span.file).path();
    for (const std::size_t number : files_.at(path).statements_at({span.begin, span.end})) {
        keys.emplace_back(path, number);
    }
    return keys;
}

std::vector<StatementKey> RepairAttempt::statements_of(const Fix& fix) const {
    std::set<StatementKey> keys;
    for (const Edit& edit : fix.edits) {
        for (StatementKey& key : statements_at(edit.span)) {
            keys.insert(std::move(key));
        }
    }
    return {keys.begin(), keys.end()};
}

std::set<StatementKey> RepairAttempt::wrong_statements() const {
    const auto is_repaired = [&](const StatementKey& key) {
        const auto applied = applied_.find(key);
        return applied != applied_.end() &&
               std::any_of(applied->second.begin(), applied->second.end(),
                           [](const AppliedFix& fix) { return !is_independent(fix.code); });
    };
    std::set<StatementKey> keys;
    for (const StatementKey& key : with_syntax_errors_) {
        if (subject_.choice == FixChoice::Certain && is_repaired(key)) {
            keys.insert(key);
        }
    }
    for (const Diagnostic& diagnostic : fixed_.compiled.diagnostics.all()) {
        if (diagnostic.severity != Severity::Error) {
            continue;
        }
        for (const StatementKey& key : statements_at(diagnostic.span)) {
            const auto before = original_errors_.find(key);
            const bool is_new = before == original_errors_.end() ||
                                before->second.count({diagnostic.code, diagnostic.message}) == 0;
            // The parser also reads the original as if it were repaired. So an error that a wrong
            // repair causes may be reported for the original, too.
            if ((is_new || subject_.choice == FixChoice::Certain) && is_repaired(key)) {
                keys.insert(key);
            }
        }
    }
    return keys;
}

void RepairAttempt::offer_doubtful(Diagnostics& diagnostics, const SourceMap& sources) const {
    const bool are_errors_left = fixed_.compiled.diagnostics.has_errors();
    diagnostics.offer_fixes_where([&](const Diagnostic& diagnostic) {
        if (is_independent(diagnostic.code)) {
            return false;
        }
        if (excludes_all_ || (diagnostic.severity != Severity::Error && are_errors_left)) {
            return true;
        }
        return std::any_of(diagnostic.fixes.begin(), diagnostic.fixes.end(), [&](const Fix& fix) {
            return std::any_of(fix.edits.begin(), fix.edits.end(), [&](const Edit& edit) {
                const std::string& path = sources.file(edit.span.file).path();
                const auto file = files_.find(path);
                if (file == files_.end()) {
                    return false;
                }
                const std::vector<std::size_t> touched =
                    file->second.original_statements_at({edit.span.begin, edit.span.end});
                return std::any_of(touched.begin(), touched.end(), [&](std::size_t number) {
                    return excluded_.count({path, number}) != 0;
                });
            });
        });
    });
}

} // namespace lsys::repair
