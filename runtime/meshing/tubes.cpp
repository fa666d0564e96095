#include "runtime/meshing/tubes.h"

#include "grammar/contract.h"
#include "runtime/derive/workers.h"
#include "runtime/meshing/axes.h"
#include "runtime/meshing/axis_reader.h"
#include "runtime/meshing/tube_triangles.h"
#include "runtime/meshing/tube_writer.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kSegmentsOfPiece = 4096;
constexpr std::uint64_t kMostLists = std::uint64_t{1} << 20; // of pieces and colours

/// A range of segments, and what is written for the axes that begin there.
struct Piece {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint64_t vertices = 0;          // before: their number; after: where they start
    std::vector<TriangleList> triangles; // of each colour
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
        std::max<std::uint64_t>(kMostLists / std::max<std::size_t>(colours, 1), 1);
    const std::uint64_t size = std::max(kSegmentsOfPiece, (segments + most - 1) / most);
    std::vector<Piece> pieces;
    for (std::uint64_t begin = 0; begin < segments; begin += size) {
        Piece& piece = pieces.emplace_back();
        piece.begin = static_cast<std::uint32_t>(begin);
        piece.end = static_cast<std::uint32_t>(std::min(begin + size, segments));
        piece.triangles.resize(colours);
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
    std::vector<MeshBuilder::WholePart> parts;
    for (const std::uint16_t colour : axes.colours) {
        slots[colour] = static_cast<std::uint32_t>(parts.size());
        parts.push_back({.material = wood_material(colour), .triangles = {}});
    }
    std::vector<Piece> pieces = make_pieces(skeleton.segments.size(), parts.size());
    Workers workers(options.threads);
    for_each_piece(workers, pieces.size(), [&](std::uint64_t i) {
        Piece& piece = pieces[i];
        TubeTriangles triangles(options, slots, piece.triangles);
        for_each_run(skeleton, axes, options, piece, [&](const Run& run) { triangles.add(run); });
        piece.vertices = triangles.vertices();
    });

    std::uint64_t vertices = 0;
    for (Piece& piece : pieces) {
        for (std::size_t slot = 0; slot < parts.size(); ++slot) {
            parts[slot].triangles.append(std::move(piece.triangles[slot]),
                                         static_cast<std::uint32_t>(vertices));
        }
        vertices += std::exchange(piece.vertices, vertices);
    }
    MeshBlock block;
    if (!builder.place_parts(std::move(parts), vertices, block)) {
        return;
    }
    for_each_piece(workers, pieces.size(), [&](std::uint64_t i) {
        const Piece& piece = pieces[i];
        TubeWriter writer(block, options, piece.vertices);
        for_each_run(skeleton, axes, options, piece, [&](const Run& run) { writer.write(run); });
        // What was counted is what was written.
        LSYS_CHECK(writer.vertex() == (i + 1 < pieces.size() ? pieces[i + 1].vertices : vertices),
                   i);
    });
}

} // namespace lsys
