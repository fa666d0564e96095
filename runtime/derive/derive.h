// SPDX-License-Identifier: MIT
// Derivation: from Bytecode to words, generation by generation (docs/language.md sections 4 to 6).
// The result depends on bytecode, seed and number of generations alone, not on threads or chunks.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/outcome.h"
#include "runtime/base/limits.h"
#include "runtime/derive/word.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class RuntimeErrorKind : std::uint8_t {
    NotFinite,       // a parameter, condition or weight is infinite or not a number
    RangeReversed,   // {min, max} with min > max
    RangeTooWide,    // a bound or the width is not finite
    BadDistribution, // a distribution whose arguments are outside their bounds
    NegativeWeight,  // a weight of a production is below 0
    WeightsTooLarge, // the sum of the weights of a choice is not finite
    OutOfBounds,     // a #param outside its bounds
    Unbalanced,      // a `]` or `}` without its partner in the last word, of age `generation`
    TooDeep,         // a #decompose or #interpret production still matches after the last pass
    SenseNotFinite,  // an answer to a sense module is infinite or not a number
    SenseFailed,     // an environment has no answer; `text` says why
};

/// The facts of a run-time error; runtime_diagnostic() makes the message.
struct RuntimeError {
    RuntimeErrorKind kind{};
    ProductionId production = kNoProduction; // kNoProduction: the axiom or a global
    /// Index in Bytecode::sites: the expression, or the production's name.
    std::uint32_t site = kNone;
    std::uint32_t generation = 0; // age of the word being rewritten; kStartGeneration: at the start
    std::uint64_t position = 0;   // index of the module in that word
    SymbolId symbol = kNoSymbol;  // the symbol of the module
    std::vector<float> parameters; // the parameters of the module
    float value = 0.0F;            // for NotFinite, OutOfBounds and errors of weights
    /// Arguments of the range or distribution, for RangeReversed, RangeTooWide and BadDistribution.
    float first_argument = 0.0F;
    float second_argument = 0.0F;
    Opcode opcode = Opcode::Range; // for BadDistribution
    /// Index in Bytecode::globals, for OutOfBounds and errors while globals are drawn; else kNone.
    std::uint32_t global = kNone;
    bool in_condition = false;         // true: in a condition or weight; false: in an argument
    bool in_weight = false;            // true: in a weight; in_condition is then also true
    std::uint32_t environment = kNone; // for SenseFailed: index in Bytecode::environments, or kNone
    std::string text; // for SenseFailed: the reason, for example "its program has ended"
    std::string help; // for SenseFailed: advice for the author, or empty
};

struct DerivationEnd;

/// Answers the sense modules `?NAME` of words (docs/language.md section 13). A derivation uses one
/// object from its start to its end; runtime/environment implements it.
class WordSense {
public:
    WordSense() = default;
    virtual ~WordSense() = default;
    WordSense(const WordSense&) = delete;
    WordSense& operator=(const WordSense&) = delete;

    /// Begins a derivation: sets up the data that environments keep from word to word, such as
    /// markers. `globals`: the values of Bytecode::globals. Sets `end` if it returns a Stop.
    [[nodiscard]] virtual std::optional<Stop> begin(std::uint64_t seed,
                                                    std::uint32_t generations,
                                                    std::span<const float> globals,
                                                    DerivationEnd& end) = 0;
    /// Writes the answers to the sense modules of `word`, a complete word of age `age`, into their
    /// first parameters. Sets `end` if it returns a Stop; the parameters of the word are then
    /// unspecified.
    [[nodiscard]] virtual std::optional<Stop>
    sense(Word& word, std::uint32_t age, DerivationEnd& end) = 0;
    /// The data that environments keep from one word to the next, such as markers that are left, as
    /// bytes for a saved state. Empty if environments keep no data.
    [[nodiscard]] virtual std::string state() const = 0;
    /// Continues from bytes of state(), after begin(). False: the bytes are not of this program.
    [[nodiscard]] virtual bool restore(std::string_view state) = 0;
};

/// A pass of a step of a derivation, for DeriveOptions::on_pass.
struct DerivationPass {
    enum class Kind : std::uint8_t { Cut, Rewrite, Decompose, Interpret, Sense, Down, Up };
    Kind kind = Kind::Rewrite;
    std::uint32_t rule = kNone;   // the only rule of the pass; kNone: all rules of its stage
    std::uint32_t number = 0;     // Decompose, Interpret: index among the passes of this kind
    std::uint32_t generation = 0; // key of its random draws; value of step() in the grammar
    std::uint64_t first_draw = 0; // number of the first draw of each module
    const Word* in = nullptr;     // the word that the pass reads
    const Word* out = nullptr;    // null: the pass is about to begin
    /// Down, Up: the module at which the sweep ended with an error; kNoFault: none. Modules that
    /// the sweep had not visited are equal in `in` and `out`.
    std::uint64_t fault = kNoFault;
    static constexpr std::uint64_t kNoFault = ~std::uint64_t{0};
};

struct DeriveOptions {
    std::uint32_t generations = 0; // number to derive; value of steps() in the grammar
    std::uint64_t seed = 0;
    std::uint32_t threads = 0; // 0: as many as the machine has
    /// Whether to keep the origin of each module: 8 bytes per module, and slower passes.
    bool origins = false;
    Limits limits;
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
    /// Answers the sense modules; not null if the bytecode has any. Outlives the derivation.
    WordSense* senses = nullptr;
    /// Max modules per chunk of a thread. Words do not depend on it; tests make it small.
    std::uint32_t chunk_modules = 1U << 16;
    /// Called after each generation, and several times during a long one; from any thread, but
    /// never from two at once.
    std::function<void(std::uint32_t generation, std::uint64_t modules_written)> progress;
    /// Called before and after each pass. Before a pass, each origin in `in` is set to the index of
    /// its module, so the origins in `out` name the modules of `in` that were rewritten. Not called
    /// for passes that cannot change the word; not called after a pass that ends with an error,
    /// except a sweep. Precondition: `origins`; fewer than 2^32 modules.
    std::function<void(const DerivationPass& pass)> on_pass;
};

/// The reason why a derivation ended before its last word, as facts for messages.
struct DerivationEnd {
    std::optional<Stop> stop; // none: the derivation is complete, or may go on
    RuntimeError error;       // set with Stop::Diagnosed
    LimitReport limit;        // set with Stop::Limit and Stop::OutOfMemory
};

/// One derivation in progress. The bytecode must outlive the object. Functions that return a Stop
/// return none on success; end() has the facts.
class Derivation {
public:
    Derivation(const Bytecode& bytecode, DeriveOptions options);
    ~Derivation();
    Derivation(Derivation&&) noexcept;
    Derivation& operator=(Derivation&&) noexcept;

    /// Draws the globals and makes the axiom. start() or resume() must be called first.
    [[nodiscard]] std::optional<Stop> start();
    /// Continues from a saved word of age `age`. Globals are drawn again from the seed, with the
    /// same values. Modules of a word without origins get unknown origins. `sense_state`: the
    /// WordSense::state() that was saved with the word.
    [[nodiscard]] std::optional<Stop>
    resume(Word word, std::uint32_t age, std::string_view sense_state = {});
    /// WordSense::state() after the last generation, to be saved with the word.
    [[nodiscard]] std::string sense_state() const;
    /// Rewrites the word once. After a Stop the word still has the age age().
    [[nodiscard]] std::optional<Stop> step();
    /// Steps until the age is `age`, or until a Stop.
    [[nodiscard]] std::optional<Stop> run_to(std::uint32_t age);
    /// Runs the whole derivation: start(), run_to(DeriveOptions::generations), check_brackets().
    [[nodiscard]] std::optional<Stop> derive();
    /// Applies the productions of `#interpret` to the word, which becomes the word to draw. No
    /// step() may follow. The class Interpretation does the same without storing words.
    [[nodiscard]] std::optional<Stop> interpret();
    /// Starts to follow the modules of the word: sets each origin to the index of its module, with
    /// age() and the bit kFollowed as generation. After step() an origin names the module of the
    /// former word that was copied or, if the generation is the new age, rewritten. Returns false
    /// if the word has more than 2^32 - 1 modules. Precondition: DeriveOptions::origins.
    [[nodiscard]] bool follow();
    /// Checks that every `]` and `}` of the word has its partner. Commands call it on the last
    /// word. The error names the production that wrote the bracket if only one can have written it.
    [[nodiscard]] std::optional<Stop> check_brackets();

    [[nodiscard]] const Word& word() const;
    [[nodiscard]] std::uint32_t age() const;
    [[nodiscard]] const DerivationEnd& end() const;
    [[nodiscard]] const RuntimeError& error() const { return end().error; }
    [[nodiscard]] const LimitReport& limit() const { return end().limit; }
    [[nodiscard]] const std::vector<float>& globals() const;
    [[nodiscard]] Word take_word();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
