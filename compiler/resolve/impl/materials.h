// SPDX-License-Identifier: MIT
// Resolves #material: an index, then keys with their values (docs/language.md section 7.7).
#pragma once

#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/keyed_values.h"
#include "compiler/resolve/impl/resolution.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lsys {

struct MaterialKey;

class MaterialResolver {
public:
    MaterialResolver(Resolution& resolution, ExpressionResolver& expressions)
        : resolution_(resolution), expressions_(expressions) {}

    /// Adds a statement to Program::materials, or reports its mistakes. Only constants before the
    /// statement are visible.
    void material(const MaterialNode& node, SourceSpan statement);

private:
    /// A key of the statement and its values, as written.
    struct Entry {
        const MaterialKey* key = nullptr;
        KeyedValues written;
    };
    [[nodiscard]] std::optional<std::uint32_t> read_index(const SetValue& value);
    void read_entries(const MaterialNode& node, ProgramMaterial& material);
    void report_unknown_key(const KeyedValues& word, const Entry& before);
    void read_entry(const Entry& entry, ProgramMaterial& material);
    [[nodiscard]] std::optional<float> number_of(const Entry& entry, const SetValue& value);
    void read_picture(const Entry& entry, MaterialPictureName& picture);

    Resolution& resolution_;
    ExpressionResolver& expressions_;
    Suggestions suggestions_;
    std::unordered_map<std::uint32_t, SourceSpan> first_; // by colour index: its first statement
};

} // namespace lsys
