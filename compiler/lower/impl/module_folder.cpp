// SPDX-License-Identifier: MIT
#include "compiler/lower/impl/module_folder.h"

#include "compiler/program/append_bytes.h"

#include <cmath>

namespace lsys {

namespace {

std::uint64_t code_capacity(std::size_t symbol_count) {
    switch (code_width(symbol_count)) {
    case 1:
        return 256;
    case 2:
        return 65'536;
    default:
        return kNone;
    }
}

} // namespace

ModuleFolder::ModuleFolder(const Program& program, Bytecode& bytecode)
    : program_(program), bytecode_(bytecode), changes_(program.symbols.size()),
      capacity_(code_capacity(program.symbols.size())) {
    for (std::size_t i = 0; i < program.symbols.size(); ++i) {
        changes_[i] = program.symbols[i].sense != Sense::Nothing;
    }
    for (const Production& production : program.productions) {
        if (production.stage == Stage::Down || production.stage == Stage::Up) {
            changes_[static_cast<std::size_t>(production.predecessor.items[0].symbol)] = true;
        }
    }
}

Code ModuleFolder::code(SymbolId symbol, std::size_t first_argument) {
    const auto symbol_code = static_cast<Code>(symbol);
    if (changes_[symbol_code]) {
        return symbol_code;
    }
    const std::uint32_t count = program_.symbol(symbol).parameter_count;
    key_.clear();
    append_bytes(key_, symbol_code);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Value& value = program_.value(program_.arguments[first_argument + i]);
        if (value.opcode != Opcode::Literal || !std::isfinite(value.literal)) {
            return symbol_code;
        }
        append_bytes(key_, value.literal);
    }
    if (key_ == last_key_) {
        return last_code_;
    }
    Code code = symbol_code;
    if (const auto found = codes_.find(key_); found != codes_.end()) {
        code = found->second;
    } else if (program_.symbols.size() + bytecode_.folded.size() < capacity_) {
        code = static_cast<Code>(program_.symbols.size() + bytecode_.folded.size());
        bytecode_.folded.push_back(
            {symbol, static_cast<std::uint32_t>(bytecode_.constants.size())});
        for (std::uint32_t i = 0; i < count; ++i) {
            bytecode_.constants.push_back(
                program_.value(program_.arguments[first_argument + i]).literal);
        }
        codes_.emplace(key_, code);
    }
    last_key_ = key_;
    last_code_ = code;
    return code;
}

} // namespace lsys
