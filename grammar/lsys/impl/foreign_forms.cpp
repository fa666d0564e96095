// SPDX-License-Identifier: MIT
#include "grammar/base/characters.h"
#include "grammar/lsys/impl/statement_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace lsys::lsys_grammar {

StatementRepair::StatementRepair(DraftText& draft, StatementText statement)
    : draft_(draft), statement_(statement) {
    const std::size_t word = text().find_first_not_of(" \t", statement.begin + 1);
    word_ = leading_word(text().substr(word));
    body_ = word + word_.size();
    keyword_ = find_keyword(word_);
    // Before a `:`, a keyword is the name of a production, except in `#w :` and lists of names.
    const bool takes_colon =
        keyword_ == Keyword::Axiom || keyword_ == Keyword::Ignore || keyword_ == Keyword::Consider;
    const std::size_t next = skip_gaps(text(), body_);
    if (!takes_colon && next < statement_.end && char_at(next) == ':') {
        keyword_ = Keyword::Label;
    }
}

namespace {

constexpr std::size_t kMaxStatement = 4096; // bytes; longer statements are not searched

} // namespace

std::size_t StatementRepair::repair() {
    const bool has_ended = statement_.end < text().size() && char_at(statement_.end) == ';';
    const std::size_t next = statement_.end + (has_ended ? 1 : 0);
    if (statement_.end - statement_.begin > kMaxStatement) {
        return next;
    }
    switch (keyword_) {
    case Keyword::Function:
        return repair_function();
    case Keyword::Curve:
    case Keyword::Contour:
        repair_curve();
        break;
    case Keyword::Set:
        repair_setting();
        break;
    case Keyword::Object:
        repair_object();
        break;
    case Keyword::Include:
        repair_include();
        break;
    case Keyword::Define:
    case Keyword::Param:
        constant();
        break;
    case Keyword::Axiom:
        choices();
        timed_modules();
        break;
    case Keyword::Label:
    case Keyword::Decompose:
    case Keyword::Interpret:
    case Keyword::Down:
    case Keyword::Up:
        return production();
    default:
        break;
    }
    return next;
}

void StatementRepair::leave_out() {
    draft_.blank(statement_.begin, after());
    draft_.is_incomplete = true;
}

namespace {

/// Repairs `#6b4423` at `at` after the key `colour`: three numbers from 0 to 1 are meant.
void repair_hexadecimal_colour(DraftText& draft, std::size_t at) {
    constexpr std::size_t kDigits = 6;
    // Searches backwards from `at`: the masked comments before the first statement may be long.
    const std::size_t last =
        at == 0 ? std::string::npos : draft.masked.find_last_not_of(kWhitespace, at - 1);
    const std::string_view before =
        std::string_view(draft.masked).substr(0, last == std::string::npos ? 0 : last + 1);
    const std::string_view digits = std::string_view(draft.masked).substr(at + 1, kDigits);
    const std::size_t end = at + 1 + kDigits;
    unsigned value = 0;
    const auto [stop, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (!(before.ends_with("colour") || before.ends_with("color")) || digits.size() < kDigits ||
        error != std::errc() || stop != digits.data() + kDigits ||
        (end < draft.masked.size() && is_word_character(draft.masked[end]))) {
        return;
    }
    const auto part = [value](unsigned shift) { return (value >> shift & 0xFFU) / 255.0; };
    const std::string numbers = fmt::format("{:.2g} {:.2g} {:.2g}", part(16), part(8), part(0));
    const SourceSpan place = draft.span(at, end);
    Diagnostic& diagnostic = draft.report(DiagnosticCode::ForeignForm, place,
                                          "a colour is three numbers from 0 to 1, not hexadecimal");
    add_fix(diagnostic, "write `" + numbers + "`", place, numbers, false);
    draft.replace(at, end, "0 0 0");
}

} // namespace

void repair_foreign_forms(DraftText& draft) {
    if (draft.is_changed) {
        draft.mask();
    }
    for (std::size_t at = draft.masked.find('#'); at != std::string::npos;
         at = draft.masked.find('#', at + 1)) {
        repair_hexadecimal_colour(draft, at);
    }
    for (std::size_t at = draft.masked.find('#'); at != std::string::npos;
         at = draft.masked.find('#', at)) {
        const std::string_view text = draft.masked;
        at = is_statement_start(text, at)
                 ? std::max(at + 1, StatementRepair(draft, statement_at(text, at)).repair())
                 : at + 1;
    }
}

} // namespace lsys::lsys_grammar
