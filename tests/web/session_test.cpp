// SPDX-License-Identifier: MIT
// Session: requests of the web package and their answers.
#include "web/binding/session.h"

#include <catch2/catch.hpp>

#include <string>
#include <string_view>

namespace lsys::web::tests {

namespace {

constexpr std::string_view kGrammar = "#n = 2;\n#param a 25 {10, 80};\n#set seed 1;\n#w : F;\n"
                                      "#p : F : * : F[+(a)F]F;\n";

/// Asks a new session about `grammar`.
Answer ask(Json request, std::string_view grammar = kGrammar) {
    request["name"] = "plant.lsys";
    request["files"] = Json::array({{{"path", "plant.lsys"}, {"size", grammar.size()}}});
    Session session({});
    return session.answer(request.dump(), grammar);
}

std::string text_of(const Answer& answer, const char* member) {
    const Block& block = answer.blocks.at(answer.head.at(member).get<std::size_t>());
    return {static_cast<const char*>(block.data), block.size};
}

} // namespace

TEST_CASE("a request derives a word") {
    const Answer answer = ask({{"op", "derive"}, {"generations", 1}});
    CHECK(answer.head.at("status") == "ok");
    CHECK(text_of(answer, "text") == "F[+(25)F]F");
    CHECK(answer.head.at("modules") == 6);
    const Answer cut = ask({{"op", "derive"}, {"maxBytes", 3}});
    CHECK(text_of(cut, "text") == "F[+");
    CHECK(cut.head.at("isWhole") == false);
}

TEST_CASE("a request compiles a grammar to its values") {
    const Answer answer = ask({{"op", "compile"}});
    CHECK(answer.head.at("generations") == 2);
    CHECK(answer.head.at("seed") == 1);
    CHECK(answer.head.at("constants").at(0).at("name") == "a");
    CHECK(answer.head.at("constants").at(0).at("max") == 80);
    CHECK(answer.head.at("messages").empty());
}

TEST_CASE("messages have places in UTF-16 code units, and fixes") {
    const Answer answer =
        ask({{"op", "compile"}}, "#n = 1;\n#w : F; /* \xF0\x9F\x8C\xB1 */ #set angle 25");
    CHECK(answer.head.at("status") == "diagnosed");
    const Json& message = answer.head.at("messages").at(0);
    CHECK(message.at("code") == "missing-semicolon");
    CHECK(message.at("place").at("line") == 2);
    CHECK(message.at("place").at("column") == 31);
    CHECK(message.at("fixes").at(0).at("edits").at(0).at("replacement") == ";");
}

TEST_CASE("a request makes a mesh, a skeleton and moments of a growth") {
    const Answer mesh = ask({{"op", "mesh"}});
    const Json& arrays = mesh.head.at("mesh");
    CHECK(mesh.blocks.at(arrays.at("positions").get<std::size_t>()).size > 0);
    CHECK(arrays.at("parts").at(0).at("count").get<std::uint64_t>() * 4 ==
          mesh.blocks.at(arrays.at("indices").get<std::size_t>()).size);
    CHECK(ask({{"op", "skeleton"}}).head.at("skeleton").at("segments").at("count") == 9);

    Session session({});
    const Json begin{{"op", "begin-growth"},
                     {"name", "plant.lsys"},
                     {"files", {{{"path", "plant.lsys"}, {"size", kGrammar.size()}}}}};
    CHECK(session.answer(begin.dump(), kGrammar).head.at("generations") == 2);
    const Answer half = session.answer(R"({"op": "pose-growth", "time": 0.5})", {});
    CHECK(half.head.at("plant").at("segments") == 3);
    CHECK(session.answer(R"({"op": "pose-growth", "time": 3})", {}).head.at("status") == "failed");
}

TEST_CASE("a request writes values into a text, and lays it out") {
    const Answer answer = ask({{"op", "edit"},
                               {"generations", 3},
                               {"definitions", {{"a", 30}}},
                               {"settings", {{"seed", "5"}}}});
    CHECK(text_of(answer, "text") == "#n = 3;\n#param a 30 {10, 80};\n#set seed 5;\n#w : F;\n"
                                     "#p : F : * : F[+(a)F]F;\n");
    CHECK(text_of(ask({{"op", "format"}}, "#n=1;#w:F;"), "text") == "#n = 1;\n#w : F;\n");
}

TEST_CASE("a request writes plants and forests as files") {
    const Answer plant = ask({{"op", "write-plant"}, {"path", "plant.obj"}});
    const Json& files = plant.head.at("files"); // with materials and pictures
    REQUIRE(files.size() == 4);
    CHECK(files.back().at("name") == "plant.obj");
    const Answer forest = ask({{"op", "write-forest"},
                               {"names", {"plant.lsys"}},
                               {"path", "wood.glb"},
                               {"scene", Json::array({Json::array({"count", "20"})})}});
    REQUIRE(forest.head.at("files").size() == 1);
    CHECK(text_of(ask({{"op", "bytecode"}}), "bytes").size() > 100);
    CHECK(ask({{"op", "write-plant"}, {"path", "plant.doc"}}).head.at("status") == "failed");
}

TEST_CASE("included files are those of the request; others are not there") {
    const std::string_view grammar = "#include \"part.lsys\";\n#n = 1;\n#w : F;\n";
    const std::string_view part = "#p : F : * : F F;\n";
    Session session({});
    const Json request{{"op", "derive"},
                       {"name", "plant.lsys"},
                       {"files",
                        {{{"path", "plant.lsys"}, {"size", grammar.size()}},
                         {{"path", "part.lsys"}, {"size", part.size()}}}}};
    const Answer answer = session.answer(request.dump(), std::string(grammar) + std::string(part));
    CHECK(text_of(answer, "text") == "F F");
    CHECK(ask({{"op", "derive"}}, grammar).head.at("status") != "ok");
}

TEST_CASE("a plant that senses asks environments, whose files are those of the request") {
    const std::string_view grammar = "#n = 1;\n#sense light shadow cell 1;\n"
                                     "#sense wall solid mesh \"wall.obj\";\n"
                                     "#w : F(0.25) ?light(0) ?wall(0, 0, 0, 0) A;\n"
                                     "#p : A : * : F(4) ?light(0);\n";
    const std::string_view mesh = "v -9 0 1\nv 9 0 1\nv 0 9 1\nf 1 2 3\n";
    const Json files = {{{"path", "plant.lsys"}, {"size", grammar.size()}},
                        {{"path", "wall.obj"}, {"size", mesh.size()}}};
    Session session({});
    const auto send = [&](Json request) {
        request["name"] = "plant.lsys";
        request["files"] = files;
        return session.answer(request.dump(), std::string(grammar) + std::string(mesh));
    };
    const Answer word = send({{"op", "derive"}});
    // The second place is four voxels above the first: the shadow is 0.2 / 2^4.
    CHECK(text_of(word, "text") == "F(0.25)?light(0.9875)?wall(1,0,0,1)F(4)?light(1)");
    CHECK(send({{"op", "mesh"}}).head.at("plant").at("segments") == 2);
    CHECK(send({{"op", "begin-growth"}}).head.at("generations") == 1);
    CHECK(ask({{"op", "derive"}}, grammar).head.at("status") == "diagnosed"); // without the mesh
}

TEST_CASE("an environment of the kind program is refused, because a page starts none") {
    const Answer answer =
        ask({{"op", "derive"}}, "#n = 1;\n#sense sun program;\n#w : F ?sun(0);\n");
    CHECK(answer.head.at("status") == "diagnosed");
    const Json& message = answer.head.at("messages").at(0);
    CHECK(message.at("code") == "sense-failed");
    CHECK(message.at("place").at("line") == 2);
    CHECK(message.dump().find("a web page starts no programs") != std::string::npos);
    CHECK(ask({{"op", "compile"}}, "#n = 1;\n#sense sun program;\n#w : F ?sun(0);\n")
              .head.at("status") == "ok");
}

TEST_CASE("a wrong request is a failure with a message") {
    Session session({});
    for (const std::string_view request :
         {"", "[]", "{}", R"({"op": "fly"})", R"({"op": "derive"})",
          R"({"op": "derive", "name": 3})", R"({"op": "derive", "name": "missing.lsys"})"}) {
        CAPTURE(request);
        const Answer answer = session.answer(request, {});
        CHECK(answer.head.at("status") == "failed");
        CHECK(answer.head.at("messages").size() == 1);
    }
    const Json limited{{"op", "derive"}, {"maxModules", 10}, {"generations", 20}};
    CHECK(ask(limited).head.at("status") == "limit");
}

} // namespace lsys::web::tests
