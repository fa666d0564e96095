// SPDX-License-Identifier: MIT
// RepairAttempt::ambiguous_statements(): comparison of repairs with their alternatives.
#include "compiler/program/program_dump.h"
#include "grammar/base/characters.h"
#include "runtime/repair/impl/alternative_repairs.h"
#include "runtime/repair/impl/mistyped_signs.h"
#include "runtime/repair/impl/repair_attempt.h"

#include <algorithm>

namespace lsys::repair {

namespace {

/// Max number of compared repairs, and max bytes of their files: a comparison compiles the file for
/// each alternative. Repairs beyond these limits are offers.
constexpr std::size_t kMaxCompared = 100;
constexpr std::size_t kMaxComparedFile = std::size_t{1} << 20;

/// The name and the number of parameters of a module.
using ModuleName = std::pair<std::string, std::uint32_t>;

std::set<ModuleName> modules_of(const Grammar& grammar) {
    std::set<ModuleName> modules;
    for (const Symbol& symbol : grammar.program->symbols) {
        modules.emplace(grammar.names.text(symbol.name), symbol.parameter_count);
    }
    return modules;
}

} // namespace

std::set<StatementKey> RepairAttempt::ambiguous_statements() const {
    std::set<StatementKey> keys;
    if (subject_.choice == FixChoice::Offered) {
        return keys; // the user accepts ambiguous repairs
    }
    std::size_t compared = 0;
    const std::set<DiagnosticCode> single = codes_of_single_mistakes();
    for (const auto& [key, fixes] : applied_) {
        if (subject_.project.is_cancelled()) {
            break;
        }
        const auto candidate = std::find_if(fixes.begin(), fixes.end(), [](const AppliedFix& fix) {
            return may_have_alternatives(fix.code);
        });
        // Several repairs of one statement count as ambiguous, because combinations are not
        // compared.
        if (candidate != fixes.end() &&
            (fixes.size() > 1 || ++compared > kMaxCompared ||
             has_alternative(key, *candidate, single.contains(candidate->code)))) {
            keys.insert(key);
            continue;
        }
        const bool is_slip = std::any_of(fixes.begin(), fixes.end(), [&](const AppliedFix& fix) {
            return single.contains(fix.code) && (fix.may_be_slip || may_be_mistyped(fix));
        });
        if (is_slip) {
            keys.insert(key);
        }
    }
    return keys;
}

/// The codes of which the original has exactly one repaired mistake. A mistake made several times
/// is a habit of the author, not a typing error.
std::set<DiagnosticCode> RepairAttempt::codes_of_single_mistakes() const {
    std::map<DiagnosticCode, std::set<std::pair<std::string, std::uint32_t>>> places;
    for (const auto& [key, fixes] : applied_) {
        for (const AppliedFix& fix : fixes) {
            places[fix.code].emplace(fix.path, fix.place);
        }
    }
    std::set<DiagnosticCode> single;
    for (const auto& [code, places_of_code] : places) {
        const auto original = original_counts_.find(code);
        if (places_of_code.size() == 1 &&
            (original == original_counts_.end() || original->second == 1)) {
            single.insert(code);
        }
    }
    return single;
}

/// Whether a fix added a sign that the author may have typed, wrongly, as a character next to its
/// place.
bool RepairAttempt::may_be_mistyped(const AppliedFix& fix) const {
    if (fix.added == '\0' || fix.added == '#') {
        return false; // characters beside a `#` belong to a label, whose spelling changes no word
    }
    const EditedFile& file = files_.at(fix.path);
    const SourceFile* const source = find_source(fix.path);
    if (source == nullptr || source->text().size() > kMaxComparedFile) {
        return true;
    }
    const std::string_view text = source->text();
    std::uint32_t begin = 0; // first offset that is not before the fix
    for (auto count = static_cast<std::uint32_t>(text.size()); count > 0;) {
        const std::uint32_t half = count / 2;
        if (file.original_place(begin + half) < fix.place) {
            begin += half + 1;
            count -= half + 1;
        } else {
            count = half;
        }
    }
    std::uint32_t end = begin;
    while (end < text.size() && text[end] != fix.added &&
           file.original_place(end + 1) == fix.place) {
        ++end;
    }
    if (end == text.size() || text[end] != fix.added) {
        return true; // another fix has removed the sign
    }
    // Remove blanks that another fix has put before the character, since `FF` may be a mistyped
    // `F;`.
    std::string joined(text);
    const std::size_t last = text.find_last_not_of(kWhitespace, begin == 0 ? 0 : begin - 1);
    const std::size_t previous = last == 0 || last == std::string_view::npos
                                     ? std::string_view::npos
                                     : text.find_last_not_of(kWhitespace, last - 1);
    if (previous != std::string_view::npos && last < begin && previous + 1 < last &&
        file.original_place(static_cast<std::uint32_t>(last)) ==
            file.original_place(static_cast<std::uint32_t>(previous)) + 1) {
        const auto added = static_cast<std::uint32_t>(last - previous - 1);
        joined.erase(previous + 1, added);
        begin -= added;
        end -= added;
    }
    const std::vector<std::string> others = mistyped_texts(joined, {begin, end + 1});
    return std::any_of(others.begin(), others.end(), [&](const std::string& other) {
        return compile_other(fix.path, other).has_value();
    });
}

/// Whether an alternative is as plausible as the applied fix. `is_single`: the original has only
/// one mistake of this code.
bool RepairAttempt::has_alternative(const StatementKey& key,
                                    const AppliedFix& fix,
                                    bool is_single) const {
    const EditedFile& file = files_.at(key.first);
    const TextPlace before = file.statements()[key.second];
    const std::optional<TextPlace> now = place_after_fixes(key);
    const SourceFile* const source = find_source(key.first);
    if (!now || source == nullptr || fix.path != key.first || fix.place < before.begin ||
        source->text().size() > kMaxComparedFile ||
        before.end - before.begin > kMaxComparedStatement) {
        return true;
    }
    const std::string_view text = source->text();
    StatementRepair repair;
    repair.code = fix.code;
    repair.is_single = is_single;
    repair.broken =
        std::string_view(file.original()).substr(before.begin, before.end - before.begin);
    repair.repaired = text.substr(now->begin, now->end - now->begin);
    repair.place = fix.place - before.begin;
    repair.file_text = text;
    const std::vector<std::string> others = alternative_repairs(repair);
    const CompiledText& fixed = fixed_.compiled;
    if (others.empty() || !fixed.grammar.program) {
        return !others.empty();
    }
    const std::set<ModuleName> modules = modules_of(fixed.grammar);
    return std::any_of(others.begin(), others.end(), [&](const std::string& other) {
        std::string other_text(text.substr(0, now->begin));
        other_text += other;
        other_text += text.substr(now->end);
        const std::optional<CompiledText> alternative = compile_other(key.first, other_text);
        if (!alternative || !alternative->grammar.program) {
            return false;
        }
        // For a missing comma the alternative is a missing `*`. It is not plausible if it makes a
        // module whose name and number of parameters no other module has.
        const std::set<ModuleName> alternative_modules = modules_of(alternative->grammar);
        return fix.code != DiagnosticCode::MissingComma ||
               alternative_modules.size() <= modules.size() ||
               !std::includes(alternative_modules.begin(), alternative_modules.end(),
                              modules.begin(), modules.end());
    });
}

/// Compiles the repaired grammar with `text` in place of one of its files. Nothing if that gives
/// more errors, more warnings or the same program.
std::optional<CompiledText> RepairAttempt::compile_other(const std::string& path,
                                                         std::string_view text) const {
    const CompiledText& fixed = fixed_.compiled;
    const SourceFile* const source = find_source(path);
    std::map<std::string, std::string> changed = fixed_.changed;
    std::string& bytes = changed[path];
    bytes = std::string(source->has_byte_order_mark() ? kByteOrderMark : "");
    bytes += text;
    CompiledText other;
    if (!compile_changed(subject_, changed, other) ||
        other.diagnostics.count(Severity::Error) > fixed.diagnostics.count(Severity::Error) ||
        other.diagnostics.count(Severity::Warning) > fixed.diagnostics.count(Severity::Warning) ||
        (fixed.grammar.program && other.grammar.program &&
         dump_without_labels(*other.grammar.program, other.grammar.names) ==
             dump_without_labels(*fixed.grammar.program, fixed.grammar.names))) {
        return std::nullopt;
    }
    return other;
}

/// The place of the statement after all fixes; nothing if the fixes split or removed it.
std::optional<TextPlace> RepairAttempt::place_after_fixes(const StatementKey& key) const {
    const EditedFile& file = files_.at(key.first);
    std::optional<TextPlace> found;
    for (const SourceSpan& span : fixed_.compiled.statements) {
        if ((*fixed_.compiled.grammar.sources).file(span.file).path() != key.first ||
            file.original_place(span.begin) != file.statements()[key.second].begin) {
            continue;
        }
        const TextPlace place{span.begin, span.end};
        if (found && *found != place) {
            return std::nullopt;
        }
        found = place;
    }
    return found;
}

const SourceFile* RepairAttempt::find_source(const std::string& path) const {
    const SourceMap& sources = *fixed_.compiled.grammar.sources;
    for (std::uint32_t i = 0; i < sources.file_count(); ++i) {
        if (sources.file(static_cast<FileId>(i)).path() == path) {
            return &sources.file(static_cast<FileId>(i));
        }
    }
    return nullptr;
}

} // namespace lsys::repair
