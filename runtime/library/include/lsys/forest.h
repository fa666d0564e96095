// SPDX-License-Identifier: MIT
// Forest: trees of some species on a ground, from a scene file, grammars or given places; its
// instances as arrays for renderers, and its files. Metres, right-handed axes, +Y up. Arrays are
// spans into the Forest or Instances, without a copy: they are valid as long as any copy of the
// Forest or Instances exists.
//
// A hero is a plant that is derived in full. Trees are assembled from branches of heroes; `rho` is
// the probability that a branch of a hero is replaced by an earlier recorded one. A stage is the
// plants of a species with the same number of generations. docs/library.md explains forests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lsys/api.h>
#include <lsys/export.h>
#include <lsys/grammar.h>
#include <lsys/outcome.h>
#include <lsys/plant.h>
#include <lsys/project.h>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lsys::LSYS_INTERFACE {

/// A tree. Its shape depends only on the key of the forest and on its species, age and number; if
/// its species senses its surroundings, also on the lowest three bits of its yaw, which number the
/// case of its surroundings. 28 bytes.
struct Tree {
    Vector3 position; // position of the turtle at the start
    float yaw = 0.0F; // radians about +Y
    float scale = 1.0F;
    std::uint32_t number = 0;  // determines the branches of the tree
    std::uint16_t species = 0; // index in Forest::species()
    std::uint16_t age = 0;     // years; 0: the last stage of its species
};

struct Species {
    std::string name;
    /// Generations of each stage, ascending; six stages in a row have equal generations if the
    /// species senses its surroundings.
    std::vector<std::uint32_t> generations;
    std::uint32_t heroes = 0; // plants derived in full, per stage
    float height = 0.0F;      // m, of `#set height`; 0: not set
};

struct ForestOptions {
    GrammarOptions grammar; // options for the grammars of all species
    /// Options of `lsc forest` that replace values of the scene: {"count", "500"}, {"rho", "0"},
    /// {"placement", "poisson"}. With rho 0 every tree is a whole hero.
    Options scene;
};

/// Sums over all trees. A branch is an instance; a tree has at least one.
struct ForestCounts {
    std::uint64_t trees = 0;
    std::uint64_t branches = 0;
    std::uint64_t segments = 0;
    std::uint64_t objects = 0;
    std::uint64_t polygons = 0;
    std::uint32_t max_branches = 0; // max branches of one tree
};

/// Cheap to copy, immutable, safe to use from several threads at once.
class LSYS_API Forest {
public:
    /// The seed of all choices of the trees.
    [[nodiscard]] std::uint64_t key() const;
    [[nodiscard]] const std::vector<Species>& species() const;
    [[nodiscard]] std::span<const Tree> trees() const;
    /// Expands all trees.
    [[nodiscard]] ForestCounts count() const;

    struct Data;
    explicit Forest(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

/// Grows the forest of a scene (.toml), or of grammars, one species each, like `lsc forest`.
[[nodiscard]] LSYS_API Outcome<Forest> grow_forest(const std::vector<std::string>& files,
                                                   const ForestOptions& options = {},
                                                   const Project& project = {});
/// Grows trees at given places. Tree::species: index in `grammars`. Options of placement have no
/// effect. Status::Failed: an unknown species, a number that is not finite, a scale that is not
/// above 0.
[[nodiscard]] LSYS_API Outcome<Forest> forest_of_places(const std::vector<std::string>& grammars,
                                                        std::span<const Tree> places,
                                                        const ForestOptions& options = {},
                                                        const Project& project = {});

/// An instance: its mesh is scaled, then rotated, then translated. 40 bytes.
struct Instance {
    Vector3 position;
    float scale = 1.0F;
    Quaternion rotation;
    std::uint32_t tree = 0;  // index in Forest::trees()
    std::uint32_t group = 0; // index in Instances::groups()
};

/// A draw call: `instance_count` instances, from `first_instance` on, of `part_count` parts of a
/// mesh, from `first_part` on.
struct InstanceGroup {
    std::uint32_t mesh = 0;       // index in Instances::meshes()
    std::uint32_t first_part = 0; // index in Mesh::parts()
    std::uint32_t part_count = 0;
    std::uint64_t first_instance = 0;
    std::uint64_t instance_count = 0;
};

/// Cheap to copy, immutable, safe to use from several threads at once.
class LSYS_API Instances {
public:
    /// One mesh for each species and stage, with all heroes; a group draws some of its parts.
    [[nodiscard]] const std::vector<Mesh>& meshes() const;
    [[nodiscard]] const std::vector<InstanceGroup>& groups() const;
    [[nodiscard]] std::span<const Instance> all() const; // sorted by group
    /// Writes `count` instances from `first` on as matrices of 16 floats, column by column, on
    /// several threads. `stride`: bytes from one to the next; 0: 64. Precondition: first + count <=
    /// all().size().
    void
    read_matrices(std::uint64_t first, std::uint64_t count, void* to, std::size_t stride = 0) const;

    struct Data;
    explicit Instances(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

/// Expands all trees and meshes their branches. `mesh.method`: not Solid.
[[nodiscard]] LSYS_API Outcome<Instances>
make_instances(const Forest& forest, const MeshOptions& mesh = {}, const Project& project = {});
/// The ground below the trees.
[[nodiscard]] LSYS_API Outcome<Mesh> make_ground(const Forest& forest, const Project& project = {});

/// Writes `path`, whose extension sets the format (json: statistics), and the pictures beside it.
/// All files appear when they are complete, or none. Returns their paths. Options: the options of
/// `lsc forest` for files: preset, compress, expand, bake, instances, viewpoint, unit, pivot,
/// collision, up, cell, frames, and the options of meshes. {"instances", "trees"}, {"instances",
/// "lods"} and `frames` grow the forest again.
[[nodiscard]] LSYS_API Outcome<std::vector<std::string>> save_forest(const Forest& forest,
                                                                     const std::string& path,
                                                                     const Options& options = {},
                                                                     const Project& project = {});
/// Like save_forest(), but passes the files to `receive`.
[[nodiscard]] LSYS_API Outcome<std::vector<std::string>> write_forest(const Forest& forest,
                                                                      const std::string& name,
                                                                      const FileReceiver& receive,
                                                                      const Options& options = {},
                                                                      const Project& project = {});

} // namespace lsys::LSYS_INTERFACE
