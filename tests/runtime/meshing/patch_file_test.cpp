// SPDX-License-Identifier: MIT
// Surface files of cpfg: closed forms of patches, and files that are cut, huge or no numbers.
#include "runtime/meshing/patch_file.h"
#include "tests/support/mesh_checks.h"

#include <string>
#include <vector>

using namespace lsys;

namespace {

constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;

/// A flat patch over [0, 3] x [0, 3] at z = 1, its first row on top.
std::string flat_patch(const std::string& name, int x = 0) {
    std::string text = name + "\nTOP COLOR: 0 DIFFUSE: 0.00 BOTTOM COLOR: 0 DIFFUSE: 0.00\n"
                              "AL: ~ A: ~ AR: ~\nL: ~ R: ~\nBL: ~ B: ~ BR: ~\n";
    for (int row = 3; row >= 0; --row) {
        for (int column = 0; column < 4; ++column) {
            text += std::to_string(3 * x + column) + " " + std::to_string(row) + " 1  ";
        }
        text += "\n";
    }
    return text;
}

std::string header(const std::string& heading = "X: 0.00 Y: 1.00 Z: 0.00",
                   const std::string& up = "X: 0.00 Y: 0.00 Z: 1.00",
                   const std::string& size = "2.0") {
    return "0 3   0 3   1 1\nPRECISION S: 4 T: 6\nCONTACT POINT  X: 1.00 Y: 0.00 Z: 1.00\n"
           "END POINT  X: 0.00 Y: 0.00 Z: 0.00\nHEADING  " +
           heading + "\nUP  " + up + "\nSIZE: " + size + "\n";
}

Result<UserMesh> read(const std::string& text) {
    return read_patches(text, {}, kMemory);
}

double area(const UserMesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        sum += 0.5 * glm::length(test::twice_area(mesh.positions[mesh.indices[i]],
                                                  mesh.positions[mesh.indices[i + 1]],
                                                  mesh.positions[mesh.indices[i + 2]]));
    }
    return sum;
}

std::string problem(const std::string& text) {
    const Result<UserMesh> mesh = read(text);
    REQUIRE_FALSE(mesh);
    return mesh.error().message;
}

} // namespace

TEST_CASE("a flat patch has its contact point at the origin and the scale of the file") {
    const Result<UserMesh> mesh = read(header() + flat_patch("leaf"));
    REQUIRE(mesh);
    CHECK(mesh.value().positions.size() == 5 * 7);
    CHECK(area(mesh.value()) == Approx(9.0 / 4.0));
    CHECK(mesh.value().length() == Approx(1.5F));
    float low = 0.0F;
    float high = 0.0F;
    for (std::size_t i = 0; i < mesh.value().positions.size(); ++i) {
        low = std::min(low, mesh.value().positions[i].x);
        high = std::max(high, mesh.value().positions[i].x);
        CHECK(mesh.value().positions[i].z == 0.0F);
        CHECK(mesh.value().normals[i].z == Approx(-1.0F)); // up of the file
    }
    CHECK(low == Approx(-1.0F)); // x of the file is along the left of cpfg
    CHECK(high == Approx(0.5F));
}

TEST_CASE("texture coordinates run over each patch, u down its columns") {
    const Result<UserMesh> mesh = read(header() + flat_patch("leaf"));
    REQUIRE(mesh);
    const std::vector<glm::vec2>& coordinates = mesh.value().texture_coordinates;
    CHECK(coordinates.front() == glm::vec2(0.0F, 1.0F)); // first row, first column
    CHECK(coordinates[6] == glm::vec2(0.0F, 0.0F));      // first row, last column
    CHECK(coordinates.back() == glm::vec2(1.0F, 0.0F));
}

TEST_CASE("texture coordinates run over the whole surface") {
    SurfaceName name;
    name.is_whole = true;
    name.row_steps = 2;
    name.column_steps = 3;
    const Result<UserMesh> mesh =
        read_patches(header() + flat_patch("a") + flat_patch("b", 1), name, kMemory);
    REQUIRE(mesh);
    REQUIRE(mesh.value().positions.size() == 2 * 3 * 4);
    for (std::size_t i = 0; i < mesh.value().positions.size(); ++i) {
        const glm::vec3& at = mesh.value().positions[i]; // x from 0.5 to -2.5, y from 0 to 1.5
        const glm::vec2& coordinate = mesh.value().texture_coordinates[i];
        CHECK(coordinate.x == Approx((0.5F - at.x) / 3.0F).margin(1e-6));
        CHECK(coordinate.y == Approx(1.0F - at.y / 1.5F).margin(1e-6));
    }
}

TEST_CASE("triangles are counter-clockwise seen from the side of the normals") {
    const Result<UserMesh> read_mesh = read(header() + flat_patch("leaf"));
    REQUIRE(read_mesh);
    const UserMesh& mesh = read_mesh.value();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        CHECK(test::twice_area(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                               mesh.positions[mesh.indices[i + 2]])
                  .z < 0.0);
    }
}

TEST_CASE("the directions of the file turn the surface") {
    // The surface of the file grows along +Z, its upper side along +Y.
    const Result<UserMesh> mesh =
        read(header("X: 0 Y: 0 Z: 1", "X: 0 Y: 1 Z: 0") + flat_patch("leaf"));
    REQUIRE(mesh);
    for (const glm::vec3& position : mesh.value().positions) {
        CHECK(position.y == Approx(0.0F).margin(1e-6)); // z of the file is constant
        CHECK(position.z <= 1e-6F);                     // y of the file
    }
}

TEST_CASE("patches that share an edge have common normals there") {
    const Result<UserMesh> mesh = read(header() + flat_patch("a") + "\n" + flat_patch("b", 1));
    REQUIRE(mesh);
    CHECK(area(mesh.value()) == Approx(18.0 / 4.0));
}

TEST_CASE("line ends of Windows, a version and no precision are read") {
    std::string text = "VERSION stedit\n" + header() + flat_patch("leaf");
    text.erase(text.find("PRECISION"), std::string("PRECISION S: 4 T: 6\n").size());
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
        text.insert(at, "\r");
    }
    const Result<UserMesh> mesh = read(text);
    REQUIRE(mesh);
    CHECK(mesh.value().positions.size() == 9 * 9);
}

TEST_CASE("mistakes in a surface file are named with their line") {
    CHECK(problem("") == "line 1: the file ends where numbers should follow");
    CHECK(problem("a b c") == "line 1: `a` is not a number");
    CHECK(problem("0 1 0 1\n") == "line 1: the box lacks a number");
    CHECK(problem("0 1 0 1 0 1\nSIZE: 1\n") == "line 2: expected `CONTACT POINT`");
    CHECK(problem("0 1 0 1 0 1\nPRECISION S: 1000000 T: 5\n") ==
          "line 2: a precision of 1000000 is not from 1 to 64");
    CHECK(problem("0 1 0 1 0 1\nPRECISION S: 0 T: 5\n") ==
          "line 2: a precision of 0 is not from 1 to 64");
    CHECK(problem(header("X: 0 Y: 0 Z: 0")) == "line 5: HEADING has no direction");
    CHECK(problem(header("X: 0 Y: 1 Z: 0", "X: 0 Y: 2 Z: 0")) ==
          "line 6: HEADING and UP are parallel");
    CHECK(problem(header("X: 0 Y: nan Z: 0")) == "line 5: nan is not a finite number below 1e30");
    CHECK(problem(header("X: 0 Y: 1 Z: 0", "X: 0 Y: 0 Z: 1", "0")) ==
          "line 7: a size of 0 is not above 0");
    CHECK(problem(header()) == "there is no patch in it");
    CHECK(problem(header() + "leaf\nAL: ~\n") == "line 9: expected `TOP COLOR:`");
    const std::string whole = header() + flat_patch("leaf");
    CHECK(problem(whole.substr(0, whole.rfind('2'))) ==
          "line 16: a row of control points lacks a number");
    CHECK(problem(whole + "next\n") == "line 18: the file ends before `TOP COLOR:`");
    std::string infinite = whole;
    infinite.replace(infinite.rfind("3 0 1"), 1, "1e300");
    CHECK(problem(infinite) == "line 16: 1e300 is not a finite number below 1e30");
}

TEST_CASE("a file cut anywhere is read or named, without a fault") {
    const std::string whole = header() + flat_patch("a") + flat_patch("b", 1);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Result<UserMesh> mesh = read(whole.substr(0, length));
        if (!mesh) {
            CHECK_FALSE(mesh.error().message.empty());
        }
    }
}

TEST_CASE("the mesh of patches keeps within the limit of memory") {
    const Result<UserMesh> mesh = read_patches(header() + flat_patch("leaf"), {}, 2000);
    REQUIRE_FALSE(mesh);
    CHECK(mesh.error().kind == ErrorKind::Limit);
}

TEST_CASE("many patches at one place are read in a time linear in their count") {
    std::string text = header();
    for (int i = 0; i < 300; ++i) {
        text += flat_patch("leaf");
    }
    CHECK(read(text));
}

TEST_CASE("a surface file may have a scale") {
    const Result<UserMesh> mesh =
        read_object_file("leaf.s#0.5", header() + flat_patch("leaf"), kMemory);
    REQUIRE(mesh);
    CHECK(mesh.value().length() == Approx(0.75F));
}
