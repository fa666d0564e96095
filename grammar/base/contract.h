// SPDX-License-Identifier: MIT
// Assertions about this program, never about an author's input.
// LSYS_CHECK is always on: a failure prints the place and the values and ends the process.
// LSYS_DCHECK is for costly checks, in debug builds only.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <type_traits>

namespace lsys {

[[noreturn]] void contract_failed(const char* condition,
                                  const char* file,
                                  int line,
                                  std::initializer_list<long long> values);

namespace detail {
template <typename... Values>
[[noreturn]] void
contract_failed_with(const char* condition, const char* file, int line, Values... values) {
    contract_failed(condition, file, line, {static_cast<long long>(values)...});
}
} // namespace detail

} // namespace lsys

#define LSYS_CHECK(condition, ...)                                                                 \
    ((condition) ? static_cast<void>(0)                                                            \
                 : ::lsys::detail::contract_failed_with(#condition, __FILE__,                      \
                                                        __LINE__ __VA_OPT__(, ) __VA_ARGS__))

#ifdef NDEBUG
#define LSYS_DCHECK(condition, ...) static_cast<void>(0)
#else
#define LSYS_DCHECK(condition, ...) LSYS_CHECK(condition __VA_OPT__(, ) __VA_ARGS__)
#endif
