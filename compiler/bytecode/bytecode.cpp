// SPDX-License-Identifier: MIT
#include "compiler/bytecode/bytecode.h"

#include "compiler/bytecode/impl/bytecode_contents.h"
#include "compiler/bytecode/instructions.h"
#include "grammar/base/contract.h"
#include "grammar/base/hash.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lsys {

namespace {

constexpr std::array<OpcodeInfo, kOpcodeCount> kOpcodes{{
#define LSYS_OPCODE(identifier, mnemonic, operand, pops, pushes, value, meaning)                   \
    {mnemonic, OperandKind::operand, pops, pushes, meaning},
#include "compiler/bytecode/opcodes.def"
#undef LSYS_OPCODE
}};
static_assert(kOpcodeCount <= 256, "an opcode is eight bits of an instruction");

/// Initial value of the hash, before any field is combined.
constexpr std::uint64_t kStart = 0x6C73797374656D73; // "lsystems"

/// Combines all fields that can affect the derived word.
class Digest {
public:
    [[nodiscard]] std::uint64_t result() const { return finish(state_); }

    IgnoringStream outside_digest() { return {}; }
    void implied(bool value) { number(std::uint64_t{value}); }
    template <typename Value>
    void number(const Value& value) {
        state_ = combine(state_, value);
    }
    template <typename Value>
    void number_or_none(const Value& value) {
        if (static_cast<std::uint32_t>(value) != kNone) {
            number(static_cast<std::uint64_t>(value));
        }
    }
    void real(const float& value) { number(std::bit_cast<std::uint32_t>(value)); }
    void truth(const bool& value) { number(std::uint64_t{value}); }
    template <typename Enum>
    void tag(const Enum& value) {
        number(static_cast<std::uint64_t>(value));
    }
    template <typename Id>
    void id(const Id& value) {
        number(static_cast<std::uint64_t>(value));
    }
    void text(const std::string& value) { state_ = combine_bytes(state_, value); }
    template <typename Row, typename Function>
    void table(const std::vector<Row>& rows, Function row) {
        number(rows.size());
        for (const Row& each : rows) {
            row(*this, each);
        }
    }
    template <typename Row, typename Function>
    void table_or_none(const std::vector<Row>& rows, Function row) {
        if (!rows.empty()) {
            table(rows, row);
        }
    }
    void codes(const std::vector<Code>& codes, std::uint32_t /*width*/) {
        table(codes, [](Digest& digest, const Code& code) { digest.number(code); });
    }

private:
    std::uint64_t state_ = kStart;
};

} // namespace

const OpcodeInfo& info(Opcode opcode) {
    const auto index = static_cast<std::size_t>(opcode);
    LSYS_CHECK(index < kOpcodeCount, index);
    return kOpcodes[index];
}

CodeNeeds needs_of(std::span<const std::uint32_t> instructions) {
    CodeNeeds needs;
    std::uint32_t depth = 0;
    for (std::size_t at = 0; at < instructions.size();) {
        const Opcode opcode = opcode_of(instructions[at]);
        const OpcodeInfo& row = info(opcode);
        depth = depth - row.pops + row.pushes;
        needs.stack_depth = std::max(needs.stack_depth, depth);
        if (row.operand == OperandKind::Local) {
            needs.local_count = std::max(needs.local_count, operand_of(instructions[at]) + 1);
        }
        at += instruction_length(opcode);
    }
    return needs;
}

TableRange Bytecode::productions_of(Stage stage) const {
    const auto before = [](const BytecodeProduction& p, Stage value) { return p.stage < value; };
    const auto after = [](Stage value, const BytecodeProduction& p) { return value < p.stage; };
    const auto first = std::lower_bound(productions.begin(), productions.end(), stage, before);
    const auto last = std::upper_bound(first, productions.end(), stage, after);
    return {static_cast<std::uint32_t>(first - productions.begin()),
            static_cast<std::uint32_t>(last - first)};
}

std::uint32_t Bytecode::rewriting_rule_count() const {
    const TableRange range = productions_of(Stage::Rewrite);
    return range.count == productions.size() ? rule_count : productions[range.count].rule;
}

bool Bytecode::has_cuts() const {
    return std::any_of(symbols.begin(), symbols.end(), [](const BytecodeSymbol& symbol) {
        return symbol.turtle == TurtleOperation::Cut;
    });
}

std::uint32_t site_of(const Bytecode& bytecode, std::uint32_t instruction) {
    const auto after = std::upper_bound(
        bytecode.site_ranges.begin(), bytecode.site_ranges.end(), instruction,
        [](std::uint32_t at, const SiteRange& range) { return at < range.instruction; });
    return after == bytecode.site_ranges.begin() ? kNone : (after - 1)->site;
}

bool Bytecode::has_senses() const {
    return std::any_of(symbols.begin(), symbols.end(),
                       [](const BytecodeSymbol& symbol) { return symbol.senses(); });
}

const BytecodeAxiom* axiom_with(const Bytecode& bytecode, std::uint32_t index) {
    const auto found = std::find_if(
        bytecode.axioms.begin(), bytecode.axioms.end(), [index](const BytecodeAxiom& axiom) {
            return index - axiom.word.codes.first < axiom.word.codes.count;
        });
    return found == bytecode.axioms.end() ? nullptr : &*found;
}

ProductionId production_with(const Bytecode& bytecode, std::uint32_t index) {
    LSYS_CHECK(index < bytecode.template_codes.size(), index);
    if (axiom_with(bytecode, index) != nullptr) {
        return kNoProduction;
    }
    // Productions with empty successors begin at the same index as the next production, so the last
    // one that begins at or before `index` holds the module.
    const auto after = std::upper_bound(
        bytecode.productions.begin(), bytecode.productions.end(), index,
        [](std::uint32_t at, const BytecodeProduction& p) { return at < p.successor.codes.first; });
    return static_cast<ProductionId>(after - bytecode.productions.begin() - 1);
}

std::optional<Site> place_of(const Bytecode& bytecode, std::uint32_t index) {
    const BytecodeAxiom* const axiom = axiom_with(bytecode, index);
    const std::uint32_t site =
        axiom != nullptr
            ? axiom->site
            : bytecode.productions[static_cast<std::size_t>(production_with(bytecode, index))]
                  .name_site;
    const auto after =
        std::upper_bound(bytecode.template_places.begin(), bytecode.template_places.end(), index,
                         [](std::uint32_t at, const PlaceRun& run) { return at < run.first; });
    if (site == kNone || after == bytecode.template_places.begin()) {
        return std::nullopt;
    }
    const PlaceRun& run = *(after - 1);
    const std::uint32_t distance = (index - run.first) * run.stride;
    const std::uint32_t begin = run.begin + distance;
    return Site{{bytecode.sites[site].span.file, begin, begin + run.length},
                run.line,
                run.column + distance};
}

std::uint64_t checksum(std::string_view bytes) {
    return finish(combine_bytes(kStart, bytes));
}

std::uint64_t digest(const Bytecode& bytecode) {
    Digest digest;
    describe(digest, bytecode);
    return digest.result();
}

} // namespace lsys
