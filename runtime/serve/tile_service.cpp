// SPDX-License-Identifier: MIT
#include "runtime/serve/tile_service.h"

#include "grammar/base/blanks.h"
#include "grammar/base/hash.h"
#include "runtime/serve/impl/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <new>
#include <optional>
#include <zlib.h>

namespace lsys {

namespace {

constexpr std::uint64_t kTagHash = 0x74696C65746167; // initial state of the hash
constexpr std::uint64_t kEntryBytes = 256;           // memory of an entry besides its file
constexpr std::size_t kMinPackedBytes = 256;         // bytes; shorter bodies are not compressed

/// Compresses by gzip (RFC 1952); yields the same bytes on every machine with the same zlib.
std::string pack(std::string_view bytes) {
    constexpr int kLevel = 6;
    constexpr int kGzip = 15 + 16; // largest window, gzip header
    z_stream stream{};
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();
    }
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string packed;
    int state = Z_OK;
    while (state == Z_OK) {
        constexpr std::size_t kPiece = 65'536;
        const std::size_t before = packed.size();
        packed.resize(before + kPiece);
        stream.next_out = reinterpret_cast<Bytef*>(packed.data() + before);
        stream.avail_out = static_cast<uInt>(kPiece);
        state = deflate(&stream, Z_FINISH);
        packed.resize(before + kPiece - stream.avail_out);
    }
    deflateEnd(&stream);
    packed.shrink_to_fit();
    return packed;
}

/// The items of a comma-separated header field, without blanks around them.
std::vector<std::string_view> items_of(std::string_view list) {
    std::vector<std::string_view> items;
    while (!list.empty()) {
        const std::size_t comma = list.find(',');
        items.push_back(without_blanks(list.substr(0, comma)));
        list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
    }
    return items;
}

/// Whether the field Accept-Encoding allows gzip; `*` stands for all codings that the field does
/// not name (RFC 9110, 12.5.3).
bool accepts_gzip(std::string_view accept_encoding) {
    bool others = false;
    for (const std::string_view item : items_of(accept_encoding)) {
        const std::size_t semicolon = item.find(';');
        const std::string_view coding = without_blanks(item.substr(0, semicolon));
        const std::string_view weight = semicolon == std::string_view::npos
                                            ? "q=1"
                                            : without_blanks(item.substr(semicolon + 1));
        const bool is_allowed = !weight.starts_with("q=0") ||
                                weight.find_first_not_of("0.", 2) != std::string_view::npos;
        if (coding == "gzip") {
            return is_allowed;
        }
        others = coding == "*" ? is_allowed : others;
    }
    return others;
}

/// Whether the field If-None-Match contains the tag, compared weakly (RFC 9110, 8.8.3.2).
bool has_tag(std::string_view if_none_match, std::string_view tag) {
    for (std::string_view item : items_of(if_none_match)) {
        if (item.starts_with("W/")) {
            item.remove_prefix(2);
        }
        if (item == "*" || item == tag) {
            return true;
        }
    }
    return false;
}

enum class RangeKind : std::uint8_t { Whole, Part, Unsatisfiable };

/// Reads a range of bytes (RFC 9110, 14.1.2). Several ranges, other units and mistakes are ignored.
RangeKind parse_range(std::string_view range, std::size_t size, TileResponse& response) {
    constexpr std::string_view kUnit = "bytes=";
    if (!range.starts_with(kUnit)) {
        return RangeKind::Whole;
    }
    range.remove_prefix(kUnit.size());
    const auto parse = [](std::string_view digits) -> std::optional<std::uint64_t> {
        std::uint64_t value = 0;
        const char* const end = digits.data() + digits.size();
        const auto [at, error] = std::from_chars(digits.data(), end, value);
        return error == std::errc() && at == end ? std::optional(value) : std::nullopt;
    };
    const std::size_t dash = range.find('-');
    if (dash == std::string_view::npos) {
        return RangeKind::Whole;
    }
    const std::optional<std::uint64_t> first = parse(range.substr(0, dash));
    const std::optional<std::uint64_t> last = parse(range.substr(dash + 1));
    const bool has_first = dash != 0;
    const bool has_last = dash + 1 != range.size();
    if ((has_first && !first) || (has_last && !last) || (!has_first && !has_last) ||
        (first && last && *last < *first)) {
        return RangeKind::Whole;
    }
    if (has_first ? *first >= size : *last == 0 || size == 0) {
        return RangeKind::Unsatisfiable;
    }
    const std::uint64_t begin = has_first ? *first : size - std::min<std::uint64_t>(*last, size);
    const std::uint64_t end =
        has_first && has_last ? std::min<std::uint64_t>(*last, size - 1) + 1 : size;
    response.first = begin;
    response.length = end - begin;
    return RangeKind::Part;
}

std::string_view type_of(std::string_view path) {
    const auto ends = [path](std::string_view end) { return path.ends_with(end); };
    return ends(".json")   ? "application/json"
           : ends(".glb")  ? "model/gltf-binary"
           : ends(".png")  ? "image/png"
           : ends(".html") ? "text/html; charset=utf-8"
                           : "application/octet-stream";
}

std::string entity_tag(std::string_view bytes) {
    return fmt::format("\"{:016x}\"", mix64(combine_bytes(kTagHash, bytes)));
}

TileResponse text_response(unsigned status, std::string text) {
    TileResponse response;
    response.status = status;
    response.fields.emplace_back("Content-Type", "text/plain; charset=utf-8");
    response.fields.emplace_back("Cache-Control", "no-store");
    response.body = std::make_shared<const std::string>(std::move(text));
    response.length = response.body->size();
    return response;
}

} // namespace

bool parse_tile_path(std::string_view path, std::string_view extension, TileId& tile) {
    if (!path.ends_with(extension)) {
        return false;
    }
    path.remove_suffix(extension.size());
    for (std::uint32_t* const number : {&tile.level, &tile.column, &tile.row}) {
        const char* const end = path.data() + path.size();
        const auto [at, error] = std::from_chars(path.data(), end, *number);
        const auto length = static_cast<std::size_t>(at - path.data());
        if (error != std::errc() || (path.front() == '0' && length > 1)) {
            return false;
        }
        path.remove_prefix(length);
        const bool is_last = number == &tile.row;
        if (is_last ? !path.empty() : !path.starts_with('/')) {
            return false;
        }
        path.remove_prefix(is_last ? 0 : 1);
    }
    return true;
}

TileService::TileService(const TileForest& forest, std::uint64_t cache_bytes)
    : forest_(forest), cache_bytes_(cache_bytes) {
    const auto add = [this](const std::string& path, std::string bytes) {
        auto entry = std::make_shared<Entry>();
        entry->tag = entity_tag(bytes);
        entry->body = std::make_shared<const std::string>(std::move(bytes));
        shared_[path] = std::move(entry);
    };
    for (const TileFile& file : forest.files()) {
        add(file.path, file.bytes);
    }
    add("index.html", tile_page());
}

TileResponse TileService::respond(const TileRequest& request) {
    TileResponse response;
    try {
        response = answer(request);
    } catch (const std::bad_alloc&) {
        response = text_response(503, "out of memory\n");
        response.fields.emplace_back("Retry-After", "10");
    }
    response.is_head = request.method == "HEAD";
    response.fields.emplace_back("Access-Control-Allow-Origin", "*");
    ++counts_.responses[std::min(response.status / 100, 5U)];
    counts_.bytes += response.is_head ? 0 : response.length;
    return response;
}

TileResponse TileService::answer(const TileRequest& request) {
    if (request.method == "OPTIONS") { // a CORS preflight, sent for pages of other sites
        TileResponse response;
        response.status = 204;
        response.fields.emplace_back("Access-Control-Allow-Methods", "GET, HEAD, OPTIONS");
        response.fields.emplace_back("Access-Control-Allow-Headers",
                                     "Range, If-None-Match, If-Range");
        response.fields.emplace_back("Access-Control-Max-Age", "86400");
        return response;
    }
    if (request.method != "GET" && request.method != "HEAD") {
        TileResponse response = text_response(405, "only GET, HEAD and OPTIONS\n");
        response.fields.emplace_back("Allow", "GET, HEAD, OPTIONS");
        return response;
    }
    std::string_view target = request.target.substr(0, request.target.find_first_of("?#"));
    if (!target.starts_with('/')) {
        return text_response(400, "the target of a request begins with /\n");
    }
    // 3DTilesRendererJS asks for //4/9/9.json if the tileset is at the root of a server.
    target.remove_prefix(std::min(target.find_first_not_of('/'), target.size()));
    if (target == "health") {
        return text_response(200, "ok\n");
    }
    if (target == "metrics") {
        TileResponse response = text_response(200, metrics());
        response.fields.front().second = "text/plain; version=0.0.4; charset=utf-8";
        return response;
    }
    const std::string path = target.empty() ? "index.html" : std::string(target);
    const bool wants_part = !request.range.empty() && request.method == "GET";
    EncodedFile file;
    if (!find_or_make(path, !wants_part && accepts_gzip(request.accept_encoding), file)) {
        return text_response(404, "no such file\n");
    }
    TileResponse response;
    response.fields.emplace_back("ETag", file.tag);
    response.fields.emplace_back("Cache-Control", "public, max-age=300");
    response.fields.emplace_back("Vary", "Accept-Encoding");
    if (has_tag(request.if_none_match, file.tag)) {
        response.status = 304;
        return response;
    }
    response.fields.emplace_back("Content-Type", file.type);
    response.fields.emplace_back("Accept-Ranges", "bytes");
    if (file.is_packed) {
        response.fields.emplace_back("Content-Encoding", "gzip");
    }
    response.body = file.body;
    response.length = file.body->size();
    if (wants_part && (request.if_range.empty() || request.if_range == file.tag)) {
        switch (parse_range(request.range, file.body->size(), response)) {
        case RangeKind::Whole:
            break;
        case RangeKind::Part:
            response.status = 206;
            response.fields.emplace_back("Content-Range",
                                         fmt::format("bytes {}-{}/{}", response.first,
                                                     response.first + response.length - 1,
                                                     file.body->size()));
            break;
        case RangeKind::Unsatisfiable:
            response = text_response(416, "the file is shorter\n");
            response.fields.emplace_back("Content-Range",
                                         fmt::format("bytes */{}", file.body->size()));
            break;
        }
    }
    return response;
}

/// Finds or makes the file at `path`; returns false if the forest has no such file.
bool TileService::find_or_make(const std::string& path, bool wants_packed, EncodedFile& file) {
    std::shared_ptr<Entry> entry;
    std::optional<MadeFile> made; // none: a shared file
    const auto shared = shared_.find(path);
    if (shared != shared_.end()) {
        entry = shared->second;
    } else {
        made = made_file(path);
        if (!made) {
            return false;
        }
        entry = find_or_add_entry(path);
    }
    const std::lock_guard<std::mutex> making(entry->making);
    try {
        if (entry->body == nullptr) {
            const auto start = std::chrono::steady_clock::now();
            std::string bytes = make(*made);
            entry->tag = entity_tag(bytes);
            entry->body = std::make_shared<const std::string>(std::move(bytes));
            const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
            const auto slot = std::lower_bound(TileCounts::kSeconds.begin(),
                                               TileCounts::kSeconds.end(), spent.count());
            ++counts_.times[static_cast<std::size_t>(slot - TileCounts::kSeconds.begin())];
            counts_.microseconds += static_cast<std::uint64_t>(1e6 * spent.count());
            ++counts_.made;
        } else if (made) {
            ++counts_.hits;
        }
        file.type = type_of(path);
        // Files of meshes and pictures are compressed already.
        file.is_packed = wants_packed && entry->body->size() >= kMinPackedBytes &&
                         file.type != "image/png" && file.type != "application/octet-stream";
        if (file.is_packed && entry->packed == nullptr) {
            entry->packed = std::make_shared<const std::string>(pack(*entry->body));
        }
    } catch (const std::bad_alloc&) {
        forget(path);
        throw;
    }
    file.body = file.is_packed ? entry->packed : entry->body;
    file.tag = entry->tag;
    if (file.is_packed) {
        file.tag.insert(file.tag.size() - 1, "-gzip");
    }
    if (made) {
        keep(path, entry,
             entry->body->size() + (entry->packed ? entry->packed->size() : 0) + kEntryBytes +
                 2 * path.size());
    }
    return true;
}

/// The tile, tileset or subtree that `path` names, if the forest has it.
std::optional<TileService::MadeFile> TileService::made_file(std::string_view path) const {
    TileId tile;
    if (path == TileForest::tileset_path(tile)) {
        return MadeFile{tile, FileKind::Tileset};
    }
    if (parse_tile_path(path, ".glb", tile) && forest_.has_tile(tile) &&
        forest_.levels()[tile.level].has_content) {
        return MadeFile{tile, FileKind::Content};
    }
    if (parse_tile_path(path, ".subtree", tile) && forest_.has_tile(tile) &&
        forest_.has_subtree(tile.level)) {
        return MadeFile{tile, FileKind::Subtree};
    }
    // The tileset of the root has a different path.
    if (parse_tile_path(path, ".json", tile) && tile.level != 0 && forest_.has_tile(tile) &&
        forest_.has_tileset(tile.level)) {
        return MadeFile{tile, FileKind::Tileset};
    }
    return std::nullopt;
}

std::string TileService::make(const MadeFile& file) const {
    switch (file.kind) {
    case FileKind::Tileset:
        return forest_.tileset(file.tile);
    case FileKind::Subtree:
        return forest_.subtree(file.tile);
    case FileKind::Content:
        break;
    }
    return forest_.content(file.tile).bytes;
}

/// The entry of the cache for a path, moved to the front; a new one if there is none.
std::shared_ptr<TileService::Entry> TileService::find_or_add_entry(const std::string& path) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = cache_.find(path);
    if (found != cache_.end()) {
        uses_.splice(uses_.begin(), uses_, found->second.last_use);
        return found->second.entry;
    }
    uses_.push_front(path);
    auto entry = std::make_shared<Entry>();
    cache_[path] = {entry, 0, uses_.begin()};
    return entry;
}

/// Stores the size of an entry; while the cache is too large, drops its least recently used entry.
void TileService::keep(const std::string& path,
                       const std::shared_ptr<Entry>& entry,
                       std::uint64_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = cache_.find(path);
    if (found == cache_.end() || found->second.entry != entry) {
        return; // another thread has dropped the entry in the meantime
    }
    used_bytes_ += bytes - found->second.bytes;
    found->second.bytes = bytes;
    while (used_bytes_ > cache_bytes_ && !uses_.empty()) {
        const auto last = cache_.find(uses_.back());
        used_bytes_ -= last->second.bytes;
        cache_.erase(last);
        uses_.pop_back();
    }
}

void TileService::forget(const std::string& path) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = cache_.find(path);
    if (found != cache_.end()) {
        used_bytes_ -= found->second.bytes;
        uses_.erase(found->second.last_use);
        cache_.erase(found);
    }
}

/// The text format of Prometheus, version 0.0.4.
std::string TileService::metrics() const {
    std::string text;
    const auto add = [&text](std::string_view name, std::string_view kind, std::string_view help) {
        text += fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name, kind, help);
    };
    add("lsc_responses_total", "counter", "Responses by class of status.");
    for (std::size_t i = 2; i < counts_.responses.size(); ++i) {
        text += fmt::format("lsc_responses_total{{code=\"{}xx\"}} {}\n", i,
                            counts_.responses[i].load());
    }
    add("lsc_response_bytes_total", "counter", "Bytes of bodies.");
    text += fmt::format("lsc_response_bytes_total {}\n", counts_.bytes.load());
    add("lsc_make_seconds", "histogram", "Time to make a tile or a tileset.");
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < TileCounts::kSeconds.size(); ++i) {
        sum += counts_.times[i].load();
        text +=
            fmt::format("lsc_make_seconds_bucket{{le=\"{}\"}} {}\n", TileCounts::kSeconds[i], sum);
    }
    const std::uint64_t made = counts_.made.load();
    text += fmt::format("lsc_make_seconds_bucket{{le=\"+Inf\"}} {0}\nlsc_make_seconds_sum {1}\n"
                        "lsc_make_seconds_count {0}\n",
                        made, static_cast<double>(counts_.microseconds.load()) * 1e-6);
    add("lsc_cache_hits_total", "counter", "Files answered from the cache.");
    text += fmt::format("lsc_cache_hits_total {}\n", counts_.hits.load());
    std::uint64_t entries = 0;
    std::uint64_t used = 0;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        entries = cache_.size();
        used = used_bytes_;
    }
    add("lsc_cache_files", "gauge", "Files in the cache.");
    text += fmt::format("lsc_cache_files {}\n", entries);
    add("lsc_cache_bytes", "gauge", "Memory of the cache.");
    text += fmt::format("lsc_cache_bytes {}\n", used);
    add("lsc_connections", "gauge", "Open connections.");
    text += fmt::format("lsc_connections {}\n", counts_.connections.load());
    add("lsc_refused_connections_total", "counter", "Connections beyond the limit.");
    text += fmt::format("lsc_refused_connections_total {}\n", counts_.refused_connections.load());
    return text;
}

} // namespace lsys
