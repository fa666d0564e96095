// SPDX-License-Identifier: MIT
#include "viewer/app/editor.h"

#include "grammar/base/paths.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace lsys::view {

namespace {

/// Form of the arguments that open a file at a line and column.
enum class PlaceForm : std::uint8_t {
    PlusLine, // +LINE FILE
    Goto,     // --goto FILE:LINE:COLUMN
    Suffix,   // FILE:LINE:COLUMN
    Options,  // --line LINE --column COLUMN FILE
};

struct EditorForm {
    std::string_view name;
    PlaceForm form = PlaceForm::PlusLine;
    bool needs_terminal = false;
};
/// Editors that take a place in another form than `+LINE FILE`, or that need a terminal.
constexpr std::array kEditors{
    EditorForm{"code", PlaceForm::Goto, false},
    EditorForm{"code-insiders", PlaceForm::Goto, false},
    EditorForm{"code-oss", PlaceForm::Goto, false},
    EditorForm{"codium", PlaceForm::Goto, false},
    EditorForm{"vscodium", PlaceForm::Goto, false},
    EditorForm{"cursor", PlaceForm::Goto, false},
    EditorForm{"subl", PlaceForm::Suffix, false},
    EditorForm{"zed", PlaceForm::Suffix, false},
    EditorForm{"zeditor", PlaceForm::Suffix, false},
    EditorForm{"kate", PlaceForm::Options, false},
    EditorForm{"kwrite", PlaceForm::Options, false},
    EditorForm{"hx", PlaceForm::Suffix, true},
    EditorForm{"helix", PlaceForm::Suffix, true},
    EditorForm{"vi", PlaceForm::PlusLine, true},
    EditorForm{"vim", PlaceForm::PlusLine, true},
    EditorForm{"vim.basic", PlaceForm::PlusLine, true},
    EditorForm{"vim.tiny", PlaceForm::PlusLine, true},
    EditorForm{"nvim", PlaceForm::PlusLine, true},
    EditorForm{"nano", PlaceForm::PlusLine, true},
    EditorForm{"pico", PlaceForm::PlusLine, true},
    EditorForm{"micro", PlaceForm::PlusLine, true},
    EditorForm{"kak", PlaceForm::PlusLine, true},
    EditorForm{"joe", PlaceForm::PlusLine, true},
    EditorForm{"jed", PlaceForm::PlusLine, true},
    EditorForm{"ne", PlaceForm::PlusLine, true},
    EditorForm{"mcedit", PlaceForm::PlusLine, true},
    EditorForm{"editor", PlaceForm::PlusLine, true}, // Debian's link, usually to vi or nano
};

struct TerminalForm {
    std::string_view name;
    std::string_view option; // before the command; empty: none
};
constexpr std::array kTerminals{
    TerminalForm{"x-terminal-emulator", "-e"},
    TerminalForm{"gnome-terminal", "--"},
    TerminalForm{"konsole", "-e"},
    TerminalForm{"xfce4-terminal", "-x"},
    TerminalForm{"kitty", ""},
    TerminalForm{"foot", ""},
    TerminalForm{"alacritty", "-e"},
    TerminalForm{"xterm", "-e"},
};

constexpr const char* kAdvice =
    "set VISUAL to an editor with a window, such as `gvim` or `code`, and start lsview again";

EditorForm form_of(const std::vector<std::string>& words) {
    const std::string_view name = name_of_path(words.front());
    const auto* const known = std::find_if(kEditors.begin(), kEditors.end(),
                                           [&](const EditorForm& one) { return one.name == name; });
    EditorForm form = known != kEditors.end() ? *known : EditorForm{};
    if (name.starts_with("emacs")) {
        form.needs_terminal = std::any_of(words.begin(), words.end(), [](const std::string& word) {
            return word == "-nw" || word == "-t" || word == "-tty" || word == "--tty" ||
                   word == "--no-window-system";
        });
    }
    return form;
}

/// The words of the command, with the path of its program; empty if there is no such program.
std::vector<std::string> found_command(std::string_view command,
                                       const EditorEnvironment& environment) {
    std::vector<std::string> words = command_words(command);
    if (words.empty()) {
        return {};
    }
    if (words.front().find('/') == std::string::npos) {
        words.front() = environment.find(words.front());
    }
    return words.front().empty() ? std::vector<std::string>() : words;
}

/// Appends the arguments that open `place`. An absolute path cannot be mistaken for an option.
void append_place(const FilePosition& place, PlaceForm form, std::vector<std::string>& words) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path_of(place.file), error);
    const std::string file = error ? place.file : path_text(absolute);
    const std::string suffixed = fmt::format("{}:{}:{}", file, place.line, place.column);
    switch (form) {
    case PlaceForm::Goto:
        words.insert(words.end(), {"--goto", suffixed});
        return;
    case PlaceForm::Suffix:
        words.push_back(suffixed);
        return;
    case PlaceForm::Options:
        words.insert(words.end(), {"--line", fmt::format("{}", place.line), "--column",
                                   fmt::format("{}", place.column), file});
        return;
    case PlaceForm::PlusLine:
        words.insert(words.end(), {fmt::format("+{}", place.line), file});
        return;
    }
}

/// Puts a terminal program before the words of a command; clears `words` if there is no terminal
/// program.
void run_in_terminal(const EditorEnvironment& environment, std::vector<std::string>& words) {
    std::vector<std::string> terminal = found_command(environment.terminal, environment);
    for (const TerminalForm& form : kTerminals) {
        const bool is_named = !terminal.empty() && name_of_path(terminal.front()) == form.name;
        if (terminal.empty()) {
            const std::string path = environment.find(std::string(form.name));
            if (path.empty()) {
                continue;
            }
            terminal = {path};
        } else if (!is_named && form.name != kTerminals.back().name) {
            continue; // unknown terminals take the option of xterm
        }
        if (!form.option.empty()) {
            terminal.emplace_back(form.option);
        }
        words.insert(words.begin(), terminal.begin(), terminal.end());
        return;
    }
    words.clear();
}

} // namespace

EditorEnvironment editor_environment() {
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name);
        return std::string(value == nullptr ? "" : value);
    };
    return {variable("VISUAL"), variable("EDITOR"), variable("TERMINAL"), platform::find_program};
}

std::vector<std::string> command_words(std::string_view command) {
    std::vector<std::string> words;
    bool is_in_word = false;
    char quote = '\0';
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        if (quote == '\0' && (c == ' ' || c == '\t' || c == '\n')) {
            is_in_word = false;
            continue;
        }
        if (!is_in_word) {
            words.emplace_back();
            is_in_word = true;
        }
        if (c == quote) {
            quote = '\0';
        } else if (quote == '\0' && (c == '"' || c == '\'')) {
            quote = c;
        } else if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
            words.back() += command[++i];
        } else {
            words.back() += c;
        }
    }
    return words;
}

Result<std::vector<std::string>> editor_command(const FilePosition& place,
                                                const EditorEnvironment& environment) {
    const bool has_visual = !command_words(environment.visual).empty();
    std::vector<std::string> words =
        found_command(has_visual ? environment.visual : environment.editor, environment);
    if (has_visual && words.empty()) {
        return Error{fmt::format("VISUAL is `{}`, but there is no such program; {}",
                                 environment.visual, kAdvice)};
    }
    if (!has_visual && (words.empty() || form_of(words).needs_terminal)) {
        for (const char* const name : {"code", "codium"}) {
            if (const std::string path = environment.find(name); !path.empty()) {
                words = {path};
                break;
            }
        }
    }
    if (words.empty()) {
        return Error{fmt::format("no editor is known: {}", kAdvice)};
    }
    const EditorForm form = form_of(words);
    const std::string name = words.front();
    append_place(place, form.form, words);
    if (form.needs_terminal) {
        run_in_terminal(environment, words);
    }
    return words.empty() ? Result<std::vector<std::string>>(Error{fmt::format(
                               "`{}` needs a terminal, and no terminal program is found: {}",
                               name_of_path(name), kAdvice)})
                         : words;
}

Result<std::string> Editors::open(const FilePosition& place) {
    Result<std::vector<std::string>> command = editor_command(place, editor_environment());
    if (!command) {
        return command.error();
    }
    Running started{{}, std::string(name_of_path(command.value().front()))};
    const platform::Reason reason = platform::start_program(command.value(), started.child);
    if (reason != 0) {
        return Error{fmt::format("cannot run `{}`: {}", started.name, errno_text(reason))};
    }
    running_.push_back(started);
    return started.name;
}

std::string Editors::forget_ended() {
    std::string message;
    std::erase_if(running_, [&message](Running& one) {
        int status = 0;
        if (!platform::has_ended(one.child, status)) {
            return false;
        }
        if (status != 0) {
            message = status < 0 ? fmt::format("`{}` was ended by a signal", one.name)
                                 : fmt::format("`{}` ended with status {}", one.name, status);
        }
        return true;
    });
    return message;
}

} // namespace lsys::view
