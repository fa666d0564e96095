// SPDX-License-Identifier: MIT
// The files beside a cpfg model that say how it looks: the view file, and a colour map (256 colours
// of 3 bytes) or materials (256 of 15 bytes). In the objects of L-studio the file `specifications`
// names them in a command line: `cpfg -M plant.mat plant.l plant.v`.
#pragma once

#include "grammar/ast/parse_context.h"
#include "grammar/base/source.h"

#include <string>
#include <string_view>

namespace lsys {

struct CpfgFiles {
    std::string view_path;
    std::string view; // text of the view file
    std::string colours_path;
    std::string colours;   // bytes of the colour map or the materials
    bool has_view = false; // a view file was found and read
};

/// Finds the files of the model `path`, in this order: the view file of the command line;
/// `specifications`; NAME.v; view.v; the only .v of the folder. Reports a view file of the command
/// line that cannot be read.
[[nodiscard]] CpfgFiles find_cpfg_files(std::string_view path, const ParseContext& context);

} // namespace lsys
