// Device: what all objects of one OpenGL context share: the count of those that are alive, so that
// a leak is seen, and the errors that the driver reports. It outlives them.
#pragma once

#include <cstdint>
#include <epoxy/gl.h>
#include <string>
#include <vector>

namespace lsys::view {

class Device {
public:
    /// Of the context that is current; listens to its reports.
    Device();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// Buffers, textures and so on that were made and not yet deleted.
    [[nodiscard]] std::uint64_t live_objects() const { return live_; }
    /// Errors since the start, in the driver's words; at most kMostErrors are kept.
    [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
    /// Bytes that were sent to buffers and textures since the start.
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_; }

    void add_object() { ++live_; }
    void remove_object() { --live_; }
    void add_upload(std::uint64_t bytes) { uploaded_ += bytes; }
    void report(std::string message);

    /// To be called between passes. A software renderer holds all triangles of a picture in memory
    /// until it is drawn; here it begins with those there are. It is never more than one pass
    /// behind.
    void end_pass();

    [[nodiscard]] std::string renderer() const; // "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"

private:
    bool is_software_ = false;
    GLsync pass_ = nullptr; // the last one's end
    std::uint64_t live_ = 0;
    std::uint64_t uploaded_ = 0;
    std::vector<std::string> errors_;
};

} // namespace lsys::view
