// SPDX-License-Identifier: MIT
// `lsc lsp` as a program: pipes, exit status, and nothing but messages on standard output.
#include "runtime/languageserver/message_reader.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

using lsys::framed;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using Json = nlohmann::json;

const std::string kInitialize =
    R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}})";
const std::string kShutdown = R"({"jsonrpc":"2.0","id":2,"method":"shutdown"})";
const std::string kExit = R"({"jsonrpc":"2.0","method":"exit"})";

/// The messages of an output, which must have no other bytes.
std::vector<Json> messages_of(const std::string& out) {
    lsys::MessageReader reader;
    reader.add(out);
    std::vector<Json> all;
    while (const std::optional<lsys::ReadMessage> message = reader.next()) {
        REQUIRE(message->error.empty());
        all.push_back(Json::parse(message->body));
    }
    CHECK(reader.is_between_messages());
    return all;
}

struct ServerRun {
    int status = -1;
    std::vector<Json> messages;
};

/// A running program, with the ends of the pipes to its standard input and from its output.
struct StartedServer {
    pid_t process = -1;
    int input = -1;
    int output = -1;
};

StartedServer start_server() {
    int to[2];
    int from[2];
    REQUIRE(::pipe(to) == 0);
    REQUIRE(::pipe(from) == 0);
    const pid_t process = ::fork();
    if (process == 0) {
        ::dup2(to[0], STDIN_FILENO);
        ::dup2(from[1], STDOUT_FILENO);
        for (const int each : {to[0], to[1], from[0], from[1]}) {
            ::close(each);
        }
        std::signal(SIGTERM, SIG_DFL);
        ::execl(LSC_EXECUTABLE, LSC_EXECUTABLE, "lsp", nullptr);
        ::_exit(127);
    }
    ::close(to[0]);
    ::close(from[1]);
    return {process, to[1], from[0]};
}

/// Runs the program, writes `pieces` one after another to its standard input, and reads its output
/// to the end.
ServerRun run_server(const std::vector<std::string>& pieces) {
    const StartedServer server = start_server();
    for (const std::string& piece : pieces) {
        CHECK(::write(server.input, piece.data(), piece.size()) ==
              static_cast<ssize_t>(piece.size()));
    }
    ::close(server.input);
    std::string out;
    char buffer[4096];
    for (ssize_t count = 1; (count = ::read(server.output, buffer, sizeof buffer)) > 0;) {
        out.append(buffer, static_cast<std::size_t>(count));
    }
    ::close(server.output);
    int status = 0;
    REQUIRE(::waitpid(server.process, &status, 0) == server.process);
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), messages_of(out)};
}

} // namespace

TEST_CASE("the program ends with status 0 after shutdown and exit") {
    const ServerRun run = run_server({framed(kInitialize), framed(kShutdown), framed(kExit)});
    CHECK(run.status == 0);
    REQUIRE(run.messages.size() == 2);
    CHECK(run.messages[0].at("result").at("serverInfo").at("name") == "lsc");
    CHECK(run.messages[1].at("id") == 2);
}

TEST_CASE("the program ends with status 1 without shutdown, or when its input ends") {
    CHECK(run_server({framed(kInitialize), framed(kExit)}).status == 1);
    CHECK(run_server({framed(kInitialize)}).status == 1);
    CHECK(run_server({}).status == 1);
    const ServerRun cut = run_server({framed(kInitialize), framed(kShutdown).substr(0, 30)});
    CHECK(cut.status == 1);
    CHECK(cut.messages.size() == 1);
}

TEST_CASE("the program reads messages byte by byte and survives malformed ones") {
    std::vector<std::string> pieces;
    for (const char c : framed(kInitialize) + "Content-Length: x\r\n\r\n" + framed("nonsense") +
                            framed(kShutdown) + framed(kExit)) {
        pieces.emplace_back(1, c);
    }
    const ServerRun run = run_server(pieces);
    CHECK(run.status == 0);
    REQUIRE(run.messages.size() == 4);
    CHECK(run.messages[1].at("error").at("code") == -32700);
    CHECK(run.messages[2].at("error").at("code") == -32700);
    CHECK(run.messages[2].at("id").is_null());
}

TEST_CASE("a signal ends the program while it waits for input") {
    const StartedServer server = start_server();
    const std::string bytes = framed(kInitialize);
    CHECK(::write(server.input, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    char first = 0;
    CHECK(::read(server.output, &first, 1) == 1); // it serves
    CHECK(::kill(server.process, SIGTERM) == 0);
    int status = 0;
    CHECK(::waitpid(server.process, &status, 0) == server.process); // its input is still open
    CHECK(!(WIFEXITED(status) && WEXITSTATUS(status) == 0));
    for (const int each : {server.input, server.output}) {
        ::close(each);
    }
}

TEST_CASE("source.fixAll makes the text of lsc check --fix") {
    const ScratchFolder folder;
    const std::string path = folder / "tree.lsys";
    const std::string text = "#n = 1\n#w : A;\n#p : A : * : F(1);\n";
    lsys::tests::write_text(path, text);
    const Json open{
        {"jsonrpc", "2.0"},
        {"method", "textDocument/didOpen"},
        {"params",
         {{"textDocument",
           {{"uri", "file://" + path}, {"languageId", "lsys"}, {"version", 1}, {"text", text}}}}}};
    const Json range{{"start", {{"line", 0}, {"character", 0}}},
                     {"end", {{"line", 0}, {"character", 0}}}};
    const Json fix{
        {"jsonrpc", "2.0"},
        {"id", 5},
        {"method", "textDocument/codeAction"},
        {"params",
         {{"textDocument", {{"uri", "file://" + path}}},
          {"range", range},
          {"context",
           {{"diagnostics", Json::array()}, {"only", Json::array({"source.fixAll"})}}}}}};
    const lsys::tests::LscRun run =
        run_lsc({"lsp"}, framed(kInitialize) + framed(open.dump()) + framed(fix.dump()) +
                             framed(kShutdown) + framed(kExit));
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    Json actions;
    for (const Json& message : messages_of(run.out)) {
        if (message.value("id", Json()) == 5) {
            actions = message.at("result");
        }
    }
    REQUIRE(actions.size() == 1);
    CHECK(actions[0].at("kind") == "source.fixAll");
    const Json& edits = actions[0].at("edit").at("changes").at("file://" + path);
    REQUIRE(edits.size() == 1);
    const auto offset = [&](const Json& place) {
        std::size_t at = 0;
        for (int line = place.at("line").get<int>(); line > 0; --line) {
            at = text.find('\n', at) + 1;
        }
        return at + place.at("character").get<std::size_t>();
    };
    const std::size_t begin = offset(edits[0].at("range").at("start"));
    const std::size_t end = offset(edits[0].at("range").at("end"));
    const std::string changed =
        text.substr(0, begin) + edits[0].at("newText").get<std::string>() + text.substr(end);
    REQUIRE(run_lsc({"check", "--fix", path}, "").status == 0);
    CHECK(changed == lsys::tests::read_text(path));
    CHECK(changed != text);
}
