// SPDX-License-Identifier: MIT
#include "runtime/mpi/crew.h"

#include "runtime/base/out_of_memory.h"

#include <optional>

namespace lsys::mpi {

namespace {

/// Calls `work`; if memory runs out, stops the folder.
template <typename Work>
void write_or_stop(lsc::TilesetFolder& folder, const Work& work) {
    catch_out_of_memory(work, [&folder] { folder.stop(Error{"out of memory", ErrorKind::Limit}); });
}

} // namespace

Crew::Crew(lsc::TilesetFolder& folder, std::uint32_t threads)
    : folder_(folder), workers_(threads + 1), min_queued_files_(threads) {
    workers_.start();
    has_helpers_ = workers_.count() > 1;
    writing_ = workers_.count() - 1;
}

void Crew::run(const std::function<bool()>& step) {
    const auto lead = [&] {
        for (bool goes_on = true; goes_on;) {
            write_or_stop(folder_, [&] { goes_on = step(); });
        }
        close();
    };
    workers_.run(lead, [this] {
        write_or_stop(folder_, [this] { folder_.write_from([this] { return queue_.take(); }); });
        --writing_;
    });
}

void Crew::close() {
    if (!is_closed_) {
        is_closed_ = true;
        queue_.close();
    }
}

bool Crew::is_finished() const {
    if (has_helpers_) {
        return is_closed_ && writing_ == 0;
    }
    return is_closed_ && (queue_.left() == 0 || folder_.is_stopped());
}

void Crew::wait(std::chrono::milliseconds time) {
    if (has_helpers_ || queue_.left() == 0 || folder_.is_stopped()) {
        const bool is_low = is_closed_ || queue_.left() < min_queued_files_;
        queue_.wait_below(is_low ? 0 : min_queued_files_, time);
        return;
    }
    if (const std::optional<std::uint64_t> number = queue_.take_now()) {
        write_or_stop(folder_, [&] { folder_.write(*number); });
    }
}

} // namespace lsys::mpi
