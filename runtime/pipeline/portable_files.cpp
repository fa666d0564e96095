// SPDX-License-Identifier: MIT
#include "runtime/pipeline/portable_files.h"

#include "grammar/base/paths.h"

#include <string>

namespace lsys {

void remove_machine_paths(Bytecode& bytecode) {
    if (bytecode.files.empty()) {
        return;
    }
    const std::string folder(folder_of_path(bytecode.files.front()));
    for (std::string& path : bytecode.files) {
        if (is_absolute_path(path)) {
            path = path.starts_with(folder) && folder != "/" ? path.substr(folder.size())
                                                             : std::string(name_of_path(path));
        }
    }
}

} // namespace lsys
