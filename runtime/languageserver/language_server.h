// SPDX-License-Identifier: MIT
// LanguageServer: `lsc lsp` without its streams. Takes messages of the editor as JSON texts (LSP
// 3.17) and returns the server's messages as JSON texts. Checks grammars by the pipeline. Derives
// them only for `lsys/plant`, on a thread of its own.
#pragma once

#include "runtime/languageserver/message_reader.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A document with the options under which it is checked.
struct CheckedText {
    const std::string& path;
    const GrammarText& text;
    const GrammarOptions& options;
};

/// The `file:` URI of a path.
[[nodiscard]] std::string uri_of_path(std::string_view path);

/// Services of the program that runs the server.
struct LanguageServerHost {
    Project project; // reads files that are not open in the editor
    std::string version;
    /// The .lsys files in a folder and below it, in a fixed order; at most a few thousand.
    std::function<std::vector<std::string>(const std::string& folder)> grammars_below;
    /// The explanation of a code as Markdown; empty if there is none.
    std::function<std::string(std::string_view code)> explain;
    /// The URI of a page about a code; empty if there is none.
    std::function<std::string(std::string_view code)> explanation_uri;
    /// Turns fixes of `compiled` that are not certain into offers, as `lsc check --fix` does.
    std::function<void(const CheckedText&, const Project&, CompiledText& compiled)> offer_doubtful;
    /// The new bytes of each file that `lsc check --fix` changes, by path.
    std::function<std::map<std::string, std::string>(const CheckedText&, const Project&)> fix;
    /// Max size of a grammar that is checked. Editors send documents of any size.
    std::uint64_t max_document_bytes = std::uint64_t{16} << 20U;
    /// Max seconds to check a document, and to answer a request.
    double max_seconds = 20.0;
};

class LanguageServer {
public:
    explicit LanguageServer(LanguageServerHost host);
    LanguageServer(const LanguageServer&) = delete;
    LanguageServer& operator=(const LanguageServer&) = delete;
    ~LanguageServer();

    /// Handles messages that arrived together: a request that a later message of `messages` cancels
    /// is not run, and diagnostics are computed once, after the last change. Returns the bodies of
    /// the responses and notifications to send, in order.
    [[nodiscard]] std::vector<std::string> receive(const std::vector<ReadMessage>& messages);
    /// From now on, sends each response of `lsys/plant` with `deliver`, on another thread, as soon
    /// as the response is made. With an empty `deliver`, cancels the requests that are not answered
    /// yet; from then on receive() waits for responses of `lsys/plant` and returns them, as it does
    /// before the first call of deliver_late().
    void deliver_late(std::function<void(const std::string& body)> deliver);
    /// Whether `exit` was received; messages after it are ignored.
    [[nodiscard]] bool has_exited() const;
    /// The exit status of the process: 0 after `shutdown`, otherwise 1.
    [[nodiscard]] int exit_status() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
