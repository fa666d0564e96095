// SPDX-License-Identifier: MIT
#include "grammar/base/contract.h"

#include <cstdio>
#include <cstdlib>

namespace lsys {

void contract_failed(const char* condition,
                     const char* file,
                     int line,
                     std::initializer_list<long long> values) {
    std::fprintf(stderr, "%s:%d: internal error: `%s` does not hold", file, line, condition);
    const char* separator = "; values: ";
    for (const long long value : values) {
        std::fprintf(stderr, "%s%lld", separator, value);
        separator = ", ";
    }
    std::fputs("\n", stderr);
    std::abort();
}

} // namespace lsys
