// SPDX-License-Identifier: MIT
// Man pages and completions: they have every command, option and value of the command line.
#include "packaging/pages/completion.h"
#include "packaging/pages/lsc_values.h"
#include "packaging/pages/manual_page.h"
#include "runtime/cli/command_line.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lsys::tests {

namespace {

using pages::CommandText;
using pages::OptionText;
using pages::ValueKind;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Text of a man page without escapes and fonts.
std::string plain(std::string page) {
    for (const auto& [escaped, shown] :
         std::vector<std::pair<std::string, std::string>>{{"\\fB", ""},
                                                          {"\\fI", ""},
                                                          {"\\fR", ""},
                                                          {"\\-", "-"},
                                                          {"\\(aq", "'"},
                                                          {"\\(ga", "`"}}) {
        for (std::size_t at = page.find(escaped); at != std::string::npos;
             at = page.find(escaped)) {
            page.replace(at, escaped.size(), shown);
        }
    }
    return page;
}

/// The part of a script from `begin` to the next `end`, without `end`.
std::string part_of(const std::string& script, const std::string& begin, const std::string& end) {
    const std::size_t at = script.find(begin);
    REQUIRE(at != std::string::npos);
    return script.substr(at, script.find(end, at) - at);
}

/// The lines of a script that contain `part`.
std::string lines_of(const std::string& script, const std::string& part) {
    std::istringstream lines(script);
    std::string found;
    for (std::string line; std::getline(lines, line);) {
        found += has(line, part) ? line + '\n' : std::string();
    }
    return found;
}

/// Whether `lsc COMMAND OPTION=VALUE` refuses the value.
bool is_refused(const CommandText& command, const OptionText& option, const std::string& value) {
    std::vector<std::string> arguments{command.name, pages::main_name(option) + "=" + value};
    for (const OptionText& other : command.positionals) {
        arguments.push_back(other.value == "FILE" ? "a.lsys" : "dump");
    }
    for (const OptionText& other : command.options) {
        if (other.required && other.names != option.names) {
            arguments.insert(arguments.end(), {other.names.front(), "a.glb"});
        }
    }
    const lsc::CommandLine parsed = lsc::parse_command_line(arguments);
    const auto* const usage = std::get_if<UsageError>(&parsed);
    return usage != nullptr && has(usage->message, "`" + value + "`");
}

} // namespace

TEST_CASE("lsc is described with all commands") {
    const pages::ProgramText program = pages::describe_lsc();
    std::vector<std::string> names;
    for (const CommandText& command : program.commands) {
        names.push_back(command.name);
        CHECK_FALSE(command.description.empty());
        CHECK(
            std::any_of(command.options.begin(), command.options.end(),
                        [](const OptionText& option) { return option.names.back() == "--help"; }));
    }
    CHECK(names == std::vector<std::string>{"check", "compile", "dump", "export", "forest",
                                            "import", "lsp", "place", "serve", "stats", "tiles",
                                            "trace", "fmt", "explain", "help"});
    CHECK(program.program.name == "lsc");
}

TEST_CASE("a man page has every option and argument with its text") {
    const pages::ProgramText program = pages::describe_lsc();
    const pages::PageInfo info{"2026-01-31", "1.2.3", {{"0", "success"}}, {"lsc"}};
    const std::string overview = plain(pages::program_page(program, info));
    for (const CommandText& command : program.commands) {
        CHECK(has(overview, ".BR lsc-" + command.name + " (1)\n" + command.description));
        const std::string page = plain(pages::command_page("lsc", command, info));
        INFO(page);
        CHECK(page.starts_with(".TH LSC-"));
        CHECK(has(page, "2026-01-31 \"lsc 1.2.3\""));
        for (const OptionText& option : command.options) {
            INFO(pages::main_name(option));
            for (const std::string& name : option.names) {
                CHECK(has(page, name));
            }
            const std::string first_words = option.description.substr(0, 12);
            CHECK(
                (has(first_words, "`") || has(first_words, "\"") || has(page, "\n" + first_words)));
        }
    }
}

TEST_CASE("no line of a man page is an accidental request") {
    CommandText command;
    command.name = "x";
    command.description = "Reads .lsys: `a\\b` and 'c'.";
    command.footer = ".lsb files\n'quoted' first\nExamples: lsc x -n 1\n          lsc x '.y'";
    OptionText option;
    option.names = {"-a"};
    option.description = ".hidden and ~ ^ \"text\"";
    command.options.push_back(option);
    const std::string page = pages::command_page("lsc", command, {"2026-01-31", "1", {}, {}});
    INFO(page);
    CHECK(has(page, "\n\\&.hidden and \\(ti \\(ha \\(dqtext\\(dq\n"));
    CHECK(has(page, "\n\\&.lsb files \\(aqquoted\\(aq first\n"));
    CHECK(has(page, "\\fBa\\eb\\fR"));
    CHECK(has(page, ".EX\nlsc x \\-n 1\nlsc x \\(aq.y\\(aq\n.EE\n"));
}

TEST_CASE("completions have every command and option") {
    const pages::ProgramText program = pages::describe_lsc();
    const std::string bash = pages::bash_completion(program);
    const std::string zsh = pages::zsh_completion(program);
    const std::string fish = pages::fish_completion(program);
    for (const CommandText& command : program.commands) {
        INFO(command.name);
        const std::string in_bash = part_of(bash, "_lsc__" + command.name + "()", "\n}\n");
        const std::string in_zsh = part_of(zsh, "_lsc__" + command.name + "()", "\n}\n");
        const std::string in_fish =
            lines_of(fish, "__fish_seen_subcommand_from " + command.name + "'");
        for (const OptionText& option : command.options) {
            for (const std::string& name : option.names) {
                INFO(name);
                CHECK((has(in_bash, " " + name + " ") || has(in_bash, " " + name + "'") ||
                       has(in_bash, "'" + name + " ")));
                CHECK((has(in_zsh, name + "[") || has(in_zsh, name + "=") ||
                       has(in_zsh, name + "+")));
                CHECK(has(in_fish, name.starts_with("--") ? " -l " + name.substr(2)
                                                          : " -s " + name.substr(1)));
            }
            for (const std::string& word : option.words) {
                CHECK(has(in_bash, word));
                CHECK(has(in_zsh, word));
                CHECK(has(in_fish, word));
            }
        }
    }
}

TEST_CASE("completions offer the values that the command line accepts") {
    std::size_t count = 0;
    for (const CommandText& command : pages::describe_lsc().commands) {
        for (const OptionText& option : command.options) {
            for (const std::string& word : option.words) {
                INFO(command.name << ' ' << pages::main_name(option) << ' ' << word);
                CHECK_FALSE(is_refused(command, option, word));
                ++count;
            }
            if (!option.words.empty()) {
                INFO(command.name << ' ' << pages::main_name(option));
                CHECK(is_refused(command, option, "no-such-value"));
            }
        }
    }
    CHECK(count > 500);
}

TEST_CASE("options with a fixed set of values offer them") {
    const pages::ProgramText program = pages::describe_lsc();
    const auto words = [&](const std::string& command_name, const std::string& option_name) {
        for (const CommandText& command : program.commands) {
            for (const OptionText& option : command.options) {
                if (command.name == command_name && pages::main_name(option) == option_name) {
                    return option.words;
                }
            }
        }
        return std::vector<std::string>{};
    };
    const auto contains = [](const std::vector<std::string>& all, const char* word) {
        return std::find(all.begin(), all.end(), word) != all.end();
    };
    CHECK(contains(words("export", "--format"), "usdz"));
    CHECK(contains(words("export", "--preset"), "unreal"));
    CHECK(contains(words("check", "--dialect"), "cpfg"));
    CHECK(contains(words("dump", "--stage"), "skeleton"));
    CHECK(contains(words("check", "--deny"), "condition-gap"));
    CHECK(contains(words("check", "--fix"), "offered"));
    CHECK(words("export", "--bones") == std::vector<std::string>{"all"});
    CHECK(words("export", "--wind").empty());
}

TEST_CASE("short texts end at the first colon or semicolon outside of code") {
    CHECK(pages::short_text("Write `a:b`; more") == "Write a:b");
    CHECK(pages::name_pattern({"lsys", "l++"}) == "[.](lsys|l[+][+])$");
    CHECK(pages::name_pattern({}).empty());
}

} // namespace lsys::tests
