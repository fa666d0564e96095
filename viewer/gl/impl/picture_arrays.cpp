// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/picture_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lsys::view {

namespace {

// Max number of bytes by which a layer may be larger than its picture.
constexpr std::uint64_t kMaxGrowth = std::uint64_t{1} << 20;

bool has_any(const MaterialPictures& pictures) {
    return pictures.colour != nullptr || pictures.normal_map != nullptr;
}

/// The picture that sets the size of a layer.
const Texture& sized(const MaterialPictures& pictures) {
    return pictures.colour != nullptr ? *pictures.colour : *pictures.normal_map;
}

/// Whether the pictures need an array of their own: the normal map has another size than the colour
/// picture, or there is no colour picture.
bool is_alone(const MaterialPictures& pictures) {
    return pictures.normal_map != nullptr &&
           (pictures.colour == nullptr || pictures.colour->width != pictures.normal_map->width ||
            pictures.colour->height != pictures.normal_map->height);
}

bool fits(const Texture& picture, const PictureArray& array) {
    const std::uint64_t area = std::uint64_t{array.width} * array.height;
    return picture.width <= array.width && picture.height <= array.height &&
           2 * array.width <= 3 * picture.width && 2 * array.height <= 3 * picture.height &&
           4 * (area - std::uint64_t{picture.width} * picture.height) <= kMaxGrowth;
}

/// Pictures of all layers, enlarged to the size of layers unless is_alone(). `picture`: which ones.
std::vector<Texture> layers_of(const PictureArray& array,
                               std::shared_ptr<const Texture> MaterialPictures::*picture) {
    std::vector<Texture> layers;
    for (const MaterialPictures& layer : array.layers) {
        if (const std::shared_ptr<const Texture>& each = layer.*picture; each != nullptr) {
            const bool is_kept =
                is_alone(layer) || (each->width == array.width && each->height == array.height);
            layers.push_back(is_kept ? *each : enlarged(*each, array.width, array.height));
        }
    }
    return layers;
}

} // namespace

Texture enlarged(const Texture& texture, std::uint32_t width, std::uint32_t height) {
    Texture large{width, height, {}};
    large.texels.resize(std::size_t{4} * width * height);
    // Place of a texel of `large` in `texture`, from the middle of its first texel on.
    const auto place = [](std::uint32_t i, std::uint32_t from, std::uint32_t to) {
        return (static_cast<float>(i) + 0.5F) * static_cast<float>(from) / static_cast<float>(to) -
               0.5F;
    };
    for (std::uint32_t y = 0; y < height; ++y) {
        const float at_y = place(y, texture.height, height);
        const float low_y = std::floor(at_y);
        for (std::uint32_t x = 0; x < width; ++x) {
            const float at_x = place(x, texture.width, width);
            const float low_x = std::floor(at_x);
            std::array<float, 4> sum{};
            std::array<float, 3> plain{};
            for (std::uint32_t k = 0; k < 4; ++k) {
                const auto beside = [](float low, std::uint32_t step, std::uint32_t side) {
                    return static_cast<std::uint32_t>(static_cast<std::int64_t>(low) + step +
                                                      side) %
                           side;
                };
                const std::size_t from =
                    std::size_t{4} *
                    (std::size_t{beside(low_y, k >> 1U, texture.height)} * texture.width +
                     beside(low_x, k & 1U, texture.width));
                const float weight_x = (k & 1U) != 0 ? at_x - low_x : 1.0F - (at_x - low_x);
                const float weight_y = (k >> 1U) != 0 ? at_y - low_y : 1.0F - (at_y - low_y);
                const float weight = weight_x * weight_y;
                const auto opacity = static_cast<float>(texture.texels[from + 3]);
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto colour = static_cast<float>(texture.texels[from + c]);
                    sum[c] += weight * opacity * colour;
                    plain[c] += weight * colour;
                }
                sum[3] += weight * opacity;
            }
            std::uint8_t* const to =
                large.texels.data() + std::size_t{4} * (std::size_t{y} * width + x);
            for (std::size_t c = 0; c < 3; ++c) {
                to[c] = static_cast<std::uint8_t>(
                    std::lround(sum[3] > 0.0F ? std::min(sum[c] / sum[3], 255.0F) : plain[c]));
            }
            to[3] = static_cast<std::uint8_t>(std::lround(std::min(sum[3], 255.0F)));
        }
    }
    return large;
}

std::vector<PictureArray> arrange_pictures(std::vector<MaterialPictures> pictures) {
    std::vector<PictureArray> arrays;
    while (!pictures.empty()) {
        // Large pictures first, because small ones may become as large.
        const auto largest =
            std::max_element(pictures.begin(), pictures.end(),
                             [](const MaterialPictures& a, const MaterialPictures& b) {
                                 return sized(a).texels.size() < sized(b).texels.size();
                             });
        const MaterialPictures each = std::move(*largest);
        pictures.erase(largest);
        const bool holes = each.colour != nullptr && has_holes(*each.colour);
        const bool bumpy = each.normal_map != nullptr;
        const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const PictureArray& at) {
            return !is_alone(each) && !is_alone(at.layers.front()) && at.has_holes == holes &&
                   at.has_normal_maps == bumpy && at.layers.size() < kMaxPictureLayers &&
                   fits(sized(each), at);
        });
        PictureArray& array = found != arrays.end() ? *found : arrays.emplace_back();
        if (array.layers.empty()) {
            array.width = sized(each).width;
            array.height = sized(each).height;
            array.has_holes = holes;
            array.has_normal_maps = bumpy;
        }
        array.layers.push_back(each);
    }
    return arrays;
}

void PictureArrays::upload(const ForestModel& model, const MaterialTextures& textures) {
    std::vector<MaterialPictures> pictures;
    for (const TreeForm& form : model.forms) {
        for (const InstanceMeshes& level : *form.meshes) {
            for (const Material& material : level.mesh.materials) {
                const MaterialPictures each{material.picture, material.normal_map};
                if (has_any(each) &&
                    std::find(pictures.begin(), pictures.end(), each) == pictures.end()) {
                    pictures.push_back(each);
                }
            }
        }
    }
    std::vector<PictureArray> before =
        std::exchange(arrays_, arrange_pictures(std::move(pictures)));
    texture_bytes_ = 0;
    const auto bytes_of = [](const Texture& texture) { return texture.texels.size() * 4 / 3; };
    for (PictureArray& array : arrays_) {
        const auto same = std::find_if(before.begin(), before.end(), [&](const PictureArray& old) {
            return old.layers == array.layers;
        });
        if (same != before.end()) {
            array = std::move(*same);
            before.erase(same);
        } else {
            if (array.layers.front().colour != nullptr) {
                array.colours = textures.make_colour_array(
                    layers_of(array, &MaterialPictures::colour), array.has_holes);
            }
            if (array.has_normal_maps) {
                array.normal_maps =
                    textures.make_normal_array(layers_of(array, &MaterialPictures::normal_map));
            }
        }
        for (const MaterialPictures& layer : array.layers) {
            const std::uint64_t whole = std::uint64_t{16} * array.width * array.height / 3;
            const bool alone = is_alone(layer);
            texture_bytes_ += layer.colour == nullptr ? 0 : whole;
            texture_bytes_ += layer.normal_map == nullptr ? 0
                              : alone                     ? bytes_of(*layer.normal_map)
                                                          : whole;
        }
    }
}

std::optional<PictureArrays::Place> PictureArrays::place_of(const Material& material) const {
    const MaterialPictures wanted{material.picture, material.normal_map};
    for (std::size_t i = 0; i < arrays_.size() && has_any(wanted); ++i) {
        const std::vector<MaterialPictures>& layers = arrays_[i].layers;
        const auto found = std::find(layers.begin(), layers.end(), wanted);
        if (found != layers.end()) {
            return Place{i, static_cast<std::uint32_t>(found - layers.begin())};
        }
    }
    return std::nullopt;
}

} // namespace lsys::view
