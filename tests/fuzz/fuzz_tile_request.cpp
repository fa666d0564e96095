// SPDX-License-Identifier: MIT
// Sends requests to the tile server: the first line of the input is the target, the second the
// method, all others are header fields. Every response must have an expected status, and a range
// must lie within its file.
#include "runtime/serve/tile_service.h"
#include "tests/support/tile_forest.h"

#include <array>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lsys::TileForest forest = lsys::tests::make_small_tile_forest();
    static lsys::TileService service(forest, 1U << 20U);
    std::string_view text(reinterpret_cast<const char*>(data), size);
    std::array<std::string_view, 6> lines;
    for (std::string_view& line : lines) {
        line = text.substr(0, text.find('\n'));
        text.remove_prefix(line.size() == text.size() ? text.size() : line.size() + 1);
    }
    const std::string_view method = lines[1].empty() ? "GET" : lines[1];
    const lsys::TileResponse response =
        service.respond({method, lines[0], lines[2], lines[3], lines[4], lines[5]});
    const bool is_known = response.status == 200 || response.status == 204 ||
                          response.status == 206 || response.status == 304 ||
                          response.status == 400 || response.status == 404 ||
                          response.status == 405 || response.status == 416;
    const std::size_t whole = response.body == nullptr ? 0 : response.body->size();
    if (!is_known || response.first > whole || response.length > whole - response.first) {
        std::abort();
    }
    return 0;
}
