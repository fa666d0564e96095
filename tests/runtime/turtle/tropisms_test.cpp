// SPDX-License-Identifier: MIT
// Tropisms whose strength the word changes, against the turtle of cpfg: the places are results of
// its formulas (sources of vlab: turtle.c, movements.c, interpret.c), computed apart from this code.
#include "grammar/base/number_chars.h"
#include "runtime/turtle/impl/tropisms.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;

namespace {

struct Case {
    std::vector<StepTropism> rows;
    std::string word;                  // `@Ti` and so on are commands
    std::vector<SensingVector> places; // the base of each segment, and the end of the last one
};

const std::vector<Case> kCases{
    {{{TropismKind::After, {0.0F, 1.0F, 0.0F}, 0.25F, 0.125F, 0.0F}},
     "+(70)FF[&(40)F_F]/(90)&(30)F_(0.5)FF",
     {{0.000000000, 0.000000000, 0.000000000},
      {-0.939692621, 0.342020143, 0.000000000},
      {-1.772738502, 0.895224048, 0.000000000},
      {-2.308639280, 1.442612799, -0.642787610},
      {-1.772738502, 0.895224048, 0.000000000},
      {-2.021300205, 1.863840112, -0.000000000},
      {-2.209191328, 2.846029974, -0.000000000},
      {-2.303979093, 3.841527478, -0.000000000}}},
    {{{TropismKind::Before, {0.0F, -1.0F, 0.0F}, 0.25F, 0.125F, 0.0F}},
     "+(60)FF@Ti(1)F@Td(1,0.25)F@Ts(1)F/(90)&(20)F",
     {{0.000000000, 0.000000000, 0.000000000},
      {-0.953216524, 0.302288369, 0.000000000},
      {-1.950851542, 0.371022427, 0.000000000},
      {-2.904600898, 0.070419421, 0.000000000},
      {-3.815827757, -0.341485435, 0.000000000},
      {-4.727054616, -0.753390292, 0.000000000},
      {-5.724207530, -0.828796305, -0.000000000}}},
    {{{TropismKind::Before, {0.0F, 1.0F, 0.0F}, 0.25F, 0.0F, 90.0F}},
     "+(30)FF&(45)F@Ts(1,0.5)FF",
     {{0.000000000, 0.000000000, 0.000000000},
      {-0.674365541, 0.738397669, 0.000000000},
      {-1.472808453, 1.340468193, 0.000000000},
      {-2.062416776, 1.667663911, -0.738447688},
      {-2.677402951, 1.836586606, -1.508679554},
      {-3.299088488, 1.921758499, -2.287301954}}},
    {{{TropismKind::Before, {0.5F, 0.0F, 0.5F}, 0.5F, 0.0F, 30.0F},
      {TropismKind::Twist, {0.0F, 1.0F, 0.0F}, 0.25F, 0.0F, 0.0F}},
     "&(50)FF/(60)+(20)F@Ts(2,0.5)F+(40)F@Tf\\(30)F&(30)@TpF",
     {{0.000000000, 0.000000000, 0.000000000},
      {0.290920861, 0.746374420, -0.598573536},
      {0.826665764, 1.505743846, -0.967809874},
      {1.469390877, 2.138450869, -1.399766182},
      {2.256438514, 2.721113987, -1.602398137},
      {2.806204183, 3.429748346, -2.044659434},
      {3.524710888, 4.092869508, -2.254465147},
      {4.489696995, 4.281787127, -2.436432034}}},
    {{{TropismKind::Before, {0.0F, 1.0F, 0.0F}, 0.25F, 0.0F, 0.0F},
      {TropismKind::Before, {0.0F, 1.0F, 0.0F}, 0.25F, 0.0F, 90.0F},
      {TropismKind::Twist, {1.0F, 0.0F, 0.0F}, 0.5F, 0.25F, 0.0F},
      {TropismKind::After, {0.0F, 0.0F, 1.0F}, 0.125F, 0.0F, 0.0F}},
     "+(45)F[&(30)F@Ts(3,0.25)F]@Ti(3)f&(20)F@Td(2,0.125)F",
     {{0.000000000, 0.000000000, 0.000000000},
      {-0.707106781, 0.707106781, 0.000000000},
      {-1.436749277, 1.301192248, -0.338650685},
      {-1.406787035, 1.410621822, 0.124555731},
      {-2.219463259, 1.993305863, 0.130610635},
      {-2.943367386, 2.673120262, 0.248148707}}},
};

/// Reads a word with the commands of the profile `cpfg`; lengths are 1.
class Reader {
public:
    explicit Reader(const Case& wanted) : tropisms_(rows_of(wanted.rows)), text_(wanted.word) {}

    std::vector<SensingVector> places() {
        while (!text_.empty()) {
            const std::size_t length = text_.starts_with('@') ? 3 : 1;
            const std::string_view name = text_.substr(0, length);
            text_.remove_prefix(length);
            read(name, arguments());
        }
        places_.push_back(last_end_);
        return places_;
    }

private:
    static StepTropisms rows_of(const std::vector<StepTropism>& rows) {
        StepTropisms all;
        std::copy(rows.begin(), rows.end(), all.begin());
        return all;
    }

    std::vector<float> arguments() {
        std::vector<float> values;
        while (text_.starts_with('(') || (text_.starts_with(',') && !values.empty())) {
            text_.remove_prefix(1);
            float value = 0.0F;
            const auto [end, error] =
                number_from_chars(text_.data(), text_.data() + text_.size(), value);
            REQUIRE(error == std::errc());
            text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
            values.push_back(value);
        }
        if (!values.empty()) {
            text_.remove_prefix(1); // the `)`
        }
        return values;
    }

    void step(bool draws) {
        tropisms_.before_step(pose_);
        if (draws) {
            places_.push_back(pose_.position);
        }
        advance(pose_, 1.0);
        last_end_ = draws ? pose_.position : last_end_;
        tropisms_.after_step(pose_, draws);
    }

    void read(std::string_view name, const std::vector<float>& values) {
        const ExactSineCosine turn =
            exact_sine_cosine_of_degrees(values.empty() ? 0.0 : static_cast<double>(values[0]));
        const auto count = static_cast<std::uint32_t>(values.size());
        const auto command = [&](TurtleOperation operation) {
            tropisms_.execute(operation, count, values.data(), pose_);
        };
        if (name == "F" || name == "f") {
            step(name == "F");
        } else if (name == "+") {
            yaw_right(pose_, inverse(turn));
        } else if (name == "&") {
            pitch_up(pose_, inverse(turn));
        } else if (name == "\\" || name == "/") {
            roll_left(pose_, name == "/" ? turn : inverse(turn));
        } else if (name == "[") {
            tropisms_.save();
            saved_.push_back(pose_);
        } else if (name == "]") {
            tropisms_.restore();
            pose_ = saved_.back();
            saved_.pop_back();
        } else {
            command(name == "_"     ? TurtleOperation::SetSusceptibility
                    : name == "@Ts" ? TurtleOperation::SetTropism
                    : name == "@Ti" ? TurtleOperation::AddTropism
                    : name == "@Td" ? TurtleOperation::SubtractTropism
                    : name == "@Tp" ? TurtleOperation::Untwist
                                    : TurtleOperation::KeepTwist);
        }
    }

    Tropisms tropisms_;
    std::string_view text_;
    SensingPose pose_;
    std::vector<SensingPose> saved_;
    std::vector<SensingVector> places_;
    SensingVector last_end_{};
};

} // namespace

TEST_CASE("tropisms bend as those of cpfg") {
    for (const Case& wanted : kCases) {
        CAPTURE(wanted.word);
        const std::vector<SensingVector> places = Reader(wanted).places();
        REQUIRE(places.size() == wanted.places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                CAPTURE(i, axis);
                CHECK(places[i][axis] == Approx(wanted.places[i][axis]).margin(1e-6));
            }
        }
    }
}

TEST_CASE("tropisms without a number, or of a number that there is not, do nothing") {
    StepTropisms rows;
    rows[0] = {TropismKind::Before, {1.0F, 0.0F, 0.0F}, 0.0F, 0.0F, 0.0F};
    Tropisms tropisms(rows);
    CHECK(tropisms.any());
    CHECK_FALSE(Tropisms(StepTropisms{}).any());
    SensingPose pose;
    for (const float number : {0.0F, 2.0F, -1.0F}) {
        const std::array<float, 2> arguments{number, 1.0F};
        tropisms.execute(TurtleOperation::SetTropism, 2, arguments.data(), pose);
    }
    tropisms.execute(TurtleOperation::SetTropism, 0, nullptr, pose);
    tropisms.before_step(pose);
    CHECK(pose.heading == SensingVector{0.0, 1.0, 0.0});
    const std::array<float, 2> arguments{1.0F, 1.0F};
    tropisms.execute(TurtleOperation::SetTropism, 2, arguments.data(), pose);
    tropisms.before_step(pose);
    CHECK(pose.heading[0] == Approx(0.8414709848)); // sin 1
}
