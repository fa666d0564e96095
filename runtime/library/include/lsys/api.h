// The version of the library, and what marks its functions as public. Every other header includes
// this one.
#pragma once

#define LSYS_VERSION_MAJOR 0
#define LSYS_VERSION_MINOR 1
#define LSYS_VERSION_PATCH 0
/// As one number, for comparisons: 1.2.3 is 10203.
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

// The public names lie in an inline namespace, so that programs write lsys::Grammar, and a program
// and a library of different interfaces do not link. The sources of the library, which have other
// things of these names in namespace lsys, see it as a plain namespace.
#ifdef LSYS_BUILDS_LIBRARY
#define LSYS_INTERFACE v0
#else
#define LSYS_INTERFACE inline v0
#endif

namespace lsys::LSYS_INTERFACE {

/// The version of the library that is linked, "0.1.0". Headers of another version may have been
/// compiled: compare with LSYS_VERSION.
[[nodiscard]] LSYS_API const char* version() noexcept;
[[nodiscard]] LSYS_API int version_number() noexcept;

} // namespace lsys::LSYS_INTERFACE
