// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/terrain_pass.h"

#include "grammar/base/hash.h"
#include "viewer/gl/impl/program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

// Locations of uniforms, and binding points, in terrain.*.glsl.
constexpr GLuint kHeights = 1;
constexpr GLuint kNoise = 2;
constexpr GLint kOrigins = 0;
constexpr GLint kRanges = static_cast<GLint>(kTerrainLevels);
constexpr GLint kLevels = kRanges + 1;
constexpr GLuint kColour = 3;
constexpr GLuint kNormalMap = 4;
constexpr GLint kTiles = kLevels + 1;
constexpr GLint kMean = kTiles + 1;
constexpr GLint kHasNormalMap = kMean + 1;
constexpr GLuint kCovers = 5;
constexpr GLint kWidestShift = 20;
constexpr GLint kNoiseShifts = 21; // 3 locations
constexpr GLint kCanopy = 24;
constexpr GLint kCanopyRange = 25;
constexpr std::array<double, 3> kNoiseTiles = {173.0, 37.0, 3.1}; // m, in ground_look.glsl
constexpr double kWidestTile = 611.0;                             // m, rotated tile
constexpr std::uint32_t kNoiseTexels = 128;
constexpr GLsizei kPatchIndices = 6 * kPatchCells * kPatchCells;

/// Tileable value noise, 0 to 1: a sum of octaves.
float noise_at(std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
    float sum = 0.0F;
    float weight = 0.0F;
    float part = 1.0F;
    for (std::uint32_t cells = 4; cells <= 64; cells *= 2) {
        const std::uint32_t step = kNoiseTexels / cells;
        const std::uint32_t column = x / step;
        const std::uint32_t row = y / step;
        const auto smooth = [step](std::uint32_t at) {
            const float t = static_cast<float>(at % step) / static_cast<float>(step);
            return t * t * (3.0F - 2.0F * t);
        };
        const float u = smooth(x);
        const float v = smooth(y);
        const auto value = [&](std::uint32_t dx, std::uint32_t dy) {
            return unit_float(
                lattice32((column + dx) % cells, (row + dy) % cells, channel * 16 + cells));
        };
        sum += part * ((1.0F - v) * ((1.0F - u) * value(0, 0) + u * value(1, 0)) +
                       v * ((1.0F - u) * value(0, 1) + u * value(1, 1)));
        weight += part;
        part *= 0.6F;
    }
    // Raises the contrast, because sums of octaves are mostly near the mean.
    return std::clamp(0.5F + 1.6F * (sum / weight - 0.5F), 0.0F, 1.0F);
}

TextureObject make_noise(Device& device) {
    std::vector<std::uint8_t> texels(std::size_t{4} * kNoiseTexels * kNoiseTexels);
    for (std::uint32_t y = 0; y < kNoiseTexels; ++y) {
        for (std::uint32_t x = 0; x < kNoiseTexels; ++x) {
            for (std::uint32_t c = 0; c < 4; ++c) {
                texels[4 * (y * kNoiseTexels + x) + c] =
                    static_cast<std::uint8_t>(std::lround(255.0F * noise_at(x, y, c)));
            }
        }
    }
    TextureObject texture = make_texture(device, GL_TEXTURE_2D);
    const auto size = static_cast<GLsizei>(kNoiseTexels);
    glTextureStorage2D(texture.name(), 8, GL_RGBA8, size, size);
    glTextureSubImage2D(texture.name(), 0, 0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE,
                        texels.data());
    device.add_upload(texels.size());
    glGenerateTextureMipmap(texture.name());
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

} // namespace

TerrainPass::TerrainPass(Device& device)
    : device_(&device), array_(make_vertex_array(device)), grass_array_(make_vertex_array(device)),
      corners_(device), indices_(device), patches_(device) {}

Result<void> TerrainPass::reload(const ShaderSource& shaders) {
    constexpr std::array<const char*, 4> kDefines = {
        "#define TWO_TAPS\n", "#define TWO_TAPS\n#define PICTURE\n",
        "#define TWO_TAPS\n#define CANOPY\n",
        "#define TWO_TAPS\n#define PICTURE\n#define CANOPY\n"};
    std::array<ProgramObject, 4> programs;
    for (std::size_t i = 0; i < programs.size(); ++i) {
        Result<ProgramObject> made =
            make_program(*device_, shaders, "terrain.vert.glsl", "terrain.frag.glsl", kDefines[i]);
        if (!made) {
            return made.error();
        }
        programs[i] = std::move(made.value());
    }
    ProgramObject grass;
    if (device_->quality() > 0) {
        Result<ProgramObject> with_grass =
            make_program(*device_, shaders, "grass.vert.glsl", "leaf.frag.glsl",
                         "#define ONE_TAP\n#define WIND\n");
        if (!with_grass) {
            return with_grass.error();
        }
        grass = std::move(with_grass.value());
    }
    grass_program_ = std::move(grass);
    programs_ = std::move(programs);
    return {};
}

void TerrainPass::show(const Terrain& terrain,
                       const GroundPictures& pictures,
                       float view_distance,
                       GroundCover cover,
                       const MaterialTextures& textures) {
    lod_ = std::make_unique<TerrainLod>(terrain, view_distance);
    const bool has_cover = static_cast<bool>(cover);
    lod_->set_cover(std::move(cover));
    origin_ = {};
    if (pictures.colour != pictures_.colour) {
        colour_ =
            pictures.colour == nullptr ? TextureObject() : textures.make_opaque(*pictures.colour);
        mean_ = pictures.colour == nullptr ? glm::vec3(0.0F) : mean_colour(*pictures.colour);
    }
    if (pictures.normals != pictures_.normals) {
        normals_ = pictures.normals == nullptr ? TextureObject()
                                               : textures.make_normals(*pictures.normals);
    }
    pictures_ = pictures;
    if (!noise_) {
        noise_ = make_noise(*device_);
        std::vector<std::array<std::uint8_t, 2>> corners;
        std::vector<std::uint8_t> indices;
        constexpr std::uint32_t kVerticesPerRow = kPatchCells + 1;
        for (std::uint32_t z = 0; z < kVerticesPerRow; ++z) {
            for (std::uint32_t x = 0; x < kVerticesPerRow; ++x) {
                corners.push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(z)});
                if (x < kPatchCells && z < kPatchCells) {
                    const std::uint32_t a = z * kVerticesPerRow + x;
                    for (const std::uint32_t i : {a, a + kVerticesPerRow, a + kVerticesPerRow + 1,
                                                  a, a + kVerticesPerRow + 1, a + 1}) {
                        indices.push_back(static_cast<std::uint8_t>(i));
                    }
                }
            }
        }
        corners_.fill(std::span<const std::array<std::uint8_t, 2>>(corners));
        indices_.fill(std::span<const std::uint8_t>(indices));
        const GLuint array = array_.name();
        glEnableVertexArrayAttrib(array, 0);
        glVertexArrayAttribIFormat(array, 0, 2, GL_UNSIGNED_BYTE, 0);
        glVertexArrayAttribBinding(array, 0, 0);
        glVertexArrayVertexBuffer(array, 0, corners_.name(), 0, 2);
        glEnableVertexArrayAttrib(array, 1);
        glVertexArrayAttribIFormat(array, 1, 3, GL_INT, 0);
        glVertexArrayAttribBinding(array, 1, 1);
        glVertexArrayBindingDivisor(array, 1, 1);
        glVertexArrayElementBuffer(array, indices_.name());
    }
    const auto size = static_cast<GLsizei>(kHeightTexels);
    heights_ = make_texture(*device_, GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(heights_.name(), 1, GL_R32F, size, size,
                       static_cast<GLsizei>(lod_->levels()));
    glTextureParameteri(heights_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(heights_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    covers_ = {};
    if (has_cover) {
        covers_ = make_texture(*device_, GL_TEXTURE_2D_ARRAY);
        glTextureStorage3D(covers_.name(), 1, GL_R32F, size, size,
                           static_cast<GLsizei>(lod_->levels()));
        glTextureParameteri(covers_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(covers_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        constexpr GLfloat kNone = 0.0F;
        glClearTexImage(covers_.name(), 0, GL_RED, GL_FLOAT, &kNone);
    }
}

void TerrainPass::set_origin(const glm::dvec3& origin) {
    lod_->set_origin(origin);
    origin_ = origin;
}

void TerrainPass::prepare(const Frustum& frustum, float tree_range) {
    tree_range_ = tree_range;
    eye_ = frustum.eye;
    lod_->select(frustum);
    const auto size = static_cast<GLsizei>(kHeightTexels);
    for (const std::uint32_t level : lod_->changed()) {
        const std::vector<float>& heights = lod_->grid(level).heights;
        glTextureSubImage3D(heights_.name(), 0, 0, 0, static_cast<GLint>(level), size, size, 1,
                            GL_RED, GL_FLOAT, heights.data());
        device_->add_upload(heights.size() * sizeof(float));
        if (const std::vector<float>& covers = lod_->grid(level).covers; !covers.empty()) {
            glTextureSubImage3D(covers_.name(), 0, 0, 0, static_cast<GLint>(level), size, size, 1,
                                GL_RED, GL_FLOAT, covers.data());
            device_->add_upload(covers.size() * sizeof(float));
        }
    }
}

void TerrainPass::set_noise() const {
    glBindTextureUnit(kNoise, noise_.name());
    std::array<GLfloat, 6> shifts{};
    for (std::size_t i = 0; i < kNoiseTiles.size(); ++i) {
        shifts[2 * i] = static_cast<GLfloat>(std::fmod(origin_.x / kNoiseTiles[i], 1.0));
        shifts[2 * i + 1] = static_cast<GLfloat>(std::fmod(origin_.z / kNoiseTiles[i], 1.0));
    }
    glUniform2fv(kNoiseShifts, 3, shifts.data());
    const glm::dvec2 turned(0.8 * origin_.x - 0.6 * origin_.z, 0.6 * origin_.x + 0.8 * origin_.z);
    glUniform2f(kWidestShift, static_cast<GLfloat>(std::fmod(turned.x / kWidestTile, 1.0)),
                static_cast<GLfloat>(std::fmod(turned.y / kWidestTile, 1.0)));
}

void TerrainPass::draw_grass(FrameStats& stats) const {
    // Locations of uniforms in grass.vert.glsl.
    constexpr GLint kHeightsOrigin = 0;
    constexpr GLint kLattice = 1;
    constexpr GLint kSides = 2;
    constexpr double kCell = 0.32;                          // m
    constexpr std::array<GLsizei, 3> kCells = {0, 64, 112}; // along a side, by quality
    constexpr GLsizei kBlades = 16;                         // per cell
    const GLsizei cells = kCells[device_->quality()];
    const auto reach = 0.5F * static_cast<float>(kCell) * static_cast<float>(cells);
    if (!grass_program_ || lod_->eye_height() > reach) {
        return;
    }
    const auto cell_of = [&](double place) {
        return static_cast<GLint>(std::floor(place / kCell));
    };
    const auto lattice_of = [&](double place) { // modulo 2^32, as in the shader
        return static_cast<GLint>(
            static_cast<std::uint32_t>(static_cast<std::int64_t>(std::round(place / kCell))));
    };
    glUseProgram(grass_program_.name());
    set_noise();
    const glm::ivec2& origin = lod_->grid(0).origin;
    glUniform2i(kHeightsOrigin, origin.x, origin.y);
    glUniform4i(kLattice, cell_of(static_cast<double>(eye_.x)) - cells / 2,
                cell_of(static_cast<double>(eye_.z)) - cells / 2, lattice_of(origin_.x),
                lattice_of(origin_.z));
    glUniform2i(kSides, cells, kBlades);
    glBindVertexArray(grass_array_.name());
    glDrawArraysInstanced(GL_TRIANGLES, 0, 9 * kBlades, cells * cells);
    ++stats.draws;
    stats.triangles += std::uint64_t{3} * static_cast<std::uint64_t>(kBlades) *
                       static_cast<std::uint64_t>(cells) * static_cast<std::uint64_t>(cells);
}

FrameStats TerrainPass::draw() {
    const bool has_canopy = covers_ && tree_range_ > 0.0F && std::isfinite(tree_range_);
    const ProgramObject& program = programs_[(colour_ ? 1U : 0U) + (has_canopy ? 2U : 0U)];
    glUseProgram(program.name());
    if (colour_) {
        // Corner of a tile near the origin, because binary32 is too coarse for coordinates far from
        // it.
        const auto corner = [](double first, double origin, double size) {
            return static_cast<float>(origin == 0.0 ? first : std::fmod(first - origin, size));
        };
        glUniform4f(kTiles, corner(pictures_.origin_x, origin_.x, pictures_.width),
                    corner(pictures_.origin_z, origin_.z, pictures_.depth),
                    static_cast<float>(pictures_.width), static_cast<float>(pictures_.depth));
        glUniform3f(kMean, mean_.r, mean_.g, mean_.b);
        glUniform1i(kHasNormalMap, normals_ ? 1 : 0);
        glBindTextureUnit(kColour, colour_.name());
        glBindTextureUnit(kNormalMap, normals_ ? normals_.name() : colour_.name());
    } else {
        set_noise();
    }
    if (has_canopy) {
        // The colour of the canopy appears before the trees end, so that no border is visible.
        // Both are fractions of tree_range_.
        constexpr float kBegin = 0.45F;
        constexpr float kEnd = 0.95F;
        glUniform3f(kCanopy, canopy_.r, canopy_.g, canopy_.b);
        glUniform2f(kCanopyRange, kBegin * tree_range_, kEnd * tree_range_);
    }
    FrameStats stats = draw_with(program);
    if (!colour_) {
        draw_grass(stats);
    }
    return stats;
}

FrameStats TerrainPass::draw_with(const ProgramObject& program) {
    FrameStats stats;
    const std::vector<TerrainPatch>& patches = lod_->patches();
    if (patches.empty()) {
        return stats;
    }
    static_assert(sizeof(TerrainPatch) == 12);
    patches_.fill(std::span<const TerrainPatch>(patches));
    glVertexArrayVertexBuffer(array_.name(), 1, patches_.name(), 0, sizeof(TerrainPatch));
    glUseProgram(program.name());
    std::array<GLint, std::size_t{2} * kTerrainLevels> origins{};
    for (std::uint32_t level = 0; level < lod_->levels(); ++level) {
        origins[std::size_t{2} * level] = lod_->grid(level).origin.x;
        origins[std::size_t{2} * level + 1] = lod_->grid(level).origin.y;
    }
    glUniform2iv(kOrigins, static_cast<GLsizei>(kTerrainLevels), origins.data());
    glUniform4f(kRanges, kFinestCell, TerrainLod::range(0),
                TerrainLod::morph_start(0) / TerrainLod::range(0), lod_->eye_height());
    glUniform1i(kLevels, static_cast<GLint>(lod_->levels()));
    glBindTextureUnit(kHeights, heights_.name());
    glBindTextureUnit(kCovers, covers_ ? covers_.name() : heights_.name());
    glEnable(GL_CULL_FACE);
    glBindVertexArray(array_.name());
    glDrawElementsInstanced(GL_TRIANGLES, kPatchIndices, GL_UNSIGNED_BYTE, nullptr,
                            static_cast<GLsizei>(patches.size()));
    glDisable(GL_CULL_FACE);
    stats.draws = 1;
    stats.triangles = patches.size() * kPatchIndices / 3;
    return stats;
}

std::uint64_t TerrainPass::texture_bytes() const {
    std::uint64_t texels = std::uint64_t{kNoiseTexels} * kNoiseTexels; // in the finest mip levels
    for (const auto& picture : {pictures_.colour, pictures_.normals}) {
        texels += picture == nullptr ? 0 : std::uint64_t{picture->width} * picture->height;
    }
    return lod_ == nullptr ? 0
                           : std::uint64_t{4} * kHeightTexels * kHeightTexels * lod_->levels() +
                                 std::uint64_t{4} * texels * 4 / 3;
}

std::vector<float> TerrainPass::read_heights(std::uint32_t level) const {
    std::vector<float> heights(std::size_t{kHeightTexels} * kHeightTexels);
    const auto size = static_cast<GLsizei>(kHeightTexels);
    glGetTextureSubImage(heights_.name(), 0, 0, 0, static_cast<GLint>(level), size, size, 1, GL_RED,
                         GL_FLOAT, static_cast<GLsizei>(heights.size() * sizeof(float)),
                         heights.data());
    return heights;
}

} // namespace lsys::view
