// SPDX-License-Identifier: MIT
#include "tests/reference/mesh_file.h"

#include "tests/reference/spelling.h"

#include <algorithm>

namespace lsys::reference {

namespace {

template <typename T>
const T& with_path(const std::vector<T>& files, const std::string& path) {
    return *std::find_if(files.begin(), files.end(),
                         [&](const T& file) { return file.path == path; });
}

} // namespace

const MeshFile& mesh_of(const Grammar& grammar, const std::string& path) {
    return with_path(grammar.meshes, path);
}

const PictureFile& picture_of(const Grammar& grammar, const std::string& path) {
    return with_path(grammar.pictures, path);
}

Surface surface_of(const MeshFile& mesh) {
    const auto corner = [&](std::size_t index) {
        const std::array<float, 3>& vertex = mesh.vertices[index];
        return Vector{static_cast<double>(vertex[0]), static_cast<double>(vertex[1]),
                      static_cast<double>(vertex[2])};
    };
    Surface surface;
    for (const std::vector<std::size_t>& face : mesh.faces) {
        for (std::size_t i = 2; i < face.size(); ++i) {
            surface.push_back({corner(face[0]), corner(face[i - 1]), corner(face[i])});
        }
    }
    return surface;
}

double half_area(const MeshFile& mesh) {
    double sum = 0;
    for (const Triangle& triangle : surface_of(mesh)) {
        sum += length_of(cross(difference(triangle[1], triangle[0]),
                               difference(triangle[2], triangle[0]))) /
               2;
    }
    return sum / 2;
}

double length_of_object(const MeshFile& mesh) {
    float bottom = mesh.vertices.front()[1];
    float top = bottom;
    for (const std::array<float, 3>& vertex : mesh.vertices) {
        bottom = std::min(bottom, vertex[1]);
        top = std::max(top, vertex[1]);
    }
    return static_cast<double>(top - bottom);
}

GreyPicture grey_of(const PictureFile& picture) {
    GreyPicture grey{picture.columns, picture.rows, {}};
    const double white = picture.depth == 8 ? 255 : 65535;
    for (std::size_t i = 0; i < picture.columns * picture.rows; ++i) {
        const std::uint16_t* const sample = &picture.samples[i * picture.channels];
        const double value = picture.channels < 3
                                 ? sample[0]
                                 : 0.2126 * sample[0] + 0.7152 * sample[1] + 0.0722 * sample[2];
        grey.values.push_back(value / white);
    }
    return grey;
}

std::string obj_text(const MeshFile& mesh) {
    std::string text;
    for (const std::array<float, 3>& vertex : mesh.vertices) {
        text += "v";
        for (const float coordinate : vertex) {
            text += coordinate < 0 ? " -" : " ";
            text += spell_number(coordinate < 0 ? -coordinate : coordinate, nullptr);
        }
        text += "\n";
    }
    for (const std::vector<std::size_t>& face : mesh.faces) {
        text += "f";
        for (const std::size_t index : face) {
            text += " " + std::to_string(index + 1);
        }
        text += "\n";
    }
    return text;
}

} // namespace lsys::reference
