// The files that a command writes together: all of them appear or none.
#pragma once

#include "runtime/export/export.h"
#include "runtime/program/console.h"
#include "runtime/program/files.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys::lsc {

class OutputSet {
public:
    /// `console` must outlive the set.
    explicit OutputSet(const Console& console) : console_(console) {}

    /// Writes a file that appears at commit(), and prints the messages of `write`. `write` passes
    /// the bytes to the sink that it gets, which returns false after a failure or an interrupt.
    [[nodiscard]] ExitStatus add(const std::string& path,
                                 const std::function<Outcome<void>(const ByteSink&)>& write);
    /// Makes all files visible.
    [[nodiscard]] ExitStatus commit() { return report_result(commit_all(outputs_), console_); }
    /// Total size of all files.
    [[nodiscard]] std::uint64_t byte_count() const { return byte_count_; }

private:
    const Console& console_;
    std::vector<Output> outputs_;
    std::uint64_t byte_count_ = 0;
};

} // namespace lsys::lsc
