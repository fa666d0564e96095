// TableReader: takes the values of a table of a scene file one key at a time, says what is wrong
// with each, and in the end what nobody has asked for.
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

/// What a number may be.
struct NumberRange {
    double least = 0.0;
    double most = 0.0;
    bool above = false; // `least` itself is too little
    std::string_view unit;
};

struct WholeRange {
    std::uint64_t least = 0;
    std::uint64_t most = 0;
};

class TableReader {
public:
    /// `name` as it is written: `[terrain]`; empty: the file. `table` may be nullptr: there is none
    /// in the file, and all keys are missing.
    TableReader(const SceneValue* table, std::string_view name, Diagnostics& diagnostics)
        : table_(table), name_(name), diagnostics_(diagnostics) {}

    /// Each of these gives the value of `key`; none where it is not there, or is reported.
    [[nodiscard]] const SceneEntry* entry(std::string_view key);
    [[nodiscard]] std::optional<double> number(std::string_view key, const NumberRange& range);
    [[nodiscard]] std::optional<std::uint64_t> whole(std::string_view key, WholeRange range);
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    /// Of a file, not yet whether there is one.
    [[nodiscard]] std::optional<SceneFile> file(std::string_view key);
    /// Which of `names` stands there.
    [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                    std::span<const std::string_view> names);
    /// `[first, second]`; with `lone`, also one number for both.
    [[nodiscard]] std::optional<std::array<double, 2>>
    pair(std::string_view key, const NumberRange& range, bool lone);
    /// The same, and the first is not above the second.
    [[nodiscard]] std::optional<std::array<double, 2>> ordered_pair(std::string_view key,
                                                                    const NumberRange& range);
    [[nodiscard]] const SceneValue* table(std::string_view key);

    /// Of one value, wherever it stands; `what` names it.
    [[nodiscard]] std::optional<double>
    number_of(const SceneValue& value, std::string_view what, const NumberRange& range);
    [[nodiscard]] std::optional<std::uint64_t>
    whole_of(const SceneValue& value, std::string_view what, WholeRange range);

    /// Says that the table needs `key`.
    Diagnostic& missing(std::string_view key, std::string_view why);
    Diagnostic& bad(SourceSpan span, std::string message);
    /// Says that `key` has no place here, if it is there; `because` is a sentence about `cause`,
    /// the value that decides, which may be nowhere.
    void refuse(std::string_view key, std::string_view because, SourceSpan cause);
    /// After all keys have been asked for: reports the others.
    void finish();

    [[nodiscard]] bool has(std::string_view key) const {
        return table_ != nullptr && find_entry(*table_, key) != nullptr;
    }
    /// Of the value of `key`, or of the table where it is not there.
    [[nodiscard]] SourceSpan span_of(std::string_view key) const;
    [[nodiscard]] SourceSpan span() const {
        return table_ == nullptr ? SourceSpan{} : table_->span;
    }

private:
    Diagnostic& wrong_kind(const SceneValue& value, std::string_view what, std::string_view wanted);

    const SceneValue* table_;
    std::string name_;
    Diagnostics& diagnostics_;
    std::vector<std::string_view> known_;
};

} // namespace lsys
