// SPDX-License-Identifier: MIT
// Random edits: after any sequence of incremental changes the server knows the same text, and says
// the same about it, as a server that has just been started.
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <array>
#include <random>
#include <string>

namespace {

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

Json position_of(const Units& units, std::size_t at) {
    int line = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < at; ++i) {
        if (units[i] == u'\n' ||
            (units[i] == u'\r' && (i + 1 == units.size() || units[i + 1] != u'\n'))) {
            ++line;
            begin = i + 1;
        }
    }
    return Editor::position(line, static_cast<int>(at - begin));
}

} // namespace

TEST_CASE("two thousand random edits leave the state of a fresh server") {
    const std::array<const char16_t*, 22> pieces{u"#n = 2;\n",
                                                 u"#w : A(1) B;\n",
                                                 u"#p : A(x) : x > k : F(x) A(x - 1);\n",
                                                 u"#q : B : * : [+F] B;\r\n",
                                                 u"#define k 1;\n",
                                                 u"#include \"b.lsys\";\n",
                                                 u"#object L LEAF;\n",
                                                 u"/* \U0001F332 */",
                                                 u"// \u00E4\u20AC\n",
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
    std::mt19937 random(7);
    const auto below = [&](std::size_t count) { return std::size_t{random()} % count; };
    const std::array<std::string, 2> paths{"/p/a.lsys", "/p/b.lsys"};
    std::array<Units, 2> texts;
    Editor editor(Json::object());
    for (const std::string& path : paths) {
        editor.open(path, "");
    }
    constexpr int kEdits = 2000;
    constexpr int kBetweenChecks = 100;
    for (int i = 1; i <= kEdits; ++i) {
        const std::size_t file = below(2);
        Units& text = texts[file];
        Json changes = Json::array();
        for (std::size_t change = 0; change <= below(2); ++change) {
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
            const Units piece = pieces[below(pieces.size())];
            changes.push_back(
                {{"range", {{"start", position_of(text, begin)}, {"end", position_of(text, end)}}},
                 {"text", to_utf8(piece)}});
            text.replace(begin, end - begin, piece);
        }
        editor.notify("textDocument/didChange",
                      {{"textDocument", {{"uri", Editor::uri(paths[file])}, {"version", i + 1}}},
                       {"contentChanges", changes}});
        if (i % kBetweenChecks != 0) {
            continue;
        }
        Editor fresh(Json::object());
        fresh.open(paths[0], to_utf8(texts[0]));
        fresh.open(paths[1], to_utf8(texts[1]));
        for (const std::string& path : paths) {
            CAPTURE(i, path);
            CHECK(editor.diagnostics.at(Editor::uri(path)) ==
                  fresh.diagnostics.at(Editor::uri(path)));
            for (const char* method : {"textDocument/documentSymbol", "textDocument/formatting"}) {
                Json a = editor.raw_request(method, Editor::in(path));
                Json b = fresh.raw_request(method, Editor::in(path));
                a.erase("id");
                b.erase("id");
                CHECK(a == b);
            }
        }
    }
}
