// SPDX-License-Identifier: MIT
#include "runtime/platform/file.h"

#include <utility>

namespace lsys::platform {

File::File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

File& File::operator=(File&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

File::~File() {
    if (is_open()) {
        static_cast<void>(close());
    }
}

} // namespace lsys::platform
