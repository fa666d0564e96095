// SPDX-License-Identifier: MIT
#include "web/binding/impl/mesh_answer.h"

#include "compiler/bytecode/turtle_operation.h"
#include "runtime/meshing/texture.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lsys::web {

namespace {

/// The pictures of a mesh; each is added once.
class Pictures {
public:
    explicit Pictures(Answer& answer) : answer_(answer) {}

    /// The index of a picture of a file.
    Json of_file(const std::shared_ptr<const Texture>& texture) {
        const auto [found, is_new] = files_.try_emplace(texture.get(), list_.size());
        if (is_new) {
            add(*texture, nullptr);
        }
        return found->second;
    }
    /// The index of a computed picture.
    Json computed(const char* id, const Texture& texture) {
        const auto [found, is_new] = computed_.try_emplace(id, list_.size());
        if (is_new) {
            add(texture, id);
        }
        return found->second;
    }
    [[nodiscard]] Json take() { return std::move(list_); }

private:
    void add(const Texture& texture, const char* id) {
        list_.push_back({{"id", id != nullptr ? Json(id) : Json()},
                         {"width", texture.width},
                         {"height", texture.height},
                         {"texels", answer_.add(texture.texels)}});
    }

    Answer& answer_;
    Json list_ = Json::array();
    std::map<const Texture*, std::size_t> files_; // indexes in list_
    std::map<std::string, std::size_t> computed_; // indexes in list_, by `id`
};

/// Computed once, since each takes milliseconds.
const Texture& bark() {
    static const Texture texture = material_texture(MaterialKind::Bark);
    return texture;
}
const Texture& bark_relief() {
    static const Texture texture = bark_normals();
    return texture;
}
const Texture& leaf() {
    static const Texture texture = material_texture(MaterialKind::Leaf);
    return texture;
}

Json material_of(const Material& material, Pictures& pictures) {
    Json picture;
    Json normals;
    const bool is_bark = material.kind == MaterialKind::Bark;
    if (material.picture) {
        picture = pictures.of_file(material.picture);
    } else if (material.textured && has_texture(material.kind)) {
        picture = is_bark ? pictures.computed("bark", bark()) : pictures.computed("leaf", leaf());
    }
    if (material.normal_map) {
        normals = pictures.of_file(material.normal_map);
    } else if (is_bark && material.textured && !material.picture) {
        normals = pictures.computed("bark-normals", bark_relief());
    }
    const glm::vec4& colour = material.colour;
    return {{"name", material.name},
            {"colour", {colour.r, colour.g, colour.b, colour.a}},
            {"roughness", roughness_of(material)},
            {"translucency", material.translucency ? Json(*material.translucency) : Json()},
            {"twoSided", material.two_sided},
            {"cutOut", material.cut_out},
            {"picture", std::move(picture)},
            {"normals", std::move(normals)}};
}

} // namespace

Json add_mesh(Mesh mesh, Answer& answer) {
    Json parts = Json::array();
    for (const MeshPart& part : mesh.parts) {
        parts.push_back({{"material", part.material},
                         {"first", part.first_index},
                         {"count", part.index_count}});
    }
    Pictures pictures(answer);
    Json materials = Json::array();
    for (const Material& material : mesh.materials) {
        materials.push_back(material_of(material, pictures));
    }
    LargeVector<std::uint32_t> indices = mesh.indices.expanded();
    mesh.indices = {};
    return {{"positions", answer.add(std::move(mesh.positions))},
            {"normals", answer.add(std::move(mesh.normals))},
            {"textureCoordinates", answer.add(std::move(mesh.texture_coordinates))},
            {"indices", answer.add(std::move(indices))},
            {"parts", std::move(parts)},
            {"materials", std::move(materials)},
            {"pictures", pictures.take()}};
}

Json add_skeleton(const Skeleton& skeleton, Answer& answer) {
    std::vector<glm::vec3> start;
    std::vector<glm::vec3> end;
    std::vector<float> radii;
    std::vector<std::uint32_t> parent;
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> colour;
    for (const Segment& segment : skeleton.segments) {
        start.push_back(segment.base);
        end.push_back(tip(segment));
        radii.push_back(segment.base_radius);
        radii.push_back(segment.tip_radius);
        parent.push_back(segment.parent);
        order.push_back(segment.order);
        colour.push_back(segment.colour);
    }
    Json segments{
        {"count", skeleton.segments.size()},       {"start", answer.add(std::move(start))},
        {"end", answer.add(std::move(end))},       {"radii", answer.add(std::move(radii))},
        {"parent", answer.add(std::move(parent))}, {"order", answer.add(std::move(order))},
        {"colour", answer.add(std::move(colour))}};
    std::vector<glm::vec3> position;
    std::vector<float> frame; // x, y, z, w
    std::vector<float> size;
    std::vector<std::uint32_t> kind;
    std::vector<std::uint32_t> object_colour;
    Json kinds = Json::array();
    for (const TurtleInfo& row : TurtleInfo::kRows) {
        kinds.push_back(row.name);
    }
    for (const PlacedObject& object : skeleton.objects) {
        position.push_back(object.position);
        frame.insert(frame.end(), {object.frame.x, object.frame.y, object.frame.z, object.frame.w});
        size.push_back(object.size);
        kind.push_back(static_cast<std::uint32_t>(object.kind));
        object_colour.push_back(object.colour);
    }
    Json objects{{"count", skeleton.objects.size()},
                 {"position", answer.add(std::move(position))},
                 {"frame", answer.add(std::move(frame))},
                 {"size", answer.add(std::move(size))},
                 {"kind", answer.add(std::move(kind))},
                 {"colour", answer.add(std::move(object_colour))},
                 {"kinds", std::move(kinds)}};
    std::vector<std::uint32_t> corner_counts;
    std::vector<std::uint32_t> polygon_colour;
    for (const Polygon& polygon : skeleton.polygons) {
        corner_counts.push_back(polygon.corner_count);
        polygon_colour.push_back(polygon.colour);
    }
    std::vector<glm::vec3> corners;
    for (const Polygon& polygon : skeleton.polygons) {
        const auto first = skeleton.corners.begin() + polygon.first_corner;
        corners.insert(corners.end(), first, first + polygon.corner_count);
    }
    Json polygons{{"count", skeleton.polygons.size()},
                  {"cornerCounts", answer.add(std::move(corner_counts))},
                  {"corners", answer.add(std::move(corners))},
                  {"colour", answer.add(std::move(polygon_colour))}};
    return {{"segments", std::move(segments)},
            {"objects", std::move(objects)},
            {"polygons", std::move(polygons)}};
}

} // namespace lsys::web
