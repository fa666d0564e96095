#include "grammar/dialects/houdini/session.h"

#include "grammar/dialects/houdini/settings.h"
#include "houdini/parser.h"

#include <algorithm>
#include <string>

namespace lsys {

namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::uint32_t kDeepest = 10'000;

} // namespace

HoudiniSession::HoudiniSession(FileId file, const ParseContext& parse_context)
    : context(parse_context), file_(file),
      size_(static_cast<std::uint32_t>(parse_context.sources.file(file).text().size())), last_{file,
                                                                                               0,
                                                                                               0} {}

SourceSpan HoudiniSession::take(std::uint32_t length) {
    const std::uint32_t begin = at_;
    at_ += length;
    last_ = {file_, std::min(begin, size_), std::min(at_, size_)};
    return last_;
}

void HoudiniSession::untake(std::uint32_t length) {
    at_ -= length;
    last_.end = std::min(at_, size_);
}

int HoudiniSession::key_token(std::string_view text) {
    using Token = houdini_grammar::Parser::token;
    const std::string key = houdini_key(text);
    wants_modules_ = key == "premise" || key == "axiom";
    if (wants_modules_) {
        return Token::TOK_PREMISE;
    }
    return find_houdini_setting(key) != nullptr ? Token::TOK_KEY : 0;
}

std::uint32_t HoudiniSession::length_of_key(std::string_view text) {
    return static_cast<std::uint32_t>(text.find_last_not_of(kBlanks) + 1);
}

bool HoudiniSession::close() {
    depth_ -= depth_ != 0 ? 1U : 0U;
    return depth_ == 0 && !tail_;
}

bool HoudiniSession::end_tail() {
    const bool ended = tail_ && depth_ == 0;
    tail_ = tail_ && !ended;
    return ended;
}

void HoudiniSession::end_line() {
    depth_ = 0;
    tail_ = false;
}

int HoudiniSession::add_node(HoudiniNodeKind kind, SourceSpan span, int first, int second) {
    nodes.push_back({kind, span, first, second, -1});
    if (depth_ == kDeepest && kind == HoudiniNodeKind::Group) {
        context.diagnostics.add(DiagnosticCode::NestingTooDeep, span,
                                "parentheses are nested more than 10,000 deep");
    }
    return static_cast<int>(nodes.size()) - 1;
}

int HoudiniSession::add_arguments(int node) {
    arguments.push_back({node, node, 1});
    return static_cast<int>(arguments.size()) - 1;
}

int HoudiniSession::extend_arguments(int list, int node) {
    HoudiniArguments& known = arguments[static_cast<std::size_t>(list)];
    nodes[static_cast<std::size_t>(known.last)].next = node;
    known.last = node;
    ++known.count;
    return list;
}

void HoudiniSession::add_module(SourceSpan symbol, SourceSpan parentheses, int arguments_of_it) {
    modules.push_back({symbol, parentheses, arguments_of_it});
}

int HoudiniSession::add_list(std::uint32_t modules_in_it) {
    const auto end = static_cast<std::uint32_t>(modules.size());
    lists.push_back({end - modules_in_it, end});
    return static_cast<int>(lists.size()) - 1;
}

int HoudiniSession::extend_list(int list) {
    lists[static_cast<std::size_t>(list)].end = static_cast<std::uint32_t>(modules.size());
    return list;
}

void HoudiniSession::add_premise(int list, SourceSpan span) {
    line_node_ = static_cast<std::uint32_t>(nodes.size());
    if (premise == -1) {
        premise = list;
        premise_span = span;
        return;
    }
    context.diagnostics.add(DiagnosticCode::ForeignSyntax, span, "a rule has a `=`")
        .labels.push_back({premise_span, "the premise is here already"});
}

void HoudiniSession::begin_rule(int left, int predecessor, int right) {
    rule_ = {};
    rule_.left = left;
    rule_.predecessor = predecessor;
    rule_.right = right;
    rule_.first_node = line_node_;
}

void HoudiniSession::end_rule(int condition, int successor, int probability, SourceSpan span) {
    rule_.condition = condition;
    rule_.successor = successor;
    rule_.probability = probability;
    rule_.end_node = static_cast<std::uint32_t>(nodes.size());
    rule_.span = span;
    for (const int list : {rule_.left, rule_.predecessor, rule_.right}) {
        add_formals(list);
    }
    std::sort(rule_.formals.begin(), rule_.formals.end());
    line_node_ = rule_.end_node;
    rules.push_back(rule_);
}

void HoudiniSession::add_formals(int list) {
    if (list == -1) {
        return;
    }
    const HoudiniList& head = lists[static_cast<std::size_t>(list)];
    for (std::uint32_t i = head.begin; i < head.end; ++i) {
        const int given = modules[i].arguments;
        int node = given == -1 ? -1 : arguments[static_cast<std::size_t>(given)].first;
        for (; node != -1; node = nodes[static_cast<std::size_t>(node)].next) {
            const HoudiniNode& formal = nodes[static_cast<std::size_t>(node)];
            if (formal.kind == HoudiniNodeKind::Name) {
                rule_.formals.push_back(context.sources.text(formal.span));
            }
        }
    }
}

void HoudiniSession::forget_rule() {
    line_node_ = static_cast<std::uint32_t>(nodes.size());
}

} // namespace lsys
