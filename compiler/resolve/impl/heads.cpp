// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/heads.h"

#include "compiler/resolve/profiles.h"
#include "grammar/base/characters.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

/// Whether a predecessor is a hyphenated name, words of two or more letters: `shoot-apex`.
bool is_hyphenated(std::string_view text) {
    std::size_t word = 0;
    bool has_hyphen = false;
    for (const char c : text) {
        if (c == '-' && word >= 2) {
            has_hyphen = true;
            word = 0;
        } else if (is_word_character(c)) {
            ++word;
        } else {
            return false;
        }
    }
    return has_hyphen && word >= 1;
}

} // namespace

bool HeadResolver::resolve(const ProductionNode& node, Production& production) {
    node_ = &node;
    production_ = &production;
    production.has_left = node.has_left;
    production.has_right = node.has_right;
    bool ok = check_shape(node);
    ok = read_pattern(node.left, Part::Left, production.left) && ok;
    ok = read_pattern(node.predecessor, Part::Predecessor, production.predecessor) && ok;
    ok = read_pattern(node.right, Part::Right, production.right) && ok;
    return ok;
}

bool HeadResolver::check_shape(const ProductionNode& node) {
    bool ok = true;
    const auto empty_context = [&](SourceSpan sign, const char* side) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::EmptyContext, sign, fmt::format("the {} context is empty", side));
        error.help.emplace_back("write the required module, or remove the sign");
        error.fixes.push_back({"remove the sign", {{sign, ""}}, false});
        ok = false;
    };
    if (node.has_left && node.left.count == 0) {
        empty_context(node.less_span, "left");
    }
    if (node.has_right && node.right.count == 0) {
        empty_context(node.greater_span, "right");
    }
    if (node.predecessor.count == 0) {
        resolution_.diagnostics.add(DiagnosticCode::EmptyPredecessor, node.predecessor.span,
                                    "this production names no module to rewrite");
        return false;
    }
    if (node.stage != Stage::Rewrite && !check_stage(node)) {
        return false;
    }
    if (node.predecessor.count > 1 &&
        resolution_.program.settings.rewriting == RewritingMode::Parallel) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::SeveralPredecessors, node.predecessor.span,
            fmt::format("{} modules are to be rewritten as one", node.predecessor.count));
        const std::string_view written = resolution_.sources.text(node.predecessor.span);
        if (is_hyphenated(written)) {
            error.notes.emplace_back("a name holds no `-`, which is a module that turns");
            std::string joined(written);
            std::replace(joined.begin(), joined.end(), '-', '_');
            Fix fix{fmt::format("write `{}` at every place", joined), {}, false};
            const FileId file = node.predecessor.span.file;
            const std::string_view text = resolution_.sources.file(file).text();
            for (std::size_t at = text.find(written); at != std::string_view::npos;
                 at = text.find(written, at + written.size())) {
                const auto begin = static_cast<std::uint32_t>(at);
                fix.edits.push_back(
                    {{file, begin, begin + static_cast<std::uint32_t>(written.size())}, joined});
            }
            error.fixes.push_back(std::move(fix));
            return false;
        }
        error.notes.emplace_back("in parallel rewriting every module is rewritten by itself");
        error.help.emplace_back("write the neighbours as contexts (`A < B > C`), or use "
                                "`#set rewriting leftmost;` or `sequential`");
        return false;
    }
    return ok;
}

/// Checks that a production of a later stage has one module, and no context that its stage cannot
/// have.
bool HeadResolver::check_stage(const ProductionNode& node) {
    if (node.stage == Stage::Down || node.stage == Stage::Up) {
        return check_sweep(node);
    }
    const bool several = node.predecessor.count > 1;
    if (!several && !node.has_left && !node.has_right) {
        return true;
    }
    const SourceSpan place = several         ? node.predecessor.span
                             : node.has_left ? node.less_span
                                             : node.greater_span;
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::ContextOfModule, place,
        several ? fmt::format("`{}` takes one module, not {}", keyword_of(node.stage),
                              node.predecessor.count)
                : fmt::format("`{}` has no contexts", keyword_of(node.stage)));
    error.notes.emplace_back(
        node.stage == Stage::Interpret
            ? "how a module is drawn depends on the module alone, not on its neighbours"
            : "how a module is decomposed depends on the module alone, not on its neighbours");
    return false;
}

bool HeadResolver::check_sweep(const ProductionNode& node) {
    const std::string_view keyword = keyword_of(node.stage);
    const RewritingMode rewriting = resolution_.program.settings.rewriting;
    if (rewriting != RewritingMode::Parallel) {
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::BadSweep, node.name_span,
                                        fmt::format("`{}` does not work with `#set rewriting {};`",
                                                    keyword, name_of(rewriting)));
        error.notes.emplace_back("sweeps belong to generations in which all modules are rewritten "
                                 "at once: `parallel`");
        return false;
    }
    if (node.predecessor.count > 1) {
        resolution_.diagnostics
            .add(DiagnosticCode::ContextOfModule, node.predecessor.span,
                 fmt::format("`{}` takes one module, not {}", keyword, node.predecessor.count))
            .notes.emplace_back("a sweep visits each module by itself");
        return false;
    }
    const bool goes_down = node.stage == Stage::Down;
    if (goes_down ? !node.has_left : !node.has_right) {
        return true;
    }
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::ContextOfModule, goes_down ? node.less_span : node.greater_span,
        fmt::format("`{}` has no {} context", keyword, goes_down ? "left" : "right"));
    error.notes.emplace_back(
        goes_down ? "it visits the word from right to left, children before parents, so that only "
                    "modules to the right have been swept"
                  : "it visits the word from left to right, parents before children, so that only "
                    "modules to the left have been swept");
    error.help.push_back(
        goes_down
            ? "write the module as right context, `A > B`; to carry values from the root use `#up`"
            : "write the module as left context, `B < A`; to carry values to the root use `#down`");
    return false;
}

bool HeadResolver::read_pattern(ModuleList list, Part part, ProgramPattern& out) {
    bool ok = true;
    out.span = list.span;
    out.items.reserve(list.count);
    open_.clear();
    bracket_reported_ = false;
    ModuleCursor cursor(resolution_.ast, resolution_.names, resolution_.sources, list);
    for (; !cursor.done(); cursor.next()) {
        const ModuleView module = cursor.view();
        if (!check_module(reading_, module)) {
            ok = false;
            continue;
        }
        const SymbolKind kind =
            kind_of(resolution_.program.settings.turtle, resolution_.text(module.name));
        if (kind == SymbolKind::BranchOpen || kind == SymbolKind::BranchClose) {
            ok = read_bracket(module, part, out) && ok;
            continue;
        }
        const auto first_formal = static_cast<std::uint32_t>(production_->formals.size());
        ok = read_formals(module) && ok;
        append(module, first_formal, out);
    }
    for (const SourceSpan open : open_) {
        resolution_.diagnostics.add(DiagnosticCode::BracketInHead, open,
                                    part == Part::Predecessor
                                        ? "this `[` of the predecessor is never closed"
                                        : "this `[` of the context is never closed");
        ok = false;
    }
    return ok;
}

bool HeadResolver::read_bracket(const ModuleView& module, Part part, ProgramPattern& out) {
    const bool opens = kind_of(resolution_.program.settings.turtle,
                               resolution_.text(module.name)) == SymbolKind::BranchOpen;
    const bool rewritten = part == Part::Predecessor &&
                           resolution_.program.settings.rewriting == RewritingMode::Leftmost;
    if (part != Part::Right && !rewritten) {
        if (std::exchange(bracket_reported_, true)) {
            return false;
        }
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::BracketInHead, module.span,
                                        part == Part::Left ? "a left context cannot hold brackets"
                                                           : "brackets cannot be rewritten");
        if (part == Part::Left) {
            error.notes.emplace_back("it is the path to the root, which leaves branches without a "
                                     "sign");
        }
        return false;
    }
    if (opens) {
        open_.push_back(module.span);
    } else if (open_.empty()) {
        resolution_.diagnostics.add(DiagnosticCode::BracketInHead, module.span,
                                    rewritten ? "this `]` of the predecessor closes nothing"
                                              : "this `]` of the context closes nothing");
        return false;
    } else {
        open_.pop_back();
    }
    if (rewritten) { // with `rewriting leftmost` a predecessor has brackets as ordinary modules
        const auto first_formal = static_cast<std::uint32_t>(production_->formals.size());
        const bool ok = read_formals(module);
        append(module, first_formal, out);
        return ok;
    }
    out.items.push_back({opens ? PatternKind::Open : PatternKind::Close, kNoSymbol, 0,
                         module.span.begin, module.span.end});
    return true;
}

void HeadResolver::append(const ModuleView& module,
                          std::uint32_t first_formal,
                          ProgramPattern& out) {
    const std::uint32_t count = module.arguments.count;
    const bool may_split = &out != &production_->predecessor && !module.is_indivisible;
    const std::span<const NamePart> parts =
        may_split ? reading_.splitter.parts(module.name, count, module.span.file)
                  : std::span<const NamePart>{};
    if (parts.empty()) {
        out.items.push_back({PatternKind::Module, reading_.symbols.get(module.name, count),
                             first_formal, module.span.begin, module.span.end});
        return;
    }
    reading_.splits.add(module.name_span, module.span, parts);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool is_last = i + 1 == parts.size();
        const std::uint32_t end =
            is_last ? module.span.end : module.name_span.begin + parts[i + 1].offset;
        out.items.push_back({PatternKind::Module,
                             reading_.symbols.get(parts[i].name, is_last ? count : 0), first_formal,
                             module.name_span.begin + parts[i].offset, end});
    }
}

bool HeadResolver::read_formals(const ModuleView& module) {
    bool ok = true;
    for (std::uint32_t i = 0; i < module.arguments.count; ++i) {
        const ExpressionId argument = resolution_.ast.expression_lists[module.arguments.first + i];
        ok = read_formal(resolution_.ast.expression(argument)) && ok;
    }
    return ok;
}

bool HeadResolver::read_formal(const Expression& argument) {
    const SourceSpan span = argument.span();
    if (argument.kind != ExpressionKind::Name) {
        if (argument.kind != ExpressionKind::Error) {
            report_argument(argument);
        }
        return false;
    }
    const std::string_view text = resolution_.text(argument.name);
    if (!reading_.expressions.add_formal(argument.name, span)) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::DuplicateFormal, span, fmt::format("a second parameter `{}`", text));
        error.labels.push_back(
            {reading_.expressions.formal_span(argument.name), "the first is here"});
        error.help.emplace_back("each parameter of a production needs a name of its own; to ask "
                                "for equal values, compare them in the condition");
        return false;
    }
    production_->formals.push_back(argument.name);
    production_->formal_spans.push_back(span);
    if (constants_.state(argument.name) == ConstantState::Known) {
        Diagnostic& warning = resolution_.diagnostics.add(
            DiagnosticCode::HiddenConstant, span,
            fmt::format("the parameter `{}` hides a constant of that name", text));
        warning.labels.push_back({constants_.definition_span(argument.name), "the constant"});
        warning.notes.push_back(fmt::format("in this production `{}` is the parameter", text));
    }
    return true;
}

void HeadResolver::report_argument(const Expression& argument) {
    const std::string_view written = resolution_.sources.text(argument.span());
    Diagnostic& error =
        resolution_.diagnostics.add(DiagnosticCode::ExpressionInHead, argument.span(),
                                    "a parameter is a name here, not a value");
    std::string name;
    for (const char* const candidate : {"x", "y", "z", "u", "v"}) {
        const NameId id = resolution_.names.find(candidate);
        const std::vector<NameId>& formals = production_->formals;
        const bool is_free =
            id == kNoName || (constants_.state(id) == ConstantState::Unknown &&
                              std::find(formals.begin(), formals.end(), id) == formals.end());
        if (name.empty() && is_free) {
            name = candidate;
        }
    }
    if (name.empty() || written.size() > 40 || argument.kind == ExpressionKind::Range) {
        error.help.emplace_back("name the parameter, and ask for its value in the condition");
        return;
    }
    error.help.push_back(fmt::format(
        "name the parameter, and ask for its value in the condition: `{} == {}`", name, written));
    if (argument.kind == ExpressionKind::Number) {
        if (const auto edit = condition_edit(fmt::format("{} == {}", name, written))) {
            error.fixes.push_back(
                {"put it into the condition", {{argument.span(), name}, *edit}, true});
        }
    }
}

std::optional<Edit> HeadResolver::condition_edit(const std::string& test) const {
    const ConditionNode& condition = node_->condition;
    const SourceSpan span = condition.span;
    const std::string_view written = resolution_.sources.text(span);
    if (condition.condition != kNoExpression) {
        return std::nullopt;
    }
    if (written.starts_with('*')) {
        return Edit{{span.file, span.begin, span.begin + 1}, test};
    }
    if (written.starts_with('~')) {
        return Edit{{span.file, span.begin, span.begin}, test + " "};
    }
    return std::nullopt;
}

} // namespace lsys
