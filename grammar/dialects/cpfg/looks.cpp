// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/looks.h"

#include "grammar/base/characters.h"
#include "grammar/base/number_chars.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lsys {

namespace {

/// A line `key: value` of a view file.
struct ViewLine {
    std::string_view key;
    std::string_view value;
    SourceSpan span;
};

std::string rounded_text(double value) {
    return fixed_text(static_cast<float>(value));
}

/// Removes the number at the start of `text`, and blanks, commas and colons around it.
std::optional<double> next_number(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t,:\r"), text.size()));
    text.remove_prefix(text.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Replaces comments by blanks, so that places stay.
std::string without_comments(std::string_view text) {
    std::string result(text);
    for (std::size_t at = 0; at + 1 < result.size(); ++at) {
        const bool is_block = text.substr(at, 2) == "/*";
        if (!is_block && text.substr(at, 2) != "//") {
            continue;
        }
        const std::size_t close = is_block ? text.find("*/", at + 2) : text.find('\n', at);
        const std::size_t end = std::min(close + (is_block ? 2 : 0), text.size());
        for (const std::size_t last = close == std::string_view::npos ? text.size() : end;
             at < last; ++at) {
            result[at] = result[at] == '\n' ? '\n' : ' ';
        }
        --at;
    }
    return result;
}

std::vector<ViewLine> lines_of(FileId file, std::string_view text) {
    std::vector<ViewLine> lines;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view line = trimmed(take_line(rest), kWhitespace);
        const std::size_t colon = line.find(':');
        if (colon != std::string_view::npos) {
            const auto begin = static_cast<std::uint32_t>(line.data() - text.data());
            lines.push_back({trimmed(line.substr(0, colon), kWhitespace),
                             line.substr(colon + 1),
                             {file, begin, begin + static_cast<std::uint32_t>(line.size())}});
        }
    }
    return lines;
}

constexpr double kColours = 256.0;
constexpr double kMinScale = 1e-6;
constexpr double kMaxRatio = 1e6;

struct ViewTropism {
    std::string kind;
    std::array<double, 3> direction{};
    double strength = 0.0;
    double increment = 0.0;
    double angle = 0.0; // degrees
    bool is_valid = true;
};

bool normalise(std::array<double, 3>& direction, double length) {
    double square = 0.0;
    for (const double part : direction) {
        square += part * part;
    }
    if (!(square > 0.0) || length == 0.0) {
        return false;
    }
    for (double& part : direction) {
        part *= length / std::sqrt(square);
    }
    return true;
}

/// Reads `T: x y z I: i A: a E: e S: s`: direction, intensity up to 1, angle, strength, increment.
ViewTropism read_tropism(std::string_view text, std::string kind) {
    ViewTropism tropism{.kind = std::move(kind)};
    double intensity = 1.0;
    while (true) {
        text = trimmed(text, " \t:\r");
        if (text.empty()) {
            break;
        }
        const char letter = text[0];
        text.remove_prefix(1);
        for (int i = 0; i < (letter == 'T' ? 3 : 1); ++i) {
            const std::optional<double> value = next_number(text);
            tropism.is_valid = tropism.is_valid && value.has_value();
            const double number = value.value_or(0.0);
            if (letter == 'T') {
                tropism.direction[static_cast<std::size_t>(i)] = number;
            } else if (letter == 'I') {
                intensity = std::clamp(number, -1.0, 1.0);
            } else if (letter == 'A') {
                tropism.angle = number;
            } else if (letter == 'E') {
                tropism.strength = number;
            } else if (letter == 'S') {
                tropism.increment = number;
            } else {
                tropism.is_valid = false;
            }
        }
        if (!tropism.is_valid) {
            return tropism;
        }
    }
    tropism.is_valid = normalise(tropism.direction, intensity);
    return tropism;
}

class LookReader {
public:
    explicit LookReader(const CpfgUses& uses) : uses_(uses) {
        after_.kind = "after";
        after_.direction = {0.0, 1.0, 0.0};
    }

    void read(const ViewLine& line) {
        read_tropism_line(line);
        read_width_line(line);
        read_other_line(line);
    }

    /// `nowhere`: place of statements that no line of the view file gives.
    CpfgLooks finish(SourceSpan nowhere) {
        write_tropisms(nowhere);
        write_widths(nowhere);
        return std::move(looks_);
    }

private:
    void leave_out(const ViewLine& line, const std::string& why) {
        looks_.left_out.push_back(
            {"`" + std::string(line.key) + "` is left out: " + why, line.span});
    }
    std::optional<double> number_of(const ViewLine& line) {
        std::string_view value = line.value;
        const std::optional<double> number = next_number(value);
        if (!number) {
            leave_out(line, "this is no number");
        }
        return number;
    }

    void read_tropism_line(const ViewLine& line) {
        if (line.key == "tropism direction") {
            std::string_view value = line.value;
            std::array<double, 3> direction{};
            bool is_valid = true;
            for (double& part : direction) {
                const std::optional<double> number = next_number(value);
                is_valid = is_valid && number;
                part = number.value_or(0.0);
            }
            if (!is_valid || !normalise(direction, 1.0)) {
                leave_out(line, "a direction has three numbers, not all 0");
                return;
            }
            after_.direction = direction;
            place_ = line.span;
        } else if (line.key == "initial elasticity") {
            after_.strength = number_of(line).value_or(0.0);
            place_ = line.span;
        } else if (line.key == "elasticity increment") {
            after_.increment = number_of(line).value_or(0.0);
        } else if (line.key == "tropism" || line.key == "torque") {
            ViewTropism read = read_tropism(line.value, line.key == "tropism" ? "before" : "twist");
            constexpr std::size_t kMaxCount = 10; // max number of tropisms and torques in cpfg
            if (!read.is_valid || rows_.size() == kMaxCount) {
                leave_out(line, read.is_valid ? "there are ten others"
                                              : "it is not of the form `T: 0 -1 0 E: 0.2`");
                return;
            }
            rows_.push_back(std::move(read));
            place_ = line.span;
        }
    }

    void read_width_line(const ViewLine& line) {
        const std::string_view value = trimmed(line.value, kWhitespace);
        if (line.key == "initial line width") {
            std::string_view rest = value;
            if (const std::optional<double> width = next_number(rest)) {
                width_ = *width;
                width_place_ = line.span;
                is_pixel_ = trimmed(rest, kWhitespace).starts_with('p');
            } else {
                leave_out(line, "this is no number");
            }
        } else if (line.key == "line style") {
            is_pixel_ = value.starts_with("pixel") || value.starts_with('1');
            width_place_ = line.span;
        } else if (line.key == "line width increment") {
            const std::optional<double> increment = number_of(line);
            if (increment && uses_.steps_widths) {
                looks_.statements.push_back(
                    {"#set width_increment " + rounded_text(*increment) + ";\n", line.span});
            }
        }
    }

    void read_other_line(const ViewLine& line) {
        std::string_view value = line.value;
        if (line.key == "initial color") {
            if (const std::optional<double> colour = number_of(line)) {
                const double index = std::clamp(std::trunc(*colour), 0.0, 255.0);
                looks_.statements.push_back(
                    {"#set colour " + rounded_text(index) + ";\n", line.span});
                looks_.first_colour = static_cast<unsigned>(index);
            }
        } else if (line.key == "color increment") {
            const double increment = std::trunc(next_number(value).value_or(1.0));
            if (uses_.steps_colours && increment != 1.0) {
                // The indices wrap, so -1 is 255.
                const double turned =
                    std::fmod(std::fmod(increment, kColours) + kColours, kColours);
                looks_.statements.push_back(
                    {"#set colour_increment " + rounded_text(turned) + ";\n", line.span});
            }
        } else if (line.key == "texture") {
            read_texture(line);
        } else if (line.key == "initial scale") {
            read_scale(line);
        } else if (line.key == "tsurface" || line.key == "line" || line.key == "blob") {
            leave_out(line, "it is not drawn");
        }
    }

    /// Reads `F: bark.rgb L: n H: n E: m R: 1 S`. Filters (L, H) have no effect.
    void read_texture(const ViewLine& line) {
        if (uses_.textures.empty() && !uses_.has_any_texture) {
            return;
        }
        constexpr std::string_view kBetween = " \t\r:,";
        std::string_view rest = line.value;
        const auto next_word = [&] {
            rest.remove_prefix(std::min(rest.find_first_not_of(kBetween), rest.size()));
            const std::string_view word = rest.substr(0, rest.find_first_of(kBetween));
            rest.remove_prefix(word.size());
            return word;
        };
        CpfgTexture texture;
        for (std::string_view key = next_word(); !key.empty(); key = next_word()) {
            const std::string_view value = key[0] == 'S' ? std::string_view() : next_word();
            if (key[0] == 'F') {
                texture.file = value;
            } else if (key[0] == 'E') {
                texture.replaces_colour = value.starts_with('d');
            } else if (key[0] == 'S') {
                texture.is_whole = true;
            } else if (key[0] == 'R') {
                std::string_view text = value;
                const double ratio = next_number(text).value_or(1.0);
                texture.ratio = ratio >= kMinScale && ratio < kMaxRatio ? ratio : 1.0;
            }
        }
        const std::string_view file = texture.file;
        constexpr std::array<std::string_view, 4> kRead = {".rgb", ".tga", ".png", ".jpg"};
        if (!std::ranges::any_of(kRead, [&](auto end) { return file.ends_with(end); })) {
            leave_out(line, "only rgb, tga, png and jpg files are read");
            texture.file.clear();
        }
        looks_.textures.push_back(std::move(texture));
    }

    /// Reads the scale of the plant. It scales widths that the word sets, not the initial width.
    void read_scale(const ViewLine& line) {
        const std::optional<double> scale = number_of(line);
        if (!scale || *scale == 1.0 || *scale == 0.0) { // cpfg takes 0 as 1
            return;
        }
        if (*scale < kMinScale || uses_.reads_places) {
            leave_out(line, uses_.reads_places ? "`?P` reads places before a plant is scaled"
                                               : "the scale of a plant is 0.000001 or more");
            return;
        }
        scale_ = *scale;
        looks_.statements.push_back({"#set scale " + rounded_text(*scale) + ";\n", line.span});
    }

    void write_tropisms(SourceSpan nowhere) {
        std::string text;
        const auto add = [&](const ViewTropism& row) {
            text += " " + row.kind;
            for (const double part : row.direction) {
                text += " " + rounded_text(part);
            }
            const bool has_angle = row.angle != 0.0;
            text += " " + rounded_text(row.strength);
            text += row.increment != 0.0 || has_angle ? " " + rounded_text(row.increment) : "";
            text += has_angle ? " " + rounded_text(row.angle) : "";
        };
        if (after_.strength != 0.0 || uses_.has_elasticity) {
            add(after_);
        }
        const bool acts = uses_.changes_tropisms ||
                          std::any_of(rows_.begin(), rows_.end(),
                                      [](const auto& row) { return row.strength != 0.0; });
        for (std::size_t i = 0; acts && i < rows_.size(); ++i) {
            add(rows_[i]);
        }
        if (!text.empty()) {
            looks_.statements.push_back({"#set tropisms" + text + ";\n", place_.value_or(nowhere)});
        }
    }

    void write_widths(SourceSpan nowhere) {
        const SourceSpan place = width_place_.value_or(nowhere);
        // If no line of the view file states the unit, widths that the model sets are in metres.
        const bool is_pixel = is_pixel_.value_or(!uses_.sets_widths);
        if (is_pixel) {
            looks_.statements.push_back({"#set width_unit pixels;\n", place});
        }
        if (width_ || is_pixel) {
            const double width = std::max(width_.value_or(1.0), 0.0);
            looks_.statements.push_back(
                {"#set width " + rounded_text(is_pixel ? width : width / scale_) + ";\n", place});
        }
    }

    CpfgLooks looks_;
    const CpfgUses& uses_;
    ViewTropism after_;                     // the tropism of elasticity
    std::vector<ViewTropism> rows_;         // the other tropisms and torques
    std::optional<SourceSpan> place_;       // place of the last line about a tropism
    double scale_ = 1.0;                    // `initial scale:`
    std::optional<double> width_;           // initial line width
    std::optional<bool> is_pixel_;          // widths are in pixels; unset: no line states the unit
    std::optional<SourceSpan> width_place_; // place of the last line about widths
};

} // namespace

CpfgLooks read_looks(FileId view, std::string_view text, const CpfgUses& uses) {
    LookReader reader(uses);
    const std::string plain = without_comments(text);
    for (const ViewLine& line : lines_of(view, plain)) {
        reader.read(line);
    }
    return reader.finish({view, 0, 0});
}

} // namespace lsys
