// SPDX-License-Identifier: MIT
#include "runtime/platform/file.h"

#include "runtime/platform/process.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/random.h>

namespace lsys::platform {

namespace {

Reason rename_with(const std::string& from, const std::string& to, unsigned flags) {
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
}

} // namespace

Reason rename_to_new(const std::string& from, const std::string& to) {
    return rename_with(from, to, RENAME_NOREPLACE);
}

Reason exchange_files(const std::string& one, const std::string& other) {
    return rename_with(one, other, RENAME_EXCHANGE);
}

std::uint64_t random_bits() {
    std::uint64_t bits = 0;
    if (::getrandom(&bits, sizeof bits, GRND_NONBLOCK) != sizeof bits) {
        // No random bytes are available yet. Names made with O_EXCL need not be secret.
        static std::atomic<std::uint64_t> count{0};
        bits = (process_id() << 20) + ++count;
    }
    return bits;
}

} // namespace lsys::platform
