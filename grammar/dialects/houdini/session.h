// One parse of a Houdini rule text: what scanner, parser and writer share.
#pragma once

#include "grammar/base/contract.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

enum class HoudiniNodeKind : std::uint8_t {
    Number,
    Name,
    Call,    // the place is that of the name; first: the arguments
    Group,   // first, in parentheses
    Unary,   // the place is that of the operator; first
    Binary,  // the same; first and second
    Text,    // in quotes
    Missing, // an argument that is left out
};

/// A node of an expression. Others are told by index; -1: none.
struct HoudiniNode {
    HoudiniNodeKind kind{};
    SourceSpan span;
    int first = -1;
    int second = -1;
    int next = -1; // of a list of arguments
};

/// Arguments in order: a chain of nodes.
struct HoudiniArguments {
    int first = -1;
    int last = -1;
    std::uint32_t count = 0;
};

struct HoudiniModule {
    SourceSpan symbol;
    SourceSpan parentheses; // with what they hold; empty: there are none
    int arguments = -1;     // an index of HoudiniArguments
};

/// Modules [begin, end).
struct HoudiniList {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// A line `key: value`.
struct HoudiniSetting {
    SourceSpan key;
    SourceSpan value;
};

/// `left<predecessor>right:condition=successor:probability`; lists and nodes by index, -1: none.
struct HoudiniRule {
    int left = -1;
    int predecessor = -1;
    int right = -1;
    int condition = -1;
    int successor = -1;
    int probability = -1;
    std::uint32_t first_node = 0; // of the nodes of its line
    std::uint32_t end_node = 0;
    SourceSpan span;
    std::vector<std::string_view> formals; // names of parameters of the head, sorted
};

class HoudiniSession {
public:
    HoudiniSession(FileId file, const ParseContext& parse_context);

    const ParseContext& context;
    std::vector<HoudiniSetting> settings;
    std::vector<HoudiniNode> nodes;
    std::vector<HoudiniArguments> arguments;
    std::vector<HoudiniModule> modules;
    std::vector<HoudiniList> lists;
    std::vector<HoudiniRule> rules;
    int premise = -1; // a list
    SourceSpan premise_span;

    // For the scanner.
    SourceSpan take(std::uint32_t length);
    /// Gives the end of what was taken last back.
    void untake(std::uint32_t length);
    [[nodiscard]] SourceSpan last() const { return last_; }
    /// The token of a line's first word, which blanks may follow; 0: it is no key.
    int key_token(std::string_view text);
    [[nodiscard]] static std::uint32_t length_of_key(std::string_view text);
    [[nodiscard]] bool wants_modules() const { return wants_modules_; }
    void open() { ++depth_; }
    /// True: modules go on.
    bool close();
    void begin_tail() { tail_ = true; }
    /// A `=` behind a condition; true: modules follow.
    bool end_tail();
    void end_line();

    // For the parser.
    int add_node(HoudiniNodeKind kind, SourceSpan span, int first, int second);
    int add_arguments(int node);
    int extend_arguments(int list, int node);
    void add_module(SourceSpan symbol, SourceSpan parentheses, int arguments_of_it);
    int add_list(std::uint32_t modules_in_it);
    int extend_list(int list);
    void add_premise(int list, SourceSpan span);
    void begin_rule(int left, int predecessor, int right);
    void end_rule(int condition, int successor, int probability, SourceSpan span);
    void forget_rule();

private:
    void add_formals(int list);

    FileId file_;
    std::uint32_t size_ = 0;
    std::uint32_t at_ = 0;
    SourceSpan last_;
    std::uint32_t depth_ = 0; // open parentheses
    bool tail_ = false;       // in a condition or probability
    bool wants_modules_ = false;
    HoudiniRule rule_;            // that is being read
    std::uint32_t line_node_ = 0; // first node of the line
};

/// A key in one form: lower-case letters only.
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

int houdini_yylex(lsys::SourceSpan* location, lsys::HoudiniSession& session, void* yyscanner);
