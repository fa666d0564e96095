// SPDX-License-Identifier: MIT
// Reading Wavefront OBJ: every notation of a face, computed values, refused files.
#include "runtime/meshing/user_mesh.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;

namespace {

constexpr std::uint64_t kPlenty = std::uint64_t{1} << 40; // bytes

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

UserMesh read(const std::string& text) {
    Result<UserMesh> result = read_obj(text, kPlenty);
    INFO((result.ok() ? "" : result.error().message));
    REQUIRE(result.ok());
    UserMesh mesh = std::move(result.value());
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    REQUIRE((mesh.texture_coordinates.empty() ||
             mesh.texture_coordinates.size() == mesh.positions.size()));
    for (const std::uint32_t index : mesh.indices) {
        REQUIRE(index < mesh.positions.size());
    }
    for (const glm::vec3& normal : mesh.normals) {
        REQUIRE(glm::length(normal) == Approx(1.0F).margin(1e-5));
    }
    return mesh;
}

std::string message(const std::string& text) {
    const Result<UserMesh> result = read_obj(text, kPlenty);
    return result.ok() ? "read" : result.error().message;
}

} // namespace

TEST_CASE("an OBJ quad becomes a fan with normals") {
    const UserMesh mesh = read(kSquare + "f 1 2 3 4\n");
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    CHECK(mesh.texture_coordinates.empty());
    for (const glm::vec3& normal : mesh.normals) {
        CHECK(normal == glm::vec3(0, 0, 1));
    }
    CHECK(mesh.length() == 1.0F);
}

TEST_CASE("the length of a mesh is its extent along y, wherever its origin is") {
    for (const auto& [low, high] :
         {std::pair(-0.25, 0.75), std::pair(-3.0, -2.0), std::pair(5.0, 6.0)}) {
        CAPTURE(low, high);
        const std::string bottom = std::to_string(low);
        const UserMesh mesh = read("v 0 " + bottom + " 0\nv 1 " + bottom + " 0\nv 1 " +
                                   std::to_string(high) + " 0\nf 1 2 3\n");
        CHECK(mesh.length() == 1.0F);
    }
    CHECK(read("v 0 2 0\nv 1 2 0\nv 1 2 1\nf 1 2 3\n").length() == 0.0F);
}

TEST_CASE("every notation of an index of an OBJ face") {
    const std::string head = kSquare + "vt 0 0\nvt 1 0.25\nvn 0 0 5\n";
    const auto form = GENERATE(as<std::string>(), "f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1",
                               "f 1/1/1 2/2/1 3/1/1", "f -4/-2/-1 -3/-1/-1 -2/-2/-1",
                               "f 1/1/ 2/2/ 3/1/", "f 1 2 3 # a comment", "f 1 2 \\\n 3");
    for (const std::string end : {"\n", "\r\n", "\r", ""}) {
        const UserMesh mesh = read(head + form + end);
        CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2});
        CHECK(mesh.positions[2] == glm::vec3(1, 1, 0));
        CHECK(mesh.normals[1] == glm::vec3(0, 0, 1));
        if (form.find("2/2") != std::string::npos) {
            // V is flipped to point down.
            CHECK(mesh.texture_coordinates[1] == glm::vec2(1.0F, 0.75F));
        }
    }
}

TEST_CASE("negative OBJ indices count back from their face, not from the end of the file") {
    const UserMesh mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 3\nf -1 -3 -2");
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.positions[mesh.indices[3]] == glm::vec3(0, 0, 3));
}

TEST_CASE("corners of OBJ faces are shared if all their indices are equal") {
    const UserMesh shared = read(kSquare + "f 1 2 3\nf 1 3 4\n");
    CHECK(shared.positions.size() == 4);
    const UserMesh split = read(kSquare + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/2 4/2\n");
    CHECK(split.positions.size() == 6);
    // The split vertices keep the normal of the original vertex.
    CHECK(split.normals[0] == split.normals[3]);
}

TEST_CASE("missing normals are weighted by area") {
    // A large face in the plane z = 0 and one of a quarter of its area in x = 0 meet in an edge.
    const UserMesh mesh = read("v 0 0 0\nv 0 1 0\nv -4 0 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
    const glm::vec3 expected = glm::normalize(glm::vec3(1, 0, 4));
    CHECK(glm::distance(mesh.normals[0], expected) < 1e-6F);
    CHECK(glm::distance(mesh.normals[1], expected) < 1e-6F);
    CHECK(mesh.normals[2] == glm::vec3(0, 0, 1));
}

TEST_CASE("a normal of length 0 counts as missing") {
    const UserMesh mesh = read(kSquare + "vn 0 0 0\nf 1//1 2//1 3//1");
    CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));
}

TEST_CASE("triangles without area are left out") {
    const UserMesh mesh = read(kSquare + "v 2 0 0\nf 1 2 5\nf 1 1 2\nf 1 2 3 1 2 3");
    CHECK(mesh.indices.size() % 3 == 0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::vec3 c = mesh.positions[mesh.indices[i + 2]];
        CHECK(glm::length(glm::cross(b - a, c - a)) > 0.0F);
    }
}

TEST_CASE("numbers of OBJ files") {
    CHECK(read("v +1 -.5 1e-400\nv 1. 2e0 0\nv 0 0 1 0.5 0.5 0.5\nf 1 2 3").positions[0] ==
          glm::vec3(1.0F, -0.5F, 0.0F));
    CHECK(
        read("v 0 0 0." + std::string(500, '0') + "1\nv 1 0 0\nv 0 1 0\nf 1 2 3").positions[0].z ==
        0.0F);
    for (const std::string number :
         {"x", "nan", "inf", "-inf", "1e39", "1e999", "+-1", "1,5", "+", "0x10", "--1", "1e18.5"}) {
        CHECK(message("v 0 0 " + number) == "line 1: a vertex needs three numbers of up to 1e18");
    }
    CHECK(message("v 0 0 1" + std::string(500, '0')) ==
          "line 1: a vertex needs three numbers of up to 1e18");
    CHECK(message("vt a") == "line 1: a texture coordinate needs numbers of up to 1e18");
    CHECK(message("\n\nvt 0 a") == "line 3: a texture coordinate needs numbers of up to 1e18");
    CHECK(message("vn 0 1") == "line 1: a normal needs three numbers of up to 1e18");
}

TEST_CASE("the message about an invalid OBJ face has its line") {
    const std::string eight = kSquare + kSquare;
    CHECK(message(eight + "\n\n\nf 1 2 9") == "line 12: face refers to vertex 9 of 8");
    CHECK(message(eight + "f 1 2 -9") == "line 9: face refers to vertex -9 of 8");
    CHECK(message(eight + "f 1 2 0") == "line 9: face refers to vertex 0 of 8");
    CHECK(message(eight + "f 1 2 99999999999999999999") ==
          "line 9: face refers to vertex 99999999999999999999 of 8");
    CHECK(message(eight + "f 1/1 2 3") == "line 9: face refers to texture coordinate 1 of 0");
    CHECK(message(eight + "f 1 2//3 3") == "line 9: face refers to normal 3 of 0");
    CHECK(message(eight + "f 1 2") == "line 9: a face needs three corners and has 2");
    CHECK(message(eight + "f \\\n1 \\\n2") == "line 9: a face needs three corners and has 2");
    CHECK(message(eight + "f 1 \\\n2 \\\n3\nf 1 2 9") == "line 12: face refers to vertex 9 of 8");
    for (const std::string corner : {"a", "1.5", "1/2/3/4", "/", "1a"}) {
        CHECK_THAT(message(eight + "vt 0 0\nvt 0 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1 2 " + corner),
                   Catch::Contains("a corner of a face is not written as"));
    }
    CHECK(message("") == "there is no face in it");
    CHECK(message(kSquare) == "there is no face in it");
    CHECK(message(kSquare + "f 1 1 1") == "there is no face in it");
}

TEST_CASE("lines of other kinds are skipped") {
    const std::string text = "# head \\\nmtllib a.mtl\no thing\ng a b\ns off\nusemtl m\nvp 1 2\n"
                             "\x01\x02 what\n  v 0 0 0\n\tv 1 0 0\nv 0 1 0\nl 1 2\np 1\n"
                             "curv2 9\n\n\\\nf 1 2 3\nvendor x";
    CHECK(read(text).indices.size() == 3);
}

TEST_CASE("random OBJ text gives an error or a mesh") {
    const std::string zero(1, '\0');
    CHECK(message("v 0 0 0" + zero) == "line 1: a vertex needs three numbers of up to 1e18");
    CHECK(message(zero + "v\n" + kSquare + "f 1 2 3") == "read");
    CHECK(message(std::string(1'000'000, '\0')) == "there is no face in it");
    CHECK(message("\\") == "there is no face in it");
    CHECK(message("f \\") == "line 1: a face needs three corners and has 0");
    // A face of about 200,000 corners; 100,000 of them are one position with different texture
    // coordinates.
    std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::string face = "f 2";
    for (int i = 1; i <= 100'000; ++i) {
        many += "vt 0 0\n";
        face += " 3 1/" + std::to_string(i);
    }
    CHECK(read(many + face).positions.size() == 100'002);
}

TEST_CASE("an OBJ with any text stays within the limit of memory") {
    constexpr std::size_t kCount = 20'000;
    const auto repeated = [](const std::function<std::string(std::size_t)>& line) {
        std::string text = kSquare;
        for (std::size_t i = 0; i < kCount; ++i) {
            text += line(i);
        }
        return text + "f 1 2 3\n";
    };
    const std::string fan = [] {
        std::string text = kSquare + "f";
        for (std::size_t i = 0; i < kCount; ++i) {
            text += " 1 2 3";
        }
        return text + "\n";
    }();
    const std::vector<std::string> texts{
        repeated([](std::size_t) { return std::string("v 0 0 0\n"); }),
        repeated([](std::size_t) { return std::string("vn 0 0 1\n"); }),
        repeated([](std::size_t) { return std::string("vt 0\n"); }),
        repeated([](std::size_t) { return std::string("f 1 2 3\n"); }),
        repeated([](std::size_t) { return std::string("v 1 2 9\nf -1 2 3\n"); }),
        repeated([](std::size_t i) { return "mtllib " + std::to_string(i) + "\n"; }),
        repeated([](std::size_t i) { return "usemtl " + std::to_string(i) + "\nf 1 2 3\n"; }),
        fan,
    };
    for (const std::string& text : texts) {
        CAPTURE(text.substr(kSquare.size(), 20));
        const Result<UserMesh> whole = read_obj(text, kPlenty);
        REQUIRE(whole.ok());
        CHECK(read_obj(text, 16'000'000).ok());
        const Result<UserMesh> refused = read_obj(text, 100'000);
        REQUIRE(!refused.ok());
        CHECK(refused.error().kind == ErrorKind::Limit);
        CHECK(refused.error().message ==
              "its mesh needs more than the 97.7 KiB that remain of the memory limit");
    }
    CHECK(read(kSquare + "f 1 2 3\n").byte_count() < 1000);
}
