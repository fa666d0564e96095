// SPDX-License-Identifier: MIT
#include "runtime/pipeline/setting_controls.h"

#include "compiler/bytecode/settings.h"
#include "grammar/base/number_chars.h"
#include "runtime/pipeline/setting_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// Usual values of a setting. Settings whose scale depends on the grammar, such as lengths, have no
/// row.
struct UsualRange {
    std::string_view key;
    float min;
    float max;
};
constexpr std::array<UsualRange, 5> kUsual{{
    {"angle", 0.0F, 180.0F},
    {"angle_scale", 0.0F, 2.0F},
    {"step_scale", 0.0F, 2.0F},
    {"width_scale", 0.0F, 2.0F},
    {"sides", 3.0F, 64.0F},
}};

SettingControl number_control(std::string_view key, SettingKind kind, float value) {
    SettingControl control;
    control.key = key;
    control.kind = kind;
    control.numbers[0] = value;
    for (const UsualRange& usual : kUsual) {
        if (usual.key == key) {
            control.min = std::min(usual.min, value);
            control.max = std::max(usual.max, value);
        }
    }
    return control;
}

template <typename Enum>
SettingControl word_control(std::string_view key, Enum value) {
    SettingControl control;
    control.key = key;
    control.kind = SettingKind::Word;
    control.word = name_of(value);
    for (const Enum each : enumerators_of<Enum>()) {
        control.words.push_back(name_of(each));
    }
    return control;
}

} // namespace

std::vector<SettingControl> setting_controls(const Grammar& grammar) {
    const Settings& settings = grammar.bytecode.settings;
    std::vector<SettingControl> controls;
#define LSYS_NUMBER(field, initial, effect, group, min, wanted)                                    \
    controls.push_back(number_control(#field, SettingKind::Number, settings.field));               \
    controls.back().accepts = wanted;                                                              \
    controls.back().lowest = min;                                                                  \
    controls.back().highest = -kLowestNumber;
#include "compiler/bytecode/settings.def"
    SettingControl& tropism = controls.emplace_back();
    tropism.key = "tropism";
    tropism.accepts = "a direction and a strength: x y z e";
    tropism.kind = SettingKind::Vector;
    tropism.numbers = settings.tropism;
    tropism.lowest = kLowestNumber;
    tropism.highest = -kLowestNumber;
    tropism.min = -1.0F;
    tropism.max = 1.0F;
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    controls.push_back(                                                                            \
        number_control(#field, SettingKind::Count, static_cast<float>(settings.field)));           \
    controls.back().accepts = wanted;                                                              \
    controls.back().lowest = min;                                                                  \
    controls.back().highest = max;
#include "compiler/bytecode/settings.def"
#define LSYS_CHOICE(type, field, initial, effect, group)                                           \
    controls.push_back(word_control(#field, settings.field));
#include "compiler/bytecode/settings.def"
    if (grammar.translation.empty()) {
        SettingControl& names = controls.emplace_back();
        names.key = "names";
        names.kind = SettingKind::Word;
        names.words = {"words", "letters", "characters"};
        names.word = names.words[settings.print_characters ? 2 : settings.print_letters ? 1 : 0];
    }
    if (grammar.is_module_file) {
        std::erase_if(controls,
                      [](const SettingControl& control) { return is_compiled_in(control.key); });
    }
    return controls;
}

std::string setting_text(std::span<const float> numbers) {
    return fmt::format("{}", fmt::join(numbers, " "));
}

std::optional<std::array<float, 4>> numbers_of(std::string_view values, std::size_t count) {
    std::array<float, 4> numbers{};
    const char* at = values.data();
    const char* const end = at + values.size();
    for (std::size_t i = 0; i < count; ++i) {
        while (at != end && *at == ' ') {
            ++at;
        }
        const auto [next, failure] = number_from_chars(at, end, numbers[i]);
        if (failure != std::errc() || !std::isfinite(numbers[i]) || (next != end && *next != ' ')) {
            return std::nullopt;
        }
        at = next;
    }
    return at == end ? std::optional(numbers) : std::nullopt;
}

} // namespace lsys
