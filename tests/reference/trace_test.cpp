// SPDX-License-Identifier: MIT
// Traces all modules of random grammars: the successor in each trace must equal the modules that
// the runtime has written.
#include "runtime/derive/derive.h"
#include "runtime/derive/trace.h"
#include "tests/reference/compile_case.h"
#include "tests/reference/generate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace lsys::reference {

namespace {

lsys::Word copy_of(const lsys::Word& word) {
    lsys::Word copy(word.code_width());
    REQUIRE(copy.resize(word.module_count(), word.parameter_count()));
    std::copy(word.code_bytes().begin(), word.code_bytes().end(), copy.code_bytes().begin());
    std::copy(word.parameters().begin(), word.parameters().end(), copy.parameters().begin());
    return copy;
}

/// Counts of the results in all traces.
struct Seen {
    std::array<std::uint64_t, kCountOf<Fate>> fates{};
    std::array<std::uint64_t, kCountOf<Verdict>> verdicts{};
    std::array<std::uint64_t, 7> kinds{}; // by DerivationPass::Kind
    std::uint64_t choices = 0;
    std::uint64_t ranges = 0;
    std::uint64_t faults_found = 0;
};

void count(const StepTracer& tracer, Seen& seen) {
    for (const ModuleTrace& trace : tracer.traces()) {
        ++seen.fates[static_cast<std::size_t>(trace.fate)];
        ++seen.kinds[static_cast<std::size_t>(trace.kind)];
        seen.choices += trace.choice ? 1U : 0U;
        seen.ranges += trace.ranges.size();
        for (const Attempt& attempt : trace.attempts) {
            ++seen.verdicts[static_cast<std::size_t>(attempt.verdict)];
        }
    }
}

/// Traces all modules of a word in one step, or in its interpretation. Returns false if the runtime
/// reports an error.
bool check_step(const Bytecode& bytecode,
                DeriveOptions options,
                const lsys::Derivation& from,
                bool interprets,
                Seen& seen) {
    StepTracer tracer(bytecode,
                      {options.seed, static_cast<float>(options.generations), from.globals(), {}});
    std::vector<std::uint64_t> all(from.word().module_count());
    std::iota(all.begin(), all.end(), 0);
    tracer.begin(all, from.word(), from.age(),
                 interprets ? DerivationPass::Kind::Interpret : DerivationPass::Kind::Rewrite);
    options.on_pass = [&](const DerivationPass& pass) { tracer.on_pass(pass); };
    lsys::Derivation stepping(bytecode, options);
    REQUIRE(!stepping.resume(copy_of(from.word()), from.age()));
    const std::optional<Stop> stop = interprets ? stepping.interpret() : stepping.step();
    tracer.finish();
    if (stop == Stop::Limit) {
        return false; // the interpretation grows without end
    }
    if (stop) {
        // The runtime reports the first module of a pass that fails; the trace of this module must
        // fail, too.
        const bool is_found =
            std::any_of(tracer.traces().begin(), tracer.traces().end(), [&](const auto& trace) {
                return trace.fate == Fate::Failed && trace.position == stepping.error().position;
            });
        const bool is_value = stepping.error().kind != RuntimeErrorKind::TooDeep;
        CHECK((!is_value || is_found));
        seen.faults_found += is_found ? 1U : 0U;
        return false;
    }
    CHECK(tracer.agrees());
    const auto wrong =
        std::find_if(tracer.traces().begin(), tracer.traces().end(),
                     [](const ModuleTrace& trace) { return !trace.is_checked || !trace.agrees; });
    if (wrong != tracer.traces().end()) {
        FAIL_CHECK("module " << wrong->position << " of generation " << wrong->generation
                             << ", pass " << static_cast<int>(wrong->kind) << " " << wrong->pass
                             << ", rule " << wrong->rule << ", fate "
                             << static_cast<int>(wrong->fate) << ", run " << wrong->was_run
                             << ", checked " << wrong->is_checked);
    }
    CHECK(tracer.places().size() == stepping.word().module_count());
    count(tracer, seen);
    return true;
}

} // namespace

TEST_CASE("traces of random grammars agree with the engine, module by module") {
    Seen seen;
    for (std::uint64_t seed = 5001; seed <= 5120; ++seed) {
        const Case test_case = generate(seed);
        std::string messages;
        const std::optional<Bytecode> bytecode = compile_case(test_case, messages);
        INFO("seed " << seed << "\n" << messages);
        REQUIRE(bytecode);
        DeriveOptions options;
        options.generations =
            test_case.request.generations.value_or(bytecode->generations.value_or(0));
        options.seed = test_case.request.seed.value_or(bytecode->settings.seed);
        options.threads = 1;
        options.origins = true;
        options.limits.max_modules = 100'000;
        lsys::Derivation derivation(*bytecode, options);
        if (derivation.start()) {
            continue;
        }
        while (derivation.word().module_count() < 1000) {
            if (!check_step(*bytecode, options, derivation, true, seen) ||
                !check_step(*bytecode, options, derivation, false, seen) ||
                derivation.age() == options.generations) {
                break;
            }
            REQUIRE(!derivation.step());
        }
    }
    // Every kind of result in a trace occurs often.
    for (const Fate fate : enumerators_of<Fate>()) {
        INFO("fate " << static_cast<int>(fate));
        CHECK((fate == Fate::Failed || fate == Fate::Sensed ||
               seen.fates[static_cast<std::size_t>(fate)] > 20));
    }
    for (const Verdict verdict : enumerators_of<Verdict>()) {
        INFO("verdict " << static_cast<int>(verdict));
        CHECK((verdict == Verdict::Fault || seen.verdicts[static_cast<std::size_t>(verdict)] > 20));
    }
    for (std::size_t kind = 0; kind < seen.kinds.size(); ++kind) {
        INFO("kind " << kind);
        CHECK((kind == static_cast<std::size_t>(DerivationPass::Kind::Sense) ||
               seen.kinds[kind] > 20));
    }
    CHECK(seen.choices > 1000);
    CHECK(seen.ranges > 1000);
    CHECK(seen.faults_found > 5);
}

} // namespace lsys::reference
