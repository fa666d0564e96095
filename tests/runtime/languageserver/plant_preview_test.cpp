// SPDX-License-Identifier: MIT
// `lsys/plant`: the plant of a grammar as GLB, with the places in the text that drew its parts.
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <set>

namespace lsys::tests {

namespace {

const std::string kTree = "#n = 3;\n"
                          "#param l 2 {1, 4}; // length of a branch\n"
                          "#define unused {1, 2};\n"
                          "#set seed 7;\n"
                          "#w : F(1) A;\n"
                          "#grow : A : * : F(l) [+(30) A] [-(30) A];\n";

Json plant_of(Editor& editor, Json more = Json::object()) {
    Json params = Editor::in("/p/a.lsys");
    params.update(more);
    return editor.request("lsys/plant", params);
}

std::string bytes_of(const std::string& base64) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : base64) {
        if (c == '=') {
            break;
        }
        bits = bits << 6U | static_cast<std::uint32_t>(kDigits.find(c));
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
        }
    }
    return bytes;
}

/// A GLB file: its document and its buffer.
struct Glb {
    explicit Glb(const std::string& bytes) {
        REQUIRE(bytes.size() > 20);
        REQUIRE(bytes.substr(0, 4) == "glTF");
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, 4);
        document = Json::parse(bytes.substr(20, length));
        buffer = bytes.substr(20 + length + 8);
    }
    /// The numbers of the attribute `_ITEMS` of all vertices.
    [[nodiscard]] std::set<float> items() const {
        std::set<float> all;
        for (const Json& mesh : document.at("meshes")) {
            for (const Json& primitive : mesh.at("primitives")) {
                const auto number = primitive.at("attributes").at("_ITEMS").get<std::size_t>();
                const Json& accessor = document.at("accessors").at(number);
                CHECK(accessor.at("type") == "VEC2");
                const Json& view =
                    document.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
                const auto first = view.value("byteOffset", std::size_t{0});
                const auto count = accessor.at("count").get<std::size_t>();
                for (std::size_t i = 0; i < 2 * count; ++i) {
                    float item = 0.0F;
                    std::memcpy(&item, buffer.data() + first + 4 * i, 4);
                    all.insert(item);
                }
            }
        }
        return all;
    }
    Json document;
    std::string buffer;
};

} // namespace

TEST_CASE("lsys/plant answers with the plant, its sources and the parameters") {
    Editor editor(Json::object());
    CHECK(editor.answer.at("capabilities").at("experimental").at("lsysPlant") == true);
    editor.open("/p/a.lsys", kTree);
    const Json result = plant_of(editor);
    CHECK(result.at("version") == 1);
    CHECK(result.at("lastGeneration") == 3);
    REQUIRE(result.at("parameters").size() == 2);
    const Json& parameter = result.at("parameters").at(0);
    CHECK(parameter.at("name") == "l");
    CHECK(parameter.at("comment") == "length of a branch");
    CHECK(parameter.at("value") == 2);
    CHECK(parameter.at("minimum") == 1);
    CHECK(parameter.at("maximum") == 4);
    CHECK(result.at("parameters").at(1).at("value").is_null());

    const Json& plant = result.at("plant");
    CHECK(plant.at("generations") == 3);
    CHECK(plant.at("seed") == 7);
    CHECK(plant.at("level") == 0);
    // The axiom has 2 modules. The production is applied 1 + 2 + 4 times and adds 8 each time.
    CHECK(plant.at("modules") == 2 + 8 * 7);
    CHECK(plant.at("triangles").get<int>() > 8);
    const Json& sources = plant.at("sources");
    REQUIRE(sources.size() == 2);
    CHECK(sources.at(0).at("production").is_null());
    CHECK(sources.at(0).at("uri") == "file:///p/a.lsys");
    CHECK(sources.at(0).at("range") == Editor::range(4, 5, 9));
    CHECK(sources.at(0).at("statement") == Editor::range(4, 0, 12));
    CHECK(sources.at(1).at("production") == "grow");
    CHECK(sources.at(1).at("range") == Editor::range(5, 16, 20));
    CHECK(sources.at(1).at("statement") == Editor::range(5, 0, 41));
    const Glb glb(bytes_of(plant.at("glb").get<std::string>()));
    CHECK(glb.items() == std::set<float>{0.0F, 1.0F});
}

TEST_CASE("lsys/plant follows the text, its options and included files") {
    Editor editor(Json::object(), {{"/p/part.lsys", "#p : A : * : F A;\n"}});
    editor.open("/p/a.lsys", "#n = 2;\n#w : A;\n#include \"part.lsys\";\n");
    CHECK(plant_of(editor).at("plant").at("modules") == 3);
    const Json source = plant_of(editor).at("plant").at("sources").at(0);
    CHECK(source.at("uri") == "file:///p/part.lsys");
    CHECK(source.at("range") == Editor::range(0, 13, 14));

    editor.open("/p/part.lsys", "#p : A : * : F F A;\n"); // not saved
    CHECK(plant_of(editor).at("plant").at("modules") == 5);
    CHECK(plant_of(editor, {{"generations", 4}}).at("plant").at("modules") == 9);
    // The plant of a part is that of the grammar that includes it.
    Json params = Editor::in("/p/part.lsys");
    CHECK(editor.request("lsys/plant", params).at("plant").at("modules") == 5);

    editor.change("/p/a.lsys", kTree);
    const Json plain = plant_of(editor);
    const Json longer = plant_of(editor, {{"definitions", {{"l", 3.5}, {"gone", 1}}}});
    CHECK(longer.at("parameters").at(0).at("value") == 3.5);
    CHECK(longer.at("plant").at("glb") != plain.at("plant").at("glb"));
    CHECK(plant_of(editor, {{"seed", 8}}).at("plant").at("seed") == 8);
    CHECK(plain == [&] {
        Json again = plant_of(editor);
        again["plant"]["seconds"] = plain.at("plant").at("seconds");
        return again;
    }());
}

TEST_CASE("lsys/plant counts characters as the editor does") {
    Editor editor(Json{{"general", {{"positionEncodings", Json::array({"utf-8"})}}}});
    editor.open("/p/a.lsys", "/* 🌳 */ #w : F;\n");
    const Json result = plant_of(editor, {{"generations", 0}});
    CHECK(result.at("plant").at("sources").at(0).at("range") == Editor::range(0, 16, 17));
    Editor other(Json::object());
    other.open("/p/a.lsys", "\xEF\xBB\xBF/* 🌳 */ #w : F;\n");
    CHECK(plant_of(other, {{"generations", 0}}).at("plant").at("sources").at(0).at("range") ==
          Editor::range(0, 15, 16));
}

TEST_CASE("lsys/plant says why there is no plant") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", "#n = 40;\n#param x 1 {0, 2};\n#w : A;\n#p : A : * : A A F(x);\n");
    const Json many = plant_of(editor);
    CHECK(many.at("plant").is_null());
    CHECK(many.at("reason") == "limit");
    CHECK_THAT(many.at("message").get<std::string>(), Catch::Contains("modules"));
    CHECK(many.at("parameters").size() == 1);
    const Json fine = plant_of(editor, {{"generations", 3}, {"maxTriangles", 1}});
    CHECK(fine.at("reason") == "limit");
    CHECK_THAT(fine.at("message").get<std::string>(), Catch::Contains("triangles"));

    editor.change("/p/a.lsys", "#w : F;\n#p : A : x > 1 : F;\n");
    const Json wrong = plant_of(editor);
    CHECK(wrong.at("reason") == "grammar");
    CHECK_THAT(wrong.at("message").get<std::string>(), Catch::StartsWith("line 2: "));

    editor.change("/p/a.lsys", "#n = 1;\n#w : A(0);\n#p : A(x) : * : F(1/x);\n");
    const Json infinite = plant_of(editor);
    CHECK(infinite.at("reason") == "grammar");
    CHECK_THAT(infinite.at("message").get<std::string>(), Catch::StartsWith("line 3: "));

    editor.change("/p/a.lsys", "#n = 0;\n#w : f;\n");
    CHECK(plant_of(editor).at("plant").at("glb") == "");
}

TEST_CASE("lsys/plant grows plants that sense, in the environments of their files") {
    Editor editor(Json::object(), {{"/p/wall.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n"}});
    editor.open("/p/a.lsys", "#n = 2;\n#sense light shadow;\n#sense wall solid mesh \"wall.obj\";\n"
                             "#w : F(2) ?light(0) ?wall(0, 0, 0, 0) A(0);\n"
                             "#p : ?wall(d, x, y, z) < A(a) : d > 0.5 : F(d) A(d);\n"
                             "#down d : ?light(q) > A(a) : * : ?light(a);\n");
    const Json result = plant_of(editor);
    CAPTURE(result.dump().substr(0, 300));
    CHECK(result.at("plant").at("modules") == 5);
}

TEST_CASE("lsys/plant starts no program") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", "#n = 0;\n#sense started program;\n#w : F ?started(0);\n");
    const Json result = plant_of(editor);
    CHECK(result.at("plant").is_null());
    CHECK(result.at("reason") == "grammar");
    const std::string message = result.at("message").get<std::string>();
    CHECK_THAT(message, Catch::StartsWith("line 2: "));
    CHECK_THAT(message, Catch::Contains("nothing is given that answers it"));
}

TEST_CASE("lsys/plant refuses wrong parameters") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", kTree);
    const auto refused = [&](Json more) {
        Json params = Editor::in("/p/a.lsys");
        params.update(more);
        return editor.error_code("lsys/plant", params);
    };
    CHECK(refused({{"generations", -1}}) == -32602);
    CHECK(refused({{"seed", 1.5}}) == -32602);
    CHECK(refused({{"maxModules", 0}}) == -32602);
    CHECK(refused({{"maxSeconds", 0}}) == -32602);
    CHECK(refused({{"definitions", {{"l", "2"}}}}) == -32602);
    CHECK(editor.error_code("lsys/plant", Editor::in("/p/none.lsys")) == -32602);
}

#if LSYS_THREADS

namespace {

/// Responses that arrive on another thread.
class Late {
public:
    explicit Late(LanguageServer& server) : server_(server) {
        server.deliver_late([this](const std::string& body) {
            const std::lock_guard lock(mutex_);
            Json message = Json::parse(body);
            const int id = message.at("id").get<int>();
            responses_[id] = std::move(message);
            arrived_.notify_all();
        });
    }
    ~Late() { server_.deliver_late({}); }
    [[nodiscard]] bool has(int id) {
        const std::lock_guard lock(mutex_);
        return responses_.contains(id);
    }
    Json response(int id) {
        std::unique_lock lock(mutex_);
        REQUIRE(arrived_.wait_for(lock, std::chrono::seconds(60),
                                  [&] { return responses_.contains(id); }));
        return responses_.at(id);
    }

private:
    LanguageServer& server_;
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::map<int, Json> responses_;
};

/// A grammar whose derivation takes far longer than any test, within the limit of modules.
const std::string kEndless = "#n = 4000000000;\n#w : A(0);\n#p : A(x) : * : A(x + 1);\n";

/// Asks for a plant, which may take an hour unless `more` has another limit.
void ask(Editor& editor, int id, Json more = Json::object()) {
    Json params = Editor::in("/p/a.lsys");
    params["maxSeconds"] = 3600;
    params.update(more);
    editor.send({{"jsonrpc", "2.0"}, {"id", id}, {"method", "lsys/plant"}, {"params", params}});
}

} // namespace

TEST_CASE("lsys/plant does not block the server, and a newer request ends an older one") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", kEndless);
    Late late(editor.server());
    ask(editor, 1001);
    CHECK(editor.request("textDocument/hover", Editor::at("/p/a.lsys", 1, 1)).is_object());
    CHECK_FALSE(late.has(1001));
    ask(editor, 1002);
    CHECK(late.response(1001).at("error").at("code") == -32802);
    editor.notify("$/cancelRequest", {{"id", 1002}});
    CHECK(late.response(1002).at("error").at("code") == -32800);
    editor.change("/p/a.lsys", kTree);
    ask(editor, 1003);
    CHECK(late.response(1003).at("result").at("plant").at("triangles").get<int>() > 0);
    editor.notify("$/cancelRequest", {{"id", 1003}}); // too late: no effect
}

TEST_CASE("plants of different documents do not end each other") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", kEndless);
    editor.open("/p/b.lsys", kTree);
    Late late(editor.server());
    ask(editor, 1001, {{"maxSeconds", 0.2}});
    editor.send({{"jsonrpc", "2.0"},
                 {"id", 1002},
                 {"method", "lsys/plant"},
                 {"params", Editor::in("/p/b.lsys")}});
    editor.notify("$/cancelRequest", {{"id", 999}}); // unknown
    CHECK(late.response(1001).at("result").at("reason") == "limit");
    CHECK(late.response(1002).at("result").at("plant").is_object());
}

TEST_CASE("lsys/plant ends after the wanted time") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", kEndless);
    Late late(editor.server());
    ask(editor, 1001, {{"maxSeconds", 0.2}});
    const Json result = late.response(1001).at("result");
    CHECK(result.at("reason") == "limit");
    CHECK(result.at("message") == "the plant takes longer than 0.2 s");
}

TEST_CASE("lsys/plant states its limit of time, however short") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", kEndless);
    Late late(editor.server());
    for (int id = 1001; id <= 1020; ++id) {
        ask(editor, id, {{"maxSeconds", 1e-4}});
        const Json response = late.response(id);
        CAPTURE(response.dump());
        REQUIRE(response.contains("result"));
        CHECK(response.at("result").at("message") == "the plant takes longer than 0.0001 s");
    }
}

TEST_CASE("a server that ends cancels its plants") {
    Editor editor(Json::object());
    editor.open("/p/a.lsys", kEndless);
    Late late(editor.server());
    ask(editor, 1001);
    CHECK(editor.request("shutdown", nullptr).is_null());
    CHECK(late.response(1001).contains("error"));
}

#endif

} // namespace lsys::tests
