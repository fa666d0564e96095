// SPDX-License-Identifier: MIT
// Pieces of lines, their places, and the reports about unexpected pieces.
#include "grammar/base/names.h"
#include "grammar/dialects/impl/line_reader.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using namespace lsys;

std::size_t word_length(std::string_view ahead) {
    return std::min(ahead.find_first_of(std::string_view(" \n=;#\0", 6)), ahead.size());
}

/// A text and a reader of it.
struct Read {
    Read(std::string text, const LineFormat& format)
        : file(sources.add("list", std::move(text))),
          reader(whole_file(file, context), format, context) {}

    /// Pieces to the end; `|` is the end of a line, `.` the end of the text.
    std::string all() {
        std::string text;
        while (true) {
            const LinePiece piece = reader.next(word_length);
            CHECK(sources.text(piece.span) == piece.text);
            if (piece.kind == LinePieceKind::TextEnd) {
                return text + ".";
            }
            text += piece.kind == LinePieceKind::LineEnd ? "|" : std::string(piece.text) + ",";
        }
    }

    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    FileLoader load = [](const std::string&) -> Result<std::string> { return Error{"no file"}; };
    ParseContext context{sources, names, diagnostics, load};
    FileId file;
    LineReader reader;
};

} // namespace

TEST_CASE("a line consists of words and single characters") {
    CHECK(Read("a b=c", {" "}).all() == "a,b,=,c,|.");
    CHECK(Read("a\nb\n", {" "}).all() == "a,|b,||.");
    CHECK(Read("", {" "}).all() == "|.");
    CHECK(Read(std::string("a\0\0b", 4), {" "}).all() == std::string("a,\0,\0,b,|.", 10));
}

TEST_CASE("the end of a line covers the blank lines behind it") {
    Read read("a\n \n\n  b", {" "});
    CHECK(read.reader.next(word_length).text == "a");
    const LinePiece end = read.reader.next(word_length);
    CHECK(end.kind == LinePieceKind::LineEnd);
    CHECK(end.span == SourceSpan{read.file, 1, 5});
    CHECK(read.reader.next(word_length).span == SourceSpan{read.file, 7, 8});
    const LinePiece last = read.reader.next(word_length);
    CHECK(last.kind == LinePieceKind::LineEnd);
    CHECK(last.span == SourceSpan{read.file, 8, 8});
}

TEST_CASE("a comment begins only where a piece could begin") {
    CHECK(Read("a ;b\n;c\nd", {" ", ';', false}).all() == "a,||d,|.");
    const std::string text("#a\0b\nc", 6);
    CHECK(Read(text, {" ", '#', true}).all() == "|c,|.");
    CHECK(Read(text, {" ", '#', false}).all() == std::string("\0,b,|c,|.", 9));
}

TEST_CASE("if line ends do not count, a text is a sequence of pieces") {
    CHECK(Read("a\n b\n", {" \n"}).all() == "a,b,.");
    Read read("a= b", {" \n"});
    CHECK(read.reader.take(1).text == "a");
    CHECK(read.reader.rest() == "= b");
    CHECK(read.reader.take(1).text == "=");
    CHECK(read.reader.rest() == " b");
    CHECK(read.reader.ahead() == "b");
}

TEST_CASE("an unexpected piece is reported, and its line is skipped") {
    Read read("a = b\nc", {" "});
    CHECK(read.reader.next(word_length).text == "a");
    read.reader.expect(false, read.reader.next(word_length), {"a word", "the end of the line"});
    REQUIRE(read.diagnostics.all().size() == 1);
    CHECK(read.diagnostics.all()[0].message == "expected a word or the end of the line, found `=`");
    CHECK(read.diagnostics.all()[0].span == SourceSpan{read.file, 2, 3});
    CHECK(read.reader.next(word_length).text == "c");
    read.reader.expect(false, read.reader.next(word_length), {"a word"});
    CHECK(read.diagnostics.all()[1].message == "expected a word, found the end of the line");
    const LinePiece end = read.reader.next(word_length);
    CHECK(end.kind == LinePieceKind::TextEnd);
    read.reader.expect(false, end, {"a word"});
    CHECK(read.diagnostics.all()[2].message == "expected a word, found the end of the file");
}

TEST_CASE("an unexpected piece ends its line, also if line ends do not count") {
    Read read("a = b\n c", {" \n"});
    CHECK(read.reader.next(word_length).text == "a");
    CHECK(!read.reader.expect(false, read.reader.next(word_length), {"a word"}));
    CHECK(read.reader.next(word_length).text == "c");
    CHECK(read.reader.next(word_length).kind == LinePieceKind::TextEnd);
}

TEST_CASE("a part of a file is read with places of the file") {
    Read read("x { a } y", {" "});
    LineReader inner({read.file, 3, 5}, {" "}, read.context);
    CHECK(inner.next(word_length).span == SourceSpan{read.file, 4, 5});
    CHECK(inner.next(word_length).kind == LinePieceKind::LineEnd);
    CHECK(inner.next(word_length).kind == LinePieceKind::TextEnd);
}
