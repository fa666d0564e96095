// SPDX-License-Identifier: MIT
// Parses any bytes as a command line of lsc: each line is an argument. The command is not run.
#include "runtime/cli/command_line.h"
#include "tests/fuzz/input_bytes.h"

#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMaxArguments = 64;
    InputBytes input(data, size);
    std::vector<std::string> arguments;
    while (!input.empty() && arguments.size() < kMaxArguments) {
        arguments.emplace_back(input.line());
    }
    const lsys::lsc::CommandLine parsed = lsys::lsc::parse_command_line(arguments);
    if (parsed.valueless_by_exception()) {
        std::abort();
    }
    return 0;
}
