// SPDX-License-Identifier: MIT
// TemporalAntialiasing: mixes each picture with the pictures before it, whose pixels are found again
// by the motion of the camera and of the wind (Karis 2014, "High-Quality Temporal Supersampling").
// Each picture is shifted by a part of a pixel, so that a few pictures together have many samples
// per pixel.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/frame_block.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace lsys::view {

class TemporalAntialiasing {
public:
    /// What a picture was drawn with.
    struct Moment {
        glm::mat4 from_world{1.0F}; // view projection without the shift
        glm::vec4 wind{0.0F};       // FrameBlock::wind
        float time = 0.0F;          // s
    };

    explicit TemporalAntialiasing(Device& device) : device_(&device) {}

    /// Compiles the shader again. Error: it does not compile.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// Ignores the pictures before the next one, which shows something else.
    void forget() { count_ = 0; }
    /// Number of the shift of the next picture, 0 to 16; 0 without a picture before it.
    [[nodiscard]] std::uint32_t shift() const { return count_ == 0 ? 0 : 1 + (count_ - 1) % 16; }
    /// The moment of the picture before; `now` if there is none.
    [[nodiscard]] const Moment& before(const Moment& now) const {
        return count_ == 0 ? now : before_;
    }
    /// Prepares for pictures of a size. Call it before shift(): after a change of the size, the
    /// pictures before are ignored.
    void resize(std::uint32_t width, std::uint32_t height);
    /// The framebuffer to which RenderTarget::copy_parts() copies colours, motions and depths.
    [[nodiscard]] GLuint parts() const { return parts_.name(); }
    /// Mixes the picture in parts() with the ones before. A FrameBlock and an empty vertex array
    /// must be bound. `moves`: the motions of parts() are set. Returns a framebuffer with the mix.
    [[nodiscard]] GLuint mix(const Moment& now, bool moves);

private:
    Device* device_;
    ProgramObject program_;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::array<TextureObject, 3> pictures_; // of parts_: colours, motions, depths
    Framebuffer parts_;
    std::array<TextureObject, 2> mixes_; // used in turn
    std::array<Framebuffer, 2> targets_;
    std::uint32_t count_ = 0; // pictures since forget()
    Moment before_;
};

} // namespace lsys::view
