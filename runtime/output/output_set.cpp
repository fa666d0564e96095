// SPDX-License-Identifier: MIT
#include "runtime/output/output_set.h"

#include "grammar/base/paths.h"
#include "grammar/base/utf8.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace lsys {

bool OutputContext::can_write_beside(const std::string& path) const {
    if (receiver != nullptr) {
        return true;
    }
    std::error_code ignored;
    const auto kind = std::filesystem::status(path_of(path), ignored).type();
    return path != "-" && (kind == std::filesystem::file_type::not_found ||
                           kind == std::filesystem::file_type::regular);
}

namespace {

/// Whether a text is UTF-8 without control characters, so that it can stand in a line.
bool is_line_of_text(std::string_view text) {
    while (!text.empty()) {
        const CodePoint first = decode_utf8(text);
        if (!first.valid || first.value < 0x20 || first.value == 0x7F) {
            return false;
        }
        text.remove_prefix(first.length);
    }
    return true;
}

} // namespace

Result<std::string> mtl_name(const std::filesystem::path& path) {
    std::string name = path_text(path.filename());
    if (!is_line_of_text(name)) {
        return Error{"the name of an OBJ file is UTF-8 without control characters, because the "
                     "file names its .mtl file in a line of text"};
    }
    return name;
}

Result<void> check_picture_names(const std::vector<PictureFile>& pictures,
                                 const std::string& prefix) {
    if (!pictures.empty() && !is_line_of_text(prefix)) {
        return Error{"the name of a file with pictures beside it is UTF-8 without control "
                     "characters, because the names of the pictures begin with it"};
    }
    return {};
}

ExitStatus OutputSet::add(const std::string& path,
                          const std::function<Outcome<void>(const ByteSink&)>& write) {
    if (context_.paths != nullptr) {
        context_.paths->push_back(path);
    }
    if (context_.receiver != nullptr) {
        return hand_over(path, write);
    }
    const Console& console = context_.console;
    Result<Output> output = Output::open(path, console);
    if (!output) {
        return report_error(output.error(), console);
    }
    std::optional<Error> failure;
    const Outcome<void> written = write([&](std::string_view bytes) {
        if (console.interrupted()) {
            return false;
        }
        byte_count_ += bytes.size();
        const Result<void> done = output.value().write(bytes);
        if (!done) {
            failure = done.error();
        }
        return !failure;
    });
    if (failure) {
        return report_error(*failure, console);
    }
    if (const ExitStatus status = console.take(written); status != ExitStatus::Ok) {
        return status;
    }
    if (const Result<void> finished = output.value().finish(); !finished) {
        return report_error(finished.error(), console);
    }
    outputs_.push_back(std::move(output.value()));
    return ExitStatus::Ok;
}

ExitStatus OutputSet::hand_over(const std::string& path,
                                const std::function<Outcome<void>(const ByteSink&)>& write) {
    const Outcome<void> written = write([&](std::string_view bytes) {
        byte_count_ += bytes.size();
        return !context_.console.interrupted() && (*context_.receiver)({path, bytes, false});
    });
    const ExitStatus status = context_.console.take(written);
    if (status != ExitStatus::Ok) {
        return status;
    }
    return (*context_.receiver)({path, {}, true}) ? ExitStatus::Ok : ExitStatus::Interrupted;
}

ExitStatus OutputSet::add_text(const std::string& path, std::string_view text) {
    return add(path, [text](const ByteSink& sink) -> Outcome<void> {
        return sink(text) ? Outcome<void>() : Outcome<void>(Stop::Cancelled, Messages{});
    });
}

} // namespace lsys
