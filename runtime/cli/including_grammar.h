// Search for the grammar that includes a file, so that a part can be checked by itself.
#pragma once

#include <optional>
#include <string>

namespace lsys::lsc {

/// The path of a .lsys file in the folder of `path`, or in the folder above, that includes `path`;
/// the first by name. Unreadable and large files are passed over.
[[nodiscard]] std::optional<std::string> find_including_grammar(const std::string& path);

} // namespace lsys::lsc
