// Files, whole: read at once, written beside their name and renamed when complete. `-` is standard
// input or output. Everything the environment refuses comes back as an Error that names the file.
#pragma once

#include "grammar/base/result.h"
#include "runtime/program/console.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// The bytes of `path`, or of standard input for `-`; at most `max_bytes`.
[[nodiscard]] Result<std::string>
read_file(const std::string& path, std::uint64_t max_bytes, const Console& console);
/// The bytes of a file; its Error is the reason alone. `cancelled` may be null.
[[nodiscard]] Result<std::string>
read_bytes(const std::string& path, std::uint64_t max_bytes, const std::atomic<bool>* cancelled);
/// The bytes of standard input; its Error is the reason alone.
[[nodiscard]] Result<std::string> read_standard_input(std::uint64_t max_bytes,
                                                      const Console& console);

/// What `errno` means, lower case.
[[nodiscard]] std::string reason_text(int reason);

/// The name of a file of a series: tree.glb and 12 give tree.0012.glb.
[[nodiscard]] std::string numbered(const std::string& path, std::uint32_t number);

/// Something that is written. A regular file appears under its name, or replaces what was there,
/// only at commit(); until then, and if it is never called, nothing has changed. Move only.
class Output {
public:
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    Output(Output&& other) noexcept;
    Output& operator=(Output&&) = delete;
    ~Output();

    /// `-` is standard output.
    [[nodiscard]] static Result<Output> open(const std::string& path, const Console& console);
    [[nodiscard]] Result<Done> write(std::string_view text);
    [[nodiscard]] Result<Done> commit();

private:
    Output(const Console& console, std::string path) : console_(&console), path_(std::move(path)) {}
    [[nodiscard]] Error failure(int reason) const;

    const Console* console_;
    std::string path_;      // as the user wrote it
    std::string target_;    // with links resolved
    std::string temporary_; // beside target_; empty where the file is written in place
    int descriptor_ = -1;   // none: standard output
};

/// open, write, commit.
[[nodiscard]] Result<Done>
write_file(const std::string& path, std::string_view text, const Console& console);

} // namespace lsys
