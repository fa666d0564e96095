#include "runtime/program/files.h"

#include "runtime/pipeline/grammar.h"
#include "runtime/program/descriptor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <istream>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;

Error size_error(std::uint64_t max_bytes) {
    return Error{fmt::format("it has more than {} bytes, the most that can be read", max_bytes)};
}

} // namespace

std::string reason_text(int reason) {
    std::string text = std::strerror(reason);
    if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
        text[0] = static_cast<char>(text[0] - 'A' + 'a');
    }
    return text;
}

std::string numbered(const std::string& path, std::uint32_t number) {
    std::filesystem::path name(path);
    const std::string extension = name.extension().string();
    return name.replace_extension(fmt::format(".{:04}{}", number, extension)).string();
}

Result<std::string>
read_file(const std::string& path, std::uint64_t max_bytes, const Console& console) {
    Result<std::string> bytes = path == "-" ? read_standard_input(max_bytes, console)
                                            : read_bytes(path, max_bytes, console.io().interrupted);
    if (!bytes) {
        return Error{fmt::format("cannot read `{}`: {}", shown_path(path), bytes.error().message)};
    }
    return bytes;
}

Result<std::string> read_standard_input(std::uint64_t max_bytes, const Console& console) {
    std::istream& in = console.io().in;
    std::string bytes;
    while (in.good()) {
        const std::size_t size = bytes.size();
        bytes.resize(size + kPiece);
        in.read(bytes.data() + size, static_cast<std::streamsize>(kPiece));
        bytes.resize(size + static_cast<std::size_t>(in.gcount()));
        if (console.interrupted()) {
            return Error{"interrupted"};
        }
        if (bytes.size() > max_bytes) {
            return size_error(max_bytes);
        }
    }
    if (in.bad()) {
        return Error{reason_text(errno)};
    }
    return bytes;
}

Result<std::string>
read_bytes(const std::string& path, std::uint64_t max_bytes, const std::atomic<bool>* cancelled) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat facts {};
    if (file.get() < 0 || ::fstat(file.get(), &facts) != 0) {
        return Error{reason_text(errno)};
    }
    if (S_ISDIR(facts.st_mode)) {
        return Error{"it is a directory"};
    }
    const auto expected = static_cast<std::uint64_t>(std::max<off_t>(facts.st_size, 0));
    if (expected > max_bytes) {
        return size_error(max_bytes);
    }
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(expected) + 1);
    while (true) {
        const std::size_t size = bytes.size();
        // One byte more than expected, so that the end is seen without growing.
        const std::size_t room = std::max<std::size_t>(bytes.capacity() - size, 1);
        bytes.resize(size + std::min(room, kPiece));
        const ssize_t count = ::read(file.get(), bytes.data() + size, bytes.size() - size);
        const int reason = errno;
        bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) {
            return Error{"interrupted"};
        }
        if (count < 0 && reason != EINTR) {
            return Error{reason_text(reason)};
        }
        if (bytes.size() > max_bytes) {
            return size_error(max_bytes);
        }
        if (count == 0) {
            return bytes;
        }
        if (bytes.size() == bytes.capacity()) {
            bytes.reserve(bytes.size() + std::max(bytes.size() / 2, kPiece));
        }
    }
}

Error Output::failure(int reason) const {
    return Error{fmt::format("cannot write `{}`: {}", path_, reason_text(reason))};
}

Output::Output(Output&& other) noexcept
    : console_(other.console_), path_(std::move(other.path_)), target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, std::string())),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

Output::~Output() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    if (!temporary_.empty()) {
        ::unlink(temporary_.c_str());
    }
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
    std::string name = output.target_ + ".XXXXXX";
    output.descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (output.descriptor_ < 0) {
        return output.failure(errno);
    }
    output.temporary_ = std::move(name);
    // A temporary file is private; the real one is as open as the one it replaces, or as new ones
    // are.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const mode_t mode = exists ? facts.st_mode & 07777U : 0666U & ~mask;
    if (::fchmod(output.descriptor_, mode) != 0) {
        return output.failure(errno);
    }
    return output;
}

Result<Done> Output::write(std::string_view text) {
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
    return Done{};
}

Result<Done> Output::commit() {
    if (descriptor_ < 0) {
        return console_->flush();
    }
    // Some file systems report a full disk only here.
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        return failure(errno);
    }
    if (!temporary_.empty()) {
        if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
            return failure(errno);
        }
        temporary_.clear();
    }
    return Done{};
}

Result<Done> write_file(const std::string& path, std::string_view text, const Console& console) {
    Result<Output> output = Output::open(path, console);
    if (!output) {
        return output.error();
    }
    if (Result<Done> written = output.value().write(text); !written) {
        return written;
    }
    return output.value().commit();
}

} // namespace lsys
