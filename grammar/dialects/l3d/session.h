// One parse of a file of L3D: what scanner, parser and writer share.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/contract.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

/// A line `key=value`, both as they stand.
struct L3dRule {
    SourceSpan key;   // without the `=`
    SourceSpan value; // to the end of the line
};

class L3dSession {
public:
    L3dSession(FileId file, const ParseContext& parse_context)
        : context(parse_context), file_(file) {}

    const ParseContext& context;
    std::vector<SourceSpan> numbers; // three
    std::vector<SourceSpan> axioms;  // the last one counts
    std::vector<L3dRule> rules;
    std::optional<SourceSpan> mark; // the `@`
    bool in_value = false;          // of the scanner: a `=` has been seen

    /// Where the next `length` bytes stand.
    SourceSpan take(std::uint32_t length) {
        at_ += length;
        return {file_, at_ - length, at_};
    }
    void rule(SourceSpan key_and_equals, SourceSpan value) {
        rules.push_back(
            {{key_and_equals.file, key_and_equals.begin, key_and_equals.end - 1}, value});
    }

private:
    FileId file_;
    std::uint32_t at_ = 0;
};

/// One pass of the scanner over a text.
class L3dScanning {
public:
    L3dScanning(L3dSession& session, std::string_view text);
    ~L3dScanning();
    L3dScanning(const L3dScanning&) = delete;
    L3dScanning& operator=(const L3dScanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys

int l3d_yylex(lsys::SourceSpan* location, lsys::L3dSession& session, void* yyscanner);
