// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/tubes.h"

#include "grammar/base/contract.h"
#include "runtime/base/waitable_count.h"
#include "runtime/base/workers.h"
#include "runtime/meshing/impl/axes.h"
#include "runtime/meshing/impl/axis_reader.h"
#include "runtime/meshing/impl/tube_triangles.h"
#include "runtime/meshing/impl/tube_writer.h"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kPieces = 64;             // wanted number of pieces
constexpr std::uint64_t kMinPieceSegments = 4096; // segments per piece
constexpr std::uint64_t kMaxPieceSegments = std::uint64_t{1} << 17;
constexpr std::uint64_t kMaxLists = std::uint64_t{1} << 20; // max pieces times colours
constexpr std::size_t kJointsPerSegment = 2;                // estimate, including ends and collars
constexpr std::size_t kJointsPerPart = 2048;
constexpr std::size_t kMinLongRun = 4 * kJointsPerPart; // min joints of a run written in parts
static_assert(kMinLongRun <= 0x7FFF);

/// A Run whose joints and radii are stored in Piece.
struct KeptRun {
    std::uint32_t first_segment = 0;
    std::uint16_t joint_count : 15 = 0; // unused for long runs
    bool has_roots : 1 = false;
    TubeEnd begin = TubeEnd::Flat;
    TubeEnd end = TubeEnd::Blunt;
};

/// A run with joints of its own that several threads write in parts. The frame is transported from
/// joint to joint, so each part waits until the part before has computed the frame where it starts.
struct LongRun {
    std::size_t number = 0;      // index in Piece::runs
    std::size_t first_joint = 0; // index in Piece::joints of the joints of the next run
    LargeVector<Joint> joints;
    LargeVector<float> radii;
    std::uint64_t first_vertex = 0; // among the vertices of the piece
    std::uint64_t end_vertex = 0;
    std::vector<TubeWriter::Place> places; // the start of each part
    WaitableCount known{1};                // number of items of `places` that are set
};

/// A range of segments, and the runs of the axes that begin there.
struct Piece {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint64_t vertices = 0;          // number of vertices, later the index of the first one
    std::vector<TriangleList> triangles; // triangles of each colour
    LargeVector<KeptRun> runs;
    LargeVector<Joint> joints; // joints of all runs that are not long
    LargeVector<float> radii;
    std::vector<std::unique_ptr<LongRun>> long_runs;
};

std::vector<Piece> make_pieces(std::uint64_t segments, std::size_t colours) {
    const std::uint64_t max_pieces =
        std::max<std::uint64_t>(kMaxLists / std::max<std::size_t>(colours, 1), 1);
    const std::uint64_t size =
        std::max(std::clamp(segments / kPieces, kMinPieceSegments, kMaxPieceSegments),
                 (segments + max_pieces - 1) / max_pieces);
    std::vector<Piece> pieces;
    for (std::uint64_t begin = 0; begin < segments; begin += size) {
        Piece& piece = pieces.emplace_back();
        piece.begin = static_cast<std::uint32_t>(begin);
        piece.end = static_cast<std::uint32_t>(std::min(begin + size, segments));
        piece.triangles.resize(colours);
    }
    return pieces;
}

/// Reads all runs of a piece and makes their triangles.
class PieceReader {
public:
    PieceReader(const Skeleton& skeleton,
                const Axes& axes,
                const MeshOptions& options,
                const ColourSlots& slots,
                Piece& piece)
        : skeleton_(skeleton), axes_(axes), piece_(piece), reader_(skeleton, axes, options),
          triangles_(options, slots, piece.triangles) {}

    void read() {
        Run run;
        piece_.joints.reserve(kJointsPerSegment * (piece_.end - piece_.begin));
        for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
            if (begins_axis(axes_, skeleton_.segments[i], i)) {
                reader_.start(i);
                while (reader_.next(run)) {
                    store_run(run);
                }
            }
        }
        piece_.vertices = triangles_.vertices();
    }

private:
    void store_run(const Run& run) {
        const std::uint64_t first = triangles_.vertices();
        triangles_.add(run);
        const bool is_long = run.joints.size() >= kMinLongRun;
        piece_.runs.push_back(
            {.first_segment = run.first_segment,
             .joint_count = static_cast<std::uint16_t>(is_long ? 0 : run.joints.size() & 0x7FFFU),
             .has_roots = run.has_roots,
             .begin = run.begin,
             .end = run.end});
        if (!is_long) {
            piece_.joints.insert(piece_.joints.end(), run.joints.begin(), run.joints.end());
            piece_.radii.insert(piece_.radii.end(), run.radii.begin(), run.radii.end());
            return;
        }
        LongRun& kept = *piece_.long_runs.emplace_back(std::make_unique<LongRun>());
        kept.number = piece_.runs.size() - 1;
        kept.first_joint = piece_.joints.size();
        reader_.take(kept.joints, kept.radii);
        kept.first_vertex = first;
        kept.end_vertex = triangles_.vertices();
    }

    const Skeleton& skeleton_;
    const Axes& axes_;
    Piece& piece_;
    AxisReader reader_;
    TubeTriangles triangles_;
};

/// Some runs of a piece, or a part of a long run.
struct Task {
    Piece* piece = nullptr;
    std::size_t first_run = 0; // runs [first_run, end_run) of Piece::runs
    std::size_t end_run = 0;
    std::size_t first_joint = 0;    // index in Piece::joints
    std::uint64_t first_vertex = 0; // vertices [first_vertex, end_vertex) of the block
    std::uint64_t end_vertex = 0;
    LongRun* shared = nullptr; // the long run; null: whole runs
    std::size_t part = 0;      // number of the part of the long run
};

/// Tasks in the order of their vertices.
std::vector<Task> make_tasks(std::vector<Piece>& pieces, std::uint64_t vertices) {
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        Piece& piece = pieces[i];
        const std::uint64_t end = i + 1 < pieces.size() ? pieces[i + 1].vertices : vertices;
        Task task{.piece = &piece, .first_vertex = piece.vertices};
        for (const std::unique_ptr<LongRun>& longer : piece.long_runs) {
            LongRun& run = *longer;
            task.end_run = run.number;
            task.end_vertex = piece.vertices + run.first_vertex;
            tasks.push_back(task);
            const std::size_t parts = (run.joints.size() + kJointsPerPart - 1) / kJointsPerPart;
            run.places.resize(parts + 1);
            for (std::size_t part = 0; part < parts; ++part) {
                tasks.push_back({.piece = &piece,
                                 .first_run = run.number,
                                 .end_run = run.number + 1,
                                 .first_vertex = piece.vertices + run.first_vertex,
                                 .end_vertex = piece.vertices + run.end_vertex,
                                 .shared = &run,
                                 .part = part});
            }
            task.first_run = run.number + 1;
            task.first_joint = run.first_joint;
            task.first_vertex = piece.vertices + run.end_vertex;
        }
        task.end_run = piece.runs.size();
        task.end_vertex = end;
        tasks.push_back(task);
    }
    return tasks;
}

class TaskWriter {
public:
    /// `alone`: no other thread writes vertices.
    TaskWriter(const Skeleton& skeleton,
               const MeshBlock& block,
               const MeshOptions& options,
               bool alone,
               const Task& task)
        : skeleton_(skeleton), alone_(alone), task_(task),
          writer_(
              block, options, skeleton.tube_shape.flare, skeleton.looks.get(), task.first_vertex) {}

    void write() {
        if (task_.shared != nullptr) {
            write_part(*task_.shared);
        } else {
            write_runs();
        }
    }

private:
    [[nodiscard]] Run
    run_of(const KeptRun& kept, std::span<const Joint> joints, std::span<const float> radii) const {
        return {.joints = joints,
                .radii = radii,
                .begin = kept.begin,
                .end = kept.end,
                .side = side_of(skeleton_, kept.first_segment),
                .first_segment = kept.first_segment,
                .has_roots = kept.has_roots};
    }

    /// Before writing, publishes the place where the next part starts, unless there is no other
    /// thread.
    void write_part(LongRun& shared) {
        const Run run = run_of(task_.piece->runs[task_.first_run], shared.joints, shared.radii);
        const std::size_t end = std::min((task_.part + 1) * kJointsPerPart, run.joints.size());
        if (task_.part == 0) {
            shared.places[0] = writer_.begin(run);
        }
        shared.known.wait_above(task_.part);
        TubeWriter::Place& next = shared.places[task_.part + 1];
        TubeWriter::Place place = shared.places[task_.part];
        const bool others_wait = !alone_ && end < run.joints.size();
        if (others_wait) {
            next = place;
            writer_.skip(run, next, end);
            shared.known.raise(task_.part + 2);
        }
        writer_.write(run, place, end);
        if (!others_wait) {
            next = place;
            shared.known.raise(task_.part + 2);
        }
        LSYS_CHECK(end < run.joints.size() || writer_.vertex() == task_.end_vertex,
                   writer_.vertex(), task_.end_vertex);
    }

    void write_runs() {
        Piece& piece = *task_.piece;
        std::size_t joint = task_.first_joint;
        for (std::size_t i = task_.first_run; i < task_.end_run; ++i) {
            const KeptRun& kept = piece.runs[i];
            writer_.write(run_of(kept, std::span(piece.joints).subspan(joint, kept.joint_count),
                                 std::span(piece.radii)
                                     .subspan(piece.radii.empty() ? 0 : joint,
                                              piece.radii.empty() ? 0 : kept.joint_count)));
            joint += kept.joint_count;
        }
        // The number of written vertices must equal the number that the reader has counted.
        LSYS_CHECK(writer_.vertex() == task_.end_vertex, writer_.vertex(), task_.end_vertex);
        if (piece.long_runs.empty()) {
            piece.runs = {};
            piece.joints = {};
            piece.radii = {};
        }
    }

    const Skeleton& skeleton_;
    bool alone_; // no other thread writes vertices
    const Task& task_;
    TubeWriter writer_;
};

} // namespace

void append_tubes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder) {
    Workers workers(options.threads);
    const Axes axes = find_axes(skeleton, workers);
    const ColourSlots slots(axes.colours);
    std::vector<MeshBuilder::WholePart> parts;
    for (const ItemColour colour : axes.colours) {
        parts.push_back({.material = wood_material(colour), .triangles = {}, .word = "wood"});
    }
    std::vector<Piece> pieces = make_pieces(skeleton.segments.size(), parts.size());
    workers.for_each(pieces.size(), [&](std::uint64_t i) {
        PieceReader(skeleton, axes, options, slots, pieces[i]).read();
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
    const std::vector<Task> tasks = make_tasks(pieces, vertices);
    const bool alone = workers.count() == 1;
    const auto write = [&](std::uint64_t i) {
        TaskWriter(skeleton, block, options, alone, tasks[i]).write();
    };
    if (alone) {
        workers.for_each(tasks.size(), write);
    } else { // noexcept: after an exception, other tasks would wait forever
        workers.for_each(tasks.size(), [&](std::uint64_t i) noexcept { write(i); });
    }
}

} // namespace lsys
