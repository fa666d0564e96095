// SPDX-License-Identifier: MIT
// Terrain: the ground of a forest. One function gives its height to placement, meshes and picking,
// so that trees stand on the drawn ground. Metres, +Y up.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/grey_map.h"
#include "runtime/meshing/mesh.h"
#include "runtime/terrain/noise_layer.h"
#include "runtime/terrain/region.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kMaxOctaves = 16;

/// Fractal noise: a sum of octaves of gradient noise (Perlin 2002, "Improving noise"; Ebert et al.
/// 2003, "Texturing and Modeling", chapter 2).
struct NoiseOptions {
    std::uint64_t seed = 0;
    std::uint32_t octaves = 6; // 1 to kMaxOctaves
    double lacunarity = 2.0;   // ratio of frequencies of successive octaves, 1 to 8
    double gain = 0.5;         // ratio of heights of successive octaves, 0 to 1
    double feature = 250.0;    // m, distance between hills of the first octave
    double height = 50.0;      // m; heights are in [base, base + height], mostly in the middle half
    double base = 0.0;         // m

    friend bool operator==(const NoiseOptions&, const NoiseOptions&) = default;
};

enum class HeightFilter : std::uint8_t {
    Bilinear,
    Bicubic, // Catmull-Rom (Keys 1981, a = -1/2); smooth, may overshoot its samples slightly
};

/// Altitudes of the map: black is at `lowest`, white at `highest`. The centres of the outermost
/// pixels are on the border of the ground, so the ground has columns - 1 by rows - 1 cells.
struct HeightMapOptions {
    double lowest = 0.0;   // m
    double highest = 50.0; // m
    HeightFilter filter = HeightFilter::Bicubic;
};

class Terrain {
public:
    /// Makes a level ground. Errors: a bad region; an altitude not within kMaxCoordinate.
    [[nodiscard]] static Result<Terrain> flat(const Region& region, double altitude = 0.0);
    /// Makes ground of noise, which continues beyond `region` and does not depend on it. Errors: a
    /// bad region; an option out of range, named in the message.
    [[nodiscard]] static Result<Terrain> noise(const Region& region, const NoiseOptions& options);
    /// Makes ground from a map, level beyond its border. Errors: a bad region or altitude; fewer
    /// than 2 by 2 pixels.
    [[nodiscard]] static Result<Terrain>
    height_map(const Region& region, GreyMap map, const HeightMapOptions& options);

    [[nodiscard]] const Region& region() const { return region_; }
    /// Height in m at (x, z) in m. The same on every machine; finite within kMaxCoordinate.
    [[nodiscard]] float height(float x, float z) const;
    /// height() at each point of a grid whose rows run along X; for noise much faster than separate
    /// calls.
    [[nodiscard]] std::vector<float> heights(std::span<const float> x,
                                             std::span<const float> z) const;
    /// A lower and an upper bound of all heights, in m.
    [[nodiscard]] std::array<double, 2> altitudes() const;
    /// Unit normal, by finite differences over slope_step(); one-sided at the border of a height
    /// map.
    [[nodiscard]] glm::vec3 normal(float x, float z) const;
    /// Rise over run, by the finite differences of normal(): 0 is level, 1 is 45 degrees.
    [[nodiscard]] float slope(float x, float z) const;
    /// An upper bound, in m, of the vertical distance between the ground and a mesh of it with square
    /// cells of `cell` m (make_terrain_mesh()), from the second derivatives of the ground. For a
    /// height map, time is linear in the number of pixels.
    [[nodiscard]] double mesh_error(double cell) const;
    /// A hash of all that height() and slope() depend on.
    [[nodiscard]] std::uint64_t digest() const;
    /// Distance in m over which slopes are measured: proportional to the finest feature, at least
    /// 5 cm.
    [[nodiscard]] double slope_step() const { return slope_step_; }

private:
    struct Octave {
        double frequency = 0.0; // noise cells per metre
        double shift_x = 0.0;   // noise cells
        double shift_z = 0.0;
        float layer = 0.0F;     // third coordinate in the noise
        double amplitude = 0.0; // m
        NoiseLayer noise;
    };

    explicit Terrain(const Region& region) : region_(region) {}
    [[nodiscard]] double exact_height(double x, double z) const; // before rounding to float
    [[nodiscard]] double noise_height(double x, double z) const; // m above base_
    void
    add_noise(std::span<const float> x, std::span<const float> z, std::span<double> sums) const;
    [[nodiscard]] double map_height(double x, double z) const;            // m above base_
    [[nodiscard]] std::array<double, 2> gradient(float x, float z) const; // of height(), per m

    Region region_;
    double base_ = 0.0;       // m
    double map_scale_ = 0.0;  // m per grey value
    double slope_step_ = 1.0; // m
    std::vector<Octave> octaves_;
    std::optional<GreyMap> map_;
    HeightFilter filter_ = HeightFilter::Bilinear;
};

inline constexpr std::uint64_t kMaxTerrainCells = std::uint64_t{1} << 24; // a mesh of 0.9 GB

/// Repeating textures of the ground; a tile is `width` by `depth`. Columns run along X, rows along
/// Z.
struct GroundPictures {
    std::shared_ptr<const Texture> colour;  // null: no pictures
    std::shared_ptr<const Texture> normals; // normal map like bark_normals(); null: none
    double origin_x = 0.0;                  // m, corner of a tile
    double origin_z = 0.0;                  // m
    double width = 4.0;                     // m, size of a tile along X
    double depth = 4.0;                     // m, size of a tile along Z
};

/// Options of a mesh of the ground: cells along X and Z.
struct TerrainMeshOptions {
    std::uint32_t columns = 256;
    std::uint32_t rows = 256;
    double texture_size = 0.0; // m of ground per texture; 0: one over the region
    std::uint32_t threads = 0; // 0: as many as the machine has
    GroundPictures pictures;   // if its colour is set, `texture_size` is ignored
    bool tangents = false;     // whether to make Mesh::tangents, along X
};

/// Meshes the terrain's region with two triangles per cell. Vertices have height() and normal() of
/// their x and z; u runs along X and v along Z. The same for any number of threads. Errors: no
/// cells, more than kMaxTerrainCells, a negative texture size, or tiles without area.
[[nodiscard]] Result<Mesh> make_terrain_mesh(const Terrain& terrain,
                                             const TerrainMeshOptions& options);

} // namespace lsys
