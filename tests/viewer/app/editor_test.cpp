// SPDX-License-Identifier: MIT
#include "viewer/app/editor.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

using namespace lsys;
using namespace lsys::view;

namespace {

using Words = std::vector<std::string>;

const FilePosition kPlace{"/tmp/a \"b\"/tree's.lsys", 12, 5};

/// An environment in which these programs lie in /bin.
EditorEnvironment with_programs(const std::set<std::string>& names) {
    EditorEnvironment environment;
    environment.find = [names](const std::string& name) {
        return names.contains(name) ? "/bin/" + name : std::string();
    };
    return environment;
}

Words command_of(const EditorEnvironment& environment) {
    const Result<Words> command = editor_command(kPlace, environment);
    return command ? command.value() : Words{"error: " + command.error().message};
}

} // namespace

TEST_CASE("commands are split into words as by a shell") {
    CHECK(command_words("  gvim\t-f ") == Words{"gvim", "-f"});
    CHECK(command_words(R"("/opt/my editor/run" --name='a "b"' c\ d "\"" '')") ==
          Words{"/opt/my editor/run", "--name=a \"b\"", "c d", "\"", ""});
    CHECK(command_words(" ").empty());
}

TEST_CASE("VISUAL comes first, with its arguments and with blanks and quotes in file names") {
    EditorEnvironment environment = with_programs({"gvim", "code", "codium", "kate", "subl"});
    environment.visual = "gvim -f";
    environment.editor = "nano";
    CHECK(command_of(environment) == Words{"/bin/gvim", "-f", "+12", kPlace.file});
    environment.visual = "'/opt/an editor/e' -x";
    CHECK(command_of(environment) == Words{"/opt/an editor/e", "-x", "+12", kPlace.file});
    environment.visual = "codium --wait";
    CHECK(command_of(environment) ==
          Words{"/bin/codium", "--wait", "--goto", kPlace.file + ":12:5"});
    environment.visual = "kate";
    CHECK(command_of(environment) ==
          Words{"/bin/kate", "--line", "12", "--column", "5", kPlace.file});
    environment.visual = "subl";
    CHECK(command_of(environment) == Words{"/bin/subl", kPlace.file + ":12:5"});
    environment.visual = "missing";
    CHECK(command_of(environment)
              .front()
              .starts_with("error: VISUAL is `missing`, but there is no such program; set VISUAL"));
}

TEST_CASE("without VISUAL the editor with a window is taken, then VS Code") {
    EditorEnvironment environment = with_programs({"gedit", "code", "nano", "xterm"});
    CHECK(command_of(environment) == Words{"/bin/code", "--goto", kPlace.file + ":12:5"});
    environment.editor = "gedit";
    CHECK(command_of(environment) == Words{"/bin/gedit", "+12", kPlace.file});
    environment.editor = "nano";
    CHECK(command_of(environment).front() == "/bin/code");
    CHECK(command_of(with_programs({"codium"})).front() == "/bin/codium");
    CHECK(command_of(with_programs({}))
              .front()
              .starts_with("error: no editor is known: set VISUAL to an editor with a window"));
}

TEST_CASE("an editor without a window runs in a terminal") {
    EditorEnvironment environment = with_programs({"vim", "emacs", "xterm", "gnome-terminal"});
    environment.visual = "vim";
    CHECK(command_of(environment) ==
          Words{"/bin/gnome-terminal", "--", "/bin/vim", "+12", kPlace.file});
    environment.terminal = "xterm -geometry 90x40";
    CHECK(command_of(environment) ==
          Words{"/bin/xterm", "-geometry", "90x40", "-e", "/bin/vim", "+12", kPlace.file});
    environment.terminal = "/opt/term";
    CHECK(command_of(environment) == Words{"/opt/term", "-e", "/bin/vim", "+12", kPlace.file});
    environment.visual = "emacs";
    CHECK(command_of(environment) == Words{"/bin/emacs", "+12", kPlace.file});
    environment.visual = "emacs -nw";
    CHECK(command_of(environment).front() == "/opt/term");
    environment = with_programs({"vi"});
    environment.visual = "vi";
    CHECK(command_of(environment)
              .front()
              .starts_with("error: `vi` needs a terminal, and no terminal program is found"));
}

TEST_CASE("a program runs beside, and its status is taken when it has ended") {
    platform::Child child;
    REQUIRE(platform::start_program({"/bin/sh", "-c", "exit 3"}, child) == 0);
    int status = 0;
    for (int i = 0; i < 1000 && !platform::has_ended(child, status); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK(status == 3);
    CHECK(child.process_id == 0);
    CHECK_FALSE(platform::has_ended(child, status));
    CHECK(platform::start_program({"/nowhere/editor", "+1"}, child) != 0);
}
