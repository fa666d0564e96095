// PieceWriter: bytes on their way to a sink. Small ones are gathered to pieces of kPieceBytes,
// large arrays go out in such pieces straight from where they lie. After the sink has said no, all
// is swallowed.
#pragma once

#include "runtime/export/export.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace lsys {

inline constexpr std::size_t kPieceBytes = std::size_t{256} << 10;

class PieceWriter {
public:
    explicit PieceWriter(const ByteSink& sink);

    /// Where the next bytes may be written, at most `bytes` of them; used() says how many were.
    [[nodiscard]] char* room(std::size_t bytes) {
        if (static_cast<std::size_t>(end_ - at_) < bytes) {
            flush();
        }
        return at_;
    }
    void used(char* end) { at_ = end; }

    void put(std::string_view text);
    /// What is long is not copied.
    void put_bytes(std::span<const std::byte> bytes);
    template <typename T>
    void put_array(std::span<const T> items) {
        put_bytes(std::as_bytes(items));
    }

    [[nodiscard]] bool stopped() const { return stopped_; }
    /// Hands over what is left. False if the sink has stopped.
    [[nodiscard]] bool finish();

private:
    void flush();
    void hand_over(std::string_view piece);

    const ByteSink& sink_;
    std::unique_ptr<char[]> buffer_;
    char* at_;
    char* end_;
    bool stopped_ = false;
};

} // namespace lsys
