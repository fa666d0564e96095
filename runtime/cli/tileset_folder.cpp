// SPDX-License-Identifier: MIT
#include "runtime/cli/tileset_folder.h"

#include "grammar/base/counted_text.h"
#include "grammar/base/paths.h"
#include "runtime/base/size_text.h"
#include "runtime/cli/tileset_record.h"
#include "runtime/platform/file.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

namespace lsys::lsc {

namespace fs = std::filesystem;

namespace {

/// Number of files that are flushed to the disk together: many, so that flushing takes less time
/// than making them. Each file stays open until it has its name.
std::size_t files_stored_at_once() {
    constexpr std::size_t kMostFiles = 128;
    return std::clamp<std::size_t>(platform::max_open_files() / 4, 1, kMostFiles);
}

} // namespace

NextFile files_of_part(const TilePart& part, std::uint64_t end) {
    const auto taken = std::make_shared<std::atomic<std::uint64_t>>(0);
    return [taken, part, end]() -> std::optional<std::uint64_t> {
        const std::uint64_t number = part.index - 1 + part.count * taken->fetch_add(1);
        return number < end ? std::optional(number) : std::nullopt;
    };
}

Result<void> check_tileset_folder(const TilesCommand& command) {
    const std::string& folder = command.output;
    const bool may_have_files = command.force || command.resume || command.part.count != 1;
    std::error_code error;
    const fs::file_status status = fs::status(path_of(folder), error);
    if (fs::exists(status) && !fs::is_directory(status)) {
        return Error{fmt::format("`{}` is a file; a tileset is a folder", folder)};
    }
    if (!may_have_files && fs::is_directory(status) &&
        fs::directory_iterator(path_of(folder), error) != fs::directory_iterator()) {
        return Error{fmt::format("`{}` has files already; --force writes there too, --resume adds "
                                 "the files that are missing",
                                 folder)};
    }
    return {};
}

std::string tileset_stats(const TileForest& forest, const TileTotals& totals, bool is_whole) {
    std::string text = "level     side m    tiles   error m  a tile shows\n";
    const std::vector<TileLevel>& levels = forest.levels();
    for (std::uint32_t i = 0; i < levels.size(); ++i) {
        const TileLevel& level = levels[i];
        text += fmt::format("{:>5} {:>10.1f} {:>8} {:>9.3f}  {}\n", i, level.side,
                            forest.extent(i).count(), level.error,
                            !level.has_content ? std::string("nothing")
                            : level.has_trees  ? fmt::format("{:.0f} trees of {} triangles",
                                                             level.trees, level.triangles)
                                               : std::string("ground and crowns as one surface"));
    }
    text +=
        fmt::format("{} written, {}", counted(totals.files, "file"), byte_size_text(totals.bytes));
    if (is_whole && totals.trees != 0) {
        text += fmt::format("; {}, {:.0f} bytes a tree", counted(totals.trees, "tree"),
                            static_cast<double>(totals.bytes) / static_cast<double>(totals.trees));
    }
    return text + "\n";
}

TilesetFolder::TilesetFolder(const TilesCommand& command,
                             const TileForest& forest,
                             const Console& console)
    : command_(command), forest_(forest), console_(console) {
    sections_.push_back({Kind::Shared, 0, 0, forest.files().size()});
    const auto levels = static_cast<std::uint32_t>(forest.levels().size());
    for (std::uint32_t level = 0; level < levels; ++level) {
        if (forest_.levels()[level].has_content) {
            add_section(Kind::Content, level);
        }
    }
    for (std::uint32_t level = levels; level-- > 0;) {
        if (forest_.has_subtree(level)) {
            add_section(Kind::Subtree, level);
        }
        if (forest_.has_tileset(level)) {
            add_section(Kind::Tileset, level);
        }
    }
}

void TilesetFolder::add_section(Kind kind, std::uint32_t level) {
    const TileExtent tiles = forest_.extent(level);
    sections_.push_back({kind, level, tiles.columns, count() + tiles.count()});
}

void TilesetFolder::make(std::uint64_t digest) {
    make_folder("");
    if (is_stopped_) {
        return;
    }
    const bool keeps = command_.resume || !command_.force;
    const TilesetRecord record = find_tileset_record(command_.output, digest);
    if (record == TilesetRecord::Same) {
        return;
    }
    if (record == TilesetRecord::NoTiles) {
        const Result<TilesetRecord> begun = begin_tileset_record(command_.output, digest, console_);
        if (!begun) {
            stop(begun.error());
        } else if (begun.value() != TilesetRecord::Same) {
            // Another run writes other tiles now: not even --force may mix the two.
            stop(other_tiles_error(command_.output, begun.value()));
        }
    } else if (keeps) {
        stop(other_tiles_error(command_.output, record));
    } else {
        // Until all tiles are replaced, no later run may keep them.
        take(remove_tileset_record(command_.output));
        if (command_.part.count == 1) {
            late_digest_ = digest;
        }
    }
}

void TilesetFolder::write(std::uint64_t number) {
    if (number == root()) {
        name_files(); // before the root, which shows that the tileset is complete
        write_numbered(number);
        name_files();
        if (late_digest_ && !is_stopped()) {
            take(write_tileset_record(command_.output, *late_digest_, console_));
        }
    } else {
        write_numbered(number);
    }
}

void TilesetFolder::write_numbered(std::uint64_t number) {
    const auto section = std::find_if(sections_.begin(), sections_.end(),
                                      [number](const Section& each) { return number < each.end; });
    const std::uint64_t index =
        section == sections_.begin() ? number : number - std::prev(section)->end;
    if (section->kind == Kind::Shared) {
        const TileFile& file = forest_.files()[index];
        write_file_at(file.path, [&] { return file.bytes; });
        return;
    }
    const TileId tile{section->level, static_cast<std::uint32_t>(index % section->columns),
                      static_cast<std::uint32_t>(index / section->columns)};
    if (section->kind == Kind::Tileset) {
        write_file_at(TileForest::tileset_path(tile), [&] { return forest_.tileset(tile); });
        return;
    }
    if (section->kind == Kind::Subtree) {
        write_file_at(TileForest::subtree_path(tile), [&] { return forest_.subtree(tile); });
        return;
    }
    write_file_at(TileForest::content_path(tile), [&] {
        TileContent content = forest_.content(tile);
        trees_ += tile.level + 1 == forest_.levels().size() ? content.trees : 0;
        return std::move(content.bytes);
    });
}

void TilesetFolder::write_from(const NextFile& next) {
    while (!is_stopped()) {
        const std::optional<std::uint64_t> number = next();
        if (!number) {
            break;
        }
        write(*number);
    }
    name_files();
}

template <typename Make>
void TilesetFolder::write_file_at(const std::string& path, const Make& make) {
    const std::string whole = command_.output + "/" + path;
    std::error_code error;
    if (command_.resume && fs::exists(path_of(whole), error)) {
        return; // files get their names when they are complete
    }
    make_folder(folder_of_path(path));
    const std::string bytes = make();
    if (is_stopped_) {
        return;
    }
    Result<Output> output = Output::open_one_of_many(whole, console_);
    Result<void> written = output ? output.value().write(bytes) : Result<void>(output.error());
    if (written) {
        written = output.value().finish(Storing::BySystem);
    }
    if (!written) {
        stop(written.error());
        return;
    }
    bytes_ += bytes.size();
    ++files_;
    std::size_t count = 0;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        outputs_.push_back(std::move(output.value()));
        count = outputs_.size();
    }
    if (count >= files_stored_at_once()) {
        name_files();
    }
}

void TilesetFolder::name_files() {
    std::vector<Output> outputs;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        outputs.swap(outputs_);
    }
    if (outputs.empty()) {
        return;
    }
    // After a power failure a name must not stand for a file whose bytes were never stored.
    platform::store_file_system(command_.output);
    for (Output& output : outputs) {
        take(output.commit());
    }
}

void TilesetFolder::make_folder(std::string_view path) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!folders_.insert(std::string(path)).second) {
        return;
    }
    const std::string whole = command_.output + (path.empty() ? "" : "/") + std::string(path);
    std::error_code error;
    fs::create_directories(path_of(whole), error);
    if (error && result_) {
        result_ = Error{fmt::format("cannot make the folder `{}`: {}", whole, error.message())};
        is_stopped_ = true;
    }
}

void TilesetFolder::take(const Result<void>& done) {
    if (!done) {
        stop(done.error());
    }
}

void TilesetFolder::stop(const Error& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    result_ = result_ ? Result<void>(error) : result_;
    is_stopped_ = true;
}

Result<void> TilesetFolder::result() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return result_;
}

} // namespace lsys::lsc
