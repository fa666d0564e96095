// SPDX-License-Identifier: MIT
#include "runtime/program/temporaries.h"

#include "runtime/platform/file.h"

#include <algorithm>
#include <atomic>
#include <memory>

namespace lsys {

struct TemporaryName {
    std::atomic<char*> path{
        nullptr}; // the thread or handler that exchanges it for null owns the text
    TemporaryName* next = nullptr;
};

namespace {

// A list of all slots. It only grows at its head, so a signal handler can traverse it at any time.
std::atomic<TemporaryName*> first_name{nullptr};
static_assert(std::atomic<char*>::is_always_lock_free);
static_assert(std::atomic<TemporaryName*>::is_always_lock_free);

} // namespace

TemporaryName* register_temporary(const std::string& path) {
    auto text = std::make_unique<char[]>(path.size() + 1); // ends in 0
    std::copy(path.begin(), path.end(), text.get());
    for (TemporaryName* name = first_name; name != nullptr; name = name->next) {
        char* empty = nullptr;
        if (name->path.compare_exchange_strong(empty, text.get())) {
            text.release();
            return name;
        }
    }
    auto* const name = new TemporaryName;
    name->path = text.release();
    name->next = first_name;
    while (!first_name.compare_exchange_weak(name->next, name)) {
    }
    return name;
}

void unregister_temporary(TemporaryName* name) {
    const std::unique_ptr<char[]> text(name->path.exchange(nullptr));
}

void remove_temporaries() noexcept {
    for (TemporaryName* name = first_name; name != nullptr; name = name->next) {
        if (const char* const path = name->path.exchange(nullptr)) {
            platform::remove_file(path);
        }
    }
}

} // namespace lsys
