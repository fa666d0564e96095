// SPDX-License-Identifier: MIT
// TileService: answers requests for the files of a tileset, which it makes on request. Implements
// HTTP (RFC 9110) without sockets; http_server.h connects it to a network. Reads no files.
#pragma once

#include "runtime/tiles/tiles.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lsys {

/// The parts of a request that the service uses. Fields of the header are empty if they are missing.
struct TileRequest {
    std::string_view method;
    std::string_view target; // as received
    std::string_view accept_encoding;
    std::string_view if_none_match;
    std::string_view range;
    std::string_view if_range;
};

struct TileResponse {
    unsigned status = 200;
    std::vector<std::pair<std::string_view, std::string>> fields; // of the header
    std::shared_ptr<const std::string> body;                      // null: none
    std::size_t first = 0;  // index of the first byte of `body` to send
    std::size_t length = 0; // number of bytes to send
    bool is_head = false;   // send the length of the body, but not the body
};

/// Counts of one TileService since it was made, for /metrics.
struct TileCounts {
    /// Upper bounds of the classes of `times`; the last class has none.
    static constexpr std::array<double, 8> kSeconds{0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0};

    std::array<std::atomic<std::uint64_t>, 6> responses{}; // by first digit of the status code
    std::atomic<std::uint64_t> bytes{0};                   // number of bytes of the bodies sent
    std::atomic<std::uint64_t> made{0};                    // tiles and tilesets made
    std::atomic<std::uint64_t> hits{0};                    // requests answered from the cache
    std::array<std::atomic<std::uint64_t>, kSeconds.size() + 1> times{}; // files by time to make
    std::atomic<std::uint64_t> microseconds{0};                          // spent on making files
    std::atomic<std::int64_t> connections{0};                            // open now
    std::atomic<std::uint64_t> refused_connections{0}; // too many, or no memory for them
};

class TileService {
public:
    /// `cache_bytes`: max memory in bytes of the tiles and tilesets kept for later requests.
    /// `forest` must outlive the service.
    TileService(const TileForest& forest, std::uint64_t cache_bytes);

    /// Answers any request. May be called from several threads; a file that two of them ask for is
    /// made once.
    [[nodiscard]] TileResponse respond(const TileRequest& request);
    [[nodiscard]] TileCounts& counts() { return counts_; }

private:
    /// A cached file, made by the first thread that requests it.
    struct Entry {
        std::mutex making;                         // held while the file is made or compressed
        std::shared_ptr<const std::string> body;   // null: not made yet
        std::shared_ptr<const std::string> packed; // by gzip; null: not asked for yet
        std::string tag;                           // entity tag of `body`
    };
    struct Cached {
        std::shared_ptr<Entry> entry;
        std::uint64_t bytes = 0;
        std::list<std::string>::iterator last_use; // place of its path in uses_
    };
    enum class FileKind : std::uint8_t { Content, Tileset, Subtree };
    /// A file that is made on request: the content, tileset or subtree of `tile`.
    struct MadeFile {
        TileId tile;
        FileKind kind = FileKind::Content;
    };
    /// A file in the form in which it is sent.
    struct EncodedFile {
        std::shared_ptr<const std::string> body;
        std::string tag;
        std::string_view type; // media type
        bool is_packed = false;
    };

    /// The response, before it is counted.
    [[nodiscard]] TileResponse answer(const TileRequest& request);
    /// Finds the file in the cache, or makes it. Returns false if the forest has no such file.
    [[nodiscard]] bool find_or_make(const std::string& path, bool wants_packed, EncodedFile& file);
    /// The file that `path` names; nullopt if the forest does not have it.
    [[nodiscard]] std::optional<MadeFile> made_file(std::string_view path) const;
    [[nodiscard]] std::string make(const MadeFile& file) const;
    /// The entry of the cache for a path; a new one if there is none.
    [[nodiscard]] std::shared_ptr<Entry> find_or_add_entry(const std::string& path);
    /// Sets the size of an entry; drops entries used least recently while the cache is too large.
    void keep(const std::string& path, const std::shared_ptr<Entry>& entry, std::uint64_t bytes);
    void forget(const std::string& path);      // drops it from the cache
    [[nodiscard]] std::string metrics() const; // the text of /metrics

    const TileForest& forest_;
    std::uint64_t cache_bytes_; // max sum of the sizes of cached files
    TileCounts counts_;
    std::unordered_map<std::string, std::shared_ptr<Entry>>
        shared_;                                    // files that tiles share, and the page
    mutable std::mutex mutex_;                      // guards the members below
    std::unordered_map<std::string, Cached> cache_; // by path
    std::list<std::string> uses_;  // paths of the files in cache_, the most recently used first
    std::uint64_t used_bytes_ = 0; // sum of the sizes of cached files
};

/// Sets `tile` to the tile that `path` names, such as "3/5/2.glb" with the extension ".glb".
/// Returns false for any other path, also for another spelling of the numbers: "03/5/2.glb".
[[nodiscard]] bool parse_tile_path(std::string_view path, std::string_view extension, TileId& tile);

} // namespace lsys
