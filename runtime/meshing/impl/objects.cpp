// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/objects.h"

#include "grammar/base/characters.h"
#include "runtime/base/workers.h"
#include "runtime/meshing/impl/droop.h"
#include "runtime/meshing/impl/groups.h"
#include "runtime/meshing/shapes.h"
#include "runtime/turtle/surface_name.h"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <string>

namespace lsys {

namespace {

constexpr std::uint64_t kVerticesPerPiece = 1U << 15;

constexpr unsigned kColourBits = 25;
static_assert(kTurtleOperationCount < 1U << 7); // a kind has 7 bits in key_of()

/// Kind, file and colour, packed into one number that orders the parts; kNoGroup: not drawn.
std::uint64_t key_of(const PlacedObject& object, std::size_t file_count) {
    if (object.size == 0.0F ||
        (object.kind == TurtleOperation::MeshFile && object.mesh_file >= file_count)) {
        return kNoGroup;
    }
    const std::uint64_t file = object.kind == TurtleOperation::MeshFile ? object.mesh_file : 0;
    return std::uint64_t{static_cast<std::uint8_t>(object.kind)} << 57 | file << kColourBits |
           object.colour;
}

bool shows_pictures(const UserMesh& mesh) {
    return (mesh.picture != nullptr || mesh.normal_map != nullptr) &&
           !mesh.texture_coordinates.empty();
}

/// Writes one part of a shape for each of many objects.
struct Instances {
    const Skeleton& skeleton;
    std::span<const std::uint32_t> items; // objects
    const ShapePart& part;
    ItemColour palette;
    float droop;
    MeshBlock block;

    /// Writes the objects items[first] to items[end - 1].
    void write(std::uint64_t first, std::uint64_t end) const;

private:
    void write_indices(std::uint64_t item, bool mirrored) const;
};

void Instances::write_indices(std::uint64_t item, bool mirrored) const {
    const std::size_t count = part.indices.size();
    const auto base = static_cast<std::uint32_t>(block.first_vertex + item * part.positions.size());
    std::uint32_t* const out = block.indices.data() + item * count;
    if (!mirrored) {
        for (std::size_t i = 0; i < count; ++i) {
            out[i] = base + part.indices[i];
        }
        return;
    }
    for (std::size_t i = 0; i < count; i += 3) {
        out[i] = base + part.indices[i];
        out[i + 1] = base + part.indices[i + 2];
        out[i + 2] = base + part.indices[i + 1];
    }
}

void Instances::write(std::uint64_t first, std::uint64_t end) const {
    const std::size_t count = part.positions.size();
    std::optional<Droop> bending;
    ShapePart bent;
    if (droop > 0.0F) {
        bending.emplace(part);
        bent = part;
    }
    const ShapePart& source = droop > 0.0F ? bent : part;
    for (std::uint64_t item = first; item < end; ++item) {
        const PlacedObject& object = skeleton.objects[items[item]];
        if (bending) {
            bending->bend(part, object.frame, droop, bent);
        }
        // A negative size turns an object inside out: reverse its normals and triangles.
        const bool mirrored = object.size < 0.0F;
        const glm::mat3 turn = glm::mat3_cast(object.frame);
        const glm::mat3 turn_and_scale = object.size * turn;
        const std::uint64_t at = item * count;
        for (std::size_t i = 0; i < count; ++i) {
            block.positions[at + i] = object.position + turn_and_scale * source.positions[i];
            const glm::vec3 normal = turn * source.normals[i];
            block.normals[at + i] = mirrored ? -normal : normal;
        }
        if (!block.texture_coordinates.empty()) {
            std::copy(source.texture_coordinates.begin(), source.texture_coordinates.end(),
                      block.texture_coordinates.begin() + static_cast<std::ptrdiff_t>(at));
        }
        if (!block.tangents.empty()) {
            for (std::size_t i = 0; i < count; ++i) {
                const glm::vec3 tangent = turn * glm::vec3(source.tangents[i]);
                block.tangents[at + i] = mirrored ? glm::vec4(-tangent, -source.tangents[i].w)
                                                  : glm::vec4(tangent, source.tangents[i].w);
            }
        }
        if (!block.colours.empty()) {
            std::fill_n(block.colours.begin() + static_cast<std::ptrdiff_t>(at), count, palette);
        }
        if (!block.segments.empty()) {
            std::fill_n(block.segments.begin() + static_cast<std::ptrdiff_t>(at), count,
                        VertexSegments{object.parent, object.parent});
        }
        write_indices(item, mirrored);
    }
}

void write_all(Workers& workers, const Instances& instances) {
    const std::uint64_t count = instances.items.size();
    const std::uint64_t size =
        std::max<std::uint64_t>(1, kVerticesPerPiece / instances.part.positions.size());
    workers.for_each((count + size - 1) / size, [&](std::uint64_t piece) {
        instances.write(piece * size, std::min(count, (piece + 1) * size));
    });
}

/// The file name without folder and extension, with characters that every format accepts.
std::string stem_of(const std::string& path) {
    const std::size_t slash = path.find_last_of("/\\");
    std::string stem = path.substr(slash == std::string::npos ? 0 : slash + 1);
    stem.erase(std::min(stem.find_last_of('.'), stem.size()));
    for (char& c : stem) {
        const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
        if (is_ascii && !is_letter(c) && !is_digit(c) && c != '-') {
            c = c == ' ' ? ' ' : '_';
        }
    }
    return stem;
}

std::string small_letters(std::string text) {
    for (char& c : text) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return text;
}

} // namespace

std::vector<std::string> object_file_names(const std::vector<std::string>& files) {
    // Names of the built-in materials, and of the pictures that are written beside a mesh file.
    std::set<std::string> taken{"", "bark", "bark normals", "leaf", "polygon", "impostor"};
    std::vector<std::string> names;
    for (const std::string& file : files) {
        const std::string stem = stem_of(path_of_object(file));
        std::string name = stem;
        for (int number = 1; !taken.insert(small_letters(name)).second; ++number) {
            name = fmt::format("{}{}file{}", stem, stem.empty() ? "" : " ",
                               number == 1 ? "" : fmt::format(" {}", number));
        }
        names.push_back(name);
    }
    return names;
}

void append_objects(const Skeleton& skeleton,
                    const std::vector<UserMesh>& user_meshes,
                    const MeshOptions& options,
                    MeshBuilder& builder) {
    // append_l3d_shapes() draws leaves, together with the segments.
    const auto is_drawn = [&](const PlacedObject& object) {
        return !(skeleton.l3d_compatible_surface && options.method == MeshMethod::Tubes &&
                 object.kind == TurtleOperation::Leaf);
    };
    const Groups groups = group_items(skeleton.objects.size(), [&](std::uint64_t i) {
        return is_drawn(skeleton.objects[i]) ? key_of(skeleton.objects[i], user_meshes.size())
                                             : kNoGroup;
    });
    Workers workers(options.threads);
    const float droop = options.droop.value_or(skeleton.leaf_droop);
    Shape shape;
    std::uint64_t shape_key = kNoGroup;
    std::string word;
    std::vector<std::string> names = object_file_names(skeleton.mesh_files);
    names.resize(user_meshes.size());
    for (const Group& group : groups.groups) {
        const std::span<const std::uint32_t> items =
            std::span(groups.items).subspan(group.first, group.count);
        if (group.key >> kColourBits != shape_key) {
            shape_key = group.key >> kColourBits;
            const PlacedObject& object = skeleton.objects[items.front()];
            shape = object.kind == TurtleOperation::MeshFile
                        ? make_shape(user_meshes[object.mesh_file])
                        : make_shape(object.kind, options.level);
            word = object.kind == TurtleOperation::MeshFile ? names[object.mesh_file]
                                                            : std::string(name_of(object.kind));
            for (ShapePart& part : shape.parts) {
                if (object.kind == TurtleOperation::MeshFile &&
                    shows_pictures(user_meshes[object.mesh_file])) {
                    part.material.picture = static_cast<std::uint16_t>(object.mesh_file + 1);
                }
            }
        }
        const auto colour = static_cast<ItemColour>(group.key & ((1U << kColourBits) - 1U));
        for (const ShapePart& part : shape.parts) {
            if (part.positions.empty()) {
                continue;
            }
            MaterialKey material = part.material;
            if (colour != 0 && part.takes_colour) {
                material.palette = colour;
            }
            MeshBlock block;
            if (!builder.reserve(builder.part(material, word), items.size() * part.positions.size(),
                                 items.size() * part.indices.size(), block)) {
                return;
            }
            write_all(workers, {.skeleton = skeleton,
                                .items = items,
                                .part = part,
                                .palette = material.palette,
                                .droop = shape.droops ? std::min(droop, 1.0F) : 0.0F,
                                .block = block});
        }
    }
}

} // namespace lsys
