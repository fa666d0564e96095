// SPDX-License-Identifier: MIT
#include "runtime/derive/word_text.h"
#include "runtime/library/impl/call.h"
#include "runtime/library/impl/data.h"

#include <algorithm>
#include <utility>

namespace lsys::v0 {

namespace {

std::vector<ModuleKind> kinds_of(const Bytecode& bytecode) {
    std::vector<ModuleKind> kinds;
    kinds.reserve(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        const BytecodeSymbol& symbol = bytecode.symbol(bytecode.symbol_of(code));
        ModuleKind kind{symbol.name, bytecode.stored_parameters(code), {}};
        if (code >= bytecode.symbols.size()) {
            const FoldedModule& folded = bytecode.folded[code - bytecode.symbols.size()];
            const auto first = bytecode.constants.begin() + folded.first_constant;
            kind.constants.assign(first, first + symbol.parameter_count);
        }
        kinds.push_back(std::move(kind));
    }
    return kinds;
}

} // namespace

Word::Word(std::shared_ptr<const Data> data) noexcept : data_(std::move(data)) {}

std::uint64_t Word::size() const {
    return data_->derived.word.module_count();
}

std::uint32_t Word::generation() const {
    return data_->derived.generations;
}

std::uint64_t Word::seed() const {
    return data_->derived.seed;
}

const void* Word::codes() const {
    return data_->derived.word.code_bytes().data();
}

std::uint32_t Word::code_bytes() const {
    return data_->derived.word.code_width();
}

std::span<const float> Word::parameters() const {
    return data_->derived.word.parameters();
}

const std::vector<ModuleKind>& Word::kinds() const {
    return data_->kinds;
}

void Word::visit(std::uint64_t first,
                 std::uint64_t count,
                 const std::function<bool(const Module& module)>& visit) const {
    const std::vector<ModuleKind>& kinds = data_->kinds;
    data_->derived.word.visit([&](auto codes) {
        const std::uint64_t begin = std::min<std::uint64_t>(first, codes.size());
        const std::uint64_t end = begin + std::min<std::uint64_t>(count, codes.size() - begin);
        const float* parameters = this->parameters().data();
        for (std::uint64_t i = 0; i < begin; ++i) {
            parameters += kinds[codes[i]].stored_parameters;
        }
        for (std::uint64_t i = begin; i < end; ++i) {
            const ModuleKind& kind = kinds[codes[i]];
            const std::span<const float> values =
                kind.stored_parameters != 0 ? std::span(parameters, kind.stored_parameters)
                                            : std::span<const float>(kind.constants);
            parameters += kind.stored_parameters;
            if (!visit({kind.name, values})) {
                return;
            }
        }
    });
}

bool Word::write_text(const std::function<bool(std::string_view piece)>& write) const {
    return WordPrinter(data_->bytecode()).print(data_->derived.word, write);
}

std::string Word::text() const {
    std::string text;
    static_cast<void>(write_text([&](std::string_view piece) {
        text += piece;
        return true;
    }));
    return text;
}

Outcome<Word> derive(const Grammar& grammar, const DeriveOptions& options, const Project& project) {
    Call call(project, {grammar.data().file}, grammar.data().policy);
    call.check_environments(grammar.data().grammar.bytecode);
    PlantOptions inner;
    inner.file = grammar.name();
    inner.generations = options.generations;
    inner.seed = options.seed;
    return call.run<Word>(
        [&] { return derive_word(inner, grammar.data().grammar, call.project()); },
        [&](DerivedWord derived) {
            auto data = std::make_shared<Word::Data>(Word::Data{grammar, std::move(derived), {}});
            data->kinds = kinds_of(data->bytecode());
            return Word(std::move(data));
        });
}

} // namespace lsys::v0
