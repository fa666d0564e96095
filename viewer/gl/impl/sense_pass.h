// SPDX-License-Identifier: MIT
// SensePass: draws the SenseDrawing of a plant.
#pragma once

#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/sense_drawing.h"

#include <vector>

namespace lsys::view {

class SensePass {
public:
    explicit SensePass(Device& device);

    void upload(const SenseDrawing& drawing);
    /// Draws with the bound program of shaders/sense, after all opaque parts of the picture.
    void draw(FrameStats& stats) const;
    [[nodiscard]] bool empty() const { return groups_.empty(); }

private:
    VertexArray array_;
    Buffer vertices_;
    std::vector<SenseGroup> groups_;
};

} // namespace lsys::view
