// SPDX-License-Identifier: MIT
// Reads a text in the notation of "The Algorithmic Beauty of Plants" into statements with spans.
// The parts of statements are read by the writer.
#pragma once

#include "grammar/ast/parse_context.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class AbopKey : std::uint8_t {
    Axiom,
    Generations,
    Angle,
    Step,
    Width,
    Seed,
    Ignore,
    Consider
};

enum class AbopStage : std::uint8_t { Rewrite, Decompose, Interpret };

struct AbopSetting {
    AbopKey key{};
    SourceSpan name;
    SourceSpan value; // without blanks at its ends; may be empty
};

struct AbopConstant {
    SourceSpan name;
    SourceSpan value;
};

/// `label: left < predecessor > right : condition -chance-> successor`. Spans have no blanks at
/// their ends.
struct AbopRule {
    SourceSpan span;
    SourceSpan head; // all before the first `:` that is not the end of the label
    std::optional<SourceSpan> label;
    std::optional<SourceSpan> left;
    SourceSpan predecessor;
    std::optional<SourceSpan> right;
    std::optional<SourceSpan> condition;
    std::optional<SourceSpan> chance; // a probability, perhaps with a `%`
    SourceSpan arrow;
    SourceSpan successor; // may be empty
    AbopStage stage = AbopStage::Rewrite;
};

struct AbopFile {
    /// The text with blanks in place of comments and carriage returns, byte for byte.
    std::string text;
    std::vector<AbopSetting> settings;
    std::vector<AbopConstant> constants;
    std::vector<AbopRule> rules;
    std::vector<std::string> names; // declared symbols of several characters
    bool is_lpy = false;            // `_` is a command, functions are Python's

    [[nodiscard]] std::string_view text_of(SourceSpan span) const {
        return std::string_view(text).substr(span.begin, span.end - span.begin);
    }
    /// The setting of a key; null if the file has none.
    [[nodiscard]] const AbopSetting* find(AbopKey key) const;
};

/// Reads a file. Without `context` no mistake is reported.
[[nodiscard]] AbopFile read_abop(FileId file, std::string_view text, const ParseContext* context);
/// Whether most lines of a text are statements of the notation, among them an axiom and a rule.
[[nodiscard]] bool is_abop(std::string_view text);

/// Splits `left < predecessor > right`, the head of a rule.
void split_contexts(const AbopFile& file, AbopRule& rule);
/// The setting with a name; nullopt if there is none.
[[nodiscard]] std::optional<AbopKey> abop_key(std::string_view name);

} // namespace lsys
