// SPDX-License-Identifier: MIT
// Reads exported files with assimp and compares them, triangle by triangle, with the PLY of the
// same name, whose plain binary layout is read here. Usage: read_assimp FOLDER
//
// assimp keeps the vertices of PLY and OFF; their number must be that of counts.txt. For OBJ, STL
// and glTF assimp makes its own vertices; in files of these formats, each corner of a triangle must
// lie at its place in the PLY.
//
// --forest: FOLDER has expanded.glb and expanded.gltf. Their nodes place the triangles of
// baked.ply, in another order.
//
// --box FILE: prints, as JSON, the seconds and memory of reading, the number of nodes with meshes,
// and the box of all nodes but `ground`.
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <utility>
#include <vector>

namespace {

using Point = std::array<float, 3>;

struct Triangles {
    std::vector<Point> corners; // three per triangle, in the order of the file
    std::uint64_t vertices = 0;
};

int failures = 0;

void fail(const std::filesystem::path& path, const std::string& what) {
    std::printf("%s: %s\n", path.filename().c_str(), what.c_str());
    ++failures;
}

/// The number after `key` in a header.
std::uint64_t number_after(const std::string& text, const std::string& key) {
    return std::stoull(text.substr(text.find(key) + key.size()));
}

Triangles read_ply(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::string mark = "end_header\n";
    const std::size_t data = bytes.find(mark) + mark.size();
    const std::string header = bytes.substr(0, data);
    const bool textured = header.find("property float s") != std::string::npos;
    const bool coloured = header.find("property uchar red") != std::string::npos;
    const std::size_t stride = 24U + (textured ? 8U : 0U) + (coloured ? 3U : 0U);
    Triangles triangles;
    triangles.vertices = number_after(header, "element vertex ");
    const std::uint64_t faces = number_after(header, "element face ");
    const std::size_t first_face = data + triangles.vertices * stride;
    if (bytes.size() != first_face + 13 * faces) {
        fail(path, "not as long as its header says");
        return triangles;
    }
    for (std::uint64_t i = 0; i < faces; ++i) {
        std::array<std::uint32_t, 3> corners{};
        std::memcpy(corners.data(), bytes.data() + first_face + 13 * i + 1, sizeof corners);
        for (const std::uint32_t corner : corners) {
            Point point{};
            std::memcpy(point.data(), bytes.data() + data + corner * stride, sizeof point);
            triangles.corners.push_back(point);
        }
    }
    return triangles;
}

bool read_with_assimp(const std::filesystem::path& path, Triangles& triangles) {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(path.string(), 0);
    if (scene == nullptr) {
        fail(path, importer.GetErrorString());
        return false;
    }
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMesh& mesh = *scene->mMeshes[m];
        triangles.vertices += mesh.mNumVertices;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) {
                fail(path, "a face that is no triangle");
                return false;
            }
            for (unsigned c = 0; c < 3; ++c) {
                const aiVector3D& v = mesh.mVertices[face.mIndices[c]];
                triangles.corners.push_back({v.x, v.y, v.z});
            }
        }
    }
    return true;
}

void sort_triangles(Triangles& triangles) {
    std::vector<std::array<Point, 3>> sorted(triangles.corners.size() / 3);
    for (std::size_t i = 0; i < triangles.corners.size(); ++i) {
        sorted[i / 3][i % 3] = triangles.corners[i];
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < triangles.corners.size(); ++i) {
        triangles.corners[i] = sorted[i / 3][i % 3];
    }
}

/// The greatest difference between coordinates of corresponding corners, as a fraction of the
/// greatest coordinate.
double difference(const Triangles& a, const Triangles& b) {
    double extent = 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = static_cast<double>(a.corners[i][axis]);
            extent = std::max(extent, std::abs(x));
            worst = std::max(worst, std::abs(x - static_cast<double>(b.corners[i][axis])));
        }
    }
    return extent == 0.0 ? worst : worst / extent;
}

void compare(const std::filesystem::path& path, const Triangles& expected) {
    Triangles found;
    if (!read_with_assimp(path, found)) {
        return;
    }
    const std::string extension = path.extension().string();
    if (found.corners.size() != expected.corners.size()) {
        fail(path, std::to_string(found.corners.size() / 3) + " triangles instead of " +
                       std::to_string(expected.corners.size() / 3));
        return;
    }
    const bool keeps_vertices = extension == ".ply" || extension == ".off";
    if (keeps_vertices && found.vertices != expected.vertices) {
        fail(path, std::to_string(found.vertices) + " vertices instead of " +
                       std::to_string(expected.vertices));
    }
    // assimp's fast parser of decimal numbers loses the last bits.
    const double allowed = extension == ".obj" || extension == ".off" ? 1e-6 : 0.0;
    if (extension == ".glb" || extension == ".gltf") {
        Triangles sorted = expected;
        sort_triangles(sorted);
        sort_triangles(found);
        if (difference(sorted, found) > allowed) {
            fail(path, "corners lie elsewhere");
        }
    } else if (difference(expected, found) > allowed) {
        fail(path, "corners lie elsewhere");
    }
}

/// Bounds of the corners, sum of the corners, total area and number of triangles, which do not
/// depend on the order of the triangles.
struct MeshTotals {
    std::array<double, 3> low{1e30, 1e30, 1e30};
    std::array<double, 3> high{-1e30, -1e30, -1e30};
    std::array<double, 3> sum{};
    double area = 0.0;
    std::uint64_t triangles = 0;

    void bound(const aiVector3D& at) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], static_cast<double>(at[axis]));
            high[axis] = std::max(high[axis], static_cast<double>(at[axis]));
        }
    }
    void add(const std::array<aiVector3D, 3>& corners) {
        const aiVector3D cross = (corners[1] - corners[0]) ^ (corners[2] - corners[0]);
        area += 0.5 * static_cast<double>(cross.Length());
        ++triangles;
        for (const aiVector3D& corner : corners) {
            bound(corner);
            for (unsigned axis = 0; axis < 3; ++axis) {
                sum[axis] += static_cast<double>(corner[axis]);
            }
        }
    }
};

MeshTotals totals_of(const aiScene& scene) {
    MeshTotals whole;
    std::vector<std::pair<const aiNode*, aiMatrix4x4>> pending{
        {scene.mRootNode, scene.mRootNode->mTransformation}};
    while (!pending.empty()) {
        const auto [node, matrix] = pending.back();
        pending.pop_back();
        for (unsigned m = 0; m < node->mNumMeshes; ++m) {
            const aiMesh& mesh = *scene.mMeshes[node->mMeshes[m]];
            // Include vertices without faces, because readers bound and upload them.
            for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
                whole.bound(matrix * mesh.mVertices[v]);
            }
            for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
                const unsigned* const i = mesh.mFaces[f].mIndices;
                whole.add({matrix * mesh.mVertices[i[0]], matrix * mesh.mVertices[i[1]],
                           matrix * mesh.mVertices[i[2]]});
            }
        }
        for (unsigned c = 0; c < node->mNumChildren; ++c) {
            const aiNode* const child = node->mChildren[c];
            pending.emplace_back(child, matrix * child->mTransformation);
        }
    }
    return whole;
}

void compare_forest(const std::filesystem::path& path, const Triangles& baked) {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(path.string(), 0);
    if (scene == nullptr) {
        fail(path, importer.GetErrorString());
        return;
    }
    const MeshTotals found = totals_of(*scene);
    MeshTotals wanted;
    for (std::size_t i = 0; i + 2 < baked.corners.size(); i += 3) {
        std::array<aiVector3D, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const Point& p = baked.corners[i + c];
            corners[c] = aiVector3D(p[0], p[1], p[2]);
        }
        wanted.add(corners);
    }
    if (found.triangles != wanted.triangles) {
        fail(path, std::to_string(found.triangles) + " triangles instead of " +
                       std::to_string(wanted.triangles));
    }
    if (!(std::abs(found.area - wanted.area) <= 1e-4 * wanted.area)) {
        fail(path, "another area");
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double count = 3.0 * static_cast<double>(wanted.triangles);
        if (!(std::abs(found.low[axis] - wanted.low[axis]) < 1e-3) ||
            !(std::abs(found.high[axis] - wanted.high[axis]) < 1e-3) ||
            !(std::abs(found.sum[axis] - wanted.sum[axis]) < 1e-3 * count)) {
            fail(path, "corners lie elsewhere");
        }
    }
}

int read_forest(const std::filesystem::path& folder) {
    const Triangles baked = read_ply(folder / "baked.ply");
    for (const char* name : {"expanded.glb", "expanded.gltf"}) {
        compare_forest(folder / name, baked);
    }
    std::printf("2 files read, %d failures\n", failures);
    return failures == 0 && !baked.corners.empty() ? 0 : 1;
}

int print_box(const std::filesystem::path& path) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(path.string(), 0);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    const double worked = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
    if (scene == nullptr) {
        fail(path, importer.GetErrorString());
        return 1;
    }
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    MeshTotals box;
    std::uint64_t nodes = 0;
    std::vector<std::pair<const aiNode*, aiMatrix4x4>> pending{
        {scene->mRootNode, scene->mRootNode->mTransformation}};
    while (!pending.empty()) {
        const auto [node, matrix] = pending.back();
        pending.pop_back();
        for (unsigned c = 0; c < node->mNumChildren; ++c) {
            const aiNode* const child = node->mChildren[c];
            pending.emplace_back(child, matrix * child->mTransformation);
        }
        if (node->mNumMeshes == 0 || std::string(node->mName.C_Str()) == "ground") {
            continue;
        }
        ++nodes;
        for (unsigned m = 0; m < node->mNumMeshes; ++m) {
            const aiMesh& mesh = *scene->mMeshes[node->mMeshes[m]];
            for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
                box.bound(matrix * mesh.mVertices[v]);
            }
        }
    }
    std::printf(
        "{\"reader\":\"assimp %u.%u.%u\",\"seconds\":%.3f,\"processor\":%.3f,\"megabytes\":%.1f,"
        "\"instances\":%llu,\"low\":[%.9g,%.9g,%.9g],\"high\":[%.9g,%.9g,%.9g]}\n",
        aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch(), time.count(), worked,
        static_cast<double>(use.ru_maxrss) / 1024.0, static_cast<unsigned long long>(nodes),
        box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]);
    return 0;
}

} // namespace

int main(int argument_count, char** arguments) {
    if (argument_count == 3 && std::string(arguments[1]) == "--forest") {
        return read_forest(arguments[2]);
    }
    if (argument_count == 3 && std::string(arguments[1]) == "--box") {
        return print_box(arguments[2]);
    }
    if (argument_count != 2) {
        std::fputs("usage: read_assimp [--forest] FOLDER | --box FILE\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = arguments[1];
    std::ifstream counts(folder / "counts.txt");
    std::string name;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t parts = 0;
    int files = 0;
    while (counts >> name >> vertices >> triangles >> parts) {
        const std::filesystem::path ply = folder / (name + ".ply");
        const Triangles expected = read_ply(ply);
        if (expected.vertices != vertices || expected.corners.size() != 3 * triangles) {
            fail(ply, "other counts than counts.txt has");
        }
        for (const char* extension : {".ply", ".obj", ".off", ".stl", ".glb", ".gltf"}) {
            compare(folder / (name + extension), expected);
            ++files;
        }
    }
    std::printf("%d files read, %d failures\n", files, failures);
    return failures == 0 && files > 0 ? 0 : 1;
}
