// SPDX-License-Identifier: MIT
// The source pane without a window: colours, messages, fixes, layout, keys.
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"
#include "viewer/app/file_edits.h"
#include "viewer/app/source_pane.h"
#include "viewer/app/source_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

/// The source of a grammar as after a load.
std::shared_ptr<const SourceText> source_of(const std::string& file) {
    SourceRequest request;
    request.loaded.file = file;
    request.loaded.run.limits.max_bytes = std::uint64_t{1} << 30;
    const Project project{make_file_host(nullptr), request.loaded.run.limits, 1, {}};
    const Outcome<Grammar> grammar = load_grammar(file, {}, project);
    if (grammar) {
        request.loaded.sources = grammar.value().sources;
    }
    request.loaded.messages = std::make_shared<Messages>(grammar.messages());
    const std::atomic<bool> cancelled = false;
    return make_source_text(request, cancelled);
}

std::string token_text(const ShownSource& source, SourceTokenKind kind) {
    std::string text;
    for (const SourceToken& token : source.tokens) {
        if (token.kind == kind) {
            text += text.empty() ? "" : " ";
            text += source.file->text().substr(token.begin, token.end - token.begin);
        }
    }
    return text;
}

std::vector<std::string> texts_of(const std::vector<TextLine>& lines) {
    std::vector<std::string> texts;
    for (const TextLine& line : lines) {
        texts.push_back(plain_text(line));
    }
    return texts;
}

class QuietConsole {
public:
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    Console console{{in, out, err, false, nullptr, "lsview"}, {}};
};

std::vector<FileChange> changes_of(const SourceText& text, const SourceFix& fix) {
    std::vector<FileChange> changes;
    for (const auto& [path, edits] : fix.edits) {
        const SourceFile& file = *text.files.at(text.find(path).value()).file;
        changes.push_back({path, file_bytes(file), edited_bytes(file, edits)});
    }
    return changes;
}

} // namespace

TEST_CASE("the source of a grammar has coloured names, comments and statements of all its files") {
    const ScratchFolder folder;
    const std::string file = folder / "tree.lsys";
    write_text(folder / "part.lsys", "#define k 2;\n#q : A : * : F(k) A;\n");
    write_text(file, "// \"A\" tree\n#n = 1;\n#include \"part.lsys\"\n#set angle 30;\n"
                     "#w : A /* F\n k */ F(k);\n");
    const auto text = source_of(file);
    REQUIRE(text->files.size() == 2);
    const ShownSource& tree = text->files[0];
    CHECK(tree.path == file);
    CHECK(token_text(tree, SourceTokenKind::Module) == "A F");
    CHECK(token_text(tree, SourceTokenKind::Constant) == "k");
    CHECK(token_text(tree, SourceTokenKind::Setting) == "angle");
    CHECK(token_text(tree, SourceTokenKind::Keyword) == "#n #include #set #w");
    CHECK(token_text(tree, SourceTokenKind::Comment) == "// \"A\" tree /* F\n k */");
    CHECK(token_text(text->files[1], SourceTokenKind::Constant) == "k k");
    // A place in a statement of several lines; between statements the line itself.
    const LineRange axiom = statement_at(tree, 6, 7);
    CHECK(axiom.first == 5);
    CHECK(axiom.last == 6);
    CHECK(statement_at(tree, 1, 4).last == 1);
    CHECK(statement_at(tree, 99, 1).first == 7);
}

TEST_CASE("a certain fix writes what `lsc check --fix` writes, and undo restores the bytes") {
    const ScratchFolder folder;
    const std::string file = folder / "tree.lsys";
    // A byte order mark, CRLF, a blank at a line end, and no line end at the end of the file.
    const std::string wrong =
        "\xEF\xBB\xBF#n = 1;\r\n#w : A(1) \r\n#q : A(x) : * : F(x);\r\n#set angle 30;";
    write_text(file, wrong);
    write_text(folder / "fixed.lsys", wrong);
    static_cast<void>(run_lsc({"check", "--fix", folder / "fixed.lsys"}, ""));
    const std::string fixed = read_text(folder / "fixed.lsys");
    REQUIRE(fixed != wrong);

    const auto text = source_of(file);
    REQUIRE(text->files.size() == 1);
    REQUIRE(text->files[0].messages.size() == 1);
    const SourceMessage& message = text->files[0].messages[0];
    CHECK(message.line == 2);
    CHECK(message.severity == Severity::Error);
    REQUIRE(message.fixes.size() == 1);
    CHECK(message.fixes[0].is_certain);
    CHECK(message.fixes[0].refusal.empty());
    CHECK(plain_text(message.fixes[0].preview.front()).find("#w : A(1);") != std::string::npos);
    CHECK(text->fix_count == 1);
    CHECK(text->fixed.at(file) == fixed);

    QuietConsole quiet;
    FileEdits edits;
    REQUIRE(edits.apply(changes_of(*text, message.fixes[0]), quiet.console));
    CHECK(read_text(file) == fixed);
    CHECK(edits.position() == 1);
    REQUIRE(edits.go_to(0, quiet.console));
    CHECK(read_text(file) == wrong);
    REQUIRE(edits.go_to(1, quiet.console));
    CHECK(read_text(file) == fixed);
    // The same fix cannot be applied again, since the file is no longer as it was read.
    const Result<void> again = edits.apply(changes_of(*text, message.fixes[0]), quiet.console);
    REQUIRE_FALSE(again);
    CHECK(again.error().message == "`" + file + "` has changed on disk since it was read");
    CHECK(read_text(file) == fixed);
    // After a change by someone else nothing is taken back, and the step is skipped.
    write_text(file, fixed + "\n");
    CHECK_FALSE(edits.go_to(0, quiet.console));
    CHECK(read_text(file) == fixed + "\n");
    CHECK(edits.position() == 0);
    CHECK(edits.go_to(1, quiet.console));
    CHECK(read_text(file) == fixed + "\n");
}

TEST_CASE("a repair that may be meant otherwise is offered with the line that it makes") {
    const ScratchFolder folder;
    const std::string file = folder / "tree.lsys";
    const std::string wrong =
        "#n = 1;\n#define spread 25;\n#w : F [ +(spred) F ];\n#q : F : * : F F;\n";
    write_text(file, wrong);
    write_text(folder / "checked.lsys", wrong);
    static_cast<void>(run_lsc({"check", "--fix", folder / "checked.lsys"}, ""));
    REQUIRE(read_text(folder / "checked.lsys") == wrong);
    const auto text = source_of(file);
    CHECK(text->fixed.empty());
    CHECK(text->fix_count == 0);
    REQUIRE(text->files.at(0).messages.size() == 1);
    const SourceMessage& message = text->files[0].messages[0];
    CHECK(message.line == 3);
    CHECK(message.begin == 11);
    CHECK(message.end == 16);
    REQUIRE(message.fixes.size() == 1);
    CHECK_FALSE(message.fixes[0].is_certain);
    CHECK(texts_of(message.fixes[0].preview).front() == "  3 | #w : F [ +(spread) F ];");
    QuietConsole quiet;
    FileEdits edits;
    REQUIRE(edits.apply(changes_of(*text, message.fixes[0]), quiet.console));
    CHECK(read_text(file) ==
          "#n = 1;\n#define spread 25;\n#w : F [ +(spread) F ];\n#q : F : * : F F;\n");
}

TEST_CASE("files that are no .lsys grammar have plain text with messages") {
    const ScratchFolder folder;
    const std::string file = folder / "tree.l";
    write_text(file, "Lsystem: 1\nderivation length: 2\nAxiom: F\nF -> F[+F]F(\nendlsystem\n");
    const auto text = source_of(file);
    REQUIRE(text->files.size() == 1);
    CHECK(text->files[0].tokens.empty());
    CHECK_FALSE(text->files[0].messages.empty());
    CHECK(text->files[0].file->line_count() == 6);

    write_text(folder / "plant.lsys", "#n = 1;\n#w : F;\n#p : F : * : F F;\n");
    static_cast<void>(run_lsc({"compile", folder / "plant.lsys", "-o", folder / "plant.lsb"}, ""));
    const auto compiled = source_of(folder / "plant.lsb");
    CHECK(compiled->files.empty());
    CHECK(compiled->failure == "`" + folder / "plant.lsb" + "`: is compiled, so it has no source");
}

TEST_CASE("messages are wrapped at blanks, and tabs become blanks") {
    const TextLine line{{TextColour::Red, "error: "},
                        {TextColour::Bold, "unknown name `spred`"},
                        {TextColour::Plain, " [unknown-name]"}};
    CHECK(texts_of(wrapped(line, 80)) ==
          std::vector<std::string>{"error: unknown name `spred` [unknown-name]"});
    CHECK(texts_of(wrapped(line, 20)) ==
          std::vector<std::string>{"error: unknown name ", "`spred` ", "[unknown-name]"});
    CHECK(texts_of(wrapped({{TextColour::Plain, "abcdefgh"}}, 3)) ==
          std::vector<std::string>{"abc", "def", "gh"});
    CHECK(expanded("\ta\tb", 0) == "    a   b");
    CHECK(expanded("\ta", 3) == " a");
}
