// SPDX-License-Identifier: MIT
#include "runtime/pipeline/named_files.h"

#include "grammar/base/paths.h"
#include "runtime/meshing/looks.h"
#include "runtime/turtle/surface_name.h"

namespace lsys {

std::vector<std::string> named_files(const Bytecode& bytecode, const std::string& file) {
    std::vector<std::string> paths = bytecode.files;
    paths.push_back(file);
    const auto folder = path_of(file).parent_path();
    const auto add = [&](const std::string& name) {
        if (!name.empty()) {
            paths.push_back(path_text(folder / path_of(name)));
        }
    };
    for (const BytecodeSymbol& symbol : bytecode.symbols) {
        if (symbol.turtle == TurtleOperation::MeshFile ||
            symbol.turtle == TurtleOperation::PolygonBegin) {
            add(path_of_object(symbol.mesh_file));
        }
    }
    for (const BytecodeMaterial& material : bytecode.materials) {
        add(std::string(picture_name(material.picture.path).path));
        add(material.normal.path);
    }
    for (const BytecodeEnvironment& environment : bytecode.environments) {
        for (const EnvironmentSurface& surface : environment.surfaces) {
            add(surface.path);
        }
    }
    return paths;
}

} // namespace lsys
