// One parse of a .sys file: what scanner, parser and writer share.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/contract.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

/// A line `A R p` of the file.
struct SysRule {
    SourceSpan symbol;
    SourceSpan replacement;
    SourceSpan probability;
};

class SysSession {
public:
    SysSession(FileId file, const ParseContext& parse_context)
        : context(parse_context), file_(file) {}

    const ParseContext& context;
    std::optional<SourceSpan> count; // of the rules, as written
    std::optional<SourceSpan> axiom;
    std::vector<SysRule> rules;

    /// Where the next `length` bytes stand.
    SourceSpan take(std::uint32_t length) {
        at_ += length;
        return {file_, at_ - length, at_};
    }
    /// The token at the end: a line's end, if the last line has none, then the file's.
    int at_end();

private:
    FileId file_;
    std::uint32_t at_ = 0;
    bool ended_ = false;
};

/// One pass of the scanner over a text.
class SysScanning {
public:
    SysScanning(SysSession& session, std::string_view text);
    ~SysScanning();
    SysScanning(const SysScanning&) = delete;
    SysScanning& operator=(const SysScanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys

int sys_yylex(lsys::SourceSpan* location, lsys::SysSession& session, void* yyscanner);
