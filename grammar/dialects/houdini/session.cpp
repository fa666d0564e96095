// SPDX-License-Identifier: MIT
#include "grammar/dialects/houdini/session.h"

#include "grammar/dialects/houdini/settings.h"
#include "houdini/parser.h"

#include <algorithm>
#include <string>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::uint32_t kMaxDepth = 10'000;

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

void HoudiniSession::put_back(std::uint32_t length) {
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

int HoudiniSession::any_key_token(std::string_view text) {
    const int token = key_token(text);
    return token != 0 ? token : houdini_grammar::Parser::token::TOK_KEY;
}

std::uint32_t HoudiniSession::length_of_key(std::string_view text) {
    return static_cast<std::uint32_t>(text.find_last_not_of(kBlanks) + 1);
}

bool HoudiniSession::close() {
    depth_ -= depth_ != 0 ? 1U : 0U;
    return depth_ == 0 && !in_condition_;
}

bool HoudiniSession::end_condition() {
    const bool ended = in_condition_ && depth_ == 0;
    in_condition_ = in_condition_ && !ended;
    return ended;
}

void HoudiniSession::end_line() {
    depth_ = 0;
    in_condition_ = false;
}

ForeignId HoudiniSession::add_node(ForeignKind kind,
                                   SourceSpan token,
                                   std::vector<ForeignId> parts,
                                   SourceSpan span) {
    return nodes.add({.kind = kind,
                      .text = std::string(context.sources.text(token)),
                      .parts = std::move(parts),
                      .span = span,
                      .token = token});
}

void HoudiniSession::check_nesting(SourceSpan span) const {
    if (depth_ == kMaxDepth) {
        context.diagnostics.add(DiagnosticCode::NestingTooDeep, span,
                                "parentheses are nested more than 10,000 deep");
    }
}

void HoudiniSession::add_premise(std::vector<HoudiniModule> modules, SourceSpan span) {
    line_node_ = static_cast<std::uint32_t>(nodes.size());
    if (premise.empty()) {
        premise = std::move(modules);
        premise_span = span;
        return;
    }
    context.diagnostics.add(DiagnosticCode::ForeignSyntax, span, "a rule has a `=`")
        .labels.push_back({premise_span, "the premise is here already"});
}

void HoudiniSession::add_rule(HoudiniRule rule, SourceSpan span) {
    rule.first_node = line_node_;
    rule.end_node = line_node_ = static_cast<std::uint32_t>(nodes.size());
    rule.span = span;
    for (const std::vector<HoudiniModule>* const modules : rule.head()) {
        for (const HoudiniModule& module : *modules) {
            for (const ForeignId argument : module.arguments) {
                const ForeignNode& formal = node(argument);
                if (formal.kind == ForeignKind::Name) {
                    rule.formals.push_back(context.sources.text(formal.span));
                }
            }
        }
    }
    std::sort(rule.formals.begin(), rule.formals.end());
    rules.push_back(std::move(rule));
}

void HoudiniSession::forget_rule() {
    line_node_ = static_cast<std::uint32_t>(nodes.size());
}

} // namespace lsys
