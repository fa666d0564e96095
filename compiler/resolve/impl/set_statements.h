// SPDX-License-Identifier: MIT
// Resolves #set: keys and values to Settings. Modes and profiles affect the reading of all other
// statements, so they are read first; numbers may use constants and are read in the order of the
// text.
#pragma once

#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/resolution.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace lsys {

struct Synonym;

class SetResolver {
public:
    /// Origin of the `#set` statements.
    enum class Origin : std::uint8_t {
        Grammar,
        Options, // --set: replaces values of the grammar; `names` applies to the root file
    };
    SetResolver(Resolution& resolution, Origin origin) : resolution_(resolution), origin_(origin) {}

    /// Reads all settings whose value is a word: modes and the profile of the turtle. Reports
    /// unknown keys and duplicates.
    void read_modes();
    /// Reads a setting of one or more numbers; does nothing for other keys and for duplicates.
    void read_number(const SetNode& node, ExpressionResolver& expressions);

private:
    /// The scope in which a key may be set once: the file for `names`, the program for other keys.
    [[nodiscard]] std::uint64_t scope_of(const SetNode& node) const;
    [[nodiscard]] bool check_first_setting(const SetNode& node);
    void read_mode(const SetNode& node, std::string_view key);
    void report_unknown_key(const SetNode& node);
    void
    report_statement_for_key(const SetNode& node, const Synonym& synonym, Diagnostic& error) const;
    /// Explains a tropism that is given by one number.
    void explain_tropism(const SetNode& node, Diagnostic& error) const;
    Diagnostic& report_bad_value(const SetNode& node, SourceSpan span, const std::string& message);
    /// The word that is the only value of the statement; empty after an error is reported.
    [[nodiscard]] std::string_view word_of(const SetNode& node, const char* choices);
    /// Sets `chosen` to the value that the statement names; reports other words.
    template <typename Enum, std::size_t size>
    void choose(const SetNode& node, const std::array<Enum, size>& values, Enum& chosen);
    [[nodiscard]] std::optional<float>
    number_of(const SetNode& node, std::uint32_t index, ExpressionResolver& expressions);
    /// The numbers that are valid for a setting.
    struct NumberRange {
        float min;
        float max;
        bool is_whole;
        const char* wanted; // "an angle in degrees"
    };
    [[nodiscard]] std::optional<float>
    read_one(const SetNode& node, const NumberRange& range, ExpressionResolver& expressions);
    void read_tropism(const SetNode& node, ExpressionResolver& expressions);
    void read_tropisms(const SetNode& node, ExpressionResolver& expressions);
    void read_height(const SetNode& node, ExpressionResolver& expressions);
    void read_pipe(const SetNode& node, ExpressionResolver& expressions);
    void read_flare(const SetNode& node, ExpressionResolver& expressions);
    /// The two or three numbers of a setting, the third one 0 if missing; no value after an error.
    [[nodiscard]] std::optional<std::array<float, 3>>
    read_two_or_three(const SetNode& node, const char* wanted, ExpressionResolver& expressions);
    [[nodiscard]] SourceSpan value_span(const SetNode& node, std::uint32_t index) const;
    void read_spring(const SetNode& node, ExpressionResolver& expressions);
    void read_seed(const SetNode& node, ExpressionResolver& expressions);

    Resolution& resolution_;
    Origin origin_;
    Suggestions suggestions_;
    std::unordered_map<std::uint64_t, SourceSpan> first_; // first statement, by scope_of()
};

} // namespace lsys
