// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/forest_culling.h"

#include "viewer/gl/impl/program.h"
#include "viewer/scene/ground_horizon.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lsys::view {

namespace {

// Binding points in shaders/culling*.glsl.
constexpr GLuint kBlockBinding = 1;
constexpr GLuint kBranches = 0;
constexpr GLuint kTrees = 1;
constexpr GLuint kTables = 2;
constexpr GLuint kIdentities = 3; // also Rays, while the horizon is computed
constexpr GLuint kCells = 4;
constexpr GLuint kState = 5;
constexpr GLuint kCodes = 6;
constexpr GLuint kSums = 7;
constexpr GLuint kVisibleCells = 8;
constexpr GLuint kEntries = 9;
constexpr GLuint kCandidates = 11;
constexpr GLuint kNear = 12;
constexpr GLuint kNodes = 13;
constexpr GLuint kUnsorted = 14;
constexpr GLuint kSorted = 15;
constexpr GLuint kKeys = 16;
constexpr GLuint kDigits = 17;
constexpr GLuint kCommandKeys = 18;
constexpr GLuint kCommands = 19;
constexpr GLuint kHeightsTexture = 1;
constexpr GLuint kHorizonTexture = 6;

constexpr std::uint32_t kBlock = 256;               // number of elements that a workgroup handles
constexpr std::uint32_t kSortPart = 2048;           // number of branches that a workgroup sorts
constexpr std::uint32_t kDigitBits = 8;             // bits of a key that a pass of the sort handles
constexpr std::uint32_t kDetailSteps = 6;           // steps of the search for CullingState::detail
constexpr std::uint32_t kMaxCandidates = 1U << 20U; // max number of candidates for branches
constexpr std::uint32_t kRoomForTrees = 1U << 14U;  // number of spare records for added trees
constexpr std::size_t kIdentityBytes = 12;
constexpr std::size_t kCellBytes = 48;
constexpr std::size_t kNearBytes = 48;
constexpr std::size_t kSumsBytes = 192 * sizeof(std::uint32_t); // `sums` of State (culling.glsl)
constexpr std::uint32_t kRemoved = 0x8000'0000U;                // bit of an Identity or cell
constexpr std::size_t kPartBytes = 512;                         // of a part of the mapped buffers
static_assert(sizeof(CullingState) <= kPartBytes && sizeof(CullingState) % 4 == 0);

/// What an invocation, or with BySortPart a workgroup, of a kernel handles.
enum Dispatch : std::uint8_t { ByTree, ByCandidate, ByNearTree, ByBranch, BySortPart };

/// Identity of a tree: yaw in radians, a float as bits; Tree::number; kRemoved or 0.
using Identity = std::array<std::uint32_t, 3>;
static_assert(sizeof(Identity) == kIdentityBytes);

Identity identity_of(const ForestLod& lod, std::uint32_t number) {
    const Tree& tree = lod.tree_of(number);
    return {std::bit_cast<std::uint32_t>(tree.yaw), tree.number,
            lod.lod_tree(number).is_removed() ? kRemoved : 0};
}

/// The record of a cell, in the layout of shaders/culling_cells.comp.glsl.
using CellRecord = std::array<std::uint32_t, 12>;
static_assert(sizeof(CellRecord) == kCellBytes);

CellRecord record_of(const ForestCell& cell) {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return {bits(cell.low.x),    bits(cell.low.y),
            bits(cell.low.z),    bits(cell.tallest),
            bits(cell.high.x),   bits(cell.high.y),
            bits(cell.high.z),   cell.count | (cell.removed != 0 ? kRemoved : 0),
            bits(cell.middle.x), bits(cell.middle.y),
            bits(cell.middle.z), cell.first};
}

void wait_for_shaders() {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void run(const ProgramObject& program, std::uint32_t elements, std::uint32_t size) {
    constexpr std::uint32_t kWidest = 32768;
    const std::uint32_t groups = (elements + size - 1) / size;
    glUseProgram(program.name());
    glDispatchCompute(std::min(groups, kWidest), (groups + kWidest - 1) / kWidest, 1);
    wait_for_shaders();
}

void run(const ProgramObject& program, Dispatch size) {
    glUseProgram(program.name());
    glDispatchComputeIndirect(static_cast<GLintptr>(size * 3 * sizeof(std::uint32_t)));
    wait_for_shaders();
}

void set_parameter(const ProgramObject& program, std::uint32_t value) {
    glProgramUniform1ui(program.name(), 0, value);
}

} // namespace

/// Layout of the uniforms in shaders/culling.glsl.
struct ForestCulling::Block {
    std::array<glm::vec4, 5> planes{};
    glm::vec4 eye_pixels{0.0F};
    glm::vec4 level_pixels{0.0F};
    glm::vec4 sway{0.0F};
    glm::vec4 clusters{0.0F};
    glm::vec4 casters_low{0.0F};
    glm::vec4 casters_high{0.0F};
    std::array<std::uint32_t, 4> trees{};
    std::array<std::uint32_t, 4> limits{};
    std::array<std::uint32_t, 4> key{};
    glm::vec4 ground{0.0F};
    std::array<std::uint32_t, 4> heights{};
    std::array<std::array<std::int32_t, 4>, kTerrainLevels> origins{};
};

std::optional<std::string> lacking_for_culling(const CullingLimits& limits) {
    constexpr std::int32_t kBindings = kCommands + 1;
    constexpr std::int32_t kBlocks = 8;
    constexpr std::int32_t kInvocations = 1024;
    if (limits.storage_bindings < kBindings) {
        return fmt::format("{} of {} bindings of storage buffers", limits.storage_bindings,
                           kBindings);
    }
    if (limits.storage_blocks < kBlocks) {
        return fmt::format("{} of {} storage buffers in a compute shader", limits.storage_blocks,
                           kBlocks);
    }
    if (limits.invocations < kInvocations) {
        return fmt::format("{} of {} invocations in a workgroup", limits.invocations, kInvocations);
    }
    return std::nullopt;
}

CullingLimits culling_limits() {
    CullingLimits limits;
    glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &limits.storage_bindings);
    glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &limits.storage_blocks);
    glGetIntegerv(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, &limits.invocations);
    return limits;
}

ForestCulling::ForestCulling(Device& device)
    : device_(&device), blocks_(device, kPartBytes, MappedBuffer::Access::Write),
      states_(device, kPartBytes, MappedBuffer::Access::Read), timer_(device), rays_(device),
      tables_(device), identities_(device), cells_(device), state_(device), codes_(device),
      sums_(device), visible_cells_(device), tree_entries_(device), cluster_entries_(device),
      candidates_(device), near_(device), nodes_(device),
      branches_(device), sorted_{Buffer(device), Buffer(device)}, digits_(device), keys_(device),
      command_keys_(device), commands_(device), changes_(device),
      horizon_(make_texture(device, GL_TEXTURE_2D)) {
    static_assert(sizeof(Block) == 480 && sizeof(Block) <= kPartBytes);
    const std::vector<float> rays = GroundHorizon::rays();
    rays_.fill(std::span<const float>(rays));
    state_.allocate(sizeof(CullingState) + kSumsBytes);
    glTextureStorage2D(horizon_.name(), 1, GL_R32F, GroundHorizon::kMaxDistances,
                       GroundHorizon::kDirections);
    glTextureParameteri(horizon_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(horizon_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Result<void> ForestCulling::reload(const ShaderSource& shaders) {
    Programs programs;
    struct ProgramSpec {
        ProgramObject* program;
        const char* name;
        const char* defines;
    };
    const std::array<ProgramSpec, 17> wanted = {
        {{&programs.horizon, "culling_horizon.comp.glsl", ""},
         {&programs.mark_cells, "culling_cells.comp.glsl", ""},
         {&programs.list_cells, "culling_cells.comp.glsl", "#define LIST\n"},
         {&programs.sum, "culling_sum.comp.glsl", ""},
         {&programs.mark_trees, "culling_trees.comp.glsl", ""},
         {&programs.list_trees, "culling_trees.comp.glsl", "#define LIST\n"},
         {&programs.detail, "culling_detail.comp.glsl", ""},
         {&programs.mark_near, "culling_near.comp.glsl", ""},
         {&programs.list_near, "culling_near.comp.glsl", "#define LIST\n"},
         {&programs.nodes, "culling_nodes.comp.glsl", ""},
         {&programs.branches, "culling_branches.comp.glsl", ""},
         {&programs.visible, "culling_visible.comp.glsl", ""},
         {&programs.count_digits, "culling_sort.comp.glsl", "#define COUNT\n"},
         {&programs.sum_digits, "culling_sort.comp.glsl", "#define SUM\n"},
         {&programs.sort, "culling_sort.comp.glsl", ""},
         {&programs.finish, "culling_finish.comp.glsl", ""},
         {&programs.commands, "culling_commands.comp.glsl", ""}}};
    for (const ProgramSpec& one : wanted) {
        Result<ProgramObject> made = make_compute_program(*device_, shaders, one.name, one.defines);
        if (!made) {
            return made.error();
        }
        *one.program = std::move(made.value());
    }
    programs_ = std::move(programs);
    horizon_eye_.reset();
    return {};
}

void ForestCulling::upload_identities(const ForestLod& lod) {
    const std::uint32_t count = lod.tree_count();
    identities_.allocate((std::size_t{count} + kRoomForTrees) * kIdentityBytes);
    constexpr std::uint32_t kPiece = 1U << 16U;
    std::vector<Identity> piece;
    for (std::uint32_t first = 0; first < count; first += kPiece) {
        piece.clear();
        for (std::uint32_t i = first; i < std::min(first + kPiece, count); ++i) {
            piece.push_back(identity_of(lod, i));
        }
        identities_.write(std::span<const Identity>(piece), first * kIdentityBytes);
    }
}

void ForestCulling::grow_lists(std::uint32_t trees) {
    if (trees <= tree_capacity_ && tree_capacity_ != 0) {
        return;
    }
    tree_capacity_ = trees + kRoomForTrees;
    const auto cells = static_cast<std::uint32_t>(cells_.capacity() / kCellBytes);
    const std::size_t elements = std::max(tree_capacity_, cells);
    max_candidates_ = std::min(tree_capacity_, kMaxCandidates);
    identities_.grow(tree_capacity_ * kIdentityBytes);
    codes_.allocate(elements * 2 * sizeof(std::uint32_t));
    sums_.allocate((elements / kBlock + 1) * 4 * sizeof(std::uint32_t));
    tree_entries_.allocate(tree_capacity_ * sizeof(ImpostorEntry));
    candidates_.allocate(std::size_t{max_candidates_} * 2 * sizeof(std::uint32_t));
    near_.allocate(max_candidates_ * kNearBytes);
}

bool ForestCulling::show(const ForestLod& lod, ForestBuffers& buffers) {
    std::optional<CullingTables> tables = make_culling_tables(lod.model());
    if (!tables) {
        return false;
    }
    changed_.clear();
    horizon_eye_.reset();
    tables_.fill(std::span<const std::uint32_t>(std::exchange(tables->words, {})));
    table_layout_ = std::move(*tables);
    std::vector<CellRecord> cells;
    cells.reserve(lod.cells().size());
    for (const ForestCell& cell : lod.cells()) {
        cells.push_back(record_of(cell));
    }
    cells_.fill(std::span<const CellRecord>(cells));
    visible_cells_.allocate(cells.size() * 4 * sizeof(std::uint32_t));
    cluster_entries_.allocate(cells.size() * sizeof(ImpostorEntry));
    upload_identities(lod);
    tree_capacity_ = 0;
    grow_lists(lod.tree_count());
    max_branches_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        std::uint64_t{table_layout_.max_branches} * tree_capacity_, BranchPool::kMaxBranches));
    nodes_.allocate(std::size_t{max_branches_} * 4 * sizeof(std::uint32_t));
    branches_.allocate(max_branches_ * sizeof(PoolBranch));
    for (Buffer& sorted : sorted_) {
        sorted.allocate(std::size_t{2} * max_branches_ * 2 * sizeof(std::uint32_t));
    }
    digits_.allocate((std::size_t{2} * max_branches_ / kSortPart + 1) *
                     (std::size_t{1} << kDigitBits) * sizeof(std::uint32_t));
    keys_.allocate((std::size_t{table_layout_.key_count} + 1) * 2 * sizeof(std::uint32_t));
    sort_passes_ = 1;
    while (sort_passes_ < 4 && table_layout_.key_count >> (sort_passes_ * kDigitBits) != 0) {
        ++sort_passes_;
    }
    const CommandTemplates templates = buffers.command_templates(table_layout_.first_keys);
    command_count_ = static_cast<std::uint32_t>(templates.commands.size());
    commands_.fill(std::span<const DrawCommand>(templates.commands));
    command_keys_.fill(std::span<const std::uint32_t>(templates.keys));
    draws_ = {branches_.name(), sorted_[sort_passes_ % 2].name(), commands_.name(),
              templates.ranges};
    return true;
}

void ForestCulling::change_tree(std::uint32_t number) {
    changed_.push_back(number);
}

void ForestCulling::apply_changes(const ForestLod& lod) {
    if (changed_.empty()) {
        return;
    }
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    grow_lists(lod.tree_count());
    // Changes are written to a separate buffer and copied from there, see Buffer::write().
    std::vector<std::uint32_t> words;
    struct Copy {
        const Buffer* to;
        std::size_t from;
        std::size_t offset;
        std::size_t bytes;
    };
    std::vector<Copy> copies;
    const auto add = [&](const Buffer& to, std::size_t offset, const auto& record) {
        copies.push_back({&to, words.size() * sizeof(std::uint32_t), offset, sizeof(record)});
        words.insert(words.end(), record.begin(), record.end());
    };
    for (const std::uint32_t number : changed_) {
        add(identities_, number * kIdentityBytes, identity_of(lod, number));
        if (number < lod.trees().size()) {
            const std::uint32_t cell = lod.cell_number(lod.trees()[number].position);
            add(cells_, cell * kCellBytes, record_of(lod.cells()[cell]));
        }
    }
    changes_.fill(std::span<const std::uint32_t>(words));
    for (const Copy& copy : copies) {
        glCopyNamedBufferSubData(changes_.name(), copy.to->name(), static_cast<GLintptr>(copy.from),
                                 static_cast<GLintptr>(copy.offset),
                                 static_cast<GLsizeiptr>(copy.bytes));
    }
    changed_.clear();
}

void ForestCulling::begin(const ForestLod& lod, const ForestBuffers& buffers, Block& block) {
    // Orders the clears and copies below after the writes by shaders of the previous picture.
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    apply_changes(lod);
    block.trees = {static_cast<std::uint32_t>(lod.cells().size()),
                   static_cast<std::uint32_t>(lod.trees().size()),
                   lod.tree_count() - static_cast<std::uint32_t>(lod.trees().size()),
                   block.trees[3]};
    block.limits[2] = max_branches_;
    block.limits[3] = max_candidates_;
    const std::uint64_t key = lod.model().forest->key;
    block.key = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U),
                 tree_capacity_, table_layout_.key_count};
    blocks_.begin();
    std::memcpy(blocks_.data(), &block, sizeof(block));
    glBindBufferRange(GL_UNIFORM_BUFFER, kBlockBinding, blocks_.name(), blocks_.offset(),
                      sizeof(block));
    glClearNamedBufferData(state_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    glClearNamedBufferData(keys_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    const std::array<std::pair<GLuint, GLuint>, 17> bound = {
        {{kBranches, branches_.name()},
         {kTrees, buffers.trees()},
         {kTables, tables_.name()},
         {kIdentities, identities_.name()},
         {kCells, cells_.name()},
         {kState, state_.name()},
         {kCodes, codes_.name()},
         {kSums, sums_.name()},
         {kVisibleCells, visible_cells_.name()},
         {kEntries, tree_entries_.name()},
         {kCandidates, candidates_.name()},
         {kNear, near_.name()},
         {kNodes, nodes_.name()},
         {kKeys, keys_.name()},
         {kDigits, digits_.name()},
         {kCommandKeys, command_keys_.name()},
         {kCommands, commands_.name()}}};
    for (const auto& [binding, name] : bound) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name);
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state_.name());
}

void ForestCulling::make_horizon(const View& view) {
    std::vector<glm::ivec2> origins;
    for (std::uint32_t level = 0; level < view.ground->levels(); ++level) {
        origins.push_back(view.ground->grid(level).origin);
    }
    if (horizon_eye_ == view.frustum.eye && origins == horizon_origins_) {
        return;
    }
    horizon_eye_ = view.frustum.eye;
    horizon_origins_ = std::move(origins);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kIdentities, rays_.name());
    glBindTextureUnit(kHeightsTexture, view.heights);
    glBindImageTexture(0, horizon_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    glUseProgram(programs_.horizon.name());
    glDispatchCompute(GroundHorizon::kDirections, 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kIdentities, identities_.name());
}

void ForestCulling::list_trees(std::uint32_t cells) {
    glBindTextureUnit(kHorizonTexture, horizon_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kEntries, cluster_entries_.name());
    if (cells != 0) {
        run(programs_.mark_cells, cells, kBlock);
    }
    set_parameter(programs_.sum, 0);
    run(programs_.sum, 1, 1);
    if (cells != 0) {
        run(programs_.list_cells, cells, kBlock);
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kEntries, tree_entries_.name());
    run(programs_.mark_trees, ByTree);
    set_parameter(programs_.sum, 1);
    run(programs_.sum, 1, 1);
    run(programs_.list_trees, ByTree);
}

void ForestCulling::list_branches() {
    for (std::uint32_t step = 0; step < kDetailSteps; ++step) {
        set_parameter(programs_.detail, step);
        run(programs_.detail, ByCandidate);
    }
    set_parameter(programs_.detail, kDetailSteps);
    run(programs_.detail, 1, 1);
    run(programs_.mark_near, ByCandidate);
    set_parameter(programs_.sum, 2);
    run(programs_.sum, 1, 1);
    run(programs_.list_near, ByCandidate);
    run(programs_.nodes, ByNearTree);
    run(programs_.branches, ByBranch);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kUnsorted, sorted_[0].name());
    run(programs_.visible, ByBranch);
    for (std::uint32_t pass = 0; pass < sort_passes_; ++pass) {
        for (const ProgramObject* program :
             {&programs_.count_digits, &programs_.sum_digits, &programs_.sort}) {
            set_parameter(*program, pass * kDigitBits);
        }
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kUnsorted, sorted_[pass % 2].name());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kSorted, sorted_[(pass + 1) % 2].name());
        run(programs_.count_digits, BySortPart);
        run(programs_.sum_digits, 1, 1);
        run(programs_.sort, BySortPart);
    }
    run(programs_.finish, 1, 1);
    if (command_count_ != 0) {
        set_parameter(programs_.commands, command_count_);
        run(programs_.commands, command_count_, kBlock);
    }
}

void ForestCulling::select(const ForestLod& lod, const ForestBuffers& buffers, const View& view) {
    Block block;
    block.planes = view.frustum.planes;
    block.eye_pixels = {view.frustum.eye, view.frustum.pixels};
    block.level_pixels = glm::make_vec4(view.options.level_pixels.data());
    const Sway sway = sway_in(view.options.wind);
    block.sway = {sway.height_factor, sway.width_factor, sway.flutter, view.options.blend};
    block.clusters = {view.options.cluster_pixels, static_cast<float>(lod.cell_size()),
                      view.options.level_blend, 0.0F};
    block.limits = {static_cast<std::uint32_t>(view.options.max_triangles),
                    static_cast<std::uint32_t>(view.options.max_triangles >> 32U), 0, 0};
    // For an eye below the ground, the ground is invisible and occludes nothing.
    const bool occludes = view.ground != nullptr && view.ground->eye_height() > 0.0F;
    if (occludes) {
        block.ground = {1.0F, view.ground->eye_height(), 0.0F, 0.0F};
        block.heights = {view.ground->levels(), GroundHorizon::distance_count(*view.ground), 0, 0};
        for (std::uint32_t level = 0; level < view.ground->levels(); ++level) {
            const glm::ivec2& origin = view.ground->grid(level).origin;
            block.origins[level] = {origin.x, origin.y, 0, 0};
        }
    }
    timer_.begin();
    begin(lod, buffers, block);
    if (occludes) {
        make_horizon(view);
    }
    list_trees(block.trees[0]);
    list_branches();
    timer_.end();
    blocks_.end();
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    states_.begin();
    glCopyNamedBufferSubData(state_.name(), states_.name(), 0, states_.offset(),
                             sizeof(CullingState));
    states_.end();
}

void ForestCulling::select_casters(const ForestLod& lod,
                                   const ForestBuffers& buffers,
                                   const Bounds& box) {
    Block block;
    block.casters_low = {box.low, 0.0F};
    block.casters_high = {box.high, 0.0F};
    block.trees[3] = 1;
    begin(lod, buffers, block);
    list_trees(block.trees[0]);
    blocks_.end();
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

std::size_t ForestCulling::impostor_command(bool clusters) {
    return offsetof(CullingState, draws) + (clusters ? 8 : 0) * sizeof(std::uint32_t);
}

const CullingState* ForestCulling::finished_state() const {
    return reinterpret_cast<const CullingState*>(states_.last_finished());
}

PoolBranch ForestCulling::branch(std::uint32_t slot) const {
    PoolBranch branch;
    glGetNamedBufferSubData(branches_.name(), static_cast<GLintptr>(slot * sizeof(PoolBranch)),
                            sizeof(PoolBranch), &branch);
    return branch;
}

CulledLists ForestCulling::read_lists() const {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    CulledLists lists;
    const auto read = [](const Buffer& from, std::size_t offset, auto& items) {
        using Item = typename std::decay_t<decltype(items)>::value_type;
        if (!items.empty()) {
            glGetNamedBufferSubData(from.name(), static_cast<GLintptr>(offset * sizeof(Item)),
                                    static_cast<GLsizeiptr>(items.size() * sizeof(Item)),
                                    items.data());
        }
    };
    glGetNamedBufferSubData(state_.name(), 0, sizeof(CullingState), &lists.state);
    const auto read_entries = [&](const Buffer& from, std::size_t at) {
        std::vector<ImpostorEntry> whole(lists.state.draws[at + 1]);
        std::vector<ImpostorEntry> blended(lists.state.draws[at + 5]);
        read(from, lists.state.draws[at + 3], whole);
        read(from, lists.state.draws[at + 7], blended);
        whole.insert(whole.end(), blended.rbegin(), blended.rend());
        return whole;
    };
    lists.trees = read_entries(tree_entries_, 0);
    lists.clusters = read_entries(cluster_entries_, 8);
    lists.pool.resize(lists.state.pool_used);
    read(branches_, 0, lists.pool);
    std::vector<std::array<std::uint32_t, 2>> sorted(lists.state.drawn_branches);
    read(sorted_[sort_passes_ % 2], 0, sorted);
    for (const auto& [key, entry] : sorted) {
        lists.branches.push_back(std::bit_cast<BranchEntry>(entry));
    }
    return lists;
}

std::uint64_t ForestCulling::byte_count() const {
    std::uint64_t bytes = 0;
    for (const Buffer* buffer :
         {&tables_, &identities_, &cells_, &codes_, &sums_, &visible_cells_, &tree_entries_,
          &cluster_entries_, &candidates_, &near_, &nodes_, &branches_, &sorted_[0], &sorted_[1],
          &digits_, &keys_, &command_keys_, &commands_}) {
        bytes += buffer->capacity();
    }
    return bytes;
}

} // namespace lsys::view
