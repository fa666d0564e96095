// SPDX-License-Identifier: MIT
// Editor: a client of the language server in the same process, with files in memory.
#pragma once

#include "runtime/languageserver/language_server.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace lsys::tests {

using Json = nlohmann::json;

class Editor {
public:
    explicit Editor(Json capabilities) : Editor(std::move(capabilities), {}) {}
    /// `files`: the texts of files on disk, by absolute path. The editor has opened the folder
    /// `/p`.
    /// `change_host`: changes the host before the server is made; may be null.
    Editor(Json capabilities,
           std::map<std::string, std::string> files,
           void (*change_host)(LanguageServerHost& host) = nullptr)
        : files_(std::make_shared<std::map<std::string, std::string>>(std::move(files))) {
        LanguageServerHost host;
        host.version = "1";
        host.project.host.read_referenced_file = [texts = files_](const std::string& path,
                                                                  const ReadLimit& /*limit*/) {
            const auto found = texts->find(path);
            return found != texts->end() ? Result<std::string>(found->second)
                                         : Result<std::string>(Error{"no such file"});
        };
        host.project.host.read_file = host.project.host.read_referenced_file;
        host.project.host.file_exists = [texts = files_](const std::string& path) {
            return texts->contains(path);
        };
        host.project.environments = {{"started", "echo"}};
        host.project.host.start_program =
            [](const std::string& /*command*/, double /*seconds*/,
               const std::atomic<bool>* /*cancelled*/) -> Result<std::unique_ptr<LineProgram>> {
            throw std::logic_error("the language server has started a program");
        };
        host.grammars_below = [texts = files_](const std::string& folder) {
            std::vector<std::string> paths;
            for (const auto& [path, text] : *texts) {
                if (path.starts_with(folder) && path.ends_with(".lsys")) {
                    paths.push_back(path);
                }
            }
            return paths;
        };
        host.explain = [](std::string_view code) { return "text of " + std::string(code); };
        host.explanation_uri = [](std::string_view code) { return "doc:" + std::string(code); };
        if (change_host != nullptr) {
            change_host(host);
        }
        server_ = std::make_unique<LanguageServer>(std::move(host));
        answer =
            request("initialize",
                    {{"processId", nullptr},
                     {"rootUri", nullptr},
                     {"workspaceFolders", Json::array({Json{{"uri", "file:///p"}, {"name", "p"}}})},
                     {"capabilities", std::move(capabilities)}});
        notify("initialized", Json::object());
    }

    /// Sends a request and returns its result. If the response is an error, throws the error object
    /// as text.
    Json request(const std::string& method, Json params) {
        const Json response = raw_request(method, std::move(params));
        if (response.contains("error")) {
            throw std::runtime_error(response.at("error").dump());
        }
        return response.at("result");
    }
    /// Sends a request and returns its whole response.
    Json raw_request(const std::string& method, Json params) {
        const int id = ++id_;
        send({{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}});
        return responses.at(id);
    }
    /// Sends a request that must fail; returns the code of its error.
    int error_code(const std::string& method, Json params) {
        return raw_request(method, std::move(params)).at("error").at("code").get<int>();
    }
    std::string error_text(const std::string& method, Json params) {
        return raw_request(method, std::move(params)).at("error").at("message").get<std::string>();
    }
    void notify(const std::string& method, Json params) {
        send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
    }
    void send(const Json& message) { send_all({message}); }
    /// Sends several messages that arrive at the server at the same time.
    void send_all(const std::vector<Json>& messages) {
        std::vector<ReadMessage> bodies;
        for (const Json& message : messages) {
            bodies.push_back({message.dump(-1, ' ', false, Json::error_handler_t::replace), {}});
        }
        take(bodies);
    }
    /// Passes messages to the server and stores what it answers, by kind.
    void take(const std::vector<ReadMessage>& bodies) {
        for (const std::string& body : server_->receive(bodies)) {
            const Json message = Json::parse(body);
            if (message.contains("id") && message.at("id").is_number_integer()) {
                responses[message.at("id").get<int>()] = message;
            } else if (message.value("method", "") == "textDocument/publishDiagnostics") {
                diagnostics[message.at("params").at("uri").get<std::string>()] =
                    message.at("params").at("diagnostics");
                ++publish_count;
            } else {
                others.push_back(message);
            }
        }
    }

    void open(const std::string& path, const std::string& text) {
        notify("textDocument/didOpen",
               {{"textDocument",
                 {{"uri", uri(path)}, {"languageId", "lsys"}, {"version", 1}, {"text", text}}}});
    }
    /// Replaces the whole text of a file.
    void change(const std::string& path, const std::string& text) {
        notify("textDocument/didChange",
               {{"textDocument", {{"uri", uri(path)}, {"version", ++version_}}},
                {"contentChanges", Json::array({Json{{"text", text}}})}});
    }
    static std::string uri(const std::string& path) { return "file://" + path; }
    static Json position(int line, int character) {
        return {{"line", line}, {"character", character}};
    }
    static Json range(int line, int from, int to) {
        return {{"start", position(line, from)}, {"end", position(line, to)}};
    }
    /// Parameters of a request at a position.
    static Json at(const std::string& path, int line, int character) {
        return {{"textDocument", {{"uri", uri(path)}}}, {"position", position(line, character)}};
    }
    /// Parameters of a request about a whole file.
    static Json in(const std::string& path) { return {{"textDocument", {{"uri", uri(path)}}}}; }

    /// The text after the edits of a WorkspaceEdit or of a list of TextEdits. Precondition: edited
    /// lines are ASCII, and no edit spans several lines.
    static std::string applied(std::string text, const Json& edits) {
        std::vector<Json> last_first(edits.begin(), edits.end());
        const auto offset = [&](const Json& place) {
            std::size_t at = 0;
            for (auto line = place.at("line").get<int>(); line > 0; --line) {
                at = text.find('\n', at) + 1;
            }
            return at + place.at("character").get<std::size_t>();
        };
        std::sort(last_first.begin(), last_first.end(), [&](const Json& a, const Json& b) {
            return offset(a.at("range").at("start")) > offset(b.at("range").at("start"));
        });
        for (const Json& edit : last_first) {
            const std::size_t begin = offset(edit.at("range").at("start"));
            const std::size_t end = offset(edit.at("range").at("end"));
            text.replace(begin, end - begin, edit.at("newText").get<std::string>());
        }
        return text;
    }

    std::map<std::string, std::string>& files() { return *files_; }
    LanguageServer& server() { return *server_; }

    Json answer;                             // result of `initialize`
    std::map<int, Json> responses;           // by id of the request
    std::map<std::string, Json> diagnostics; // as last published, by URI
    int publish_count = 0;
    std::vector<Json> others; // all further messages of the server, in order

private:
    std::shared_ptr<std::map<std::string, std::string>> files_;
    std::unique_ptr<LanguageServer> server_;
    int id_ = 0;
    int version_ = 1;
};

/// The codes of diagnostics, in order.
inline std::vector<std::string> codes(const Json& diagnostics) {
    std::vector<std::string> all;
    for (const Json& diagnostic : diagnostics) {
        all.push_back(diagnostic.at("code").get<std::string>());
    }
    return all;
}

} // namespace lsys::tests
