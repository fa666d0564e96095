// SPDX-License-Identifier: MIT
// Derives up to four generations within small limits, for the fuzz targets. Files that environments
// name are not read: each mesh is a tetrahedron, each picture has one pixel.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/environment/word_sense.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

class SmallDerivation {
public:
    /// `bytecode` must outlive the object.
    explicit SmallDerivation(const lsys::Bytecode& bytecode)
        : files_(files_of(bytecode)), senses_(bytecode, sense_options(files_)),
          options_(options_of(bytecode, senses_)), derivation_(bytecode, options_) {}

    /// Derives all generations. Returns a Stop if the derivation ends early.
    [[nodiscard]] std::optional<lsys::Stop> run() {
        const std::optional<lsys::Stop> stop = derivation_.start();
        return stop ? stop : derivation_.run_to(options_.generations);
    }
    [[nodiscard]] const lsys::Word& word() const { return derivation_.word(); }

private:
    static constexpr std::uint64_t kMaxBytes = 16U << 20;

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
    static lsys::SenseOptions sense_options(const std::vector<lsys::EnvironmentFiles>& files) {
        lsys::SenseOptions options;
        options.files = &files;
        options.programs.resize(files.size());
        options.threads = 1;
        options.max_bytes = kMaxBytes;
        return options;
    }
    static lsys::DeriveOptions options_of(const lsys::Bytecode& bytecode, lsys::WordSense& senses) {
        lsys::DeriveOptions options;
        options.generations = std::min<std::uint32_t>(bytecode.generations.value_or(3), 4);
        options.threads = 1;
        options.limits.max_modules = 20'000;
        options.limits.max_bytes = kMaxBytes;
        options.senses = &senses;
        return options;
    }

    std::vector<lsys::EnvironmentFiles> files_;
    lsys::EnvironmentSense senses_;
    lsys::DeriveOptions options_;
    lsys::Derivation derivation_;
};
