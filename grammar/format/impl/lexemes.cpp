// SPDX-License-Identifier: MIT
#include "grammar/format/impl/lexemes.h"

#include "grammar/base/characters.h"
#include "grammar/base/local_values.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace lsys {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

} // namespace

bool LexemeReader::next(Lexeme& lexeme) {
    if (!skip_blanks()) {
        return false;
    }
    const char c = text_[at_];
    if (c == '/' && starts('/', '*')) {
        const std::size_t end = text_.find("*/", at_ + 2);
        take(LexemeKind::BlockComment, end == text_.npos ? bytes_left() : end + 2 - at_);
    } else if (c == '/' && area_ == Area::Between && starts('/', '/')) {
        read_line_comment();
    } else if (c == '#') {
        read_keyword();
    } else if (c == ';') {
        take(LexemeKind::Semicolon, 1);
        area_ = Area::Between;
    } else if (c == ':' && depth_ == 0) {
        take(LexemeKind::Colon, 1);
        enter_next_part();
    } else {
        read_token();
    }
    lexeme = lexeme_;
    return true;
}

bool LexemeReader::skip_blanks() {
    newlines_ = 0;
    std::size_t at = at_;
    for (; at < text_.size() && is_blank(text_[at]); ++at) {
        newlines_ += text_[at] == '\n' ? 1U : 0U;
    }
    blank_ = at > at_;
    at_ = at;
    return at < text_.size();
}

void LexemeReader::take(LexemeKind kind, std::size_t length) {
    lexeme_ = {kind, text_.substr(at_, length), newlines_, blank_, false, false, false};
    at_ += length;
    if (kind != LexemeKind::BlockComment) {
        previous_ = kind;
    }
}

void LexemeReader::read_line_comment() {
    std::size_t length = std::min(text_.find('\n', at_), text_.size()) - at_;
    while (length > 2 && is_blank(text_[at_ + length - 1])) {
        --length;
    }
    take(LexemeKind::LineComment, length);
}

std::size_t LexemeReader::word_length(std::size_t from) const {
    std::size_t end = from;
    while (end < text_.size() && is_word_character(text_[end])) {
        ++end;
    }
    return end - from;
}

void LexemeReader::read_keyword() {
    using enum StatementShape;
    const std::string_view name = text_.substr(at_ + 1, word_length(at_ + 1));
    take(LexemeKind::Keyword, name.size() + 1);
    depth_ = 0;
    part_ = 0;
    has_locals_ = false;
    in_probability_ = false;
    in_formals_ = false;
    after_value_ = false;
    const char next = next_character();
    if (name == "w" || name == "ignore" || name == "consider") {
        shape_ = List;
        in_probability_ = next == '~';
        area_ = in_probability_ ? Area::Expression : Area::Modules;
    } else if (next == ':' || name == "decompose" || name == "interpret" || name == "down" ||
               name == "up") {
        shape_ = Production;
        area_ = Area::Modules;
        part_ = 1;
    } else if (name == "module") {
        shape_ = Declaration;
        area_ = Area::Modules;
    } else if (name == "object" || name == "include") {
        shape_ = name == "include" && next == '"' ? Other : Declaration;
        area_ = Area::Object;
    } else if (name == "set" || name == "curve" || name == "contour" || name == "material" ||
               name == "sense") {
        shape_ = name == "material" || name == "sense" ? Keyed : Setting;
        area_ = Area::Set;
    } else if (name == "function") {
        shape_ = Other;
        area_ = Area::Name;
        in_formals_ = true;
    } else if (name == "define" || name == "param") {
        shape_ = Definition;
        area_ = Area::Name;
    } else {
        shape_ = Other;
        area_ = Area::Expression;
    }
}

char LexemeReader::next_character() const {
    std::size_t at = at_;
    while (at < text_.size()) {
        if (is_blank(text_[at])) {
            ++at;
        } else if (text_.substr(at).starts_with("/*")) {
            const std::size_t end = text_.find("*/", at + 2);
            at = end == text_.npos ? text_.size() : end + 2;
        } else {
            return text_[at];
        }
    }
    return '\0';
}

void LexemeReader::enter_next_part() {
    if (in_probability_) { // the modules of the axiom follow the probability
        in_probability_ = false;
        area_ = Area::Modules;
        after_value_ = false;
    }
    if (part_ == 0) {
        return;
    }
    // Local values stand between colons of their own, but count as part 3.
    const bool has_locals = part_ == 3 && !has_locals_ && begins_local_values(text_, at_);
    has_locals_ = has_locals_ || has_locals;
    part_ += has_locals ? 0U : 1U;
    area_ = part_ == 3 ? Area::Expression : Area::Modules;
    lexeme_.ends_head = part_ == 4;
    after_value_ = false;
}

void LexemeReader::read_token() {
    if (area_ == Area::Modules && depth_ == 0) {
        read_module();
    } else if ((area_ == Area::Object || (area_ == Area::Set && text_[at_] == '"')) &&
               depth_ == 0) {
        read_quoted();
    } else {
        read_expression();
    }
}

/// A file name or a module; a single `"` is a module.
void LexemeReader::read_quoted() {
    const std::size_t end = text_[at_] == '"' ? text_.find_first_of("\"\n", at_ + 1) : text_.npos;
    if (end != text_.npos && text_[end] == '"') {
        take(LexemeKind::Quoted, end + 1 - at_);
    } else {
        read_module();
    }
}

void LexemeReader::read_module() {
    const char c = text_[at_];
    if (is_letter(c)) {
        take(LexemeKind::Module, word_length(at_));
    } else if (c == '?' && bytes_left() > 1 && is_letter(text_[at_ + 1])) {
        take(LexemeKind::Module, 1 + word_length(at_ + 1));
    } else if (c == '`') {
        // Adjacent quoted names are one text, or modules that must stay adjacent.
        std::size_t end = text_.find('`', at_ + 1);
        while (end != text_.npos && end + 1 < text_.size() && text_[end + 1] == '`') {
            end = text_.find('`', end + 2);
        }
        take(LexemeKind::Module, end == text_.npos ? bytes_left() : end + 1 - at_);
    } else if (c == '(') {
        take(LexemeKind::Open, 1);
        depth_ = 1;
        after_value_ = false;
    } else if (c == '<' || c == '>') {
        take(LexemeKind::Context, 1);
    } else {
        take(LexemeKind::Module, 1);
    }
}

void LexemeReader::read_value(LexemeKind kind, std::size_t length) {
    take(kind, length);
    // After a value of `#set` and after the name of a constant comes a value, not an operator.
    after_value_ = !(area_ == Area::Set && depth_ == 0) && (area_ != Area::Name || in_formals_);
    if (area_ == Area::Name) {
        area_ = Area::Expression;
    }
}

void LexemeReader::read_expression() {
    const char c = text_[at_];
    if (is_letter(c)) {
        read_value(LexemeKind::Word, word_length(at_));
    } else if (is_digit(c) || c == '.') {
        read_value(LexemeKind::Number, number_length());
    } else if (c == '(' || c == '{') {
        const bool call = c == '(' && after_value_ && previous_ == LexemeKind::Word;
        const bool bounds = c == '{' && after_value_ && depth_ == 0;
        take(LexemeKind::Left, 1);
        lexeme_.opens_call = call;
        lexeme_.opens_bounds = bounds;
        ++depth_;
        after_value_ = false;
    } else if (c == ')' || c == '}') {
        // At depth 1 in a list of modules the `)` closes the arguments of a module.
        const bool module = depth_ == 1 && (area_ == Area::Modules || area_ == Area::Object);
        take(module ? LexemeKind::Close : LexemeKind::Right, 1);
        depth_ -= depth_ > 0 ? 1U : 0U;
        const bool ends_formals = in_formals_ && depth_ == 0;
        in_formals_ = in_formals_ && !ends_formals;
        after_value_ = !(area_ == Area::Set && depth_ == 0) && !ends_formals;
    } else if (c == ',') {
        take(LexemeKind::Comma, 1);
        after_value_ = false;
    } else {
        read_operation();
    }
}

std::size_t LexemeReader::number_length() const {
    std::size_t end = at_;
    const auto digits = [&] {
        while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.')) {
            ++end;
        }
    };
    digits();
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
        std::size_t exponent = end + 1;
        if (exponent < text_.size() && (text_[exponent] == '+' || text_[exponent] == '-')) {
            ++exponent;
        }
        if (exponent < text_.size() && is_digit(text_[exponent])) {
            end = exponent;
            digits();
        }
    }
    return end - at_;
}

void LexemeReader::read_operation() {
    const char c = text_[at_];
    const bool is_comparison = (c == '=' || c == '!' || c == '<' || c == '>') && starts(c, '=');
    if (is_comparison || ((c == '&' || c == '|') && starts(c, c))) {
        take(LexemeKind::Operator, 2);
        after_value_ = false;
        return;
    }
    const bool is_unary = !after_value_ && (c == '-' || c == '!');
    const bool is_any = !after_value_ && c == '*';
    take(is_unary ? LexemeKind::Unary : is_any ? LexemeKind::Any : LexemeKind::Operator, 1);
    after_value_ = is_any; // `~` may follow
}

std::vector<Lexeme> lexemes_of(std::string_view text) {
    std::vector<Lexeme> lexemes;
    LexemeReader reader(text, 0);
    for (Lexeme lexeme; reader.next(lexeme);) {
        lexemes.push_back(lexeme);
    }
    return lexemes;
}

} // namespace lsys
