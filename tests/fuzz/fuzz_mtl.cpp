// SPDX-License-Identifier: MIT
// Reads any bytes as the materials of an OBJ file. The first line has the names of the wanted
// materials, separated by blanks; the rest is the MTL file. Picture names stand at their offsets.
#include "runtime/meshing/user_mesh.h"
#include "tests/fuzz/input_bytes.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    InputBytes input(data, size);
    std::string_view names = input.line();
    std::vector<lsys::ObjName> wanted;
    while (!names.empty()) {
        const std::string_view name = names.substr(0, names.find(' '));
        wanted.push_back({std::string(name)});
        names.remove_prefix(std::min(names.size(), name.size() + 1));
    }
    const std::string_view text = input.rest();
    for (const auto& [material, picture] : lsys::pictures_of(text, wanted)) {
        for (const lsys::ObjName* name : {&picture.file, &picture.opacity, &picture.normal_map}) {
            if (!name->name.empty() &&
                text.substr(name->offset).substr(0, name->name.size()) != name->name) {
                std::abort();
            }
        }
        if (!std::isfinite(picture.bump)) {
            std::abort();
        }
    }
    return 0;
}
