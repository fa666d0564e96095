// SPDX-License-Identifier: MIT
// Arrangement of pictures in arrays, and enlarged pictures.
#include "viewer/gl/impl/picture_arrays.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

using namespace lsys;
using namespace lsys::view;

namespace {

std::shared_ptr<const Texture>
picture(std::uint32_t width, std::uint32_t height, std::uint8_t opacity = 255) {
    Texture texture{width, height, {}};
    texture.texels.assign(std::size_t{4} * width * height, 200);
    texture.texels[3] = opacity; // of the first texel
    for (std::size_t i = 7; i < texture.texels.size(); i += 4) {
        texture.texels[i] = 255;
    }
    return std::make_shared<const Texture>(std::move(texture));
}

} // namespace

TEST_CASE("pictures of about one size are layers of one array, as far as one program draws them") {
    const auto bark = picture(64, 64);
    const auto normals = picture(64, 64);
    const std::vector<PictureArray> arrays = arrange_pictures({
        {picture(64, 64), nullptr},
        {picture(48, 64), nullptr}, // becomes as wide as the others
        {picture(40, 64), nullptr}, // would become more than half wider
        {bark, normals},
        {picture(64, 64, 0), nullptr},
        {picture(64, 48, 0), nullptr},
        {picture(64, 64, 0), normals},
        {picture(64, 64), picture(32, 32)}, // a normal map of another size
        {nullptr, normals},
    });
    std::vector<std::vector<std::size_t>> found; // layers, width, holes, normal maps
    for (const PictureArray& array : arrays) {
        found.push_back({array.layers.size(), array.width, array.has_holes ? 1U : 0U,
                         array.has_normal_maps ? 1U : 0U});
    }
    std::sort(found.begin(), found.end());
    CHECK(found == std::vector<std::vector<std::size_t>>{{1, 40, 0, 0},
                                                         {1, 64, 0, 1},
                                                         {1, 64, 0, 1},
                                                         {1, 64, 0, 1},
                                                         {1, 64, 1, 1},
                                                         {2, 64, 0, 0},
                                                         {2, 64, 1, 0}});
}

TEST_CASE("an array has at most 16 layers, and no layer grows by more than 1 MiB") {
    std::vector<MaterialPictures> many;
    for (int i = 0; i < 20; ++i) {
        many.push_back({picture(8, 8), nullptr});
    }
    const std::vector<PictureArray> arrays = arrange_pictures(many);
    REQUIRE(arrays.size() == 2);
    CHECK(arrays[0].layers.size() == kMaxPictureLayers);
    CHECK(arrays[1].layers.size() == 4);
    CHECK(arrange_pictures({{picture(1024, 1024), nullptr}, {picture(900, 900), nullptr}}).size() ==
          1);
    CHECK(arrange_pictures({{picture(1024, 1024), nullptr}, {picture(800, 800), nullptr}}).size() ==
          2);
}

TEST_CASE("an enlarged picture repeats without a seam and keeps its colours") {
    Texture stripes{4, 2, {}};
    for (std::size_t i = 0; i < 8; ++i) {
        const auto red = static_cast<std::uint8_t>(i % 4 < 2 ? 240 : 40);
        stripes.texels.insert(stripes.texels.end(), {red, 100, 60, 255});
    }
    const Texture large = enlarged(stripes, 6, 3);
    REQUIRE(large.texels.size() == std::size_t{4} * 6 * 3);
    int sum = 0;
    for (std::size_t x = 0; x < 6; ++x) {
        sum += large.texels[4 * x];
        CHECK(large.texels[4 * x + 1] == 100);
        CHECK(large.texels[4 * x + 3] == 255);
        // The rows are equal, and a red and the one 3 columns beside it have the sum 240 + 40.
        CHECK(large.texels[4 * x] == large.texels[4 * (12 + x)]);
        CHECK(std::abs(large.texels[4 * x] + large.texels[4 * ((x + 3) % 6)] - 280) <= 1);
    }
    CHECK(std::abs(sum - 6 * 140) <= 3);
    // The first column is mixed with the last one, because the picture repeats.
    CHECK(large.texels[0] < 240);
    CHECK(large.texels[0] > 140);
    CHECK(large.texels[4] == 240);
}

TEST_CASE("transparent texels do not colour an enlarged picture") {
    Texture half{2, 1, {250, 0, 0, 255, 0, 0, 250, 0}};
    const Texture large = enlarged(half, 3, 1);
    for (std::size_t x = 0; x < 3; ++x) {
        if (large.texels[4 * x + 3] != 0) {
            CHECK(large.texels[4 * x] == 250);
        }
    }
}
