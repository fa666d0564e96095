// SPDX-License-Identifier: MIT
#include "runtime/languageserver/language_server.h"

#include "grammar/base/cancellation.h"
#include "runtime/base/deadline.h"
#include "runtime/languageserver/impl/plant_preview.h"
#include "runtime/languageserver/impl/workspace.h"

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

namespace lsys {

namespace {

/// A request about documents, and the function that answers it.
struct RequestRow {
    std::string_view method;
    Json (*answer)(Workspace& workspace, const Json& params);
};

Json pull_diagnostics(Workspace& workspace, const Json& params) {
    Document& document = workspace.document(params.at("textDocument").at("uri"));
    return {{"kind", "full"}, {"items", document_diagnostics(workspace, document)}};
}

constexpr std::array kRequests{
    RequestRow{"textDocument/diagnostic", pull_diagnostics},
    RequestRow{"textDocument/codeAction", code_actions},
    RequestRow{"textDocument/formatting", format_document},
    RequestRow{"textDocument/rangeFormatting", format_range},
    RequestRow{"textDocument/onTypeFormatting", format_on_type},
    RequestRow{"textDocument/inlayHint", inlay_hints},
    RequestRow{"textDocument/codeLens", code_lenses},
    RequestRow{"textDocument/documentSymbol", document_symbols},
    RequestRow{"workspace/symbol", workspace_symbols},
    RequestRow{"textDocument/definition", go_to_definition},
    RequestRow{"textDocument/references", find_references},
    RequestRow{"textDocument/documentHighlight", highlight_name},
    RequestRow{"textDocument/prepareRename", prepare_rename},
    RequestRow{"textDocument/rename", rename_name},
    RequestRow{"textDocument/hover", hover},
    RequestRow{"textDocument/completion", complete},
    RequestRow{"textDocument/signatureHelp", signature_help},
    RequestRow{"textDocument/semanticTokens/full", semantic_tokens},
    RequestRow{"textDocument/foldingRange", folding_ranges},
    RequestRow{"textDocument/documentColor", document_colours},
    RequestRow{"textDocument/colorPresentation", colour_presentations},
};

Json error_response(const Json& id, RpcError code, const std::string& message) {
    return {{"jsonrpc", "2.0"},
            {"id", id},
            {"error", {{"code", static_cast<int>(code)}, {"message", message}}}};
}

/// The member of nested objects, or null: `member(capabilities, {"general", "positionEncodings"})`.
const Json& member(const Json& object, std::initializer_list<const char*> names) {
    static const Json null;
    const Json* found = &object;
    for (const char* name : names) {
        if (!found->is_object() || !found->contains(name)) {
            return null;
        }
        found = &found->at(name);
    }
    return *found;
}

bool is_true(const Json& value) {
    return value.is_boolean() && value.get<bool>();
}

EditorFeatures features_of(const Json& capabilities) {
    EditorFeatures features;
    features.pulls_diagnostics = member(capabilities, {"textDocument", "diagnostic"}).is_object();
    features.related_information =
        is_true(member(capabilities, {"textDocument", "publishDiagnostics", "relatedInformation"}));
    features.nested_symbols = is_true(member(
        capabilities, {"textDocument", "documentSymbol", "hierarchicalDocumentSymbolSupport"}));
    features.snippets = is_true(
        member(capabilities, {"textDocument", "completion", "completionItem", "snippetSupport"}));
    features.registers_watchers = is_true(
        member(capabilities, {"workspace", "didChangeWatchedFiles", "dynamicRegistration"}));
    for (const Json& encoding : member(capabilities, {"general", "positionEncodings"})) {
        if (encoding == "utf-8") { // offsets of the server are bytes
            features.encoding = PositionEncoding::Utf8;
        }
    }
    return features;
}

Json server_capabilities(const EditorFeatures& editor) {
    return {
        {"positionEncoding", editor.encoding == PositionEncoding::Utf8 ? "utf-8" : "utf-16"},
        {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
        {"diagnosticProvider",
         {{"identifier", "lsc"}, {"interFileDependencies", true}, {"workspaceDiagnostics", false}}},
        {"codeActionProvider", {{"codeActionKinds", Json::array({"quickfix", "source.fixAll"})}}},
        {"documentFormattingProvider", true},
        {"documentRangeFormattingProvider", true},
        {"documentOnTypeFormattingProvider", {{"firstTriggerCharacter", ";"}}},
        {"inlayHintProvider", true},
        {"codeLensProvider", Json::object()},
        {"documentSymbolProvider", true},
        {"workspaceSymbolProvider", true},
        {"definitionProvider", true},
        {"referencesProvider", true},
        {"documentHighlightProvider", true},
        {"renameProvider", {{"prepareProvider", true}}},
        {"hoverProvider", true},
        {"semanticTokensProvider", {{"legend", token_legend()}, {"full", true}}},
        {"foldingRangeProvider", true},
        {"colorProvider", true},
        {"completionProvider", {{"triggerCharacters", Json::array({"#", " ", "(", ":"})}}},
        {"signatureHelpProvider", {{"triggerCharacters", Json::array({"(", ","})}}},
        {"experimental", {{"lsysPlant", true}}},
        {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}},
    };
}

/// The request that is answered on another thread.
constexpr std::string_view kPlantRequest = "lsys/plant";

/// A host whose functions may be called from two threads at once.
Host shared_host(Host host) {
    const auto mutex = std::make_shared<std::mutex>();
    const auto guarded = [&mutex](auto read) {
        return [mutex, read](const std::string& path, const ReadLimit& limit) {
            const std::lock_guard lock(*mutex);
            return read(path, limit);
        };
    };
    host.read_file = guarded(host.read_file);
    host.read_referenced_file = guarded(host.read_referenced_file);
    host.file_exists = [mutex, exists = host.file_exists](const std::string& path) {
        const std::lock_guard lock(*mutex);
        return exists(path);
    };
    return host;
}

LanguageServerHost with_shared_files(LanguageServerHost host) {
    Host& files = host.project.host;
    files = shared_host(std::move(files));
    // Opening a grammar, which may come from a stranger, must not start a program.
    host.project.environments.clear();
    files.environments.clear();
    files.start_program = nullptr;
    files.environment_help = [](const std::string& name) {
        return "previews start no programs: derive with `lsc dump --environment " + name +
               "=COMMAND`";
    };
    return host;
}

bool is_id(const Json& id) {
    return id.is_number_integer() || id.is_string();
}

} // namespace

struct LanguageServer::State {
    /// Precondition: the functions of `host` come from shared_host().
    explicit State(const LanguageServerHost& host)
        : workspace(host),
          preview(host.project, "lsc " + host.version, [this](const Json& response) {
              send_late(response);
          }) {}

    enum class Phase { Created, Running, ShutDown, Exited };

    Workspace workspace;
    Phase phase = Phase::Created;
    bool was_shut_down = false;      // `shutdown` was received
    std::vector<std::string> output; // messages that receive() will return
    std::mutex late_mutex;           // guards the two members below
    /// The function of deliver_late(); empty: none.
    std::function<void(const std::string&)> deliver;
    std::vector<std::string> late_output; // texts not delivered yet
    PlantPreview preview;                 // last member: its thread uses all members above

    /// Replaces invalid UTF-8, which paths and texts of an author may contain.
    [[nodiscard]] static std::string text_of(const Json& message) {
        return message.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    void send(const Json& message) { output.push_back(text_of(message)); }
    /// Sends a message from another thread.
    void send_late(const Json& message) {
        const std::string text = text_of(message);
        const std::lock_guard lock(late_mutex);
        if (deliver) {
            deliver(text);
        } else {
            late_output.push_back(text);
        }
    }

    void receive(const Json& message, const std::set<std::string>& cancelled);
    [[nodiscard]] Json answer(const std::string& method, const Json& params);
    /// Throws RequestError unless the server answers requests on documents.
    void require_running() const;
    void notify(const std::string& method, const Json& params);
    [[nodiscard]] Json initialize(const Json& params);
    void open(const Json& params);
    void change(const Json& params);
    void close(const Json& params);
    void change_folders(const Json& params);
    /// Asks the editor to report changes of files that are not open.
    void register_watchers();
    /// Marks the documents that read the file `path` as dirty; if `path` is empty, marks all
    /// documents.
    void mark(const std::string& path);
    void publish();
};

void LanguageServer::State::mark(const std::string& path) {
    for (auto& [open, document] : workspace.documents) {
        if (path.empty() || open == path || document.inputs.contains(path)) {
            document.is_dirty = true;
            document.is_published = false;
            document.checked.reset();
        }
    }
}

void LanguageServer::State::publish() {
    if (phase != Phase::Running || workspace.editor.pulls_diagnostics) {
        return;
    }
    for (auto& [path, document] : workspace.documents) {
        if (!document.is_published) {
            document.is_published = true;
            Json all = document_diagnostics(workspace, document);
            send({{"jsonrpc", "2.0"},
                  {"method", "textDocument/publishDiagnostics"},
                  {"params",
                   {{"uri", document.uri},
                    {"version", document.version},
                    {"diagnostics", std::move(all)}}}});
        }
    }
}

Json LanguageServer::State::initialize(const Json& params) {
    workspace.editor = features_of(member(params, {"capabilities"}));
    const Json& folders = member(params, {"workspaceFolders"});
    if (folders.is_array()) {
        for (const Json& folder : folders) {
            workspace.folders.push_back(path_of_uri(folder.at("uri").get<std::string>()));
        }
    } else if (const Json& root = member(params, {"rootUri"}); root.is_string()) {
        workspace.folders.push_back(path_of_uri(root.get<std::string>()));
    }
    phase = Phase::Running;
    return {{"capabilities", server_capabilities(workspace.editor)},
            {"serverInfo", {{"name", "lsc"}, {"version", workspace.host.version}}}};
}

void LanguageServer::State::open(const Json& params) {
    const Json& item = params.at("textDocument");
    Document document;
    document.uri = item.at("uri").get<std::string>();
    document.path = path_of_uri(document.uri);
    document.text = item.at("text").get<std::string>();
    document.version = item.value("version", std::int64_t{0});
    document.is_lsys = item.value("languageId", std::string()) == "lsys";
    workspace.documents.insert_or_assign(document.path, std::move(document));
    mark({}); // other documents may include this file, which may have been missing
}

void LanguageServer::State::change(const Json& params) {
    Document& document = workspace.document(params.at("textDocument").at("uri"));
    std::string text = document.text; // a copy: a malformed change leaves the document unchanged
    for (const Json& change : params.at("contentChanges")) {
        const auto replacement = change.at("text").get<std::string>();
        if (!change.contains("range")) {
            text = replacement;
            continue;
        }
        const TextPositions positions(text, workspace.editor.encoding);
        const std::size_t begin = positions.offset(position_of(change.at("range").at("start")));
        const std::size_t end =
            std::max(begin, positions.offset(position_of(change.at("range").at("end"))));
        text.replace(begin, end - begin, replacement);
    }
    // If this document includes other files than before, these files are checked differently.
    const bool includes_same =
        included_files(document.path, document.text) == included_files(document.path, text);
    document.version = params.at("textDocument").value("version", document.version + 1);
    document.text = std::move(text);
    mark(includes_same ? document.path : std::string());
}

void LanguageServer::State::close(const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    const std::string path = document.path;
    const std::string uri = document.uri;
    workspace.documents.erase(path);
    mark({});
    if (!workspace.editor.pulls_diagnostics) {
        send({{"jsonrpc", "2.0"},
              {"method", "textDocument/publishDiagnostics"},
              {"params", {{"uri", uri}, {"diagnostics", Json::array()}}}});
    }
}

void LanguageServer::State::change_folders(const Json& params) {
    const Json& event = params.at("event");
    for (const Json& folder : event.at("removed")) {
        std::erase(workspace.folders, path_of_uri(folder.at("uri").get<std::string>()));
    }
    for (const Json& folder : event.at("added")) {
        workspace.folders.push_back(path_of_uri(folder.at("uri").get<std::string>()));
    }
}

void LanguageServer::State::register_watchers() {
    if (workspace.editor.registers_watchers) {
        send({{"jsonrpc", "2.0"},
              {"id", "watch"},
              {"method", "client/registerCapability"},
              {"params",
               {{"registrations",
                 Json::array(
                     {{{"id", "watch"},
                       {"method", "workspace/didChangeWatchedFiles"},
                       {"registerOptions",
                        {{"watchers", Json::array({{{"globPattern", "**/*.lsys"}}})}}}}})}}}});
    }
}

Json LanguageServer::State::answer(const std::string& method, const Json& params) {
    if (method == "initialize") {
        if (phase != Phase::Created) {
            throw RequestError(RpcError::InvalidRequest, "the server is initialized already");
        }
        return initialize(params);
    }
    require_running();
    if (method == "shutdown") {
        preview.cancel_all();
        phase = Phase::ShutDown;
        was_shut_down = true;
        return nullptr;
    }
    const auto found = std::find_if(kRequests.begin(), kRequests.end(),
                                    [&](const RequestRow& row) { return row.method == method; });
    if (found == kRequests.end()) {
        throw RequestError(RpcError::MethodNotFound, "there is no method `" + method + "`");
    }
    return found->answer(workspace, params);
}

void LanguageServer::State::require_running() const {
    if (phase == Phase::Created) {
        throw RequestError(RpcError::ServerNotInitialized, "the server is not initialized");
    }
    if (phase == Phase::ShutDown) {
        throw RequestError(RpcError::InvalidRequest, "the server is shut down");
    }
}

void LanguageServer::State::notify(const std::string& method, const Json& params) {
    if (method == "exit") {
        phase = Phase::Exited;
    }
    if (phase != Phase::Running) {
        return;
    }
    if (method == "initialized") {
        register_watchers();
    } else if (method == "textDocument/didOpen") {
        open(params);
    } else if (method == "textDocument/didChange") {
        change(params);
    } else if (method == "textDocument/didClose") {
        close(params);
    } else if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles") {
        mark({});
    } else if (method == "workspace/didChangeWorkspaceFolders") {
        change_folders(params);
    } else if (method == "$/cancelRequest") {
        preview.cancel(params.at("id"));
    } // other notifications, also unknown ones, have no effect
}

void LanguageServer::State::receive(const Json& message, const std::set<std::string>& cancelled) {
    if (phase == Phase::Exited) {
        return;
    }
    const Json id = message.is_object() && message.contains("id") ? message.at("id") : Json();
    const Json& method = member(message, {"method"});
    if (!method.is_string()) {
        const bool is_response = !member(message, {"id"}).is_null() &&
                                 (message.contains("result") || message.contains("error"));
        if (!is_response) {
            send(error_response(is_id(id) ? id : Json(), RpcError::InvalidRequest,
                                "the message has no method"));
        }
        return;
    }
    const bool is_request = message.contains("id");
    const auto fail = [&](RpcError code, const std::string& reason) {
        if (is_request) {
            send(error_response(is_id(id) ? id : Json(), code, reason));
        }
    };
    if (is_request && !is_id(id)) {
        fail(RpcError::InvalidRequest, "the id is neither a number nor a text");
        return;
    }
    if (is_request && cancelled.contains(id.dump())) {
        fail(RpcError::RequestCancelled, "the request was cancelled");
        return;
    }
    const LanguageServerHost& host = workspace.host;
    // A notification has no time limit: half a change would leave another text than the editor's.
    std::optional<Deadline> deadline;
    if (is_request) {
        deadline.emplace(host.max_seconds, host.project.host.cancelled, std::function<void()>());
    }
    const CancellationScope scope(deadline ? deadline->stop() : host.project.host.cancelled);
    try {
        if (is_request && method == kPlantRequest) {
            require_running();
            preview.start(id, member(message, {"params"}), workspace);
        } else if (is_request) {
            Json result = answer(method.get<std::string>(), member(message, {"params"}));
            send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
        } else {
            notify(method.get<std::string>(), member(message, {"params"}));
        }
    } catch (const RequestError& error) {
        fail(error.code, error.what());
    } catch (const CompilationCancelled&) {
        if (!deadline || !deadline->has_passed()) {
            throw; // the program ends
        }
        fail(RpcError::RequestFailed, too_slow_message(host.max_seconds));
    } catch (const Json::exception&) {
        fail(RpcError::InvalidParams, "the parameters of `" + method.get<std::string>() +
                                          "` are not as in the specification");
    }
}

namespace {

/// Parses a message; discarded if it is not JSON or nested too deep. Each level of nesting takes
/// much more memory than its character.
Json parse_message(const std::string& body) {
    constexpr int kMaxNesting = 1000;
    bool is_too_deep = false;
    const auto keep = [&is_too_deep](int depth, Json::parse_event_t, Json&) {
        is_too_deep = is_too_deep || depth > kMaxNesting;
        return !is_too_deep;
    };
    Json message = Json::parse(body, keep, false);
    return is_too_deep ? Json(Json::value_t::discarded) : message;
}

} // namespace

LanguageServer::LanguageServer(LanguageServerHost host)
    : state_(std::make_unique<State>(with_shared_files(std::move(host)))) {}

LanguageServer::~LanguageServer() = default;

std::vector<std::string> LanguageServer::receive(const std::vector<ReadMessage>& messages) {
    std::vector<Json> parsed;
    std::set<std::string> cancelled; // ids as JSON
    for (const ReadMessage& message : messages) {
        parsed.push_back(message.error.empty() ? parse_message(message.body)
                                               : Json(Json::value_t::discarded));
        if (!parsed.back().is_discarded() &&
            member(parsed.back(), {"method"}) == "$/cancelRequest") {
            cancelled.insert(member(parsed.back(), {"params", "id"})
                                 .dump(-1, ' ', false, Json::error_handler_t::replace));
        }
    }
    for (std::size_t i = 0; i < parsed.size(); ++i) {
        if (parsed[i].is_discarded()) {
            state_->send(error_response(nullptr, RpcError::ParseError,
                                        messages[i].error.empty() ? "the message is not JSON"
                                                                  : messages[i].error));
        } else {
            state_->receive(parsed[i], cancelled);
        }
    }
    state_->publish();
    bool waits = false;
    {
        const std::lock_guard lock(state_->late_mutex);
        waits = !state_->deliver;
    }
    if (waits) {
        state_->preview.wait();
        const std::lock_guard lock(state_->late_mutex);
        for (std::string& late : std::exchange(state_->late_output, {})) {
            state_->output.push_back(std::move(late));
        }
    }
    return std::exchange(state_->output, {});
}

void LanguageServer::deliver_late(std::function<void(const std::string& body)> deliver) {
    if (!deliver) {
        state_->preview.cancel_all();
        state_->preview.wait();
    }
    const std::lock_guard lock(state_->late_mutex);
    state_->deliver = std::move(deliver);
}

bool LanguageServer::has_exited() const {
    return state_->phase == State::Phase::Exited;
}

int LanguageServer::exit_status() const {
    return has_exited() && state_->was_shut_down ? 0 : 1;
}

} // namespace lsys
