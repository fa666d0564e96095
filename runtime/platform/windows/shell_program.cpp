// SPDX-License-Identifier: MIT
#include "runtime/platform/shell_program.h"

#include <cerrno>

namespace lsys::platform {

ShellProgram::~ShellProgram() = default;

Reason ShellProgram::start(const std::string& /*command*/) {
    return ENOSYS;
}

ShellProgram::Reply ShellProgram::ask(const std::string& /*line*/,
                                      double /*seconds*/,
                                      std::uint64_t /*max_bytes*/,
                                      const std::atomic<bool>* /*cancelled*/,
                                      std::string& /*answer*/) {
    return Reply::Ended;
}

void ShellProgram::finish() {}

void end_shell_programs() noexcept {}

} // namespace lsys::platform
