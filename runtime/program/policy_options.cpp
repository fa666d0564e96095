// SPDX-License-Identifier: MIT
#include "runtime/program/policy_options.h"

#include "grammar/base/paths.h"
#include "runtime/program/arguments.h"
#include "runtime/program/find_option.h"
#include "runtime/program/memory_size.h"
#include "runtime/program/option_parsers.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

constexpr const char* kGroup = "Limits";
constexpr double kUntrustedSeconds = 60.0;
constexpr std::uint64_t kUntrustedBytes = std::uint64_t{1} << 30U; // of memory, and of output

Result<std::string> parse_folder(const std::string& text) {
    std::error_code ignored;
    return std::filesystem::is_directory(path_of(text), ignored)
               ? Result<std::string>(text)
               : Error{fmt::format("`{}` is not a folder", text)};
}

Result<double> parse_seconds(const std::string& text) {
    constexpr float kMin = 0.001F;
    constexpr float kMax = 31'536'000.0F; // a year
    const Result<float> seconds = parse_number(text, kMin, kMax);
    return seconds ? Result<double>(static_cast<double>(seconds.value())) : seconds.error();
}

} // namespace

void add_file_policy(CLI::App& app, RunOptions& run, Trust trust) {
    run.files.is_untrusted = trust == Trust::Untrusted;
    app.add_flag_callback(
           "--untrusted", [&run] { run.files.is_untrusted = true; },
           trust == Trust::Untrusted
               ? "Also limit the memory to 1 GiB, and the time until the server listens to a minute"
               : "Grammars and scenes are not trusted: they name only files of their own folder, "
                 "start no programs, and have limits of memory, time and output (1 GiB, a minute, "
                 "1 GiB, unless options set others)")
        ->group(kGroup);
    if (trust == Trust::Untrusted) {
        app.add_flag_callback(
               "--trusted", [&run] { run.files.is_untrusted = false; },
               "The scene and its grammars may name files anywhere (default: only files in the "
               "folder of FILE or below)")
            ->group(kGroup);
    }
    add_parsed(app, "--root", run.files.root, parse_folder,
               "For files that are not trusted: the folder of all files that they name (default: "
               "the folder of FILE)")
        ->type_name("FOLDER")
        ->group(kGroup);
}

void add_time_limit(CLI::App& app, RunOptions& run, const char* text) {
    add_parsed(app, "--max-time", run.max_seconds, parse_seconds, text)
        ->type_name("SECONDS")
        ->group(kGroup);
}

void add_run_policy(CLI::App& app, RunOptions& run) {
    add_time_limit(app, run, "Maximum duration of the command (default: none)");
    add_parsed(app, "--max-output", run.max_output, parse_size,
               "Maximum size of all files and of standard output together (default: none)")
        ->type_name("SIZE")
        ->group(kGroup);
}

std::optional<UsageError>
apply_policy(const CLI::App& app, std::vector<std::string> named, RunOptions& run) {
    const bool is_option = is_given(app, "--untrusted");
    if (is_option && is_given(app, "--trusted")) {
        return UsageError{"--trusted and --untrusted contradict each other", "leave one out"};
    }
    if (!run.files.is_untrusted) {
        return run.files.root.empty()
                   ? std::nullopt
                   : std::optional(UsageError{"--root is for grammars that are not trusted",
                                              "add --untrusted, or leave --root out"});
    }
    if (!run.environments.empty()) {
        return UsageError{"--environment starts a program, which gets data of grammars that are "
                          "not trusted",
                          is_option ? "leave --untrusted or --environment out"
                                    : "add --trusted if the grammars are trusted"};
    }
    run.files.named = std::move(named);
    std::erase(run.files.named, "");
    run.files.max_included_files = kUntrustedIncludedFiles;
    run.files.max_included_bytes = kUntrustedIncludedBytes;
    if (!is_option) {
        return std::nullopt;
    }
    if (!is_given(app, "--max-memory")) {
        run.limits.max_bytes = std::min({run.limits.max_bytes, kUntrustedBytes, half_of_memory()});
    }
    if (!is_given(app, "--max-time")) {
        run.max_seconds = kUntrustedSeconds;
    }
    if (!is_given(app, "--max-output")) {
        run.max_output = kUntrustedBytes;
    }
    return std::nullopt;
}

} // namespace lsys
