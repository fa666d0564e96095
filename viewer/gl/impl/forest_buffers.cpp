// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/forest_buffers.h"

#include "grammar/base/contract.h"
#include "grammar/base/hash.h"
#include "runtime/meshing/texture.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace lsys::view {

namespace {

// Binding points in forest.glsl and branch.vert.glsl.
constexpr GLuint kBranches = 0;
constexpr GLuint kTrees = 1;
constexpr GLuint kForms = 2;
constexpr GLuint kMaterials = 3;
constexpr GLuint kBranchColours = 5;
constexpr GLuint kBranchAttribute = 4;

struct Vertex {
    std::array<std::int16_t, 3> position{}; // from the hero's origin, in 1/32767 of boxes_
    std::uint16_t material = 0;
    std::array<std::int8_t, 2> normal{}; // octahedral, in 1/127
    std::array<std::uint8_t, 2> unused{};
    std::array<std::uint16_t, 2> texture_coordinate{}; // binary16
};
static_assert(sizeof(Vertex) == 16);

/// Material of branch.vert.glsl.
struct MaterialRecord {
    glm::vec3 colour{};
    // kTextured, kTranslucent, kBumpy; from bit 8 on: translucency in 1/256; from bit 20 on:
    // roughness in 1/255; from bit 28 on: layer of the array of its pictures
    std::uint32_t kind = 0;
};
static_assert(sizeof(MaterialRecord) == 16);
constexpr std::uint32_t kTextured = 1; // bits in branch.frag.glsl
constexpr std::uint32_t kTranslucent = 2;
constexpr std::uint32_t kBumpy = 4;
constexpr unsigned kTranslucencyShift = 8;
constexpr unsigned kRoughnessShift = 20;
constexpr unsigned kLayerShift = 28;

/// Form of forest.glsl.
struct FormRecord {
    glm::vec4 cylinder{};
    glm::vec4 layers{};
};

/// A tree of forest.glsl, as three uvec2.
struct TreeRecord {
    glm::vec3 root{};
    float scale = 1.0F;
    std::uint32_t yaw_and_phase = 0;
    std::uint32_t form_and_impostor = 0;
};
static_assert(sizeof(TreeRecord) == 24);

/// Number of spare records for added trees. When they are used up, the device copies all records to
/// a larger buffer.
constexpr std::size_t kRoomForTrees = std::size_t{1} << 14U;

/// The record of a tree. `full`: the same tree with its yaw and number.
TreeRecord record_of(const LodTree& tree, const Tree& full) {
    const float turns = full.yaw / (2.0F * std::numbers::pi_v<float>);
    const auto yaw = static_cast<std::uint32_t>(65536.0F * (turns - std::floor(turns))) & 0xFFFFU;
    const std::uint32_t phase = golden_multiple(full.number) >> 16U;
    const auto impostor = static_cast<std::uint32_t>(tree.impostor & ~LodTree::kRemoved);
    return {tree.position, tree.scale, phase << 16U | yaw, impostor << 16U | tree.form};
}

/// Combines the hash of items with `digest`, to find out whether an upload would change anything.
template <typename T>
std::uint64_t digest_of(std::span<const T> items, std::uint64_t digest) {
    return combine_bytes(digest, {reinterpret_cast<const char*>(items.data()), items.size_bytes()});
}

std::int16_t snorm16(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * 32767.0F));
}

std::array<std::int8_t, 2> octahedral(const glm::vec3& n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 e = sum > 0.0F ? glm::vec2(n.x, n.y) / sum : glm::vec2(0.0F);
    if (n.z < 0.0F) {
        e = {std::copysign(1.0F - std::abs(e.y), e.x), std::copysign(1.0F - std::abs(e.x), e.y)};
    }
    const auto snorm8 = [](float v) { return static_cast<std::int8_t>(std::lround(v * 127.0F)); };
    return {snorm8(e.x), snorm8(e.y)};
}

/// Appends the records of materials, equal records only once. Returns their indices.
std::vector<std::uint16_t> add_materials(const std::vector<Material>& materials,
                                         const PictureArrays& pictures,
                                         std::vector<MaterialRecord>& records) {
    std::vector<std::uint16_t> numbers;
    for (const Material& material : materials) {
        MaterialRecord record;
        record.colour = glm::vec3(material.colour);
        // Thin materials are leaves, petals, and two-sided materials of mesh files, most of which
        // are leaves.
        const bool is_thin = material.two_sided || material.kind == MaterialKind::Leaf ||
                             material.kind == MaterialKind::Flower;
        const auto translucency = static_cast<std::uint32_t>(translucency_step(material, is_thin));
        const bool is_bumpy = material.normal_map != nullptr ||
                              (material.textured && material.kind == MaterialKind::Bark);
        record.kind = (material.textured ? kTextured : 0) | (translucency > 0 ? kTranslucent : 0) |
                      (is_bumpy ? kBumpy : 0) | translucency << kTranslucencyShift |
                      static_cast<std::uint32_t>(std::lround(255.0F * roughness_of(material)))
                          << kRoughnessShift;
        if (const std::optional<PictureArrays::Place> place = pictures.place_of(material)) {
            record.kind |= place->layer << kLayerShift;
        }
        const auto equal_record =
            std::find_if(records.begin(), records.end(), [&](const MaterialRecord& other) {
                return other.colour == record.colour && other.kind == record.kind;
            });
        numbers.push_back(static_cast<std::uint16_t>(equal_record - records.begin()));
        if (equal_record == records.end()) {
            records.push_back(record);
        }
    }
    return numbers;
}

// Numbers of texture units in branch.frag.glsl and leaf.frag.glsl.
constexpr GLuint kBarkTexture = 1;
constexpr GLuint kLeafTexture = 2;
constexpr GLuint kNormalMapTexture = 5;

} // namespace

ForestBuffers::DrawBuffers ForestBuffers::make_draw_buffers(Device& device) {
    return {Buffer(device), Buffer(device), Buffer(device), {}};
}

ForestBuffers::ForestBuffers(Device& device)
    : array_(make_vertex_array(device)), vertices_(device), indices_(device), materials_(device),
      forms_(device), branch_colours_(device), clusters_(device),
      forest_(make_draw_buffers(device)), impostor_(make_draw_buffers(device)),
      shadow_(make_draw_buffers(device)), device_(&device) {
    const GLuint array = array_.name();
    for (GLuint i = 0; i <= kBranchAttribute; ++i) {
        glEnableVertexArrayAttrib(array, i);
        glVertexArrayAttribBinding(array, i, i == kBranchAttribute ? 1 : 0);
    }
    glVertexArrayAttribFormat(array, 0, 3, GL_SHORT, GL_TRUE, offsetof(Vertex, position));
    glVertexArrayAttribIFormat(array, 1, 1, GL_UNSIGNED_SHORT, offsetof(Vertex, material));
    glVertexArrayAttribFormat(array, 2, 2, GL_BYTE, GL_TRUE, offsetof(Vertex, normal));
    glVertexArrayAttribFormat(array, 3, 2, GL_HALF_FLOAT, GL_FALSE,
                              offsetof(Vertex, texture_coordinate));
    glVertexArrayAttribIFormat(array, kBranchAttribute, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayBindingDivisor(array, 1, 1);
}

void ForestBuffers::use(BufferSet set) {
    current_ = set == BufferSet::Forest     ? &forest_
               : set == BufferSet::Impostor ? &impostor_
                                            : &shadow_;
}

std::size_t ForestBuffers::class_of(const Material& material) const {
    if (const std::optional<PictureArrays::Place> place = pictures_.place_of(material)) {
        return kBranchClasses + place->array;
    }
    if (material.cut_out && material.textured) {
        return static_cast<std::size_t>(BranchClass::CutOut);
    }
    if (!material.two_sided) {
        return static_cast<std::size_t>(BranchClass::OneSided);
    }
    return static_cast<std::size_t>(material.textured ? BranchClass::TwoSided : BranchClass::Plain);
}

void ForestBuffers::upload(ForestModel& model,
                           const ImpostorPlan& plan,
                           const MaterialTextures& textures) {
    pictures_.upload(model, textures);
    for (DrawBuffers* const buffers : {&forest_, &impostor_, &shadow_}) {
        while (buffers->commands.size() < 2 * class_count()) {
            buffers->commands.push_back({Buffer(*device_), 0});
        }
    }
    std::vector<MaterialRecord> records;
    std::uint64_t vertex_count = 0;
    std::uint64_t index_count = 0;
    std::vector<float> boxes;
    for (const TreeForm& form : model.forms) {
        float box = 1e-6F;
        for (const InstanceMeshes& level : *form.meshes) {
            vertex_count += level.mesh.positions.size();
            index_count += level.mesh.indices.size();
            for (const glm::vec3& at : level.mesh.positions) {
                const glm::vec3 size = glm::abs(at);
                box = std::max({box, size.x, size.y, size.z});
            }
        }
        boxes.push_back(box);
    }
    boxes_ = boxes;
    upload_forms(model, plan);
    vertices_.allocate(vertex_count * sizeof(Vertex));
    indices_.allocate(index_count * sizeof(std::uint32_t));
    mesh_bytes_ = vertex_count * sizeof(Vertex) + index_count * sizeof(std::uint32_t);
    form_levels_.clear();
    mesh_digests_.clear();
    std::uint64_t first_vertex = 0;
    std::uint64_t first_index = 0;
    std::vector<Vertex> packed;
    std::vector<std::uint32_t> listed;
    std::map<std::shared_ptr<const Texture>, std::uint64_t> picture_digests;
    for (std::size_t f = 0; f < model.forms.size(); ++f) {
        auto& levels = form_levels_.emplace_back();
        std::uint64_t& digest = mesh_digests_.emplace_back(0);
        digest = digest_of(std::span<const float>(&boxes[f], 1), digest);
        const std::shared_ptr<const TreeMeshes> of_levels = std::move(model.forms[f].meshes);
        for (std::size_t l = 0; l < kTreeLevels; ++l) {
            const InstanceMeshes& meshes = (*of_levels)[l];
            const Mesh& mesh = meshes.mesh;
            const LargeVector<std::uint32_t> indices = mesh.indices.expanded();
            const std::vector<std::uint16_t> numbers =
                add_materials(mesh.materials, pictures_, records);
            FormLevel& level = levels[l];
            level.base_vertex = static_cast<std::int32_t>(first_vertex);
            packed.assign(mesh.positions.size(), {});
            for (std::size_t v = 0; v < packed.size(); ++v) {
                const glm::vec3 at = mesh.positions[v] / boxes[f];
                packed[v].position = {snorm16(at.x), snorm16(at.y), snorm16(at.z)};
                packed[v].normal = octahedral(mesh.normals[v]);
                if (!mesh.texture_coordinates.empty()) {
                    const glm::vec2& uv = mesh.texture_coordinates[v];
                    packed[v].texture_coordinate = {glm::packHalf1x16(uv.x),
                                                    glm::packHalf1x16(uv.y)};
                }
            }
            const auto instances = static_cast<std::uint32_t>(meshes.first_part.size()) - 1;
            level.ranges.assign(instances * class_count(), {});
            std::vector<std::size_t> classes;
            for (const Material& material : mesh.materials) {
                classes.push_back(class_of(material));
            }
            listed.clear();
            for (std::uint32_t i = 0; i < instances; ++i) {
                // Parts are sorted by material, not by class.
                for (std::size_t kind = 0; kind < class_count(); ++kind) {
                    const std::size_t before = listed.size();
                    for (const MeshPart& part : meshes.parts_of(i)) {
                        if (classes[part.material] != kind) {
                            continue;
                        }
                        for (std::uint64_t k = 0; k < part.index_count; ++k) {
                            const std::uint32_t vertex = indices[part.first_index + k];
                            packed[vertex].material = numbers[part.material];
                            listed.push_back(vertex);
                        }
                    }
                    level.ranges[i * class_count() + kind] = {
                        static_cast<std::uint32_t>(first_index + before),
                        static_cast<std::uint32_t>(listed.size() - before)};
                }
            }
            for (const Material& material : mesh.materials) {
                if (material.picture != nullptr) {
                    const auto [known, is_new] = picture_digests.try_emplace(material.picture, 0);
                    if (is_new) {
                        known->second =
                            digest_of(std::span<const std::uint8_t>(material.picture->texels), 0);
                    }
                    digest = combine(digest, known->second);
                }
            }
            for (const std::uint16_t number : numbers) {
                MaterialRecord record = records[number];
                record.kind &= (1U << kLayerShift) - 1; // the layer depends on other pictures
                digest = digest_of(std::span<const MaterialRecord>(&record, 1), digest);
            }
            digest = digest_of(std::span<const Vertex>(packed), digest);
            digest = digest_of(std::span<const std::uint32_t>(listed), digest);
            vertices_.write(std::span<const Vertex>(packed), first_vertex * sizeof(Vertex));
            indices_.write(std::span<const std::uint32_t>(listed),
                           first_index * sizeof(std::uint32_t));
            first_vertex += mesh.positions.size();
            first_index += listed.size();
        }
    }
    materials_.fill(std::span<const MaterialRecord>(records));
    glVertexArrayVertexBuffer(array_.name(), 0, vertices_.name(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(array_.name(), indices_.name());
}

void ForestBuffers::upload_forms(const ForestModel& model, const ImpostorPlan& plan) {
    LSYS_CHECK(boxes_.size() == model.forms.size());
    std::vector<FormRecord> forms;
    for (std::size_t f = 0; f < plan.forms.size(); ++f) {
        const ImpostorForm& form = plan.forms[f];
        forms.push_back(
            {{form.cylinder.radius, form.cylinder.low, form.cylinder.high,
              boxes_[f % boxes_.size()]},
             {static_cast<float>(form.first_layer), f < boxes_.size() ? 0.0F : 1.0F, 0.0F, 0.0F}});
    }
    forms_.fill(std::span<const FormRecord>(forms));
}

void ForestBuffers::set_colours(const ForestModel& model, BranchColours by) {
    colour_digests_.assign(model.forms.size(), 0);
    // First one number per tree form: the index of its first colour. Forms of clusters have no
    // branches, so they need none.
    std::vector<std::uint32_t> words(model.forms.size(), 0);
    const std::vector<LegendEntry> legend = legend_of(model, by);
    for (std::size_t f = 0; !legend.empty() && f < model.forms.size(); ++f) {
        const InstanceCache& cache = *model.forms[f].cache;
        const std::size_t first = words.size();
        for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
            const glm::vec3 colour =
                branch_colour(by, branch_value(by, cache, i), legend.back().value);
            words.push_back(glm::packUnorm4x8(glm::vec4(glm::sqrt(colour), 1.0F)));
        }
        words[f] = static_cast<std::uint32_t>(first);
        colour_digests_[f] =
            digest_of(std::span<const std::uint32_t>(words).subspan(first), 0) | 1U;
    }
    branch_colours_.fill(std::span<const std::uint32_t>(words));
}

void ForestBuffers::upload_trees(const ForestLod& lod) {
    const std::span<const LodTree> trees = lod.trees();
    current_->trees.allocate((trees.size() + kRoomForTrees) * sizeof(TreeRecord));
    constexpr std::size_t kPiece = std::size_t{1} << 16U;
    std::vector<TreeRecord> records;
    for (std::size_t first = 0; first < trees.size(); first += kPiece) {
        records.clear();
        for (std::size_t t = first; t < std::min(first + kPiece, trees.size()); ++t) {
            records.push_back(record_of(trees[t], lod.model().forest->trees[trees[t].tree]));
        }
        current_->trees.write(std::span<const TreeRecord>(records), first * sizeof(TreeRecord));
    }
    upload_clusters(lod);
}

void ForestBuffers::upload_changed_trees(const ForestLod& lod, std::span<const TreeSpan> changed) {
    if (changed.empty()) {
        return;
    }
    current_->trees.grow(lod.trees().size() * sizeof(TreeRecord));
    std::vector<TreeRecord> records;
    for (const TreeSpan& span : changed) {
        records.clear();
        for (std::uint32_t t = span.first; t < span.first + span.count; ++t) {
            const LodTree& tree = lod.trees()[t];
            if (!tree.is_removed()) {
                records.push_back(record_of(tree, lod.tree_of(t)));
            }
        }
        if (records.size() == span.count) { // else the square was removed in the meantime
            current_->trees.write(std::span<const TreeRecord>(records),
                                  span.first * sizeof(TreeRecord));
        }
    }
    upload_clusters(lod);
}

void ForestBuffers::upload_clusters(const ForestLod& lod) {
    std::vector<TreeRecord> records;
    const auto forms = static_cast<std::uint32_t>(lod.model().forms.size());
    for (const ForestCell& cell : lod.cells()) {
        const auto number = lod.model().streamed == nullptr
                                ? static_cast<std::uint32_t>(records.size())
                                : cell.seed;
        // Each cluster is rotated by a random number of quarter turns, which keep its square
        // aligned with its cell.
        const std::uint32_t drawn = golden_multiple(number);
        const std::uint32_t yaw = drawn >> 30U << 14U;
        const std::uint32_t phase = drawn & 0xFFFF0000U;
        records.push_back({cell.middle, cell.scale, phase | yaw, forms + cell.form});
    }
    clusters_.fill(std::span<const TreeRecord>(records));
}

void ForestBuffers::upload_tree(const ForestLod& lod, std::uint32_t number) {
    const std::size_t offset = std::size_t{number} * sizeof(TreeRecord);
    Buffer& trees = current_->trees;
    if (offset + sizeof(TreeRecord) > trees.capacity()) {
        trees.grow(offset + kRoomForTrees * sizeof(TreeRecord));
    }
    const TreeRecord record = record_of(lod.lod_tree(number), lod.tree_of(number));
    trees.write(std::span<const TreeRecord>(&record, 1), offset);
}

void ForestBuffers::bind_clusters() const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTrees, clusters_.name());
}

void ForestBuffers::set_trees(std::span<const Tree> trees, std::uint32_t form) {
    std::vector<TreeRecord> records;
    for (const Tree& tree : trees) {
        records.push_back({tree.position, tree.scale, 0, form});
    }
    current_->trees.fill(std::span<const TreeRecord>(records));
}

void ForestBuffers::upload_branches(BranchPool& pool) {
    const std::span<const PoolBranch> all = pool.branches();
    current_->branches.grow(std::bit_ceil(std::max<std::size_t>(all.size_bytes(), 1024)));
    for (const PoolSpan& span : pool.take_written()) {
        current_->branches.write(all.subspan(span.first, span.count),
                                 span.first * sizeof(PoolBranch));
    }
}

void ForestBuffers::set_branches(std::span<const PoolBranch> branches) {
    current_->branches.fill(branches);
}

void ForestBuffers::upload_commands(const DrawLists& lists) {
    current_->lists.fill(std::span<const BranchEntry>(lists.branches));
    std::vector<std::vector<DrawCommand>> commands(2 * class_count());
    for (const BranchRun& run : lists.runs) {
        const FormLevel& level = form_levels_[run.form][run.level];
        for (std::size_t kind = 0; kind < class_count(); ++kind) {
            const IndexRange& range = level.ranges[run.instance * class_count() + kind];
            if (range.count != 0) {
                commands[command_index(kind, run.blends)].push_back(
                    {range.count, run.count, range.first, level.base_vertex, run.first});
            }
        }
    }
    for (std::size_t i = 0; i < commands.size(); ++i) {
        current_->commands[i].buffer.fill(std::span<const DrawCommand>(commands[i]));
        current_->commands[i].count = static_cast<std::uint32_t>(commands[i].size());
    }
}

CommandTemplates
ForestBuffers::command_templates(const std::vector<std::uint32_t>& first_keys) const {
    CommandTemplates templates;
    for (std::size_t kind = 0; kind < class_count(); ++kind) {
        for (const bool blends : {false, true}) {
            CommandRange& range = templates.ranges.emplace_back();
            range.first = static_cast<std::uint32_t>(templates.commands.size());
            // Finer levels are drawn first, as in ForestLod::list_runs().
            for (std::uint32_t group = blends ? kTreeLevels : 0;
                 group < (blends ? 2 * kTreeLevels : kTreeLevels); ++group) {
                for (std::size_t f = 0; f < form_levels_.size(); ++f) {
                    const FormLevel& level = form_levels_[f][group % kTreeLevels];
                    const auto instances =
                        static_cast<std::uint32_t>(level.ranges.size() / class_count());
                    for (std::uint32_t i = 0; i < instances; ++i) {
                        const IndexRange& indices = level.ranges[i * class_count() + kind];
                        if (indices.count != 0) {
                            templates.commands.push_back(
                                {indices.count, 0, indices.first, level.base_vertex, 0});
                            templates.keys.push_back(first_keys[f] + group * instances + i);
                        }
                    }
                }
            }
            range.count = static_cast<std::uint32_t>(templates.commands.size()) - range.first;
        }
    }
    return templates;
}

std::uint64_t ForestBuffers::draw(std::size_t kind, bool blends) const {
    GLuint buffer = commands_of(kind, blends).buffer.name();
    CommandRange range{0, commands_of(kind, blends).count};
    if (uses_device_draws()) {
        buffer = device_draws_->commands;
        range = device_draws_->ranges[command_index(kind, blends)];
    }
    if (range.count == 0) {
        return 0;
    }
    glBindVertexArray(array_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(range.first * sizeof(DrawCommand)),
                                static_cast<GLsizei>(range.count), sizeof(DrawCommand));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    return 1;
}

std::uint64_t ForestBuffers::draw(BranchClass kind, bool blends) const {
    (kind == BranchClass::OneSided ? glEnable : glDisable)(GL_CULL_FACE);
    return draw(static_cast<std::size_t>(kind), blends);
}

std::uint64_t ForestBuffers::draw_pictures(GLuint solid,
                                           GLuint cut_out,
                                           GLuint bumpy_cut_out,
                                           MaterialTextures& textures,
                                           bool blends) const {
    std::uint64_t draws = 0;
    const std::vector<PictureArray>& arrays = pictures_.arrays();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        const PictureArray& array = arrays[i];
        glUseProgram(!array.has_holes ? solid : array.has_normal_maps ? bumpy_cut_out : cut_out);
        glBindTextureUnit(array.has_holes ? kLeafTexture : kBarkTexture,
                          array.colours ? array.colours.name()
                                        : textures.base_colour_array(MaterialKind::Bark));
        glBindTextureUnit(kNormalMapTexture, array.normal_maps ? array.normal_maps.name()
                                                               : textures.bark_normal_array());
        glDisable(GL_CULL_FACE); // meshes from files are two-sided
        draws += draw(kBranchClasses + i, blends);
    }
    return draws;
}

void ForestBuffers::bind_storage() const {
    GLuint branches = current_->branches.name();
    if (uses_device_draws()) {
        branches = device_draws_->branches;
        constexpr GLsizei kPair = 2 * sizeof(std::uint32_t);
        glVertexArrayVertexBuffer(array_.name(), 1, device_draws_->entries, sizeof(std::uint32_t),
                                  kPair);
    } else {
        glVertexArrayVertexBuffer(array_.name(), 1, current_->lists.name(), 0, sizeof(BranchEntry));
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBranches, branches);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTrees,
                     (current_ == &shadow_ ? forest_ : *current_).trees.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kForms, forms_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kMaterials, materials_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBranchColours, branch_colours_.name());
}

} // namespace lsys::view
