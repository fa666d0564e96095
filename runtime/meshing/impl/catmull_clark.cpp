// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/catmull_clark.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
constexpr std::uint64_t kTooMany = std::uint64_t{1} << 40;
constexpr std::uint64_t kElementsPerPiece = 1U << 15;

} // namespace

MeshCounts refined_counts(const PolygonMesh& mesh, std::uint32_t steps) {
    MeshCounts counts{.vertices = mesh.positions.size(),
                      .edges = mesh.corners.size() / 2,
                      .faces = mesh.face_ends.size(),
                      .corners = mesh.corners.size()};
    for (std::uint32_t i = 0; i < steps && counts.corners > 0 && counts.corners < kTooMany; ++i) {
        counts = {.vertices = counts.vertices + counts.edges + counts.faces,
                  .edges = 2 * counts.edges + counts.corners,
                  .faces = counts.corners,
                  .corners = 4 * counts.corners};
    }
    return counts;
}

CatmullClark::CatmullClark(PolygonMesh mesh, Workers& workers)
    : mesh_(std::move(mesh)), workers_(workers) {
    LSYS_CHECK(mesh_.corners.size() < std::uint64_t{1} << 31, mesh_.corners.size());
    faces_.resize(mesh_.corners.size());
    std::uint32_t half = 0;
    for (std::uint32_t face = 0; face < mesh_.face_ends.size(); ++face) {
        for (; half < mesh_.face_ends[face]; ++half) {
            faces_[half] = face;
        }
    }
    find_twins();
}

template <typename Piece>
void CatmullClark::for_each(std::uint64_t count, const Piece& piece) {
    workers_.for_each((count + kElementsPerPiece - 1) / kElementsPerPiece, [&](std::uint64_t i) {
        const auto end = static_cast<std::uint32_t>(std::min(count, (i + 1) * kElementsPerPiece));
        for (auto j = static_cast<std::uint32_t>(i * kElementsPerPiece); j < end; ++j) {
            piece(j);
        }
    });
}

std::uint32_t CatmullClark::next(std::uint32_t half) const {
    if (quads_) {
        return (half & ~3U) | ((half + 1) & 3U);
    }
    const std::uint32_t face = faces_[half];
    return half + 1 < mesh_.face_ends[face] ? half + 1 : face_begin(face);
}

std::uint32_t CatmullClark::previous(std::uint32_t half) const {
    if (quads_) {
        return (half & ~3U) | ((half + 3) & 3U);
    }
    const std::uint32_t face = faces_[half];
    return half > face_begin(face) ? half - 1 : mesh_.face_ends[face] - 1;
}

/// Pairs the half-edges that join the same two vertices; the half-edges are sorted into buckets by
/// the lower number of the two.
void CatmullClark::find_twins() {
    const auto count = static_cast<std::uint32_t>(mesh_.corners.size());
    twins_.resize(count);
    std::fill(twins_.begin(), twins_.end(), kNone);
    edges_.resize(count);
    vertex_half_.resize(mesh_.positions.size());
    std::fill(vertex_half_.begin(), vertex_half_.end(), kNone);
    const auto low = [&](std::uint32_t half) {
        return std::min(mesh_.corners[half], mesh_.corners[next(half)]);
    };
    const auto high = [&](std::uint32_t half) {
        return std::max(mesh_.corners[half], mesh_.corners[next(half)]);
    };
    LargeVector<std::uint32_t> ends;
    ends.resize(mesh_.positions.size());
    std::fill(ends.begin(), ends.end(), 0U);
    for (std::uint32_t half = 0; half < count; ++half) {
        ++ends[low(half)];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& end : ends) {
        sum += std::exchange(end, sum);
    }
    LargeVector<std::uint32_t> sorted;
    sorted.resize(count);
    for (std::uint32_t half = 0; half < count; ++half) {
        sorted[ends[low(half)]++] = half;
        vertex_half_[mesh_.corners[half]] = half;
    }
    closed_ = std::find(vertex_half_.begin(), vertex_half_.end(), kNone) == vertex_half_.end();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : ends) {
        std::sort(sorted.begin() + begin, sorted.begin() + end,
                  [&](std::uint32_t a, std::uint32_t b) {
                      return std::pair(high(a), a) < std::pair(high(b), b);
                  });
        for (std::uint32_t i = begin; i < end; i += 2) {
            const std::uint32_t a = sorted[i];
            const std::uint32_t b = i + 1 < end ? sorted[i + 1] : a;
            const bool third = i + 2 < end && high(sorted[i + 2]) == high(a);
            if (high(a) != high(b) || mesh_.corners[a] == mesh_.corners[b] || third) {
                closed_ = false;
                return;
            }
            twins_[a] = b;
            twins_[b] = a;
            edges_[a] = static_cast<std::uint32_t>(edge_half_.size());
            edges_[b] = edges_[a];
            edge_half_.push_back(a);
        }
        begin = end;
    }
}

template <typename T>
void CatmullClark::smooth(const LargeVector<T>& from, LargeVector<T>& to) {
    const std::uint64_t vertices = from.size();
    const std::uint64_t faces = mesh_.face_ends.size();
    const std::uint64_t edges = edge_half_.size();
    to.resize(vertices + faces + edges);
    const auto at = [&](std::uint32_t half) { return from[mesh_.corners[half]]; };
    for_each(faces, [&](std::uint32_t face) {
        T sum(0.0F);
        const std::uint32_t begin = face_begin(face);
        const std::uint32_t end = mesh_.face_ends[face];
        for (std::uint32_t half = begin; half < end; ++half) {
            sum += at(half);
        }
        to[vertices + face] = sum / static_cast<float>(end - begin);
    });
    for_each(edges, [&](std::uint32_t edge) {
        const std::uint32_t half = edge_half_[edge];
        const std::uint32_t twin = twins_[half];
        to[vertices + faces + edge] = 0.25F * (at(half) + at(twin) + to[vertices + face_of(half)] +
                                               to[vertices + face_of(twin)]);
    });
    for_each(vertices, [&](std::uint32_t vertex) {
        T face_sum(0.0F);
        T middle_sum(0.0F);
        std::uint32_t valence = 0;
        visit_faces(vertex, [&](std::uint32_t face, std::uint32_t half) {
            face_sum += to[vertices + face];
            middle_sum += 0.5F * (from[vertex] + at(next(half)));
            ++valence;
        });
        const auto n = static_cast<float>(valence);
        to[vertex] = (face_sum / n + 2.0F * middle_sum / n + (n - 3.0F) * from[vertex]) / n;
    });
}

void CatmullClark::place_vertices(PolygonMesh& to) {
    smooth(mesh_.positions, to.positions);
    if (!mesh_.texture_coordinates.empty()) {
        smooth(mesh_.texture_coordinates, to.texture_coordinates);
    }
    if (!mesh_.radii.empty()) {
        smooth(mesh_.radii, to.radii);
    }
}

void CatmullClark::refine() {
    const auto halves = static_cast<std::uint32_t>(mesh_.corners.size());
    LSYS_CHECK(closed_ && halves < std::uint32_t{1} << 29, halves);
    const auto vertices = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto faces = static_cast<std::uint32_t>(mesh_.face_ends.size());
    const auto edges = static_cast<std::uint32_t>(edge_half_.size());
    PolygonMesh to;
    place_vertices(to);
    to.corners.resize(std::uint64_t{4} * halves);
    to.face_ends.resize(halves);
    to.colours.resize(halves);
    to.segments.resize(mesh_.segments.empty() ? 0 : halves);
    LargeVector<std::uint32_t> twins;
    twins.resize(to.corners.size());
    LargeVector<std::uint32_t> edges_of;
    edges_of.resize(to.corners.size());
    // The children 4h to 4h + 3 of half-edge h form the quad at the first vertex of h.
    for_each(halves, [&](std::uint32_t half) {
        const std::uint32_t twin = twins_[half];
        const std::uint32_t before = previous(half);
        const std::uint32_t twin_before = twins_[before];
        const std::uint32_t child = 4 * half;
        to.corners[child] = mesh_.corners[half];
        to.corners[child + 1] = vertices + faces + edges_[half];
        to.corners[child + 2] = vertices + face_of(half);
        to.corners[child + 3] = vertices + faces + edges_[before];
        twins[child] = 4 * next(twin) + 3;
        twins[child + 1] = 4 * next(half) + 2;
        twins[child + 2] = 4 * before + 1;
        twins[child + 3] = 4 * twin_before;
        edges_of[child] = 2 * edges_[half] + (half > twin ? 0U : 1U);
        edges_of[child + 1] = 2 * edges + half;
        edges_of[child + 2] = 2 * edges + before;
        edges_of[child + 3] = 2 * edges_[before] + (before > twin_before ? 1U : 0U);
        to.face_ends[half] = child + 4;
        to.colours[half] = mesh_.colours.empty() ? std::uint32_t{0} : mesh_.colours[face_of(half)];
        if (!to.segments.empty()) {
            to.segments[half] = mesh_.segments[face_of(half)];
        }
    });
    LargeVector<std::uint32_t> edge_half;
    edge_half.resize(std::uint64_t{2} * edges + halves);
    LargeVector<std::uint32_t> vertex_half;
    vertex_half.resize(to.positions.size());
    for_each(edges, [&](std::uint32_t edge) {
        const std::uint32_t half = edge_half_[edge];
        const std::uint32_t twin = twins_[half];
        edge_half[2 * edge + (half > twin ? 0U : 1U)] = 4 * half;
        edge_half[2 * edge + (half > twin ? 1U : 0U)] = 4 * twin;
        vertex_half[vertices + faces + edge] = 4 * half + 1;
    });
    for_each(halves, [&](std::uint32_t half) { edge_half[2 * edges + half] = 4 * half + 1; });
    for_each(vertices,
             [&](std::uint32_t vertex) { vertex_half[vertex] = 4 * vertex_half_[vertex]; });
    for_each(faces,
             [&](std::uint32_t face) { vertex_half[vertices + face] = 4 * face_begin(face) + 2; });
    mesh_ = std::move(to);
    twins_ = std::move(twins);
    edges_ = std::move(edges_of);
    edge_half_ = std::move(edge_half);
    vertex_half_ = std::move(vertex_half);
    faces_ = {};
    quads_ = true;
}

} // namespace lsys
