// SPDX-License-Identifier: MIT
// Levels of diagnostics (error, warning or hidden), set by the options --allow, --warn and --deny
// and by the comments `/* lsc: allow CODE */` of grammars. Errors stay errors.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace lsys {

enum class MessageLevel : std::uint8_t {
    Allow, // not shown
    Warn,
    Deny, // an error
};

/// Levels of single codes, of all warnings and of all notes. The level of a code overrides the
/// level of its group.
class MessageLevels {
public:
    /// Sets the level of a code, or of all `warnings` or `notes`. Returns a message if the code
    /// does not exist, is the code of an error, or already has another level.
    [[nodiscard]] std::optional<std::string> set(MessageLevel level,
                                                 std::string_view code_or_group);

    /// The level of a diagnostic; nullopt if it is an error or keeps its usual severity.
    [[nodiscard]] std::optional<MessageLevel> level_of(const Diagnostic& diagnostic) const;
    [[nodiscard]] bool denies_warnings() const { return warnings_ == MessageLevel::Deny; }

    friend bool operator==(const MessageLevels&, const MessageLevels&) = default;

private:
    std::map<DiagnosticCode, MessageLevel> codes_;
    // Levels of warnings and of notes whose code has no level of its own; unset: usual severity.
    std::optional<MessageLevel> warnings_;
    std::optional<MessageLevel> notes_;
};

/// Gives diagnostics the severities of their levels; removes diagnostics that a level or a comment
/// of `sources` allows.
void apply_levels(const MessageLevels& levels, const SourceMap& sources, Diagnostics& diagnostics);

/// The reason why the level of `code` cannot be set, as a clause: "`x` is ..."; nullopt if it can
/// be set.
[[nodiscard]] std::optional<std::string> reason_against_level(std::string_view code);

} // namespace lsys
