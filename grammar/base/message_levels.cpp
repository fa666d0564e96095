// SPDX-License-Identifier: MIT
#include "grammar/base/message_levels.h"

#include <vector>

namespace lsys {

namespace {

Severity severity_at(MessageLevel level) {
    return level == MessageLevel::Deny ? Severity::Error : Severity::Warning;
}

} // namespace

std::optional<std::string> reason_against_level(std::string_view code) {
    const std::string quoted = "`" + std::string(code) + "`";
    if (const std::optional<DiagnosticCode> found = find_diagnostic_code(code)) {
        return info(*found).severity == Severity::Error
                   ? std::optional(quoted + " is an error, which has no other level")
                   : std::nullopt;
    }
    std::vector<std::string_view> names;
    for (std::uint32_t i = 0; i < diagnostic_code_count(); ++i) {
        names.push_back(info(static_cast<DiagnosticCode>(i)).name);
    }
    const std::optional<std::string_view> nearest = nearest_name(code, names);
    return quoted + " is not the code of a message" +
           (nearest ? "; did you mean `" + std::string(*nearest) + "`?" : std::string());
}

std::optional<std::string> MessageLevels::set(MessageLevel level, std::string_view code_or_group) {
    const auto put = [&](std::optional<MessageLevel>& group) -> std::optional<std::string> {
        if (group && *group != level) {
            return "`" + std::string(code_or_group) + "` have two levels";
        }
        group = level;
        return std::nullopt;
    };
    if (code_or_group == "warnings") {
        return put(warnings_);
    }
    if (code_or_group == "notes") {
        return put(notes_);
    }
    if (std::optional<std::string> reason = reason_against_level(code_or_group)) {
        return reason;
    }
    const auto [at, is_new] = codes_.try_emplace(*find_diagnostic_code(code_or_group), level);
    return is_new || at->second == level
               ? std::nullopt
               : std::optional("`" + std::string(code_or_group) + "` has two levels");
}

std::optional<MessageLevel> MessageLevels::level_of(const Diagnostic& diagnostic) const {
    if (diagnostic.severity == Severity::Error) {
        return std::nullopt;
    }
    if (const auto found = codes_.find(diagnostic.code); found != codes_.end()) {
        return found->second;
    }
    return diagnostic.severity == Severity::Warning ? warnings_ : notes_;
}

void apply_levels(const MessageLevels& levels, const SourceMap& sources, Diagnostics& diagnostics) {
    diagnostics.reassign_severities([&](const Diagnostic& diagnostic) -> std::optional<Severity> {
        if (diagnostic.severity == Severity::Error) {
            return diagnostic.severity;
        }
        if (diagnostic.span.file != kNoFile &&
            sources.allows(diagnostic.span, info(diagnostic.code).name)) {
            return std::nullopt;
        }
        const std::optional<MessageLevel> level = levels.level_of(diagnostic);
        if (!level) {
            return diagnostic.severity;
        }
        return *level == MessageLevel::Allow ? std::nullopt : std::optional(severity_at(*level));
    });
    if (levels.denies_warnings()) {
        diagnostics.promote_unstored_warnings();
    }
}

} // namespace lsys
