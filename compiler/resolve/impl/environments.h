// SPDX-License-Identifier: MIT
// Resolves #sense: a name, a kind, then keys with their values; and the names of sense modules
// (docs/language.md section 13).
#pragma once

#include "compiler/bytecode/environment_keys.h"
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/keyed_values.h"
#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/symbols.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lsys {

class EnvironmentResolver {
public:
    EnvironmentResolver(Resolution& resolution,
                        ExpressionResolver& expressions,
                        SymbolTable& symbols)
        : resolution_(resolution), expressions_(expressions), symbols_(symbols) {}

    /// Adds the names of all #sense to the SymbolTable. Call before any symbol is made. `#sense`
    /// may follow the modules that ask it.
    void declare_all();
    /// Reads the keys of statement Ast::senses[index]; only constants before it are visible.
    void environment(std::uint32_t index);
    /// Returns false after reporting a sense module that no #sense declares; true for other
    /// modules.
    [[nodiscard]] bool check_name(NameId module, SourceSpan span);

private:
    /// A key of the statement and its values, as written.
    struct Entry {
        const EnvironmentKey* key = nullptr;
        KeyedValues written;
    };
    /// Facts of the statement that is being read.
    struct Reading {
        EnvironmentKind kind{};
        SourceSpan kind_span;
        bool is_complete = true; // no key is unknown; an unknown one may be a misspelt required key
        std::vector<Entry> entries;
    };
    /// Returns false after reporting a name that the turtle or another #sense has, or, under `#set
    /// names letters`, a name that is not one letter.
    [[nodiscard]] bool check_free_name(const SenseNode& node);
    [[nodiscard]] std::optional<EnvironmentKind> read_kind(const SenseNode& node);
    void report_unknown_kind(const SetValue& value, SourceSpan name);
    [[nodiscard]] Reading read_entries(const SenseNode& node, EnvironmentKind kind);
    void report_unknown_key(const KeyedValues& word, EnvironmentKind kind);
    /// Whether the entry has fewer values than its key takes.
    [[nodiscard]] bool lacks_value(const Entry& entry, EnvironmentKind kind) const;
    void read_entry(const Entry& entry, ProgramEnvironment& environment);
    void read_shape(const Entry& entry, const SetValue& value, ProgramEnvironment& environment);
    void read_plane(const Entry& entry, ProgramEnvironment& environment);
    void read_file(const Entry& entry, const SetValue& value, ProgramEnvironment& environment);
    [[nodiscard]] std::optional<float>
    number_of(const Entry& entry, const SetValue& value, EnvironmentKind kind);
    void check_missing_keys(const Reading& reading, const ProgramEnvironment& environment);
    /// Reports a value that the key does not take.
    Diagnostic& report_wrong_value(const Entry& entry, const SetValue& value, EnvironmentKind kind);
    [[nodiscard]] const SetValue& value(const Entry& entry, std::uint32_t index) const {
        return resolution_.ast.set_values[entry.written.values.first + index];
    }

    Resolution& resolution_;
    ExpressionResolver& expressions_;
    SymbolTable& symbols_;
    Suggestions suggestions_;
    std::unordered_map<NameId, SourceSpan> first_; // by name: place in its first #sense
    /// Index in Program::environments, by index in Ast::senses.
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
    /// Names, with `?`, of the sense modules that need no further report: they are declared, or
    /// reported. All values are true.
    std::unordered_map<NameId, bool> declared_;
};

} // namespace lsys
