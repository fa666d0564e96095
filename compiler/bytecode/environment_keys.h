// SPDX-License-Identifier: MIT
// The keys of `#sense`: one table, from which the resolver, the dumps, messages, the language
// server and its documents are made (docs/language.md section 13).
#pragma once

#include "compiler/bytecode/environment.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lsys {

/// The kind of value after a key.
enum class EnvironmentKeyForm : std::uint8_t {
    Number,
    WholeNumber,
    Vector, // x y z, or x z in an environment of kind Map
    Shape,  // a SpaceShape or a mesh file
    Plane,  // a b c d; the key may occur several times
    Meshes, // a file; the key may occur several times
    Picture // a file
};

struct EnvironmentKey {
    std::string_view word;
    std::uint32_t kinds = 0; // bits of the kinds that have the key
    /// Bits of the kinds that need the key. A space whose shape is a mesh does not need `size`.
    std::uint32_t required_kinds = 0;
    EnvironmentKeyForm form{};
    // The range of a number, or of each part of a vector.
    float min = 0.0F;
    float max = 0.0F;
    bool above_min = false;  // `min` itself is not allowed
    std::string_view wanted; // completes "`cell` takes ..."; Vector: see wanted_text()
    std::string_view meaning;
    // The field for the value: one of these is set; none for Shape, Plane, Meshes and Picture.
    float BytecodeEnvironment::*number = nullptr;
    std::uint32_t BytecodeEnvironment::*whole = nullptr;
    std::array<float, 3> BytecodeEnvironment::*vector = nullptr;

    [[nodiscard]] bool belongs_to(EnvironmentKind kind) const {
        return (kinds >> static_cast<std::uint32_t>(kind) & 1U) != 0;
    }
    [[nodiscard]] bool is_required_by(EnvironmentKind kind) const {
        return (required_kinds >> static_cast<std::uint32_t>(kind) & 1U) != 0;
    }
    [[nodiscard]] bool may_repeat() const {
        return form == EnvironmentKeyForm::Plane || form == EnvironmentKeyForm::Meshes;
    }
    /// Whether the value is in the range of the key.
    [[nodiscard]] bool admits(float value) const;
};

/// All keys, in the order in which messages list them.
[[nodiscard]] std::span<const EnvironmentKey> environment_keys();
/// The row of a word; nullptr if no kind has such a key.
[[nodiscard]] const EnvironmentKey* find_environment_key(std::string_view word);
/// The keys of a kind.
[[nodiscard]] std::vector<std::string_view> environment_keys_of(EnvironmentKind kind);
/// A description of the kind and its answer, for hovers and documents.
[[nodiscard]] std::string_view meaning_of(EnvironmentKind kind);
/// Names of the numbers in an answer of this kind, such as "(q, x, y, z)".
[[nodiscard]] std::string_view answer_text(EnvironmentKind kind);
[[nodiscard]] std::optional<EnvironmentKind> find_environment_kind(std::string_view word);
/// The words of the kinds, in their order.
[[nodiscard]] std::vector<std::string_view> environment_kind_names();

/// Number of components of a value of the form Vector: x z for Map, else x y z.
[[nodiscard]] constexpr std::uint32_t axes_of(EnvironmentKind kind) {
    return kind == EnvironmentKind::Map ? 2 : 3;
}
/// Number of values after one occurrence of a key.
[[nodiscard]] constexpr std::uint32_t value_count(const EnvironmentKey& key, EnvironmentKind kind) {
    return key.form == EnvironmentKeyForm::Vector  ? axes_of(kind)
           : key.form == EnvironmentKeyForm::Plane ? 4
                                                   : 1;
}
/// Completes "`size` takes ..." for a kind.
[[nodiscard]] std::string wanted_text(const EnvironmentKey& key, EnvironmentKind kind);

/// Names of the sense modules that ask the turtle, without `?`, in the order of Sense.
inline constexpr std::string_view kTurtleSenses = "PHURL";
/// Whether `module` is `?P`, `?H`, `?U`, `?R` or `?L`.
[[nodiscard]] constexpr bool is_turtle_sense(std::string_view module) {
    return module.size() == 2 && module[0] == '?' &&
           kTurtleSenses.find(module[1]) != std::string_view::npos;
}

/// The words of the shapes that are no mesh.
[[nodiscard]] std::vector<std::string_view> space_shape_names();
/// The word of a shape; Mesh has none.
[[nodiscard]] std::string_view name_of(SpaceShape shape);
[[nodiscard]] std::optional<SpaceShape> find_space_shape(std::string_view word);

/// The kind and all its keys with their values, as a statement gives them.
[[nodiscard]] std::string environment_text(const BytecodeEnvironment& environment);
/// The default of a key as text; empty if it has none.
[[nodiscard]] std::string default_text(const EnvironmentKey& key);

} // namespace lsys
