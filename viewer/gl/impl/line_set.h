// SPDX-License-Identifier: MIT
// LineSet: coloured lines on the device.
#pragma once

#include "viewer/gl/impl/objects.h"
#include "viewer/scene/lines.h"

#include <cstdint>
#include <span>

namespace lsys::view {

class LineSet {
public:
    explicit LineSet(Device& device);

    void upload(std::span<const LineVertex> lines);
    /// Draws with the bound program of shaders/line. Returns the number of draw calls.
    std::uint64_t draw() const;

    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

private:
    VertexArray array_;
    Buffer vertices_;
    std::uint64_t count_ = 0;
    Bounds bounds_;
};

} // namespace lsys::view
