// SPDX-License-Identifier: MIT
#include "grammar/ast/ast.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <array>

namespace lsys {

const char* spelling(UnaryOperation operation) {
    return operation == UnaryOperation::Negate ? "-" : "!";
}

const char* spelling(BinaryOperation operation) {
    static constexpr std::array<const char*, 13> kSpellings{
        "^", "*", "/", "+", "-", "<", "<=", ">", ">=", "==", "!=", "&&", "||"};
    const auto index = static_cast<std::size_t>(operation);
    LSYS_CHECK(index < kSpellings.size(), index);
    return kSpellings[index];
}

namespace {

/// Offset one past the name at `begin` of `text` and past its back quotes, if it has any.
std::uint32_t name_end(std::string_view text, std::uint32_t begin, std::string_view name) {
    const std::size_t quotes = text.substr(begin).starts_with('`') && name != "`" ? 2 : 0;
    return static_cast<std::uint32_t>(std::min(begin + name.size() + quotes, text.size()));
}

/// The entry of `names` for the name at byte `begin` of `file`; null if there is none.
const WrittenName*
find_written(std::span<const WrittenName> names, FileId file, std::uint32_t begin) {
    const auto found = std::lower_bound(names.begin(), names.end(), WrittenName{file, begin, 0});
    return found != names.end() && found->file == file && found->begin == begin ? &*found : nullptr;
}

} // namespace

SourceSpan module_name_span(const SourceMap& sources,
                            FileId file,
                            std::uint32_t begin,
                            std::string_view name,
                            std::span<const WrittenName> written_names) {
    if (const WrittenName* const written = find_written(written_names, file, begin)) {
        return {file, begin, written->end};
    }
    return {file, begin, name_end(sources.file(file).text(), begin, name)};
}

ModuleCursor::ModuleCursor(const Ast& ast,
                           const Names& names,
                           const SourceMap& sources,
                           ModuleList list)
    : ast_(&ast), names_(&names), sources_(&sources), file_(list.span.file), index_(list.first),
      end_(list.first + list.count), call_(0) {
    if (list.count != 0) {
        call_ = ast.calls.partition_point(
            [this](const CallNode& call) { return call.module < index_; });
    }
}

ModuleView ModuleCursor::view() const {
    LSYS_DCHECK(!done());
    const ModuleNode& node = ast_->modules[index_];
    ModuleView view;
    view.name = name();
    const std::string_view text = names_->text(view.name);
    view.has_parentheses = node.has_call();
    view.name_span = module_name_span(*sources_, file_, node.begin, text, ast_->written_names);
    view.is_indivisible = sources_->text(view.name_span) != text;
    view.span = view.name_span;
    if (view.has_parentheses) {
        const CallNode& call = ast_->calls[call_];
        view.span.end = call.end;
        view.arguments = call.arguments;
    }
    return view;
}

NameId ModuleCursor::name() const {
    LSYS_DCHECK(!done());
    return ast_->modules[index_].name();
}

void ModuleCursor::next() {
    call_ += ast_->modules[index_].has_call() ? 1u : 0u;
    ++index_;
}

} // namespace lsys
