// Levels of detail of samples: fewer and fewer triangles that look like the plant from as far as
// they are made for. Pictures are drawn here, with opacity and without light.
#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/impl/thinning.h"
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/plant.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys {

namespace {

// Directions between those in which the levels are fitted: turns about +Y and heights of the eye, in
// radians.
constexpr std::array<float, 4> kTurns{0.39F, 1.18F, 1.96F, 2.75F};
constexpr std::array<float, 2> kTilts{0.0F, 0.5F};
constexpr int kSamples = 2; // of a pixel, along each side
constexpr int kMaxPixels = 128;
constexpr double kMaxColourDifference = 0.035;
constexpr double kMaxImpostorDistance = 5.0; // pixels

Project sample_project() {
    Project project;
    project.threads = 1;
    project.host.read_file = [](const std::string& path, const ReadLimit&) -> Result<std::string> {
        std::ifstream file(path, std::ios::binary);
        if (!file) {
            return Error{"no such file or directory"};
        }
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    project.host.read_named_file = project.host.read_file;
    project.host.file_exists = [](const std::string& path) { return std::ifstream(path).good(); };
    return project;
}

Plant grown(const std::string& name) {
    const Project project = sample_project();
    PlantOptions options;
    options.file = std::string(LSYS_SOURCE_DIR) + "/samples/" + name + "/" + name + ".lsys";
    Outcome<Grammar> grammar = load_grammar(options.file, {}, project);
    REQUIRE(grammar);
    Outcome<Plant> plant = grow_plant(options, grammar.value(), project);
    REQUIRE(plant);
    return std::move(plant.value());
}

/// A picture as coverage and colour of each pixel.
struct Picture {
    int side = 0;
    std::vector<float> coverage;
    glm::dvec3 colour{0.0}; // mean over the silhouette
    double area = 0.0;      // pixels
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

/// Draws `mesh` into a square, in which the largest extent of `frame` takes `pixels`, seen along -Z
/// after a turn and a tilt.
Picture draw(const Mesh& mesh, const Bounds& frame, int pixels, float turn, float tilt) {
    const glm::vec3 middle = 0.5F * (frame.low + frame.high);
    const glm::vec3 half = frame.high - middle;
    const float across = std::hypot(half.x, half.z);
    const float reach = std::max(across, std::cos(tilt) * half.y + std::sin(tilt) * across);
    const float largest = std::max({half.x, half.y, half.z});
    const float scale = 0.5F * static_cast<float>(pixels * kSamples) / largest;
    const int side = static_cast<int>(std::ceil(2.0F * scale * reach / kSamples));
    const int size = side * kSamples;
    const auto place = [&](std::uint32_t vertex) {
        const glm::vec3 p = mesh.positions[vertex] - middle;
        const float near = std::cos(turn) * p.z - std::sin(turn) * p.x;
        return scale * glm::vec3(std::cos(turn) * p.x + std::sin(turn) * p.z + reach,
                                 std::cos(tilt) * p.y - std::sin(tilt) * near + reach,
                                 std::cos(tilt) * near + std::sin(tilt) * p.y);
    };
    const std::size_t count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    std::vector<float> depth(count, -std::numeric_limits<float>::infinity());
    std::vector<glm::vec3> colours(count);
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        const Material& material = mesh.materials[part.material];
        const Texels texels(material);
        for (std::uint64_t t = part.first_index; t + 2 < part.first_index + part.index_count;
             t += 3) {
            const std::array<std::uint32_t, 3> v{indices[t], indices[t + 1], indices[t + 2]};
            const std::array<glm::vec3, 3> p{place(v[0]), place(v[1]), place(v[2])};
            const auto cross = [](const glm::vec3& a, const glm::vec3& b, float x, float y) {
                return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
            };
            const float whole = cross(p[0], p[1], p[2].x, p[2].y);
            if (whole == 0.0F) {
                continue;
            }
            const auto first = [](float low) { return std::max(0, static_cast<int>(low)); };
            const auto last = [&](float high) {
                return std::min(size - 1, static_cast<int>(high));
            };
            const int end_x = last(std::max({p[0].x, p[1].x, p[2].x}));
            const int end_y = last(std::max({p[0].y, p[1].y, p[2].y}));
            for (int y = first(std::min({p[0].y, p[1].y, p[2].y})); y <= end_y; ++y) {
                for (int x = first(std::min({p[0].x, p[1].x, p[2].x})); x <= end_x; ++x) {
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
    picture.side = side;
    picture.coverage.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0F);
    for (std::size_t i = 0; i < count; ++i) {
        if (depth[i] > -std::numeric_limits<float>::infinity()) {
            const std::size_t x = i % static_cast<std::size_t>(size) / kSamples;
            const std::size_t y = i / static_cast<std::size_t>(size) / kSamples;
            picture.coverage[y * static_cast<std::size_t>(side) + x] +=
                1.0F / static_cast<float>(kSamples * kSamples);
            picture.area += 1.0 / static_cast<double>(kSamples * kSamples);
            picture.colour += glm::dvec3(colours[i]);
        }
    }
    picture.colour /= std::max(picture.area * kSamples * kSamples, 1.0);
    return picture;
}

/// Distance in pixels from each pixel to the nearest one that is at least half covered, along one
/// axis and then the other (Felzenszwalb and Huttenlocher 2012, by direct search).
std::vector<float> distances_to(const Picture& picture) {
    const int side = picture.side;
    const auto at = [side](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(x);
    };
    constexpr float kFar = 1e9F;
    std::vector<float> along(picture.coverage.size(), kFar); // in the row
    for (int y = 0; y < side; ++y) {
        for (const bool forwards : {true, false}) {
            float last = kFar;
            for (int k = 0; k < side; ++k) {
                const int x = forwards ? k : side - 1 - k;
                last = picture.coverage[at(x, y)] >= 0.5F ? 0.0F : last + 1.0F;
                along[at(x, y)] = std::min(along[at(x, y)], last);
            }
        }
    }
    std::vector<float> result(picture.coverage.size(), kFar);
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) {
            float best = along[at(x, y)];
            for (int away = 1; away < side && static_cast<float>(away) < best; ++away) {
                for (const int other : {y - away, y + away}) {
                    if (other >= 0 && other < side) {
                        best = std::min(best,
                                        std::hypot(static_cast<float>(away), along[at(x, other)]));
                    }
                }
            }
            result[at(x, y)] = best;
        }
    }
    return result;
}

/// Mean distance in pixels from the silhouette of one picture to that of the other, the larger one
/// of both directions: the modified Hausdorff distance (Dubuisson and Jain 1994).
double silhouette_distance(const Picture& a, const Picture& b) {
    const auto one_way = [](const Picture& from, const Picture& to) {
        const std::vector<float> distances = distances_to(to);
        double sum = 0.0;
        double pixels = 0.0;
        for (std::size_t i = 0; i < distances.size(); ++i) {
            if (from.coverage[i] >= 0.5F) {
                sum += std::min(static_cast<double>(distances[i]), static_cast<double>(to.side));
                pixels += 1.0;
            }
        }
        return pixels > 0.0 ? sum / pixels : 0.0;
    };
    return std::max(one_way(a, b), one_way(b, a));
}

/// How a mesh differs from the finest one, over all views.
struct Difference {
    double silhouette = 0.0; // mean over views, pixels
    double area = 0.0;       // ratio of the covered areas
    double colour = 0.0;     // largest difference of a channel, a part of the brightest one
};

Difference compare(const Mesh& fine, const Mesh& coarse, const Bounds& frame, int pixels) {
    Difference result;
    double fine_area = 0.0;
    double coarse_area = 0.0;
    glm::dvec3 fine_colour(0.0);
    glm::dvec3 coarse_colour(0.0);
    for (const float turn : kTurns) {
        for (const float tilt : kTilts) {
            const Picture a = draw(fine, frame, pixels, turn, tilt);
            const Picture b = draw(coarse, frame, pixels, turn, tilt);
            result.silhouette +=
                silhouette_distance(a, b) / static_cast<double>(kTurns.size() * kTilts.size());
            fine_area += a.area;
            coarse_area += b.area;
            fine_colour += a.area * a.colour;
            coarse_colour += b.area * b.colour;
        }
    }
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
    double factor = 1.0; // of the level before
    float pixels = 0.0F;
    Difference difference; // the silhouette in pixels where the level is shown
};

std::vector<LevelResult> measure_levels(const std::string& name) {
    const Plant plant = grown(name);
    const DetailLevels levels = planned(plant, {.threads = 1});
    const Mesh finest = level_mesh(plant, levels, 0);
    const Bounds frame = bounds_of(finest);
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
            const int pixels = std::clamp(static_cast<int>(result.pixels), 8, kMaxPixels);
            result.difference = compare(finest, mesh, frame, pixels);
            result.difference.silhouette *= static_cast<double>(result.pixels) / pixels;
        }
    }
    return results;
}

} // namespace

TEST_CASE("levels of samples have fewer triangles and look alike from afar", "[levels]") {
    const std::string name = GENERATE("carey-type-0", "carey-type-1"); // others take minutes
    const std::vector<LevelResult> results = measure_levels(name);
    for (std::size_t k = 0; k < results.size(); ++k) {
        const LevelResult& level = results[k];
        CAPTURE(name, k, level.triangles, level.factor, level.pixels, level.difference.silhouette,
                level.difference.area, level.difference.colour);
        CHECK(level.planned == level.triangles);
        CHECK(level.difference.colour <= kMaxColourDifference);
        if (k > 0) {
            CHECK(level.factor > 1.4);
            CHECK(level.factor < 7.0);
        }
    }
    CHECK(results.back().triangles <= kMinDetailTriangles);
    CHECK(results.back().difference.silhouette <= kMaxImpostorDistance);
}

// The table of docs/files.md: tests_levels "[table]"
TEST_CASE("table of levels", "[.][table]") {
    std::printf("| sample | triangles | silhouette, pixels | colour, %% |\n|---|---|---|---|\n");
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
        std::printf("| %s | %s | %s | %.1f |\n", name, triangles.c_str(), silhouettes.c_str(),
                    100.0 * colour);
        std::fflush(stdout);
    }
}

TEST_CASE("what a level keeps, all finer levels keep", "[levels]") {
    const Plant plant = grown("carey-3-2-2");
    const DetailLevels levels = planned(plant, {.threads = 1});
    const ThinningOrder order = thinning_order(plant.skeleton);
    // Paths come after their parents.
    for (std::size_t i = 0; i < plant.skeleton.segments.size(); ++i) {
        const std::uint32_t parent = plant.skeleton.segments[i].parent;
        if (parent < i) {
            CHECK(order.path_ranks[parent] <= order.path_ranks[i]);
        }
    }
    for (std::size_t k = 1; k < levels.levels.size() && !levels.levels[k].impostor; ++k) {
        CHECK(levels.levels[k].paths <= levels.levels[k - 1].paths);
        CHECK(levels.levels[k].foliage <= levels.levels[k - 1].foliage);
    }
    CHECK(std::set(order.foliage.begin(), order.foliage.end()).size() ==
          plant.skeleton.objects.size() + plant.skeleton.polygons.size());
}

TEST_CASE("leaves that stay have the area of all leaves", "[levels]") {
    Skeleton skeleton;
    test::Numbers numbers(7);
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
        double left = 0.0;
        std::map<std::uint16_t, double> by_colour;
        for (const PlacedObject& leaf : thin.objects) {
            const double own = static_cast<double>(leaf.size) * static_cast<double>(leaf.size);
            left += own;
            by_colour[leaf.colour] += own;
        }
        CHECK(left == Approx(area).epsilon(1e-4));
        if (kept >= 3) { // each colour keeps its part
            CHECK(by_colour.size() == 3);
            for (const auto& [colour, part] : by_colour) {
                CHECK(part == Approx(area / 3.0).epsilon(0.05));
            }
        }
    }
}

TEST_CASE("levels do not depend on threads", "[levels]") {
    const Plant plant = grown("carey-3-2-2");
    const DetailLevels one = planned(plant, {.threads = 1});
    const DetailLevels four = planned(plant, {.threads = 4});
    REQUIRE(one.levels.size() == four.levels.size());
    for (std::size_t k = 0; k < one.levels.size(); ++k) {
        CHECK(one.levels[k].triangles == four.levels[k].triangles);
        CHECK(one.levels[k].paths == four.levels[k].paths);
        CHECK(one.levels[k].foliage == four.levels[k].foliage);
        CHECK(one.levels[k].error == four.levels[k].error);
    }
}

} // namespace lsys
