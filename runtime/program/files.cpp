// SPDX-License-Identifier: MIT
#include "runtime/program/files.h"

#include "grammar/base/paths.h"
#include "runtime/base/size_text.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/platform/file.h"
#include "runtime/program/run_files.h"
#include "runtime/program/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <istream>
#include <utility>

namespace lsys {

namespace {

using platform::FileFacts;
using platform::FileType;
using platform::Reason;

constexpr std::size_t kReadBytes = std::size_t{1} << 20;

/// Returns an Error if `size` bytes exceed the limit.
Result<void> check_size(std::uint64_t size, const ReadLimit& limit) {
    if (size > limit.memory && limit.memory < limit.max_bytes) {
        return memory_error("it", limit.memory);
    }
    if (size > limit.max_bytes) {
        return Error{fmt::format("it is larger than {} bytes, the maximum", limit.max_bytes)};
    }
    return {};
}

/// The reason to refuse reading a file; empty if it may be read.
std::string_view refusal_reason(FileType type, FileKind kind) {
    switch (type) {
    case FileType::Directory:
        return "it is a directory";
    case FileType::Regular:
    case FileType::Null:
        return {};
    case FileType::Device:
        return kind == FileKind::Regular ? "it is not a regular file" : "it is a device";
    case FileType::Missing:
    case FileType::Link:
    case FileType::Terminal:
    case FileType::Other:
        break;
    }
    return kind == FileKind::Regular ? "it is not a regular file" : "";
}

Result<std::string> read_open_file(const platform::File& file,
                                   std::uint64_t expected,
                                   const ReadLimit& limit,
                                   const std::atomic<bool>* cancelled) {
    const std::uint64_t max_bytes = std::min(limit.max_bytes, limit.memory);
    std::string bytes;
    bytes.reserve(expected + 1);
    while (true) {
        const std::size_t size = bytes.size();
        // The capacity is one byte more than the expected size, so that reading finds the end of
        // the file without a larger buffer.
        const std::size_t room = std::max<std::size_t>(bytes.capacity() - size, 1);
        bytes.resize(size + std::min(room, kReadBytes));
        const auto [count, reason] =
            platform::read_some(file, bytes.data() + size, bytes.size() - size);
        bytes.resize(size + count);
        if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) {
            return Error{"interrupted"};
        }
        if (reason != 0 && reason != EINTR) {
            return Error{errno_text(reason)};
        }
        if (const Result<void> checked = check_size(bytes.size(), limit); !checked) {
            return checked.error();
        }
        if (count == 0 && reason == 0) {
            return bytes;
        }
        if (bytes.size() == bytes.capacity()) {
            const std::uint64_t next = bytes.size() + std::max(bytes.size() / 2, kReadBytes);
            bytes.reserve(std::min(next, std::max(max_bytes, max_bytes + 1)));
        }
    }
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
    std::filesystem::path name = path_of(path);
    const std::string extension = path_text(name.extension());
    return path_text(name.replace_extension(path_of(fmt::format(".{:04}{}", number, extension))));
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
    // For FileKind::Regular a pipe opens without waiting for its writer, and refusal_reason() then
    // refuses the pipe.
    platform::File file;
    if (const Reason reason = platform::open_to_read(path, kind == FileKind::Named, file);
        reason != 0) {
        return Error{reason == EISDIR ? std::string(refusal_reason(FileType::Directory, kind))
                                      : errno_text(reason)};
    }
    return read_opened(file, kind, limit, cancelled);
}

Result<std::string> read_opened(const platform::File& file,
                                FileKind kind,
                                const ReadLimit& limit,
                                const std::atomic<bool>* cancelled) {
    FileFacts facts;
    if (const Reason reason = platform::facts_of(file, facts); reason != 0) {
        return Error{errno_text(reason)};
    }
    if (const std::string_view refusal = refusal_reason(facts.type, kind); !refusal.empty()) {
        return Error{std::string(refusal)};
    }
    if (const Result<void> checked = check_size(facts.size, limit); !checked) {
        return checked.error();
    }
    return read_open_file(file, facts.size, limit, cancelled);
}

Result<std::string>
read_file(const std::string& path, const ReadLimit& limit, const Console& console) {
    if (path != "-" && console.io().files != nullptr) {
        console.io().files->note_read(path);
    }
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
      slot_(std::exchange(other.slot_, nullptr)), file_(std::move(other.file_)),
      lock_(std::move(other.lock_)), is_finished_(other.is_finished_),
      must_be_new_(other.must_be_new_), state_(other.state_) {}

Output::~Output() {
    if (file_.is_open()) {
        static_cast<void>(file_.close()); // close before the removal, as Windows demands
    }
    if (!temporary_.empty()) {
        if (state_ == State::Exchanged) {
            // Another process may have removed the earlier file and made its own under this name.
            remove_unlocked_temporary(temporary_, target_);
        } else {
            platform::remove_file(temporary_.c_str());
        }
        forget_temporary();
    }
}

void Output::forget_temporary() {
    temporary_.clear();
    if (slot_ != nullptr) {
        unregister_temporary(std::exchange(slot_, nullptr));
    }
}

/// Makes an empty file in the folder of target_. If the target exists, the file is private and then
/// gets `permissions`; else its permissions follow the umask.
Result<void> Output::make_temporary(bool exists, unsigned permissions) {
    std::string name;
    if (const Reason reason = create_temporary_file(target_, exists, name, file_); reason != 0) {
        return failure(reason);
    }
    temporary_ = std::move(name); // the destructor removes it if the next call throws
    slot_ = register_temporary(temporary_);
    if (exists) {
        if (const Reason reason = platform::set_permissions(file_, permissions); reason != 0) {
            return failure(reason);
        }
    }
    return {};
}

Result<Output> Output::open(const std::string& path, const Console& console) {
    if (path != "-" && console.io().files != nullptr) {
        const FileType type = platform::facts_of(path).type;
        const bool is_file = type == FileType::Regular || type == FileType::Missing;
        const std::string_view refusal = is_file ? console.io().files->begin_write(path) : "";
        if (!refusal.empty()) {
            return Error{fmt::format("cannot write `{}`: {}", path, refusal)};
        }
    }
    return reopen(path, console);
}

Result<Output> Output::open_one_of_many(const std::string& path, const Console& console) {
    if (console.io().files != nullptr && console.io().files->is_read(path)) {
        return Error{fmt::format("cannot write `{}`: {}", path, kIsInput)};
    }
    return reopen(path, console);
}

Result<Output> Output::reopen(const std::string& path, const Console& console) {
    Output output(console, path);
    if (path == "-") {
        return output;
    }
    const FileFacts facts = platform::facts_of(path);
    const bool exists = facts.type != FileType::Missing;
    if (facts.type == FileType::Directory) {
        return output.failure(EISDIR);
    }
    if (exists && facts.type != FileType::Regular) { // a device or a pipe
        if (const Reason reason = platform::open_to_write(path, output.file_); reason != 0) {
            return output.failure(reason);
        }
        return output;
    }
    output.target_ = path;
    if (exists) {
        Reason reason = platform::check_writable(path);
        if (reason == 0) {
            reason = platform::resolve_links(path, output.target_);
            // In a folder whose path is too long for the system, `path` can still name a file.
            if (reason == ENAMETOOLONG && platform::link_facts_of(path).type != FileType::Link) {
                output.target_ = path;
                reason = 0;
            }
        }
        if (reason != 0) {
            return output.failure(reason);
        }
    }
    if (Result<void> made = output.make_temporary(exists, facts.permissions); !made) {
        return made.error();
    }
    return output;
}

Result<Output> Output::create(const std::string& path, const Console& console) {
    Output output(console, path);
    output.must_be_new_ = true;
    output.target_ = path;
    if (platform::link_facts_of(path).type != FileType::Missing) {
        return output.failure(EEXIST);
    }
    if (Result<void> made = output.make_temporary(false, 0); !made) {
        return made.error();
    }
    return output;
}

Result<void> Output::write(std::string_view text) {
    if (!file_.is_open()) {
        return console_->write(text);
    }
    if (Result<void> taken = console_->take_output(text.size()); !taken) {
        return taken;
    }
    while (!text.empty()) {
        const auto [count, reason] = platform::write_some(file_, text.data(), text.size());
        if (reason != 0 && reason != EINTR) {
            return failure(reason);
        }
        text.remove_prefix(count);
    }
    return {};
}

Result<void> Output::finish(Storing storing) {
    if (std::exchange(is_finished_, true)) {
        return {};
    }
    if (!file_.is_open()) {
        return console_->flush();
    }
    // After a power failure the name must not stand for a file whose bytes were never stored.
    const bool stores = storing == Storing::BeforeNaming && !temporary_.empty();
    Reason reason = stores ? platform::store(file_) : 0;
    if (reason == 0 && !temporary_.empty()) {
        reason = platform::keep_lock(file_, temporary_, lock_);
    }
    if (const Reason closed = file_.close(); reason == 0) {
        reason = closed;
    }
    return reason == 0 ? Result<void>() : failure(reason);
}

Result<void> Output::commit() {
    if (Result<void> finished = finish(); !finished) {
        return finished;
    }
    if (temporary_.empty()) {
        return {};
    }
    Reason reason = must_be_new_ ? platform::rename_to_new(temporary_, target_)
                                 : platform::rename_file(temporary_, target_);
    if (must_be_new_ && (reason == EINVAL || reason == ENOSYS)) {
        reason = platform::rename_file(temporary_, target_); // create() found no target_
    }
    if (reason != 0) {
        return failure(reason);
    }
    forget_temporary();
    lock_ = platform::File();
    return {};
}

/// Gives the file its name. A file with that name gets the temporary name, from which unpublish()
/// can restore it.
Result<void> Output::publish() {
    if (temporary_.empty() || must_be_new_ ||
        platform::link_facts_of(target_).type != FileType::Regular) {
        const bool has_name = !temporary_.empty();
        Result<void> done = commit();
        state_ = done && has_name ? State::New : State::Unpublished;
        return done;
    }
    if (platform::exchange_files(temporary_, target_) == 0) {
        lock_ = platform::File(); // the file has its name
        state_ = State::Exchanged;
        return {};
    }
    Result<void> done = commit();
    state_ = done ? State::Replaced : State::Unpublished;
    return done;
}

void Output::unpublish() {
    if (state_ == State::New) {
        platform::remove_file(target_.c_str());
    } else if (state_ == State::Exchanged) {
        static_cast<void>(platform::exchange_files(temporary_, target_));
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

namespace {

Result<void> write_all(Result<Output> output, std::string_view text) {
    if (!output) {
        return output.error();
    }
    if (Result<void> written = output.value().write(text); !written) {
        return written;
    }
    return output.value().commit();
}

} // namespace

Result<void> write_file(const std::string& path, std::string_view text, const Console& console) {
    return write_all(Output::open(path, console), text);
}

Result<void> rewrite_file(const std::string& path, std::string_view text, const Console& console) {
    return write_all(Output::reopen(path, console), text);
}

} // namespace lsys
