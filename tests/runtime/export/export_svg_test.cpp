// Drawings of skeletons.
#include "runtime/export/export.h"
#include "runtime/export/impl/outline.h"

#include <catch2/catch.hpp>

#include <string>

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

TEST_CASE("a segment that is not linked to the one before begins a polyline") {
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
    // 2 m in diameter, around (10, 1).
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
