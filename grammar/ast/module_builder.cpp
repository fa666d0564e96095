// SPDX-License-Identifier: MIT
// The module lists of AstBuilder. A run of names is one token and is split here: the hot loop of
// the front end, since an axiom may have a hundred million modules.
#include "grammar/ast/ast_builder.h"
#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/characters.h"
#include "grammar/base/contract.h"
#include "grammar/base/hash.h"
#include "grammar/base/utf8.h"

namespace lsys {

namespace {

enum class CharacterClass : std::uint8_t { Blank, Letter, Symbol, Bracket, Slash, Open, Question };

constexpr std::array<CharacterClass, 128> kClasses = [] {
    std::array<CharacterClass, 128> classes{};
    classes.fill(CharacterClass::Symbol);
    for (const char c : {' ', '\t', '\r', '\n'}) {
        classes[static_cast<unsigned char>(c)] = CharacterClass::Blank;
    }
    for (std::size_t c = 0; c < 128; ++c) {
        if (is_letter(static_cast<char>(c))) {
            classes[c] = CharacterClass::Letter;
        }
    }
    classes['['] = CharacterClass::Bracket;
    classes[']'] = CharacterClass::Bracket;
    classes['/'] = CharacterClass::Slash;
    classes['('] = CharacterClass::Open;
    classes['?'] = CharacterClass::Question;
    return classes;
}();

CharacterClass class_of(char c) {
    return kClasses[static_cast<unsigned char>(c) & 0x7Fu];
}

bool is_name_character(char c) {
    return class_of(c) == CharacterClass::Letter || is_digit(c);
}

} // namespace

ModuleList AstBuilder::empty_modules(SourceSpan where) {
    open_brackets_ = 0;
    last_name_ = LastName::None;
    return {static_cast<std::uint32_t>(ast_.modules.size()), 0, where};
}

SourceSpan AstBuilder::place_in_list(SourceSpan span) {
    if (scanned_.translation == nullptr) {
        return span;
    }
    if (list_place_.file != kNoFile && span.file != list_place_.file) {
        return list_place_;
    }
    list_place_ = span.begin == span.end ? list_place_ : span;
    return span;
}

void AstBuilder::extend_list(ModuleList& list, SourceSpan span) {
    list.span = list.count == 0 ? span : join(list.span, span);
    list.count = static_cast<std::uint32_t>(ast_.modules.size()) - list.first;
}

/// `text`: the place of the name in the scanned text, with its back quotes. Inline because the
/// function runs for every module. Only translated or edited text needs a further function call.
inline void AstBuilder::push_module(NameId name, TextRange text) {
    if (scanned_.translation != nullptr || scanned_.map != nullptr) {
        push_module_of_edited_text(name, text);
    } else {
        ast_.modules.push_back({name, text.begin});
    }
    last_name_ = LastName::Bare;
}

void AstBuilder::push_module_of_edited_text(NameId name, TextRange text) {
    push_with_place(name, place_in_list(scanned_.span(text.begin, text.end)));
}

void AstBuilder::push_with_place(NameId name, SourceSpan span) {
    ast_.modules.push_back({name, span.begin});
    const std::string_view text = names_.text(name);
    const std::string_view written = sources_.text(span);
    const bool is_quoted = written.size() == text.size() + 2 && written.starts_with('`') &&
                           written.substr(1).starts_with(text);
    if (written != text && !is_quoted) {
        ast_.written_names.push_back({span.file, span.begin, span.end});
    }
}

ModuleList AstBuilder::modules(ModuleList list, TextRange run) {
    const std::string_view text = scanned_.text;
    std::uint32_t at = run.begin;
    std::uint32_t name_end = run.begin;
    constexpr std::uint32_t kBytesPerLook = 1U << 16U;
    std::uint32_t next_look = run.begin; // byte at which cancellation is checked next
    while (at < run.end) {
        if (at >= next_look) {
            stop_if_cancelled();
            next_look = at + kBytesPerLook;
        }
        const char c = text[at];
        switch (class_of(c)) {
        case CharacterClass::Blank:
            ++at;
            continue;
        case CharacterClass::Open:
            at = read_plain_arguments(at, name_end);
            continue;
        case CharacterClass::Letter:
            if ((at + 1 < run.end && is_name_character(text[at + 1])) ||
                (module_names_ != ModuleNames::Words && c == '_')) {
                std::uint32_t end = at + 1;
                while (end < run.end && is_name_character(text[end])) {
                    ++end;
                }
                if (module_names_ != ModuleNames::Words) {
                    push_letters({at, end});
                } else {
                    push_module(intern_word(text.substr(at, end - at)), {at, end});
                }
                at = name_end = end;
                continue;
            }
            break;
        case CharacterClass::Slash:
            if (at + 1 < run.end && text[at + 1] == '/' &&
                (at == run.begin || text[at - 1] != '/')) {
                record_slashes(at);
            }
            break;
        case CharacterClass::Bracket:
            count_bracket(c, scanned_.span(at, at + 1));
            break;
        case CharacterClass::Question: // begins a name: a run has no lone `?`
            at = name_end = push_sense({at, run.end});
            continue;
        case CharacterClass::Symbol:
            break;
        }
        NameId& name = one_character_names_[static_cast<unsigned char>(c) & 0x7Fu];
        if (name > kNoName) {
            name = names_.intern(text.substr(at, 1));
        }
        push_module(name, {at, at + 1});
        name_end = ++at;
    }
    extend_list(list, place_in_list(scanned_.span(run.begin, run.end)));
    return list;
}

NameId AstBuilder::intern_word(std::string_view word) {
    if (word.size() > sizeof(std::uint64_t)) {
        return names_.intern(word);
    }
    std::uint64_t key = 0;
    for (const char c : word) {
        key = key << 8 | static_cast<unsigned char>(c);
    }
    CachedWord& cached = word_cache_[golden_multiple(key) >> 56];
    if (cached.key != key) {
        cached = {key, names_.intern(word)};
    }
    return cached.name;
}

std::uint32_t AstBuilder::push_sense(TextRange run) {
    const std::string_view text = scanned_.text;
    std::uint32_t end = run.begin + 2;
    if (module_names_ != ModuleNames::Words && text[run.begin + 1] == '_') {
        report_not_a_letter(diagnostics_, scanned_.span(run.begin + 1, end), '_');
        last_name_ = LastName::None;
        return end;
    }
    while (module_names_ == ModuleNames::Words && end < run.end && is_name_character(text[end])) {
        ++end;
    }
    push_module(intern_word(text.substr(run.begin, end - run.begin)), {run.begin, end});
    return end;
}

void AstBuilder::push_letters(TextRange word) {
    bool reported = false;
    for (std::uint32_t at = word.begin; at < word.end; ++at) {
        const char c = scanned_.text[at];
        if (is_digit(c) || c == '_') {
            if (!reported) {
                report_not_a_letter(diagnostics_, scanned_.span(at, at + 1), c);
                reported = true;
            }
            last_name_ = LastName::None;
            continue;
        }
        push_module(intern_word(scanned_.text.substr(at, 1)), {at, at + 1});
    }
}

ModuleList AstBuilder::quoted_module(ModuleList list, NameId name, SourceSpan span) {
    const std::string_view text = names_.text(name);
    if (text == "[" || text == "]") {
        count_bracket(text[0], span);
    }
    span = place_in_list(span);
    push_with_place(name, span);
    last_name_ = LastName::Bare;
    extend_list(list, span);
    return list;
}

void AstBuilder::push_character(std::string_view character, TextRange text) {
    if (character.size() > 1) {
        push_module(names_.intern(character), text);
        return;
    }
    if (character == "[" || character == "]") {
        count_bracket(character[0], scanned_.span(text.begin, text.end));
    }
    NameId& name = one_character_names_[static_cast<unsigned char>(character[0]) & 0x7Fu];
    if (name > kNoName) {
        name = names_.intern(character);
    }
    push_module(name, text);
}

ModuleList AstBuilder::quoted_text(ModuleList list, TextRange quoted) {
    const bool adjoins = list.count != 0 && quoted.begin == text_end_;
    if (adjoins) {
        push_character("`", {quoted.begin, quoted.begin + 1});
    } else if (quoted.begin + 2 == quoted.end) {
        last_name_ = LastName::Empty;
    }
    for (std::uint32_t at = quoted.begin + 1; at + 1 < quoted.end;) {
        const std::uint32_t length = decode_utf8(scanned_.text.substr(at)).length;
        push_character(scanned_.text.substr(at, length), {at, at + length});
        at += length;
    }
    text_end_ = quoted.end;
    extend_list(list, place_in_list(scanned_.span(quoted.begin, quoted.end)));
    return list;
}

ModuleList
AstBuilder::module_arguments(ModuleList list, std::uint32_t count, SourceSpan parentheses) {
    CallNode call;
    parentheses = place_in_list(parentheses);
    if (!begin_call(parentheses, call)) {
        drop_arguments(count);
        return list;
    }
    call.name_end = list.span.end;
    call.open = parentheses.begin;
    call.end = parentheses.end;
    call.arguments = take_arguments(count);
    ast_.calls.push_back(call);
    list.span.end = parentheses.end;
    return list;
}

bool AstBuilder::begin_call(SourceSpan parentheses, CallNode& call) {
    switch (last_name_) {
    case LastName::None:
        return false;
    case LastName::Empty:
        if (diagnostics_.admits(DiagnosticCode::BadQuotedName)) {
            diagnostics_.add(DiagnosticCode::BadQuotedName, parentheses,
                             "parameters of a text in back quotes without characters");
        }
        return false;
    case LastName::Called:
        if (diagnostics_.admits(DiagnosticCode::SyntaxError)) {
            diagnostics_
                .add(DiagnosticCode::SyntaxError, parentheses,
                     "a module has one pair of parentheses, and this is a second one")
                .help.emplace_back("several parameters are separated by commas: `F(1, 2)`");
        }
        return false;
    case LastName::Bare:
        break;
    }
    ast_.modules.back().set_call();
    call.module = static_cast<std::uint32_t>(ast_.modules.size() - 1);
    last_name_ = LastName::Called;
    return true;
}

std::uint32_t AstBuilder::read_plain_arguments(std::uint32_t open, std::uint32_t name_end) {
    const std::string_view text = scanned_.text;
    CallNode call;
    if (!begin_call({}, call)) { // no module takes the arguments: already reported
        return static_cast<std::uint32_t>(text.find(')', open)) + 1;
    }
    call.name_end = place_in_list(scanned_.span(name_end, name_end)).end;
    call.open = place_in_list(scanned_.span(open, open + 1)).begin;
    call.arguments.first = static_cast<std::uint32_t>(ast_.expression_lists.size());
    std::uint32_t at = open + 1;
    while (text[at] != ')') {
        if (class_of(text[at]) == CharacterClass::Blank || text[at] == ',') {
            ++at;
            continue;
        }
        const std::uint32_t begin = at;
        at += text[at] == '-' ? 1u : 0u;
        while (class_of(text[at]) == CharacterClass::Blank) {
            ++at;
        }
        const std::uint32_t first = at;
        while (is_name_character(text[at]) || text[at] == '.' ||
               ((text[at] == '-' || text[at] == '+') &&
                (text[at - 1] == 'e' || text[at - 1] == 'E'))) {
            ++at;
        }
        ExpressionId value = plain_number(first, at);
        if (begin != first) {
            value = unary(UnaryOperation::Negate, value, scanned_.span(begin, at));
        }
        ast_.expression_lists.push_back(value);
        ++call.arguments.count;
    }
    ++at;
    call.end = place_in_list(scanned_.span(at - 1, at)).end;
    ast_.calls.push_back(call);
    return at;
}

ExpressionId AstBuilder::plain_number(std::uint32_t begin, std::uint32_t end) {
    const std::string_view text = scanned_.text.substr(begin, end - begin);
    const Literal literal = read_literal(text);
    const SourceSpan span = scanned_.span(begin, end);
    report_literal_range(diagnostics_, literal, text, span);
    return literal.range == LiteralRange::Overflow ? error(span) : number(literal.value, span);
}

void AstBuilder::count_bracket(char bracket, SourceSpan span) {
    if (bracket == ']') {
        open_brackets_ -= open_brackets_ == 0 ? 0u : 1u;
    } else if (++open_brackets_ > kMaxNesting && !is_discarded_) {
        report_too_deep(diagnostics_, span, "branches `[`");
        is_discarded_ = true;
    }
}

void AstBuilder::remove_slashes(std::uint32_t begin) {
    const SourceSpan first = scanned_.span(begin, begin);
    while (!ast_.slashes.empty() && ast_.slashes.back().file == first.file &&
           ast_.slashes.back().begin >= first.begin) {
        ast_.slashes.pop_back();
    }
}

void AstBuilder::record_slashes(std::uint32_t slashes) {
    // Max number of recorded `//` per grammar, since files may use `//` often, to roll twice.
    constexpr std::size_t kMaxKept = 10'000;
    const std::size_t next = scanned_.text.find_first_not_of(" \t", slashes + 2);
    if (next != std::string_view::npos && is_letter(scanned_.text[next]) &&
        scanned_.translation == nullptr && ast_.slashes.size() < kMaxKept) {
        ast_.slashes.push_back(scanned_.span(slashes, slashes + 2));
    }
}

} // namespace lsys
