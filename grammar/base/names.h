// SPDX-License-Identifier: MIT
// Interned names: equal ids mean equal texts, so later stages compare ids. Made by the front ends,
// read by all later stages of a compilation.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lsys {

/// Index of a name in its Names, by first appearance; below 2^31.
enum class NameId : std::uint32_t {};
inline constexpr NameId kNoName{0x7FFFFFFFu};

class Names {
public:
    /// The id of `text`, which is added if it is new.
    NameId intern(std::string_view text);
    /// The id of `text`; kNoName if `text` is not interned.
    [[nodiscard]] NameId find(std::string_view text) const;
    [[nodiscard]] std::string_view text(NameId id) const;
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(texts_.size()); }

    /// Sets the text of a name in messages: the original of a name that a dialect replaced.
    void set_written(NameId id, std::string_view original);
    /// The name as the author wrote it, for messages.
    [[nodiscard]] std::string_view written(NameId id) const;

private:
    std::deque<std::string> texts_; // by NameId
    std::unordered_map<std::string_view, NameId> ids_;
    std::map<NameId, std::string> written_; // originals of replaced names
};

/// Whether `text` matches [A-Za-z_][A-Za-z0-9_]*.
[[nodiscard]] bool is_identifier(std::string_view text);
/// Whether `text` is `?` and an identifier: the name of a sense module.
[[nodiscard]] bool is_sense_name(std::string_view text);
/// The name of the sense module that asks the environment `name`.
[[nodiscard]] inline std::string sense_name(std::string_view name) {
    return '?' + std::string(name);
}

} // namespace lsys
