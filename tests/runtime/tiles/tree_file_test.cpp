// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tree_source.h"
#include "runtime/tiles/tree_file.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace lsys {
namespace {

const Region kRegion{-50.0, 20.0, 300.0, 100.0};
const TreeFileScene kScene{0x1234, kRegion, 3};

LargeVector<Tree> some_trees() {
    LargeVector<Tree> trees;
    for (std::uint32_t i = 0; i < 500; ++i) {
        Tree tree;
        tree.position = {-50.0F + static_cast<float>(i * 97 % 300), static_cast<float>(i % 7),
                         20.0F + static_cast<float>(i * 31 % 100)};
        tree.number = i;
        tree.species = static_cast<std::uint16_t>(i % 3);
        tree.age = static_cast<std::uint16_t>(i % 5);
        tree.scale = 0.5F + static_cast<float>(i % 4);
        trees.push_back(tree);
    }
    sort_by_tile(TileGrid(kRegion), trees);
    return trees;
}

std::string file_of(const LargeVector<Tree>& trees) {
    std::string bytes;
    REQUIRE(write_tree_file(kScene.placement_digest, trees, [&](std::string_view piece) {
        bytes += piece;
        return true;
    }));
    return bytes;
}

std::string error_of(std::string_view bytes, const TreeFileScene& scene = kScene) {
    const Result<LargeVector<Tree>> read = read_tree_file(bytes, scene);
    return read ? std::string() : read.error().message;
}

TEST_CASE("a file of trees holds the trees as they were") {
    for (const LargeVector<Tree>& trees : {some_trees(), LargeVector<Tree>()}) {
        const Result<LargeVector<Tree>> read = read_tree_file(file_of(trees), kScene);
        REQUIRE(read);
        REQUIRE(read.value().size() == trees.size());
        CHECK((trees.empty() ||
               std::memcmp(read.value().data(), trees.data(), trees.size() * sizeof(Tree)) == 0));
    }
}

TEST_CASE("every cut and every changed byte of a file of trees is refused") {
    const std::string bytes = file_of(some_trees());
    for (std::size_t size = 0; size < bytes.size(); size += size < 80 ? 1 : 61) {
        CHECK_FALSE(error_of(std::string_view(bytes).substr(0, size)).empty());
    }
    for (std::size_t at = 0; at < bytes.size(); at += at < 80 ? 1 : 61) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 4);
        CHECK_FALSE(error_of(changed).empty());
    }
    CHECK(error_of(bytes + "x") ==
          "the file of trees is cut off or damaged: its header says 500 trees");
    CHECK(error_of("{\"asset\": 1}") == "not a file of trees; `lsc place` writes one");
}

TEST_CASE("trees of another scene are refused") {
    const std::string bytes = file_of(some_trees());
    TreeFileScene other = kScene;
    other.placement_digest = 5;
    CHECK(error_of(bytes, other) ==
          "the trees were placed for another scene, or with other options: place them again");
}

TEST_CASE("trees that the scene cannot have are refused, whatever the checksum says") {
    const std::string impossible = "the file of trees is damaged: the scene has no such tree";
    const auto error_with = [&](auto change) {
        LargeVector<Tree> trees = some_trees();
        change(trees);
        return error_of(file_of(trees));
    };
    CHECK(error_with([](LargeVector<Tree>& trees) { trees[7].species = 3; }) == impossible);
    CHECK(error_with([](LargeVector<Tree>& trees) { trees[7].scale = 0.0F; }) == impossible);
    CHECK(error_with([](LargeVector<Tree>& trees) { trees[7].yaw = NAN; }) == impossible);
    CHECK(error_with([](LargeVector<Tree>& trees) { trees[7].position.x = 250.0F; }) == impossible);
    CHECK(error_with([](LargeVector<Tree>& trees) { std::swap(trees[7], trees[70]); }) ==
          impossible);
}

} // namespace
} // namespace lsys
