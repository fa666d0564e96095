// One parse of a .rules file: what scanner, parser and writer share.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/contract.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

/// A line `key: value`. The spans hold no blanks around them.
struct CareySetting {
    SourceSpan key;
    SourceSpan value;
};

/// A line `left=right:ratio`.
struct CareyRule {
    SourceSpan left;
    SourceSpan right; // empty: the rule erases
    std::optional<SourceSpan> ratio;
};

class CareySession {
public:
    CareySession(FileId file, const ParseContext& parse_context)
        : context(parse_context), file_(file) {}

    const ParseContext& context;
    std::vector<CareySetting> settings;
    std::vector<CareyRule> rules;

    /// Where the next `length` bytes stand.
    SourceSpan take(std::uint32_t length) {
        at_ += length;
        return {file_, at_ - length, at_};
    }
    /// Reports a line with a `:` that has no `=` before it; `is_rule`: it has one behind.
    void no_equals(SourceSpan name, SourceSpan colon, bool is_rule) const;
    /// The token at the end: a line's end, if the last line has none, then the file's.
    int at_end();

private:
    FileId file_;
    std::uint32_t at_ = 0;
    bool ended_ = false;
};

/// One pass of the scanner over a text.
class CareyScanning {
public:
    CareyScanning(CareySession& session, std::string_view text);
    ~CareyScanning();
    CareyScanning(const CareyScanning&) = delete;
    CareyScanning& operator=(const CareyScanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys

int carey_yylex(lsys::SourceSpan* location, lsys::CareySession& session, void* yyscanner);
