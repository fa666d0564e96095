// SPDX-License-Identifier: MIT
// SweepCompiler: makes the operations of a SweepMachine from the code of a production. interpret()
// runs the code with this class as its Domain, whose values are nodes of a graph: an operand or an
// operation on earlier nodes. A node that several others read, as local values are, is computed
// once and stored in a slot.
#pragma once

#include "compiler/bytecode/interpret.h"
#include "runtime/derive/engine/sweep_machine.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace lsys {

/// Modules whose random draws are made together.
inline constexpr std::uint32_t kSweepLanes = 64;

/// The data that all productions of a sweep use.
struct SweepCode {
    std::vector<SweepOperation> operations;
    std::vector<float> constants; // step(), steps(), the globals, literals
    /// Numbers of the blocks of four draws that some production uses. Draw w of block
    /// draw_blocks[b] is read at index (4 b + w) * kSweepLanes of the array kDrawBase.
    std::vector<std::uint32_t> draw_blocks;
    std::uint32_t slot_count = 0;
    std::uint32_t value_count = 0; // max values of a production

    /// The operand of draw `number` of a module.
    [[nodiscard]] SweepOperand draw(std::uint64_t number);
};
inline constexpr std::uint32_t kStepConstant = 0;
inline constexpr std::uint32_t kStepsConstant = 1;
inline constexpr std::uint32_t kFirstGlobal = 2;

/// A node of the graph: its index in the order in which nodes are made.
struct SweepNode {
    std::uint32_t id = 0;
};

class SweepCompiler : public UnknownDomain<SweepNode> {
public:
    /// `first_draw`: number of the draw for random range 0 of the production.
    SweepCompiler(const Bytecode& bytecode, SweepCode& code, std::uint64_t first_draw);

    /// Declares that formals of `item` are read from `base`.
    void add_module(const PatternItem& item, std::uint32_t base);
    /// Compiles the condition or weight at `first`; its value is the result of the run. Returns the
    /// index of the first operation.
    [[nodiscard]] std::uint32_t condition(std::uint32_t first);
    /// Compiles a successor. Several values are emitted; a single one is the result of the run.
    [[nodiscard]] std::uint32_t successor(const WordTemplate& word);
    /// Whether the code uses random draws.
    [[nodiscard]] bool draws() const { return draws_; }

    // Domain
    SweepNode literal(float value);
    [[nodiscard]] SweepNode formal(std::uint32_t index);
    SweepNode global(std::uint32_t index) { return leaf({kConstantBase, kFirstGlobal + index}); }
    SweepNode step() { return leaf({kConstantBase, kStepConstant}); }
    SweepNode steps() { return leaf({kConstantBase, kStepsConstant}); }
    SweepNode branch_draw(std::uint32_t branch);
    SweepNode unary(Opcode opcode, SweepNode x);
    SweepNode binary(Opcode opcode, SweepNode x, SweepNode y);
    SweepNode curve(std::uint32_t index, SweepNode x);
    SweepNode mix(SweepNode x, SweepNode y, SweepNode t);
    SweepNode choice(SweepNode x, SweepNode y, SweepNode z);
    void first_side(SweepNode condition);
    void second_side(SweepNode condition);
    bool random_draw(
        Opcode opcode, SweepNode& x, SweepNode y, std::uint32_t index, const std::uint32_t* at);
    bool take(SweepNode x, const std::uint32_t* at);

private:
    enum class Kind : std::uint8_t { Operand, Unary, Binary, Curve, Mix, Choice, Draw };
    struct Node {
        Kind kind = Kind::Operand;
        Opcode opcode = Opcode::End; // Unary, Binary, Draw
        SweepOperand operand;        // Operand: itself; Draw: the draw; Curve: index of the curve
        std::array<std::uint32_t, 3> inputs{};
        std::uint32_t input_count = 0;
        std::uint32_t depth = 0; // operations on the longest way to a stored value
        std::uint32_t uses = 0;
        bool is_checked = false; // a Draw that may be invalid; inputs[2] says whether it is needed
        bool is_stored = false;  // computed before the nodes that use it
    };
    struct Source {
        std::uint32_t first = 0; // index of the first formal
        std::uint32_t count = 0; // number of formals
        std::uint32_t base = 0;
    };

    SweepNode leaf(SweepOperand operand);
    SweepNode add(Kind kind,
                  Opcode opcode,
                  std::initializer_list<SweepNode> inputs,
                  SweepOperand operand = {});
    /// The value of a node, if it is a constant of the whole derivation.
    [[nodiscard]] std::optional<float> known(std::uint32_t id) const;
    void run(std::uint32_t first, std::vector<SweepNode>& slots);
    /// Writes the operations that compute the nodes in taken_.
    void write_taken();
    /// Counts the uses of all nodes that are needed.
    void count_uses();
    void write(SweepFunction function,
               SweepOperand x = {},
               SweepOperand y = {},
               Opcode opcode = Opcode::End);
    /// Writes operations whose result is node `id`.
    void load(std::uint32_t id);
    void load_binary(const Node& node);
    void load_draw(const Node& node);
    /// The node as an operand; stores it in a slot if it is not one.
    [[nodiscard]] SweepOperand operand(std::uint32_t id);
    [[nodiscard]] SweepOperand store();

    const Bytecode& bytecode_;
    SweepCode& code_;
    std::uint64_t first_draw_;
    std::vector<Source> sources_;
    std::vector<Node> nodes_;
    std::vector<SweepNode> taken_;
    std::vector<std::uint32_t> guards_; // guard_ before each choice that is being compiled
    std::uint32_t guard_ = kNone;       // node that is 0 if the current side is not taken, or kNone
    std::uint32_t slots_ = 0;           // slots used
    std::uint32_t written_ = 0;         // operations of the current code
    bool draws_ = false;
};

} // namespace lsys
