// SPDX-License-Identifier: MIT
// System calls for files, which have the same results on all systems.
#include "runtime/platform/file.h"
#include "runtime/platform/process.h"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

using namespace lsys::platform;

namespace {

/// A folder that the destructor removes.
class FilesFolder {
public:
    FilesFolder() {
        static std::atomic<int> number{0};
        path_ = std::filesystem::temp_directory_path() /
                ("lsys-platform-" + std::to_string(process_id()) + "-" + std::to_string(++number));
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    FilesFolder(const FilesFolder&) = delete;
    FilesFolder& operator=(const FilesFolder&) = delete;
    ~FilesFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::string operator/(const char* name) const { return (path_ / name).string(); }
    [[nodiscard]] std::string text() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

void put_file(const std::string& path, std::string_view text) {
    File file;
    REQUIRE(create_file(path, false, file) == 0);
    CHECK(write_some(file, text.data(), text.size()).count == text.size());
    CHECK(file.close() == 0);
}

std::string get_file(const std::string& path) {
    File file;
    REQUIRE(open_to_read(path, true, file) == 0);
    std::array<char, 64> bytes{};
    const ByteCount read = read_some(file, bytes.data(), bytes.size());
    CHECK(read.reason == 0);
    return {bytes.data(), read.count};
}

} // namespace

TEST_CASE("a file is made once") {
    const FilesFolder folder;
    put_file(folder / "x", "one\r\ntwo\n");
    CHECK(get_file(folder / "x") == "one\r\ntwo\n");
    File file;
    CHECK(create_file(folder / "x", true, file) == EEXIST);
    CHECK(!file.is_open());
    CHECK(create_file(folder / "none/x", false, file) == ENOENT);
    CHECK(open_to_read(folder / "none", true, file) == ENOENT);
}

TEST_CASE("a moved file is open in one place") {
    const FilesFolder folder;
    File first;
    REQUIRE(create_file(folder / "x", false, first) == 0);
    File second(std::move(first));
    CHECK(second.is_open());
    first = std::move(second);
    CHECK(first.is_open());
    CHECK(write_some(first, "text", 4).count == 4);
    CHECK(first.close() == 0);
    CHECK(!first.is_open());
    CHECK(get_file(folder / "x") == "text");
}

TEST_CASE("a name gives the type, size and permissions of its file") {
    const FilesFolder folder;
    put_file(folder / "x", "four");
    CHECK(facts_of(folder / "x").type == FileType::Regular);
    CHECK(facts_of(folder / "x").size == 4);
    CHECK(facts_of(folder.text()).type == FileType::Directory);
    CHECK(facts_of(folder / "none").type == FileType::Missing);
    CHECK(link_facts_of(folder / "x").type == FileType::Regular);
    CHECK(link_facts_of(folder / "none").type == FileType::Missing);
    File file;
    REQUIRE(open_to_read(folder / "x", false, file) == 0);
    FileFacts facts;
    REQUIRE(facts_of(file, facts) == 0);
    CHECK(facts.type == FileType::Regular);
    CHECK(facts.size == 4);
    CHECK(check_writable(folder / "x") == 0);
    CHECK(check_writable(folder / "none") == ENOENT);
    std::string real;
    CHECK(resolve_links(folder / "none", real) == ENOENT);
    REQUIRE(resolve_links(folder / "x", real) == 0);
    CHECK(std::filesystem::equivalent(real, folder / "x"));
}

TEST_CASE("files are renamed, replaced and exchanged") {
    const FilesFolder folder;
    put_file(folder / "a", "a");
    put_file(folder / "b", "b");
    const Reason refused = rename_to_new(folder / "a", folder / "b");
    CHECK((refused == EEXIST || refused == EINVAL || refused == ENOSYS));
    CHECK(get_file(folder / "b") == "b");
    const Reason exchanged = exchange_files(folder / "a", folder / "b");
    if (exchanged == 0) {
        CHECK(get_file(folder / "a") == "b");
        CHECK(get_file(folder / "b") == "a");
    } else {
        CHECK((exchanged == EINVAL || exchanged == ENOSYS));
        CHECK(get_file(folder / "a") == "a");
    }
    const std::string text = get_file(folder / "a");
    CHECK(rename_file(folder / "a", folder / "b") == 0);
    CHECK(get_file(folder / "b") == text);
    CHECK(facts_of(folder / "a").type == FileType::Missing);
    CHECK(exchange_files(folder / "a", folder / "b") != 0);
    CHECK(get_file(folder / "b") == text);
    std::filesystem::create_directory(folder / "c");
    CHECK(rename_file(folder / "b", folder / "c") == EISDIR);
    remove_file((folder / "b").c_str());
    CHECK(facts_of(folder / "b").type == FileType::Missing);
    remove_file((folder / "b").c_str()); // no effect
}

TEST_CASE("a stamp changes with the contents") {
    const FilesFolder folder;
    CHECK(!stamp_of(folder / "x").exists);
    put_file(folder / "x", "one");
    const FileStamp first = stamp_of(folder / "x");
    CHECK(first.exists);
    CHECK(first.size == 3);
    CHECK(stamp_of(folder / "x") == first);
    put_file(folder / "y", "four");
    CHECK(rename_file(folder / "y", folder / "x") == 0);
    CHECK(stamp_of(folder / "x") != first);
}

TEST_CASE("random bits differ") {
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 1000; ++i) {
        seen.insert(random_bits());
    }
    CHECK(seen.size() == 1000);
}
