// SPDX-License-Identifier: MIT
// The data of the public Grammar, Word, Plant and Mesh.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"

#include <cstdint>
#include <lsys/grammar.h>
#include <lsys/plant.h>
#include <lsys/project.h>
#include <lsys/word.h>
#include <memory>
#include <string>
#include <vector>

namespace lsys::v0 {

struct Grammar::Data {
    std::string name;
    std::string file;                // FilePolicy::named: the name, or "-" for a text of the caller
    std::vector<std::string> inputs; // paths of the files that were read, which no export replaces
    Policy policy;                   // policy with which the grammar was read
    ::lsys::Grammar grammar;         // not folded; calls work on copies
    std::vector<Constant> constants;
};

/// A copy that a call may change, by folding the bytecode and adding files to the sources. Omits
/// names and program, which only compilation needs.
[[nodiscard]] ::lsys::Grammar copy_of(const ::lsys::Grammar& grammar);

struct Word::Data {
    Grammar grammar;
    DerivedWord derived;
    std::vector<ModuleKind> kinds;

    /// The bytecode that defines the codes of the word.
    [[nodiscard]] const Bytecode& bytecode() const {
        return derived.folded ? *derived.folded : grammar.data().grammar.bytecode;
    }
};

struct Plant::Data {
    ::lsys::Plant plant;
    Grammar grammar;                 // needed for bending and growth
    ::lsys::PlantOptions options;    // options with which the plant was grown
    std::vector<std::string> inputs; // paths of the files that its growth has read
};

struct Mesh::Data {
    std::shared_ptr<const ::lsys::Mesh> mesh; // never null
    std::vector<MeshPart> parts;
    std::vector<Material> materials;
    std::uint32_t threads = 0;
};

/// A mesh of the pipeline as a public one.
[[nodiscard]] Mesh public_mesh(std::shared_ptr<const ::lsys::Mesh> mesh, std::uint32_t threads);
/// What is wrong with mesh options: a value out of its range. Empty: nothing.
[[nodiscard]] std::string mistake_of(const MeshOptions& options);
[[nodiscard]] ::lsys::MeshOptions inner_mesh_options(const MeshOptions& options);
[[nodiscard]] ::lsys::GrammarOptions inner_grammar_options(const GrammarOptions& options);

} // namespace lsys::v0
