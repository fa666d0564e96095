// SPDX-License-Identifier: MIT
// Failures of environments, and checks that places and meshes are finite, before trees are built
// over them.
#pragma once

#include "runtime/environment/environment.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace lsys {

/// A failure without a message. `stop`: OutOfMemory or Cancelled.
[[nodiscard]] inline EnvironmentFailure stopped(Stop stop) {
    EnvironmentFailure failure;
    failure.stop = stop;
    return failure;
}
/// Stop::Limit: the answers would take `bytes`.
[[nodiscard]] inline EnvironmentFailure beyond_memory(std::uint64_t bytes) {
    EnvironmentFailure failure;
    failure.stop = Stop::Limit;
    failure.bytes = bytes;
    return failure;
}
/// Stop::Diagnosed, with the reason `text` and the advice `help`.
[[nodiscard]] inline EnvironmentFailure refused(std::string text, std::string help) {
    EnvironmentFailure failure;
    failure.text = std::move(text);
    failure.help = std::move(help);
    return failure;
}

/// The failure of the first place with a coordinate that is infinite or NaN.
[[nodiscard]] std::optional<EnvironmentFailure> check_places(std::span<const SensePlace> places);

/// The failure of a mesh whose vertices are not all finite.
[[nodiscard]] std::optional<EnvironmentFailure> check_mesh(const EnvironmentMesh& mesh);

} // namespace lsys
