// SPDX-License-Identifier: MIT
// Writes the meshes of tests/support/meshes.h and a drawing in every format.
// Usage: write_meshes FOLDER
// FOLDER/counts.txt gets a line `NAME VERTICES TRIANGLES PARTS` for each mesh.
#include "runtime/export/export.h"
#include "tests/support/meshes.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace lsys;

namespace {

bool write_file(const std::filesystem::path& path,
                const Mesh& mesh,
                const Skeleton& skeleton,
                const ExportInfo& info) {
    std::ofstream file(path, std::ios::binary);
    const auto format = format_of_path(path.string());
    const Outcome<void> written =
        format
            ? export_mesh(mesh, skeleton, *format, info,
                          [&file](std::string_view bytes) {
                              file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
                              return file.good();
                          })
            : write_mtl(mesh, info, [&file](std::string_view bytes) {
                  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
                  return file.good();
              });
    file.close();
    if (!written || !file) {
        std::fprintf(stderr, "%s: not written\n", path.string().c_str());
        return false;
    }
    return true;
}

bool write_buffer(const std::filesystem::path& path, const Mesh& mesh, const ExportInfo& info) {
    std::ofstream file(path, std::ios::binary);
    const Outcome<void> written =
        write_gltf_buffer(mesh, {}, info, [&file](std::string_view bytes) {
            file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
            return file.good();
        });
    return written.ok() && file.good();
}

/// Writes the pictures that lie beside a file of the format.
bool write_pictures(const std::filesystem::path& folder,
                    const Mesh& mesh,
                    ExportFormat format,
                    const ExportInfo& info) {
    const Outcome<std::vector<PictureFile>> files = make_picture_files(mesh, format, info);
    bool succeeded = files.ok();
    for (const PictureFile& picture : files.value()) {
        std::ofstream file(folder / picture.name, std::ios::binary);
        file << picture.bytes;
        succeeded = succeeded && file.good();
    }
    return succeeded;
}

/// A crooked line with a branch and a polygon; its widths decrease.
Skeleton drawing() {
    Skeleton skeleton;
    glm::vec3 at(0.0F);
    for (int i = 0; i < 60; ++i) {
        const float angle = 0.2F * static_cast<float>(i);
        Segment segment;
        segment.base = at;
        segment.length = 1.0F + 0.1F * static_cast<float>(i);
        segment.frame = glm::angleAxis(angle, glm::vec3(0.0F, 0.0F, 1.0F));
        segment.base_radius = 0.4F - 0.1F * static_cast<float>(i / 20);
        segment.tip_radius = segment.base_radius;
        segment.parent = i == 0 ? kNoSegment : static_cast<std::uint32_t>(i - 1);
        segment.linked = i != 0;
        segment.colour = static_cast<std::uint16_t>(i / 15);
        skeleton.segments.push_back(segment);
        at = tip(segment);
    }
    skeleton.corners = {at, at + glm::vec3(9.0F, 3.0F, 0.0F), at + glm::vec3(5.0F, 9.0F, 2.0F)};
    skeleton.polygons.push_back({.first_corner = 0, .corner_count = 3, .colour = 1});
    return skeleton;
}

} // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: write_meshes FOLDER\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = arguments[1];
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);

    Mesh bare = test::plant_mesh();
    bare.texture_coordinates.clear();
    bare.tangents.clear();
    bare.colours.clear();
    Mesh unwieldy = test::plant_mesh();
    unwieldy.normals[3] = glm::vec3(0.0F);
    unwieldy.tangents[4] *= glm::vec4(2.0F, 2.0F, 2.0F, 0.0F);
    for (Material& material : unwieldy.materials) {
        material.name = "7 \"\\<\n\xC3\xA4\xFF";
    }
    const std::array<std::pair<const char*, Mesh>, 7> meshes{{
        {"triangle", test::triangle_mesh()},
        {"cube", test::cube_mesh()},
        {"tube", test::tube_mesh(40, 12)},
        {"plant", test::plant_mesh()},
        {"bare", bare},
        {"unwieldy", unwieldy},
        {"large", test::large_mesh(100000)},
    }};
    ExportInfo info{.grammar = "hand \"made\" <&>.lsys",
                    .seed = 7,
                    .generations = 3,
                    .generator = "write_meshes",
                    .mtl_name = "",
                    .picture_prefix = ""};
    bool succeeded = true;
    std::ofstream counts(folder / "counts.txt");
    for (const auto& [name, mesh] : meshes) {
        info.mtl_name = std::string(name) + ".mtl";
        info.picture_prefix = name;
        succeeded = write_file(folder / info.mtl_name, mesh, {}, info) && succeeded;
        for (const ExportFormat format : export_formats()) {
            const FormatTraits& traits = traits_of(format);
            if (traits.uses_mesh) {
                const std::string file = fmt::format("{}.{}", name, traits.name);
                succeeded = write_pictures(folder, mesh, format, info) && succeeded;
                succeeded = write_file(folder / file, mesh, {}, info) && succeeded;
            }
        }
        for (const auto& [ending, compression] :
             {std::pair{"separate.gltf", ExportCompression::None},
              {"quantize.glb", ExportCompression::Quantize},
              {"quantize.gltf", ExportCompression::Quantize},
              {"meshopt.glb", ExportCompression::Meshopt},
              {"meshopt.gltf", ExportCompression::Meshopt}}) {
            const std::string file = fmt::format("{}.{}", name, ending);
            ExportInfo form = info;
            form.compression = compression;
            if (compression == ExportCompression::None) {
                form.buffer_name = fmt::format("{}.separate.bin", name);
                form.picture_prefix = fmt::format("{}.separate", name);
                succeeded = write_pictures(folder, mesh, ExportFormat::Gltf, form) && succeeded;
                succeeded = write_buffer(folder / form.buffer_name, mesh, form) && succeeded;
            }
            succeeded = write_file(folder / file, mesh, {}, form) && succeeded;
        }
        counts << name << ' ' << mesh.positions.size() << ' ' << mesh.indices.size() / 3 << ' '
               << mesh.parts.size() << '\n';
    }
    succeeded = write_file(folder / "drawing.svg", {}, drawing(), info) && succeeded;
    return succeeded && counts.good() ? 0 : 1;
}
