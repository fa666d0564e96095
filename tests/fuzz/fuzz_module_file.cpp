// SPDX-License-Identifier: MIT
// Reads any bytes as a .lsb file: it is refused, or it verifies and can be derived within small
// limits. The checksum is corrected first, so that the other checks of reader and verifier are
// reached.
#include "compiler/bytecode/disassemble.h"
#include "compiler/bytecode/module_file.h"
#include "tests/fuzz/small_derivation.h"

#include <algorithm>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(data, data + size);
    lsys::seal_module_file(bytes);
    const lsys::Result<lsys::Bytecode> read = lsys::read_module_file(bytes);
    if (!read) {
        return 0;
    }
    static_cast<void>(lsys::disassemble(read.value()));
    static_cast<void>(SmallDerivation(read.value()).run());
    return 0;
}
