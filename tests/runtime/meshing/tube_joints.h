// SPDX-License-Identifier: MIT
// The joints of tubes, for tests of radii and curves of stems.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/meshing/impl/axes.h"
#include "runtime/meshing/impl/axis_reader.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <vector>

namespace lsys::test {

/// The joints of the tube along the axis that begins with segment `first`.
inline std::vector<Joint>
joints_of(const Skeleton& skeleton, const MeshOptions& options, std::uint32_t first) {
    Workers workers(1);
    const Axes axes = find_axes(skeleton, workers);
    AxisReader reader(skeleton, axes, options);
    reader.start(first);
    Run run;
    REQUIRE(reader.next(run));
    return {run.joints.begin(), run.joints.end()};
}

} // namespace lsys::test
