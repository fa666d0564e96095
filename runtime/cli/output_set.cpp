#include "runtime/cli/output_set.h"

#include <optional>
#include <utility>

namespace lsys::lsc {

ExitStatus OutputSet::add(const std::string& path,
                          const std::function<Outcome<void>(const ByteSink&)>& write) {
    Result<Output> output = Output::open(path, console_);
    if (!output) {
        return report_error(output.error(), console_);
    }
    std::optional<Error> failure;
    const Outcome<void> written = write([&](std::string_view bytes) {
        if (console_.interrupted()) {
            return false;
        }
        byte_count_ += bytes.size();
        const Result<void> done = output.value().write(bytes);
        if (!done) {
            failure = done.error();
        }
        return !failure;
    });
    if (failure) {
        return report_error(*failure, console_);
    }
    if (const ExitStatus status = console_.take(written); status != ExitStatus::Ok) {
        return status;
    }
    if (const Result<void> finished = output.value().finish(); !finished) {
        return report_error(finished.error(), console_);
    }
    outputs_.push_back(std::move(output.value()));
    return ExitStatus::Ok;
}

} // namespace lsys::lsc
