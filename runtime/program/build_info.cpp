// SPDX-License-Identifier: MIT
#include "runtime/program/build_info.h"

#include "runtime/base/workers.h"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <glm/detail/setup.hpp>
#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <meshoptimizer.h>
#include <png.h>
#include <toml++/impl/version.h>
#include <utf8proc.h>
#include <zlib.h>

#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

namespace lsys {

namespace {

/// `9.1.0` for 90100.
std::string dotted(int version) {
    constexpr int kPart = 100;
    return fmt::format("{}.{}.{}", version / (kPart * kPart), version / kPart % kPart,
                       version % kPart);
}

std::string compiler() {
#if defined(__clang__)
    return fmt::format("clang {}", __clang_version__);
#else
    return fmt::format("g++ {}", __VERSION__);
#endif
}

std::string standard_library() {
#if defined(_GLIBCXX_RELEASE)
    std::string text = fmt::format("libstdc++ {}", _GLIBCXX_RELEASE);
#else
    std::string text = "libc++";
#endif
#if defined(__GLIBC__)
    text += fmt::format(", glibc {}", gnu_get_libc_version());
#endif
    return text;
}

/// Instruction sets for which runtime/base/random.cpp and runtime/derive/engine have special code,
/// selected at run time.
std::string processor() {
#if defined(__x86_64__)
    const bool has_avx2 =
        __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("popcnt") != 0;
    return fmt::format("x86-64; at run time: {}",
                       has_avx2 ? "AVX2 for random numbers and derivation" : "no AVX2");
#elif defined(__aarch64__)
    return "AArch64, the baseline";
#else
    return "the baseline of the compiler";
#endif
}

} // namespace

std::vector<LibraryVersion> common_libraries() {
    constexpr int kMinor = 10; // MESHOPTIMIZER_VERSION is 180 for 0.18
    constexpr int kMajor = 100;
    return {
        {"CLI11", CLI11_VERSION},
        {"fmt", dotted(FMT_VERSION)},
        {"GLM", fmt::format("{}.{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH,
                            GLM_VERSION_REVISION)},
        {"libpng", png_get_libpng_ver(nullptr)},
        {"meshoptimizer", fmt::format("{}.{}", MESHOPTIMIZER_VERSION / (kMajor * kMinor),
                                      MESHOPTIMIZER_VERSION / kMinor % kMajor)},
        {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                      NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
        {"stb_image", LSYS_STB_IMAGE_VERSION},
        {"stb_perlin", LSYS_STB_PERLIN_VERSION},
        {"toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
        {"utf8proc", utf8proc_version()},
        {"zlib", zlibVersion()},
    };
}

std::string describe_build(const std::string& revision,
                           const std::vector<LibraryVersion>& libraries) {
    std::string names;
    constexpr std::size_t kLineLength = 60;
    std::size_t column = 0;
    for (const auto& [name, version] : libraries) {
        const std::string item = fmt::format("{} {}", name, version);
        if (column + item.size() > kLineLength) {
            names += ",\n              ";
            column = 0;
        } else if (!names.empty()) {
            names += ", ";
        }
        names += item;
        column += item.size() + 2;
    }
#if defined(NDEBUG)
    const char* const checks = "without internal checks";
#else
    const char* const checks = "with internal checks";
#endif
    return fmt::format("commit        {}\n"
                       "compiler      {}, {}\n"
                       "C++ library   {}\n"
                       "libraries     {}\n"
                       "processor     {}\n"
                       "threads       {}\n",
                       revision, compiler(), checks, standard_library(), names, processor(),
                       Workers(0).count());
}

} // namespace lsys
