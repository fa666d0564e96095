// Impostors: crossed cards with pictures of a plant, for the coarsest levels of detail. Three upright
// directions turned by 60 degrees and a level one have one card each, or three with a third of the
// depth of the plant each. A card is a strip of trapezoids around what it shows. All share one
// atlas. The colour picture has the opacity; the relief has the normals in the frame of the card,
// and in its alpha the depth: 1 to 255 for the back to the front of the part of the plant that the
// card shows, with the card in the middle.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

class LinearTextures;

/// From so many triangles on, each direction has three cards.
inline constexpr std::uint64_t kTrianglesOfSlabs = 40;

class ImpostorBaker {
public:
    /// Takes the pictures of `mesh`, which has texture coordinates. They are the same on every
    /// machine. `pixels`: of the largest extent of the plant where the impostor is shown first;
    /// pictures have about as many texels, so that viewers need no smaller ones at once, in which
    /// thin plants vanish. `triangles`: of the cards, at least 2.
    ImpostorBaker(const Mesh& mesh, float pixels, std::uint64_t triangles);

    /// The cards: `triangles` of them, one less if they are odd, and none where nothing is seen.
    /// `cover`: area of opaque texels, in that of the mesh in each picture. Thin parts
    /// that cover less than a texel are opaque in as many texels as they cover on average. The mean
    /// colour of each picture is that of the mesh, times `tint`; linear.
    [[nodiscard]] Mesh make(double cover, const glm::vec3& tint) const;

private:
    /// One picture. Arrays have tile_ by tile_ texels, rows from above.
    struct View {
        glm::vec3 right{};
        glm::vec3 up{};
        glm::vec3 towards{};
        glm::vec3 low{};  // of the card, along these axes; z: depth of the plant behind it
        glm::vec3 high{}; // the same, z in front
        std::vector<float> coverage;
        std::vector<glm::vec3> colours; // linear
        std::vector<glm::vec3> normals; // along these axes
        std::vector<float> depths;      // 0 to 1
    };

    struct Fragment;
    struct Canvas;
    /// Takes the part `slab` of `slabs_` in depth, from behind, or all of it.
    void take(const Mesh& mesh, int slab, Canvas& canvas, View& view) const;
    /// Returns which texels are opaque.
    std::vector<std::uint8_t> paint(const View& view,
                                    std::size_t tile,
                                    double cover,
                                    const glm::vec3& tint,
                                    Texture& colour,
                                    Texture& relief) const;

    [[nodiscard]] std::size_t texels() const {
        return static_cast<std::size_t>(tile_) * static_cast<std::size_t>(tile_);
    }

    int tile_;            // texels of a side of a picture, 16 to 128
    int slabs_;           // cards of a direction
    std::size_t columns_; // of pictures in the atlas
    std::uint64_t triangles_;
    std::vector<View> views_;
};

} // namespace lsys
