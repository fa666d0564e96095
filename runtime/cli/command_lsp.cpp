// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/explanations.h"
#include "runtime/languageserver/serve_editor.h"
#include "runtime/platform/input.h"
#include "runtime/program/host.h"
#include "runtime/repair/fixes.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

namespace fs = std::filesystem;

/// The .lsys files in a folder and its folders at any depth, sorted by name. Omits hidden folders.
std::vector<std::string> grammars_below(const std::string& folder) {
    constexpr std::size_t kMaxFiles = 2000;
    constexpr std::size_t kMaxEntries = 50'000; // files of any kind
    constexpr int kMaxDepth = 8;
    std::vector<std::string> files;
    std::error_code failed;
    fs::recursive_directory_iterator entries(path_of(folder),
                                             fs::directory_options::skip_permission_denied, failed);
    std::size_t count = 0;
    while (!failed && entries != fs::recursive_directory_iterator() && files.size() < kMaxFiles &&
           ++count <= kMaxEntries) {
        std::error_code ignored;
        const std::string name = path_text(entries->path().filename());
        if (name.starts_with('.') || entries.depth() >= kMaxDepth) {
            entries.disable_recursion_pending();
        }
        if (name.ends_with(".lsys") && entries->is_regular_file(ignored)) {
            files.push_back(path_text(entries->path()));
        }
        entries.increment(failed);
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// The explanation of `lsc explain` as Markdown.
std::string explain_as_markdown(std::string_view code) {
    for (const Explanation& explanation : parse_explanations(explanations_text())) {
        if (explanation.code != code) {
            continue;
        }
        std::string text = explanation.text;
        for (const Example& example : explanation.examples) {
            text += example.is_correct ? "\n\nRight:\n" : "\n\nWrong:\n";
            for (const auto& [name, grammar] : example.files) {
                text += "\n```lsys\n" + grammar + "```";
            }
        }
        return text;
    }
    return {};
}

/// The explanations of all messages as a file: the installed one, or that of the sources if the
/// program is in its build folder. Empty if neither is found.
std::string explanations_file() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (failed) {
        return {};
    }
    const fs::path folder = program.parent_path();
    for (const fs::path& file : {folder / ".." / LSC_DOCUMENTS / "grammar/explanations.md",
                                 folder / "../.." / "grammar/explanations.md"}) {
        if (fs::exists(file, failed)) {
            return path_text(file.lexically_normal());
        }
    }
    return {};
}

} // namespace

ExitStatus run_command(const LspCommand& command, const Console& console) {
    LanguageServerHost host;
    host.project = make_project(console, command.run);
    host.version = LSC_VERSION;
    host.grammars_below = grammars_below;
    host.explain = explain_as_markdown;
    host.explanation_uri = [file = explanations_file()](std::string_view code) {
        return file.empty() ? std::string() : uri_of_path(file) + "#" + std::string(code);
    };
    host.offer_doubtful = [](const CheckedText& checked, const Project& project,
                             CompiledText& compiled) {
        const repair::FixScope scope(checked.path, std::array{checked.path});
        // After an error, such as an unreadable file, no fix is known to be certain.
        if (!repair::offer_doubtful_fixes(checked.path, checked.text, checked.options, scope,
                                          project, compiled)) {
            compiled.diagnostics.offer_fixes_from(0);
        }
    };
    host.fix = [](const CheckedText& checked, const Project& project) {
        repair::FixedGrammar fixed;
        const repair::FixScope scope(checked.path, std::array{checked.path});
        const Result<void> done =
            repair::fix_text(checked.path, checked.text, checked.options, scope, project,
                             repair::FixChoice::Certain, fixed);
        return done ? std::move(fixed.changed) : std::map<std::string, std::string>();
    };
    LanguageServer server(std::move(host));
    // A signal does not end a read of the stream. So wait for input or a signal, and begin a read
    // only when there is input.
    const auto wait = [&console] {
        constexpr int kMilliseconds = 500;
        const bool is_process = console.io().interrupted != nullptr;
        while (is_process && !console.interrupted()) {
            if (platform::wait_for_standard_input(kMilliseconds)) {
                return true;
            }
        }
        return !is_process;
    };
    return serve_editor(server, console.io().in, console.io().out, wait) == 0
               ? ExitStatus::Ok
               : ExitStatus::AuthorErrors;
}

} // namespace lsys::lsc
