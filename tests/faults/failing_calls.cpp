// SPDX-License-Identifier: MIT
// A library that is loaded before others (LD_PRELOAD). It counts calls of the C library by the program and lets one of
// them fail once. Variables of the environment say what it does:
//   LSYS_FAULT         CALL:NUMBER:ERROR, e.g. `write:3:28`: the third write() fails with error number 28 (ENOSPC).
//                      ERROR `short`, for read and write only: the call transfers one byte.
//   LSYS_FAULT_COUNTS  a file of at least 8 bytes for each CALL, to which the numbers of calls are written in the order
//                      of the enumeration below, each as 64 bits.
//   LSYS_FAULT_ORDER   a file to which lines are appended: `write`, `fsync`, `syncfs` or `rename` and the
//                      paths of the files.
// A process that tries many faults calls lsys_set_fault() and lsys_count_calls() instead.
// Programs that the program starts do not load the library. Linux with the GNU C library only, whose allocating
// functions can be called by a second name.
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

// NOLINTBEGIN: names and signatures are those of the C library.
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum Call {
    Malloc,
    Open,
    Read,
    Write,
    Rename,
    Mmap,
    Fsync,
    Close,
    Fstat,
    Fchmod,
    Thread,
    CallCount
};
const char* const kNames[CallCount] = {"malloc", "open",  "read",  "write",  "rename", "mmap",
                                       "fsync",  "close", "fstat", "fchmod", "thread"};
constexpr int kShort = -1; // an error number that no call returns: transfer one byte

struct Fault {
    int call = CallCount;     // none
    std::uint64_t number = 0; // of the call that fails, from 1
    int error = 0;            // its error number, or kShort
};

Fault fault;
std::atomic<std::uint64_t> unshared_counts[CallCount]; // used without LSYS_FAULT_COUNTS
std::atomic<std::uint64_t>* counts = unshared_counts;  // else the mapped file
std::atomic<bool> is_ready = false;                    // calls are counted
int order_file = -1; // descriptor for the order of calls; -1: not recorded

Fault parse(const char* text) {
    const char* const number = std::strchr(text, ':');
    const char* const error = number == nullptr ? nullptr : std::strchr(number + 1, ':');
    if (error == nullptr) {
        return {};
    }
    Fault parsed;
    for (int call = 0; call < CallCount; ++call) {
        if (std::strncmp(kNames[call], text, static_cast<std::size_t>(number - text)) == 0) {
            parsed.call = call;
        }
    }
    parsed.number = std::strtoull(number + 1, nullptr, 10);
    parsed.error = std::strcmp(error + 1, "short") == 0 ? kShort : std::atoi(error + 1);
    return parsed;
}

// Reads the environment. Runs before main(), in one thread.
__attribute__((constructor)) void begin() {
    if (const char* const text = std::getenv("LSYS_FAULT")) {
        fault = parse(text);
    }
    if (const char* const path = std::getenv("LSYS_FAULT_COUNTS")) {
        const long file = syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC, 0);
        void* const mapped =
            reinterpret_cast<void*>(syscall(SYS_mmap, nullptr, sizeof unshared_counts,
                                            PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
        if (mapped != MAP_FAILED) {
            counts = static_cast<std::atomic<std::uint64_t>*>(mapped);
        }
        syscall(SYS_close, file);
    }
    if (const char* const path = std::getenv("LSYS_FAULT_ORDER")) {
        order_file = static_cast<int>(
            syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_APPEND | O_CLOEXEC, 0));
    }
    unsetenv("LD_PRELOAD");
    is_ready = true;
}

// Counts a call after the start of the program. Returns the error with which it fails, else 0.
int error_of(Call call) {
    if (!is_ready.load(std::memory_order_relaxed)) {
        return 0;
    }
    const std::uint64_t number = counts[call].fetch_add(1, std::memory_order_relaxed) + 1;
    return call == fault.call && number == fault.number ? fault.error : 0;
}

bool fails(Call call) {
    const int error = error_of(call);
    if (error != 0) {
        errno = error;
    }
    return error != 0;
}

// Records a call with the paths of its files; the second one may be empty.
void record(const char* call, const char* path, const char* second = "") {
    char line[2 * PATH_MAX + 16];
    const int size = std::snprintf(line, sizeof line, "%s\t%s\t%s\n", call, path, second);
    syscall(SYS_write, order_file, line, static_cast<std::size_t>(size));
}

void record(const char* call, int file) {
    if (order_file < 0) {
        return;
    }
    char link[32];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    char path[PATH_MAX] = "";
    if (syscall(SYS_readlinkat, AT_FDCWD, link, path, sizeof path - 1) > 0) {
        record(call, path);
    }
}

// Renames a file, unless the call shall fail. Records the paths as given.
int renamed(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    if (fails(Rename)) {
        return -1;
    }
    if (order_file >= 0) {
        record("rename", from, to);
    }
    return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

// The function of the C library that this library hides.
template <typename F>
F* next(const char* name) {
    return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

// Sets all counts to 0, and takes the fault from `text`, written as LSYS_FAULT; null: no fault.
__attribute__((visibility("default"))) void lsys_set_fault(const char* text) {
    is_ready = false;
    fault = text == nullptr ? Fault() : parse(text);
    for (int call = 0; call < CallCount; ++call) {
        counts[call] = 0;
    }
    is_ready = true;
}
// The number of calls with the name `call` since lsys_set_fault().
__attribute__((visibility("default"))) std::uint64_t lsys_count_calls(const char* call) {
    for (int each = 0; each < CallCount; ++each) {
        if (std::strcmp(kNames[each], call) == 0) {
            return counts[each];
        }
    }
    return 0;
}

void* malloc(size_t size) {
    return fails(Malloc) ? nullptr : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
    return fails(Malloc) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
    return fails(Malloc) ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
    return fails(Malloc) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
    *memory = fails(Malloc) ? nullptr : __libc_memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}

int open(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return fails(Open) ? -1 : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

ssize_t read(int file, void* bytes, size_t size) {
    const int error = error_of(Read);
    if (error > 0) {
        errno = error;
        return -1;
    }
    return syscall(SYS_read, file, bytes, error == kShort && size > 1 ? 1 : size);
}

ssize_t write(int file, const void* bytes, size_t size) {
    const int error = error_of(Write);
    if (error > 0) {
        errno = error;
        return -1;
    }
    record("write", file);
    return syscall(SYS_write, file, bytes, error == kShort && size > 1 ? 1 : size);
}

int rename(const char* from, const char* to) {
    return renamed(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    return renamed(from_folder, from, to_folder, to, flags);
}

void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset) {
    if (fails(Mmap)) {
        return MAP_FAILED;
    }
    return reinterpret_cast<void*>(
        syscall(SYS_mmap, address, size, protection, flags, file, offset));
}

int fsync(int file) {
    if (fails(Fsync)) {
        return -1;
    }
    record("fsync", file);
    return static_cast<int>(syscall(SYS_fsync, file));
}

int syncfs(int file) {
    record("syncfs", file);
    return static_cast<int>(syscall(SYS_syncfs, file));
}

// A failed close() has closed the file, as on Linux.
int close(int file) {
    const int result = static_cast<int>(syscall(SYS_close, file));
    return fails(Close) ? -1 : result;
}

int fstat(int file, struct stat* facts) {
    return fails(Fstat) ? -1
                        : static_cast<int>(syscall(SYS_newfstatat, file, "", facts, AT_EMPTY_PATH));
}

int fchmod(int file, mode_t mode) {
    return fails(Fchmod) ? -1 : static_cast<int>(syscall(SYS_fchmod, file, mode));
}

int pthread_create(pthread_t* thread,
                   const pthread_attr_t* attributes,
                   void* (*function)(void*),
                   void* argument) {
    static const auto create = next<decltype(pthread_create)>("pthread_create");
    const int error = error_of(Thread);
    return error != 0 ? error : create(thread, attributes, function, argument);
}

} // extern "C"
// NOLINTEND
