// SPDX-License-Identifier: MIT
// Derives up to four generations within small limits, for the fuzz targets. Files that environments
// name are not read: each mesh is a tetrahedron, each picture has one pixel.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/derive/state_file.h"
#include "runtime/environment/word_sense.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

/// How a derivation is divided; the word must not depend on it.
struct Division {
    std::uint32_t threads = 1;
    std::uint32_t chunk_modules = 1U << 16;
    /// Answers environments of kind Program; empty: deriving a grammar that has one fails.
    lsys::ProgramCommand program{};
};

class SmallDerivation {
public:
    static constexpr std::uint64_t kMaxModules = 4'000;
    static constexpr std::uint64_t kMaxBytes = 16U << 20;

    /// `bytecode` must outlive the object.
    explicit SmallDerivation(const lsys::Bytecode& bytecode)
        : SmallDerivation(bytecode, Division{}) {}
    SmallDerivation(const lsys::Bytecode& bytecode, const Division& division)
        : files_(files_of(bytecode)), senses_(bytecode, sense_options(files_, division)),
          options_(options_of(bytecode, division, senses_)), derivation_(bytecode, options_) {}

    /// Derives all generations. Returns a Stop if the derivation ends early.
    [[nodiscard]] std::optional<lsys::Stop> run() {
        const std::optional<lsys::Stop> stop = derivation_.start();
        return stop ? stop : derivation_.run_to(options_.generations);
    }
    /// Derives all generations, and checks the brackets of the last word.
    [[nodiscard]] std::optional<lsys::Stop> derive() { return derivation_.derive(); }
    /// Continues a saved derivation to the age `last`, and checks the brackets.
    [[nodiscard]] std::optional<lsys::Stop> resume(lsys::SavedState state, std::uint32_t last) {
        std::optional<lsys::Stop> stop =
            derivation_.resume(std::move(state.word), state.header.age, state.sense_state);
        stop = stop ? stop : derivation_.run_to(last);
        return stop ? stop : derivation_.check_brackets();
    }
    [[nodiscard]] const lsys::Word& word() const { return derivation_.word(); }
    [[nodiscard]] lsys::Derivation& derivation() { return derivation_; }
    [[nodiscard]] const lsys::DeriveOptions& options() const { return options_; }

private:
    static std::vector<lsys::EnvironmentFiles> files_of(const lsys::Bytecode& bytecode) {
        std::vector<lsys::EnvironmentFiles> all(bytecode.environments.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            const lsys::BytecodeEnvironment& declared = bytecode.environments[i];
            if (declared.kind == lsys::EnvironmentKind::Map) {
                all[i].picture = {1, 1, {0.5}};
                continue;
            }
            for (const lsys::EnvironmentSurface& surface : declared.surfaces) {
                if (!surface.path.empty()) {
                    all[i].meshes.push_back(
                        {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
                }
            }
        }
        return all;
    }
    static lsys::SenseOptions sense_options(const std::vector<lsys::EnvironmentFiles>& files,
                                            const Division& division) {
        lsys::SenseOptions options;
        options.files = &files;
        options.programs.assign(files.size(), division.program);
        options.threads = division.threads;
        options.max_bytes = kMaxBytes;
        return options;
    }
    static lsys::DeriveOptions
    options_of(const lsys::Bytecode& bytecode, const Division& division, lsys::WordSense& senses) {
        lsys::DeriveOptions options;
        options.generations = std::min<std::uint32_t>(bytecode.generations.value_or(3), 4);
        options.seed = bytecode.settings.seed;
        options.threads = division.threads;
        options.chunk_modules = division.chunk_modules;
        options.limits.max_modules = kMaxModules;
        options.limits.max_bytes = kMaxBytes;
        options.senses = &senses;
        return options;
    }

    std::vector<lsys::EnvironmentFiles> files_;
    lsys::EnvironmentSense senses_;
    lsys::DeriveOptions options_;
    lsys::Derivation derivation_;
};
