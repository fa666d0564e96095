// SPDX-License-Identifier: MIT
// Drawings of skeletons.
#include "runtime/export/export.h"
#include "runtime/export/impl/opacity_outline.h"
#include "runtime/export/impl/outline.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace lsys;

namespace {

std::string drawn(const Skeleton& skeleton, const std::vector<UserMesh>* meshes = nullptr) {
    std::string text;
    const ExportInfo info{.grammar = "a&b.lsys",
                          .seed = 7,
                          .generations = 3,
                          .generator = "lsc 1",
                          .mtl_name = "",
                          .picture_prefix = "",
                          .user_meshes = meshes};
    REQUIRE(export_mesh({}, skeleton, ExportFormat::Svg, info, [&text](std::string_view piece) {
                text += piece;
                return true;
            }).ok());
    return text;
}

int occurrences(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) {
        ++count;
    }
    return count;
}

Segment upright(float base, std::uint32_t parent, float radius) {
    return {.base = {0.0F, base, 0.0F},
            .length = 1.0F,
            .base_radius = radius,
            .tip_radius = radius,
            .parent = parent,
            .linked = parent != kNoSegment};
}

} // namespace

TEST_CASE("runs of equal segments are one polyline") {
    Skeleton skeleton;
    skeleton.segments = {upright(0.0F, kNoSegment, 0.25F), upright(1.0F, 0, 0.25F),
                         upright(2.0F, 1, 0.125F), upright(1.0F, 0, 0.125F)};
    skeleton.segments[3].colour = 17;
    CHECK(drawn(skeleton) ==
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"145\" height=\"800\" "
          "viewBox=\"-0.3175 -3.1925 0.635 3.51\">\n"
          "<title>a&amp;b.lsys</title>\n"
          "<desc>lsc 1: a&amp;b.lsys, seed 7, 3 generations. Metres, seen from +Z.</desc>\n"
          "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
          "<g stroke=\"#705842\" stroke-width=\"0.5\">\n"
          "<polyline points=\"0,0 0,-1 0,-2\"/>\n"
          "</g>\n"
          "<g stroke=\"#705842\" stroke-width=\"0.25\">\n"
          "<polyline points=\"0,-2 0,-3\"/>\n"
          "</g>\n"
          "<g stroke=\"#cc2e34\" stroke-width=\"0.25\">\n"
          "<polyline points=\"0,-1 0,-2\"/>\n"
          "</g>\n"
          "</g>\n"
          "</svg>\n");
}

TEST_CASE("a segment that does not continue the previous one begins a polyline") {
    Skeleton skeleton;
    skeleton.segments = {upright(0.0F, kNoSegment, 0.25F), upright(1.0F, 0, 0.25F),
                         upright(1.0F, 0, 0.25F), upright(4.0F, 2, 0.25F)};
    skeleton.segments[3].linked = false;
    CHECK(drawn(skeleton).find("<polyline points=\"0,0 0,-1 0,-2\"/>\n"
                               "<polyline points=\"0,-1 0,-2\"/>\n"
                               "<polyline points=\"0,-4 0,-5\"/>\n") != std::string::npos);
}

TEST_CASE("lines without width are hairlines, and polygons are filled") {
    Skeleton skeleton;
    skeleton.segments = {upright(0.0F, kNoSegment, 0.0F)};
    skeleton.corners = {{0.0F, 0.0F, 5.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 4.0F, 0.0F}};
    skeleton.polygons = {{.first_corner = 0, .corner_count = 3, .colour = 1}};
    const std::string text = drawn(skeleton);
    CHECK(text.find("stroke-width=\"0.01\"") != std::string::npos);
    CHECK(text.find("<polygon fill=\"#51852f\" points=\"0,0 8,0 0,-4\"/>\n") != std::string::npos);
    CHECK(text.find("viewBox=\"-0.16 -4.16 8.32 4.32\"") != std::string::npos);
}

TEST_CASE("a drawing without extent has a view box") {
    Skeleton skeleton;
    skeleton.segments = {upright(1.0F, kNoSegment, 0.0F)};
    skeleton.segments[0].length = 0.0F;
    CHECK(drawn(skeleton).find("viewBox=\"-0.02 -1.02 0.04 0.04\"") != std::string::npos);
}

TEST_CASE("objects are drawn as the outlines of their parts") {
    Skeleton skeleton;
    // A sphere 2 m in diameter, drawn around (10, 1).
    skeleton.objects = {
        {.kind = TurtleOperation::Sphere, .position = {10.0F, 0.0F, 3.0F}, .size = 2.0F}};
    std::string text = drawn(skeleton);
    CHECK(text.find("viewBox=\"8.96 -2.04 2.08 2.08\"") != std::string::npos);
    CHECK(occurrences(text, "<polygon") == 1);
    CHECK(text.find("10,-2 ") != std::string::npos);

    skeleton.objects[0].kind = TurtleOperation::Flower;
    skeleton.objects[0].colour = 17;
    text = drawn(skeleton);
    CHECK(occurrences(text, "<polygon") == 3);
    CHECK(occurrences(text, "<polygon fill=\"#cc2e34\"") == 1); // the petals
}

TEST_CASE("objects of mesh files are drawn if their meshes are known") {
    Skeleton skeleton;
    skeleton.mesh_files = {"a.obj", "b.obj"};
    skeleton.objects = {{.kind = TurtleOperation::MeshFile, .mesh_file = 1}};
    CHECK(occurrences(drawn(skeleton), "<polygon") == 0);
    std::vector<UserMesh> meshes(2);
    meshes[1].positions = {{0.0F, 0.0F, 0.0F}, {4.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.0F}};
    meshes[1].normals.assign(3, glm::vec3(0.0F, 0.0F, 1.0F));
    meshes[1].indices = {0, 1, 2};
    const std::string text = drawn(skeleton, &meshes);
    CHECK(text.find("points=\"0,0 4,0 0,-2\"") != std::string::npos);
    CHECK(text.find("viewBox=\"-0.08 -2.08 4.16 2.16\"") != std::string::npos);
}

TEST_CASE("a card with a picture is drawn as the outline of its opaque part") {
    // A white square of 8 by 8 texels in 16 by 16, with a red hole of 2 by 2.
    auto picture = std::make_shared<Texture>();
    picture->width = 16;
    picture->height = 16;
    picture->texels.assign(std::size_t{4} * 16 * 16, 0);
    for (std::size_t y = 4; y < 12; ++y) {
        for (std::size_t x = 4; x < 12; ++x) {
            const bool hole = x >= 7 && x < 9 && y >= 7 && y < 9;
            const std::size_t at = 4 * (16 * y + x);
            for (std::size_t channel = 0; channel < 4; ++channel) {
                picture->texels[at + channel] = hole ? 0 : 255;
            }
        }
    }
    const std::vector<std::vector<glm::vec2>> loops =
        opacity_outline(*picture, glm::vec2(0.0F), glm::vec2(1.0F));
    REQUIRE(loops.size() == 2);
    const auto area = [](const std::vector<glm::vec2>& loop) {
        float twice = 0.0F;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const glm::vec2& b = loop[(i + 1) % loop.size()];
            twice += loop[i].x * b.y - loop[i].y * b.x;
        }
        return 0.5F * std::abs(twice);
    };
    CHECK(area(loops[0]) == Approx(0.25F).margin(0.03));
    CHECK(area(loops[1]) == Approx(4.0F / 256.0F).margin(0.01));
    for (const glm::vec2& point : loops[0]) {
        CHECK(std::max(std::abs(point.x - 0.5F), std::abs(point.y - 0.5F)) ==
              Approx(0.25F).margin(0.04));
    }
    // The part outside of the given box is clipped.
    CHECK(area(opacity_outline(*picture, glm::vec2(0.0F), glm::vec2(1.0F, 0.375F)).at(0)) ==
          Approx(0.5F * 0.125F).margin(0.02));

    Skeleton skeleton;
    skeleton.mesh_files = {"leaf.obj"};
    skeleton.objects = {{.kind = TurtleOperation::MeshFile, .size = 2.0F}};
    std::vector<UserMesh> meshes(1);
    meshes[0].positions = {
        {-0.5F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, {0.5F, 1.0F, 0.0F}, {-0.5F, 1.0F, 0.0F}};
    meshes[0].normals.assign(4, glm::vec3(0.0F, 0.0F, 1.0F));
    meshes[0].texture_coordinates = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}};
    meshes[0].indices = {0, 1, 2, 0, 2, 3};
    meshes[0].picture = picture;
    std::string text = drawn(skeleton, &meshes);
    CHECK(occurrences(text, "<path fill=\"#ffffff\" fill-rule=\"evenodd\" d=\"M") == 1);
    CHECK(occurrences(text, "z") >= 2);
    CHECK(occurrences(text, "<polygon") == 0);
    // The square is 1 m wide, at a height of 0.5 m to 1.5 m; the drawing includes the base of the
    // card.
    CHECK(text.find("viewBox=\"-0.53 -1.53 1.06 1.56\"") != std::string::npos);

    // A bent card is drawn whole, in the mean colour.
    meshes[0].positions[2].z = 1.0F;
    meshes[0].texture_coordinates[2] = {0.25F, 0.5F};
    text = drawn(skeleton, &meshes);
    CHECK(occurrences(text, "<path") == 0);
    CHECK(occurrences(text, "<polygon fill=\"#ffffff\"") == 1);
    // A card without holes is drawn whole.
    auto whole = std::make_shared<Texture>(*picture);
    whole->texels.assign(whole->texels.size(), 255);
    meshes[0].picture = whole;
    text = drawn(skeleton, &meshes);
    CHECK(occurrences(text, "<polygon fill=\"#ffffff\"") == 1);

    // Polygons with a picture have its mean colour.
    meshes[0].picture = picture;
    skeleton.objects.clear();
    skeleton.corners = {{0.0F, 0.0F, 0.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 4.0F, 0.0F}};
    skeleton.polygons = {{.first_corner = 0, .corner_count = 3, .colour = 1, .picture = 0}};
    CHECK(occurrences(drawn(skeleton, &meshes), "<polygon fill=\"#ffffff\"") == 1);
}

TEST_CASE("the hull of points") {
    std::vector<glm::vec2> points{{0.0F, 0.0F}, {1.0F, 1.0F}, {2.0F, 0.0F}, {2.0F, 2.0F},
                                  {1.0F, 0.0F}, {0.0F, 2.0F}, {0.0F, 0.0F}};
    const std::vector<glm::vec2> square{{0.0F, 0.0F}, {2.0F, 0.0F}, {2.0F, 2.0F}, {0.0F, 2.0F}};
    CHECK(convex_hull(points) == square);
    std::vector<glm::vec2> line{{0.0F, 0.0F}, {1.0F, 1.0F}, {2.0F, 2.0F}};
    CHECK(convex_hull(line).size() == 2);
    std::vector<glm::vec2> none;
    CHECK(convex_hull(none).empty());
}
