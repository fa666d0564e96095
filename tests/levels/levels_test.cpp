// SPDX-License-Identifier: MIT
// Levels of detail of samples: each has fewer triangles than the previous one and looks like the
// plant at its distance. The test draws its own pictures, with opacity and without light.
#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/impl/impostor.h"
#include "runtime/meshing/impl/thinning.h"
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/plant.h"
#include "tests/support/plants.h"
#include "tests/support/sample_plants.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys {

namespace {

// View directions between the directions for which the levels are fitted: turns about +Y and
// elevations of the eye, radians.
constexpr std::array<float, 8> kTurns{0.39F, 1.18F, 1.96F, 2.75F, 3.53F, 4.32F, 5.11F, 5.89F};
constexpr std::array<float, 2> kTilts{0.0F, 0.5F};
// Limits of the number of samples along the largest extent. Levels shown in few pixels have more
// samples than pixels.
constexpr int kMinSamples = 192;
constexpr int kMaxSamples = 512;
constexpr double kMaxColourDifference = 0.02;
constexpr double kMinFactor = 2.0; // triangles of a level / triangles of the next
constexpr double kMaxFactor = 3.0;
// Without an impostor, the last level has few branches of many triangles each, so the ratio may be
// larger.
constexpr double kMaxLastFactor = 3.3;
constexpr double kManyTriangles = 150.0;     // kMaxFactor applies to levels with more triangles
constexpr double kMaxImpostorDistance = 5.0; // pixels

/// A silhouette in samples, and its colour.
struct Picture {
    int size = 0; // samples along each side
    std::vector<std::uint8_t> covered;
    glm::dvec3 colour{0.0}; // mean over the silhouette
    double area = 0.0;      // samples
};

float linear(std::uint8_t byte) {
    const float c = static_cast<float>(byte) / 255.0F;
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/// Texels of a material as linear colours with opacity.
struct Texels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec4> colours;

    explicit Texels(const Material& material) {
        Texture texture;
        if (material.textured && material.picture != nullptr) {
            texture = *material.picture;
        } else if (material.textured && has_texture(material.kind)) {
            texture = material_texture(material.kind);
        }
        width = texture.width;
        height = texture.height;
        for (std::size_t i = 0; i + 3 < texture.texels.size(); i += 4) {
            colours.emplace_back(linear(texture.texels[i]), linear(texture.texels[i + 1]),
                                 linear(texture.texels[i + 2]),
                                 static_cast<float>(texture.texels[i + 3]) / 255.0F);
        }
    }
    [[nodiscard]] glm::vec4 at(const glm::vec2& place) const {
        if (colours.empty()) {
            return glm::vec4(1.0F);
        }
        const auto index = [](float value, std::uint32_t size) {
            const float part = value - std::floor(value);
            return std::min(static_cast<std::uint32_t>(part * static_cast<float>(size)), size - 1);
        };
        return colours[std::size_t{index(place.y, height)} * width + index(place.x, width)];
    }
};

/// A mesh with the texels of its parts.
struct Drawing {
    const Mesh& mesh;
    std::vector<std::uint32_t> indices;
    std::vector<Texels> texels; // by part

    explicit Drawing(const Mesh& drawn) : mesh(drawn) {
        TriangleReader reader(drawn.indices);
        for (std::uint64_t i = 0; i < drawn.indices.size(); ++i) {
            indices.push_back(reader[i]);
        }
        for (const MeshPart& part : drawn.parts) {
            texels.emplace_back(drawn.materials[part.material]);
        }
    }
};

/// Draws a mesh into a square, in which the largest extent of `frame` takes `samples`, seen along -Z
/// after a turn and a tilt.
Picture draw(const Drawing& drawing, const Bounds& frame, int samples, float turn, float tilt) {
    const Mesh& mesh = drawing.mesh;
    const glm::vec3 middle = 0.5F * (frame.low + frame.high);
    const glm::vec3 half = frame.high - middle;
    const float radius = std::hypot(half.x, half.z); // horizontal
    const float reach = std::max(radius, std::cos(tilt) * half.y + std::sin(tilt) * radius);
    const float largest = std::max({half.x, half.y, half.z});
    const float scale = 0.5F * static_cast<float>(samples) / largest;
    const int size = static_cast<int>(std::ceil(2.0F * scale * reach)) + 1;
    // Shift each view by a different fraction of a sample; otherwise samples would hit a stem in
    // the middle of every view in the same way.
    const float number = 1.0F + 8.0F * turn + 16.0F * tilt;
    const glm::vec3 shift(glm::fract(0.618F * number), glm::fract(0.414F * number), 0.0F);
    std::vector<glm::vec3> places;
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p = position - middle;
        const float near = std::cos(turn) * p.z - std::sin(turn) * p.x;
        places.push_back(shift +
                         scale * glm::vec3(std::cos(turn) * p.x + std::sin(turn) * p.z + reach,
                                           std::cos(tilt) * p.y - std::sin(tilt) * near + reach,
                                           std::cos(tilt) * near + std::sin(tilt) * p.y));
    }
    const std::size_t count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    std::vector<float> depth(count, -std::numeric_limits<float>::infinity());
    std::vector<glm::vec3> colours(count);
    for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
        const MeshPart& part = mesh.parts[k];
        const Material& material = mesh.materials[part.material];
        const Texels& texels = drawing.texels[k];
        for (std::uint64_t t = part.first_index; t + 2 < part.first_index + part.index_count;
             t += 3) {
            const std::array<std::uint32_t, 3> v{drawing.indices[t], drawing.indices[t + 1],
                                                 drawing.indices[t + 2]};
            const std::array<glm::vec3, 3> p{places[v[0]], places[v[1]], places[v[2]]};
            // Pixels whose centres may be inside.
            const auto first = [](float low) {
                return std::max(0, static_cast<int>(std::ceil(low - 0.5F)));
            };
            const auto last = [&](float high) {
                return std::min(size - 1, static_cast<int>(std::floor(high - 0.5F)));
            };
            const int begin_x = first(std::min({p[0].x, p[1].x, p[2].x}));
            const int begin_y = first(std::min({p[0].y, p[1].y, p[2].y}));
            const int end_x = last(std::max({p[0].x, p[1].x, p[2].x}));
            const int end_y = last(std::max({p[0].y, p[1].y, p[2].y}));
            const auto cross = [](const glm::vec3& a, const glm::vec3& b, float x, float y) {
                return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
            };
            const float whole = cross(p[0], p[1], p[2].x, p[2].y);
            if (whole == 0.0F) {
                continue;
            }
            for (int y = begin_y; y <= end_y; ++y) {
                for (int x = begin_x; x <= end_x; ++x) {
                    const float px = static_cast<float>(x) + 0.5F;
                    const float py = static_cast<float>(y) + 0.5F;
                    const float a = cross(p[1], p[2], px, py) / whole;
                    const float b = cross(p[2], p[0], px, py) / whole;
                    const float c = 1.0F - a - b;
                    const std::size_t at =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                        static_cast<std::size_t>(x);
                    const float z = a * p[0].z + b * p[1].z + c * p[2].z;
                    if (a < 0.0F || b < 0.0F || c < 0.0F || z <= depth[at]) {
                        continue;
                    }
                    glm::vec4 texel(1.0F);
                    if (!mesh.texture_coordinates.empty()) {
                        texel = texels.at(a * mesh.texture_coordinates[v[0]] +
                                          b * mesh.texture_coordinates[v[1]] +
                                          c * mesh.texture_coordinates[v[2]]);
                    }
                    if (material.cut_out && texel.a < 0.5F) {
                        continue;
                    }
                    depth[at] = z;
                    colours[at] = glm::vec3(material.colour) * glm::vec3(texel);
                }
            }
        }
    }
    Picture picture;
    picture.size = size;
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_covered = depth[i] > -std::numeric_limits<float>::infinity();
        picture.covered.push_back(is_covered ? 1 : 0);
        if (is_covered) {
            picture.area += 1.0;
            picture.colour += glm::dvec3(colours[i]);
        }
    }
    picture.colour /= std::max(picture.area, 1.0);
    return picture;
}

/// Mean distance in samples from the covered samples of `from` to the nearest covered sample of
/// `to`: along rows, then along columns (Felzenszwalb and Huttenlocher 2012, by direct search).
double mean_distance(const Picture& from, const Picture& to) {
    const int size = to.size;
    const auto at = [size](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
               static_cast<std::size_t>(x);
    };
    // Distance to the nearest covered sample in the row.
    std::vector<float> along(to.covered.size(), static_cast<float>(size));
    for (int y = 0; y < size; ++y) {
        for (const bool forwards : {true, false}) {
            auto last = static_cast<float>(size);
            for (int k = 0; k < size; ++k) {
                const int x = forwards ? k : size - 1 - k;
                last = to.covered[at(x, y)] != 0 ? 0.0F : last + 1.0F;
                along[at(x, y)] = std::min(along[at(x, y)], last);
            }
        }
    }
    double sum = 0.0;
    double samples = 0.0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (from.covered[at(x, y)] == 0) {
                continue;
            }
            float best = along[at(x, y)];
            for (int away = 1; away < size && static_cast<float>(away) < best; ++away) {
                for (const int other : {y - away, y + away}) {
                    if (other >= 0 && other < size) {
                        best = std::min(best,
                                        std::hypot(static_cast<float>(away), along[at(x, other)]));
                    }
                }
            }
            sum += static_cast<double>(best);
            samples += 1.0;
        }
    }
    return samples > 0.0 ? sum / samples : 0.0;
}

/// Mean distance in samples from the silhouette of one picture to that of the other, the larger of
/// the two directions: the modified Hausdorff distance (Dubuisson and Jain 1994).
double silhouette_distance(const Picture& a, const Picture& b) {
    return std::max(mean_distance(a, b), mean_distance(b, a));
}

/// Difference of a mesh from the finest one, over all views.
struct Difference {
    double silhouette = 0.0; // mean over views, pixels
    double area = 0.0;       // ratio of the covered areas
    double colour = 0.0;     // largest difference of a channel as a fraction of the brightest one
};

/// Compares two meshes with `samples` samples along the largest extent, which takes `pixels` pixels
/// where the level is shown.
Difference compare(
    const Drawing& fine, const Drawing& coarse, const Bounds& frame, int samples, float pixels) {
    Difference result;
    double fine_area = 0.0;
    double coarse_area = 0.0;
    glm::dvec3 fine_colour(0.0);
    glm::dvec3 coarse_colour(0.0);
    for (const float turn : kTurns) {
        for (const float tilt : kTilts) {
            const Picture a = draw(fine, frame, samples, turn, tilt);
            const Picture b = draw(coarse, frame, samples, turn, tilt);
            result.silhouette += silhouette_distance(a, b);
            fine_area += a.area;
            coarse_area += b.area;
            fine_colour += a.area * a.colour;
            coarse_colour += b.area * b.colour;
        }
    }
    result.silhouette *= static_cast<double>(pixels) / static_cast<double>(samples) /
                         static_cast<double>(kTurns.size() * kTilts.size());
    fine_colour /= std::max(fine_area, 1e-9);
    coarse_colour /= std::max(coarse_area, 1e-9);
    const glm::dvec3 off = glm::abs(fine_colour - coarse_colour);
    result.area = coarse_area / std::max(fine_area, 1e-9);
    result.colour = std::max({off.x, off.y, off.z}) /
                    std::max({fine_colour.x, fine_colour.y, fine_colour.z, 1e-9});
    return result;
}

std::uint64_t triangles_of(const Mesh& mesh) {
    return mesh.indices.size() / 3;
}

Bounds bounds_of(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    return bounds;
}

DetailLevels planned(const Plant& plant, const MeshOptions& options) {
    DetailLevels levels;
    REQUIRE(plan_detail_levels(plant.skeleton, plant.user_meshes, options, {.pictures = true},
                               levels) == std::nullopt);
    return levels;
}

Mesh level_mesh(const Plant& plant, const DetailLevels& levels, std::size_t number) {
    Mesh mesh;
    REQUIRE(make_detail_mesh(plant.skeleton, plant.user_meshes, levels, number, {.threads = 1},
                             mesh) == std::nullopt);
    return mesh;
}

} // namespace

namespace {

const std::array<const char*, 10> kSamplesOfLevels{
    "carey-type-0", "carey-type-1",        "carey-type-2", "carey-3-2-2",    "abop-1-24f",
    "abop-2-8a",    "abop-2-6-monopodial", "abop-lychnis", "abop-1-25-bush", "crankshaw-7-3"};

/// A level of a sample, compared with its finest one.
struct LevelResult {
    std::uint64_t planned = 0; // triangles
    std::uint64_t triangles = 0;
    double factor = 1.0;   // triangles of the previous level / own triangles
    float pixels = 0.0F;   // largest extent at the distance where the level is shown
    Difference difference; // silhouette in pixels at the distance where the level is shown
};

std::vector<LevelResult> measure_levels(const std::string& name) {
    const Plant plant = test::sample_plant(name);
    const DetailLevels levels = planned(plant, {.threads = 1});
    const Mesh finest = level_mesh(plant, levels, 0);
    const Bounds frame = bounds_of(finest);
    const Drawing fine(finest);
    std::vector<LevelResult> results;
    for (std::size_t k = 0; k < levels.levels.size(); ++k) {
        const Mesh mesh = level_mesh(plant, levels, k);
        LevelResult& result = results.emplace_back();
        result.planned = levels.levels[k].triangles;
        result.triangles = triangles_of(mesh);
        result.pixels = levels.levels[k].pixels;
        if (k > 0) {
            result.factor = static_cast<double>(levels.levels[k - 1].triangles) /
                            static_cast<double>(result.triangles);
            const int samples =
                std::clamp(static_cast<int>(result.pixels), kMinSamples, kMaxSamples);
            result.difference = compare(fine, Drawing(mesh), frame, samples, result.pixels);
        }
    }
    return results;
}

} // namespace

TEST_CASE("levels of samples have fewer triangles and look alike at their distance", "[levels]") {
    // The other samples take longer; only the table of levels measures them.
    const std::string name = GENERATE("carey-type-0", "carey-type-1", "carey-3-2-2", "abop-1-24f",
                                      "abop-2-8a", "abop-2-6-monopodial", "abop-lychnis");
    const std::vector<LevelResult> results = measure_levels(name);
    for (std::size_t k = 0; k < results.size(); ++k) {
        const LevelResult& level = results[k];
        CAPTURE(name, k, level.triangles, level.factor, level.pixels, level.difference.silhouette,
                level.difference.area, level.difference.colour);
        CHECK(level.planned == level.triangles);
        CHECK(level.difference.colour <= kMaxColourDifference);
        if (k > 0) {
            CHECK(level.factor >= kMinFactor);
            CHECK(level.factor <= kMaxFactor);
            CHECK(level.difference.area == Approx(1.0).margin(0.06));
        }
    }
    CHECK(results.back().triangles <= kMinDetailTriangles);
    CHECK(results.back().difference.silhouette <= kMaxImpostorDistance);
}

TEST_CASE("each level has a third to a half of the triangles of the previous level", "[levels]") {
    const std::string name = GENERATE(from_range(kSamplesOfLevels));
    const Plant plant = test::sample_plant(name);
    const DetailLevels levels = planned(plant, {});
    REQUIRE(levels.levels.size() >= 6);
    for (std::size_t k = 1; k < levels.levels.size(); ++k) {
        const double before = static_cast<double>(levels.levels[k - 1].triangles);
        CAPTURE(name, k, before, levels.levels[k].triangles);
        CHECK(before >= kMinFactor * static_cast<double>(levels.levels[k].triangles));
        CHECK(before <= kMaxFactor * static_cast<double>(levels.levels[k].triangles));
    }
    CHECK(levels.levels.back().is_impostor);
    CHECK(levels.levels.back().triangles <= kMinDetailTriangles);
}

TEST_CASE("levels without impostors have fewer triangles too", "[levels]") {
    const std::string name = GENERATE("abop-lychnis", "carey-type-0", "abop-2-8a");
    const Plant plant = test::sample_plant(name);
    DetailLevels levels;
    REQUIRE(plan_detail_levels(plant.skeleton, plant.user_meshes, {.threads = 1}, {}, levels) ==
            std::nullopt);
    for (std::size_t k = 1; k < levels.levels.size(); ++k) {
        const DetailLevel& level = levels.levels[k];
        const auto before = static_cast<double>(levels.levels[k - 1].triangles);
        CAPTURE(name, k, before, level.triangles);
        CHECK(level.triangles == triangles_of(level_mesh(plant, levels, k)));
        CHECK(before >= kMinFactor * static_cast<double>(level.triangles));
        CHECK(before <= (before > kManyTriangles ? kMaxFactor : kMaxLastFactor) *
                            static_cast<double>(level.triangles));
        CHECK_FALSE(level.is_impostor);
        CHECK(level.tint == glm::vec3(1.0F));
    }
    CHECK(levels.levels.back().triangles <= kMinDetailTriangles);
}

TEST_CASE("levels that are fitted later equal levels fitted at once", "[levels]") {
    const Plant plant = test::sample_plant("carey-type-1");
    const MeshOptions options{.threads = 1};
    const DetailLevels all = planned(plant, options);
    constexpr DetailChain kLater{.pictures = true, .first_fitted = kNoDetailLevel};
    DetailLevels later;
    REQUIRE(plan_detail_levels(plant.skeleton, plant.user_meshes, options, kLater, later) ==
            std::nullopt);
    REQUIRE(later.levels.size() == all.levels.size());
    std::vector<bool> fitted_levels(later.levels.size());
    fitted_levels[2] = true;
    fitted_levels.back() = true;
    REQUIRE(fit_detail_levels(plant.skeleton, plant.user_meshes, options, kLater, fitted_levels,
                              later) == std::nullopt);
    for (std::size_t k = 0; k < fitted_levels.size(); ++k) {
        const DetailLevel& level = later.levels[k];
        CHECK(level.pixels == all.levels[k].pixels);
        CHECK(level.wood_scale == (fitted_levels[k] ? all.levels[k].wood_scale : 1.0F));
        CHECK(level.tint == (fitted_levels[k] ? all.levels[k].tint : glm::vec3(1.0F)));
        if (fitted_levels[k]) {
            CHECK(level.triangles == all.levels[k].triangles);
            CHECK(level.cover == all.levels[k].cover);
        }
    }
    // The coarsest level is always fitted, because --level uses it for all numbers beyond the last
    // level.
    DetailLevels coarsest;
    REQUIRE(plan_detail_levels(plant.skeleton, plant.user_meshes, options,
                               {.pictures = true, .first_fitted = kMaxDetailLevel},
                               coarsest) == std::nullopt);
    CHECK(coarsest.levels.back().cover == all.levels.back().cover);
}

TEST_CASE("a short chain goes from the finest level to the coarsest", "[levels]") {
    const Plant plant = test::sample_plant("carey-type-0");
    const DetailLevels all = planned(plant, {});
    for (std::uint32_t count = 1; count <= all.levels.size() + 1; ++count) {
        DetailLevels few;
        REQUIRE(
            plan_detail_levels(plant.skeleton, plant.user_meshes, {},
                               {.pictures = true, .first_fitted = kNoDetailLevel, .count = count},
                               few) == std::nullopt);
        const std::size_t expected = std::min<std::size_t>(count, all.levels.size());
        CAPTURE(count);
        REQUIRE(few.levels.size() == expected);
        CHECK_FALSE(few.levels.front().is_impostor);
        CHECK(few.levels.back().is_impostor == (count > 1));
        // A shorter chain has levels of the whole chain, with steps between them that differ by at
        // most one.
        std::size_t at = 0;
        std::set<std::size_t> steps;
        for (std::size_t k = 1; k < expected; ++k) {
            std::size_t step = 1;
            while (at + step < all.levels.size() &&
                   all.levels[at + step].pixels != few.levels[k].pixels) {
                ++step;
            }
            REQUIRE(at + step < all.levels.size());
            steps.insert(step);
            at += step;
        }
        CHECK((steps.empty() || *steps.rbegin() - *steps.begin() <= 1));
    }
}

TEST_CASE("cards have the requested number of triangles", "[levels]") {
    const Plant plant = test::sample_plant("abop-lychnis");
    Mesh finest;
    REQUIRE(make_mesh(plant.skeleton, plant.user_meshes, {.threads = 1}, finest) == std::nullopt);
    for (const std::uint64_t triangles : {4U, 8U, 24U, 40U, 48U, 100U, 184U}) {
        CAPTURE(triangles);
        const ImpostorBaker baker(finest, 60.0F, triangles);
        const Mesh cards = baker.make(1.0, glm::vec3(1.0F));
        CHECK(triangles_of(cards) == triangles);
        // Cards lie within the bounding sphere of the box of the plant, and their front faces have
        // the direction of their normals.
        const Bounds frame = bounds_of(finest);
        const glm::vec3 middle = 0.5F * (frame.low + frame.high);
        for (const glm::vec3& position : cards.positions) {
            CHECK(glm::distance(position, middle) <= 1.05F * glm::distance(frame.high, middle));
        }
        TriangleReader indices(cards.indices);
        for (std::uint64_t i = 0; i < cards.indices.size(); i += 3) {
            const glm::vec3& a = cards.positions[indices[i]];
            const glm::vec3 normal = glm::cross(cards.positions[indices[i + 1]] - a,
                                                cards.positions[indices[i + 2]] - a);
            CHECK(glm::dot(normal, cards.normals[indices[i]]) >= 0.0F);
        }
    }
}

// The table of docs/files.md: tests_levels "[table]"
TEST_CASE("table of levels", "[.][table]") {
    std::printf("| sample | triangles | silhouette, pixels | colour |\n|---|---|---|---|\n");
    for (const char* const name : kSamplesOfLevels) {
        std::string triangles;
        std::string silhouettes;
        double colour = 0.0;
        for (const LevelResult& level : measure_levels(name)) {
            const char* const comma = triangles.empty() ? "" : ", ";
            triangles += comma + std::to_string(level.triangles);
            std::array<char, 32> digits{};
            std::snprintf(digits.data(), digits.size(), "%.1f", level.difference.silhouette);
            silhouettes += comma + std::string(digits.data());
            colour = std::max(colour, level.difference.colour);
        }
        std::printf("| %s | %s | %s | %.1f %% |\n", name, triangles.c_str(), silhouettes.c_str(),
                    100.0 * colour);
        std::fflush(stdout);
    }
}

TEST_CASE("a finer level keeps all paths of a coarser level", "[levels]") {
    const Plant plant = test::sample_plant("carey-3-2-2");
    const DetailLevels levels = planned(plant, {.threads = 1});
    const ThinningOrder order = thinning_order(plant.skeleton);
    // In the order, a path comes after the path from which it branches.
    for (std::size_t i = 0; i < plant.skeleton.segments.size(); ++i) {
        const std::uint32_t parent = plant.skeleton.segments[i].parent;
        if (parent < i) {
            CHECK(order.path_ranks[parent] <= order.path_ranks[i]);
        }
    }
    for (std::size_t k = 1; k < levels.levels.size() && !levels.levels[k].is_impostor; ++k) {
        CHECK(levels.levels[k].paths <= levels.levels[k - 1].paths);
        CHECK(levels.levels[k].foliage <= levels.levels[k - 1].foliage);
    }
    CHECK(std::set(order.foliage.begin(), order.foliage.end()).size() ==
          plant.skeleton.objects.size() + plant.skeleton.polygons.size());
}

TEST_CASE("the kept leaves have the area of all leaves", "[levels]") {
    Skeleton skeleton;
    test::RandomNumbers numbers(7);
    double area = 0.0;
    for (int i = 0; i < 1000; ++i) {
        PlacedObject leaf;
        leaf.kind = TurtleOperation::Leaf;
        leaf.position = 10.0F * numbers.direction();
        leaf.size = numbers.uniform(0.5F, 1.5F);
        leaf.colour = static_cast<std::uint16_t>(2 + i % 3);
        area += static_cast<double>(leaf.size) * static_cast<double>(leaf.size);
        skeleton.objects.push_back(leaf);
    }
    const ThinningOrder order = thinning_order(skeleton);
    const std::vector<FoliageShape> shapes = foliage_shapes(order, {}, 0);
    for (const std::uint64_t kept : {1000U, 300U, 30U, 3U, 1U}) {
        Skeleton thin;
        LargeVector<std::uint32_t> segments;
        thin_skeleton(skeleton, order, {.foliage = kept}, shapes, shapes, thin, segments);
        REQUIRE(thin.objects.size() == kept);
        double kept_area = 0.0;
        std::map<ItemColour, double> by_colour;
        for (const PlacedObject& leaf : thin.objects) {
            const double leaf_area =
                static_cast<double>(leaf.size) * static_cast<double>(leaf.size);
            kept_area += leaf_area;
            by_colour[leaf.colour] += leaf_area;
        }
        CHECK(kept_area == Approx(area).epsilon(1e-4));
        if (kept >= 3) { // each colour keeps its share of the area
            CHECK(by_colour.size() == 3);
            for (const auto& [colour, part] : by_colour) {
                CHECK(part == Approx(area / 3.0).epsilon(0.05));
            }
        }
    }
}

TEST_CASE("levels do not depend on threads", "[levels]") {
    const Plant plant = test::sample_plant("carey-3-2-2");
    const DetailLevels one = planned(plant, {.threads = 1});
    const DetailLevels four = planned(plant, {.threads = 4});
    REQUIRE(one.levels.size() == four.levels.size());
    for (std::size_t k = 0; k < one.levels.size(); ++k) {
        CHECK(one.levels[k].triangles == four.levels[k].triangles);
        CHECK(one.levels[k].paths == four.levels[k].paths);
        CHECK(one.levels[k].foliage == four.levels[k].foliage);
        CHECK(one.levels[k].error == four.levels[k].error);
        CHECK(one.levels[k].wood_scale == four.levels[k].wood_scale);
        CHECK(one.levels[k].foliage_scale == four.levels[k].foliage_scale);
        CHECK(one.levels[k].cover == four.levels[k].cover);
        CHECK(one.levels[k].tint == four.levels[k].tint);
    }
}

} // namespace lsys
