// One parse of a Fractint collection, or of one of its entries: what scanner, parser and writer
// share.
#pragma once

#include "grammar/base/contract.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// `name { ... }`
struct FractintEntry {
    SourceSpan name; // empty: it has none
    SourceSpan body; // between the braces
};

enum class FractintLineKind : std::uint8_t { Axiom, Angle, Rule };

/// A line of an entry.
struct FractintLine {
    FractintLineKind kind{};
    SourceSpan key;
    std::vector<SourceSpan> texts; // words and `=`, in order
};

class FractintSession {
public:
    /// Lists the entries of `file`.
    FractintSession(FileId file, const ParseContext& parse_context);
    /// Reads what stands between the braces of an entry.
    FractintSession(const FractintEntry& entry, const ParseContext& parse_context);

    const ParseContext& context;
    std::vector<FractintEntry> entries;
    std::vector<FractintLine> lines;

    void parse(std::string_view text);

    /// Where the next `length` bytes stand.
    SourceSpan take(std::uint32_t length) {
        at_ += length;
        return {file_, at_ - length, at_};
    }
    /// Gives the end of what was taken last back.
    void untake(std::uint32_t length) { at_ -= length; }
    /// The token that tells the parser what is read, once; then 0.
    int start_token();
    /// The token at the end: the end of a line, then that of the file.
    int end_token();

    void see_word(SourceSpan word);
    void end_line();
    void add_block(SourceSpan body);
    void begin_line(FractintLineKind kind, SourceSpan key) { lines.push_back({kind, key, {}}); }
    void add_text(SourceSpan text) { lines.back().texts.push_back(text); }

private:
    FileId file_;
    std::uint32_t at_ = 0;
    bool is_entry_ = false;
    bool started_ = false;
    bool ended_ = false;
    SourceSpan name_;         // what a `{` would be the block of
    std::uint32_t words_ = 0; // of this line, outside of blocks
};

/// One pass of the scanner over a text.
class FractintScanning {
public:
    FractintScanning(FractintSession& session, std::string_view text);
    ~FractintScanning();
    FractintScanning(const FractintScanning&) = delete;
    FractintScanning& operator=(const FractintScanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys

int fractint_yylex(lsys::SourceSpan* location, lsys::FractintSession& session, void* yyscanner);
