// SPDX-License-Identifier: MIT
// The user's editor: the command line that opens a file at a line, and the programs started with
// it, which run beside lsview.
#pragma once

#include "grammar/base/result.h"
#include "runtime/pipeline/file_position.h"
#include "runtime/platform/child.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

/// The environment from which an editor is chosen.
struct EditorEnvironment {
    std::string visual;   // $VISUAL: a program with arguments
    std::string editor;   // $EDITOR
    std::string terminal; // $TERMINAL
    /// The path of a program in the folders of PATH, or empty.
    std::function<std::string(const std::string& name)> find;
};
[[nodiscard]] EditorEnvironment editor_environment();

/// The words of a command, split at blanks. Quotes and backslashes keep blanks, as in a shell.
[[nodiscard]] std::vector<std::string> command_words(std::string_view command);

/// The command line that opens a place: $VISUAL; or $EDITOR if it has a window of its own; or VS
/// Code; or $EDITOR in a terminal. An editor without a window is run in a terminal program. Error:
/// there is no such program; the text of the error names the variables to set.
[[nodiscard]] Result<std::vector<std::string>> editor_command(const FilePosition& place,
                                                              const EditorEnvironment& environment);

/// The editors started.
class Editors {
public:
    /// Starts the editor and returns its name at once.
    [[nodiscard]] Result<std::string> open(const FilePosition& place);
    /// Forgets editors that have ended. Returns a message about one that failed, else no text.
    [[nodiscard]] std::string forget_ended();

private:
    struct Running {
        platform::Child child;
        std::string name;
    };
    std::vector<Running> running_;
};

} // namespace lsys::view
