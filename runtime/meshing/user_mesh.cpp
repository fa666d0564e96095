// SPDX-License-Identifier: MIT
#include "runtime/meshing/user_mesh.h"

#include "grammar/base/hash.h"
#include "grammar/base/number_chars.h"
#include "runtime/base/size_text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <unordered_set>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kNotGiven = 0xFFFFFFFFu;
// Every vertex and every corner of a face takes two bytes at least, so indices fit into 32 bits.
constexpr std::uint64_t kMaxBytes = 0x1FFFFFFF0u;

/// A corner of a face: zero-based indices of the elements read so far.
struct Corner {
    std::uint32_t position = kNotGiven;
    std::uint32_t texture = kNotGiven;
    std::uint32_t normal = kNotGiven;
    friend bool operator==(const Corner&, const Corner&) = default;
};

/// Numbers distinct corners in order of first use: open addressing, at most half full.
class CornerNumbers {
public:
    std::uint32_t number(const Corner& corner) {
        if (2 * (corners_.size() + 1) > slots_.size()) {
            grow();
        }
        std::size_t slot = start(corner);
        while (slots_[slot] != kNotGiven) {
            if (corners_[slots_[slot]] == corner) {
                return slots_[slot];
            }
            slot = (slot + 1) & (slots_.size() - 1);
        }
        slots_[slot] = static_cast<std::uint32_t>(corners_.size());
        corners_.push_back(corner);
        return slots_[slot];
    }
    [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }
    [[nodiscard]] std::uint64_t byte_count() const {
        return corners_.capacity() * sizeof(Corner) + slots_.capacity() * sizeof(std::uint32_t);
    }
    /// Bytes that `more` new corners need beside byte_count(); 0 while there is room.
    [[nodiscard]] std::uint64_t growth(std::size_t more) const {
        const std::size_t count = corners_.size() + more;
        const bool has_room = count <= corners_.capacity() && 2 * count <= slots_.size();
        return has_room ? 0 : 2 * byte_count() + kFirstSlots * sizeof(std::uint32_t);
    }

private:
    static constexpr std::size_t kFirstSlots = 1024;

    [[nodiscard]] std::size_t start(const Corner& corner) const {
        const std::uint64_t low = corner.position | std::uint64_t{corner.texture} << 32;
        return mix64(mix64(low) + corner.normal) & (slots_.size() - 1);
    }
    void grow() {
        slots_.assign(std::max<std::size_t>(kFirstSlots, 2 * slots_.size()), kNotGiven);
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            std::size_t slot = start(corners_[i]);
            while (slots_[slot] != kNotGiven) {
                slot = (slot + 1) & (slots_.size() - 1);
            }
            slots_[slot] = i;
        }
    }

    std::vector<Corner> corners_;
    std::vector<std::uint32_t> slots_; // hash table: indexes in corners_; kNotGiven: empty
};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

class Reader {
public:
    Reader(std::string_view text, std::uint64_t max_bytes) : text_(text), max_bytes_(max_bytes) {}

    Result<UserMesh> read() {
        while (at_ < text_.size()) {
            read_line();
            if (error_) {
                return std::move(*error_);
            }
        }
        if (mesh_.indices.empty()) {
            return Error{"there is no face in it"};
        }
        const std::uint64_t finished_bytes =
            numbers_.corners().size() * (2 * sizeof(glm::vec3) + sizeof(glm::vec2));
        if (!check_memory(finished_bytes)) {
            return std::move(*error_);
        }
        finish();
        return std::move(mesh_);
    }

private:
    // --- text: lines end at \n, \r or both; a backslash at the end of a line continues it
    [[nodiscard]] bool ends_here(std::size_t at) const {
        return at >= text_.size() || text_[at] == '\n' || text_[at] == '\r';
    }
    void skip_line_end() {
        if (at_ < text_.size()) {
            at_ += text_.substr(at_, 2) == "\r\n" ? 2U : 1U;
            ++line_;
        }
    }
    void skip_blanks() {
        while (at_ < text_.size()) {
            if (is_blank(text_[at_])) {
                ++at_;
            } else if (text_[at_] == '\\' && at_ + 1 < text_.size() && ends_here(at_ + 1)) {
                ++at_;
                skip_line_end();
            } else {
                return;
            }
        }
    }
    /// The next word of the line; empty at its end, and where a comment begins.
    std::string_view word() {
        skip_blanks();
        if (at_ < text_.size() && text_[at_] == '#') {
            while (!ends_here(at_)) {
                ++at_;
            }
        }
        const std::size_t begin = at_;
        while (!ends_here(at_) && !is_blank(text_[at_]) &&
               !(text_[at_] == '\\' && ends_here(at_ + 1))) {
            ++at_;
        }
        return text_.substr(begin, at_ - begin);
    }
    void fail(std::uint64_t line, std::string_view what) {
        error_ = Error{fmt::format("line {}: {}", line, what)};
    }

    // --- memory
    [[nodiscard]] std::uint64_t held_bytes() const {
        const auto of = [](const auto& items) { return items.capacity() * sizeof(items[0]); };
        return of(positions_) + of(normals_) + of(texture_coordinates_) + of(area_sums_) +
               of(mesh_.indices) + numbers_.byte_count() + name_bytes_;
    }
    /// Returns whether `more` bytes fit; sets the error if they do not.
    bool check_memory(std::uint64_t more) {
        if (held_bytes() + more <= max_bytes_) {
            return true;
        }
        error_ = memory_error("its mesh", max_bytes_);
        return false;
    }
    /// Makes room for `more` items, by doubling. Needs the memory of the new array beside the old
    /// one.
    template <typename T>
    bool make_room(std::vector<T>& items, std::size_t more) {
        const std::size_t count = items.size() + more;
        if (count <= items.capacity()) {
            return true;
        }
        constexpr std::size_t kMin = 32;
        const std::size_t room = std::max({count, 2 * items.capacity(), kMin});
        if (!check_memory(room * sizeof(T))) {
            return false;
        }
        items.reserve(room);
        return true;
    }

    void read_line() {
        const std::uint64_t line = line_;
        const std::string_view kind = word();
        if (kind == "v") {
            read_position(line);
        } else if (kind == "vt") {
            read_texture_coordinate(line);
        } else if (kind == "vn") {
            read_normal(line);
        } else if (kind == "f") {
            read_face(line);
        } else if (kind == "mtllib") {
            static_cast<void>(add_name(rest_of_line(), known_libraries_, mesh_.libraries));
        } else if (kind == "usemtl") {
            material_ = rest_of_line();
        }
        if (error_) {
            return;
        }
        while (!word().empty()) {
        }
        skip_line_end();
    }

    /// The name in the rest of the line. It may have blanks in it, but not at its ends.
    ObjName rest_of_line() {
        skip_blanks();
        const std::size_t begin = at_;
        while (!ends_here(at_)) {
            ++at_;
        }
        std::size_t end = at_;
        while (end > begin && is_blank(text_[end - 1])) {
            --end;
        }
        return {std::string(text_.substr(begin, end - begin)), begin};
    }
    bool add_name(const ObjName& name,
                  std::unordered_set<std::string>& known,
                  std::vector<ObjName>& names) {
        if (known.contains(name.name)) {
            return true;
        }
        // Upper bound: a node and a bucket of the set, an item of a list that may be reallocating.
        const std::uint64_t bytes =
            2 * name.name.size() + 8 * sizeof(void*) + sizeof(std::string) + 3 * sizeof(ObjName);
        if (!check_memory(bytes)) {
            return false;
        }
        name_bytes_ += bytes;
        known.insert(name.name);
        names.push_back(name);
        return true;
    }

    // --- numbers
    std::optional<float> number() {
        std::string_view digits = word();
        if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') {
            digits.remove_prefix(1);
        }
        double value = 0.0;
        const char* const end = digits.data() + digits.size();
        const auto [stop, problem] = number_from_chars(digits.data(), end, value);
        if (stop != end || problem == std::errc::invalid_argument) {
            return std::nullopt;
        }
        if (problem == std::errc::result_out_of_range) {
            // Out of range of a double: the text tells whether it is too large or too small.
            const std::size_t exponent = digits.find_first_of("eE");
            const std::size_t leading = digits.find_first_not_of("-0");
            const bool tiny = exponent != std::string_view::npos
                                  ? digits.substr(exponent + 1).starts_with('-')
                                  : leading != std::string_view::npos && digits[leading] == '.';
            value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
        }
        if (!(std::abs(value) <= static_cast<double>(kMaxCoordinate))) {
            return std::nullopt;
        }
        return static_cast<float>(value);
    }
    bool read_numbers(std::uint64_t line, std::span<float> numbers, std::string_view what) {
        for (float& value : numbers) {
            const std::optional<float> read = number();
            if (!read) {
                fail(line, what);
                return false;
            }
            value = *read;
        }
        return true;
    }
    void read_position(std::uint64_t line) {
        std::array<float, 3> p{};
        if (read_numbers(line, p, "a vertex needs three numbers of up to 1e18") &&
            make_room(positions_, 1)) {
            positions_.emplace_back(p[0], p[1], p[2]);
        }
    }
    void read_normal(std::uint64_t line) {
        std::array<float, 3> n{};
        if (read_numbers(line, n, "a normal needs three numbers of up to 1e18") &&
            make_room(normals_, 1)) {
            normals_.emplace_back(n[0], n[1], n[2]);
        }
    }
    void read_texture_coordinate(std::uint64_t line) {
        std::array<float, 2> t{};
        if (!read_numbers(line, std::span(t).first(1),
                          "a texture coordinate needs numbers of up to 1e18")) {
            return;
        }
        const std::size_t before = at_;
        const std::uint64_t line_before = line_;
        const std::optional<float> v = number(); // the second coordinate may be missing
        if (v) {
            t[1] = *v;
        } else {
            at_ = before;
            line_ = line_before;
            if (!word().empty()) {
                fail(line, "a texture coordinate needs numbers of up to 1e18");
                return;
            }
        }
        if (make_room(texture_coordinates_, 1)) {
            texture_coordinates_.emplace_back(t[0], 1.0F - t[1]);
        }
    }

    // --- faces
    /// Reads an index at the head of `rest`. Negative indices count back from the last element
    /// read.
    bool read_index(std::uint64_t line,
                    std::string_view& rest,
                    std::size_t count,
                    std::string_view what,
                    std::uint32_t& index) {
        std::int64_t value = 0;
        const auto [stop, problem] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (problem == std::errc::invalid_argument) {
            fail(line, "a corner of a face is not written as v, v/vt, v//vn or v/vt/vn");
            return false;
        }
        const auto limit = static_cast<std::int64_t>(count);
        if (problem != std::errc() || value == 0 || value > limit || value < -limit) {
            fail(line, fmt::format("face refers to {} {} of {}", what,
                                   std::string_view(rest.data(),
                                                    static_cast<std::size_t>(stop - rest.data())),
                                   count));
            return false;
        }
        index = static_cast<std::uint32_t>(value > 0 ? value - 1 : limit + value);
        rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
        return true;
    }
    bool read_corner(std::uint64_t line, std::string_view text, Corner& corner) {
        corner = {};
        if (!read_index(line, text, positions_.size(), "vertex", corner.position)) {
            return false;
        }
        if (text.starts_with('/')) {
            text.remove_prefix(1);
            if (!text.empty() && text.front() != '/' &&
                !read_index(line, text, texture_coordinates_.size(), "texture coordinate",
                            corner.texture)) {
                return false;
            }
        }
        if (text.starts_with('/')) {
            text.remove_prefix(1);
            if (!text.empty() &&
                !read_index(line, text, normals_.size(), "normal", corner.normal)) {
                return false;
            }
        }
        if (!text.empty()) {
            fail(line, "a corner of a face is not written as v, v/vt, v//vn or v/vt/vn");
            return false;
        }
        return true;
    }
    void read_face(std::uint64_t line) {
        Corner first;
        Corner last;
        std::uint64_t count = 0;
        for (std::string_view text = word(); !text.empty(); text = word()) {
            Corner corner;
            if (!read_corner(line, text, corner)) {
                return;
            }
            if (count == 0) {
                first = corner;
            } else if (count > 1 && !add_triangle(first, last, corner)) {
                return;
            }
            last = corner;
            ++count;
        }
        if (count < 3) {
            fail(line, fmt::format("a face needs three corners and has {}", count));
        }
    }
    /// Returns false if memory runs out.
    bool add_triangle(const Corner& a, const Corner& b, const Corner& c) {
        const glm::dvec3 p(positions_[a.position]);
        const glm::dvec3 area = glm::cross(glm::dvec3(positions_[b.position]) - p,
                                           glm::dvec3(positions_[c.position]) - p);
        if (glm::dot(area, area) == 0.0) {
            return true;
        }
        if (mesh_.materials.empty() || material_.name != last_material_) {
            last_material_ = material_.name;
            if (!add_name(material_, known_materials_, mesh_.materials)) {
                return false;
            }
        }
        const std::uint64_t growth = numbers_.growth(3);
        if ((growth != 0 && !check_memory(growth)) || !make_room(mesh_.indices, 3)) {
            return false;
        }
        for (const Corner* corner : {&a, &b, &c}) {
            mesh_.indices.push_back(numbers_.number(*corner));
            if (!has_normal(*corner)) {
                if (area_sums_.size() < positions_.size()) {
                    if (!make_room(area_sums_, positions_.size() - area_sums_.size())) {
                        return false;
                    }
                    area_sums_.resize(positions_.size());
                }
                area_sums_[corner->position] += area;
            }
        }
        return true;
    }
    [[nodiscard]] bool has_normal(const Corner& corner) const {
        return corner.normal != kNotGiven && normals_[corner.normal] != glm::vec3(0.0F);
    }

    void finish() {
        const std::vector<Corner>& corners = numbers_.corners();
        mesh_.positions.reserve(corners.size());
        mesh_.normals.reserve(corners.size());
        if (!texture_coordinates_.empty()) {
            mesh_.texture_coordinates.reserve(corners.size());
        }
        for (const Corner& corner : corners) {
            mesh_.positions.push_back(positions_[corner.position]);
            const glm::dvec3 normal = has_normal(corner) ? glm::dvec3(normals_[corner.normal])
                                                         : area_sums_[corner.position];
            const double length = std::sqrt(glm::dot(normal, normal));
            // If the normals of the faces of a vertex cancel each other, its normal is +Y.
            mesh_.normals.push_back(length > 0.0 ? glm::vec3(normal / length)
                                                 : glm::vec3(0.0F, 1.0F, 0.0F));
            if (!texture_coordinates_.empty()) {
                mesh_.texture_coordinates.push_back(corner.texture != kNotGiven
                                                        ? texture_coordinates_[corner.texture]
                                                        : glm::vec2(0.0F));
            }
        }
    }

    static constexpr float kMaxCoordinate = 1e18F; // so that areas and lengths stay finite

    std::string_view text_;
    std::uint64_t max_bytes_;
    std::uint64_t name_bytes_ = 0; // bytes of the names of materials and their files
    std::size_t at_ = 0;
    std::uint64_t line_ = 1; // number of the line at at_
    std::optional<Error> error_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec2> texture_coordinates_;
    std::vector<glm::dvec3>
        area_sums_; // by vertex: sum of the normals of its faces, each of length 2 * area
    CornerNumbers numbers_;
    ObjName material_;          // material of the faces that follow
    std::string last_material_; // name of the material of the triangle added last
    std::unordered_set<std::string> known_libraries_;
    std::unordered_set<std::string> known_materials_;
    UserMesh mesh_;
};

} // namespace

float UserMesh::length() const {
    if (positions.empty()) {
        return 0.0F;
    }
    const auto [lowest, highest] =
        std::minmax_element(positions.begin(), positions.end(),
                            [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; });
    return highest->y - lowest->y;
}

std::uint64_t UserMesh::byte_count() const {
    const auto of = [](const auto& items) { return items.capacity() * sizeof(items[0]); };
    std::uint64_t bytes = of(positions) + of(normals) + of(texture_coordinates) + of(indices) +
                          of(libraries) + of(materials) + of(files);
    for (const std::vector<ObjName>* const names : {&libraries, &materials}) {
        for (const ObjName& name : *names) {
            bytes += name.name.size();
        }
    }
    for (const std::string& file : files) {
        bytes += file.size();
    }
    return bytes;
}

namespace {

/// The member that a line with `keyword` sets; null if the keyword is no supported map.
ObjName* map_of(std::string_view keyword, MaterialPicture& material) {
    if (keyword == "map_Kd") {
        return &material.file;
    }
    if (keyword == "map_d") {
        return &material.opacity;
    }
    const bool is_normal_map =
        keyword == "map_Bump" || keyword == "map_bump" || keyword == "bump" || keyword == "norm";
    return is_normal_map ? &material.normal_map : nullptr;
}

/// The number written as `word`; 1 if it is not a number.
float number_of(std::string_view word) {
    float number = 1.0F;
    const auto [end, failure] = number_from_chars(word.data(), word.data() + word.size(), number);
    return failure == std::errc() && end == word.data() + word.size() && std::isfinite(number)
               ? number
               : 1.0F;
}

} // namespace

std::unordered_map<std::string, MaterialPicture> pictures_of(std::string_view mtl,
                                                             std::span<const ObjName> wanted) {
    std::unordered_set<std::string_view> names;
    for (const ObjName& each : wanted) {
        names.insert(each.name);
    }
    std::unordered_map<std::string, MaterialPicture> materials;
    MaterialPicture* material = nullptr; // material that the current lines describe
    for (std::size_t at = 0; at < mtl.size();) {
        const std::size_t end = std::min(mtl.find_first_of("\r\n", at), mtl.size());
        std::size_t begin = at;
        const auto skip_blanks = [&] {
            while (begin < end && is_blank(mtl[begin])) {
                ++begin;
            }
        };
        const auto next_word = [&] {
            skip_blanks();
            const std::size_t first = begin;
            while (begin < end && !is_blank(mtl[begin])) {
                ++begin;
            }
            return mtl.substr(first, begin - first);
        };
        const std::string_view kind = next_word();
        skip_blanks();
        std::size_t last = end;
        while (last > begin && is_blank(mtl[last - 1])) {
            --last;
        }
        if (kind == "newmtl") {
            const std::string_view name = mtl.substr(begin, last - begin);
            material = names.contains(name) ? &materials[std::string(name)] : nullptr;
        } else if (material == nullptr) {
            // A line of a material that is not wanted is skipped.
        } else if (ObjName* const file = map_of(kind, *material); file != nullptr) {
            // Options precede the name: a keyword, then its numbers or another word.
            while (begin < last && mtl[begin] == '-') {
                const std::string_view option = next_word();
                if (option == "-bm" && file == &material->normal_map) {
                    material->bump = number_of(next_word());
                    skip_blanks();
                    continue;
                }
                material->has_options = true;
                const bool of_numbers =
                    option == "-o" || option == "-s" || option == "-t" || option == "-mm";
                std::size_t kept = begin;
                for (int i = 0; i < (of_numbers ? 3 : 1); ++i) {
                    kept = begin;
                    const std::string_view value = next_word();
                    if (of_numbers &&
                        value.find_first_not_of("+-.0123456789eE") != std::string_view::npos) {
                        begin = kept;
                        break;
                    }
                }
                skip_blanks();
            }
            const std::size_t name = std::min(begin, last);
            *file = {std::string(mtl.substr(name, last - name)), name};
        }
        at = end + 1;
    }
    return materials;
}

Result<UserMesh> read_obj(std::string_view text, std::uint64_t max_bytes) {
    if (text.size() > kMaxBytes) {
        return Error{"it has more than 8 GiB"};
    }
    return Reader(text, max_bytes).read();
}

} // namespace lsys
