// SPDX-License-Identifier: MIT
#include "tests/viewer/lsview_run.h"

#include "viewer/app/lsview.h"

#include <sstream>
#include <utility>

namespace lsys::tests {

LscRun run_lsview(const std::vector<std::string>& arguments) {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    LscRun run;
    run.status = view::run(arguments, {in, out, err, false, nullptr, "lsview"});
    run.out = std::move(out).str();
    run.err = std::move(err).str();
    return run;
}

std::string sample(const std::string& name) {
    return LSYS_SOURCE_DIR "/samples/" + name + "/" + name + ".lsys";
}

} // namespace lsys::tests
