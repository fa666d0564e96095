// SPDX-License-Identifier: MIT
// The version of the library, and macros that mark its functions as public. Every other public
// header includes this header.
#pragma once

#define LSYS_VERSION_MAJOR 0
#define LSYS_VERSION_MINOR 1
#define LSYS_VERSION_PATCH 0
/// The version as one number, for comparisons: 1.2.3 is 10203.
#define LSYS_VERSION (LSYS_VERSION_MAJOR * 10000 + LSYS_VERSION_MINOR * 100 + LSYS_VERSION_PATCH)

#if defined(_WIN32) && defined(LSYS_SHARED)
#ifdef LSYS_BUILDS_LIBRARY
#define LSYS_API __declspec(dllexport)
#else
#define LSYS_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define LSYS_API __attribute__((visibility("default")))
#else
#define LSYS_API
#endif

// The public names are in an inline namespace: programs write lsys::Grammar, and a program and a
// library with different interfaces do not link. For the sources of the library the namespace is
// not inline, because namespace lsys has other types with these names.
#ifdef LSYS_BUILDS_LIBRARY
#define LSYS_INTERFACE v0
#else
#define LSYS_INTERFACE inline v0
#endif

namespace lsys::LSYS_INTERFACE {

/// The version of the linked library, "0.1.0". It may differ from LSYS_VERSION, the version of the
/// compiled headers.
[[nodiscard]] LSYS_API const char* version() noexcept;
[[nodiscard]] LSYS_API int version_number() noexcept;

} // namespace lsys::LSYS_INTERFACE
