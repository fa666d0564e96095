#include "compiler/bytecode/bytecode.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lsys {

namespace {

constexpr std::array<OpcodeInfo, kOpcodeCount> kOpcodes{{
#define LSYS_OPCODE(identifier, mnemonic, operand, pops, pushes, meaning)                          \
    {mnemonic, OperandKind::operand, pops, pushes, meaning},
#include "compiler/bytecode/opcodes.def"
#undef LSYS_OPCODE
}};
static_assert(kOpcodeCount <= 256, "an opcode is eight bits of an instruction");

struct TurtleInfo {
    std::string_view name;
    bool draws;
};

constexpr std::array<TurtleInfo, kTurtleOperationCount> kTurtleOperations{{
#define LSYS_TURTLE(identifier, name, draws) {name, draws != 0},
#include "compiler/bytecode/turtle_operations.def"
#undef LSYS_TURTLE
}};

/// Mixes 64-bit words one after the other. Each step is a bijection of the state for a given word
/// and of the word for a given state, so that two sequences that differ in one word never collide.
class Mixer {
public:
    void word(std::uint64_t word) {
        state_ = (state_ ^ word) * kMultiplier;
        state_ ^= state_ >> 29;
    }
    void real(float value) { word(std::bit_cast<std::uint32_t>(value)); }
    void text(std::string_view bytes) {
        word(bytes.size());
        for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
            word(little_endian(bytes.data(), 8));
        }
        if (!bytes.empty()) {
            word(little_endian(bytes.data(), bytes.size()));
        }
    }
    template <typename Enum>
    void tag(Enum value) {
        word(static_cast<std::uint64_t>(value));
    }
    [[nodiscard]] std::uint64_t result() const {
        const std::uint64_t x = (state_ ^ (state_ >> 32)) * kMultiplier;
        return x ^ (x >> 32);
    }

private:
    static std::uint64_t little_endian(const char* bytes, std::size_t count) {
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < count; ++i) {
            word |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
        }
        return word;
    }

    static constexpr std::uint64_t kMultiplier = 0x9E3779B97F4A7C15; // 2^64 / golden ratio, odd
    std::uint64_t state_ = 0x6C73797374656D73;
};

void add(Mixer& mixer, TableRange range) {
    mixer.word(range.first);
    mixer.word(range.count);
}

void add(Mixer& mixer, const WordTemplate& word) {
    add(mixer, word.codes);
    mixer.word(word.arguments);
    mixer.word(word.parameter_count);
    mixer.word(word.draw_count);
}

} // namespace

const OpcodeInfo& info(Opcode opcode) {
    const auto index = static_cast<std::size_t>(opcode);
    LSYS_CHECK(index < kOpcodeCount, index);
    return kOpcodes[index];
}

std::string_view name_of(TurtleOperation operation) {
    const auto index = static_cast<std::size_t>(operation);
    LSYS_CHECK(index < kTurtleOperationCount, index);
    return kTurtleOperations[index].name;
}

bool draws(TurtleOperation operation) {
    const auto index = static_cast<std::size_t>(operation);
    LSYS_CHECK(index < kTurtleOperationCount, index);
    return kTurtleOperations[index].draws;
}

bool turns(TurtleOperation operation) {
    switch (operation) {
    case TurtleOperation::YawRight:
    case TurtleOperation::YawLeft:
    case TurtleOperation::PitchDown:
    case TurtleOperation::PitchUp:
    case TurtleOperation::RollRight:
    case TurtleOperation::RollLeft:
        return true;
    default:
        return false;
    }
}

TableRange Bytecode::of(Stage stage) const {
    const auto before = [](const BytecodeProduction& p, Stage value) { return p.stage < value; };
    const auto after = [](Stage value, const BytecodeProduction& p) { return value < p.stage; };
    const auto first = std::lower_bound(productions.begin(), productions.end(), stage, before);
    const auto last = std::upper_bound(first, productions.end(), stage, after);
    return {static_cast<std::uint32_t>(first - productions.begin()),
            static_cast<std::uint32_t>(last - first)};
}

std::uint32_t Bytecode::rewriting_rules() const {
    const TableRange range = of(Stage::Rewrite);
    return range.count == productions.size() ? rule_count : productions[range.count].rule;
}

bool Bytecode::cuts() const {
    return std::any_of(symbols.begin(), symbols.end(), [](const BytecodeSymbol& symbol) {
        return symbol.turtle == TurtleOperation::Cut;
    });
}

std::uint32_t site_of(const Bytecode& bytecode, std::uint32_t instruction) {
    const auto after = std::upper_bound(
        bytecode.site_marks.begin(), bytecode.site_marks.end(), instruction,
        [](std::uint32_t at, const SiteMark& mark) { return at < mark.instruction; });
    return after == bytecode.site_marks.begin() ? kNone : (after - 1)->site;
}

ProductionId writer_of(const Bytecode& bytecode, std::uint32_t index) {
    LSYS_CHECK(index < bytecode.template_codes.size(), index);
    if (index - bytecode.axiom.codes.first < bytecode.axiom.codes.count) {
        return kNoProduction;
    }
    // of several that begin there only the last is not empty
    const auto after = std::upper_bound(
        bytecode.productions.begin(), bytecode.productions.end(), index,
        [](std::uint32_t at, const BytecodeProduction& p) { return at < p.successor.codes.first; });
    return static_cast<ProductionId>(after - bytecode.productions.begin() - 1);
}

std::optional<Site> place_of(const Bytecode& bytecode, std::uint32_t index) {
    const ProductionId writer = writer_of(bytecode, index);
    const std::uint32_t site =
        writer == kNoProduction ? bytecode.axiom_site
                                : bytecode.productions[static_cast<std::size_t>(writer)].name_site;
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
    Mixer mixer;
    mixer.text(bytes);
    return mixer.result();
}

std::uint64_t digest(const Bytecode& bytecode) {
    Mixer mixer;
    mixer.tag(bytecode.settings.rewriting);
    mixer.tag(bytecode.settings.choice);
    mixer.tag(bytecode.settings.at_depth);
    mixer.word(bytecode.settings.decompose_depth);
    mixer.word(bytecode.symbols.size());
    for (const BytecodeSymbol& symbol : bytecode.symbols) {
        mixer.text(symbol.name);
        mixer.word(symbol.parameter_count);
        mixer.tag(symbol.kind);
        mixer.tag(symbol.ignored);
        mixer.tag(symbol.turtle == TurtleOperation::Cut);
    }
    mixer.word(bytecode.folded.size());
    for (const FoldedModule& module : bytecode.folded) {
        mixer.tag(module.symbol);
        mixer.word(module.first_constant);
    }
    mixer.word(bytecode.constants.size());
    for (const float constant : bytecode.constants) {
        mixer.real(constant);
    }
    mixer.word(bytecode.globals.size());
    for (const BytecodeGlobal& global : bytecode.globals) {
        mixer.word(global.instruction);
        mixer.word(global.draw_position);
        mixer.word(global.draw_count);
        mixer.tag(global.has_bounds);
        mixer.real(global.minimum);
        mixer.real(global.maximum);
    }
    mixer.word(bytecode.patterns.size());
    for (const PatternItem& item : bytecode.patterns) {
        mixer.tag(item.kind);
        mixer.tag(item.symbol);
    }
    mixer.word(bytecode.template_codes.size());
    for (const Code code : bytecode.template_codes) {
        mixer.word(code);
    }
    mixer.word(bytecode.instructions.size());
    for (const std::uint32_t instruction : bytecode.instructions) {
        mixer.word(instruction);
    }
    mixer.word(bytecode.productions.size());
    for (const BytecodeProduction& production : bytecode.productions) {
        mixer.word(production.rule);
        mixer.word(production.group);
        mixer.tag(production.stage);
        mixer.tag(production.stochastic);
        mixer.real(production.weight);
        add(mixer, production.left);
        add(mixer, production.predecessor);
        add(mixer, production.right);
        mixer.word(production.condition);
        add(mixer, production.successor);
    }
    add(mixer, bytecode.axiom);
    mixer.word(bytecode.axiom_draw_position);
    return mixer.result();
}

} // namespace lsys
