// SPDX-License-Identifier: MIT
// The contents of a Bytecode, described once. describe() passes every field to a stream, in the
// order of a .lsb file; the writer and the reader of module_file.cpp, the digest of bytecode.cpp
// and the range checks of verify.cpp are streams.
//
// A stream has these functions, each of which takes a field by reference:
//   number, real, truth, tag (an enumerator), id, text, optional_number, table, codes
//   number_or_none a number that is kNone in most programs; kNone does not change the digest
//   table_or_none  a table that most programs lack; an empty one does not change the digest
//   implied        a truth value computed from a field, for the digest alone: the derived word
//                  depends on it, while the field itself goes to outside_digest()
//   outside_digest() returns the stream for fields that do not affect the derived word: an
//                  IgnoringStream in the digest, otherwise the stream itself
// The settings follow their table, settings.def. Every other struct is taken apart by a structured
// binding, so that a new field does not compile until it has a name here. Pass the field to the
// stream: then it is written, read and digested. Only a field that affects nothing but drawing,
// printing or messages goes to outside_digest(). In both cases the format of .lsb files changes:
// raise kModuleFileVersion.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <type_traits>

namespace lsys {

/// A stream that ignores all fields; others derive from it.
struct IgnoringStream {
    template <typename Value>
    void number(const Value& /*value*/) {}
    template <typename Value>
    void number_or_none(const Value& /*value*/) {}
    void real(const float& /*value*/) {}
    void truth(const bool& /*value*/) {}
    template <typename Enum>
    void tag(const Enum& /*value*/) {}
    template <typename Id>
    void id(const Id& /*value*/) {}
    void text(const std::string& /*value*/) {}
    void optional_number(const std::optional<std::uint32_t>& /*value*/) {}
    template <typename Row, typename Function>
    void table(const std::vector<Row>& /*rows*/, Function /*row*/) {}
    template <typename Row, typename Function>
    void table_or_none(const std::vector<Row>& /*rows*/, Function /*row*/) {}
};

// In the describe functions `Value` is a const type if the stream only reads the fields.

template <typename Stream, typename Value>
void describe_traits(Stream& stream, Value& traits) {
    auto& [leaf_moves, object_moves, object_has_step_scale, forward_has_width, width_is_relative,
           l3d_compatible_surface, box_segments, corners_are_ends, organs_branch, colours_wrap,
           taper, first_turn, first_colour, leaf_droop, organ_tangent] = traits;
    stream.truth(leaf_moves);
    stream.truth(object_moves);
    stream.truth(object_has_step_scale);
    stream.truth(forward_has_width);
    stream.truth(width_is_relative);
    stream.truth(l3d_compatible_surface);
    stream.truth(box_segments);
    stream.truth(corners_are_ends);
    stream.truth(organs_branch);
    stream.truth(colours_wrap);
    stream.real(taper);
    stream.real(first_turn);
    stream.number(first_colour);
    stream.real(leaf_droop);
    stream.real(organ_tangent);
}

template <typename Stream, typename Value>
void describe_value(Stream& stream, Value& value) {
    using Type = std::remove_const_t<Value>;
    if constexpr (std::is_same_v<Type, bool>) {
        stream.truth(value);
    } else if constexpr (std::is_enum_v<Type>) {
        stream.tag(value);
    } else if constexpr (std::is_floating_point_v<Type>) {
        stream.real(value);
    } else if constexpr (std::is_unsigned_v<Type>) {
        stream.number(value);
    } else if constexpr (std::is_same_v<Type, TurtleTraits>) {
        describe_traits(stream, value);
    } else if constexpr (std::is_same_v<Type, Pipe>) {
        auto& [exponent, tip_width, taper] = value;
        stream.real(exponent);
        stream.real(tip_width);
        stream.real(taper);
    } else if constexpr (std::is_same_v<Type, Flare>) {
        auto& [factor, height, roots] = value;
        stream.real(factor);
        stream.real(height);
        stream.number(roots);
    } else if constexpr (std::is_same_v<Type, StepTropism>) {
        auto& [kind, direction, strength, increment, angle] = value;
        stream.tag(kind);
        describe_value(stream, direction);
        stream.real(strength);
        stream.real(increment);
        stream.real(angle);
    } else {
        for (auto& component : value) {
            describe_value(stream, component);
        }
    }
}

template <typename Stream, typename Value>
void describe_settings(Stream& stream, Value& settings) {
    auto&& undigested = stream.outside_digest();
    for_each_setting(settings, [&](const SettingRow& row, auto& value) {
        if (row.effect == SettingEffect::AffectsWord) {
            describe_value(stream, value);
        } else {
            describe_value(undigested, value);
        }
    });
}

template <typename Stream, typename Value>
void describe_range(Stream& stream, Value& range) {
    auto& [first, count] = range;
    stream.number(first);
    stream.number(count);
}

template <typename Stream, typename Value>
void describe_word(Stream& stream, Value& word) {
    auto& [codes, locals, arguments, parameter_count, draw_count] = word;
    describe_range(stream, codes);
    stream.number_or_none(locals);
    stream.number(arguments);
    stream.number(parameter_count);
    stream.number(draw_count);
}

template <typename Stream, typename Value>
void describe_symbol(Stream& stream, Value& symbol) {
    auto& [name, parameter_count, kind, ignored, turtle, mesh_file, sense] = symbol;
    auto&& undigested = stream.outside_digest();
    stream.text(name);
    stream.number(parameter_count);
    stream.tag(kind);
    stream.truth(ignored);
    undigested.tag(turtle);
    stream.implied(turtle == TurtleOperation::Cut);
    undigested.text(mesh_file);
    stream.number_or_none(sense);
}

template <typename Stream, typename Value>
void describe_folded(Stream& stream, Value& folded) {
    auto& [symbol, first_constant] = folded;
    stream.id(symbol);
    stream.number(first_constant);
}

template <typename Stream, typename Value>
void describe_global(Stream& stream, Value& global) {
    auto& [name, instruction, draw_position, draw_count, has_bounds, minimum, maximum, site] =
        global;
    auto&& undigested = stream.outside_digest();
    undigested.text(name);
    stream.number(instruction);
    stream.number(draw_position);
    stream.number(draw_count);
    stream.truth(has_bounds);
    stream.real(minimum);
    stream.real(maximum);
    undigested.number(site);
}

template <typename Stream, typename Value>
void describe_pattern_item(Stream& stream, Value& item) {
    auto& [kind, symbol, first_formal] = item;
    stream.tag(kind);
    stream.id(symbol);
    stream.number(first_formal);
}

template <typename Stream, typename Value>
void describe_site(Stream& stream, Value& site) {
    auto& [span, line, column] = site;
    auto& [file, begin, end] = span;
    stream.id(file);
    stream.number(begin);
    stream.number(end);
    stream.number(line);
    stream.number(column);
}

template <typename Stream, typename Value>
void describe_site_range(Stream& stream, Value& range) {
    auto& [instruction, site] = range;
    stream.number(instruction);
    stream.number(site);
}

template <typename Stream, typename Value>
void describe_place_run(Stream& stream, Value& run) {
    auto& [first, begin, length, stride, line, column] = run;
    stream.number(first);
    stream.number(begin);
    stream.number(length);
    stream.number(stride);
    stream.number(line);
    stream.number(column);
}

template <typename Stream, typename Value>
void describe_production(Stream& stream, Value& production) {
    auto& [name, name_site, rule, group, stage, has_left, has_right, left, predecessor, right,
           formal_count, condition, stochastic, weight, weight_code, successor] = production;
    auto&& undigested = stream.outside_digest();
    undigested.text(name);
    undigested.number(name_site);
    stream.number(rule);
    stream.number(group);
    stream.tag(stage);
    stream.truth(has_left);
    stream.truth(has_right);
    describe_range(stream, left);
    describe_range(stream, predecessor);
    describe_range(stream, right);
    stream.number(formal_count);
    stream.number(condition);
    stream.truth(stochastic);
    stream.real(weight);
    stream.number(weight_code);
    describe_word(stream, successor);
}

/// Omits the slopes, which set_slopes() computes from the points.
template <typename Stream, typename Value>
void describe_curve(Stream& stream, Value& curve) {
    auto& [name, points] = curve;
    auto&& undigested = stream.outside_digest();
    undigested.text(name);
    stream.table(points, [](auto& s, auto& row) {
        s.real(row.x);
        s.real(row.y);
    });
}

template <typename Stream, typename Value>
void describe_contour(Stream& stream, Value& contour) {
    auto& [name, points] = contour;
    stream.text(name);
    stream.table(points, [](auto& s, auto& row) {
        auto& [x, y] = row;
        s.real(x);
        s.real(y);
    });
}

template <typename Stream, typename Value>
void describe_picture(Stream& stream, Value& picture) {
    auto& [path, site] = picture;
    stream.text(path);
    stream.number(site);
}

template <typename Stream, typename Value>
void describe_material(Stream& stream, Value& material) {
    auto& [index, has_colour, colour, picture, normal, has_roughness, roughness, has_translucency,
           translucency, has_sides, two_sided] = material;
    stream.number(index);
    stream.truth(has_colour);
    describe_value(stream, colour);
    describe_picture(stream, picture);
    describe_picture(stream, normal);
    stream.truth(has_roughness);
    stream.real(roughness);
    stream.truth(has_translucency);
    stream.real(translucency);
    stream.truth(has_sides);
    stream.truth(two_sided);
}

/// Two programs whose mesh or picture files differ, but have the same paths, have equal digests.
template <typename Stream, typename Value>
void describe_surface(Stream& stream, Value& surface) {
    auto& [path, plane, site] = surface;
    stream.text(path);
    describe_value(stream, plane);
    stream.outside_digest().number(site);
}

template <typename Stream, typename Value>
void describe_environment(Stream& stream, Value& environment) {
    auto& [name, kind, site, cell, levels, strength, ratio, extinction, directions, shape, size, at,
           count, radius, angle, kill, low, high, surfaces] = environment;
    auto&& undigested = stream.outside_digest();
    stream.text(name);
    stream.tag(kind);
    undigested.number(site);
    stream.real(cell);
    stream.number(levels);
    stream.real(strength);
    stream.real(ratio);
    stream.real(extinction);
    stream.number(directions);
    stream.tag(shape);
    describe_value(stream, size);
    describe_value(stream, at);
    stream.number(count);
    stream.real(radius);
    stream.real(angle);
    stream.real(kill);
    stream.real(low);
    stream.real(high);
    stream.table(surfaces, [](auto& s, auto& row) { describe_surface(s, row); });
}

template <typename Stream, typename Value>
void describe_axiom(Stream& stream, Value& axiom) {
    auto& [word, site, draw_position, weight] = axiom;
    describe_word(stream, word);
    stream.outside_digest().number(site);
    stream.number(draw_position);
    stream.real(weight);
}

template <typename Stream, typename Value>
void describe(Stream& stream, Value& bytecode) {
    auto& [settings, generations, files, symbols, folded, constants, globals, patterns,
           template_codes, instructions, sites, site_ranges, template_places, productions,
           rule_count, context_group_count, axioms, uses_steps, curves, contours, materials,
           environments, stack_depth, local_count] = bytecode;
    auto&& undigested = stream.outside_digest();
    describe_settings(stream, settings);
    undigested.optional_number(generations);
    undigested.table(files, [](auto& s, auto& path) { s.text(path); });
    stream.table(symbols, [](auto& s, auto& row) { describe_symbol(s, row); });
    stream.table(folded, [](auto& s, auto& row) { describe_folded(s, row); });
    stream.table(constants, [](auto& s, auto& value) { s.real(value); });
    stream.table(globals, [](auto& s, auto& row) { describe_global(s, row); });
    stream.table(patterns, [](auto& s, auto& row) { describe_pattern_item(s, row); });
    stream.codes(template_codes,
                 code_width(std::uint64_t{bytecode.symbols.size()} + bytecode.folded.size()));
    stream.table(instructions, [](auto& s, auto& word) { s.number(word); });
    undigested.table(sites, [](auto& s, auto& row) { describe_site(s, row); });
    undigested.table(site_ranges, [](auto& s, auto& row) { describe_site_range(s, row); });
    undigested.table(template_places, [](auto& s, auto& row) { describe_place_run(s, row); });
    stream.table(productions, [](auto& s, auto& row) { describe_production(s, row); });
    stream.number(rule_count);
    stream.number(context_group_count);
    stream.table(axioms, [](auto& s, auto& row) { describe_axiom(s, row); });
    stream.truth(uses_steps);
    stream.table_or_none(curves, [](auto& s, auto& row) { describe_curve(s, row); });
    undigested.table(contours, [](auto& s, auto& row) { describe_contour(s, row); });
    undigested.table(materials, [](auto& s, auto& row) { describe_material(s, row); });
    stream.table_or_none(environments, [](auto& s, auto& row) { describe_environment(s, row); });
    undigested.number(stack_depth);
    undigested.number(local_count);
}

} // namespace lsys
