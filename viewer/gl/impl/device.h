// SPDX-License-Identifier: MIT
// Device: state that all objects of one OpenGL context share: the number of live objects, which
// shows leaks, and errors of the driver. Must outlive the objects.
#pragma once

#include <cstdint>
#include <epoxy/gl.h>
#include <string>
#include <vector>

namespace lsys::view {

class Device {
public:
    /// Uses the current context, and installs a debug callback in it.
    Device();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// Number of OpenGL objects, such as buffers and textures, that were made and not deleted.
    [[nodiscard]] std::uint64_t live_objects() const { return live_; }
    /// The first kMaxErrors messages that the driver reported for this device.
    [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
    /// Number of bytes sent to buffers and textures of this device.
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_; }

    /// Whether the CPU draws, as llvmpipe does.
    [[nodiscard]] bool is_software() const { return is_software_; }

    /// Macro QUALITY, 0 to 2, of all shaders that are compiled from now on.
    [[nodiscard]] std::uint32_t quality() const { return quality_; }
    void set_quality(std::uint32_t quality) { quality_ = quality; }

    void add_object() { ++live_; }
    void remove_object() { --live_; }
    void add_upload(std::uint64_t bytes) { uploaded_ += bytes; }
    void report(std::string message); // adds a message to errors()

    /// Call between passes. A software renderer stores the triangles of a pass until it draws them.
    /// end_pass() makes it draw them, and waits until it is at most one pass behind.
    void end_pass();

    [[nodiscard]] std::string renderer() const; // "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"

private:
    bool is_software_ = false;
    std::uint32_t quality_ = 0;
    GLsync pass_end_ = nullptr;  // end of the last pass
    std::uint64_t live_ = 0;     // live_objects()
    std::uint64_t uploaded_ = 0; // uploaded_bytes()
    std::vector<std::string> errors_;
};

} // namespace lsys::view
