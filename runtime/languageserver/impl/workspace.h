// SPDX-License-Identifier: MIT
// Workspace: the open documents, the folders of the editor, and the answers to requests about them.
// Texts of open documents replace the files on disk everywhere.
#pragma once

#include "runtime/languageserver/language_server.h"
#include "runtime/languageserver/text_positions.h"
#include "runtime/names/name_index.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

using Json = nlohmann::json;

/// Error codes of JSON-RPC and LSP.
enum class RpcError : int {
    ParseError = -32700,
    InvalidRequest = -32600,
    MethodNotFound = -32601,
    InvalidParams = -32602,
    ServerNotInitialized = -32002,
    RequestCancelled = -32800,
    ServerCancelled = -32802,
    RequestFailed = -32803,
};

/// Ends a request with an error response. LanguageServer catches it.
struct RequestError : std::runtime_error {
    RequestError(RpcError own_code, const std::string& message)
        : std::runtime_error(message), code(own_code) {}
    RpcError code;
};

struct CheckedDocument;

struct Document {
    std::string uri; // URI as the editor writes it
    std::string path;
    std::string text; // text with a byte order mark, if the editor sends one
    std::int64_t version = 0;
    bool is_lsys = false;         // the editor calls the language `lsys`
    bool is_dirty = true;         // the diagnostics are out of date
    bool is_published = false;    // sent, or the editor requests diagnostics itself
    std::set<std::string> inputs; // files read by the last check
    Json diagnostics = Json::array();
    std::shared_ptr<const CheckedDocument> checked; // null: not checked since the last change

    /// Whether the text is .lsys, not a grammar of another program.
    [[nodiscard]] bool has_lsys_text() const { return is_lsys || path.ends_with(".lsys"); }
};

/// Features of the editor.
struct EditorFeatures {
    bool pulls_diagnostics = false;   // requests diagnostics itself
    bool related_information = false; // shows further places of a diagnostic
    bool nested_symbols = false;      // accepts document symbols as a tree
    bool snippets = false;            // accepts completions with placeholders
    bool registers_watchers = false;  // reports changes of files if it is asked to
    PositionEncoding encoding = PositionEncoding::Utf16;
};

/// The message about a document or a request that takes longer than `seconds`.
[[nodiscard]] std::string too_slow_message(double seconds);

/// The result of checking a document, and the file that was checked.
struct CheckedDocument {
    std::string path; // path of the checked file
    GrammarText text;
    CompiledText compiled;
    std::string failure; // why the document could not be checked; empty if it was
};

/// A parsed grammar with its names.
struct IndexedGrammar {
    /// Texts that were read, by path; nullopt: reading failed.
    std::map<std::string, std::optional<std::string>> texts;
    bool is_lsys = true; // parsed as .lsys
    ParsedGrammar parsed;
    NameIndex index;
};

class Workspace {
public:
    explicit Workspace(LanguageServerHost own_host);
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    LanguageServerHost host; // `project` reads open documents first
    EditorFeatures editor;
    std::vector<std::string> folders;
    std::map<std::string, Document> documents; // by path

    /// The open document of a URI. Throws RequestError.
    [[nodiscard]] Document& document(const Json& uri);
    /// The text of a file, without a byte order mark; nullopt if it cannot be read.
    [[nodiscard]] std::optional<std::string> text_of(const std::string& path) const;
    /// The grammars that contain `path`: those that no file includes and that include it, directly
    /// or through other files; `path` itself if nothing includes it. At most 64.
    [[nodiscard]] std::vector<std::string> roots_of(const std::string& path) const;
    /// All grammars: open documents, files below the folders, or else files beside `path`.
    [[nodiscard]] std::vector<std::string> known_grammars(const std::string& path) const;
    /// The parsed file with its included files. Kept until one of the texts changes.
    [[nodiscard]] std::shared_ptr<const IndexedGrammar> grammar(const std::string& root);
    /// The names of all grammars with these roots.
    [[nodiscard]] std::shared_ptr<const NameIndex> names(const std::vector<std::string>& roots);
    /// names() with the texts of `changed`, by path, in place of the texts of these files.
    [[nodiscard]] NameIndex names_if(const std::vector<std::string>& roots,
                                     const std::map<std::string, std::string>& changed) const;
    /// Checks a document as `lsc check` does. Kept until the document or one of its inputs changes.
    [[nodiscard]] const CheckedDocument& check(Document& document);
    /// check(), with doubtful fixes as offers.
    [[nodiscard]] CheckedDocument check_with_offers(Document& document);
    /// The bytes that `lsc check --fix` writes, by path.
    [[nodiscard]] std::map<std::string, std::string> fixed(Document& document);

    [[nodiscard]] std::string uri_of(const std::string& path) const;
    /// Checks the grammar of a document with `options`: the document itself, or, if it is only a
    /// part, the first grammar that includes it.
    [[nodiscard]] CheckedDocument check_whole(const Document& document,
                                              const GrammarOptions& options) const;

private:
    /// The text of a document as .lsys or its dialect; sets `failure` if it cannot be read.
    [[nodiscard]] GrammarText grammar_text(const Document& document, std::string& failure) const;
    /// The options of a check: whether the document is a part of a grammar.
    [[nodiscard]] GrammarOptions options_of(const Document& document) const;
    /// check() without the result of an earlier check.
    [[nodiscard]] CheckedDocument check_anew(const Document& document) const;
    /// Compiles `checked.text`. Sets `checked.failure` if it cannot, or takes too long.
    void compile(const GrammarOptions& options, CheckedDocument& checked) const;
    [[nodiscard]] FileLoader loader() const;
    [[nodiscard]] bool is_lsys_text(const std::string& path) const;
    /// Parses a file; null if it cannot be read.
    [[nodiscard]] std::shared_ptr<const IndexedGrammar> parse(const std::string& root,
                                                              const FileLoader& load) const;

    std::vector<std::pair<std::string, std::shared_ptr<const IndexedGrammar>>>
        grammars_; // by root, the last used one last
};

/// The path that a URI names, normalised; the URI itself if it names no file.
[[nodiscard]] std::string path_of_uri(std::string_view uri);

/// The files that the text of `path` includes, normalised.
[[nodiscard]] std::vector<std::string> included_files(const std::string& path,
                                                      std::string_view text);

/// A `Position`. Throws RequestError if its numbers are not whole, or below 0.
[[nodiscard]] TextPosition position_of(const Json& position);

/// Converts places of files to JSON, and reads each file once.
class Places {
public:
    explicit Places(const Workspace& workspace) : workspace_(workspace) {}
    [[nodiscard]] TextPosition position(const std::string& path, std::uint32_t offset);
    [[nodiscard]] Json range(const TextPlace& place);
    [[nodiscard]] Json location(const TextPlace& place);
    /// The byte offset of a `Position` in the text without its byte order mark.
    [[nodiscard]] std::uint32_t offset(const std::string& path, const Json& position);
    [[nodiscard]] const std::string& text(const std::string& path);

private:
    struct File {
        std::string text;     // text with the byte order mark of an open document
        std::size_t mark = 0; // bytes of the byte order mark
        std::string unmarked; // `text` without the mark
        std::optional<TextPositions> positions;
    };
    [[nodiscard]] File& file(const std::string& path);

    const Workspace& workspace_;
    std::map<std::string, File> files_;
};

/// The edit that turns `before`, the text of `path`, into `after`; replaces only the bytes between
/// the first and the last difference.
[[nodiscard]] Json
changing_edit(const std::string& path, std::string_view before, std::string_view after, Places& at);

// The requests, each with its parameters as in LSP. They throw RequestError, and exceptions of
// Json for invalid parameters.

[[nodiscard]] Json document_diagnostics(Workspace& workspace, Document& document);
[[nodiscard]] Json code_actions(Workspace& workspace, const Json& params);
[[nodiscard]] Json format_document(Workspace& workspace, const Json& params);
[[nodiscard]] Json format_range(Workspace& workspace, const Json& params);
[[nodiscard]] Json format_on_type(Workspace& workspace, const Json& params);
[[nodiscard]] Json document_symbols(Workspace& workspace, const Json& params);
[[nodiscard]] Json workspace_symbols(Workspace& workspace, const Json& params);
[[nodiscard]] Json go_to_definition(Workspace& workspace, const Json& params);
[[nodiscard]] Json find_references(Workspace& workspace, const Json& params);
[[nodiscard]] Json highlight_name(Workspace& workspace, const Json& params);
[[nodiscard]] Json prepare_rename(Workspace& workspace, const Json& params);
[[nodiscard]] Json rename_name(Workspace& workspace, const Json& params);
[[nodiscard]] Json hover(Workspace& workspace, const Json& params);
[[nodiscard]] Json complete(Workspace& workspace, const Json& params);
[[nodiscard]] Json signature_help(Workspace& workspace, const Json& params);
[[nodiscard]] Json inlay_hints(Workspace& workspace, const Json& params);
[[nodiscard]] Json code_lenses(Workspace& workspace, const Json& params);
[[nodiscard]] Json semantic_tokens(Workspace& workspace, const Json& params);
[[nodiscard]] Json folding_ranges(Workspace& workspace, const Json& params);
[[nodiscard]] Json document_colours(Workspace& workspace, const Json& params);
[[nodiscard]] Json colour_presentations(Workspace& workspace, const Json& params);
/// The token types of semantic_tokens(), for the capabilities of the server.
[[nodiscard]] Json token_legend();

} // namespace lsys
