// SPDX-License-Identifier: MIT
// Environments of kind Space: markers of free space that buds compete for (Runions, Lane &
// Prusinkiewicz 2007, "Modeling trees with a space colonization algorithm"; Palubicki et al. 2009,
// "Self-organizing tree models for image synthesis").
//
// The arithmetic, in binary64: with the vector w from a place to a marker, the marker is within the
// radius if (wx^2 + wy^2) + wz^2 <= radius^2, seen if heading . w >= c |w| where c is the correctly
// rounded cosine of angle / 2 degrees, and killed if wx^2 + wy^2 + wz^2, summed in that order, is
// below kill^2. Of places at equal squared distances the one with the lowest index gets the marker.
// The unit vectors w / |w| of a place's markers are summed in the order of the markers and divided
// by their number; the answer is this mean divided by its length.
#include "grammar/base/contract.h"
#include "grammar/base/hash.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/input_checks.h"
#include "runtime/environment/impl/marker_search.h"
#include "runtime/environment/impl/markers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace lsys {

namespace {

constexpr std::size_t kMarkersPerPiece = 1U << 9;

class SpaceEnvironment : public Environment {
public:
    SpaceEnvironment(const BytecodeEnvironment& declared,
                     const EnvironmentFiles& files,
                     std::uint32_t number,
                     const EnvironmentContext& context)
        : declared_(declared), files_(files), number_(number), context_(context) {
        LSYS_CHECK(files.meshes.size() == (declared.shape == SpaceShape::Mesh ? 1U : 0U));
        LSYS_CHECK(declared.count > 0 && declared.count <= kMaxMarkers);
    }

    std::optional<EnvironmentFailure> begin(std::uint64_t seed) override { return draw(seed); }

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& /*sizes*/) override {
        if (auto failure = check_places(word.places)) {
            return failure;
        }
        return compete(word.places, answers);
    }

    void append_markers(std::vector<Vector3>& markers) const override {
        for (const Marker& marker : markers_) {
            markers.push_back(shape_->position(marker.units));
        }
    }
    std::string state() const override;
    bool restore(std::string_view state) override;

private:
    using Failure = std::optional<EnvironmentFailure>;

    [[nodiscard]] Failure cancelled_or_none() const {
        return is_cancelled(context_.cancelled) ? Failure(stopped(Stop::Cancelled)) : std::nullopt;
    }

    /// Moves the crown mesh to its place and builds its tree. Returns a failure if the mesh cannot
    /// bound markers.
    [[nodiscard]] Failure prepare_crown();
    [[nodiscard]] Failure draw(std::uint64_t seed);
    [[nodiscard]] Failure compete(std::span<const SensePlace> places, std::vector<float>& answers);
    /// Removes the markers that places kill. Returns the place that each remaining marker belongs
    /// to.
    [[nodiscard]] LargeVector<std::uint32_t> take_markers(const MarkerSearch& search);
    void write_answers(std::span<const SensePlace> places,
                       const LargeVector<std::uint32_t>& owners,
                       std::vector<float>& answers) const;
    /// Writes the answer of a place to which `markers`, indexes in markers_, belong.
    void
    write_one(const SensePlace& place, std::span<const std::uint32_t> markers, float* answer) const;
    [[nodiscard]] std::uint64_t digest() const;

    const BytecodeEnvironment& declared_;
    const EnvironmentFiles& files_;
    std::uint32_t number_; // index in Bytecode::environments
    EnvironmentContext context_;
    EnvironmentMesh crown_; // mesh of SpaceShape::Mesh, moved to its place
    std::unique_ptr<TriangleTree> crown_tree_;
    std::optional<MarkerShape> shape_; // set by begin()
    std::uint64_t seed_ = 0;
    LargeVector<Marker> markers_; // markers that no place has killed, by ascending index
};

std::optional<EnvironmentFailure> SpaceEnvironment::prepare_crown() {
    if (declared_.shape != SpaceShape::Mesh || crown_tree_ != nullptr) {
        return std::nullopt;
    }
    const EnvironmentMesh& mesh = files_.meshes.front();
    if (auto failure = check_mesh(mesh)) {
        return failure;
    }
    const std::uint64_t bytes = TriangleTree::bytes(mesh) + mesh.vertices.size() * sizeof(Vector3) +
                                mesh.triangles.size() * sizeof(mesh.triangles.front());
    if (bytes > context_.max_bytes) {
        return beyond_memory(bytes);
    }
    crown_ = mesh;
    for (Vector3& vertex : crown_.vertices) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            vertex[axis] += static_cast<double>(declared_.at[axis]);
        }
    }
    auto tree = std::make_unique<TriangleTree>(crown_, context_);
    if (auto failure = cancelled_or_none()) {
        return failure;
    }
    if (!tree->closed() || tree->empty()) {
        return refused("its mesh is not closed", "let each edge belong to exactly two faces");
    }
    crown_tree_ = std::move(tree);
    return std::nullopt;
}

std::optional<EnvironmentFailure> SpaceEnvironment::draw(std::uint64_t seed) {
    markers_.clear();
    if (auto failure = prepare_crown()) {
        return failure;
    }
    // Bytes per marker: the marker and, while a word is sensed, an element of each of three arrays:
    // the markers in spatial order, the place of each marker, and the markers sorted by place.
    const std::uint64_t bytes =
        std::uint64_t{declared_.count} * (sizeof(Marker) + 3 * sizeof(std::uint32_t));
    if (bytes > context_.max_bytes) {
        return beyond_memory(bytes);
    }
    shape_.emplace(declared_, crown_tree_ != nullptr ? &crown_ : nullptr, crown_tree_.get());
    seed_ = seed;
    auto markers = draw_markers(*shape_, declared_.count, {seed, number_}, context_);
    if (!markers) {
        return stopped(Stop::Cancelled);
    }
    markers_ = std::move(*markers);
    return std::nullopt;
}

std::optional<EnvironmentFailure> SpaceEnvironment::compete(std::span<const SensePlace> places,
                                                            std::vector<float>& answers) {
    if (places.empty()) {
        return std::nullopt;
    }
    const std::uint64_t bytes = markers_.size() * (sizeof(Marker) + 3 * sizeof(std::uint32_t)) +
                                MarkerSearch::bytes(places.size());
    if (bytes > context_.max_bytes) {
        return beyond_memory(bytes);
    }
    const MarkerSearch search(places, marker_reach(declared_), context_);
    if (!search.empty()) {
        const LargeVector<std::uint32_t> owners = take_markers(search);
        write_answers(places, owners, answers);
    }
    return cancelled_or_none();
}

LargeVector<std::uint32_t> SpaceEnvironment::take_markers(const MarkerSearch& search) {
    LargeVector<std::uint32_t> owners(markers_.size(), kNoPlace);
    const LargeVector<std::uint32_t> order = order_in_space(markers_);
    const std::uint64_t pieces = (markers_.size() + kMarkersPerPiece - 1) / kMarkersPerPiece;
    context_.workers->for_each(pieces, [&](std::uint64_t piece) {
        if (is_cancelled(context_.cancelled)) {
            return;
        }
        const std::size_t begin = piece * kMarkersPerPiece;
        const std::size_t end = std::min(markers_.size(), begin + kMarkersPerPiece);
        // Read all positions in one loop, so that the processor waits for several reads at the
        // same time.
        std::array<Vector3, kMarkersPerPiece> positions;
        for (std::size_t at = begin; at < end; ++at) {
            positions[at - begin] = shape_->position(markers_[order[at]].units);
        }
        std::uint32_t hint = kNoPlace;
        for (std::size_t at = begin; at < end; ++at) {
            const std::uint32_t owner = search.find(positions[at - begin], hint);
            owners[order[at]] = owner;
            hint = owner < kKilled ? owner : hint;
        }
    });
    std::size_t left = 0;
    for (std::size_t i = 0; i < markers_.size(); ++i) {
        if (owners[i] != kKilled) {
            owners[left] = owners[i];
            markers_[left++] = markers_[i];
        }
    }
    owners.resize(left);
    markers_.resize(left);
    return owners;
}

void SpaceEnvironment::write_answers(std::span<const SensePlace> places,
                                     const LargeVector<std::uint32_t>& owners,
                                     std::vector<float>& answers) const {
    // Sort the markers by place, ascending for each place, with a counting sort.
    std::vector<std::uint32_t> ends(places.size() + 1, 0);
    for (const std::uint32_t owner : owners) {
        if (owner != kNoPlace) {
            ++ends[owner + 1];
        }
    }
    for (std::size_t i = 1; i < ends.size(); ++i) {
        ends[i] += ends[i - 1];
    }
    LargeVector<std::uint32_t> sorted(ends.back());
    for (std::size_t i = 0; i < owners.size(); ++i) {
        if (owners[i] != kNoPlace) {
            sorted[ends[owners[i]]++] = static_cast<std::uint32_t>(i);
        }
    }
    constexpr std::size_t kPlacesPerPiece = 1U << 9;
    const std::uint64_t pieces = (places.size() + kPlacesPerPiece - 1) / kPlacesPerPiece;
    context_.workers->for_each(pieces, [&](std::uint64_t piece) {
        const std::size_t end = std::min<std::size_t>(places.size(), (piece + 1) * kPlacesPerPiece);
        for (std::size_t i = piece * kPlacesPerPiece; i < end; ++i) {
            const std::uint32_t first = i == 0 ? 0 : ends[i - 1];
            write_one(places[i], {sorted.data() + first, ends[i] - first}, answers.data() + i * 4);
        }
    });
}

void SpaceEnvironment::write_one(const SensePlace& place,
                                 std::span<const std::uint32_t> markers,
                                 float* answer) const {
    Vector3 direction{};
    for (const std::uint32_t marker : markers) {
        const Vector3 way = minus(shape_->position(markers_[marker].units), place.position);
        direction = plus(direction, normalised(way));
    }
    const auto count = static_cast<double>(markers.size());
    if (!markers.empty()) {
        direction = normalised({direction[0] / count, direction[1] / count, direction[2] / count});
    }
    write_answer(count, direction, answer);
}

/// A digest of the seed, the shape and all other inputs that decide which markers are drawn.
std::uint64_t SpaceEnvironment::digest() const {
    const std::array<float, 3>& size = declared_.size;
    const std::array<float, 3>& at = declared_.at;
    std::uint64_t hash = combine_numbers(0, seed_, number_, declared_.shape, declared_.count,
                                         size[0], size[1], size[2], at[0], at[1], at[2]);
    for (const Vector3& vertex : crown_.vertices) {
        hash = combine_numbers(hash, vertex[0], vertex[1], vertex[2]);
    }
    for (const std::array<std::uint32_t, 3>& corners : crown_.triangles) {
        hash = combine_numbers(hash, corners[0], corners[1], corners[2]);
    }
    return finish(hash);
}

constexpr std::size_t kDigestBytes = 8;

/// Eight bytes of digest, little-endian, then a bit for each declared marker, the lowest bit of a
/// byte first: 1 if the marker is left.
std::string SpaceEnvironment::state() const {
    std::string bytes(kDigestBytes + (std::size_t{declared_.count} + 7) / 8, '\0');
    const std::uint64_t hash = digest();
    for (std::size_t i = 0; i < kDigestBytes; ++i) {
        bytes[i] = static_cast<char>(static_cast<unsigned char>(hash >> (8 * i)));
    }
    for (const Marker& marker : markers_) {
        char& byte = bytes[kDigestBytes + marker.index / 8];
        byte = static_cast<char>(static_cast<unsigned char>(byte) | 1U << marker.index % 8);
    }
    return bytes;
}

bool SpaceEnvironment::restore(std::string_view state) {
    const std::size_t bytes = (std::size_t{declared_.count} + 7) / 8;
    if (state.size() != kDigestBytes + bytes) {
        return false;
    }
    const auto byte_at = [&](std::size_t at) { return static_cast<unsigned char>(state[at]); };
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < kDigestBytes; ++i) {
        hash |= std::uint64_t{byte_at(i)} << (8 * i);
    }
    if (hash != digest()) {
        return false;
    }
    const auto is_left = [&](std::uint32_t index) {
        return (byte_at(kDigestBytes + index / 8) >> index % 8 & 1) != 0;
    };
    std::size_t left = 0; // bits that are set
    for (std::size_t i = kDigestBytes; i < state.size(); ++i) {
        left += static_cast<std::size_t>(std::popcount(byte_at(i)));
    }
    LargeVector<Marker> markers;
    markers.reserve(markers_.size());
    std::copy_if(markers_.begin(), markers_.end(), std::back_inserter(markers),
                 [&](const Marker& marker) { return is_left(marker.index); });
    if (markers.size() != left) { // the state has markers that were never drawn
        return false;
    }
    markers_ = std::move(markers);
    return true;
}

} // namespace

std::unique_ptr<Environment> make_space(const BytecodeEnvironment& declared,
                                        const EnvironmentFiles& files,
                                        std::uint32_t number,
                                        const EnvironmentContext& context) {
    return std::make_unique<SpaceEnvironment>(declared, files, number, context);
}

} // namespace lsys
