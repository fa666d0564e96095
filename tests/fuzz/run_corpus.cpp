// SPDX-License-Identifier: MIT
// Runs a fuzz function over the files named on the command line, and over about 16 prefixes of each
// file.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
    int files = 0;
    for (int i = 1; i < argc; ++i) {
        std::ifstream file(argv[i], std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file),
                               std::istreambuf_iterator<char>()};
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
        const std::size_t stride = text.size() / 16 + 1;
        for (std::size_t size = 0; size < text.size(); size += stride) {
            LLVMFuzzerTestOneInput(bytes, size);
        }
        LLVMFuzzerTestOneInput(bytes, text.size());
        ++files;
    }
    std::printf("%d files\n", files);
    return files == 0 ? 1 : 0;
}
