// SPDX-License-Identifier: MIT
#include "grammar/rendering/render_diagnostic.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>

namespace {

using namespace std::string_literals;
using lsys::Diagnostic;
using lsys::DiagnosticCode;
using lsys::FileId;
using lsys::MessageFormat;
using lsys::RenderOptions;
using lsys::SourceMap;
using lsys::SourceSpan;

/// A file, with spans of the first occurrence of a text in it.
struct Fixture {
    SourceMap sources;
    FileId file;

    explicit Fixture(std::string text) : file(sources.add("tree.lsys", std::move(text))) {}

    SourceSpan span(std::string_view needle) const {
        const std::size_t at = sources.file(file).text().find(needle);
        REQUIRE(at != std::string_view::npos);
        return {file, static_cast<std::uint32_t>(at),
                static_cast<std::uint32_t>(at + needle.size())};
    }
    Diagnostic at(SourceSpan span, std::string label = {}) const {
        Diagnostic diagnostic =
            lsys::make_diagnostic(DiagnosticCode::SyntaxError, span, "this is wrong");
        diagnostic.label = std::move(label);
        return diagnostic;
    }
    std::string human(const Diagnostic& diagnostic, RenderOptions options = {}) const {
        std::string out;
        lsys::render(diagnostic, sources, options, out);
        return out;
    }
    /// The frame without the head line.
    std::string frame(const Diagnostic& diagnostic) const {
        const std::string text = human(diagnostic);
        return text.substr(text.find('\n') + 1);
    }
};

} // namespace

TEST_CASE("a frame shows the line, carets under the span and the label") {
    const Fixture f("#n = 2;\n#p1 : A(x) : x > 2 : F(1)A(x, 1);\n");
    Diagnostic d = f.at(f.span("A(x, 1)"), "two parameters");
    d.notes.push_back("a note");
    d.help.push_back("a repair");
    CHECK(f.human(d) == "tree.lsys:2:26: error: this is wrong [syntax-error]\n"
                        "  2 | #p1 : A(x) : x > 2 : F(1)A(x, 1);\n"
                        "    |                          ^^^^^^^ two parameters\n"
                        "note: a note\n"
                        "help: a repair\n");
}

TEST_CASE("the short format is the head line") {
    const Fixture f("#w : A;\n");
    CHECK(f.human(f.at(f.span("A")), {.format = MessageFormat::Short}) ==
          "tree.lsys:1:6: error: this is wrong [syntax-error]\n");
}

TEST_CASE("a diagnostic without a place names the program") {
    const Fixture f("");
    CHECK(f.human(f.at({})) == "lsc: error: this is wrong [syntax-error]\n");
}

TEST_CASE("the bar is straight beside line numbers of different lengths") {
    const Fixture f(std::string(999, '\n') + "#w : A;\n");
    CHECK(f.frame(f.at(f.span("A"))) == "1000 | #w : A;\n"
                                        "    |      ^\n");
}

TEST_CASE("tabs are expanded to stops of four columns") {
    const Fixture f("\t#w\t: A;\n");
    CHECK(f.frame(f.at(f.span("A"))) == "  1 |     #w  : A;\n"
                                        "    |           ^\n");
    CHECK(f.frame(f.at(f.span("\t:"))) == "  1 |     #w  : A;\n"
                                          "    |       ^^^\n");
}

TEST_CASE("wide characters take two columns, combining ones none") {
    const Fixture wide("/* 木木 */ A;");
    CHECK(wide.frame(wide.at(wide.span("A"))) == "  1 | /* 木木 */ A;\n"
                                                 "    |            ^\n");
    CHECK(wide.frame(wide.at(wide.span("木木"))) == "  1 | /* 木木 */ A;\n"
                                                    "    |    ^^^^\n");
    const Fixture combining("e\u0301x A;"); // e followed by a combining acute accent
    CHECK(combining.frame(combining.at(combining.span("x"))) == "  1 | e\u0301x A;\n"
                                                                "    |  ^\n");
    CHECK(combining.frame(combining.at(combining.span("\u0301"))) == "  1 | e\u0301x A;\n"
                                                                     "    | ^\n");
}

TEST_CASE("invisible and control characters are shown as escapes") {
    const Fixture zero_width("A\u200BB;");
    CHECK(zero_width.frame(zero_width.at(zero_width.span("\u200B"))) == "  1 | A\\u{200b}B;\n"
                                                                        "    |  ^^^^^^^^\n");
    const Fixture bell("A\x07 B;");
    CHECK(bell.frame(bell.at(bell.span("\x07"))) == "  1 | A\\x07 B;\n"
                                                    "    |  ^^^^\n");
    const Fixture nul("A\0B;"s);
    CHECK(nul.frame(nul.at(nul.span("B"))) == "  1 | A\\x00B;\n"
                                              "    |      ^\n");
    const Fixture reversed("A \u202E B;");
    CHECK(reversed.frame(reversed.at(reversed.span("B"))) == "  1 | A \\u{202e} B;\n"
                                                             "    |            ^\n");
}

TEST_CASE("bytes that are not UTF-8 are shown as the replacement character") {
    const Fixture f("A\xFF\xC3 B;");
    CHECK(f.frame(f.at(f.span("\xFF\xC3"))) == "  1 | A\uFFFD\uFFFD B;\n"
                                               "    |  ^^\n");
    CHECK(f.human(f.at(f.span("B"))).starts_with("tree.lsys:1:5:"));
    const Fixture overlong("\xE0\x80\x80\xED\xA0\x80 B;");
    CHECK(overlong.human(overlong.at(overlong.span("B"))).starts_with("tree.lsys:1:8:"));
}

TEST_CASE("messages cannot send control sequences to a terminal") {
    const Fixture f("A");
    Diagnostic d = f.at(f.span("A"));
    d.message = "unknown `\x1b[2J`";
    CHECK(f.human(d, {.format = MessageFormat::Short}) ==
          "tree.lsys:1:1: error: unknown `\\x1b[2J` [syntax-error]\n");
}

TEST_CASE("an empty span is one caret") {
    const Fixture f("#n = 2\n#w : A;");
    CHECK(f.frame(f.at({f.file, 6, 6}, "a `;` is missing")) == "  1 | #n = 2\n"
                                                               "    |       ^ a `;` is missing\n");
    CHECK(f.frame(f.at({f.file, 14, 14})) == "  2 | #w : A;\n"
                                             "    |        ^\n");
    const Fixture ended("#n = 2;\n");
    CHECK(ended.frame(ended.at({ended.file, 8, 8})) == "  2 |\n"
                                                       "    | ^\n");
    const Fixture empty("");
    CHECK(empty.frame(empty.at({empty.file, 0, 0})) == "  1 |\n"
                                                       "    | ^\n");
}

TEST_CASE("a span of several lines marks the first and the last") {
    const Fixture two("#p : A :\n   * : B;\n");
    CHECK(two.frame(two.at(two.span("A :\n   *"), "here")) == "  1 | #p : A :\n"
                                                              "    |      ^^^\n"
                                                              "  2 |    * : B;\n"
                                                              "    |    ^ here\n");
    const Fixture many("{a\nb\nc\nd}\n");
    CHECK(many.frame(many.at({many.file, 0, 9})) == "  1 | {a\n"
                                                    "    | ^^\n"
                                                    "    | ...\n"
                                                    "  4 | d}\n"
                                                    "    | ^^\n");
    const Fixture line_end("a\r\nb\r\n");
    CHECK(line_end.frame(line_end.at({line_end.file, 0, 3})) == "  1 | a\n"
                                                                "    | ^\n");
    CHECK(line_end.frame(line_end.at({line_end.file, 1, 3})) == "  1 | a\n"
                                                                "    |  ^\n");
}

TEST_CASE("labels in the same line share the frame, others get their own") {
    const Fixture f("#define w 3;\n#p : A(w) : * : F(w)F(w);\n");
    Diagnostic d = f.at(f.span("w) : *"), "the formal");
    d.span.end = d.span.begin + 1;
    d.labels.push_back({f.span("F(w)"), "used here"});
    d.labels.push_back({{f.file, 8, 9}, "the constant is here"});
    CHECK(f.frame(d) == "  2 | #p : A(w) : * : F(w)F(w);\n"
                        "    |        ^ the formal\n"
                        "    |                 ---- used here\n"
                        "note: the constant is here: tree.lsys:1:9\n"
                        "  1 | #define w 3;\n"
                        "    |         -\n");
}

TEST_CASE("eight labels are shown, and a note counts the others") {
    const Fixture f("#define w 3;\n#p : A : * : F;\n");
    Diagnostic d = f.at({f.file, 13, 15});
    d.labels.assign(9, {{f.file, 8, 9}, "a place"});
    CHECK(f.frame(d).ends_with("note: and 1 more place\n"));
    d.labels.resize(10, d.labels.front());
    CHECK(f.frame(d).ends_with("note: and 2 more places\n"));
    d.labels.resize(8);
    CHECK(f.frame(d).find("more place") == std::string::npos);
}

TEST_CASE("labels may lie in another file") {
    Fixture f("#include \"part.lsys\";\n#define w 4;\n");
    const FileId part = f.sources.add("part.lsys", "#define w 3;\n");
    Diagnostic d = f.at(f.span("w 4"));
    d.span.end = d.span.begin + 1;
    d.labels.push_back({{part, 8, 9}, "the first is here"});
    CHECK(f.frame(d) == "  2 | #define w 4;\n"
                        "    |         ^\n"
                        "note: the first is here: part.lsys:1:9\n"
                        "  1 | #define w 3;\n"
                        "    |         -\n");
}

TEST_CASE("a fix is shown as the changed line") {
    const Fixture f("#n = 2\n#w : A − B − C;\n");
    Diagnostic insert = f.at({f.file, 6, 6});
    insert.fixes.push_back({"add `;`", {{{f.file, 6, 6}, ";"}}});
    CHECK(f.frame(insert) == "  1 | #n = 2\n"
                             "    |       ^\n"
                             "help: add `;`\n"
                             "  1 | #n = 2;\n"
                             "    |       +\n");
    const SourceSpan first = f.span("−");
    const SourceSpan second{f.file, first.begin + 6, first.end + 6};
    Diagnostic replace = f.at(first);
    replace.fixes.push_back({"write `-`", {{second, "-"}, {first, "-"}}});
    CHECK(f.frame(replace) == "  2 | #w : A − B − C;\n"
                              "    |        ^\n"
                              "help: write `-`\n"
                              "  2 | #w : A - B - C;\n"
                              "    |        ~   ~\n");
    Diagnostic remove = f.at(first);
    remove.fixes.push_back({"remove it", {{{f.file, first.begin, first.end + 1}, ""}}});
    CHECK(f.frame(remove).ends_with("help: remove it\n"
                                    "  2 | #w : A B − C;\n"));
    Diagnostic lines = f.at(first);
    lines.fixes.push_back({"split it", {{{f.file, first.begin, first.end}, ";\n#x : "}}});
    CHECK(f.frame(lines).ends_with("help: split it\n"
                                   "  2 | #w : A ;\n"
                                   "    |        ~\n"
                                   "  3 | #x :  B − C;\n"));
}

TEST_CASE("a long line is shortened to the part around the span") {
    const std::string rest(5'000'000, 'x');
    const Fixture f(rest + " A " + rest);
    const std::string frame = f.frame(f.at(f.span("A")));
    const std::string line = frame.substr(0, frame.find('\n'));
    CHECK(line.starts_with("  1 | ...x"));
    CHECK(line.ends_with("x..."));
    CHECK(line.size() < 140);
    CHECK(frame.find('^') - frame.rfind("| ", frame.find('^')) == line.find('A') - line.find("| "));

    Diagnostic d = f.at(f.span("A"));
    d.fixes.push_back({"write `B`", {{f.span("A"), "B"}}});
    const std::string fixed = f.frame(d);
    const std::string last = fixed.substr(fixed.find("write `B`\n") + 10);
    CHECK(last.starts_with("  1 | ...x"));
    CHECK(last.find('B') - last.find("| ") == last.find('~') - last.rfind("| "));

    const std::string all = f.frame(f.at({f.file, 0, 10'000'003}));
    CHECK(all.size() < 600);
    CHECK(all.starts_with("  1 | xxx"));
}

TEST_CASE("a line of zero-width characters is shortened too") {
    std::string text = "A";
    for (int i = 0; i < 100'000; ++i) {
        text += "\u0301";
    }
    const Fixture f(text + "B");
    CHECK(f.frame(f.at(f.span("B"))).size() < 10'000);
    CHECK(f.frame(f.at(f.span("A"))).size() < 10'000);
}

TEST_CASE("showing fifty of a hundred thousand diagnostics on one long line is fast") {
    constexpr std::uint32_t kCount = 100'000;
    std::string text;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        text +=
            "0123456789é0123456789é0123456789é0123456789é0123456789é0123456789é0123456789é012345\t";
    }
    const Fixture f(std::move(text));
    const auto stride = static_cast<std::uint32_t>(f.sources.file(f.file).text().size() / kCount);
    lsys::Diagnostics all;
    for (std::uint32_t i = 0; i < kCount + 7; ++i) {
        // Added in descending order of place, so that the first fifty are the last ones of the
        // text.
        const std::uint32_t at = (kCount - 1 - i % kCount) * stride;
        all.add(DiagnosticCode::SyntaxError, {f.file, at, at + 1}, "this is wrong");
    }
    const auto begin = std::chrono::steady_clock::now();
    std::string out;
    lsys::render_all(all, f.sources, {}, out);
    const auto spent = std::chrono::steady_clock::now() - begin;
    CHECK(out.ends_with("lsc: 99957 more errors\n"));
    CHECK(out.starts_with("tree.lsys:1:8399917: error:"));
    CHECK(spent < std::chrono::seconds(1));
}

TEST_CASE("if not all diagnostics are shown, errors come before warnings") {
    const Fixture f("A B C D");
    lsys::Diagnostics all;
    all.add(DiagnosticCode::MissingGenerations, f.span("A"), "first");
    all.add(DiagnosticCode::MissingGenerations, f.span("B"), "second");
    all.add(DiagnosticCode::ZeroGenerations, f.span("C"), "third");
    all.add(DiagnosticCode::SyntaxError, f.span("D"), "fourth");
    std::string out;
    lsys::render_all(all, f.sources, {.format = MessageFormat::Short, .max_shown = 2}, out);
    CHECK(out == "tree.lsys:1:1: warning: first [missing-generations]\n"
                 "tree.lsys:1:7: error: fourth [syntax-error]\n"
                 "lsc: 1 more warning, 1 more note\n");
    out.clear();
    lsys::render_all(all, f.sources, {.format = MessageFormat::Json, .max_shown = 0}, out);
    CHECK(std::count(out.begin(), out.end(), '\n') == 4); // all of them, for editors
    CHECK(out.find("\"more\"") == std::string::npos);
}

TEST_CASE("colour is used only on request and changes no text") {
    const Fixture f("#n = 2\n#define w 3;");
    Diagnostic d = f.at({f.file, 6, 6}, "label");
    d.labels.push_back({f.span("w"), "other"});
    d.notes.push_back("note");
    d.help.push_back("help");
    d.fixes.push_back({"add `;`", {{{f.file, 6, 6}, ";"}}});
    const std::string plain = f.human(d);
    CHECK(plain.find('\x1b') == std::string::npos);
    std::string coloured = f.human(d, {.colour = true});
    CHECK(coloured.find("\x1b[1;31merror: \x1b[0m") != std::string::npos);
    for (std::size_t at = coloured.find('\x1b'); at != std::string::npos;
         at = coloured.find('\x1b')) {
        coloured.erase(at, coloured.find('m', at) - at + 1);
    }
    CHECK(coloured == plain);
}

TEST_CASE("JSON has all data of a diagnostic, with byte offsets of the file on disk") {
    SourceMap sources;
    const FileId file = sources.add("tree.lsys", "\xEF\xBB\xBF#w : é\xFFx;\n");
    Diagnostic d = lsys::make_diagnostic(DiagnosticCode::SyntaxError, {file, 7, 9}, "wrong \xFF");
    d.label = "here";
    d.labels.push_back({{file, 0, 2}, "there"});
    d.notes.push_back("note");
    d.help.push_back("help");
    d.fixes.push_back({"mend", {{{file, 7, 8}, ""}}, false});
    std::string out;
    lsys::render(d, sources, {.format = MessageFormat::Json}, out);
    CHECK(out.back() == '\n');
    CHECK(out.find('\n') == out.size() - 1);
    const nlohmann::json json = nlohmann::json::parse(out);
    CHECK(json["severity"] == "error");
    CHECK(json["code"] == "syntax-error");
    CHECK(json["message"] == "wrong \uFFFD");
    CHECK(json["file"] == "tree.lsys");
    CHECK(json["line"] == 1);
    CHECK(json["column"] == 7);
    CHECK(json["end_column"] == 9);
    CHECK(json["byte"] == 10);
    CHECK(json["end_byte"] == 12);
    CHECK(json["label"] == "here");
    CHECK(json["labels"][0]["text"] == "there");
    CHECK(json["labels"][0]["byte"] == 3);
    CHECK(json["notes"][0] == "note");
    CHECK(json["help"][0] == "help");
    CHECK(json["fixes"][0]["title"] == "mend");
    CHECK(json["fixes"][0]["machine_applicable"] == false);
    CHECK(json["fixes"][0]["edits"][0]["byte"] == 10);
    CHECK(json["fixes"][0]["edits"][0]["replacement"] == "");
}

TEST_CASE("a diagnostic of no file begins with the program that prints it") {
    const Fixture f("#n = 2;\n");
    RenderOptions options;
    const Diagnostic d = f.at(SourceSpan{});
    CHECK(f.human(d, options) == "lsc: error: this is wrong [syntax-error]\n");
    options.program = "lsview";
    CHECK(f.human(d, options) == "lsview: error: this is wrong [syntax-error]\n");
    options.format = MessageFormat::Short;
    CHECK(f.human(d, options) == "lsview: error: this is wrong [syntax-error]\n");
}
