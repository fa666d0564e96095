#include "grammar/ast/ast.h"

#include "grammar/base/contract.h"
#include "grammar/base/utf8.h"

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

constexpr std::uint32_t kCallBit = 0x80000000u;

/// One past the name `name` that begins at `begin` of the source. It may have been written with
/// typographic characters, and then is longer there.
std::uint32_t name_end(std::string_view source, std::uint32_t begin, std::string_view name) {
    const std::string_view rest = source.substr(begin);
    if (rest.starts_with(name)) {
        return begin + static_cast<std::uint32_t>(name.size());
    }
    if (rest.starts_with('`')) {
        const std::size_t close = rest.find_first_of("`\n", 1);
        return begin + static_cast<std::uint32_t>(close == std::string_view::npos ? rest.size()
                                                                                  : close + 1);
    }
    std::size_t at = 0;
    for (std::size_t taken = 0; taken < name.size() && at < rest.size(); ++taken) {
        at += decode_utf8(rest.substr(at)).length;
    }
    return begin + static_cast<std::uint32_t>(at);
}

} // namespace

ModuleCursor::ModuleCursor(const Ast& ast,
                           const Names& names,
                           const SourceMap& sources,
                           ModuleList list)
    : ast_(&ast), names_(&names), sources_(&sources), file_(list.span.file), index_(list.first),
      end_(list.first + list.count), call_(0) {
    // The first call of a module at or after index_.
    std::size_t low = 0;
    std::size_t high = list.count == 0 ? 0 : ast.calls.size();
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (ast.calls[middle].module < index_) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    call_ = low;
}

ModuleView ModuleCursor::view() const {
    LSYS_DCHECK(!done());
    const ModuleNode& node = ast_->modules[index_];
    const std::string_view source = sources_->file(file_).text();
    ModuleView view;
    view.name = name();
    view.quoted = source[node.begin] == '`' && names_->text(view.name) != "`";
    view.has_parentheses = (node.name_and_call & kCallBit) != 0;
    view.name_span = {file_, node.begin, name_end(source, node.begin, names_->text(view.name))};
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
    return static_cast<NameId>(ast_->modules[index_].name_and_call & ~kCallBit);
}

void ModuleCursor::next() {
    call_ += (ast_->modules[index_].name_and_call & kCallBit) != 0 ? 1u : 0u;
    ++index_;
}

} // namespace lsys
