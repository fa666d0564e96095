// SPDX-License-Identifier: MIT
// Random changes of inputs that have no known structure, for runs without libFuzzer.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// `text` with one to six changes that depend on `seed` alone: bytes and numbers changed, parts
/// removed, repeated, or taken from `other`.
[[nodiscard]] std::string
changed_bytes(std::string_view text, std::string_view other, std::uint64_t seed);
