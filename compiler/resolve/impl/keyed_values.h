// SPDX-License-Identifier: MIT
// The keys of #material and #sense statements, with their values.
#pragma once

#include "compiler/resolve/impl/resolution.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A key and the values behind it, as written.
struct KeyedValues {
    NameId key = kNoName;
    SourceSpan span;  // place of the key
    ListRange values; // range of Ast::set_values
};

/// Splits values into keys, each with the values up to the next key. A word is a key, unless
/// is_value(word, key) says that it is a value of the key before it. Drops values before the first
/// key. Precondition: the caller has reported such values.
template <typename IsValue>
[[nodiscard]] std::vector<KeyedValues>
split_keyed_values(const Ast& ast, ListRange range, IsValue is_value) {
    std::vector<KeyedValues> keys;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
        const SetValue& value = ast.set_values[i];
        if (value.is_word && (keys.empty() || !is_value(value, keys.back()))) {
            keys.push_back({value.word, value.span, {i + 1, 0}});
        } else if (!keys.empty()) {
            ++keys.back().values.count;
        }
    }
    return keys;
}

/// Reports a constant without parentheses in the place of a value.
void report_bare_constant(Resolution& resolution, DiagnosticCode code, const SetValue& word);
/// Reports a key with another number of values than `wanted` says; returns the message.
Diagnostic& report_value_count(Resolution& resolution,
                               DiagnosticCode code,
                               const KeyedValues& key,
                               std::string_view wanted);
/// The path of a file relative to the root file. A statement gives it relative to the file that
/// contains the statement.
[[nodiscard]] std::string path_from_root(const Resolution& resolution, const SetValue& file);

} // namespace lsys
