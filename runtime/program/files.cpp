#include "runtime/program/files.h"

#include "runtime/base/size_text.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/descriptor.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <istream>
#include <memory>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kReadBytes = std::size_t{1} << 20;

/// Returns an Error if `size` bytes exceed the limit.
Result<void> check_size(std::uint64_t size, const ReadLimit& limit) {
    if (size > limit.memory && limit.memory < limit.max_bytes) {
        return memory_error("it", limit.memory);
    }
    if (size > limit.max_bytes) {
        return Error{
            fmt::format("it has more than {} bytes, the most that can be read", limit.max_bytes)};
    }
    return {};
}

/// The reason to refuse reading a file; empty if it may be read.
std::string_view refusal_reason(const struct stat& facts, int descriptor, FileKind kind) {
    if (S_ISDIR(facts.st_mode)) {
        return "it is a directory";
    }
    const bool is_null = S_ISCHR(facts.st_mode) && facts.st_rdev == ::makedev(1, 3);
    if (S_ISREG(facts.st_mode) || is_null) {
        return {};
    }
    if (kind == FileKind::Regular) {
        return "it is not a regular file";
    }
    const bool is_device = S_ISBLK(facts.st_mode) || S_ISCHR(facts.st_mode);
    return is_device && ::isatty(descriptor) == 0 ? "it is a device" : "";
}

Result<std::string> read_descriptor(int descriptor,
                                    std::uint64_t expected,
                                    const ReadLimit& limit,
                                    const std::atomic<bool>* cancelled) {
    const std::uint64_t max_bytes = std::min(limit.max_bytes, limit.memory);
    std::string bytes;
    bytes.reserve(expected + 1);
    while (true) {
        const std::size_t size = bytes.size();
        // The capacity is one byte more than the expected size, so that read() finds the end of the
        // file without a larger buffer.
        const std::size_t room = std::max<std::size_t>(bytes.capacity() - size, 1);
        bytes.resize(size + std::min(room, kReadBytes));
        const ssize_t count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
        const int reason = errno;
        bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) {
            return Error{"interrupted"};
        }
        if (count < 0 && reason != EINTR) {
            return Error{errno_text(reason)};
        }
        if (const Result<void> checked = check_size(bytes.size(), limit); !checked) {
            return checked.error();
        }
        if (count == 0) {
            return bytes;
        }
        if (bytes.size() == bytes.capacity()) {
            const std::uint64_t next = bytes.size() + std::max(bytes.size() / 2, kReadBytes);
            bytes.reserve(std::min(next, std::max(max_bytes, max_bytes + 1)));
        }
    }
}

/// Six random letters or digits.
std::string random_letters() {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::uint64_t bits = 0;
    if (::getrandom(&bits, sizeof bits, GRND_NONBLOCK) != sizeof bits) {
        // No random bytes are available. With O_EXCL the name need not be secret, only different
        // for each attempt.
        static std::atomic<std::uint64_t> count{0};
        bits = (static_cast<std::uint64_t>(::getpid()) << 20) + ++count;
    }
    std::string letters;
    for (int i = 0; i < 6; ++i) {
        letters += kLetters[bits % kLetters.size()];
        bits /= kLetters.size();
    }
    return letters;
}

} // namespace

std::string errno_text(int reason) {
    if (reason == EBADF) { // a standard stream that was closed when the process started
        return "it is closed";
    }
    std::string text = std::strerror(reason);
    if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
        text[0] = static_cast<char>(text[0] - 'A' + 'a');
    }
    return text;
}

std::string numbered_path(const std::string& path, std::uint32_t number) {
    std::filesystem::path name(path);
    const std::string extension = name.extension().string();
    return name.replace_extension(fmt::format(".{:04}{}", number, extension)).string();
}

void report_complete_frames(const std::string& path,
                            std::uint32_t done,
                            std::uint32_t count,
                            const Console& console) {
    if (done != 0) {
        console.info(fmt::format("{} of {} frames are complete, the last of them `{}`", done, count,
                                 numbered_path(path, done)));
    }
}

Result<std::string> read_standard_input(const ReadLimit& limit, const Console& console) {
    std::istream& in = console.io().in;
    std::string bytes;
    while (in.good()) {
        const std::size_t size = bytes.size();
        bytes.resize(size + kReadBytes);
        in.read(bytes.data() + size, static_cast<std::streamsize>(kReadBytes));
        bytes.resize(size + static_cast<std::size_t>(in.gcount()));
        if (console.interrupted()) {
            return Error{"interrupted"};
        }
        if (const Result<void> checked = check_size(bytes.size(), limit); !checked) {
            return checked.error();
        }
    }
    if (in.bad()) {
        return Error{errno_text(errno)};
    }
    return bytes;
}

Result<std::string> read_bytes(const std::string& path,
                               FileKind kind,
                               const ReadLimit& limit,
                               const std::atomic<bool>* cancelled) {
    // With O_NONBLOCK open() does not wait for the writer of a pipe; refusal_reason() refuses
    // pipes.
    const int mode = kind == FileKind::Regular ? O_NONBLOCK : 0;
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | mode));
    struct stat facts {};
    if (file.get() < 0 || ::fstat(file.get(), &facts) != 0) {
        return Error{errno_text(errno)};
    }
    if (const std::string_view reason = refusal_reason(facts, file.get(), kind); !reason.empty()) {
        return Error{std::string(reason)};
    }
    const auto expected = static_cast<std::uint64_t>(std::max<off_t>(facts.st_size, 0));
    if (const Result<void> checked = check_size(expected, limit); !checked) {
        return checked.error();
    }
    return read_descriptor(file.get(), expected, limit, cancelled);
}

Result<std::string>
read_file(const std::string& path, const ReadLimit& limit, const Console& console) {
    Result<std::string> bytes =
        path == "-" ? read_standard_input(limit, console)
                    : read_bytes(path, FileKind::Named, limit, console.io().interrupted);
    if (!bytes) {
        return Error{fmt::format("cannot read `{}`: {}", shown_path(path), bytes.error().message),
                     bytes.error().kind};
    }
    return bytes;
}

Error Output::failure(int reason) const {
    return Error{fmt::format("cannot write `{}`: {}", path_, errno_text(reason))};
}

Output::Output(Output&& other) noexcept
    : console_(other.console_), path_(std::move(other.path_)), target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, std::string())),
      slot_(std::exchange(other.slot_, nullptr)), descriptor_(std::exchange(other.descriptor_, -1)),
      is_finished_(other.is_finished_), must_be_new_(other.must_be_new_), state_(other.state_) {}

Output::~Output() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    if (!temporary_.empty()) {
        ::unlink(temporary_.c_str());
        clear_temporary();
    }
}

void Output::clear_temporary() {
    temporary_.clear();
    if (slot_ != nullptr) {
        unregister_temporary(std::exchange(slot_, nullptr));
    }
}

/// Makes an empty file in the folder of target_. If the target exists, the file is made with mode
/// 0600 and then gets `mode`; else its mode follows the umask.
Result<void> Output::make_temporary(bool exists, unsigned mode) {
    constexpr int kAttempts = 100;
    const mode_t first_mode = exists ? 0600 : 0666;
    for (int attempt = 0; attempt < kAttempts && descriptor_ < 0; ++attempt) {
        std::string name = target_ + '.' + random_letters();
        descriptor_ =
            ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, first_mode);
        if (descriptor_ >= 0) {
            slot_ = register_temporary(name);
            temporary_ = std::move(name);
        } else if (errno != EEXIST) {
            return failure(errno);
        }
    }
    if (descriptor_ < 0) {
        return failure(EEXIST);
    }
    if (exists && ::fchmod(descriptor_, mode) != 0) {
        return failure(errno);
    }
    return {};
}

Result<Output> Output::open(const std::string& path, const Console& console) {
    Output output(console, path);
    if (path == "-") {
        return output;
    }
    struct stat facts {};
    const bool exists = ::stat(path.c_str(), &facts) == 0;
    if (exists && S_ISDIR(facts.st_mode)) {
        return output.failure(EISDIR);
    }
    if (exists && !S_ISREG(facts.st_mode)) { // a device or a pipe
        output.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (output.descriptor_ < 0) {
            return output.failure(errno);
        }
        return output;
    }
    output.target_ = path;
    if (exists) {
        if (::access(path.c_str(), W_OK) != 0) {
            return output.failure(errno);
        }
        const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr),
                                                               &std::free);
        if (real == nullptr) {
            return output.failure(errno);
        }
        output.target_ = real.get();
    }
    if (Result<void> made = output.make_temporary(exists, facts.st_mode & 0777U); !made) {
        return made.error();
    }
    return output;
}

Result<Output> Output::create(const std::string& path, const Console& console) {
    Output output(console, path);
    output.must_be_new_ = true;
    output.target_ = path;
    struct stat facts {};
    if (::lstat(path.c_str(), &facts) == 0) {
        return output.failure(EEXIST);
    }
    if (Result<void> made = output.make_temporary(false, 0); !made) {
        return made.error();
    }
    return output;
}

Result<void> Output::write(std::string_view text) {
    if (descriptor_ < 0) {
        return console_->write(text);
    }
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor_, text.data(), text.size());
        if (count < 0 && errno != EINTR) {
            return failure(errno);
        }
        text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
    return {};
}

Result<void> Output::finish() {
    if (std::exchange(is_finished_, true)) {
        return {};
    }
    if (descriptor_ < 0) {
        return console_->flush();
    }
    // Some file systems report a full disk only here.
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        return failure(errno);
    }
    return {};
}

Result<void> Output::commit() {
    if (Result<void> finished = finish(); !finished) {
        return finished;
    }
    if (temporary_.empty()) {
        return {};
    }
    const unsigned flags = must_be_new_ ? RENAME_NOREPLACE : 0;
    int failed = ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), flags);
    if (failed != 0 && flags != 0 && (errno == EINVAL || errno == ENOSYS)) {
        failed = ::rename(temporary_.c_str(), target_.c_str()); // create() has found no such file
    }
    if (failed != 0) {
        return failure(errno);
    }
    clear_temporary();
    return {};
}

/// Gives the file its name. A file with that name gets the temporary name, from which unpublish()
/// can restore it.
Result<void> Output::publish() {
    struct stat facts {};
    const bool replaces = ::lstat(target_.c_str(), &facts) == 0;
    if (temporary_.empty() || must_be_new_ || !replaces || !S_ISREG(facts.st_mode)) {
        const bool has_name = !temporary_.empty();
        Result<void> done = commit();
        state_ = done && has_name ? State::New : State::Unpublished;
        return done;
    }
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) ==
        0) {
        state_ = State::Exchanged;
        return {};
    }
    Result<void> done = commit();
    state_ = done ? State::Replaced : State::Unpublished;
    return done;
}

void Output::unpublish() {
    if (state_ == State::New) {
        ::unlink(target_.c_str());
    } else if (state_ == State::Exchanged) {
        ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE);
    }
}

Result<void> commit_all(std::vector<Output>& outputs) {
    // Finish all files first, to detect a full disk before any file is replaced.
    for (Output& output : outputs) {
        if (Result<void> finished = output.finish(); !finished) {
            return finished;
        }
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (Result<void> published = outputs[i].publish(); !published) {
            while (i > 0) {
                outputs[--i].unpublish();
            }
            return published;
        }
    }
    outputs.clear(); // destructors remove the replaced files, which have the temporary names
    return {};
}

Result<void> write_file(const std::string& path, std::string_view text, const Console& console) {
    Result<Output> output = Output::open(path, console);
    if (!output) {
        return output.error();
    }
    if (Result<void> written = output.value().write(text); !written) {
        return written;
    }
    return output.value().commit();
}

} // namespace lsys
