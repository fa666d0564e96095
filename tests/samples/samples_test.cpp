// SPDX-License-Identifier: MIT
// The facts in the header of each sample of the gallery: command lines, counts, layout.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace {

using lsys::tests::all_samples;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::Sample;

} // namespace

TEST_CASE("lsc check reports nothing about the samples") {
    const std::vector<Sample> samples = all_samples();
    REQUIRE(samples.size() > 40);
    for (const Sample& sample : samples) {
        INFO(sample.file);
        const LscRun run = run_lsc({"check", sample.file.string()}, "");
        CHECK(run.status == 0);
        CHECK(run.err.find(": error: ") == std::string::npos);
        const bool has_warnings = run.err.find(": warning: ") != std::string::npos;
        CHECK(has_warnings == sample.declares_warnings);
    }
}

TEST_CASE("the command lines of samples succeed") {
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        CHECK(!sample.runs.empty());
        for (const std::vector<std::string>& arguments : sample.runs) {
            const LscRun run = run_lsc(arguments, "");
            INFO(run.err);
            CHECK(run.status == 0);
            CHECK(!run.out.empty());
        }
    }
}

TEST_CASE("samples have the stated numbers of modules") {
    std::size_t counted = 0;
    for (const Sample& sample : all_samples()) {
        if (sample.counts_size == 0) {
            continue;
        }
        ++counted;
        INFO(sample.file);
        const LscRun run = run_lsc({"dump", sample.file.string(), "--all", "--count", "-n",
                                    std::to_string(sample.counts_size - 1)},
                                   "");
        CHECK(run.status == 0);
        CHECK(run.out == sample.counts);
    }
    CHECK(counted > 40);
}

TEST_CASE("samples in the dialect of their source derive the same words") {
    std::size_t tried = 0;
    for (const Sample& sample : all_samples()) {
        for (const auto& entry : std::filesystem::directory_iterator(sample.file.parent_path())) {
            const std::string path = entry.path().string();
            const std::string extension = entry.path().extension().string();
            if (extension != ".rules" && extension != ".sys" && extension != ".l" &&
                extension != ".l++") {
                continue;
            }
            INFO(path);
            ++tried;
            const LscRun check = run_lsc({"check", path}, "");
            CHECK(check.status == 0);
            // A .sys file does not give the number of generations, and files of L3D may have a note
            // about the order of their rules.
            const bool may_note = extension == ".sys" || extension == ".l" || extension == ".l++";
            CHECK((check.err.empty() || may_note));
            CHECK(check.err.find("error") == std::string::npos);
            for (const char* const generations : {"2", "7"}) {
                const std::vector<std::string> rest{"-n", generations, "--seed", "5"};
                std::vector<std::string> one{"dump", path};
                std::vector<std::string> other{"dump", sample.file.string()};
                one.insert(one.end(), rest.begin(), rest.end());
                other.insert(other.end(), rest.begin(), rest.end());
                const LscRun ours = run_lsc(one, "");
                CHECK(ours.status == 0);
                CHECK(ours.out.size() > 10);
                CHECK(ours.out == run_lsc(other, "").out);
            }
        }
    }
    CHECK(tried == 9);
}

TEST_CASE("samples and their included files have the layout of lsc fmt") {
    std::vector<std::string> command{"fmt", "--check"};
    for (const Sample& sample : all_samples()) {
        for (const auto& entry : std::filesystem::directory_iterator(sample.file.parent_path())) {
            if (entry.path().extension() == ".lsys") {
                command.push_back(entry.path().string());
            }
        }
    }
    REQUIRE(command.size() > 60);
    const LscRun run = run_lsc(command, "");
    CHECK(run.err == "");
    CHECK(run.status == 0);
}
