// SPDX-License-Identifier: MIT
// Sends a sequence of messages to the language server. Each line of the input is a message: with
// `{` or `[` first, JSON as it is; otherwise a number of a method, the number of a file, two
// numbers of a position, and a text, which the message contains. At the end every grammar that is
// open must have the diagnostics that a new server gives it.
#include "runtime/languageserver/language_server.h"
#include "tests/fuzz/input_bytes.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Json = nlohmann::json;

constexpr std::array kFiles{"file:///p/a.lsys", "file:///p/b.lsys", "file:///p/c.l"};
constexpr std::array kLanguages{"lsys", "lsys", "cpfg"};
constexpr std::array kRequests{
    "textDocument/codeAction",
    "textDocument/codeLens",
    "textDocument/colorPresentation",
    "textDocument/completion",
    "textDocument/definition",
    "textDocument/diagnostic",
    "textDocument/documentColor",
    "textDocument/documentHighlight",
    "textDocument/documentSymbol",
    "textDocument/foldingRange",
    "textDocument/formatting",
    "textDocument/hover",
    "textDocument/inlayHint",
    "textDocument/onTypeFormatting",
    "textDocument/prepareRename",
    "textDocument/rangeFormatting",
    "textDocument/references",
    "textDocument/rename",
    "textDocument/semanticTokens/full",
    "textDocument/signatureHelp",
    "workspace/symbol",
    "lsys/plant",
};

lsys::LanguageServerHost make_host() {
    lsys::LanguageServerHost host;
    host.version = "1";
    host.project.host.read_referenced_file = [](const std::string&, const lsys::ReadLimit&) {
        return lsys::Result<std::string>(lsys::Error{"no such file"});
    };
    host.project.host.read_file = host.project.host.read_referenced_file;
    host.project.host.file_exists = [](const std::string&) { return false; };
    host.project.threads = 1;
    host.project.limits = {10'000, 16U << 20U};
    host.grammars_below = [](const std::string&) { return std::vector<std::string>(); };
    host.explain = [](std::string_view code) { return std::string(code); };
    host.explanation_uri = [](std::string_view) { return std::string(); };
    return host;
}

/// A server and the number of its next request.
class Session {
public:
    Session() : server_(make_host()) {
        request(
            "initialize",
            {{"processId", nullptr}, {"rootUri", "file:///p"}, {"capabilities", Json::object()}});
        send(Json{{"jsonrpc", "2.0"}, {"method", "initialized"}, {"params", Json::object()}});
    }

    void request(const std::string& method, Json params) {
        send(Json{
            {"jsonrpc", "2.0"}, {"id", ++id_}, {"method", method}, {"params", std::move(params)}});
    }
    void notify(const std::string& method, Json params) {
        send(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
    }
    void send(const Json& message) {
        send_text(message.dump(-1, ' ', false, Json::error_handler_t::replace));
    }
    void send_text(std::string body) {
        for (const std::string& answer : server_.receive({{std::move(body), ""}})) {
            const Json message = Json::parse(answer); // throws for an answer that is no JSON
            if (message.value("method", "") == "textDocument/publishDiagnostics") {
                const Json& params = message.at("params");
                diagnostics[params.at("uri").get<std::string>()] = params.at("diagnostics");
            }
        }
    }

    std::map<std::string, Json> diagnostics;

private:
    lsys::LanguageServer server_;
    int id_ = 0;
};

/// The texts that are open, by file.
using Texts = std::map<std::size_t, std::string>;

std::string valid_text(std::string_view bytes) {
    // JSON replaces bytes that are no UTF-8. `\n` in the input stands for a line end.
    const std::string dumped = Json(bytes).dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string text = Json::parse(dumped).get<std::string>();
    for (std::size_t at = text.find("\\n"); at != std::string::npos; at = text.find("\\n", at)) {
        text.replace(at, 2, "\n");
    }
    return text;
}

void open(Session& session, std::size_t file, const std::string& text) {
    session.notify("textDocument/didOpen", {{"textDocument",
                                             {{"uri", kFiles[file]},
                                              {"languageId", kLanguages[file]},
                                              {"version", 1},
                                              {"text", text}}}});
}

void send_line(std::string_view line, Session& session, Texts& texts) {
    InputBytes bytes(reinterpret_cast<const std::uint8_t*>(line.data()), line.size());
    const std::size_t method = bytes.below(kRequests.size() + 3);
    const std::size_t file = bytes.below(kFiles.size());
    const Json position{{"line", bytes.number<std::uint8_t>()},
                        {"character", bytes.number<std::uint8_t>()}};
    const Json document{{"uri", kFiles[file]}};
    const std::string text = valid_text(bytes.rest());
    if (method < kRequests.size()) {
        session.request(
            kRequests[method],
            {{"textDocument", document},
             {"position", position},
             {"color", {{"red", 0.5}, {"green", 0.25}, {"blue", 1}, {"alpha", 1}}},
             {"ch", ";"},
             {"range", {{"start", position}, {"end", position}}},
             {"context", {{"includeDeclaration", true}, {"diagnostics", Json::array()}}},
             {"options", {{"tabSize", 4}, {"insertSpaces", true}}},
             {"newName", text},
             {"query", text}});
    } else if (!texts.contains(file)) {
        open(session, file, text);
        texts[file] = text;
    } else if (method == kRequests.size()) {
        session.notify("textDocument/didClose", {{"textDocument", document}});
        texts.erase(file);
    } else {
        session.notify("textDocument/didChange",
                       {{"textDocument", {{"uri", kFiles[file]}, {"version", 2}}},
                        {"contentChanges", Json::array({Json{{"text", text}}})}});
        texts[file] = text;
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr int kMaxMessages = 24;
    InputBytes input(data, size);
    Session session;
    Texts texts;
    bool is_changed_by_json = false;
    for (int i = 0; i < kMaxMessages && !input.empty(); ++i) {
        const std::string_view line = input.line();
        if (line.starts_with('{') || line.starts_with('[')) {
            is_changed_by_json = true; // `texts` may differ from what the server has
            session.send_text(std::string(line));
        } else {
            send_line(line, session, texts);
        }
    }
    if (is_changed_by_json) {
        return 0;
    }
    Session fresh;
    for (const auto& [file, text] : texts) {
        open(fresh, file, text);
    }
    for (const auto& [file, text] : texts) {
        if (session.diagnostics[kFiles[file]] != fresh.diagnostics[kFiles[file]]) {
            std::abort();
        }
    }
    return 0;
}
