// SPDX-License-Identifier: MIT
// Organs: surfaces around an axis, with closed forms of their areas and volumes, and an axis computed
// in another way.
#include "runtime/derive/derive.h"
#include "runtime/meshing/impl/organ_axis.h"
#include "runtime/meshing/organ_shape.h"
#include "runtime/turtle/growth.h"
#include "runtime/turtle/organs.h"
#include "runtime/turtle/turtle.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/mesh_checks.h"

#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;

namespace {

constexpr double kPi = std::numbers::pi;

using Contours = std::vector<BytecodeContour>;

const BytecodeContour kSquare{"square",
                              {{0.5F, 0.5F},
                               {0.5F, 0.5F},
                               {-0.5F, 0.5F},
                               {-0.5F, 0.5F},
                               {-0.5F, -0.5F},
                               {-0.5F, -0.5F},
                               {0.5F, -0.5F},
                               {0.5F, -0.5F},
                               {0.5F, 0.5F}}};
/// Half of kSquare, turned by 45 degrees.
const BytecodeContour kDiamond{"diamond",
                               {{0.0F, 0.25F},
                                {0.0F, 0.25F},
                                {-0.25F, 0.0F},
                                {-0.25F, 0.0F},
                                {0.0F, -0.25F},
                                {0.0F, -0.25F},
                                {0.25F, 0.0F},
                                {0.25F, 0.0F},
                                {0.0F, 0.25F}}};
const BytecodeContour kBlade{"blade", {{-0.5F, 0.0F}, {0.0F, 0.0F}, {0.5F, 0.0F}}};
/// A crescent, whose middle is outside of it.
const BytecodeContour kCrescent{"crescent",
                                {{0.5F, 0.0F},
                                 {0.35F, 0.4F},
                                 {-0.1F, 0.5F},
                                 {-0.4F, 0.3F},
                                 {0.0F, 0.35F},
                                 {0.3F, 0.0F},
                                 {0.0F, -0.35F},
                                 {-0.4F, -0.3F},
                                 {-0.1F, -0.5F},
                                 {0.35F, -0.4F},
                                 {0.5F, 0.0F}}};

/// Draws a word: B, P and E begin, continue and end an organ, T sets its tangents, and C0, C1 ...
/// set a contour.
struct Drawing {
    Skeleton skeleton;
    std::array<TurtleFault, kTurtleFaultKindCount> faults{};
    [[nodiscard]] std::uint64_t count(TurtleFaultKind kind) const {
        return faults[static_cast<std::size_t>(kind)].count;
    }
};

Drawing draw(const std::string& word, const Contours& contours = {}) {
    using enum TurtleOperation;
    Bytecode bytecode = test::BytecodeBuilder().axiom(word).build();
    bytecode.contours = contours;
    const std::vector<std::pair<std::string, TurtleOperation>> known{
        {"F", Forward},      {"f", Move},       {"+", YawRight},
        {"-", YawLeft},      {"&", PitchDown},  {"/", RollRight},
        {"!", SetWidth},     {"'", SetColour},  {"[", Save},
        {"]", Restore},      {"%", Cut},        {"B", SurfaceBegin},
        {"P", SurfacePoint}, {"E", SurfaceEnd}, {"T", SurfaceTangents}};
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        for (const auto& [name, operation] : known) {
            symbol.turtle = symbol.name == name ? operation : symbol.turtle;
        }
        if (symbol.name.size() == 2 && symbol.name[0] == 'C') {
            symbol.turtle = SetContour;
            symbol.mesh_file = contours[static_cast<std::size_t>(symbol.name[1] - '0')].name;
        }
    }
    Derivation derivation(bytecode, {});
    REQUIRE(derivation.start() == std::nullopt);
    Turtle turtle(bytecode, {});
    REQUIRE(turtle.feed(derivation.word()) == std::nullopt);
    REQUIRE(turtle.finish() == std::nullopt);
    Drawing drawing;
    drawing.faults = turtle.end().faults;
    drawing.skeleton = turtle.take_skeleton();
    return drawing;
}

Mesh mesh_of(const Skeleton& skeleton, MeshOptions options = {}) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

Mesh mesh_of(const std::string& word, const Contours& contours = {}) {
    return mesh_of(draw(word, contours).skeleton);
}

/// Area of a regular polygon of `sides` corners on a circle.
double polygon_area(double radius, int sides) {
    return 0.5 * sides * radius * radius * std::sin(2.0 * kPi / sides);
}

void check_closed(const Mesh& mesh) {
    const test::Topology topology = test::topology_of(mesh);
    CHECK(topology.open_edges == 0);
    CHECK(topology.euler() == 2);
    CHECK(test::triangles_turned_over(mesh) == 0);
}

} // namespace

TEST_CASE("a straight organ with a round contour is a closed tube") {
    const Mesh mesh = mesh_of("!(0.4,32)B F(2)E");
    check_closed(mesh);
    const double base = polygon_area(0.2, 32);
    CHECK(test::volume_of(mesh) == Approx(2.0 * base).epsilon(1e-5));
    const double around = 32 * 2.0 * 0.2 * std::sin(kPi / 32);
    CHECK(test::area_of(mesh) == Approx(2.0 * around + 2.0 * base).epsilon(1e-5));
    REQUIRE(mesh.materials.size() == 1);
    CHECK_FALSE(mesh.materials[0].two_sided);
}

TEST_CASE("an organ that ends with no width is a closed cone") {
    const Mesh mesh = mesh_of("!(0.4,32)B f(3)!(0)E");
    check_closed(mesh);
    CHECK(test::volume_of(mesh) == Approx(polygon_area(0.2, 32)).epsilon(1e-5));
}

TEST_CASE("an organ around a circle is a torus") {
    std::string word = "!(0.2,48)B";
    for (int i = 0; i < 36; ++i) {
        word += "+(5)f(0.1)+(5)P";
    }
    const Mesh mesh = mesh_of(word + "E");
    const double radius = 0.05 / std::sin(kPi / 36.0); // of the circle through the points
    CHECK(test::volume_of(mesh) == Approx(2.0 * kPi * kPi * radius * 0.01).epsilon(0.01));
    const double caps = 2.0 * polygon_area(0.1, 48);
    CHECK(test::area_of(mesh) == Approx(4.0 * kPi * kPi * radius * 0.1 + caps).epsilon(0.01));
    CHECK(test::triangles_turned_over(mesh) == 0);
}

TEST_CASE("corners of a contour are exact and sharp") {
    const Mesh mesh = mesh_of("C0!(0.4,12)B f(2)E", {kSquare});
    check_closed(mesh);
    CHECK(test::volume_of(mesh) == Approx(0.32).epsilon(1e-6));
    CHECK(test::area_of(mesh) == Approx(2.0 * 0.16 + 4.0 * 0.8).epsilon(1e-6));
    std::size_t slanted = 0;
    for (const glm::vec3& normal : mesh.normals) {
        slanted += std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}) > 0.9999F
                       ? 0U
                       : 1U;
    }
    CHECK(slanted == 0);
}

TEST_CASE("a contour that goes around the other way has its front outside too") {
    BytecodeContour reversed = kSquare;
    std::ranges::reverse(reversed.points);
    const Mesh mesh = mesh_of("C0!(0.4,12)B f(2)E", {reversed});
    check_closed(mesh);
    CHECK(test::volume_of(mesh) == Approx(0.32).epsilon(1e-6));
}

TEST_CASE("an open contour makes a sheet with two sides and no caps") {
    const Mesh mesh = mesh_of("C0!(0.5)B f(3)E", {kBlade});
    CHECK(test::area_of(mesh) == Approx(1.5).epsilon(1e-6));
    REQUIRE(mesh.materials.size() == 1);
    CHECK(mesh.materials[0].two_sided);
    for (const glm::vec3& normal : mesh.normals) {
        CHECK(normal.z == Approx(1.0)); // the turtle's up axis
    }
    const Bounds bounds = test::bounds_of(mesh);
    CHECK(bounds.low.x == Approx(-0.25));
    CHECK(bounds.high.x == Approx(0.25));
}

TEST_CASE("the roll between two points is turned evenly") {
    OrganPoint a;
    OrganPoint b;
    b.position = {0.0F, 2.0F, 0.0F};
    b.frame = glm::quat(std::sqrt(0.5F), 0.0F, std::sqrt(0.5F), 0.0F); // 90 degrees about +Y
    const std::vector<AxisStation> stations = stations_between(a, b, 0, 1);
    REQUIRE(stations.size() > 4);
    for (const AxisStation& station : stations) {
        const double angle = std::atan2(-station.right.z, station.right.x);
        CHECK(angle == Approx(0.5 * kPi * station.part).margin(1e-6));
        CHECK(station.position.y == Approx(2.0 * station.part).margin(1e-12));
    }
}

TEST_CASE("radii follow the Hermite curve of their tangents") {
    OrganPoint a;
    a.width = 0.4F;
    a.radii = {0.0F, 0.0F, 0.5F, 0.75F, false};
    OrganPoint b;
    b.position = {0.0F, 2.0F, 0.0F};
    b.width = 0.2F;
    b.radii = {0.25F, -0.5F, 0.0F, 0.0F, true}; // -0.5 chords
    const std::vector<AxisStation> stations = stations_between(a, b, 0, 1);
    REQUIRE(stations.size() == 13);
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const double t = static_cast<double>(i) / 12.0;
        // Hermite's basis functions; b's per_chord scales both radius tangents by the chord, 2 m.
        const double from = 2 * t * t * t - 3 * t * t + 1;
        const double to = -2 * t * t * t + 3 * t * t;
        const double out = t * t * t - 2 * t * t + t;
        const double in = t * t * t - t * t;
        CHECK(stations[i].part == Approx(to + out * 0.5 + in * 0.25).margin(1e-9));
        const double radius = from * 0.2 + to * 0.1 + out * 0.75 * 2.0 + in * -0.5 * 2.0;
        CHECK(stations[i].width == Approx(2.0 * std::max(radius, 0.0)).margin(1e-7));
    }
}

TEST_CASE("an axis follows the Bezier curve with the same tangents, without turning about it") {
    OrganPoint a;
    a.position = {0.1F, 0.2F, 0.3F};
    a.frame = glm::normalize(glm::quat(0.9F, 0.1F, -0.2F, 0.3F));
    OrganPoint b;
    b.position = {0.8F, 1.4F, -0.2F};
    b.frame = glm::normalize(glm::quat(0.5F, 0.6F, 0.2F, -0.1F));
    b.tangent_before = 0.7F;
    a.tangent_after = 1.3F;
    const std::vector<AxisStation> stations = stations_between(a, b, 0, 1);
    const glm::dvec3 from(a.position);
    const glm::dvec3 to(b.position);
    const double chord = glm::length(to - from);
    const auto heading_of = [](const OrganPoint& point) {
        return glm::dquat(point.frame) * glm::dvec3(0.0, 1.0, 0.0);
    };
    const std::array<glm::dvec3, 4> control{
        from, from + heading_of(a) * (chord * static_cast<double>(a.tangent_after) / 3.0),
        to - heading_of(b) * (chord * static_cast<double>(b.tangent_before) / 3.0), to};
    const auto de_casteljau = [&](double t, glm::dvec3& tangent) {
        std::array<glm::dvec3, 4> p = control;
        for (std::size_t left = 3; left > 0; --left) {
            if (left == 1) {
                tangent = glm::normalize(p[1] - p[0]);
            }
            for (std::size_t i = 0; i < left; ++i) {
                p[i] += t * (p[i + 1] - p[i]);
            }
        }
        return p[0];
    };
    // Carries the right axis along in many small steps, without turning it about the tangent.
    constexpr int kSteps = 20000;
    glm::dvec3 right = glm::dquat(a.frame) * glm::dvec3(1.0, 0.0, 0.0);
    std::vector<glm::dvec3> carried{right};
    glm::dvec3 tangent;
    std::size_t next = 1;
    double worst = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const double t = static_cast<double>(i) / kSteps;
        static_cast<void>(de_casteljau(t, tangent));
        right = glm::normalize(right - glm::dot(right, tangent) * tangent);
        if (next < stations.size() && t + 1e-9 >= stations[next].part) {
            carried.push_back(right);
            glm::dvec3 at_station;
            const glm::dvec3 place = de_casteljau(stations[next].part, at_station);
            worst = std::max(worst, glm::length(place - stations[next].position));
            worst = std::max(worst, glm::length(at_station - stations[next].heading));
            ++next;
        }
    }
    CHECK(worst < 1e-6);
    REQUIRE(carried.size() == stations.size());
    const glm::dvec3 end = glm::dquat(b.frame) * glm::dvec3(1.0, 0.0, 0.0);
    const double roll =
        std::atan2(glm::dot(end, glm::cross(carried.back(), stations.back().heading)),
                   glm::dot(end, carried.back()));
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const glm::dvec3 up = glm::cross(carried[i], stations[i].heading);
        const double turned = stations[i].part * roll;
        const glm::dvec3 wanted = std::cos(turned) * carried[i] + std::sin(turned) * up;
        CHECK(glm::length(wanted - stations[i].right) < 0.02); // steps of about 10 degrees
    }
}

TEST_CASE("contours of equal counts of points blend") {
    const Mesh mesh = mesh_of("C0!(1,16)B f(3)C1 E", {kSquare, kDiamond});
    check_closed(mesh);
    const Bounds bounds = test::bounds_of(mesh);
    CHECK(bounds.high.x == Approx(0.5));
    // Sections in between are the blends of the corners: areas of 1 at the base and 1/8 on top.
    CHECK(test::volume_of(mesh) > 3.0 * 0.125);
    CHECK(test::volume_of(mesh) < 3.0);
    double area = 0.0; // of the section at half the height
    const glm::dvec2 a(0.25 + 0.0, 0.25 + 0.125);
    const glm::dvec2 b(-0.25 - 0.125, 0.25);
    area = 4.0 * 0.5 * (a.x * b.y - a.y * b.x);
    CHECK(test::volume_of(mesh) == Approx(3.0 * (1.0 + 4.0 * area + 0.125) / 6.0).epsilon(0.01));
}

TEST_CASE("other contours are switched at the point") {
    BytecodeContour wide = kSquare;
    for (ContourPoint& point : wide.points) {
        point = {1.6F * point.x, 1.6F * point.y};
    }
    const Mesh mesh = mesh_of("!(0.5,24)B f(2)C0 P f(1)E", {wide});
    check_closed(mesh);
    CHECK(test::volume_of(mesh) == Approx(2.0 * polygon_area(0.25, 24) + 0.64).epsilon(1e-5));
    const Mesh back = mesh_of("C0!(0.5,24)B f(2)C1 P f(1)E", {wide, kBlade});
    CHECK(test::topology_of(back).open_edges > 0); // the blade is open
    CHECK(test::triangles_turned_over(back) == 0);
}

TEST_CASE("a contour that is no star is closed by caps") {
    const Mesh mesh = mesh_of("C0!(1,40)B f(1)E", {kCrescent});
    CHECK(test::topology_of(mesh).open_edges == 0);
    CHECK(test::triangles_turned_over(mesh) == 0);
    CHECK(test::volume_of(mesh) > 0.2);
    CHECK(test::volume_of(mesh) < 0.6);
}

TEST_CASE("texture coordinates are fractions around and circumferences along") {
    const Mesh mesh = mesh_of("!(0.4,32)B f(2)E");
    float lowest = 0.0F;
    float last = 0.0F;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (std::abs(mesh.normals[i].y) < 0.5F) { // no cap
            lowest = std::min(lowest, mesh.texture_coordinates[i].y);
            last = std::max(last, mesh.texture_coordinates[i].x);
        }
    }
    CHECK(last == 1.0F);
    const double around = 32 * 2.0 * 0.2 * std::sin(kPi / 32);
    CHECK(static_cast<double>(lowest) == Approx(-2.0 / around).epsilon(1e-5));
}

TEST_CASE("a picture around a closed organ is not mirrored outside") {
    BytecodeContour reversed = kSquare;
    std::ranges::reverse(reversed.points);
    for (const Mesh& mesh : {mesh_of("!(0.4,32)B f(2)E"), mesh_of("C0!(0.4,12)B f(2)E", {kSquare}),
                             mesh_of("C0!(0.4,12)B f(2)E", {reversed})}) {
        int count = 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) {
                return mesh.texture_coordinates[mesh.indices[i + k]];
            };
            if (std::abs(mesh.normals[mesh.indices[i]].y) > 0.5F) {
                continue; // a cap
            }
            const glm::vec2 b = at(1) - at(0);
            const glm::vec2 c = at(2) - at(0);
            CHECK(b.x * c.y - b.y * c.x < 0.0F); // u to the right, v down
            ++count;
        }
        CHECK(count > 0);
    }
}

TEST_CASE("a stretch has the colour of the point where it begins") {
    const Mesh mesh = mesh_of("'(3)!(0.2)B f(1)'(5)P f(1)'(7)E");
    CHECK(test::topology_of(mesh).open_edges == 0);
    double low = 0.0;
    double high = 0.0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto y = static_cast<double>(mesh.positions[i].y);
        high = mesh.colours[i] == 3 ? std::max(high, y) : high;
        low = mesh.colours[i] == 5 ? std::max(low, 2.0 - y) : low;
    }
    CHECK(high == Approx(1.0));
    CHECK(low == Approx(1.0));
}

TEST_CASE("branches within an organ draw segments and have organs of their own") {
    const Drawing drawing = draw("B F(1)[+(30)F(1)B f(1)]F(1)E");
    CHECK(drawing.skeleton.segments.size() == 1);
    REQUIRE(drawing.skeleton.objects.size() == 2);
    // The organ of the branch ends first.
    CHECK(drawing.skeleton.objects[0].order == 1);
    CHECK(points_of(drawing.skeleton, drawing.skeleton.objects[0]).size() == 2);
    CHECK(points_of(drawing.skeleton, drawing.skeleton.objects[1]).size() == 3);
}

TEST_CASE("an organ that is open at the end of the word or of a cut branch ends there") {
    const Drawing drawing = draw("[B f(1)%f(1)]B f(2)");
    REQUIRE(drawing.skeleton.objects.size() == 2);
    const auto height = [&](std::size_t i) {
        return points_of(drawing.skeleton, drawing.skeleton.objects[i]).back().position.y;
    };
    CHECK(height(0) == 1.0F);
    CHECK(height(1) == 2.0F);
}

TEST_CASE("points and ends outside of an organ, and organs within organs, are ignored") {
    const Drawing drawing = draw("P E B f(1)B f(1)E E B E");
    CHECK(drawing.count(TurtleFaultKind::SurfaceOutside) == 3);
    CHECK(drawing.count(TurtleFaultKind::SurfaceWithin) == 1);
    CHECK(drawing.count(TurtleFaultKind::SmallSurface) == 1);
    CHECK(drawing.skeleton.objects.size() == 1);
}

TEST_CASE("a point at the place of the point before replaces it") {
    const Drawing drawing = draw("B F(1)!(0.3)P F(1)E");
    const auto points = points_of(drawing.skeleton, drawing.skeleton.objects[0]);
    REQUIRE(points.size() == 3);
    CHECK(points[1].width == 0.3F);
}

TEST_CASE("levels of an organ have fewer triangles in the same box") {
    const Skeleton skeleton = draw("!(0.4,32)B+(20)f(1)+(20)P+(20)f(1)E").skeleton;
    std::uint64_t before = ~std::uint64_t{0};
    for (std::uint32_t level = 0; level < 3; ++level) {
        MeshOptions options;
        options.level = level;
        const Mesh mesh = mesh_of(skeleton, options);
        CHECK(test::topology_of(mesh).open_edges == 0);
        CHECK(mesh.indices.size() < before);
        before = mesh.indices.size();
        CHECK(test::bounds_of(mesh).high.y == Approx(1.72).margin(0.15));
    }
}

TEST_CASE("meshes of organs do not depend on the number of threads") {
    std::string word = "!(0.1,6)";
    for (int i = 0; i < 300; ++i) {
        word += "[+(" + std::to_string(i) + ")B f(0.5)/(20)&(30)f(0.5)E]";
    }
    const Skeleton skeleton = draw(word).skeleton;
    MeshOptions options;
    options.threads = 1;
    const Mesh one = mesh_of(skeleton, options);
    options.threads = 4;
    const Mesh four = mesh_of(skeleton, options);
    CHECK(std::ranges::equal(one.positions, four.positions));
    CHECK(one.indices == four.indices);
}

TEST_CASE("an organ moves and grows with its object") {
    Skeleton skeleton = draw("!(0.4,16)B f(2)E").skeleton;
    const double volume = test::volume_of(mesh_of(skeleton));
    skeleton.objects[0].size = 0.5F;
    skeleton.objects[0].position = {1.0F, 2.0F, 3.0F};
    const Mesh mesh = mesh_of(skeleton);
    CHECK(test::volume_of(mesh) == Approx(volume / 8.0).epsilon(1e-5));
    CHECK(test::bounds_of(mesh).high.y == Approx(3.0));
    skeleton.objects[0].size = 0.0F;
    CHECK(mesh_of(skeleton).indices.empty());
}

TEST_CASE("new points of an organ come out of its last one") {
    Skeleton before = draw("!(0.4,16)B f(1)E").skeleton;
    Skeleton after = draw("!(0.4,16)B f(1)P f(1)E").skeleton;
    before.object_origins.push_back({0, 0});
    after.object_origins.push_back({0, 0});
    const std::vector<Origin> ancestors{{0, 0}};
    const SkeletonGrowth growth(before, after, 1, ancestors);
    CHECK(growth.counts().kept == 1);
    Skeleton pose;
    for (const double part : {0.0, 0.25, 0.5, 1.0}) {
        growth.pose(part, pose);
        const Mesh mesh = mesh_of(pose);
        CHECK(test::topology_of(mesh).open_edges == 0);
        CHECK(test::bounds_of(mesh).high.y == Approx(1.0 + part));
    }
}

TEST_CASE("an organ that vanishes shrinks") {
    Skeleton before = draw("!(0.4,16)[B f(1)E]B f(2)E").skeleton;
    Skeleton after = draw("!(0.4,16)B f(2)E").skeleton;
    before.object_origins.push_back({0, 0});
    before.object_origins.push_back({1, 0});
    after.object_origins.push_back({0, 0});
    const std::vector<Origin> ancestors{{1, 0}};
    const SkeletonGrowth growth(before, after, 1, ancestors);
    Skeleton pose;
    growth.pose(0.5, pose);
    REQUIRE(pose.objects.size() == 2);
    CHECK(pose.organs.size() == 2);
    CHECK(points_of(pose, pose.objects[0]).back().position.y == 2.0F);
    CHECK(points_of(pose, pose.objects[1]).back().position.y == 1.0F);
    CHECK(pose.objects[1].size < 1.0F);
}
