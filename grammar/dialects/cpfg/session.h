// SPDX-License-Identifier: MIT
// The state of one parse of a cpfg file, shared by scanner, parser and writer. Statements lie in a
// vector, children before parents.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/contract.h"
#include "grammar/base/stage.h"
#include "grammar/dialects/impl/foreign_expression.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class CpfgStatementKind : std::uint8_t { Assign, Call, If, Loop, Array };

struct CpfgStatement {
    CpfgStatementKind kind = CpfgStatementKind::Call;
    ForeignId target = kNoForeign;   // Assign: a Name or Index. Array: an Index
    ForeignId value = kNoForeign;    // Assign, Call; the condition of If and Loop
    std::vector<int> block{};        // If, Loop: indices in CpfgSession::statements
    std::vector<int> otherwise{};    // If: indices of the statements after the `else`
    std::vector<ForeignId> values{}; // Array: initial values
    bool tests_last = false;         // Loop: do { block } while (value);
    SourceSpan span{};
    int depth = 1; // levels of statements within statements
};

struct CpfgModule {
    std::string name;
    SourceSpan span; // place of the name
    bool has_arguments = false;
    std::vector<ForeignId> arguments;
};

/// A production. Missing parts are empty lists or kNoForeign.
struct CpfgProduction {
    Stage stage = Stage::Rewrite;
    std::vector<CpfgModule> left;
    std::vector<CpfgModule> predecessor;
    std::vector<CpfgModule> right;
    std::vector<int> before;          // indices in CpfgSession::statements, before the condition
    ForeignId condition = kNoForeign; // kNoForeign: always holds
    std::vector<int> after;           // indices in CpfgSession::statements, after the condition
    std::vector<CpfgModule> successor;
    ForeignId weight = kNoForeign;
    SourceSpan span; // place of the predecessor
    SourceSpan arrow;
};

class CpfgSession {
public:
    CpfgSession(const Translation& preprocessed, const ParseContext& parse_context)
        : context(parse_context), text(preprocessed) {}

    const ParseContext& context;
    const Translation& text;

    ForeignExpressions expressions;
    std::vector<CpfgStatement> statements;
    std::vector<CpfgProduction> productions;
    std::vector<CpfgModule> axiom;
    std::optional<SourceSpan> axiom_span;
    std::optional<SourceSpan> ring; // `ring Lsystem`: the first module is next to the last one
    std::vector<CpfgModule> ignored;
    std::vector<CpfgModule> considered;
    bool ignores = false;   // there is a statement `ignore:`
    bool considers = false; // there is a statement `consider:`
    ForeignId derivation_length = kNoForeign;
    ForeignId seed = kNoForeign;
    ForeignId decompose_depth = kNoForeign;
    ForeignId interpret_depth = kNoForeign;
    // Indices in `statements` of the statements in the blocks `Define:`, `Start:`, `StartEach:`,
    // `EndEach:` and `End:`.
    std::vector<int> definitions;
    std::vector<int> start;
    std::vector<int> start_each;
    std::vector<int> end_each;
    std::vector<int> end;
    Stage stage = Stage::Rewrite; // stage of the productions being read
    int systems = 0;              // number of labels `Lsystem:` read

    // --- for the scanner
    /// The text at the current place: the begin of a line, modules, or an expression or statement.
    enum class Mode : std::uint8_t { Line, Symbols, Expression };
    Mode mode = Mode::Line;
    int nesting = 0; // brackets open in an expression
    // True in the arguments of a module; the `)` that closes them ends Mode::Expression.
    bool in_arguments = false;
    bool in_label = false; // whether the scanner is in the label `Lsystem: 1`

    /// Sets where in `text` the scanner begins.
    void begin_at(std::uint32_t place) { at_ = place; }
    /// Consumes the next `length` bytes; returns their span.
    SourceSpan take(std::uint32_t length) {
        at_ += length;
        return text.origin(at_ - length, at_);
    }
    /// Puts the last `length` bytes back, to be read again.
    void put_back(std::uint32_t length) { at_ -= length; }

    // --- for the parser
    /// Adds a node; reports and drops nesting beyond the limit.
    ForeignId add(ForeignNode expression);
    /// Adds a statement; reports nesting beyond the limit. Returns its index in `statements`.
    int add(CpfgStatement statement);
    void report_unsupported(SourceSpan span, std::string message) const {
        context.diagnostics.add(DiagnosticCode::ForeignFeature, span, std::move(message));
    }
    /// Adds a production of the current stage.
    void production(CpfgProduction new_production);
    void begin_system() { ++systems; }

private:
    std::uint32_t at_ = 0; // offset in `text` up to which the scanner has read
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
