// SPDX-License-Identifier: MIT
// A fuzzed client: random edits, requests in the wrong order, and cut messages. After each of them
// the server has the diagnostics of a server that was just started with the same texts.
#include "runtime/base/random.h"
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace {

using lsys::framed;
using lsys::ReadMessage;
using lsys::tests::Editor;
using Json = nlohmann::json;

/// A text in UTF-16 code units, independent of the conversions of the server.
using Units = std::u16string;

std::string to_utf8(const Units& units) {
    std::string text;
    const auto put = [&](char32_t bits, char32_t lead) { text += static_cast<char>(lead | bits); };
    for (std::size_t i = 0; i < units.size(); ++i) {
        char32_t c = units[i];
        if (c >= 0xD800 && c < 0xDC00) {
            c = 0x10000 + ((c - 0xD800) << 10U) + (units[++i] - char32_t{0xDC00});
        }
        if (c < 0x80) {
            put(c, 0);
        } else if (c < 0x800) {
            put(c >> 6U, 0xC0);
            put(c & 0x3FU, 0x80);
        } else if (c < 0x10000) {
            put(c >> 12U, 0xE0);
            put((c >> 6U) & 0x3FU, 0x80);
            put(c & 0x3FU, 0x80);
        } else {
            put(c >> 18U, 0xF0);
            put((c >> 12U) & 0x3FU, 0x80);
            put((c >> 6U) & 0x3FU, 0x80);
            put(c & 0x3FU, 0x80);
        }
    }
    return text;
}

/// Whether an edit may begin or end there: not within a character or a line end.
bool is_place(const Units& units, std::size_t at) {
    return at == 0 || at >= units.size() ||
           !((units[at] >= 0xDC00 && units[at] < 0xE000) ||
             (units[at] == u'\n' && units[at - 1] == u'\r'));
}

Json position_of(const Units& units, std::size_t at, bool is_utf8) {
    int line = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < at; ++i) {
        if (units[i] == u'\n' ||
            (units[i] == u'\r' && (i + 1 == units.size() || units[i + 1] != u'\n'))) {
            ++line;
            begin = i + 1;
        }
    }
    const std::size_t character =
        is_utf8 ? to_utf8(units.substr(begin, at - begin)).size() : at - begin;
    return Editor::position(line, static_cast<int>(character));
}

constexpr std::array kPieces{u"#n = 2;\n",
                             u"#w : A(1) B;\n",
                             u"#p : A(x) : x > k : F(x) A(x - 1);\n",
                             u"#q : B : * : [+F] B;\r\n",
                             u"#r : A < B > A : * ~ 0.5 : F({0, 1});\n",
                             u"#define k 1;\n",
                             u"#param z 2 {1, 3};\n",
                             u"#function f(a) a*k;\n",
                             u"#include \"b.lsys\";\n",
                             u"#object L LEAF;\n",
                             u"#material 3 colour 0.1 0.2 0.3;\n",
                             u"#set turtle cpfg;\n",
                             u"Lsystem: 1\nderivation length: 2\nAxiom: A\n",
                             u"A --> F[+A]A\nendlsystem\n",
                             u"A(x) : x > 1 --> F(x)A(x-1)\n",
                             u"Koch {\n Angle 6\n Axiom F--F--F\n F=F+F--F+F\n}\n",
                             u"/* \U0001F332 */",
                             u"// \u00E4\u20AC\n",
                             u"'(0.5, 1, 0)",
                             u"\u2212",
                             u"(",
                             u")",
                             u"[",
                             u"]",
                             u";",
                             u":",
                             u"x",
                             u"#",
                             u"\r\n",
                             u"\r",
                             u"`",
                             u"\U0001F332"};

constexpr std::array<const char*, 3> kPaths{"/p/a.lsys", "/p/b.lsys", "/p/c.l"};
constexpr std::array kMethodsInBatches{"textDocument/documentSymbol", "textDocument/hover",
                                       "textDocument/diagnostic", "textDocument/codeLens"};
constexpr std::array<const char*, 3> kLanguages{"lsys", "lsys", "cpfg"};

/// A wrong message: a request or a notification.
struct Mistake {
    const char* method;
    const char* params; // JSON
    bool is_request;
};
/// Messages that must have no effect; requests get an error.
const std::array kMistakes{
    Mistake{"textDocument/didChange",
            R"({"textDocument":{"uri":"file:///p/closed.lsys"},"contentChanges":[{"text":""}]})",
            false},
    Mistake{"textDocument/didChange", R"({"textDocument":{"uri":"file:///p/a.lsys"}})", false},
    Mistake{"textDocument/didChange",
            R"({"textDocument":{"uri":"file:///p/a.lsys"},"contentChanges":[{"text":""},{}]})",
            false},
    Mistake{"textDocument/didChange", "[]", false},
    Mistake{"textDocument/didClose", R"({"textDocument":{"uri":"file:///p/closed.lsys"}})", false},
    Mistake{"textDocument/didOpen", R"({"textDocument":{"uri":"file:///p/a.lsys"}})", false},
    Mistake{"textDocument/didOpen", "null", false},
    Mistake{"workspace/didChangeWorkspaceFolders", R"({"event":{}})", false},
    Mistake{"initialized", "{}", false},
    Mistake{"$/cancelRequest", R"({"id":[1]})", false},
    Mistake{"initialize", R"({"capabilities":{}})", true},
    Mistake{"textDocument/hover",
            R"({"textDocument":{"uri":"file:///p/a.lsys"},"position":{"line":-1,"character":0}})",
            true},
    Mistake{"textDocument/hover",
            R"({"textDocument":{"uri":4},"position":{"line":0,"character":0}})", true},
    Mistake{"textDocument/hover",
            R"({"textDocument":{"uri":"file:///p/no"},"position":{"line":0,"character":0}})", true},
    Mistake{"textDocument/rename",
            R"({"textDocument":{"uri":"file:///p/a.lsys"},"position":{"line":0,"character":0}})",
            true},
    Mistake{"textDocument/codeAction",
            R"({"textDocument":{"uri":"file:///p/a.lsys"},"range":0,"context":{}})", true},
    Mistake{"no/such/method", "{}", true},
};
/// Bodies that are no messages.
const std::array kNonsense{"\xFF\xFE", "\"shutdown\"", "{",
                           R"({"jsonrpc":"2.0","id":1,"method":7})",
                           R"([{"jsonrpc":"2.0","id":1,"method":"shutdown"}])"};

class FuzzedClient {
public:
    FuzzedClient(std::uint64_t seed, bool is_utf8)
        : seed_(seed), is_utf8_(is_utf8), editor_(capabilities()) {
        open_all(editor_);
    }

    void run(int edits) {
        while (edit_count_ < edits) {
            act();
            CAPTURE(seed_, step_, is_utf8_);
            compare();
        }
    }

private:
    [[nodiscard]] Json capabilities() const {
        return is_utf8_ ? Json{{"general", {{"positionEncodings", Json::array({"utf-8"})}}},
                               {"textDocument",
                                {{"publishDiagnostics", {{"relatedInformation", true}}}}}}
                        : Json::object();
    }

    std::size_t below(std::size_t count) {
        const lsys::PhiloxBlock block = lsys::draw_block(seed_, 0, draw_++, 0);
        return std::size_t{block[0]} % count;
    }
    template <typename List>
    const auto& one_of(const List& list) {
        return list[below(std::size(list))];
    }

    [[nodiscard]] Json open_message(std::size_t file) const {
        return {{"jsonrpc", "2.0"},
                {"method", "textDocument/didOpen"},
                {"params",
                 {{"textDocument",
                   {{"uri", Editor::uri(kPaths[file])},
                    {"languageId", kLanguages[file]},
                    {"version", 1},
                    {"text", to_utf8(texts_[file])}}}}}};
    }
    void open_all(Editor& editor) const {
        std::vector<Json> messages;
        for (std::size_t file = 0; file < kPaths.size(); ++file) {
            messages.push_back(open_message(file));
        }
        editor.send_all(messages);
    }

    /// A change of a random file; changes `texts_`.
    Json change_message() {
        ++edit_count_;
        const std::size_t file = below(kPaths.size());
        Units& text = texts_[file];
        Json changes = Json::array();
        for (std::size_t left = below(3); left < 3; ++left) {
            const Units piece = one_of(kPieces);
            if (below(50) == 0) {
                text = piece;
                changes.push_back({{"text", to_utf8(text)}});
                continue;
            }
            std::size_t begin = below(text.size() + 1);
            std::size_t end = std::min(text.size(), begin + (below(3) == 0 ? below(12) : 0));
            if (text.size() > 500) {
                begin = text.size() / 4;
                end = text.size();
            }
            while (!is_place(text, begin)) {
                --begin;
            }
            while (!is_place(text, end)) {
                ++end;
            }
            const bool is_beyond = end == text.size() && below(2) == 0;
            changes.push_back({{"range",
                                {{"start", position_of(text, begin, is_utf8_)},
                                 {"end", is_beyond ? Editor::position(1'000'000, 5)
                                                   : position_of(text, end, is_utf8_)}}},
                               {"text", to_utf8(piece)}});
            text.replace(begin, end - begin, piece);
        }
        return {
            {"jsonrpc", "2.0"},
            {"method", "textDocument/didChange"},
            {"params",
             {{"textDocument", {{"uri", Editor::uri(kPaths[file])}, {"version", edit_count_ + 1}}},
              {"contentChanges", changes}}}};
    }

    /// Writes bytes to the server in random pieces.
    void send_bytes(std::string_view bytes) {
        while (!bytes.empty()) {
            const std::size_t size = std::min(bytes.size(), 1 + below(200));
            reader_.add(bytes.substr(0, size));
            bytes.remove_prefix(size);
            std::vector<ReadMessage> messages;
            while (std::optional<ReadMessage> message = reader_.next()) {
                messages.push_back(std::move(*message));
            }
            if (!messages.empty()) {
                editor_.take(messages);
            }
        }
    }

    void act() {
        ++step_;
        const std::size_t choice = below(100);
        if (choice < 3) {
            cut_message();
        } else if (choice < 8) {
            mistake();
        } else if (choice < 11) {
            reopen();
        } else if (choice < 14) {
            batch();
        } else {
            send_bytes(framed(change_message().dump()));
        }
    }

    /// A message that ends too early. The rest of its length is taken from a second one, which may
    /// get lost; the third has to arrive.
    void cut_message() {
        const std::string whole = framed(R"({"jsonrpc":"2.0","method":"$/cut","params":[1,2,3]})");
        const std::string padding(whole.size(), ' ');
        send_bytes(whole.substr(0, 1 + below(whole.size() - 1)));
        send_bytes(framed(R"({"jsonrpc":"2.0","method":"$/lost","params":")" + padding + "\"}"));
        editor_.responses.clear();
        send_bytes(framed(
            R"({"jsonrpc":"2.0","id":5,"method":"workspace/symbol","params":{"query":"?"}})"));
        CAPTURE(seed_, step_);
        REQUIRE(editor_.responses.contains(5));
        CHECK(editor_.responses.at(5).contains("result"));
    }

    void mistake() {
        if (below(5) == 0) {
            send_bytes(framed(one_of(kNonsense)));
            return;
        }
        const Mistake& wrong = one_of(kMistakes);
        Json message{
            {"jsonrpc", "2.0"}, {"method", wrong.method}, {"params", Json::parse(wrong.params)}};
        if (wrong.is_request) {
            message["id"] = 0;
        }
        editor_.responses.clear();
        send_bytes(framed(message.dump()));
        CAPTURE(message);
        CHECK(editor_.responses.contains(0) == wrong.is_request);
        CHECK((!wrong.is_request || editor_.responses.at(0).contains("error")));
    }

    void reopen() {
        const std::size_t file = below(kPaths.size());
        if (below(2) == 0) { // otherwise it is opened twice
            send_bytes(framed(Json{{"jsonrpc", "2.0"},
                                   {"method", "textDocument/didClose"},
                                   {"params", Editor::in(kPaths[file])}}
                                  .dump()));
        }
        send_bytes(framed(open_message(file).dump()));
    }

    /// Messages that arrive together: changes, requests, and cancellations of some of them.
    void batch() {
        std::string bytes;
        for (std::size_t i = 0; i < 4; ++i) {
            Json params = Editor::in(one_of(kPaths));
            params["position"] = Editor::position(0, 0);
            bytes += framed(change_message().dump());
            bytes += framed(Json{
                {"jsonrpc", "2.0"},
                {"id", 100 + i},
                {"method", one_of(kMethodsInBatches)},
                {"params",
                 params}}.dump());
            if (below(2) == 0) {
                bytes += framed(Json{{"jsonrpc", "2.0"},
                                     {"method", "$/cancelRequest"},
                                     {"params", {{"id", 100 + below(4)}}}}
                                    .dump());
            }
        }
        send_bytes(bytes);
    }

    void compare() {
        Editor fresh(capabilities());
        open_all(fresh);
        for (const char* path : kPaths) {
            CAPTURE(path);
            REQUIRE(editor_.diagnostics.at(Editor::uri(path)) ==
                    fresh.diagnostics.at(Editor::uri(path)));
        }
        constexpr int kStepsBetweenRequests = 20;
        if (step_ % kStepsBetweenRequests == 0) {
            compare_requests(fresh);
        }
    }

    void compare_requests(Editor& fresh) {
        const std::size_t file = below(kPaths.size());
        const Units& text = texts_[file];
        std::size_t at = below(text.size() + 1);
        while (!is_place(text, at)) {
            --at;
        }
        const Json position = position_of(text, at, is_utf8_);
        Json params = Editor::in(kPaths[file]);
        params["position"] = position;
        params["range"] = {{"start", Editor::position(0, 0)}, {"end", position}};
        params["context"] = {{"diagnostics", Json::array()}, {"includeDeclaration", true}};
        params["newName"] = "renamed";
        params["options"] = {{"tabSize", 4}, {"insertSpaces", true}};
        params["ch"] = ";";
        params["query"] = "a";
        for (const char* method : {"textDocument/documentSymbol",
                                   "workspace/symbol",
                                   "textDocument/definition",
                                   "textDocument/references",
                                   "textDocument/documentHighlight",
                                   "textDocument/prepareRename",
                                   "textDocument/rename",
                                   "textDocument/hover",
                                   "textDocument/completion",
                                   "textDocument/signatureHelp",
                                   "textDocument/semanticTokens/full",
                                   "textDocument/foldingRange",
                                   "textDocument/documentColor",
                                   "textDocument/formatting",
                                   "textDocument/rangeFormatting",
                                   "textDocument/onTypeFormatting",
                                   "textDocument/inlayHint",
                                   "textDocument/codeLens",
                                   "textDocument/codeAction",
                                   "textDocument/diagnostic"}) {
            Json mine = editor_.raw_request(method, params);
            Json other = fresh.raw_request(method, params);
            mine.erase("id");
            other.erase("id");
            CAPTURE(method, params);
            REQUIRE(mine == other);
        }
    }

    std::uint64_t seed_;
    bool is_utf8_;
    Editor editor_;
    lsys::MessageReader reader_;
    std::array<Units, kPaths.size()> texts_;
    std::uint64_t draw_ = 0;
    int edit_count_ = 0;
    int step_ = 0;
};

} // namespace

TEST_CASE("random edits, mistakes and cut messages leave the state of a fresh server") {
    FuzzedClient(1, false).run(1500);
    FuzzedClient(2, true).run(1500);
}

TEST_CASE("a hundred thousand random edits leave the state of a fresh server", "[.]") {
    FuzzedClient(3, false).run(50'000);
    FuzzedClient(4, true).run(50'000);
}
