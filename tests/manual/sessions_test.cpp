// SPDX-License-Identifier: MIT
// Terminal sessions in documents. A block ```console is a session: lines that begin with "$ " are
// commands, followed by their output. Blocks ```sh have commands without output; only their options
// are checked.
#include "tests/manual/commands.h"
#include "tests/manual/markdown.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace lsys::tests {

namespace {

void check_session(const std::filesystem::path& document, std::size_t& count) {
    const ScratchFolder folder;
    std::filesystem::create_directory_symlink(source_root() / "samples", folder.path() / "samples");
    Session session(folder.path());
    for (const Fence& fence : fences_of(read_text(source_root() / document))) {
        if (fence.info != "console") {
            continue;
        }
        for (const SessionStep& step : steps_of(fence.lines)) {
            const std::string wrong = session.run(step);
            if (!wrong.empty()) {
                FAIL_CHECK(document.string() << ":" << fence.line + 1 + step.line << ": " << wrong);
            }
            ++count;
        }
    }
    CHECK(session.finish().empty());
}

void check_commands(const std::filesystem::path& document) {
    for (const Fence& fence : fences_of(read_text(source_root() / document))) {
        if (fence.info != "sh") {
            continue;
        }
        std::string command;
        for (std::size_t i = 0; i < fence.lines.size(); ++i) {
            command += fence.lines[i];
            if (command.ends_with('\\')) {
                command.pop_back();
                continue;
            }
            const std::vector<std::string> words = words_of(command);
            command.clear();
            const std::size_t line = fence.line + 1 + i;
            if (const std::string wrong = check_options(words); !wrong.empty()) {
                FAIL_CHECK(document.string() << ":" << line << ": " << wrong);
            }
            if (!words.empty() && words[0].starts_with("scripts/") &&
                !std::filesystem::exists(source_root() / words[0])) {
                FAIL_CHECK(document.string() << ":" << line << ": no such script");
            }
        }
    }
}

} // namespace

TEST_CASE("the sessions of the documents print the output stated there") {
    std::size_t count = 0;
    for (const std::filesystem::path& document : all_documents()) {
        check_session(document, count);
        check_commands(document);
    }
    CHECK(count >= 20);
}

TEST_CASE("sessions are parsed like a shell") {
    CHECK(words_of("lsc dump 'a b.lsys' -n 3 # three") ==
          std::vector<std::string>{"lsc", "dump", "a b.lsys", "-n", "3"});
    const std::vector<SessionStep> steps =
        steps_of({"$ lsc dump a \\", "    -n 3", "F", "", "$ x"});
    REQUIRE(steps.size() == 2);
    CHECK(words_of(steps[0].command) == std::vector<std::string>{"lsc", "dump", "a", "-n", "3"});
    CHECK(steps[0].output == std::vector<std::string>{"F", ""});
    CHECK(matches_output({"a", "...", "c"}, {"a", "b", "b", "c"}));
    CHECK(matches_output({"a", "...", "c"}, {"a", "c"}));
    CHECK_FALSE(matches_output({"a", "...", "c"}, {"a", "b"}));
    CHECK_FALSE(matches_output({"a"}, {"a", "b"}));
    CHECK_FALSE(matches_output({"a", "b"}, {"a"}));
}

TEST_CASE("the message about a session that differs has the actual output") {
    const ScratchFolder folder;
    Session session(folder.path());
    CHECK(session.run({0, "cat a.lsys", {"#n = 1;", "#w : F;"}}).empty());
    CHECK(session.run({0, "lsc dump a.lsys", {"F"}}).empty());
    CHECK(session.run({0, "lsc dump a.lsys", {"G"}}) == "$ lsc dump a.lsys\nprints\nF\n");
    CHECK(session.run({0, "cat a.lsys", {"#n = 2;"}}) ==
          "$ cat a.lsys\nthe file holds\n#n = 1;\n#w : F;\n");
    CHECK(session.run({0, "lsc dump missing.lsys", {"..."}}).empty());
    CHECK(session.finish() ==
          "$ lsc dump missing.lsys\nthe exit status is 2; show it by `$ echo $?`");
    CHECK(session.run({0, "echo $?", {"2"}}).empty());
    CHECK(session.finish().empty());
    CHECK(session.run({0, "rm a.lsys", {}}).find("the test runs") != std::string::npos);
    CHECK_FALSE(check_options({"lsc", "dump", "--no-such-option"}).empty());
    CHECK(check_options({"lsc", "dump", "a.lsys"}).empty());
}

} // namespace lsys::tests
