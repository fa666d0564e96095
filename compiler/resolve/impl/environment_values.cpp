// SPDX-License-Identifier: MIT
// The values of the keys of #sense.
#include "compiler/resolve/impl/environments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lsys {

void EnvironmentResolver::read_entry(const Entry& entry, ProgramEnvironment& environment) {
    const EnvironmentKey& key = *entry.key;
    BytecodeEnvironment& values = environment.values;
    if (entry.written.values.count != value_count(key, values.kind)) {
        Diagnostic& error = report_value_count(resolution_, DiagnosticCode::BadEnvironment,
                                               entry.written, wanted_text(key, values.kind));
        if (key.may_repeat() && !lacks_value(entry, values.kind)) {
            error.help.push_back(fmt::format("write `{}` before each of them", key.word));
        }
        return;
    }
    const SetValue& first = value(entry, 0);
    switch (key.form) {
    case EnvironmentKeyForm::Number:
        if (const auto number = number_of(entry, first, values.kind)) {
            values.*key.number = *number;
        }
        return;
    case EnvironmentKeyForm::WholeNumber:
        if (const auto number = number_of(entry, first, values.kind)) {
            values.*key.whole = static_cast<std::uint32_t>(*number);
        }
        return;
    case EnvironmentKeyForm::Vector:
        for (std::uint32_t i = 0; i < axes_of(values.kind); ++i) {
            if (const auto number = number_of(entry, value(entry, i), values.kind)) {
                (values.*key.vector)[i] = *number;
            }
        }
        return;
    case EnvironmentKeyForm::Shape:
        read_shape(entry, first, environment);
        return;
    case EnvironmentKeyForm::Plane:
        read_plane(entry, environment);
        return;
    case EnvironmentKeyForm::Meshes:
    case EnvironmentKeyForm::Picture:
        read_file(entry, first, environment);
        return;
    }
}

Diagnostic& EnvironmentResolver::report_wrong_value(const Entry& entry,
                                                    const SetValue& value,
                                                    EnvironmentKind kind) {
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadEnvironment, value.span,
        fmt::format("`{}` takes {}", entry.key->word, wanted_text(*entry.key, kind)));
    error.labels.push_back({entry.written.span, "the key"});
    return error;
}

std::optional<float>
EnvironmentResolver::number_of(const Entry& entry, const SetValue& value, EnvironmentKind kind) {
    const EnvironmentKey& key = *entry.key;
    if (value.is_word || value.is_file) {
        report_wrong_value(entry, value, kind);
        return std::nullopt;
    }
    const ValueId id = expressions_.resolve(value.value, ExpressionPlace::Environment);
    const std::optional<float> number = expressions_.constant_value(id);
    if (id == kPoison || !number) {
        return std::nullopt; // reported
    }
    if (!key.admits(*number)) {
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::BadEnvironment, value.span,
                                        fmt::format("`{}` takes {}; found {}", key.word,
                                                    wanted_text(key, kind), number_text(*number)));
        error.labels.push_back({entry.written.span, "the key"});
        return std::nullopt;
    }
    return number;
}

void EnvironmentResolver::read_shape(const Entry& entry,
                                     const SetValue& value,
                                     ProgramEnvironment& environment) {
    if (value.is_file) {
        environment.values.shape = SpaceShape::Mesh;
        read_file(entry, value, environment);
        return;
    }
    if (!value.is_word) {
        report_wrong_value(entry, value, environment.values.kind);
        return;
    }
    const std::string_view word = resolution_.text(value.word);
    if (const auto shape = find_space_shape(word)) {
        environment.values.shape = *shape;
        return;
    }
    Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::BadEnvironment, value.span,
                                                    fmt::format("there is no shape `{}`", word));
    const std::string nearest = suggestions_.nearest(word, space_shape_names());
    if (!nearest.empty()) {
        suggest(error, value.span, nearest);
    }
    error.notes.emplace_back("the shapes are `box`, `ball`, `dome`, `cone` and mesh files in "
                             "quotes");
}

void EnvironmentResolver::read_plane(const Entry& entry, ProgramEnvironment& environment) {
    EnvironmentSurface surface;
    for (std::uint32_t i = 0; i < surface.plane.size(); ++i) {
        const auto number = number_of(entry, value(entry, i), environment.values.kind);
        if (!number) {
            return;
        }
        surface.plane[i] = *number;
    }
    if (surface.plane[0] == 0.0F && surface.plane[1] == 0.0F && surface.plane[2] == 0.0F) {
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::BadEnvironment, entry.written.span,
                                        "a plane whose a, b and c are 0 has no direction");
        error.help.emplace_back("the ground is `plane 0 1 0 0`: a x + b y + c z + d = 0, solid "
                                "where it is negative");
        return;
    }
    // Planes come before files.
    BytecodeEnvironment& values = environment.values;
    const auto at = std::find_if(values.surfaces.begin(), values.surfaces.end(),
                                 [](const EnvironmentSurface& each) { return !each.path.empty(); });
    environment.surface_spans.insert(
        environment.surface_spans.begin() + (at - values.surfaces.begin()), entry.written.span);
    values.surfaces.insert(at, surface);
}

void EnvironmentResolver::read_file(const Entry& entry,
                                    const SetValue& value,
                                    ProgramEnvironment& environment) {
    if (!value.is_file) {
        Diagnostic& error = report_wrong_value(entry, value, environment.values.kind);
        if (value.is_word) {
            add_fix(error, "put the name in quotes", value.span,
                    fmt::format("\"{}\"", resolution_.text(value.word)), false);
        }
        return;
    }
    if (resolution_.text(value.word).empty()) {
        resolution_.diagnostics.add(DiagnosticCode::BadEnvironment, value.span,
                                    "a file without a name");
        return;
    }
    environment.values.surfaces.push_back({path_from_root(resolution_, value), {}});
    environment.surface_spans.push_back(value.span);
}

} // namespace lsys
