// SPDX-License-Identifier: MIT
#include "runtime/platform/file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <sys/stdio.h>

namespace lsys::platform {

Reason rename_to_new(const std::string& from, const std::string& to) {
    if (::renamex_np(from.c_str(), to.c_str(), RENAME_EXCL) == 0) {
        return 0;
    }
    return errno == ENOTSUP ? ENOSYS : errno;
}

Reason exchange_files(const std::string& one, const std::string& other) {
    if (::renamex_np(one.c_str(), other.c_str(), RENAME_SWAP) == 0) {
        return 0;
    }
    return errno == ENOTSUP ? ENOSYS : errno;
}

std::uint64_t random_bits() {
    std::uint64_t bits = 0;
    ::arc4random_buf(&bits, sizeof bits);
    return bits;
}

} // namespace lsys::platform
