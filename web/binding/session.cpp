// SPDX-License-Identifier: MIT
#include "web/binding/session.h"

#include "grammar/base/paths.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/program/memory_size.h"
#include "web/binding/impl/message_json.h"
#include "web/binding/impl/operations.h"

#include <fmt/format.h>

#include <utility>

namespace lsys::web {

namespace {

std::string normal_path(const std::string& path) {
    return path_text(path_of(path).lexically_normal());
}

Outcome<void> fail(std::string text) {
    Messages messages;
    messages.add_error(std::move(text));
    return {Stop::Failed, std::move(messages)};
}

} // namespace

Session::Session(std::function<void(const DerivationProgress&)> progress) {
    const auto read = [this](const std::string& path, const ReadLimit& limit) {
        const auto found = files_.find(normal_path(path));
        if (found == files_.end()) {
            return Result<std::string>(Error{"no such file"});
        }
        if (found->second.size() > limit.max_bytes || found->second.size() > limit.memory) {
            return Result<std::string>(Error{"the file is too large", ErrorKind::Limit});
        }
        return Result<std::string>(found->second);
    };
    project_.host.read_file = read;
    project_.host.read_referenced_file = read;
    project_.host.file_exists = [this](const std::string& path) {
        return files_.contains(normal_path(path));
    };
    project_.host.progress = std::move(progress);
    project_.host.environment_help = [](const std::string& name) {
        return fmt::format("a web page starts no programs: derive this grammar with "
                           "`lsc --environment {}=COMMAND`",
                           name);
    };
    project_.limits.max_bytes = half_of_memory();
    project_.threads = 1;
    // A grammar may come from a link. It reads only files of the page.
    project_.files.max_included_files = kUntrustedIncludedFiles;
    project_.files.max_included_bytes = kUntrustedIncludedBytes;
}

void Session::take_files(const Json& list, std::string_view bytes) {
    files_.clear();
    std::size_t begin = 0;
    for (const Json& file : list) {
        const auto size = file.at("size").get<std::size_t>();
        files_[normal_path(file.at("path").get<std::string>())] = bytes.substr(begin, size);
        begin += size;
    }
}

Outcome<void> Session::run(std::string_view text, std::string_view files, Answer& answer) {
    try {
        const Json request = Json::parse(text);
        if (const auto list = request.find("files"); list != request.end()) {
            take_files(*list, files);
        }
        project_.limits.max_modules = request.value("maxModules", Limits{}.max_modules);
        const std::string name = request.at("op").get<std::string>();
        const Operation operation = find_operation(name);
        return operation != nullptr ? operation(*this, request, answer)
                                    : fail(fmt::format("there is no operation `{}`", name));
    } catch (const Json::exception& mistake) {
        return fail(fmt::format("the request is not valid: {}", mistake.what()));
    }
}

Answer Session::answer(std::string_view request, std::string_view files) {
    Answer answer;
    const Outcome<void> outcome =
        catch_out_of_memory([&] { return run(request, files, answer); },
                            []() -> Outcome<void> {
                                Messages messages;
                                messages.add_error("there is not enough memory");
                                return {Stop::OutOfMemory, std::move(messages)};
                            });
    if (!outcome) {
        answer = {};
    }
    answer.head["status"] = outcome ? "ok" : status_name(outcome.stop());
    answer.head["blocks"] = answer.blocks.size();
    answer.head["messages"] = json_of(outcome.messages());
    return answer;
}

} // namespace lsys::web
