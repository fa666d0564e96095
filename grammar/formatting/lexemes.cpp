#include "grammar/formatting/lexemes.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace lsys {

namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

class Lexer {
public:
    explicit Lexer(std::string_view text) : text_(text) {}

    std::vector<Lexeme> run() {
        while (skip_blanks()) {
            if (starts("/*")) {
                const std::size_t end = text_.find("*/", at_ + 2);
                take(LexemeKind::BlockComment, end == text_.npos ? rest() : end + 2 - at_);
            } else if (area_ == Area::Between && starts("//")) {
                line_comment();
            } else if (text_[at_] == '#') {
                keyword();
            } else if (text_[at_] == ';') {
                take(LexemeKind::Semicolon, 1);
                area_ = Area::Between;
            } else if (text_[at_] == ':' && depth_ == 0) {
                take(LexemeKind::Colon, 1);
                next_part();
            } else {
                token();
            }
        }
        return std::move(lexemes_);
    }

private:
    enum class Area : std::uint8_t { Between, Modules, Object, Set, Name, Expression };

    bool starts(std::string_view prefix) const { return text_.substr(at_).starts_with(prefix); }
    std::size_t rest() const { return text_.size() - at_; }

    bool skip_blanks() {
        newlines_ = 0;
        blank_ = false;
        for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) {
            blank_ = true;
            newlines_ += text_[at_] == '\n' ? 1U : 0U;
        }
        return at_ < text_.size();
    }

    void take(LexemeKind kind, std::size_t length) {
        lexemes_.push_back({kind, text_.substr(at_, length), newlines_, blank_, false});
        at_ += length;
        if (kind != LexemeKind::BlockComment) {
            previous_ = kind;
        }
    }

    void line_comment() {
        std::size_t length = std::min(text_.find('\n', at_), text_.size()) - at_;
        while (length > 2 && is_blank(text_[at_ + length - 1])) {
            --length;
        }
        take(LexemeKind::LineComment, length);
    }

    std::size_t word_length(std::size_t from) const {
        std::size_t end = from;
        while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) {
            ++end;
        }
        return end - from;
    }

    void keyword() {
        const std::string_view name = text_.substr(at_ + 1, word_length(at_ + 1));
        take(LexemeKind::Keyword, name.size() + 1);
        depth_ = 0;
        part_ = 0;
        const bool production = followed_by_colon() && name != "w" && name != "ignore";
        if (production) {
            area_ = Area::Modules;
            part_ = 1;
        } else if (name == "w" || name == "ignore" || name == "module") {
            area_ = Area::Modules;
        } else if (name == "object" || name == "include") {
            area_ = Area::Object;
        } else if (name == "set") {
            area_ = Area::Set;
        } else if (name == "define" || name == "param") {
            area_ = Area::Name;
        } else {
            area_ = Area::Expression;
        }
        after_value_ = false;
    }

    bool followed_by_colon() const {
        std::size_t at = at_;
        while (at < text_.size()) {
            if (is_blank(text_[at])) {
                ++at;
            } else if (text_.substr(at).starts_with("/*")) {
                const std::size_t end = text_.find("*/", at + 2);
                at = end == text_.npos ? text_.size() : end + 2;
            } else {
                return text_[at] == ':';
            }
        }
        return false;
    }

    /// Productions: `#name :` head `:` condition `:` successor.
    void next_part() {
        if (part_ == 0) {
            return;
        }
        ++part_;
        area_ = part_ == 3 ? Area::Expression : Area::Modules;
        after_value_ = false;
    }

    void token() {
        if (area_ == Area::Modules && depth_ == 0) {
            module();
        } else if (area_ == Area::Object && depth_ == 0) {
            if (text_[at_] == '"') {
                const std::size_t end = text_.find('"', at_ + 1);
                take(LexemeKind::Quoted, end == text_.npos ? rest() : end + 1 - at_);
            } else {
                module();
            }
        } else {
            expression();
        }
    }

    void module() {
        const char c = text_[at_];
        if (is_letter(c)) {
            take(LexemeKind::Module, word_length(at_));
        } else if (c == '`') {
            const std::size_t end = text_.find('`', at_ + 1);
            take(LexemeKind::Module, end == text_.npos ? rest() : end + 1 - at_);
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

    void value(LexemeKind kind, std::size_t length) {
        take(kind, length);
        // In `#set`, values stand in a row, and the name of a constant is followed by its
        // expression.
        after_value_ = !((area_ == Area::Set && depth_ == 0) || area_ == Area::Name);
        if (area_ == Area::Name) {
            area_ = Area::Expression;
        }
    }

    void expression() {
        const char c = text_[at_];
        if (is_letter(c)) {
            value(LexemeKind::Word, word_length(at_));
        } else if (is_digit(c) || c == '.') {
            value(LexemeKind::Number, number_length());
        } else if (c == '(' || c == '{') {
            const bool call = c == '(' && after_value_ && previous_ == LexemeKind::Word;
            take(LexemeKind::Left, 1);
            lexemes_.back().call = call;
            ++depth_;
            after_value_ = false;
        } else if (c == ')' || c == '}') {
            // The parenthesis of a module opened at depth 0.
            const bool module = depth_ == 1 && (area_ == Area::Modules || area_ == Area::Object);
            take(module ? LexemeKind::Close : LexemeKind::Right, 1);
            depth_ -= depth_ > 0 ? 1U : 0U;
            after_value_ = !(area_ == Area::Set && depth_ == 0);
        } else if (c == ',') {
            take(LexemeKind::Comma, 1);
            after_value_ = false;
        } else {
            operation();
        }
    }

    std::size_t number_length() const {
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

    void operation() {
        for (const std::string_view two : {"==", "!=", "<=", ">=", "&&", "||"}) {
            if (starts(two)) {
                take(LexemeKind::Operator, 2);
                after_value_ = false;
                return;
            }
        }
        const char c = text_[at_];
        const bool unary = !after_value_ && (c == '-' || c == '!');
        take(unary ? LexemeKind::Unary : LexemeKind::Operator, 1);
        // The `*` of a condition is a value that `~` may follow.
        after_value_ = c == '*' && !after_value_;
    }

    std::string_view text_;
    std::vector<Lexeme> lexemes_;
    std::size_t at_ = 0;
    std::uint32_t newlines_ = 0;
    bool blank_ = false;
    Area area_ = Area::Between;
    std::uint32_t part_ = 0;
    std::uint32_t depth_ = 0;
    bool after_value_ = false;
    LexemeKind previous_ = LexemeKind::Semicolon;
};

} // namespace

std::vector<Lexeme> lexemes_of(std::string_view text) {
    return Lexer(text).run();
}

} // namespace lsys
