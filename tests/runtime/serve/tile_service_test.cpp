// SPDX-License-Identifier: MIT
#include "runtime/serve/tile_service.h"
#include "tests/support/tile_forest.h"

#include <catch2/catch.hpp>

#include <string>
#include <thread>
#include <vector>
#include <zlib.h>

namespace lsys {
namespace {

constexpr std::uint64_t kCache = 64U << 20U;

const TileForest& forest() {
    static const TileForest made = tests::make_small_tile_forest();
    return made;
}

std::string field_of(const TileResponse& response, std::string_view name) {
    for (const auto& [field, value] : response.fields) {
        if (field == name) {
            return value;
        }
    }
    return {};
}

std::string body_of(const TileResponse& response) {
    return response.body == nullptr ? std::string()
                                    : response.body->substr(response.first, response.length);
}

TileRequest get(std::string_view target) {
    TileRequest request;
    request.method = "GET";
    request.target = target;
    return request;
}

std::string unpacked(const std::string& packed) {
    z_stream stream{};
    REQUIRE(inflateInit2(&stream, 15 + 16) == Z_OK);
    std::string text(1U << 22U, '\0');
    std::string input = packed;
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(input.size());
    stream.next_out = reinterpret_cast<Bytef*>(text.data());
    stream.avail_out = static_cast<uInt>(text.size());
    CHECK(inflate(&stream, Z_FINISH) == Z_STREAM_END);
    text.resize(stream.total_out);
    inflateEnd(&stream);
    return text;
}

TEST_CASE("subtree files of implicit tiling are served") {
    TileOptions options;
    options.implicit = true;
    const TileForest implicit = tests::make_tile_strip(options);
    TileService service(implicit, kCache);
    CHECK(body_of(service.respond(get("/0/0/0.subtree"))) == implicit.subtree({}));
    CHECK(body_of(service.respond(get("/tileset.json"))) == implicit.tileset({}));
    CHECK(service.respond(get("/1/0/0.subtree")).status == 404); // within the first subtree
    CHECK(service.respond(get("/2/0/0.json")).status == 404);
    CHECK(TileService(forest(), kCache).respond(get("/0/0/0.subtree")).status == 404);
}

TEST_CASE("the paths of tiles are numbers in one form only") {
    TileId tile;
    CHECK(parse_tile_path("3/5/2.glb", ".glb", tile));
    CHECK(tile == TileId{3, 5, 2});
    CHECK(parse_tile_path("0/0/0.json", ".json", tile));
    for (const char* const path :
         {"", ".glb", "3/5.glb", "3/5/2", "3/5/2.json", "03/5/2.glb", "3/5/2/1.glb", "3//2.glb",
          "-3/5/2.glb", "+3/5/2.glb", " 3/5/2.glb", "3/5/2 .glb", "3/5/99999999999.glb",
          "/3/5/2.glb", "3/5/2.glb.glb", "3/5/2.GLB", "3/5/0x2.glb"}) {
        CAPTURE(path);
        CHECK_FALSE(parse_tile_path(path, ".glb", tile));
    }
}

TEST_CASE("the service answers with the tiles, tilesets and shared files of the forest") {
    TileService service(forest(), kCache);
    REQUIRE(forest().levels().size() >= 3);
    for (std::uint32_t level = 0; level < forest().levels().size(); ++level) {
        for (const TileId& tile : forest().tiles(level)) {
            const std::string path = "/" + TileForest::content_path(tile);
            const TileResponse response = service.respond(get(path));
            REQUIRE(response.status == 200);
            CHECK(field_of(response, "Content-Type") == "model/gltf-binary");
            CHECK(field_of(response, "Access-Control-Allow-Origin") == "*");
            REQUIRE(body_of(response) == forest().content(tile).bytes);
        }
    }
    const TileResponse root = service.respond(get("/tileset.json?v=1"));
    CHECK(root.status == 200);
    CHECK(field_of(root, "Content-Type") == "application/json");
    CHECK(body_of(root) == forest().tileset({}));
    CHECK(body_of(service.respond(get("//1/0/0.glb"))) == forest().content({1, 0, 0}).bytes);
    REQUIRE_FALSE(forest().files().empty());
    for (const TileFile& file : forest().files()) {
        CHECK(body_of(service.respond(get("/" + file.path))) == file.bytes);
    }
    CHECK(body_of(service.respond(get("/"))).find("tileset.json") != std::string::npos);
    CHECK(body_of(service.respond(get("/health"))) == "ok\n");
}

TEST_CASE("paths of no file of the forest are not found") {
    TileService service(forest(), kCache);
    for (const char* const target :
         {"/x", "/../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/0/0/0.json", "/1/2/0.glb",
          "/1/0/0.json", "/31/0/0.glb", "/4294967295/0/0.glb", "/models/",
          "/models/../tileset.json", "/tileset.json/", "/TILESET.JSON", "/0/0/0.glb\x01"}) {
        CAPTURE(target);
        CHECK(service.respond(get(target)).status == 404);
    }
    CHECK(service.respond(get("tileset.json")).status == 400);
    CHECK(service.respond(get("")).status == 400);
    CHECK(service.respond(get("http://127.0.0.1/tileset.json")).status == 400);
}

TEST_CASE("only GET, HEAD and OPTIONS are allowed") {
    TileService service(forest(), kCache);
    TileRequest request = get("/0/0/0.glb");
    const std::size_t size = service.respond(request).length;
    request.method = "HEAD";
    const TileResponse head = service.respond(request);
    CHECK(head.status == 200);
    CHECK(head.is_head);
    CHECK(head.length == size);
    request.method = "OPTIONS";
    const TileResponse options = service.respond(request);
    CHECK(options.status == 204);
    CHECK(field_of(options, "Access-Control-Allow-Methods") == "GET, HEAD, OPTIONS");
    for (const char* const method : {"POST", "PUT", "DELETE", "get", ""}) {
        request.method = method;
        const TileResponse refused = service.respond(request);
        CHECK(refused.status == 405);
        CHECK(field_of(refused, "Allow") == "GET, HEAD, OPTIONS");
    }
}

TEST_CASE("a client that has the file gets 304") {
    TileService service(forest(), kCache);
    TileRequest request = get("/0/0/0.glb");
    const std::string tag = field_of(service.respond(request), "ETag");
    REQUIRE(tag.size() == 18);
    const std::string list = "\"other\", W/" + tag;
    for (const std::string& value : {tag, "W/" + tag, list, std::string("*")}) {
        request.if_none_match = value;
        const TileResponse response = service.respond(request);
        CHECK(response.status == 304);
        CHECK(response.body == nullptr);
        CHECK(field_of(response, "ETag") == tag);
    }
    request.if_none_match = "\"other\"";
    CHECK(service.respond(request).status == 200);
    TileService other(forest(), kCache);
    CHECK(field_of(other.respond(get("/0/0/0.glb")), "ETag") == tag);
}

TEST_CASE("tiles are sent in gzip to clients that accept it") {
    TileService service(forest(), kCache);
    TileRequest request = get("/0/0/0.glb");
    const std::string plain = body_of(service.respond(request));
    const std::string tag = field_of(service.respond(request), "ETag");
    for (const char* const accept :
         {"gzip", "br, gzip;q=0.5", "deflate,gzip", "*", "*;q=0, gzip"}) {
        request.accept_encoding = accept;
        const TileResponse response = service.respond(request);
        CHECK(field_of(response, "Content-Encoding") == "gzip");
        CHECK(field_of(response, "Vary") == "Accept-Encoding");
        CHECK(field_of(response, "ETag") == tag.substr(0, 17) + "-gzip\"");
        CHECK(body_of(response).size() < plain.size());
        CHECK(unpacked(body_of(response)) == plain);
    }
    for (const char* const accept : {"br", "gzip;q=0", "gzip; q=0.000", "x-gzip", "*, gzip;q=0"}) {
        request.accept_encoding = accept;
        CHECK(body_of(service.respond(request)) == plain);
    }
}

TEST_CASE("ranges of bytes are sent") {
    TileService service(forest(), kCache);
    TileRequest request = get("/0/0/0.glb");
    request.accept_encoding = "gzip"; // ignored: the range is of the plain file
    const std::string whole = body_of(service.respond(get("/0/0/0.glb")));
    const std::string size = std::to_string(whole.size());
    const auto range = [&](const std::string& text) {
        request.range = text;
        return service.respond(request);
    };
    TileResponse part = range("bytes=4-7");
    CHECK(part.status == 206);
    CHECK(body_of(part) == whole.substr(4, 4));
    CHECK(field_of(part, "Content-Range") == "bytes 4-7/" + size);
    CHECK(body_of(range("bytes=-5")) == whole.substr(whole.size() - 5));
    CHECK(body_of(range("bytes=100-")) == whole.substr(100));
    CHECK(body_of(range("bytes=0-99999999999")) == whole);
    CHECK(body_of(range("bytes=-99999999999")) == whole);
    part = range("bytes=" + size + "-");
    CHECK(part.status == 416);
    CHECK(field_of(part, "Content-Range") == "bytes */" + size);
    CHECK(range("bytes=-0").status == 416);
    for (const char* const text : {"bytes=", "bytes=-", "bytes=7-4", "bytes=a-b", "bytes=0-1,3-4",
                                   "lines=1-2", "bytes=18446744073709551616-", "bytes=1"}) {
        CAPTURE(text);
        const TileResponse ignored = range(text);
        CHECK(ignored.status == 200);
        CHECK(ignored.length == whole.size());
    }
    request.if_range = "\"other\"";
    CHECK(range("bytes=4-7").status == 200);
    const std::string tag = field_of(service.respond(get("/0/0/0.glb")), "ETag");
    request.if_range = tag;
    CHECK(range("bytes=4-7").status == 206);
}

TEST_CASE("the cache keeps the files used last, within its limit") {
    const std::vector<TileId> tiles = forest().tiles(2);
    REQUIRE(tiles.size() > 8);
    std::uint64_t largest = 0;
    for (const TileId& tile : tiles) {
        largest = std::max<std::uint64_t>(largest, forest().content(tile).bytes.size());
    }
    TileService service(forest(), 3 * largest + 3000);
    const auto ask = [&](std::size_t i) {
        const std::uint64_t before = service.counts().made;
        CHECK(service.respond(get("/" + TileForest::content_path(tiles[i]))).status == 200);
        return service.counts().made > before;
    };
    CHECK(ask(0));
    CHECK(ask(1));
    CHECK_FALSE(ask(0));
    for (std::size_t i = 2; i < tiles.size(); ++i) {
        CHECK(ask(i));
        CHECK_FALSE(ask(0)); // still cached, because it is used in every round
    }
    CHECK(ask(1));
    const std::string metrics = body_of(service.respond(get("/metrics")));
    const std::size_t at = metrics.find("\nlsc_cache_bytes ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stoull(metrics.substr(at + 17)) <= 3 * largest + 3000);
    TileService without(forest(), 0);
    CHECK(without.respond(get("/0/0/0.glb")).status == 200);
    CHECK(without.respond(get("/0/0/0.glb")).status == 200);
    CHECK(without.counts().made == 2);
}

TEST_CASE("threads that ask for the same tiles get the same bytes, made once") {
    TileService service(forest(), kCache);
    std::vector<std::vector<std::string>> bodies(4);
    std::vector<std::thread> threads;
    for (std::vector<std::string>& mine : bodies) {
        threads.emplace_back([&service, &mine] {
            for (const TileId& tile : forest().tiles(2)) {
                const std::string path = "/" + TileForest::content_path(tile);
                mine.push_back(body_of(service.respond(get(path))));
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(service.counts().made == forest().tiles(2).size());
    CHECK(bodies[1] == bodies[0]);
    CHECK(bodies[2] == bodies[0]);
    CHECK(bodies[3] == bodies[0]);
}

TEST_CASE("the metrics count responses") {
    TileService service(forest(), kCache);
    static_cast<void>(service.respond(get("/0/0/0.glb")));
    static_cast<void>(service.respond(get("/0/0/0.glb")));
    static_cast<void>(service.respond(get("/none")));
    const TileResponse response = service.respond(get("/metrics"));
    CHECK(field_of(response, "Content-Type") == "text/plain; version=0.0.4; charset=utf-8");
    const std::string text = body_of(response);
    for (const char* const line :
         {"lsc_responses_total{code=\"2xx\"} 2\n", "lsc_responses_total{code=\"4xx\"} 1\n",
          "lsc_make_seconds_count 1\n", "lsc_make_seconds_bucket{le=\"+Inf\"} 1\n",
          "lsc_cache_hits_total 1\n", "lsc_cache_files 1\n", "lsc_connections 0\n"}) {
        CAPTURE(line);
        CHECK(text.find(line) != std::string::npos);
    }
}

} // namespace
} // namespace lsys
