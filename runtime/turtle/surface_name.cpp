// SPDX-License-Identifier: MIT
#include "runtime/turtle/surface_name.h"

#include "grammar/base/number_chars.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace lsys {

namespace {

constexpr std::uint32_t kMaxSteps = 64;

/// Reads the words behind `#`. The functions take_...() remove what they read, and the blank after
/// it, from the beginning of the text.
class NameReader {
public:
    explicit NameReader(std::string_view text) : rest_(text) {}

    bool read(SurfaceName& name) {
        if (rest_.empty()) {
            return false;
        }
        const char first = rest_[0];
        if (first >= '0' && first <= '9' && !take_scale(name.scale)) {
            return false;
        }
        while (!rest_.empty()) {
            const std::string_view word = take_word();
            if (word == "whole") {
                name.is_whole = true;
            } else if (word == "texture") {
                std::uint32_t number = 0;
                if (!take_count(kMaxSurfaceTexture, number)) {
                    return false;
                }
                name.texture = number;
            } else if (word != "steps" || !take_count(kMaxSteps, name.row_steps) ||
                       !take_count(kMaxSteps, name.column_steps) || name.row_steps == 0 ||
                       name.column_steps == 0) {
                return false;
            }
        }
        return true;
    }

private:
    std::string_view take_word() {
        const std::string_view word = rest_.substr(0, rest_.find(' '));
        rest_.remove_prefix(std::min(word.size() + 1, rest_.size()));
        return word;
    }

    bool take_scale(float& scale) {
        const std::string_view word = take_word();
        const auto [end, error] = number_from_chars(word.data(), word.data() + word.size(), scale);
        return error == std::errc() && end == word.data() + word.size() && scale > 0.0F &&
               scale <= std::numeric_limits<float>::max();
    }

    bool take_count(std::uint32_t max, std::uint32_t& count) {
        const std::string_view word = take_word();
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
        return error == std::errc() && end == word.data() + word.size() && count <= max;
    }

    std::string_view rest_;
};

} // namespace

std::optional<SurfaceName> surface_name(std::string_view name) {
    SurfaceName parts;
    parts.path = name.substr(0, name.rfind('#'));
    if (!parts.path.ends_with(".s") && !parts.path.ends_with(".S")) {
        return std::nullopt;
    }
    if (parts.path.size() < name.size() &&
        !NameReader(name.substr(parts.path.size() + 1)).read(parts)) {
        return std::nullopt;
    }
    return parts;
}

std::string path_of_object(const std::string& name) {
    const std::optional<SurfaceName> parts = surface_name(name);
    return parts ? std::string(parts->path) : name;
}

} // namespace lsys
