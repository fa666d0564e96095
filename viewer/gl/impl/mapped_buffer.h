// SPDX-License-Identifier: MIT
// MappedBuffer: a buffer that stays mapped into the memory of the process. It has several parts
// that are used in turn, so that neither the process nor the device waits for the other.
#pragma once

#include "viewer/gl/impl/objects.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <epoxy/gl.h>

namespace lsys::view {

class MappedBuffer {
public:
    static constexpr std::size_t kParts = 4;          // used in turn
    enum class Access : std::uint8_t { Write, Read }; // access by the process

    /// `part_bytes`: size of a part, a multiple of 256.
    MappedBuffer(Device& device, std::size_t part_bytes, Access access);
    ~MappedBuffer();
    MappedBuffer(const MappedBuffer&) = delete;
    MappedBuffer& operator=(const MappedBuffer&) = delete;

    [[nodiscard]] GLuint name() const { return object_.name(); }
    /// Makes the next part the current part; waits until the device has finished with it.
    void begin();
    /// Call it after the commands that use the current part.
    void end();
    /// Offset of the current part in bytes.
    [[nodiscard]] GLintptr offset() const { return static_cast<GLintptr>(part_ * part_bytes_); }
    /// Memory of the current part. Precondition: begin() was called.
    [[nodiscard]] std::byte* data() const { return memory_ + part_ * part_bytes_; }
    /// Memory of the last part with which the device has finished; null: there is none. Does not
    /// wait.
    [[nodiscard]] const std::byte* last_finished() const;

private:
    /// Waits at most `nanoseconds` for a fence.
    static bool is_finished(GLsync fence, GLuint64 nanoseconds);

    std::size_t part_bytes_;
    Object<BufferKind> object_;
    std::byte* memory_ = nullptr;
    std::size_t part_ = 0;                // the current one
    std::array<GLsync, kParts> fences_{}; // null: the part has not been used
};

} // namespace lsys::view
