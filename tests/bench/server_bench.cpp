// SPDX-License-Identifier: MIT
// Measures latencies of the language server, `lsc lsp`, as an editor sees them: the time from the
// first byte of a message to the last byte of the answer, through pipes. Prints a table of medians,
// and the limit for the time from a key press to the diagnostics. Asserts nothing about time.
// Usage: server_bench [RUNS]
#include "tests/bench/measure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace {

using Json = nlohmann::json;

constexpr const char* kUri = "file:///bench/bench.lsys";

/// A grammar of at least `lines` lines and `bytes` bytes without mistakes.
std::string make_grammar(std::size_t lines, std::size_t bytes) {
    std::string text = "#n = 8;\n#set turtle abop;\n#define ratio 0.9;\n#w : A0(1);\n";
    std::size_t count = 4;
    for (int i = 0; count < lines || text.size() < bytes; ++i, count += 4) {
        text += fmt::format(
            "#define k{0} {1}.25 + ratio/2;\n"
            "#p{0}a : A{0}(x) : x > k{0} : F(x) [+(25) A{2}(x*ratio)] [-(25) A{0}(x/2)]; // left\n"
            "#p{0}b : A{0}(x) : x <= k{0} : !(x) F(x*k{0}) [&(30) /(137.5) A{2}(x - 0.1)];\n"
            "/* row {0} */\n",
            i, i % 7, i + 1);
    }
    return text;
}

/// The server as a child process.
class Server {
public:
    Server() {
        int to[2];
        int from[2];
        if (pipe(to) != 0 || pipe(from) != 0) {
            lsys::bench::fail("no pipes");
        }
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
        for (const int each : {to[0], to[1], from[0], from[1]}) {
            posix_spawn_file_actions_addclose(&actions, each);
        }
        std::string program = LSYS_LSC;
        std::string command = "lsp";
        std::array<char*, 3> arguments{program.data(), command.data(), nullptr};
        if (posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ) !=
            0) {
            lsys::bench::fail(program + " does not start");
        }
        posix_spawn_file_actions_destroy(&actions);
        close(to[0]);
        close(from[1]);
        input_ = to[1];
        output_ = from[0];
        static_cast<void>(request("initialize", {{"capabilities", Json::object()}}));
        notify("initialized", Json::object());
    }
    ~Server() {
        static_cast<void>(request("shutdown", nullptr));
        notify("exit", nullptr);
        close(input_);
        close(output_);
        waitpid(process_, nullptr, 0);
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    void notify(const char* method, const Json& params) {
        write_all({{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
    }
    std::string request(const std::string& method, const Json& params) {
        write_all({{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", params}});
        return read_message();
    }
    /// The next message of the server.
    std::string read_message() {
        std::size_t end = 0;
        while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
            read_some();
        }
        const std::size_t length =
            std::strtoul(buffer_.c_str() + buffer_.find(':') + 1, nullptr, 10);
        while (buffer_.size() < end + 4 + length) {
            read_some();
        }
        std::string body = buffer_.substr(end + 4, length);
        buffer_.erase(0, end + 4 + length);
        return body;
    }

private:
    void write_all(const Json& message) {
        const std::string body = message.dump();
        const std::string bytes = fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = write(input_, bytes.data() + done, bytes.size() - done);
            if (count <= 0) {
                lsys::bench::fail("the server reads nothing");
            }
            done += static_cast<std::size_t>(count);
        }
    }
    void read_some() {
        std::array<char, 65536> bytes;
        const ssize_t count = read(output_, bytes.data(), bytes.size());
        if (count <= 0) {
            lsys::bench::fail("the server has ended");
        }
        buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    }

    pid_t process_ = 0;
    int input_ = -1;
    int output_ = -1;
    std::string buffer_;
};

void print_row(const std::string& name, std::vector<double>& times, const char* limit) {
    fmt::print("  {:<28} {:>9.2f} ms {}\n", name, lsys::bench::median(times) * 1000.0, limit);
}

/// Measures a text as an editor sends it: a key press in the middle of the text, then requests
/// after a key press.
void measure(const char* title, const std::string& text, const char* limit, int runs) {
    Server server;
    const Json document{{"uri", kUri}};
    server.notify("textDocument/didOpen",
                  {{"textDocument",
                    {{"uri", kUri}, {"languageId", "lsys"}, {"version", 1}, {"text", text}}}});
    static_cast<void>(server.read_message());
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    const std::size_t line = lines / 8 * 4; // number of a line that begins a `#define`
    int version = 1;
    const auto press_key = [&] {
        const bool adds = version % 2 == 1;
        server.notify(
            "textDocument/didChange",
            {{"textDocument", {{"uri", kUri}, {"version", ++version}}},
             {"contentChanges",
              Json::array({Json{{"range",
                                 {{"start", {{"line", line}, {"character", 0}}},
                                  {"end", {{"line", line}, {"character", adds ? 0 : 1}}}}},
                                {"text", adds ? " " : ""}}})}});
        static_cast<void>(server.read_message());
    };
    fmt::print("{}: {} lines, {} bytes\n", title, lines, text.size());
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) {
        times.push_back(lsys::bench::seconds(press_key));
    }
    print_row("key to diagnostics", times, limit);
    const Json position{{"line", line + 1}, {"character", 20}};
    const Json range{{"start", {{"line", line}, {"character", 0}}},
                     {"end", {{"line", line + 60}, {"character", 0}}}};
    for (const char* method : {"completion", "hover", "signatureHelp", "definition", "references",
                               "documentSymbol", "semanticTokens/full", "foldingRange",
                               "documentColor", "inlayHint", "codeLens", "formatting"}) {
        times.clear();
        for (int i = 0; i < (runs + 2) / 3; ++i) {
            press_key();
            times.push_back(lsys::bench::seconds([&] {
                static_cast<void>(server.request(std::string("textDocument/") + method,
                                                 {{"textDocument", document},
                                                  {"position", position},
                                                  {"range", range},
                                                  {"context", {{"includeDeclaration", true}}}}));
            }));
        }
        print_row(method, times, "");
    }
}

} // namespace

int main(int argc, char** argv) {
    constexpr int kRuns = 15;
    const int runs = argc > 1 ? std::atoi(argv[1]) : kRuns;
    fmt::print("Language server, median of {} keys; requests come right after a key.\n\n", runs);
    measure("A long grammar", make_grammar(1000, 0), "[limit 10]", runs);
    measure("A grammar of 1 MB", make_grammar(0, 1'000'000), "[limit 100]", runs);
    measure("A grammar that explodes",
            "#n = 4294967294;\n#w : A(0);\n#p : A(x) : x < 1000000 : A(x + 1) B(x);\n"
            "#q : B(x) : x > 3 : F(x) B(x - 1);\n"
            "#r : B(x) : x <= 3 : F(x) B(x + 0.37) A(x*1.001);\n",
            "", runs);
    return 0;
}
