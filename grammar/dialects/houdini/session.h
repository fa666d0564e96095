// SPDX-License-Identifier: MIT
// The state of one parse of a Houdini rule text, shared by scanner, parser and writer.
#pragma once

#include "grammar/base/contract.h"
#include "grammar/dialects/impl/foreign_expression.h"
#include "grammar/lsys/parse.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

struct HoudiniModule {
    SourceSpan symbol;
    SourceSpan parentheses;           // place of the parentheses with their contents; empty: none
    std::vector<ForeignId> arguments; // omitted ones are ForeignKind::Missing
};

/// A line `key: value`.
struct HoudiniSetting {
    SourceSpan key;
    SourceSpan value;
};

/// `left<predecessor>right:condition=successor:probability`
struct HoudiniRule {
    std::vector<HoudiniModule> left;
    std::vector<HoudiniModule> predecessor;
    std::vector<HoudiniModule> right;
    std::vector<HoudiniModule> successor;
    ForeignId condition = kNoForeign;
    ForeignId probability = kNoForeign;
    std::uint32_t first_node = 0; // nodes of the line: [first_node, end_node) of the session
    std::uint32_t end_node = 0;
    SourceSpan span;
    std::vector<std::string_view> formals; // names of parameters of the head, sorted

    /// Left context, predecessor and right context.
    [[nodiscard]] std::array<const std::vector<HoudiniModule>*, 3> head() const {
        return {&left, &predecessor, &right};
    }
};

class HoudiniSession {
public:
    HoudiniSession(FileId file, const ParseContext& parse_context);

    const ParseContext& context;
    std::vector<HoudiniSetting> settings;
    ForeignExpressions nodes;
    std::vector<HoudiniRule> rules;
    std::vector<HoudiniModule> premise; // empty: none
    SourceSpan premise_span;

    [[nodiscard]] const ForeignNode& node(ForeignId id) const { return nodes[id]; }

    // For the scanner.
    /// Consumes the next `length` bytes as the last match; returns their span.
    SourceSpan take(std::uint32_t length);
    /// Puts the last `length` bytes of the last match back.
    void put_back(std::uint32_t length);
    /// Place of the last match.
    [[nodiscard]] SourceSpan last() const { return last_; }
    /// The token of a line's first word; 0 if the word is not a key. `text` includes the blanks
    /// after the word.
    int key_token(std::string_view text);
    /// key_token() of a line that can only be a setting: an unknown key is one, too.
    int any_key_token(std::string_view text);
    /// Bytes of `text` without the blanks at its end.
    [[nodiscard]] static std::uint32_t length_of_key(std::string_view text);
    [[nodiscard]] bool wants_modules() const { return wants_modules_; }
    /// Opens a parenthesis.
    void open() { ++depth_; }
    /// Closes a parenthesis; returns true if it was the outermost one in a list of modules.
    bool close();
    void begin_condition() { in_condition_ = true; } // condition or probability of a rule
    /// Ends the condition or probability at a `=` outside of parentheses; returns true if modules
    /// follow.
    bool end_condition();
    /// Forgets what the line has opened: parentheses, a condition or probability.
    void end_line();

    // For the parser.
    /// Adds a node with the text of `token`.
    ForeignId
    add_node(ForeignKind kind, SourceSpan token, std::vector<ForeignId> parts, SourceSpan span);
    /// Reports parentheses that are nested too deep.
    void check_nesting(SourceSpan span) const;
    void add_premise(std::vector<HoudiniModule> modules, SourceSpan span);
    /// Adds a rule; sets its nodes, span and formals.
    void add_rule(HoudiniRule rule, SourceSpan span);
    /// Leaves out the nodes of a line with an error.
    void forget_rule();

private:
    FileId file_;
    std::uint32_t size_ = 0;      // bytes of the file
    std::uint32_t at_ = 0;        // offset of the next match
    SourceSpan last_;             // place of the last match
    std::uint32_t depth_ = 0;     // open parentheses
    bool in_condition_ = false;   // in a condition or probability
    bool wants_modules_ = false;  // modules follow the key of the line
    std::uint32_t line_node_ = 0; // first node of the line
};

/// The letters of a key in lower case, without other characters.
[[nodiscard]] std::string houdini_key(std::string_view text);

/// One pass of the scanner over a text.
class HoudiniScanning {
public:
    HoudiniScanning(HoudiniSession& session, std::string_view text);
    ~HoudiniScanning();
    HoudiniScanning(const HoudiniScanning&) = delete;
    HoudiniScanning& operator=(const HoudiniScanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys
