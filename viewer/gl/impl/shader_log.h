// The compiler's log of a shader that is assembled from several files.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lsys::view {

/// `log` as the driver wrote it, with names for the file numbers that its lines begin with:
/// `0:12(3): error` of Mesa, `0(12) : error` of others. `files`: the names by the numbers that
/// `#line` gives them. Lines of another form, or with a number of no file, stay as they are.
[[nodiscard]] std::string name_files(std::string_view log, std::span<const std::string> files);

} // namespace lsys::view
