#include "runtime/base/huge_pages.h"

#include <sys/mman.h>

namespace lsys {

void advise_huge_pages(void* address, std::size_t bytes) {
    static_cast<void>(madvise(address, bytes, MADV_HUGEPAGE));
}

} // namespace lsys
