#include "grammar/dialects/impl/syntax_message.h"

#include "grammar/ast/reports.h"

namespace lsys {

void SyntaxMessage::add_expected(std::string_view token) {
    if (count_++ != 0) {
        expected_ += expected_.empty() ? last_ : ", " + last_;
    }
    last_ = token;
}

void SyntaxMessage::report(std::string_view saw) {
    constexpr int kMaxNamed = 5;
    std::string message;
    if (count_ != 0 && count_ <= kMaxNamed) {
        message = "expected " + expected_ + (expected_.empty() ? "" : " or ") + last_ + ", saw ";
    } else {
        message = "did not expect ";
    }
    const std::string_view text = context_.sources.text(place_);
    const bool is_text = place_.begin != place_.end && text.find('\n') == std::string_view::npos;
    message += is_text ? "`" + shown(text) + "`" : std::string(saw);
    context_.diagnostics.add(DiagnosticCode::ForeignSyntax, place_, message);
}

} // namespace lsys
