// SPDX-License-Identifier: MIT
// TableReader: reads the values of a table of a scene file key by key, reports mistakes in each,
// and finally reports the keys that were not read.
#pragma once

#include "grammar/base/diagnostic.h"
#include "runtime/scene/impl/document.h"
#include "runtime/scene/scene.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The range of a number.
struct NumberRange {
    double min = 0.0;
    double max = 0.0;
    bool excludes_min = false;
    std::string_view unit; // for messages, such as "m"; empty: none
};

struct IntegerRange {
    std::uint64_t min = 0;
    std::uint64_t max = 0;
};

class TableReader {
public:
    /// `name`: the heading as written, `[terrain]`; empty for the keys above all tables. `table`:
    /// nullptr if the file lacks the table; every key is then missing.
    TableReader(const SceneValue* table, std::string_view name, Diagnostics& diagnostics)
        : table_(table), name_(name), diagnostics_(diagnostics) {}

    /// The functions from entry() to table() return the value of `key`, or none (nullptr) if the
    /// key is missing or its value was reported as wrong.
    [[nodiscard]] const SceneEntry* entry(std::string_view key);
    [[nodiscard]] std::optional<double> number(std::string_view key, const NumberRange& range);
    [[nodiscard]] std::optional<std::uint64_t> integer(std::string_view key, IntegerRange range);
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    /// The path of a file, which may not exist.
    [[nodiscard]] std::optional<SceneFile> file(std::string_view key);
    /// The index of the value in `names`.
    [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                    std::span<const std::string_view> names);
    /// A list `[first, second]`; with `lone` also a single number, which is then both values.
    [[nodiscard]] std::optional<std::array<double, 2>>
    pair(std::string_view key, const NumberRange& range, bool lone);
    /// Like pair(), but reports an error if the first number is above the second.
    [[nodiscard]] std::optional<std::array<double, 2>> ordered_pair(std::string_view key,
                                                                    const NumberRange& range);
    /// The value, if it is a table.
    [[nodiscard]] const SceneValue* table(std::string_view key);

    /// Reads `value` as a number; `what` names the value in messages.
    [[nodiscard]] std::optional<double>
    number_of(const SceneValue& value, std::string_view what, const NumberRange& range);
    [[nodiscard]] std::optional<std::uint64_t>
    integer_of(const SceneValue& value, std::string_view what, IntegerRange range);

    /// Reports that the table lacks `key`: "SUBJECT has no `KEY`".
    Diagnostic& report_missing(std::string_view key, std::string_view subject);
    Diagnostic& report_bad_value(SourceSpan span, std::string message);
    /// Reports `key`, if present, as not allowed. `reason`: a sentence. `cause`: the place of the
    /// value that forbids the key; SourceSpan{} if there is none.
    void report_conflicting_key(std::string_view key, std::string_view reason, SourceSpan cause);
    /// Reports the keys that were not read. Called last.
    void finish();

    [[nodiscard]] bool has(std::string_view key) const {
        return table_ != nullptr && find_entry(*table_, key) != nullptr;
    }
    /// The place of the value of `key`, or of the table if the key is missing.
    [[nodiscard]] SourceSpan span_of(std::string_view key) const;
    [[nodiscard]] SourceSpan span() const {
        return table_ == nullptr ? SourceSpan{} : table_->span;
    }

private:
    Diagnostic&
    report_wrong_kind(const SceneValue& value, std::string_view what, std::string_view wanted);

    const SceneValue* table_;
    std::string name_;
    Diagnostics& diagnostics_;
    std::vector<std::string_view> known_; // keys that the reader has asked for
};

} // namespace lsys
