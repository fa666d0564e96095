// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/impostor_atlas.h"

#include "grammar/base/hash.h"
#include "viewer/gl/impl/frame_block.h"
#include "viewer/gl/impl/program.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

constexpr std::uint32_t kSupersampling = 2; // drawn texels per stored texel, along a side
constexpr std::uint32_t kAtlasWidth = ImpostorAtlas::kYaws * ImpostorAtlas::kTile;
constexpr std::uint32_t kAtlasHeight = ImpostorAtlas::kElevations * ImpostorAtlas::kTile;
constexpr GLsizei kLevels = 6; // mip levels; tiles of the last have sides of 4 texels
/// Radians; impostor.glsl has them too.
constexpr std::array<float, ImpostorAtlas::kElevations> kElevationAngles = {0.0F, 0.6108652F,
                                                                            1.3089969F};
/// Margin of opaque_box() in texels, because opaque texels of coarse mip levels extend beyond those
/// of fine levels.
constexpr float kBoxMargin = 2.5F;
// Uniforms of branch.frag.glsl.
constexpr GLint kCentre = 2;
constexpr GLint kToEye = 3;
constexpr GLint kRight = 4;
constexpr GLint kUp = 5;

/// The cylinder of the form to which the layer `layer` belongs; the layers of a form are
/// consecutive.
const Cylinder& cylinder_of(const ImpostorPlan& plan, std::uint32_t layer) {
    return std::find_if(plan.forms.rbegin(), plan.forms.rend(),
                        [layer](const ImpostorForm& each) { return each.first_layer <= layer; })
        ->cylinder;
}

/// Copies all mip levels of a layer of an array texture of the atlas.
void copy_layer(const TextureObject& from,
                std::uint32_t from_layer,
                const TextureObject& to,
                std::uint32_t to_layer) {
    for (GLint level = 0; level < kLevels; ++level) {
        glCopyImageSubData(from.name(), GL_TEXTURE_2D_ARRAY, level, 0, 0,
                           static_cast<GLint>(from_layer), to.name(), GL_TEXTURE_2D_ARRAY, level, 0,
                           0, static_cast<GLint>(to_layer),
                           static_cast<GLsizei>(kAtlasWidth >> level),
                           static_cast<GLsizei>(kAtlasHeight >> level), 1);
    }
}

/// Hash of all that a layer shows; never 0.
std::uint64_t key_of(const ImpostorLayer& impostor,
                     const Cylinder& cylinder,
                     const ForestModel& model,
                     std::uint64_t meshes) {
    std::uint64_t key = combine(meshes, model.forest->key);
    const auto add = [&key](std::uint64_t word) { key = combine(key, word); };
    const auto add_length = [&add](float length) { add(std::bit_cast<std::uint32_t>(length)); };
    add(impostor.level);
    for (const float length : {cylinder.radius, cylinder.low, cylinder.high}) {
        add_length(length);
    }
    for (const Tree& tree : impostor.trees) {
        add(tree.number);
        for (const float length :
             {tree.position.x, tree.position.y, tree.position.z, tree.yaw, tree.scale}) {
            add_length(length);
        }
    }
    return key | 1U;
}

/// Draw lists with the branches that a layer shows.
DrawLists lists_of(const TreeForm& form,
                   std::uint32_t form_index,
                   std::uint32_t level,
                   const std::vector<PoolBranch>& branches) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_mesh;
    for (std::uint32_t i = 0; i < branches.size(); ++i) {
        by_mesh[branches[i].mesh].push_back(i);
    }
    DrawLists lists;
    for (const auto& [mesh, places] : by_mesh) {
        if (form.mesh_triangles[level][mesh] != 0) {
            lists.runs.push_back({form_index, level, mesh,
                                  static_cast<std::uint32_t>(lists.branches.size()),
                                  static_cast<std::uint32_t>(places.size())});
            for (const std::uint32_t place : places) {
                lists.branches.emplace_back(place);
            }
        }
    }
    return lists;
}

} // namespace

Result<void> ImpostorAtlas::reload(const ShaderSource& shaders) {
    Result<ProgramObject> solid =
        make_program(*device_, shaders, "branch.vert.glsl", "branch.frag.glsl", "#define BAKE\n");
    if (!solid) {
        return solid.error();
    }
    Result<ProgramObject> cut_out =
        make_program(*device_, shaders, "branch.vert.glsl", "branch.frag.glsl",
                     "#define BAKE\n#define CUT_OUT\n");
    if (!cut_out) {
        return cut_out.error();
    }
    solid_ = std::move(solid.value());
    cut_out_ = std::move(cut_out.value());
    keys_.assign(keys_.size(), 0);
    list_missing();
    return {};
}

void ImpostorAtlas::list_missing() {
    bake_.reset();
    pending_.clear();
    for (std::uint32_t layer = layers_; layer-- > 0;) {
        if (keys_[layer] != target_keys_[layer]) {
            pending_.push_back(layer);
        }
    }
    // First bakes one layer of each form without pictures, which stands in for its other layers.
    const auto waits = [this](std::uint32_t layer) {
        for (std::uint32_t other = 0; other < layers_; ++other) {
            const bool is_earlier = other < layer && keys_[other] != target_keys_[other];
            if ((filled_[other] != 0 || is_earlier) && are_alike(layer, other)) {
                return true;
            }
        }
        return false;
    };
    std::stable_partition(pending_.begin(), pending_.end(), waits);
}

bool ImpostorAtlas::are_alike(std::uint32_t a, std::uint32_t b) const {
    const ImpostorLayer& first = plan_.layers[a];
    const ImpostorLayer& second = plan_.layers[b];
    return first.form == second.form && (first.trees.size() == 1) == (second.trees.size() == 1);
}

bool ImpostorAtlas::is_filled() const {
    return std::all_of(filled_.begin(), filled_.end(), [](std::uint8_t each) { return each != 0; });
}

void ImpostorAtlas::stand_in(std::uint32_t layer) {
    for (std::uint32_t other = 0; other < layers_; ++other) {
        if (filled_[other] != 0 || !are_alike(layer, other)) {
            continue;
        }
        filled_[other] = 1;
        boxes_[other] = boxes_[layer];
        box_buffer_.write(std::span<const LayerBoxes>(&boxes_[other], 1),
                          other * sizeof(LayerBoxes));
        for (const TextureObject* texture : {&albedos_, &normals_}) {
            copy_layer(*texture, layer, *texture, other);
        }
    }
}

void ImpostorAtlas::draw_elevation(const Cylinder& form,
                                   std::uint32_t e,
                                   const ForestBuffers& buffers,
                                   MaterialTextures& textures,
                                   Buffer& frame) const {
    const float half_height = 0.5F * (form.high - form.low);
    const glm::vec3 middle(0.0F, 0.5F * (form.low + form.high), 0.0F);
    const float deep = kImpostorMargin * std::hypot(form.radius, half_height);
    const float wide = kImpostorMargin * form.radius;
    const float high = kImpostorMargin * (half_height * std::cos(kElevationAngles[e]) +
                                          form.radius * std::sin(kElevationAngles[e]));
    for (std::uint32_t y = 0; y < kYaws; ++y) {
        const float yaw =
            2.0F * std::numbers::pi_v<float> * static_cast<float>(y) / static_cast<float>(kYaws);
        const glm::vec3 to_eye(std::sin(yaw) * std::cos(kElevationAngles[e]),
                               std::sin(kElevationAngles[e]),
                               std::cos(yaw) * std::cos(kElevationAngles[e]));
        const glm::vec3 right(std::cos(yaw), 0.0F, -std::sin(yaw));
        const glm::vec3 up = glm::cross(to_eye, right);
        FrameBlock block;
        glm::mat4& matrix = block.view_projection;
        for (glm::length_t c = 0; c < 3; ++c) {
            matrix[c] = {right[c] / wide, up[c] / high, 0.5F * to_eye[c] / deep, 0.0F};
        }
        matrix[3] = {-glm::dot(right, middle) / wide, -glm::dot(up, middle) / high,
                     0.5F - 0.5F * glm::dot(to_eye, middle) / deep, 1.0F};
        frame.fill(std::span<const FrameBlock>(&block, 1));
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame.name());
        glViewport(static_cast<GLint>(y * kTile * kSupersampling), 0,
                   static_cast<GLsizei>(kTile * kSupersampling),
                   static_cast<GLsizei>(kTile * kSupersampling));
        glBindTextureUnit(1, textures.base_colour_array(MaterialKind::Bark));
        glBindTextureUnit(2, textures.base_colour_array(MaterialKind::Leaf));
        for (const ProgramObject* program : {&solid_, &cut_out_}) {
            glUseProgram(program->name());
            glUniform4f(kCentre, middle.x, middle.y, middle.z, deep);
            glUniform3f(kToEye, to_eye.x, to_eye.y, to_eye.z);
            glUniform3f(kRight, right.x, right.y, right.z);
            glUniform3f(kUp, up.x, up.y, up.z);
            if (program == &cut_out_) {
                buffers.draw(BranchClass::CutOut);
            } else {
                buffers.draw(BranchClass::OneSided);
                buffers.draw(BranchClass::TwoSided);
                buffers.draw(BranchClass::Plain);
            }
        }
        buffers.draw_pictures(solid_.name(), cut_out_.name(), cut_out_.name(), textures, false);
        device_->end_pass();
    }
}

void ImpostorAtlas::upload_layer(std::uint32_t layer, ImpostorTexels picture) {
    for (GLint level = 0; level < kLevels; ++level) {
        dilate(picture, 2);
        const std::vector<std::uint8_t> scaled = with_coverage(picture);
        if (level == 0) {
            set_boxes(layer, scaled);
        }
        const auto width = static_cast<GLsizei>(picture.width);
        const auto height = static_cast<GLsizei>(picture.height);
        glTextureSubImage3D(albedos_.name(), level, 0, 0, static_cast<GLint>(layer), width, height,
                            1, GL_RGBA, GL_UNSIGNED_BYTE, scaled.data());
        glTextureSubImage3D(normals_.name(), level, 0, 0, static_cast<GLint>(layer), width, height,
                            1, GL_RGBA, GL_UNSIGNED_BYTE, picture.normals.data());
        device_->add_upload(scaled.size() + picture.normals.size());
        picture = halved(picture);
    }
}

glm::vec3 ImpostorAtlas::mean_colour_from_above(std::span<const float> parts) const {
    constexpr GLint kLast = kLevels - 1;
    constexpr std::size_t kRow = kAtlasWidth >> static_cast<unsigned>(kLast);
    constexpr std::size_t kRows = kAtlasHeight >> static_cast<unsigned>(kLast);
    constexpr std::size_t kFirstRow = kRows * (kElevations - 1) / kElevations; // highest elevation
    std::vector<std::uint8_t> texels(4 * kRow * kRows * layers_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(albedos_.name(), kLast, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(texels.size()), texels.data());
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t layer = 0; layer < plan_.layers.size(); ++layer) {
        const ImpostorLayer& impostor = plan_.layers[layer];
        if (impostor.trees.size() != 1) {
            continue; // a form of a cluster, which does not count
        }
        const auto part = static_cast<double>(parts[impostor.form]);
        for (std::size_t texel = kFirstRow * kRow; texel < kRows * kRow; ++texel) {
            const std::uint8_t* rgba = &texels[4 * (layer * kRows * kRow + texel)];
            const glm::dvec3 root = glm::dvec3(rgba[0], rgba[1], rgba[2]) / 255.0;
            sum += part * static_cast<double>(rgba[3]) * root * root;
            weight += part * static_cast<double>(rgba[3]);
        }
    }
    return weight > 0.0 ? glm::vec3(sum / weight) : glm::vec3(0.0F);
}

void ImpostorAtlas::set_boxes(std::uint32_t layer, std::span<const std::uint8_t> albedos) {
    for (std::uint32_t e = 0; e < kElevations; ++e) {
        for (std::uint32_t y = 0; y < kYaws; ++y) {
            boxes_[layer][std::size_t{e} * kYaws + y] =
                opaque_box(albedos, kAtlasWidth, {y * kTile, e * kTile, kTile}, kBoxMargin);
        }
    }
    box_buffer_.write(std::span<const LayerBoxes>(&boxes_[layer], 1), layer * sizeof(LayerBoxes));
}

void ImpostorAtlas::make_layers(const std::vector<std::uint64_t>& keys) {
    const auto count = static_cast<std::uint32_t>(keys.size());
    if (count == layers_ && albedos_) {
        return;
    }
    const std::array<TextureObject, 2> before = {std::move(albedos_), std::move(normals_)};
    const std::vector<std::uint64_t> keys_before = std::exchange(keys_, {});
    const std::vector<LayerBoxes> boxes_before = std::exchange(boxes_, {});
    keys_.assign(count, 0);
    filled_.assign(count, 0);
    boxes_.resize(count);
    layers_ = count;
    texture_bytes_ = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        TextureObject& texture = i == 0 ? albedos_ : normals_;
        texture = make_texture(*device_, GL_TEXTURE_2D_ARRAY);
        glTextureStorage3D(texture.name(), kLevels, GL_RGBA8, static_cast<GLsizei>(kAtlasWidth),
                           static_cast<GLsizei>(kAtlasHeight), static_cast<GLsizei>(layers_));
        glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
        glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        texture_bytes_ += std::uint64_t{4} * kAtlasWidth * kAtlasHeight * layers_ * 4 / 3;
        for (GLint level = 0; level < kLevels; ++level) {
            glClearTexImage(texture.name(), level, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        }
        for (std::uint32_t layer = 0; layer < count; ++layer) {
            const auto same = std::find(keys_before.begin(), keys_before.end(), keys[layer]);
            if (same == keys_before.end()) {
                continue;
            }
            keys_[layer] = keys[layer];
            filled_[layer] = 1;
            const auto old_layer = static_cast<std::uint32_t>(same - keys_before.begin());
            boxes_[layer] = boxes_before[old_layer];
            copy_layer(before[i], old_layer, texture, layer);
        }
    }
    box_buffer_.fill(std::span<const LayerBoxes>(boxes_));
}

void ImpostorAtlas::begin(const ForestModel& model,
                          ImpostorPlan plan,
                          const ForestBuffers& buffers) {
    plan_ = std::move(plan);
    target_keys_.clear();
    for (std::uint32_t layer = 0; layer < plan_.layers.size(); ++layer) {
        const ImpostorLayer& impostor = plan_.layers[layer];
        target_keys_.push_back(
            key_of(impostor, cylinder_of(plan_, layer), model, buffers.mesh_digest(impostor.form)));
    }
    make_layers(target_keys_);
    list_missing();
}

ImpostorAtlas::BakeState ImpostorAtlas::make_bake_state() const {
    BakeState bake;
    const auto width = static_cast<GLsizei>(kAtlasWidth * kSupersampling);
    const auto height = static_cast<GLsizei>(kTile * kSupersampling); // of one elevation
    bake.target = make_framebuffer(*device_);
    constexpr std::array<GLenum, 3> kFormats = {GL_RGBA8, GL_RGBA8, GL_DEPTH_COMPONENT32F};
    constexpr std::array<GLenum, 3> kPoints = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                               GL_DEPTH_ATTACHMENT};
    for (std::size_t i = 0; i < bake.storage.size(); ++i) {
        bake.storage[i] = make_renderbuffer(*device_);
        glNamedRenderbufferStorage(bake.storage[i].name(), kFormats[i], width, height);
        glNamedFramebufferRenderbuffer(bake.target.name(), kPoints[i], GL_RENDERBUFFER,
                                       bake.storage[i].name());
    }
    glNamedFramebufferDrawBuffers(bake.target.name(), 2, kPoints.data());
    bake.frame = Buffer(*device_);
    bake.row = {kAtlasWidth * kSupersampling, kTile * kSupersampling, {}, {}};
    bake.row.albedos.resize(std::size_t{4} * bake.row.width * bake.row.height);
    bake.row.normals.resize(bake.row.albedos.size());
    return bake;
}

void ImpostorAtlas::begin_layer(std::uint32_t layer,
                                const ForestModel& model,
                                ForestBuffers& buffers) const {
    const ImpostorLayer& impostor = plan_.layers[layer];
    const TreeForm& form = model.forms[impostor.form];
    std::vector<PoolBranch> branches;
    TreeExpander expander(*form.cache, model.forest->key);
    for (std::uint32_t t = 0; t < impostor.trees.size(); ++t) {
        expander.expand(impostor.trees[t], [&](const BranchInstance& branch) {
            branches.push_back(pool_branch(branch, form.cache->instances[branch.instance], t));
        });
    }
    buffers.set_trees(impostor.trees, impostor.form);
    buffers.set_branches(branches);
    buffers.upload_commands(lists_of(form, impostor.form, impostor.level, branches));
}

void ImpostorAtlas::step(const ForestModel& model,
                         ForestBuffers& buffers,
                         MaterialTextures& textures) {
    if (pending_.empty()) {
        return;
    }
    const std::uint32_t layer = pending_.back();
    if (!bake_) {
        bake_ = make_bake_state();
    }
    BakeState& bake = *bake_;
    buffers.use(BufferSet::Impostor);
    if (bake.elevation == 0) {
        bake.finished = {kAtlasWidth, kAtlasHeight, {}, {}};
    }
    begin_layer(layer, model, buffers);
    buffers.bind_storage();
    glBindFramebuffer(GL_FRAMEBUFFER, bake.target.name());
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GEQUAL);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    constexpr std::array<GLfloat, 4> kNothing{};
    constexpr GLfloat kFar = 0.0F;
    glClearNamedFramebufferfv(bake.target.name(), GL_COLOR, 0, kNothing.data());
    glClearNamedFramebufferfv(bake.target.name(), GL_COLOR, 1, kNothing.data());
    glClearNamedFramebufferfv(bake.target.name(), GL_DEPTH, 0, &kFar);
    draw_elevation(cylinder_of(plan_, layer), bake.elevation, buffers, textures, bake.frame);
    const auto width = static_cast<GLsizei>(bake.row.width);
    const auto height = static_cast<GLsizei>(bake.row.height);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bake.row.albedos.data());
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bake.row.normals.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    buffers.use(BufferSet::Forest);
    const ImpostorTexels half = halved(bake.row);
    bake.finished.albedos.insert(bake.finished.albedos.end(), half.albedos.begin(),
                                 half.albedos.end());
    bake.finished.normals.insert(bake.finished.normals.end(), half.normals.begin(),
                                 half.normals.end());
    if (++bake.elevation < kElevations) {
        return;
    }
    bake.elevation = 0;
    const auto depth_of = [](const Cylinder& form) {
        return std::hypot(form.radius, 0.5F * (form.high - form.low));
    };
    shade_hollows(bake.finished, kTile,
                  depth_of(cylinder_of(plan_, layer)) /
                      depth_of(plan_.forms[plan_.layers[layer].form].cylinder));
    upload_layer(layer, std::move(bake.finished));
    keys_[layer] = target_keys_[layer];
    filled_[layer] = 1;
    stand_in(layer);
    pending_.pop_back();
    if (pending_.empty()) {
        bake_.reset();
    }
}

} // namespace lsys::view
