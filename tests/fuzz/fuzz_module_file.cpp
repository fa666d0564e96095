// SPDX-License-Identifier: MIT
// Bytes to word: a .lsb is refused, or it verifies and derives under small limits. The checksum is
// corrected first, so that the other checks of reader and verifier are reached.
#include "compiler/bytecode/disassemble.h"
#include "compiler/bytecode/module_file.h"
#include "runtime/derive/derive.h"

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
    lsys::DeriveOptions options;
    options.generations = std::min<std::uint32_t>(read.value().generations.value_or(3), 4);
    options.threads = 1;
    options.limits.max_modules = 20'000;
    options.limits.max_bytes = 16U << 20;
    lsys::Derivation derivation(read.value(), options);
    if (!derivation.start()) {
        static_cast<void>(derivation.run_to(options.generations));
    }
    return 0;
}
