// SPDX-License-Identifier: MIT
// Reads a TOML file as a tree of values with their byte positions. Keys are in the order of the
// text.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class SceneValueKind : std::uint8_t { Table, List, Text, Integer, Real, Boolean, Date };

struct SceneEntry;

/// A value. The comments of the last five members name the kinds that set them.
struct SceneValue {
    SceneValueKind kind = SceneValueKind::Table;
    SourceSpan span;                 // for a table: its heading, or the whole inline table
    std::int64_t integer = 0;        // Integer
    double real = 0.0;               // Real, and Integer rounded
    std::string text;                // Text
    std::vector<SceneValue> items;   // List
    std::vector<SceneEntry> entries; // Table
};

struct SceneEntry {
    std::string key;
    SourceSpan key_span;
    SceneValue value;
};

/// The kind as words in messages, such as "a text" or "a list".
[[nodiscard]] std::string_view kind_text(SceneValueKind kind);

/// The entry of `key`, or nullptr.
[[nodiscard]] const SceneEntry* find_entry(const SceneValue& table, std::string_view key);

/// Reads the table of the whole file. Returns none, with a diagnostic, if the file is not TOML.
[[nodiscard]] std::optional<SceneValue>
read_toml(FileId file, const SourceMap& sources, Diagnostics& diagnostics);

} // namespace lsys
