#include "runtime/meshing/tubes.h"

#include "grammar/contract.h"
#include "runtime/derive/workers.h"
#include "runtime/meshing/axes.h"
#include "runtime/meshing/axis_reader.h"
#include "runtime/meshing/tube_writer.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kSegmentsOfPiece = 4096;
constexpr std::uint64_t kMostCounts = std::uint64_t{1} << 22; // of pieces and colours

/// A range of segments, and what is written for the axes that begin there.
struct Piece {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint64_t vertices = 0; // before: their number; after: where they start
    std::vector<std::uint64_t> indices;
};

template <typename Visit>
void for_each_run(const Skeleton& skeleton,
                  const Axes& axes,
                  const MeshOptions& options,
                  const Piece& piece,
                  const Visit& visit) {
    AxisReader reader(skeleton, axes, options);
    Run run;
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
        if (begins_axis(axes, skeleton.segments[i], i)) {
            reader.start(i);
            while (reader.next(run)) {
                visit(run);
            }
        }
    }
}

std::vector<Piece> make_pieces(std::uint64_t segments, std::size_t colours) {
    const std::uint64_t most =
        std::max<std::uint64_t>(kMostCounts / std::max<std::size_t>(colours, 1), 1);
    const std::uint64_t size = std::max(kSegmentsOfPiece, (segments + most - 1) / most);
    std::vector<Piece> pieces;
    for (std::uint64_t begin = 0; begin < segments; begin += size) {
        Piece& piece = pieces.emplace_back();
        piece.begin = static_cast<std::uint32_t>(begin);
        piece.end = static_cast<std::uint32_t>(std::min(begin + size, segments));
        piece.indices.resize(colours);
    }
    return pieces;
}

/// Throws std::bad_alloc where a piece did.
template <typename Visit>
void for_each_piece(Workers& workers, std::uint64_t pieces, const Visit& visit) {
    std::atomic<bool> no_memory{false};
    workers.for_each(pieces, [&](std::uint64_t i) {
        try {
            visit(i);
        } catch (const std::bad_alloc&) {
            no_memory = true;
        }
    });
    if (no_memory) {
        throw std::bad_alloc();
    }
}

} // namespace

void append_tubes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder) {
    const Axes axes = find_axes(skeleton);
    ColourSlots slots(axes.colours.empty() ? 0 : axes.colours.back() + std::size_t{1});
    std::vector<MeshBuilder::PartSize> parts;
    for (const std::uint16_t colour : axes.colours) {
        slots[colour] = static_cast<std::uint32_t>(parts.size());
        parts.push_back({.material = wood_material(colour), .index_count = 0});
    }
    std::vector<Piece> pieces = make_pieces(skeleton.segments.size(), parts.size());
    Workers workers(options.threads);
    for_each_piece(workers, pieces.size(), [&](std::uint64_t i) {
        Piece& piece = pieces[i];
        for_each_run(skeleton, axes, options, piece, [&](const Run& run) {
            count_tube(run, options, slots, piece.vertices, piece.indices);
        });
    });

    std::uint64_t vertices = 0;
    for (Piece& piece : pieces) {
        vertices += std::exchange(piece.vertices, vertices);
    }
    std::uint64_t first_index = 0;
    for (std::size_t slot = 0; slot < parts.size(); ++slot) {
        const std::uint64_t begin = first_index;
        for (Piece& piece : pieces) {
            first_index += std::exchange(piece.indices[slot], first_index);
        }
        parts[slot].index_count = first_index - begin;
    }
    MeshBlock block;
    if (!builder.reserve_parts(parts, vertices, block)) {
        return;
    }
    for_each_piece(workers, pieces.size(), [&](std::uint64_t i) {
        const Piece& piece = pieces[i];
        TubeWriter writer(block, options, slots, piece.vertices, piece.indices);
        for_each_run(skeleton, axes, options, piece, [&](const Run& run) { writer.write(run); });
        // What was counted is what was written.
        const Piece* const after = i + 1 < pieces.size() ? &pieces[i + 1] : nullptr;
        LSYS_CHECK(writer.vertex() == (after != nullptr ? after->vertices : vertices), i);
        for (std::size_t slot = 0; after != nullptr && slot < parts.size(); ++slot) {
            LSYS_CHECK(writer.index()[slot] == after->indices[slot], i, slot);
        }
    });
}

} // namespace lsys
