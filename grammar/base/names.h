// Interned names: equal ids mean equal text, and no text is compared after the scanner.
// Made by the front ends, read by every later stage of the same compilation.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lsys {

/// Index of a name in its Names table, by first appearance; below 2^31.
enum class NameId : std::uint32_t {};
inline constexpr NameId kNoName{0x7FFFFFFFu};

class Names {
public:
    NameId intern(std::string_view text);
    /// The id of `text` if it is interned, else kNoName.
    [[nodiscard]] NameId find(std::string_view text) const;
    [[nodiscard]] std::string_view text(NameId id) const;
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(texts_.size()); }

    /// Makes messages write `original` for a name that the front end of another dialect replaced.
    void set_written(NameId id, std::string_view original);
    /// The name as its author wrote it, for messages.
    [[nodiscard]] std::string_view written(NameId id) const;

private:
    std::deque<std::string> texts_;
    std::unordered_map<std::string_view, NameId> ids_;
    std::map<NameId, std::string> written_; // where it is not the text
};

/// The form of an identifier: [A-Za-z_][A-Za-z0-9_]*.
[[nodiscard]] bool is_identifier(std::string_view text);

} // namespace lsys
