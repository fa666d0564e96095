// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_film.h"

#include "runtime/export/impl/gltf_parts.h"

#include <fmt/format.h>

#include <span>

namespace lsys {

namespace {

/// A frame at which a shape appears or disappears.
struct Switch {
    std::uint32_t frame = 0;
    bool shown = false;
};

/// Switches of a shape in ascending order of frames, from frame 0 on; none if the film has one
/// shape only.
std::vector<Switch> switches_of(const MeshFilm& film, std::uint32_t number) {
    std::vector<Switch> switches;
    if (film.shapes.size() == 1) {
        return switches;
    }
    const MeshFilm::Shape& shape = film.shapes[number];
    if (shape.first_frame > 0) {
        switches.push_back({0, false});
    }
    switches.push_back({shape.first_frame, true});
    if (number + 1 < film.shapes.size()) {
        switches.push_back({film.shapes[number + 1].first_frame, false});
    }
    return switches;
}

float time_of(const MeshFilm& film, std::uint32_t frame) {
    return static_cast<float>(static_cast<double>(frame) /
                              static_cast<double>(film.frames_per_second));
}

std::uint64_t weight_count(const MeshFilm::Shape& shape) {
    return std::uint64_t{shape.frame_count()} * shape.earlier.size();
}

/// Part of an array of the animation.
struct Slice {
    std::size_t view = 0;    // number of the buffer view
    std::uint64_t first = 0; // items [first, first + count) of the view
    std::uint64_t count = 0;
};

void put_times(JsonWriter& json,
               const MeshFilm& film,
               const Slice& times,
               std::uint32_t first,
               std::uint32_t last) {
    begin_accessor(json,
                   {times.view, times.first * sizeof(float), kGltfFloat, times.count, "SCALAR"})
        .member("min", {static_cast<double>(time_of(film, first))})
        .member("max", {static_cast<double>(time_of(film, last))})
        .end();
}

} // namespace

std::vector<std::uint32_t> drawn_shapes(const MeshFilm& film) {
    std::vector<std::uint32_t> shapes;
    for (std::uint32_t i = 0; i < film.shapes.size(); ++i) {
        if (film.shapes[i].part_count > 0) {
            shapes.push_back(i);
        }
    }
    return shapes;
}

GltfFilmCounts count_film_items(const MeshFilm& film) {
    GltfFilmCounts counts;
    for (const std::uint32_t i : drawn_shapes(film)) {
        counts.scales += switches_of(film, i).size();
        counts.weights += weight_count(film.shapes[i]);
    }
    if (counts.scales + counts.weights > 0) {
        counts.times = film.frame_count() + counts.scales;
    }
    return counts;
}

void write_film_times(const MeshFilm& film, const GltfBytes& write) {
    std::vector<float> times;
    for (std::uint32_t frame = 0; frame < film.frame_count(); ++frame) {
        times.push_back(time_of(film, frame));
    }
    for (const std::uint32_t i : drawn_shapes(film)) {
        for (const Switch& each : switches_of(film, i)) {
            times.push_back(time_of(film, each.frame));
        }
    }
    write(std::as_bytes(std::span<const float>(times)));
}

void write_film_scales(const MeshFilm& film, const GltfBytes& write) {
    std::vector<glm::vec3> scales;
    for (const std::uint32_t i : drawn_shapes(film)) {
        for (const Switch& each : switches_of(film, i)) {
            scales.emplace_back(each.shown ? 1.0F : 0.0F);
        }
    }
    write(std::as_bytes(std::span<const glm::vec3>(scales)));
}

void write_film_weights(const MeshFilm& film, const GltfBytes& write) {
    std::vector<float> weights;
    for (const std::uint32_t i : drawn_shapes(film)) {
        const MeshFilm::Shape& shape = film.shapes[i];
        for (std::uint32_t frame = 0; frame < shape.frame_count(); ++frame) {
            weights.assign(shape.earlier.size(), 0.0F);
            if (frame < weights.size()) {
                weights[frame] = 1.0F;
            }
            write(std::as_bytes(std::span<const float>(weights)));
        }
    }
}

void put_film_nodes(JsonWriter& json, const MeshFilm& film) {
    std::size_t mesh = 0;
    for (const std::uint32_t i : drawn_shapes(film)) {
        const MeshFilm::Shape& shape = film.shapes[i];
        const std::uint32_t last = shape.first_frame + shape.frame_count();
        json.object().member("name", fmt::format("frames {} to {}", shape.first_frame + 1, last));
        json.member("mesh", mesh++);
        if (i + 1 < film.shapes.size()) {
            json.member("scale", {0, 0, 0});
        }
        json.end();
    }
}

void put_film_accessors(JsonWriter& json, const MeshFilm& film, std::size_t first_view) {
    const std::size_t scales = first_view + 1;
    const std::size_t weights = scales + (count_film_items(film).scales > 0 ? 1 : 0);
    std::uint64_t next_scale = 0;
    std::uint64_t next_weight = 0;
    for (const std::uint32_t i : drawn_shapes(film)) {
        const MeshFilm::Shape& shape = film.shapes[i];
        if (const std::vector<Switch> switches = switches_of(film, i); !switches.empty()) {
            const std::size_t count = switches.size();
            put_times(json, film, {first_view, film.frame_count() + next_scale, count},
                      switches.front().frame, switches.back().frame);
            begin_accessor(json,
                           {scales, next_scale * sizeof(glm::vec3), kGltfFloat, count, "VEC3"})
                .end();
            next_scale += count;
        }
        if (const std::uint64_t count = weight_count(shape); count > 0) {
            put_times(json, film, {first_view, shape.first_frame, shape.frame_count()},
                      shape.first_frame, shape.first_frame + shape.frame_count() - 1);
            begin_accessor(json,
                           {weights, next_weight * sizeof(float), kGltfFloat, count, "SCALAR"})
                .end();
            next_weight += count;
        }
    }
}

void put_film_animation(JsonWriter& json,
                        const MeshFilm& film,
                        std::size_t first_node,
                        std::size_t accessor) {
    struct Channel {
        std::size_t node;
        const char* path;
        const char* interpolation;
    };
    std::vector<Channel> channels; // in the order of accessors
    std::size_t node = first_node;
    for (const std::uint32_t i : drawn_shapes(film)) {
        if (!switches_of(film, i).empty()) {
            channels.push_back({node, "scale", "STEP"});
        }
        if (weight_count(film.shapes[i]) > 0) {
            channels.push_back({node, "weights", "LINEAR"});
        }
        ++node;
    }
    if (channels.empty()) { // glTF forbids animations without channels
        return;
    }
    json.array("animations").object().member("name", "growth").array("channels");
    for (std::size_t i = 0; i < channels.size(); ++i) {
        json.object().member("sampler", i).object("target");
        json.member("node", channels[i].node).member("path", channels[i].path).end().end();
    }
    json.end().array("samplers");
    for (std::size_t i = 0; i < channels.size(); ++i) {
        json.object().member("input", accessor + 2 * i).member("output", accessor + 2 * i + 1);
        json.member("interpolation", channels[i].interpolation).end();
    }
    json.end().end().end();
}

} // namespace lsys
