// SPDX-License-Identifier: MIT
// Impostors: crossed cards with pictures of a plant, for the coarsest levels of detail. Cards face
// three upright directions, 60 degrees apart, and one direction from above. Each direction has one
// card, or three cards that each show a slab, a third of the depth of the plant. A card is a strip
// of trapezoids around its opaque texels. All cards share one atlas. The colour picture contains
// the opacity. A texel has the colour and the normal of one sample of the plant, chosen by a hash:
// a mean normal would point to the eye wherever a texel shows many leaves, and would be lit like
// none of these leaves. The normal map has the normals in the frame of the card. Its alpha is the
// depth, from 1 at the back to 255 at the front of the part of the plant that the card shows; the
// card lies halfway between. Front and back of a card are two strips with the same picture. The
// normals of the back are those of the front, turned about the axis that points up in the picture.
// Reversed normals, which viewers of glTF give to the back of a face, would show the dark
// undersides of leaves on one of the two sides.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

class LinearTextures;

/// Min triangles of an impostor with three cards per direction.
inline constexpr std::uint64_t kMinSlabTriangles = 48;

class ImpostorBaker {
public:
    /// Renders the pictures of `mesh`, which has texture coordinates. The pictures are the same on
    /// every machine. `pixels`: size on screen of the plant's largest extent where the impostor
    /// first appears. A picture has about as many texels, so that viewers do not begin with
    /// mipmaps, in which thin plants vanish. `triangles`: number of triangles of both sides of all
    /// cards, at least 4.
    ImpostorBaker(const Mesh& mesh, float pixels, std::uint64_t triangles);

    /// Makes the cards. They have `triangles` triangles in total, rounded down to a multiple of 4;
    /// a card without opaque texels has none. `cover`: area of opaque texels / area of the mesh, in
    /// each picture. Thin parts that cover less than a texel are opaque in as many texels as they
    /// cover on average. The mean linear colour of each picture is the mean linear colour of the
    /// mesh times `tint`.
    [[nodiscard]] Mesh make(double cover, const glm::vec3& tint) const;

private:
    /// One picture. Arrays have tile_side_ by tile_side_ texels, row by row from the top.
    struct View {
        glm::vec3 right{};
        glm::vec3 up{};
        glm::vec3 towards_eye{};
        glm::vec3 low{};             // bounds along right, up and towards_eye; z: back of the slab
        glm::vec3 high{};            // z: front of the slab
        std::vector<float> coverage; // fraction of the texel that the plant covers, 0 to 1
        std::vector<glm::vec3> colours; // linear
        std::vector<glm::vec3> normals; // components along right, up and towards_eye
        std::vector<float> depths;      // 0 to 1
    };

    struct Fragment;
    struct Canvas;
    /// Renders slab number `slab` of `slabs_`, counted from back to front, into `view`.
    void render_slab(const Mesh& mesh, int slab, Canvas& canvas, View& view) const;
    /// Writes picture number `tile` to the atlas. Returns 1 for each opaque texel, else 0.
    std::vector<std::uint8_t> paint(const View& view,
                                    std::size_t tile,
                                    double cover,
                                    const glm::vec3& tint,
                                    Texture& colour,
                                    Texture& normal_map) const;

    [[nodiscard]] std::size_t texels() const {
        return static_cast<std::size_t>(tile_side_) * static_cast<std::size_t>(tile_side_);
    }

    int tile_side_;           // texels of a side of a picture, 16 to 128
    int slabs_;               // cards of a direction
    std::size_t columns_;     // columns of pictures in the atlas
    std::uint64_t triangles_; // max number of triangles of all cards
    std::vector<View> views_;
};

} // namespace lsys
