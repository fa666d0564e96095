// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/materials.h"

#include "compiler/resolve/impl/definitions.h"
#include "compiler/resolve/known_words.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

namespace lsys {

struct MaterialKey {
    enum class Kind : std::uint8_t { Colour, Picture, Normal, Roughness, Translucency, TwoSided };
    std::string_view name;
    Kind kind;
    std::uint32_t count; // number of values
    const char* wanted;  // text after "takes "
};

namespace {

using KeyKind = MaterialKey::Kind;
constexpr auto kMaxIndex = static_cast<float>(kMaxColourIndex);

/// The keys, in the order in which messages list them. `color`, a synonym of `colour`, is last and
/// not listed.
constexpr std::array<MaterialKey, 7> kMaterialKeys{{
    {"colour", KeyKind::Colour, 3, "three numbers from 0 to 1: red, green and blue"},
    {"picture", KeyKind::Picture, 1, "a file name in quotes"},
    {"normal", KeyKind::Normal, 1, "a file name in quotes"},
    {"roughness", KeyKind::Roughness, 1, "a number from 0 to 1"},
    {"translucency", KeyKind::Translucency, 1, "a number from 0 to 1"},
    {"two_sided", KeyKind::TwoSided, 1, "0 or 1"},
    {"color", KeyKind::Colour, 3, "three numbers from 0 to 1: red, green and blue"},
}};

constexpr std::size_t kListedKeys = 6; // without `color`

} // namespace

std::vector<std::string_view> material_keys() {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < kListedKeys; ++i) {
        names.emplace_back(kMaterialKeys[i].name);
    }
    return names;
}

void MaterialResolver::material(const MaterialNode& node, SourceSpan statement) {
    expressions_.begin_statement();
    const auto is_number = [&](const SetValue& value) { return !value.is_word && !value.is_file; };
    if (node.values.count == 0 || !is_number(resolution_.ast.set_values[node.values.first])) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadMaterial,
            node.values.count == 0 ? statement : resolution_.ast.set_values[node.values.first].span,
            "`#material` begins with the index of a colour");
        error.help.emplace_back("for example `#material 3 colour 0.4 0.3 0.2;`; a constant stands "
                                "in parentheses: `#material (bark) ...`");
        return;
    }
    const SetValue first_value = resolution_.ast.set_values[node.values.first];
    const std::optional<std::uint32_t> index = read_index(first_value);
    ProgramMaterial material;
    material.span = first_value.span;
    read_entries(node, material);
    if (!index) {
        return;
    }
    material.index = *index;
    const auto [first, is_new] = first_.try_emplace(*index, first_value.span);
    if (!is_new) {
        report_duplicate(resolution_, first_value.span, first->second,
                         fmt::format("material of index {}", *index));
        return;
    }
    resolution_.program.materials.push_back(std::move(material));
}

std::optional<std::uint32_t> MaterialResolver::read_index(const SetValue& value) {
    const std::optional<float> number =
        expressions_.constant_value(expressions_.resolve(value.value, ExpressionPlace::Material));
    if (!number || std::isnan(*number)) {
        return std::nullopt; // an error has been reported
    }
    if (!(*number >= 0.0F && *number <= kMaxIndex) || *number != std::floor(*number)) {
        resolution_.diagnostics.add(
            DiagnosticCode::BadMaterial, value.span,
            fmt::format("the index of a colour is a whole number from 0 to 65,535, not {}",
                        number_text(*number)));
        return std::nullopt;
    }
    return static_cast<std::uint32_t>(*number);
}

void MaterialResolver::read_entries(const MaterialNode& node, ProgramMaterial& material) {
    const ListRange range{node.values.first + 1, node.values.count - 1};
    if (range.count == 0) {
        Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::BadMaterial, material.span,
                                                        "a material without any key");
        error.help.emplace_back("for example `#material 3 colour 0.4 0.3 0.2;`");
        return;
    }
    if (const SetValue first = resolution_.ast.set_values[range.first]; !first.is_word) {
        resolution_.diagnostics
            .add(DiagnosticCode::BadMaterial, first.span,
                 "a key comes after the index, not a value")
            .help.emplace_back("for example `#material 3 colour 0.4 0.3 0.2;`");
        return;
    }
    std::vector<Entry> entries;
    std::array<SourceSpan, kListedKeys>
        first_of; // place per KeyKind; kNoFile until the key is read
    const auto never = [](const SetValue&, const KeyedValues&) { return false; };
    for (const KeyedValues& written : split_keyed_values(resolution_.ast, range, never)) {
        const std::string_view name = resolution_.text(written.key);
        const MaterialKey* key = nullptr;
        for (const MaterialKey& each : kMaterialKeys) {
            key = each.name == name ? &each : key;
        }
        if (key == nullptr) {
            report_unknown_key(written, entries.empty() ? Entry{} : entries.back());
            if (!entries.empty() &&
                entries.back().written.values.count < entries.back().key->count) {
                entries.pop_back(); // the unknown word may be the value of this key
            }
            continue;
        }
        SourceSpan& first = first_of[static_cast<std::size_t>(key->kind)];
        if (first.file != kNoFile) {
            report_duplicate(resolution_, written.span, first,
                             fmt::format("`{}` of one material", name));
            continue;
        }
        first = written.span;
        entries.push_back({key, written});
    }
    for (const Entry& entry : entries) {
        read_entry(entry, material);
    }
}

void MaterialResolver::report_unknown_key(const KeyedValues& word, const Entry& before) {
    const std::string_view name = resolution_.text(word.key);
    const bool lacks_value =
        before.key != nullptr && before.written.values.count < before.key->count;
    if (lacks_value && expressions_.is_constant(word.key)) {
        report_bare_constant(resolution_, DiagnosticCode::BadMaterial, {word.span, true, word.key});
        return;
    }
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::UnknownKey, word.span, fmt::format("a material has no key `{}`", name));
    std::vector<std::string_view> keys;
    for (const MaterialKey& key : kMaterialKeys) {
        keys.push_back(key.name);
    }
    const std::string nearest = suggestions_.nearest(name, keys);
    if (!nearest.empty()) {
        suggest(error, word.span, nearest);
        return;
    }
    keys.resize(kListedKeys);
    error.help.push_back(fmt::format("the keys are `{}`", fmt::join(keys, "`, `")));
}

void MaterialResolver::read_entry(const Entry& entry, ProgramMaterial& material) {
    const MaterialKey& key = *entry.key;
    if (entry.written.values.count != key.count) {
        report_value_count(resolution_, DiagnosticCode::BadMaterial, entry.written, key.wanted);
        return;
    }
    const SetValue first = resolution_.ast.set_values[entry.written.values.first];
    switch (key.kind) {
    case KeyKind::Colour: {
        std::array<float, 3> colour{};
        for (std::uint32_t i = 0; i < colour.size(); ++i) {
            const std::optional<float> part =
                number_of(entry, resolution_.ast.set_values[entry.written.values.first + i]);
            if (!part) {
                return; // an error has been reported
            }
            colour[i] = *part;
        }
        material.colour = colour;
        return;
    }
    case KeyKind::Picture:
        read_picture(entry, material.picture);
        return;
    case KeyKind::Normal:
        read_picture(entry, material.normal);
        return;
    case KeyKind::Roughness:
        material.roughness = number_of(entry, first);
        return;
    case KeyKind::Translucency:
        material.translucency = number_of(entry, first);
        return;
    case KeyKind::TwoSided:
        if (const std::optional<float> number = number_of(entry, first)) {
            material.two_sided = *number != 0.0F;
        }
        return;
    }
}

/// A number from 0 to 1; for `two_sided` exactly 0 or 1.
std::optional<float> MaterialResolver::number_of(const Entry& entry, const SetValue& value) {
    const MaterialKey& key = *entry.key;
    if (value.is_file) {
        resolution_.diagnostics.add(DiagnosticCode::BadMaterial, value.span,
                                    fmt::format("`{}` takes {}", key.name, key.wanted));
        return std::nullopt;
    }
    const std::optional<float> number =
        expressions_.constant_value(expressions_.resolve(value.value, ExpressionPlace::Material));
    if (!number || std::isnan(*number)) {
        return std::nullopt; // an error has been reported
    }
    const bool is_switch = key.kind == KeyKind::TwoSided;
    if (!(*number >= 0.0F && *number <= 1.0F) ||
        (is_switch && *number != 0.0F && *number != 1.0F)) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadMaterial, value.span,
            fmt::format("`{}` takes {}; found {}", key.name, key.wanted, number_text(*number)));
        error.labels.push_back({entry.written.span, "the key"});
        if (key.kind == KeyKind::Colour && *number >= 2.0F && *number <= 255.0F) {
            error.help.push_back(fmt::format("for components from 0 to 255, write `({} / 255)`",
                                             number_text(*number)));
        }
        return std::nullopt;
    }
    return number;
}

void MaterialResolver::read_picture(const Entry& entry, MaterialPictureName& picture) {
    const SetValue file = resolution_.ast.set_values[entry.written.values.first];
    if (!file.is_file || resolution_.text(file.word).empty()) {
        resolution_.diagnostics.add(
            DiagnosticCode::BadMaterial, file.span,
            file.is_file ? "a file without a name"
                         : fmt::format("`{}` takes {}", entry.key->name, entry.key->wanted));
        return;
    }
    picture = {path_from_root(resolution_, file), file.span};
}

} // namespace lsys
