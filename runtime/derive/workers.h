// Workers: the threads of one derivation. Work is a number of numbered pieces; which thread takes
// which piece never shows in a result.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace lsys {

class Workers {
public:
    /// 0: as many as the machine has. No thread is started before it is needed.
    explicit Workers(std::uint32_t threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Calls `piece` for 0 ... pieces - 1, begun in that order, and returns when all are done. With
    /// one worker or one piece, on the calling thread.
    void for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece);

private:
    struct Arena;

    std::uint32_t count_;
    std::unique_ptr<Arena> arena_;
};

} // namespace lsys
