// SPDX-License-Identifier: MIT
// liblsys, used only through its public headers.
#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <lsys/grammar.h>
#include <lsys/plant.h>
#include <lsys/word.h>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

const char* const kTree = "#n = 3; #w : A; #p : A : * : F [ + A ] F A;";
const char* const kParametric = "#n = 4; #param ratio 0.5 {0, 1}; #define TURN 25; #w : A(1);\n"
                                "#p : A(x) : * : F(x) [ +(TURN) A(x*ratio) ] A(x + 1);";

std::string file_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// A project whose files are `files`.
lsys::Project project_of(std::map<std::string, std::string> files) {
    lsys::Project project;
    project.host.read_file = [files = std::move(files)](const std::string& path) {
        const auto at = files.find(path);
        return at != files.end() ? lsys::FileContents{true, at->second, {}}
                                 : lsys::FileContents{false, {}, "no such file or directory"};
    };
    return project;
}

} // namespace

TEST_CASE("the version is that of the headers") {
    CHECK(lsys::version_number() == LSYS_VERSION);
    CHECK(std::string(lsys::version()) == std::to_string(LSYS_VERSION_MAJOR) + "." +
                                              std::to_string(LSYS_VERSION_MINOR) + "." +
                                              std::to_string(LSYS_VERSION_PATCH));
}

TEST_CASE("a text is compiled and derived") {
    const auto grammar = lsys::compile_text(kTree);
    REQUIRE(grammar);
    CHECK(grammar->generations() == 3U);
    CHECK(grammar->name() == "grammar.lsys");
    const auto word = lsys::derive(*grammar, {.generations = 2, .seed = {}});
    REQUIRE(word);
    CHECK(word->text() == "F[+F[+A]F A]F F[+A]F A"); // a blank separates adjacent names
    CHECK(word->size() == 19);
    CHECK(word->generation() == 2);
    CHECK(word->parameters().empty());
    CHECK(word->code_bytes() == 1);
    const auto* codes = static_cast<const unsigned char*>(word->codes());
    CHECK(word->kinds().at(codes[0]).name == "F");
    CHECK(word->kinds().at(codes[1]).name == "[");
}

TEST_CASE("messages about limits name members of this interface") {
    const auto doubled = lsys::compile_text("#n = 30; #w : A; #p : A : * : A A;");
    REQUIRE(doubled);
    lsys::Project project;
    project.limits.max_modules = 100;
    const auto word = lsys::derive(*doubled, {}, project);
    REQUIRE(word.status() == lsys::Status::Limit);
    const std::string text = word.messages().text();
    CAPTURE(text);
    CHECK(text.find("`Limits::max_modules`") != std::string::npos);
    CHECK(text.find("--max-modules") == std::string::npos);
    project.limits = {};
    project.limits.max_bytes = 1000;
    const auto large = lsys::derive(*doubled, {}, project);
    REQUIRE(large.status() == lsys::Status::Limit);
    const std::vector<lsys::Diagnostic>& all = large.messages().all();
    REQUIRE_FALSE(all.empty());
    REQUIRE_FALSE(all.back().help.empty());
    CHECK(all.back().help.back().find("`Limits::max_bytes`") != std::string::npos);
}

TEST_CASE("modules of a word have names and parameters") {
    const auto grammar = lsys::compile_text(kParametric);
    REQUIRE(grammar);
    const auto word = lsys::derive(*grammar, {.generations = 1, .seed = {}});
    REQUIRE(word);
    CHECK(word->text() == "F(1)[+(25)A(0.5)]A(2)");
    std::string names;
    std::vector<float> values;
    word->visit(0, word->size(), [&](const lsys::Module& module) {
        names += module.name;
        values.insert(values.end(), module.parameters.begin(), module.parameters.end());
        return true;
    });
    CHECK(names == "F[+A]A");
    CHECK(values == std::vector<float>{1.0F, 25.0F, 0.5F, 2.0F});
    std::string later;
    word->visit(3, 2, [&](const lsys::Module& module) {
        later += module.name;
        if (module.name == "A") {
            CHECK(module.parameters[0] == 0.5F);
        }
        return true;
    });
    CHECK(later == "A]");
    int seen = 0;
    word->visit(0, word->size(), [&](const lsys::Module&) { return ++seen < 2; });
    CHECK(seen == 2);
}

TEST_CASE("constants and settings are listed and replaced") {
    const auto grammar = lsys::compile_text(kParametric);
    REQUIRE(grammar);
    REQUIRE(grammar->constants().size() == 2);
    const lsys::Constant& ratio = grammar->constants()[0];
    CHECK(ratio.name == "ratio");
    CHECK(ratio.is_parameter);
    CHECK(ratio.value == 0.5F);
    CHECK(ratio.max == 1.0F);
    CHECK_FALSE(grammar->constants()[1].is_parameter);
    lsys::GrammarOptions options;
    options.definitions = {{"ratio", 0.25F}};
    options.generations = 1;
    const auto other = lsys::compile_text(kParametric, "a.lsys", options);
    REQUIRE(other);
    CHECK(other->generations() == 1U);
    CHECK(lsys::derive(*other)->text() == "F(1)[+(25)A(0.25)]A(2)");
    options.definitions = {{"ration", 1.0F}};
    const auto wrong = lsys::compile_text(kParametric, "a.lsys", options);
    REQUIRE_FALSE(wrong);
    CHECK(wrong.status() == lsys::Status::Failed);
    CHECK(wrong.messages().all().at(0).message.find("ration") != std::string::npos);
}

TEST_CASE("diagnostics are available as data with places and as text with carets") {
    const auto grammar =
        lsys::compile_text("#n = 1; #define length 2;\n#w : F(lengt);\n", "leaf.lsys");
    REQUIRE_FALSE(grammar);
    CHECK(grammar.status() == lsys::Status::Diagnosed);
    CHECK(std::string(lsys::text_of(grammar.status())) == "mistakes in the grammar or scene");
    REQUIRE_FALSE(grammar.messages().empty());
    const lsys::Diagnostic& first = grammar.messages().all().front();
    CHECK(first.severity == lsys::Severity::Error);
    CHECK(first.code == "unknown-name");
    REQUIRE(first.place);
    CHECK(first.place->file == "leaf.lsys");
    CHECK(first.place->line == 2);
    CHECK(first.place->column == 8);
    CHECK(first.place->end_column == 13);
    CHECK(first.place->offset == 33);
    REQUIRE(first.fixes.size() == 1);
    REQUIRE(first.fixes[0].edits.size() == 1);
    CHECK(first.fixes[0].edits[0].replacement == "length");
    const std::string text = grammar.messages().text();
    CHECK(text.find("^^^^^") != std::string::npos);
    CHECK(text.find("\x1b[") == std::string::npos);
    CHECK(grammar.messages().text(lsys::MessageStyle::ColourFrames).find("\x1b[") !=
          std::string::npos);
    CHECK(grammar.messages().text(lsys::MessageStyle::Lines).find("leaf.lsys:2:8: error: ") == 0);
    CHECK(grammar.messages().text(lsys::MessageStyle::Json).front() == '{');
}

TEST_CASE("warnings can be made errors or switched off") {
    const char* const unused = "#n = 1; #define size 2; #w : F; #p : F : * : F F;";
    const auto warned = lsys::compile_text(unused);
    REQUIRE(warned);
    REQUIRE(warned.messages().all().size() == 1);
    const std::string code = warned.messages().all()[0].code;
    lsys::Project strict;
    strict.deny = {code};
    CHECK(lsys::compile_text(unused, "a.lsys", {}, strict).status() == lsys::Status::Diagnosed);
    lsys::Project silent;
    silent.allow = {code};
    const auto quiet = lsys::compile_text(unused, "a.lsys", {}, silent);
    REQUIRE(quiet);
    CHECK(quiet.messages().empty());
    lsys::Project wrong;
    wrong.deny = {"no-such-code"};
    CHECK(lsys::compile_text(unused, "a.lsys", {}, wrong).status() == lsys::Status::Failed);
}

TEST_CASE("the host provides the files") {
    const lsys::Project project =
        project_of({{"wood/tree.lsys", "#include \"rules.lsys\";\n#n = 1; #w : A;"},
                    {"wood/rules.lsys", "#p : A : * : F F;"}});
    const auto grammar = lsys::compile_file("wood/tree.lsys", {}, project);
    REQUIRE(grammar);
    CHECK(lsys::derive(*grammar)->text() == "F F");
    const auto missing = lsys::compile_file("wood/none.lsys", {}, project);
    REQUIRE_FALSE(missing);
    CHECK(missing.status() == lsys::Status::Failed);
    CHECK(missing.messages().all().at(0).message ==
          "cannot read `wood/none.lsys`: no such file or directory");
}

TEST_CASE("sizes are predicted, exactly where they can be") {
    const auto grammar = lsys::compile_text(kTree);
    REQUIRE(grammar);
    const std::vector<lsys::PredictedSize> sizes = grammar->predict(3);
    REQUIRE(sizes.size() == 4);
    CHECK(sizes[2].low == 19.0);
    CHECK(sizes[2].high == 19.0);
    CHECK(sizes[2].low_segments == 6.0);
    CHECK(lsys::derive(*grammar)->size() == static_cast<std::uint64_t>(sizes[3].low));
}

TEST_CASE("a compiled grammar derives the same word as its source") {
    const auto grammar = lsys::compile_text(kParametric);
    REQUIRE(grammar);
    const auto compiled =
        lsys::compile_file("tree.lsb", {}, project_of({{"tree.lsb", grammar->bytecode()}}));
    REQUIRE(compiled);
    CHECK(lsys::derive(*compiled)->text() == lsys::derive(*grammar)->text());
}

TEST_CASE("limits and exceptions of the host end a call") {
    const auto grammar = lsys::compile_text("#n = 40; #w : A; #p : A : * : A A;");
    REQUIRE(grammar);
    lsys::Project small;
    small.limits.max_modules = 1000;
    const auto limited = lsys::derive(*grammar, {}, small);
    REQUIRE_FALSE(limited);
    CHECK(limited.status() == lsys::Status::Limit);
    CHECK(limited.messages().has_errors());

    const auto slow =
        lsys::compile_text("#n = 22; #w : A(1); #p : A(x) : x > 0 : A(x + 0.5) A(x*{0.9, 1.1});");
    REQUIRE(slow);
    lsys::Project cancelling;
    int calls = 0;
    cancelling.host.progress = [&](const lsys::Progress&) { return ++calls < 3; };
    CHECK(lsys::derive(*slow, {}, cancelling).status() == lsys::Status::Cancelled);
    CHECK(calls >= 3);

    lsys::Project throwing;
    throwing.host.progress = [](const lsys::Progress&) -> bool {
        throw std::runtime_error("no more");
    };
    CHECK_THROWS_WITH(lsys::derive(*slow, {}, throwing), "no more");
    throwing.host.progress = nullptr;
    throwing.host.read_file = [](const std::string&) -> lsys::FileContents {
        throw std::runtime_error("disk on fire");
    };
    CHECK_THROWS_WITH(lsys::compile_file("tree.lsys", {}, throwing), "disk on fire");

    std::atomic<bool> cancelled{true};
    lsys::Project ended;
    ended.host.cancelled = &cancelled;
    CHECK(lsys::derive(*slow, {}, ended).status() == lsys::Status::Cancelled);
}

TEST_CASE("a plant is drawn and meshed without copies of its arrays") {
    const auto grammar = lsys::compile_text("#n = 0; #w : F(2) [ +(90) F(1) ];", "a.lsys");
    REQUIRE(grammar);
    const auto plant = lsys::grow(*grammar);
    REQUIRE(plant);
    REQUIRE(plant->segments().size() == 2);
    const lsys::Segment& trunk = plant->segments()[0];
    CHECK(trunk.length == 2.0F);
    CHECK(trunk.parent == lsys::kNoParent);
    CHECK(trunk.frame.w == 1.0F);
    CHECK((trunk.flags & 1U) == 0);
    const lsys::Segment& branch = plant->segments()[1];
    CHECK(branch.parent == 0);
    CHECK(branch.order == 1);
    CHECK((branch.flags & 1U) == 1);
    CHECK(branch.base.y == 2.0F);
    CHECK(std::abs(branch.frame.w - std::sqrt(0.5F)) < 1e-6F);
    CHECK(plant->measure().length == 3.0);
    const lsys::Plant copy = *plant;
    CHECK(copy.segments().data() == plant->segments().data());

    const auto mesh = lsys::make_mesh(*plant);
    REQUIRE(mesh);
    const std::size_t count = mesh->positions().size();
    REQUIRE(count > 0);
    CHECK(mesh->normals().size() == count);
    CHECK(mesh->texture_coordinates().size() == count);
    CHECK(mesh->index_count() % 3 == 0);
    std::uint64_t indices = 0;
    for (const lsys::MeshPart& part : mesh->parts()) {
        CHECK(part.first_index == indices);
        CHECK(part.material < mesh->materials().size());
        indices += part.index_count;
    }
    CHECK(indices == mesh->index_count());
    std::vector<std::uint32_t> list(mesh->index_count());
    mesh->read_indices(0, list.size(), list.data());
    for (const std::uint32_t index : list) {
        REQUIRE(index < count);
    }
}

TEST_CASE("vertices are written into a buffer of the caller") {
    struct Vertex {
        float position[3];
        float normal[3];
        float uv[2];
        float colour[4];
    };
    const auto grammar =
        lsys::compile_text("#n = 6; #w : A; #p : A : * : F [ + A ] F [ - A ] '(3) A;");
    REQUIRE(grammar);
    const auto mesh = lsys::make_mesh(*lsys::grow(*grammar));
    REQUIRE(mesh);
    std::vector<Vertex> vertices(mesh->positions().size());
    mesh->read_vertices({.positions = &vertices[0].position,
                         .normals = &vertices[0].normal,
                         .texture_coordinates = &vertices[0].uv,
                         .colours = &vertices[0].colour,
                         .stride = sizeof(Vertex)});
    bool equal = true;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        equal = equal && std::memcmp(vertices[i].position, &mesh->positions()[i], 12) == 0 &&
                std::memcmp(vertices[i].normal, &mesh->normals()[i], 12) == 0 &&
                std::memcmp(vertices[i].uv, &mesh->texture_coordinates()[i], 8) == 0 &&
                vertices[i].colour[3] == 1.0F;
    }
    CHECK(equal);
    std::vector<lsys::Vector3> packed(vertices.size());
    mesh->read_vertices({.positions = packed.data()});
    CHECK(std::memcmp(packed.data(), mesh->positions().data(), packed.size() * 12) == 0);
}

TEST_CASE("many threads can use one grammar") {
    const std::string path =
        std::string(LSYS_SOURCE_DIR) + "/samples/abop-1-25-bush/abop-1-25-bush.lsys";
    const auto grammar = lsys::compile_text(file_text(path), path);
    REQUIRE(grammar);
    const auto expected = lsys::make_mesh(*lsys::grow(*grammar));
    REQUIRE(expected);
    std::atomic<int> equal{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([&] {
            lsys::Project project;
            project.threads = 2;
            const auto plant = lsys::grow(*grammar, {}, project);
            const auto mesh = plant ? lsys::make_mesh(*plant, {}, project) : expected;
            if (plant && mesh && mesh->positions().size() == expected->positions().size() &&
                std::memcmp(mesh->positions().data(), expected->positions().data(),
                            mesh->positions().size_bytes()) == 0) {
                ++equal;
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(equal == 8);
}

TEST_CASE("moved-from messages stay usable") {
    const auto grammar = lsys::compile_text("#w : ;;");
    lsys::Messages taken = grammar.messages();
    const lsys::Messages moved = std::move(taken);
    CHECK(moved.has_errors());
    CHECK(taken.has_errors()); // NOLINT(bugprone-use-after-move): both share the data
    CHECK(lsys::Messages().empty());
}
