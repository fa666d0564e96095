// SPDX-License-Identifier: MIT
#include "compiler/bytecode/turtle_operation.h"
#include "grammar/base/paths.h"
#include "runtime/base/workers.h"
#include "runtime/library/impl/call.h"
#include "runtime/library/impl/data.h"
#include "runtime/meshing/looks.h"
#include "runtime/pipeline/step.h"
#include "runtime/turtle/turtle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lsys::v0 {

namespace {

/// Views an array of the pipeline as an array of the public type, without a copy.
template <typename Public, typename Inner>
std::span<const Public> as(std::span<const Inner> items) {
    static_assert(sizeof(Public) == sizeof(Inner) && alignof(Public) == alignof(Inner));
    static_assert(std::is_trivially_copyable_v<Public> && std::is_trivially_copyable_v<Inner>);
    static_assert(std::is_standard_layout_v<Public>);
    return {reinterpret_cast<const Public*>(items.data()), items.size()};
}

// The layouts of glm and of the skeleton must equal the layouts in plant.h. The flags of a segment
// are bit fields, whose position a test checks.
static_assert(offsetof(glm::quat, x) == offsetof(Quaternion, x));
static_assert(offsetof(glm::quat, w) == offsetof(Quaternion, w));
static_assert(offsetof(::lsys::Segment, frame) == offsetof(Segment, frame));
static_assert(offsetof(::lsys::Segment, mass) == offsetof(Segment, mass));
static_assert(offsetof(::lsys::Segment, colour) == offsetof(Segment, colour));
static_assert(offsetof(::lsys::Segment, order) == offsetof(Segment, order));
static_assert(offsetof(::lsys::Segment, sides) == offsetof(Segment, sides));
static_assert(offsetof(PlacedObject, kind) == offsetof(Object, kind));
static_assert(offsetof(PlacedObject, mesh_file) == offsetof(Object, file));
static_assert(offsetof(PlacedObject, frame) == offsetof(Object, frame));
static_assert(offsetof(PlacedObject, order) == offsetof(Object, order));
static_assert(offsetof(::lsys::Polygon, frame) == offsetof(Polygon, frame));
static_assert(offsetof(::lsys::Polygon, picture) == offsetof(Polygon, picture));
static_assert(offsetof(::lsys::Polygon, order) == offsetof(Polygon, order));

template <typename T>
std::span<const T> span_of(const LargeVector<T>& items) {
    return {items.data(), items.size()};
}

Vector3 vector_of(const glm::vec3& vector) {
    return {vector.x, vector.y, vector.z};
}

::lsys::MeshMethod inner_method(MeshMethod method) {
    switch (method) {
    case MeshMethod::Default:
        break;
    case MeshMethod::Tubes:
        return ::lsys::MeshMethod::Tubes;
    case MeshMethod::Cylinders:
        return ::lsys::MeshMethod::Cylinders;
    case MeshMethod::Boxes:
        return ::lsys::MeshMethod::Boxes;
    case MeshMethod::Solid:
        return ::lsys::MeshMethod::Solid;
    }
    return ::lsys::MeshMethod::Default;
}

Material public_material(const ::lsys::Material& material) {
    Material out;
    out.name = material.name;
    out.colour = {material.colour.r, material.colour.g, material.colour.b, material.colour.a};
    out.roughness = roughness_of(material);
    out.two_sided = material.two_sided;
    out.cut_out = material.cut_out;
    return out;
}

/// Writes items [first, end), of `size` bytes each, one every `stride` bytes; 0: without gaps.
void write_items(const void* from,
                 std::size_t size,
                 std::uint64_t first,
                 std::uint64_t end,
                 void* to,
                 std::size_t stride) {
    const auto* source = static_cast<const std::byte*>(from);
    auto* target = static_cast<std::byte*>(to);
    const std::size_t step = stride != 0 ? stride : size;
    for (std::uint64_t i = first; i < end; ++i) {
        std::memcpy(target + i * step, source + i * size, size);
    }
}

} // namespace

const std::vector<std::string>& object_kinds() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        all.reserve(TurtleInfo::kRows.size());
        for (const TurtleInfo& row : TurtleInfo::kRows) {
            all.emplace_back(row.name);
        }
        return all;
    }();
    return names;
}

::lsys::MeshOptions inner_mesh_options(const MeshOptions& options) {
    ::lsys::MeshOptions out;
    out.method = inner_method(options.method);
    out.sides = options.sides;
    out.deviation = options.deviation;
    out.texture_coordinates = options.texture_coordinates;
    out.tangents = options.tangents;
    out.smooth_joints = options.smooth_joints;
    out.min_width = options.min_width;
    return out;
}

std::string mistake_of(const MeshOptions& options) {
    // The ranges are those of the options of lsc; NaN is in none of them.
    if (options.sides != 0 && (options.sides < kMinSides || options.sides > kMaxSides)) {
        return fmt::format("`sides` is {}, not 0 or a whole number from {} to {}", options.sides,
                           kMinSides, kMaxSides);
    }
    const auto is_in = [](float value, float max) { return value >= 0.0F && value <= max; };
    if (!is_in(options.deviation, kMaxDeviation)) {
        return fmt::format("`deviation` is {}, not a number of metres from 0 to {}",
                           options.deviation, kMaxDeviation);
    }
    if (!is_in(options.min_width, kMaxMinWidth)) {
        return fmt::format("`min_width` is {}, not a number of metres from 0 to {}",
                           options.min_width, kMaxMinWidth);
    }
    return {};
}

Plant::Plant(std::shared_ptr<const Data> data) noexcept : data_(std::move(data)) {}

std::uint64_t Plant::modules() const {
    return data_->plant.modules;
}

std::uint32_t Plant::generations() const {
    return data_->plant.generations;
}

std::uint64_t Plant::seed() const {
    return data_->plant.seed;
}

std::span<const Segment> Plant::segments() const {
    return as<Segment>(span_of(data_->plant.skeleton.segments));
}

std::span<const Object> Plant::objects() const {
    return as<Object>(span_of(data_->plant.skeleton.objects));
}

std::span<const Polygon> Plant::polygons() const {
    return as<Polygon>(span_of(data_->plant.skeleton.polygons));
}

std::span<const Vector3> Plant::corners() const {
    return as<Vector3>(span_of(data_->plant.skeleton.corners));
}

const std::vector<std::string>& Plant::files() const {
    return data_->plant.skeleton.mesh_files;
}

PlantSize Plant::measure() const {
    const SkeletonStats stats = ::lsys::measure(data_->plant.skeleton);
    return {vector_of(stats.bounds.low),
            vector_of(stats.bounds.high),
            stats.height,
            stats.crown_width,
            stats.length,
            stats.volume,
            stats.mass,
            stats.segments_by_order};
}

Outcome<Plant> grow(const Grammar& grammar, const GrowOptions& options, const Project& project) {
    Call call(project, {grammar.data().file}, grammar.data().policy);
    call.check_environments(grammar.data().grammar.bytecode);
    ::lsys::Grammar copy = copy_of(grammar.data().grammar);
    PlantOptions inner;
    inner.file = grammar.name();
    inner.generations = options.generations;
    inner.seed = options.seed;
    inner.height = options.height;
    inner.stream = options.stream;
    const auto work = [&]() -> ::lsys::Outcome<::lsys::Plant> {
        if (inner.height && !(*inner.height >= kMinHeight && *inner.height <= kMaxHeight)) {
            return Step(call.project())
                .fail(fmt::format("`height` is {}, not a number of metres from {} to {}",
                                  *inner.height, kMinHeight, kMaxHeight));
        }
        return grow_plant(inner, copy, call.project());
    };
    return call.run<Plant>(work, [&](::lsys::Plant plant) {
        return Plant(std::make_shared<const Plant::Data>(
            Plant::Data{std::move(plant), grammar, inner, call.files()}));
    });
}

Mesh::Mesh(std::shared_ptr<const Data> data) noexcept : data_(std::move(data)) {}

std::span<const Vector3> Mesh::positions() const {
    return as<Vector3>(span_of(data_->mesh->positions));
}

std::span<const Vector3> Mesh::normals() const {
    return as<Vector3>(span_of(data_->mesh->normals));
}

std::span<const Vector2> Mesh::texture_coordinates() const {
    return as<Vector2>(span_of(data_->mesh->texture_coordinates));
}

std::span<const Vector4> Mesh::tangents() const {
    return as<Vector4>(span_of(data_->mesh->tangents));
}

std::span<const Colour> Mesh::colours() const {
    return span_of(data_->mesh->colours);
}

std::uint64_t Mesh::index_count() const {
    return data_->mesh->indices.size();
}

void Mesh::read_indices(std::uint64_t first, std::uint64_t count, std::uint32_t* to) const {
    data_->mesh->indices.read(first, {to, count});
}

void Mesh::read_vertices(const VertexTarget& target) const {
    const ::lsys::Mesh& mesh = *data_->mesh;
    constexpr std::uint64_t kPiece = 65'536;
    const std::uint64_t count = mesh.positions.size();
    const auto write = [&](const auto& items, std::uint64_t first, std::uint64_t end, void* to) {
        if (to != nullptr && !items.empty()) {
            write_items(items.data(), sizeof(items[0]), first, end, to, target.stride);
        }
    };
    Workers workers(data_->threads);
    workers.for_each((count + kPiece - 1) / kPiece, [&](std::uint64_t piece) {
        const std::uint64_t first = piece * kPiece;
        const std::uint64_t end = std::min(first + kPiece, count);
        write(mesh.positions, first, end, target.positions);
        write(mesh.normals, first, end, target.normals);
        write(mesh.texture_coordinates, first, end, target.texture_coordinates);
        write(mesh.tangents, first, end, target.tangents);
        if (target.colours == nullptr) {
            return;
        }
        const std::size_t step = target.stride != 0 ? target.stride : sizeof(Vector4);
        for (std::uint64_t i = first; i < end; ++i) {
            const glm::vec3 colour = plain_colour(mesh.looks.get(), mesh.colours[i]);
            const Vector4 rgba{colour.r, colour.g, colour.b, 1.0F};
            std::memcpy(static_cast<std::byte*>(target.colours) + i * step, &rgba, sizeof(rgba));
        }
    });
}

const std::vector<MeshPart>& Mesh::parts() const {
    return data_->parts;
}

const std::vector<Material>& Mesh::materials() const {
    return data_->materials;
}

Mesh public_mesh(std::shared_ptr<const ::lsys::Mesh> mesh, std::uint32_t threads) {
    auto data = std::make_shared<Mesh::Data>();
    for (const ::lsys::MeshPart& part : mesh->parts) {
        data->parts.push_back({part.material, part.first_index, part.index_count});
    }
    for (const ::lsys::Material& material : mesh->materials) {
        data->materials.push_back(public_material(material));
    }
    data->mesh = std::move(mesh);
    data->threads = threads;
    return Mesh(std::move(data));
}

Outcome<Mesh> make_mesh(const Plant& plant, const MeshOptions& options, const Project& project) {
    const Grammar::Data& read = plant.data().grammar.data();
    Call call(project, {read.file}, read.policy);
    const ::lsys::Plant& drawn = plant.data().plant;
    return call.run<Mesh>(
        [&]() -> ::lsys::Outcome<::lsys::Mesh> {
            if (std::string mistake = mistake_of(options); !mistake.empty()) {
                return Step(call.project()).fail(std::move(mistake));
            }
            return mesh_plant(drawn, drawn.skeleton, inner_mesh_options(options), call.project());
        },
        [&](::lsys::Mesh mesh) {
            return public_mesh(std::make_shared<const ::lsys::Mesh>(std::move(mesh)),
                               project.threads);
        });
}

} // namespace lsys::v0
