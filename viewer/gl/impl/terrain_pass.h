// TerrainPass: the ground of a forest on the device: heights around the camera as a texture, and
// one small grid that is drawn for each patch of a TerrainView.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/terrain_view.h"

#include <cstdint>
#include <memory>

namespace lsys::view {

class TerrainPass {
public:
    explicit TerrainPass(Device& device);

    /// Error: a shader does not compile; the ones before stay.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// The ground that is drawn from now on; it outlives the pass or the next call.
    void show(const Terrain& terrain, float reach);
    /// Selects for a camera and uploads what is new.
    void prepare(const ViewVolume& volume);
    /// What was selected.
    FrameStats draw();

    [[nodiscard]] const TerrainView* view() const { return view_.get(); }
    [[nodiscard]] std::uint64_t texture_bytes() const;
    /// A level's heights as the device has them, by rows.
    [[nodiscard]] std::vector<float> read_heights(std::uint32_t level) const;

private:
    Device* device_;
    std::unique_ptr<TerrainView> view_;
    ProgramObject program_;
    TextureObject heights_;
    TextureObject noise_;
    VertexArray array_;
    Buffer corners_;
    Buffer indices_;
    Buffer patches_;
};

} // namespace lsys::view
