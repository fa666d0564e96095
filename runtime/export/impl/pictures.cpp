// SPDX-License-Identifier: MIT
#include "runtime/export/impl/pictures.h"

#include "runtime/base/workers.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_variants.h"
#include "runtime/meshing/looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string_view>

namespace lsys {

namespace {

bool shows_texture(const Material& material) {
    return material.textured && (material.picture != nullptr || has_texture(material.kind));
}

/// Whether the material has a normal map, from a file or of the bark texture.
bool shows_normal_map(const Material& material) {
    return material.normal_map != nullptr ||
           (shows_texture(material) && material.kind == MaterialKind::Bark);
}

bool is_in_use(const Mesh& mesh, std::size_t material) {
    return std::any_of(mesh.parts.begin(), mesh.parts.end(), [material](const MeshPart& part) {
        return part.material == material && part.index_count >= 3;
    });
}

/// The number of the picture with the kind, material, tint and file of `wanted`, added if missing.
std::size_t number_of(std::vector<Picture>& list, const Picture& wanted) {
    const auto found = std::find_if(list.begin(), list.end(), [&wanted](const Picture& picture) {
        return picture.kind == wanted.kind && picture.material == wanted.material &&
               picture.tint == wanted.tint && picture.file_texture == wanted.file_texture;
    });
    if (found != list.end()) {
        return static_cast<std::size_t>(found - list.begin());
    }
    // The file name of a picture keeps its extension.
    constexpr std::string_view kExtension = ".png";
    const bool is_file = wanted.name.ends_with(kExtension);
    const auto stem_of = [&](const std::string& name) {
        return is_file ? name.substr(0, name.size() - kExtension.size()) : name;
    };
    std::vector<std::string> names;
    names.reserve(list.size());
    for (const Picture& picture : list) {
        names.push_back(stem_of(picture.name));
    }
    list.push_back(wanted);
    list.back().name = unique_name(names, stem_of(wanted.name));
    if (is_file) {
        list.back().name += kExtension;
    }
    return list.size() - 1;
}

void tint(Texture& texture, const glm::vec3& colour) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        std::array<std::uint8_t, 256> tinted{};
        for (std::size_t value = 0; value < tinted.size(); ++value) {
            tinted[value] = srgb_byte(colour[static_cast<int>(channel)] *
                                      linear_of_srgb(static_cast<float>(value) / 255.0F));
        }
        for (std::size_t i = channel; i < texture.texels.size(); i += 4) {
            texture.texels[i] = tinted[texture.texels[i]];
        }
    }
}

Texture paint(const Picture& picture) {
    Texture texture = picture.file_texture != nullptr          ? *picture.file_texture
                      : picture.kind == PictureKind::NormalMap ? bark_normals()
                                                               : material_texture(picture.material);
    if (picture.kind == PictureKind::Opacity) {
        for (std::size_t i = 0; i < texture.texels.size(); i += 4) {
            std::fill_n(texture.texels.begin() + static_cast<std::ptrdiff_t>(i), 3,
                        texture.texels[i + 3]);
        }
    } else if (picture.kind == PictureKind::Colour && picture.tint != glm::vec3(1.0F)) {
        tint(texture, picture.tint);
    }
    return texture;
}

std::string encode_picture(const Picture& picture) {
    const bool is_unchanged = picture.file_texture != nullptr &&
                              picture.kind != PictureKind::Opacity &&
                              picture.tint == glm::vec3(1.0F);
    if (is_unchanged) { // avoids a copy, since the file may be large
        return encode_png(*picture.file_texture);
    }
    return encode_png(paint(picture));
}

} // namespace

Pictures find_pictures(const Mesh& mesh, ExportPictures kind, const ExportInfo& info) {
    Pictures pictures;
    pictures.of_materials.resize(mesh.materials.size());
    const bool inside = kind == ExportPictures::Inside;
    if (!info.textures || kind == ExportPictures::None ||
        (!(inside && info.buffer_name.empty()) && info.picture_prefix.empty())) {
        return pictures;
    }
    const bool embedded = inside && info.buffer_name.empty();
    const auto name = [&](const std::string& what) {
        return embedded ? what : one_line(info.picture_prefix) + '.' + identifier(what) + ".png";
    };
    const bool has_tangents = is_complete(mesh, mesh.tangents);
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const Material& material = mesh.materials[i];
        if (!is_complete(mesh, mesh.texture_coordinates) || !is_in_use(mesh, i)) {
            continue;
        }
        Picture wanted;
        wanted.material = material.kind;
        wanted.file_texture = material.picture;
        const bool bark = material.kind == MaterialKind::Bark;
        const std::string what = wanted.file_texture != nullptr ? material.name
                                 : bark                         ? "bark"
                                                                : "leaf";
        MaterialPictures& shown = pictures.of_materials[i];
        if (shows_texture(material)) {
            wanted.tint = inside ? glm::vec3(1.0F) : glm::vec3(material.colour);
            wanted.name = name(inside ? what : material.name);
            shown.colour = number_of(pictures.list, wanted);
            wanted.tint = glm::vec3(1.0F);
            if (kind == ExportPictures::FilesWithOpacity && material.cut_out) {
                wanted.kind = PictureKind::Opacity;
                wanted.name = name(what + " opacity");
                shown.opacity = number_of(pictures.list, wanted);
            }
        }
        if (shows_normal_map(material) && (!inside || has_tangents)) {
            wanted.kind = PictureKind::NormalMap;
            wanted.file_texture = material.normal_map;
            wanted.name =
                name(wanted.file_texture != nullptr ? material.name + " normals" : "bark normals");
            shown.normal_map = number_of(pictures.list, wanted);
        }
    }
    return pictures;
}

std::vector<std::string> encode_pictures(const std::vector<Picture>& pictures,
                                         std::uint32_t threads) {
    std::vector<std::string> files(pictures.size());
    Workers workers(threads);
    workers.for_each(pictures.size(),
                     [&](std::uint64_t i) { files[i] = encode_picture(pictures[i]); });
    const bool all = std::none_of(files.begin(), files.end(),
                                  [](const std::string& file) { return file.empty(); });
    if (!all) {
        throw std::bad_alloc();
    }
    return files;
}

Outcome<std::vector<PictureFile>>
make_picture_files(const Mesh& mesh, ExportFormat format, const ExportInfo& info) {
    return run_within_memory("the pictures", [&]() -> Outcome<std::vector<PictureFile>> {
        std::vector<PictureFile> files;
        const ExportPictures kind = traits_of(format).pictures;
        if (kind != ExportPictures::Inside || !info.buffer_name.empty()) {
            const std::optional<UsdaVariants> variants =
                traits_of(format).variants ? find_usda_variants(mesh, info) : std::nullopt;
            const Pictures pictures =
                find_pictures(variants ? variants->samples : mesh, kind, info);
            std::vector<std::string> encoded = encode_pictures(pictures.list, info.threads);
            for (std::size_t i = 0; i < encoded.size(); ++i) {
                files.push_back({pictures.list[i].name, std::move(encoded[i])});
            }
        }
        return {std::move(files), {}};
    });
}

} // namespace lsys
