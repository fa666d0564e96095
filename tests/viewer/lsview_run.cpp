// SPDX-License-Identifier: MIT
#include "tests/viewer/lsview_run.h"

#include "viewer/app/lsview.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace lsys::tests {

LscRun run_lsview(const std::vector<std::string>& arguments) {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    LscRun run;
    std::vector<std::string> with_quality = arguments;
    const auto has = [&](const char* option) {
        return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
    };
    if (has("--screenshot") && !has("--quality")) {
        with_quality.insert(with_quality.begin(), {"--quality", "low"});
    }
    run.status = view::run(with_quality, {in, out, err, false, nullptr, "lsview"});
    run.out = std::move(out).str();
    run.err = std::move(err).str();
    return run;
}

std::string sample(const std::string& name) {
    return LSYS_SOURCE_DIR "/samples/" + name + "/" + name + ".lsys";
}

} // namespace lsys::tests
