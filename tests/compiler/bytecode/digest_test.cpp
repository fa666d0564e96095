// SPDX-License-Identifier: MIT
#include "compiler/bytecode/impl/bytecode_contents.h"
#include "tests/compiler/small_bytecode.h"

#include <catch2/catch.hpp>

#include <functional>
#include <string>

using namespace lsys;

namespace {

/// A stream that changes the field with number `target` in the order of describe(). Rows appended
/// to a table count as one field.
class Change {
public:
    struct Progress {
        std::size_t target = 0;
        std::size_t next = 0; // number of the next field
        bool changed = false;
        bool outside_digest = false; // the changed field does not affect derived words
    };

    Change(Progress& progress, bool outside) : progress_(progress), outside_(outside) {}

    Change outside_digest() { return {progress_, true}; }
    void implied(bool /*value*/) {}
    template <typename Value>
    void number(Value& value) {
        if (is_target()) {
            value ^= 1;
        }
    }
    template <typename Value>
    void number_or_none(Value& value) {
        id(value);
    }
    void real(float& value) {
        if (is_target()) {
            value += 1.0F;
        }
    }
    void truth(bool& value) {
        if (is_target()) {
            value = !value;
        }
    }
    template <typename Enum>
    void tag(Enum& value) {
        if (is_target()) {
            value = static_cast<Enum>((static_cast<std::size_t>(value) + 1) % kCountOf<Enum>);
        }
    }
    template <typename Id>
    void id(Id& value) {
        if (is_target()) {
            value = static_cast<Id>(static_cast<std::uint32_t>(value) ^ 1);
        }
    }
    void text(std::string& value) {
        if (is_target()) {
            value += 'x';
        }
    }
    void optional_number(std::optional<std::uint32_t>& value) {
        if (is_target()) {
            value = value.value_or(0) + 1;
        }
    }
    template <typename Row, typename Function>
    void table(std::vector<Row>& rows, Function row) {
        for (Row& each : rows) {
            row(*this, each);
        }
        if (is_target()) {
            rows.emplace_back();
        }
    }
    template <typename Row, typename Function>
    void table_or_none(std::vector<Row>& rows, Function row) {
        table(rows, row);
    }
    void codes(std::vector<Code>& codes, std::uint32_t /*width*/) {
        table(codes, [](Change& change, Code& code) { change.number(code); });
    }

private:
    bool is_target() {
        if (progress_.next++ != progress_.target) {
            return false;
        }
        progress_.changed = true;
        progress_.outside_digest = outside_;
        return true;
    }

    Progress& progress_;
    bool outside_; // the fields described now are not part of the digest
};

} // namespace

TEST_CASE("every field that affects the word changes the digest, and no other field does") {
    const std::uint64_t known = digest(test::small_bytecode());
    std::size_t inside = 0;
    std::size_t outside = 0;
    for (std::size_t target = 0;; ++target) {
        Bytecode bytecode = test::small_bytecode();
        Change::Progress progress{.target = target};
        Change change(progress, false);
        describe(change, bytecode);
        if (!progress.changed) {
            break;
        }
        CAPTURE(target, progress.outside_digest);
        CHECK((digest(bytecode) == known) == progress.outside_digest);
        ++(progress.outside_digest ? outside : inside);
    }
    CHECK(inside > 150);
    CHECK(outside > 80);
}

TEST_CASE("the digest depends on the inputs of the derivation and on nothing else") {
    const Bytecode bytecode = test::small_bytecode();
    const auto changed = [&](const std::function<void(Bytecode&)>& change) {
        Bytecode other = bytecode;
        change(other);
        return digest(other) != digest(bytecode);
    };
    CHECK_FALSE(changed([](Bytecode& b) { b.sites[0].line = 7; }));
    CHECK_FALSE(changed([](Bytecode& b) { b.files[0] = "other.lsys"; }));
    CHECK_FALSE(changed([](Bytecode& b) { b.productions[0].name = "q"; }));
    CHECK_FALSE(changed([](Bytecode& b) { b.generations = 7; }));
    CHECK_FALSE(changed([](Bytecode& b) { b.template_places[0].line = 7; }));
    CHECK(changed([](Bytecode& b) { b.symbols[0].name = "C"; }));
    CHECK(changed([](Bytecode& b) { b.symbols[2].ignored = false; }));
    CHECK(changed([](Bytecode& b) { b.symbols[2].turtle = TurtleOperation::Cut; }));
    CHECK_FALSE(changed([](Bytecode& b) { b.symbols[2].turtle = TurtleOperation::Forward; }));
    CHECK(changed([](Bytecode& b) { b.constants[0] = 0.25F; }));
    CHECK(changed([](Bytecode& b) { b.productions[1].weight = 0.25F; }));
    CHECK(changed([](Bytecode& b) { b.instructions[1] = test::bits(1.5F); }));
    CHECK(changed([](Bytecode& b) { b.axioms.front().draw_position = 7; }));
}

TEST_CASE("a setting changes the digest if it changes the word") {
    const auto changed = [](const std::function<void(Settings&)>& change) {
        Bytecode bytecode = test::small_bytecode();
        const std::uint64_t before = digest(bytecode);
        change(bytecode.settings);
        return digest(bytecode) != before;
    };
    CHECK(changed([](Settings& s) { s.rewriting = RewritingMode::Leftmost; }));
    CHECK(changed([](Settings& s) { s.choice = ChoiceScope::Generation; }));
    CHECK(changed([](Settings& s) { s.random = RandomSource::Glibc; }));
    CHECK(changed([](Settings& s) { s.at_depth = AtDepth::Stop; }));
    CHECK(changed([](Settings& s) { s.decompose_depth = 7; }));
    // Settings of drawing, printing and checking, and defaults of the derivation.
    CHECK_FALSE(changed([](Settings& s) { s.turtle = TurtleProfile::Abop; }));
    CHECK_FALSE(changed([](Settings& s) { s.weights = WeightRule::Any; }));
    CHECK_FALSE(changed([](Settings& s) { s.print_letters = true; }));
    CHECK_FALSE(changed([](Settings& s) { s.print_characters = true; }));
    CHECK_FALSE(changed([](Settings& s) { s.angle = 30.0F; }));
    CHECK_FALSE(changed([](Settings& s) { s.tropism[1] = 2.0F; }));
    CHECK_FALSE(changed([](Settings& s) { s.seed = 7; }));
    CHECK_FALSE(changed([](Settings& s) { s.interpret_depth = 7; }));
}
