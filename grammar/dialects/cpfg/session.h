// The state of one parse of a cpfg file, shared by scanner, parser and writer. Nodes lie in
// vectors, children before parents.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/contract.h"
#include "grammar/base/stage.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class CpfgKind : std::uint8_t {
    Number,
    Name,
    String,
    Unary,   // text: the operator
    Binary,  // text: the operator
    Choose,  // a ? b : c
    Call,    // text: the function
    Index,   // text: the array
    Address, // &name
};

struct CpfgExpression {
    CpfgKind kind = CpfgKind::Number;
    std::string text;
    std::vector<int> parts; // in CpfgSession::expressions
    SourceSpan span;
    int depth = 1; // of nested expressions
};

enum class CpfgStatementKind : std::uint8_t { Assign, Call, If, Loop, Array };

struct CpfgStatement {
    CpfgStatementKind kind = CpfgStatementKind::Call;
    int target = -1;        // Assign: a Name or Index. Array: an Index
    int value = -1;         // Assign, Call; the condition of If
    std::vector<int> block; // statements of If; values of Array
    std::vector<int> otherwise;
    SourceSpan span;
    int depth = 1;
};

struct CpfgModule {
    std::string name;
    SourceSpan span; // of the name
    bool has_arguments = false;
    std::vector<int> arguments;
};

/// A production. Missing parts are empty lists or -1.
struct CpfgProduction {
    Stage stage = Stage::Rewrite;
    std::vector<CpfgModule> left;
    std::vector<CpfgModule> predecessor;
    std::vector<CpfgModule> right;
    std::vector<int> before; // statements
    int condition = -1;      // none: always
    std::vector<int> after;
    std::vector<CpfgModule> successor;
    int weight = -1;
    SourceSpan span; // of the predecessor
    SourceSpan arrow;
};

class CpfgSession {
public:
    CpfgSession(const Translation& preprocessed, const ParseContext& parse_context)
        : context(parse_context), text(preprocessed) {}

    const ParseContext& context;
    const Translation& text;

    std::vector<CpfgExpression> expressions;
    std::vector<CpfgStatement> statements;
    std::vector<CpfgProduction> productions;
    std::vector<CpfgModule> axiom;
    std::optional<SourceSpan> axiom_span;
    std::vector<CpfgModule> ignored;
    std::vector<CpfgModule> considered;
    bool ignores = false;
    bool considers = false;
    int derivation_length = -1;
    int seed = -1;
    int decompose_depth = -1;
    int interpret_depth = -1;
    std::vector<int> definitions; // statements
    std::vector<int> start;
    std::vector<int> start_each;
    std::vector<int> end_each;
    std::vector<int> end;
    Stage stage = Stage::Rewrite; // of the productions that are being read
    int systems = 0;

    // --- for the scanner
    enum class Mode : std::uint8_t { Line, Symbols, Expression };
    Mode mode = Mode::Line;
    int nesting = 0; // brackets open in an expression
    // In the arguments of a module; the `)` that closes them ends Mode::Expression.
    bool in_arguments = false;
    bool label = false; // in the label `Lsystem: 1`

    /// The place of the next `length` bytes.
    SourceSpan take(std::uint32_t length) {
        at_ += length;
        return text.origin(at_ - length, at_);
    }
    /// Puts the last `length` bytes back, to be read again.
    void put_back(std::uint32_t length) { at_ -= length; }

    // --- for the parser
    /// Adds a node; reports and drops nesting beyond the limit.
    int add(CpfgExpression expression);
    int add(CpfgStatement statement);
    void report_unsupported(SourceSpan span, std::string message) const {
        context.diagnostics.add(DiagnosticCode::ForeignFeature, span, std::move(message));
    }
    void production(CpfgProduction made);
    void begin_system(SourceSpan label_span);

private:
    std::uint32_t at_ = 0;
};

/// One pass of the scanner over a text.
class CpfgScanning {
public:
    CpfgScanning(CpfgSession& session, std::string_view text);
    ~CpfgScanning();
    CpfgScanning(const CpfgScanning&) = delete;
    CpfgScanning& operator=(const CpfgScanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys
