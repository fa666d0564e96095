// SPDX-License-Identifier: MIT
// Reads any bytes as a Wavefront OBJ file. A mesh that is accepted has valid indices, finite
// positions, and normals of unit length.
#include "runtime/meshing/user_mesh.h"
#include "tests/fuzz/read_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    check_mesh(lsys::read_obj(text, kMaxMeshBytes));
    return 0;
}
