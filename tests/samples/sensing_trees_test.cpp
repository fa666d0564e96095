// SPDX-License-Identifier: MIT
// Facts of the samples whose trees sense: sums of sweeps, used space, and the pipe model.
#include "runtime/pipeline/plant.h"
#include "runtime/program/host.h"
#include "runtime/turtle/skeleton.h"
#include "tests/support/lsc_run.h"
#include "tests/support/sample_plants.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace lsys;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;

std::string path_of(const std::string& name) {
    return std::string(LSYS_SOURCE_DIR) + "/samples/" + name + "/" + name + ".lsys";
}

std::string dumped(const std::string& name, const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments{"dump", path_of(name)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const LscRun run = run_lsc(arguments, "");
    INFO(run.err);
    REQUIRE(run.status == 0);
    return run.out;
}

/// The numbers in the brackets that follow each `opening` in `text`, separated by commas.
std::vector<std::vector<double>> numbers_after(const std::string& text, std::string_view opening) {
    std::vector<std::vector<double>> all;
    for (std::size_t at = text.find(opening); at != std::string::npos;
         at = text.find(opening, at + 1)) {
        std::vector<double>& numbers = all.emplace_back();
        const char* next = text.c_str() + at + opening.size();
        for (char* end = nullptr;; next = end + 1) {
            numbers.push_back(std::strtod(next, &end));
            if (*end != ',') {
                break;
            }
        }
    }
    return all;
}

double sum(const std::vector<std::vector<double>>& rows, std::size_t column) {
    double total = 0.0;
    for (const std::vector<double>& row : rows) {
        total += row.at(column);
    }
    return total;
}

/// The parameters of the nodes N that have a bud, that is, a `?H` behind them.
std::vector<std::vector<double>> buds(const std::string& word) {
    std::vector<std::vector<double>> found;
    for (std::size_t at = word.find(")?H("); at != std::string::npos;
         at = word.find(")?H(", at + 1)) {
        const std::size_t node = word.rfind("N(", at);
        found.push_back(numbers_after(word.substr(node, at - node), "N(").front());
    }
    return found;
}

double base_width(const Segment& segment) {
    return 2.0 * static_cast<double>(segment.base_radius);
}

} // namespace

TEST_CASE("the light at the base of a tree is the sum over its buds, which share its resource") {
    for (const char* const name : {"self-organising-tree", "self-organising-priority"}) {
        for (const char* const generations : {"1", "5", "24"}) {
            INFO(name << " -n " << generations);
            const std::string word = dumped(name, {"-n", generations});
            const std::vector<double> base = numbers_after(word, "N(").front();
            const double light = sum(numbers_after(word, "?light("), 0);
            REQUIRE(light > 1.0);
            CHECK(base.at(1) == Approx(light).epsilon(1e-5));
            // alpha is 2; the resource is the last parameter.
            CHECK(base.back() == Approx(2.0 * light).epsilon(1e-5));
            CHECK(sum(buds(word), base.size() - 1) == Approx(2.0 * light).epsilon(1e-4));
        }
    }
}

TEST_CASE("the base of a tree counts its buds with space exactly") {
    for (const char* const generations : {"1", "8", "16"}) {
        const std::string word = dumped("self-organising-space", {"-n", generations});
        double free_buds = 0.0;
        for (const std::vector<double>& answer : numbers_after(word, "?room(")) {
            free_buds += answer.front() > 0.0 ? 1.0 : 0.0;
        }
        REQUIRE(free_buds > 5.0);
        CHECK(numbers_after(word, "N(").front().at(1) == free_buds);
    }
}

TEST_CASE("a tree in a dome of space stays in it and stops when the space is taken") {
    const std::string word = dumped("self-organising-space", {"-n", "40", "--all", "--count"});
    const std::size_t last = word.rfind('\n', word.size() - 2);
    const std::size_t before = word.rfind('\n', last - 1);
    CHECK(word.substr(last + 1) == word.substr(before + 1, last - before));
    // The dome is 4.4 m wide and ends at 4.8 m; shoots of its buds may leave it by 0.5 m.
    const Skeleton skeleton = test::sample_plant("self-organising-space").skeleton;
    const SkeletonStats stats = measure(skeleton);
    CHECK(stats.height < 4.8 + 0.5);
    CHECK(stats.height > 4.0);
    CHECK(stats.crown_width < 4.4 + 1.0);
    CHECK(stats.crown_width > 3.6);
}

TEST_CASE("control by the apex makes a leader, and boughs of low order") {
    double mean_order_before = 100.0;
    for (const float lambda : {0.46F, 0.5F, 0.54F}) {
        INFO(lambda);
        const Skeleton skeleton =
            test::sample_plant("self-organising-tree", {{.name = "lambda", .value = lambda}})
                .skeleton;
        double orders = 0.0;
        float top = 0.0F;
        float leader = 0.0F;
        for (const Segment& segment : skeleton.segments) {
            orders += segment.order;
            top = std::fmax(top, tip(segment).y);
            leader = segment.order == 0 ? std::fmax(leader, tip(segment).y) : leader;
        }
        const double mean_order = orders / static_cast<double>(skeleton.segments.size());
        CHECK(mean_order < 0.7 * mean_order_before);
        mean_order_before = mean_order;
        if (lambda > 0.5F) {
            CHECK(leader > 0.95F * top);
        } else if (lambda < 0.5F) {
            CHECK(leader < 0.5F * top);
        }
    }
}

TEST_CASE("space colonisation uses up all markers in reach") {
    const std::string start = dumped("space-colonisation", {"--stage", "environment", "-n", "0"});
    const std::string end = dumped("space-colonisation", {"--stage", "environment"});
    const auto markers_of = [](const std::string& text) {
        return numbers_after(text.substr(text.find("\"markers\"")), "        [");
    };
    REQUIRE(markers_of(start).size() > 2000);
    const std::vector<std::vector<double>> nodes = numbers_after(end, "\"position\": [");
    REQUIRE(nodes.size() > 1000);
    const double radius = 1.6;
    for (const std::vector<double>& marker : markers_of(end)) {
        for (const std::vector<double>& node : nodes) {
            CHECK(std::hypot(marker.at(0) - node.at(0), marker.at(1) - node.at(1),
                             marker.at(2) - node.at(2)) > radius);
        }
    }
    CHECK(sum(numbers_after(end, "\"answer\": ["), 0) == 0.0);
}

TEST_CASE("sections are kept at every fork of a pine") {
    const double exponent = 2.3;
    const Skeleton skeleton = test::sample_plant("pipe-model-pine").skeleton;
    REQUIRE(skeleton.segments.size() > 2000);
    std::vector<double> of_children(skeleton.segments.size(), 0.0);
    std::vector<int> children(skeleton.segments.size(), 0);
    for (const Segment& segment : skeleton.segments) {
        if (segment.parent != kNoSegment) {
            of_children.at(segment.parent) += std::pow(base_width(segment), exponent);
            ++children.at(segment.parent);
        }
    }
    std::size_t forks = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
        const double section = std::pow(base_width(skeleton.segments[i]), exponent);
        if (children[i] == 0) {
            CHECK(section == Approx(std::pow(0.007, exponent)).epsilon(1e-5));
            continue;
        }
        forks += children[i] > 1 ? 1U : 0U;
        CHECK(section == Approx(of_children[i]).epsilon(1e-5));
    }
    CHECK(forks > 500);
    CHECK(base_width(skeleton.segments[0]) > 0.1); // m: the trunk has thickened
}

TEST_CASE("a pine drops its low boughs") {
    const Skeleton skeleton = test::sample_plant("pipe-model-pine").skeleton;
    const double height = measure(skeleton).height;
    double lowest = height;
    for (const Segment& segment : skeleton.segments) {
        if (segment.order > 0) {
            lowest = std::fmin(lowest, segment.base.y);
        }
    }
    CHECK(lowest > 0.25 * height);
    const Skeleton with_boughs =
        test::sample_plant("pipe-model-pine", {{.name = "shed", .value = 0.0F}}).skeleton;
    CHECK(with_boughs.segments.size() > skeleton.segments.size());
}
