// SPDX-License-Identifier: MIT
// The user's editor: the command line that opens a file at a line, and the editors that were
// started, which run beside lsview.
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

/// The words of a command line, split at blanks. Blanks in quotes or after a backslash do not
/// split, as in a shell.
[[nodiscard]] std::vector<std::string> command_words(std::string_view command);

/// The command line that opens a place: $VISUAL; or $EDITOR if it has a window of its own; or VS
/// Code; or $EDITOR in a terminal. An editor without a window is run in a terminal program. Error:
/// there is no such program; the text of the error names the variables to set.
[[nodiscard]] Result<std::vector<std::string>> editor_command(const FilePosition& place,
                                                              const EditorEnvironment& environment);

/// The editors that were started.
class Editors {
public:
    /// Starts the editor and returns its name at once.
    [[nodiscard]] Result<std::string> open(const FilePosition& place);
    /// Removes editors that have ended. Returns a message about one of them that failed, else an
    /// empty text.
    [[nodiscard]] std::string forget_ended();

private:
    struct Running {
        platform::Child child;
        std::string name; // name of the editor's program
    };
    std::vector<Running> running_;
};

} // namespace lsys::view
