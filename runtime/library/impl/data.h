// The data of the public Grammar, Word, Plant and Mesh.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"

#include <cstdint>
#include <lsys/grammar.h>
#include <lsys/plant.h>
#include <lsys/word.h>
#include <memory>
#include <string>
#include <vector>

namespace lsys::v0 {

struct Grammar::Data {
    std::string name;
    ::lsys::Grammar grammar; // not folded; calls work on copies
    std::vector<Constant> constants;
};

/// A copy for a call, which may fold its bytecode and add files to its sources; without names and
/// program, which only compilation needs.
[[nodiscard]] ::lsys::Grammar copy_of(const Grammar& grammar);

struct Word::Data {
    Bytecode bytecode; // folded, with the codes of `derived`
    DerivedWord derived;
    std::vector<ModuleKind> kinds;
};

struct Plant::Data {
    ::lsys::Plant plant;
    std::string grammar; // file name of the grammar, for exported files
};

struct Mesh::Data {
    ::lsys::Mesh mesh;
    std::vector<MeshPart> parts;
    std::vector<Material> materials;
    std::uint32_t threads = 0;
};

} // namespace lsys::v0
