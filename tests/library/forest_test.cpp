// SPDX-License-Identifier: MIT
// Files and forests of liblsys, used only through its public headers.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <lsys.h>
#include <lsys/export.h>
#include <lsys/forest.h>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

const char* const kTree = "#n = 4; #set angle 25; #w : !(0.3) F(3) X;"
                          "#p : X : * : !(0.08) F(0.6) [ + X ] /(120) [ & X ] /(120) [ ^ X ];";

/// A project with the file tree.lsys.
lsys::Project tree_project() {
    lsys::Project project;
    project.host.read_file = [](const std::string& path) {
        return path == "tree.lsys" ? lsys::FileContents{true, kTree, {}}
                                   : lsys::FileContents{false, {}, "no such file or directory"};
    };
    return project;
}

lsys::Plant tree() {
    const auto grammar = lsys::compile_text(kTree);
    REQUIRE(grammar);
    const auto plant = lsys::grow(*grammar);
    REQUIRE(plant);
    return *plant;
}

/// The files that a receiver got, by name.
struct Received {
    std::map<std::string, std::string> files;
    std::vector<std::string> complete;

    lsys::FileReceiver receiver() {
        return [this](const lsys::FilePiece& piece) {
            files[std::string(piece.name)] += piece.bytes;
            if (piece.is_last) {
                CHECK(piece.bytes.empty());
                complete.emplace_back(piece.name);
            }
            return true;
        };
    }
};

std::string file_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// An empty folder that is removed at the end.
class Folder {
public:
    Folder() { REQUIRE(std::filesystem::create_directory(path_)); }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    [[nodiscard]] std::size_t file_count() const {
        const std::filesystem::directory_iterator files(path_);
        return static_cast<std::size_t>(std::distance(begin(files), end(files)));
    }

private:
    std::string path_ = (std::filesystem::temp_directory_path() /
                         ("lsys-" + std::to_string(std::random_device()())))
                            .generic_string();
};

} // namespace

TEST_CASE("a plant is saved with the files beside it") {
    const Folder folder;
    const auto saved = lsys::save_plant(tree(), folder / "a.obj", {{"lods", "3"}});
    REQUIRE(saved);
    CHECK(saved->size() == folder.file_count());
    for (const char* name : {"a.LOD0.obj", "a.LOD0.mtl", "a.LOD1.obj", "a.lods.json"}) {
        CAPTURE(name);
        CHECK(std::count(saved->begin(), saved->end(), folder / name) == 1);
        CHECK(std::filesystem::file_size(folder / name) > 0);
    }
}

TEST_CASE("no file of a forest replaces an input") {
    const Folder folder;
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
    };
    write("leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write("part.glb", "#set angle 25;"); // a grammar with the name of an output
    write("tree.lsys", "#include \"part.glb\";\n#object L \"leaf.obj\";\n"
                       "#n = 1; #w : !(0.1) F L;");
    write("wood.toml", "[placement]\ncount = 3\n[[species]]\ngrammar = \"tree.lsys\"\n");
    const std::string leaf = file_text(folder / "leaf.obj");
    const auto forest = lsys::grow_forest({folder / "wood.toml"});
    REQUIRE(forest);
    const auto refusal = [&](const char* name, const lsys::Options& options) {
        const auto saved = lsys::save_forest(*forest, folder / name, options);
        CHECK_FALSE(saved);
        return saved.messages().text();
    };
    CHECK(refusal("leaf.obj", {{"bake", ""}}).find("it is an input") != std::string::npos);
    CHECK(refusal("part.glb", {}).find("it is an input") != std::string::npos);
    CHECK(file_text(folder / "leaf.obj") == leaf);
    CHECK(file_text(folder / "part.glb") == "#set angle 25;");
    CHECK(lsys::save_forest(*forest, folder / "wood.glb"));
}

TEST_CASE("a mesh is saved unchanged, and replaces no input") {
    const Folder folder;
    std::ofstream(folder / "leaf.obj", std::ios::binary) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(folder / "tree.lsys", std::ios::binary)
        << "#object L \"leaf.obj\";\n#n = 1; #w : !(0.1) F L;";
    const auto grammar = lsys::compile_file(folder / "tree.lsys");
    REQUIRE(grammar);
    const auto plant = lsys::grow(*grammar);
    REQUIRE(plant);
    const auto mesh = lsys::make_mesh(*plant);
    REQUIRE(mesh);
    const auto saved = lsys::save_mesh(*plant, *mesh, folder / "tree.obj", "obj");
    REQUIRE(saved);
    CHECK(*saved == std::vector<std::string>{folder / "tree.obj"});
    std::string bytes;
    REQUIRE(lsys::export_plant(*plant, *mesh, "obj", [&](std::string_view piece) {
        bytes += piece;
        return true;
    }));
    CHECK(file_text(folder / "tree.obj") == bytes);
    const auto refused = lsys::save_mesh(*plant, *mesh, folder / "leaf.obj", "obj");
    CHECK_FALSE(refused);
    CHECK(refused.messages().text().find("it is an input") != std::string::npos);
    CHECK(file_text(folder / "leaf.obj").starts_with("v 0 0 0\n"));
    CHECK_FALSE(lsys::save_mesh(*plant, *mesh, folder / "a.doc", "doc"));
}

TEST_CASE("a receiver gets the same files as a folder") {
    const Folder folder;
    const lsys::Options options{{"preset", "unreal"}, {"lods", "3"}};
    const auto saved = lsys::save_plant(tree(), folder / "a.gltf", options);
    REQUIRE(saved);
    Received received;
    const auto written = lsys::write_plant(tree(), "a.gltf", received.receiver(), options);
    REQUIRE(written);
    CHECK(received.complete == *written);
    REQUIRE(received.files.size() == saved->size());
    for (const auto& [name, bytes] : received.files) {
        CAPTURE(name);
        CHECK(bytes == file_text(folder / name));
    }
    CHECK(received.files.contains("a.lods.json"));
    CHECK(received.files["a.LOD0.gltf"].find("UCP_a_00") != std::string::npos);
}

TEST_CASE("a plant bends, moves and grows in files") {
    Received bent;
    REQUIRE(lsys::write_plant(tree(), "a.stl", bent.receiver(), {{"gravity", "9.81"}}));
    Received still;
    REQUIRE(lsys::write_plant(tree(), "a.stl", still.receiver()));
    CHECK(bent.files["a.stl"].size() == still.files["a.stl"].size());
    CHECK(bent.files["a.stl"] != still.files["a.stl"]);
    Received moving;
    REQUIRE(lsys::write_plant(tree(), "a.glb", moving.receiver(),
                              {{"wind", "8,0,0"}, {"frames", "5"}}));
    CHECK(moving.files["a.glb"].find("\"animations\"") != std::string::npos);
    Received growing;
    REQUIRE(
        lsys::write_plant(tree(), "a.ply", growing.receiver(), {{"grow", ""}, {"frames", "3"}}));
    CHECK(growing.complete == std::vector<std::string>{"a.0001.ply", "a.0002.ply", "a.0003.ply"});
    Received print; // the plant is grown again, because the preset makes it 150 mm high
    REQUIRE(lsys::write_plant(tree(), "a.obj", print.receiver(), {{"preset", "print"}}));
    CHECK(print.files["a.obj"].find("# millimetres, +Z up") != std::string::npos);
}

TEST_CASE("invalid options are refused with the messages of lsc") {
    const auto text_of = [](const std::string& name, const lsys::Options& options) {
        Received received;
        const auto written = lsys::write_plant(tree(), name, received.receiver(), options);
        REQUIRE_FALSE(written);
        CHECK(written.status() == lsys::Status::Failed);
        CHECK(received.files.empty());
        return written.messages().all().front().message;
    };
    CHECK(text_of("a.stl", {{"preset", "web"}}) == "--preset web is for glb and gltf, not stl");
    CHECK(text_of("a.glb", {{"lod", "3"}}) == "unknown option `--lod=3`; did you mean `--lods`?");
    CHECK(text_of("a.glb", {{"lods", "many"}}).find("many") != std::string::npos);
    CHECK(text_of("a.glb", {{"grow", ""}}) == "--grow needs the number of its frames: --frames N");
    CHECK(text_of("a.xyz", {}).find("`a.xyz` has no extension of a known format") == 0);
}

TEST_CASE("a receiver can end a call, and its exceptions are rethrown") {
    const auto ended =
        lsys::write_plant(tree(), "a.glb", [](const lsys::FilePiece&) { return false; });
    REQUIRE_FALSE(ended);
    CHECK(ended.status() == lsys::Status::Cancelled);
    CHECK_THROWS_AS(
        lsys::write_plant(tree(), "a.glb",
                          [](const lsys::FilePiece&) -> bool { throw std::runtime_error("full"); }),
        std::runtime_error);
}

TEST_CASE("a forest of grammars has the trees of lsc forest") {
    lsys::ForestOptions options;
    options.scene = {{"count", "40"}, {"size", "60"}, {"heroes", "3"}, {"key", "5"}};
    const auto forest = lsys::grow_forest({"tree.lsys"}, options, tree_project());
    REQUIRE(forest);
    CHECK(forest->key() == 5);
    REQUIRE(forest->species().size() == 1);
    CHECK(forest->species()[0].name == "tree");
    CHECK(forest->species()[0].heroes == 3);
    CHECK(forest->species()[0].generations == std::vector<std::uint32_t>{4});
    REQUIRE(forest->trees().size() == 40);
    for (const lsys::Tree& each : forest->trees()) {
        CHECK(each.position.x >= 0.0F);
        CHECK(each.position.x <= 60.0F);
        CHECK(each.scale == 1.0F);
    }
    const auto refused = lsys::grow_forest({"tree.lsys"}, {{}, {{"placement", "rows"}}}, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.messages().all().front().message.find("rows") != std::string::npos);
}

TEST_CASE("instances are grouped by mesh, and draw every tree once") {
    lsys::ForestOptions options;
    options.scene = {{"count", "300"}, {"heroes", "2"}};
    const auto forest = lsys::grow_forest({"tree.lsys"}, options, tree_project());
    REQUIRE(forest);
    const lsys::ForestCounts counts = forest->count();
    std::vector<std::vector<lsys::Instance>> lists;
    for (const std::uint32_t threads : {1U, 4U}) {
        lsys::Project project = tree_project();
        project.threads = threads;
        const auto made = lsys::make_instances(*forest, {}, project);
        REQUIRE(made);
        const auto all = made->all();
        REQUIRE(all.size() == counts.branches);
        std::uint64_t next = 0;
        std::uint64_t segments = 0;
        for (const lsys::InstanceGroup& group : made->groups()) {
            CHECK(group.first_instance == next);
            REQUIRE(group.instance_count > 0);
            next += group.instance_count;
            REQUIRE(group.mesh < made->meshes().size());
            const auto& parts = made->meshes()[group.mesh].parts();
            REQUIRE(group.first_part + group.part_count <= parts.size());
            segments += group.part_count * group.instance_count;
        }
        CHECK(next == all.size());
        CHECK(segments > 0);
        std::vector<bool> has_tree(forest->trees().size());
        for (const lsys::Instance& instance : all) {
            has_tree[instance.tree] = true;
            const lsys::InstanceGroup& group = made->groups()[instance.group];
            const auto index = static_cast<std::uint64_t>(&instance - all.data());
            REQUIRE(index - group.first_instance < group.instance_count);
        }
        CHECK(std::count(has_tree.begin(), has_tree.end(), true) == 300);
        lists.emplace_back(all.begin(), all.end());
    }
    CHECK(std::memcmp(lists[0].data(), lists[1].data(), lists[0].size() * sizeof(lsys::Instance)) ==
          0);
}

TEST_CASE("matrices of instances are those of their places, in a buffer with a stride") {
    const std::array<lsys::Tree, 2> places{
        lsys::Tree{{1.0F, 2.0F, 3.0F}, 0.0F, 2.0F, 0, 0, 0},
        lsys::Tree{{-4.0F, 0.0F, 5.0F}, 1.57079633F, 0.5F, 1, 0, 0}};
    lsys::ForestOptions options;
    options.scene = {{"rho", "0"}, {"heroes", "1"}};
    const auto forest = lsys::forest_of_places({"tree.lsys"}, places, options, tree_project());
    REQUIRE(forest);
    CHECK(std::memcmp(forest->trees().data(), places.data(), sizeof(places)) == 0);
    const auto made = lsys::make_instances(*forest, {}, tree_project());
    REQUIRE(made);
    REQUIRE(made->all().size() == 2);
    struct Row {
        std::array<float, 16> matrix;
        std::uint32_t tag;
    };
    std::array<Row, 2> rows{Row{{}, 7}, Row{{}, 8}};
    made->read_matrices(0, 2, rows.data(), sizeof(Row));
    CHECK(rows[0].tag == 7);
    CHECK(rows[1].tag == 8);
    const auto plant = lsys::make_mesh(tree());
    REQUIRE(plant);
    CHECK(made->meshes()[0].positions().size() == plant->positions().size());
    // The whole hero is the plant, scaled, rotated about +Y, and translated.
    for (std::size_t i = 0; i < 2; ++i) {
        const std::array<float, 16>& m = rows[i].matrix;
        const lsys::Tree& place = places[made->all()[i].tree];
        const float cosine = std::cos(place.yaw) * place.scale;
        const float sine = std::sin(place.yaw) * place.scale;
        const std::array<float, 16> expected{cosine,
                                             0.0F,
                                             -sine,
                                             0.0F,
                                             0.0F,
                                             place.scale,
                                             0.0F,
                                             0.0F,
                                             sine,
                                             0.0F,
                                             cosine,
                                             0.0F,
                                             place.position.x,
                                             place.position.y,
                                             place.position.z,
                                             1.0F};
        for (std::size_t k = 0; k < 16; ++k) {
            CAPTURE(i, k);
            CHECK(m[k] == Approx(expected[k]).margin(1e-5));
        }
    }
}

TEST_CASE("trees at places sense their surroundings if the option says so") {
    // A mast with two arms, which stop in the shade of another mast.
    const std::string star =
        "#n = 6; #sense light shadow cell 1 levels 20 strength 0.1 ratio 1;"
        "#w : F(3) [ +(90) ?light(1,0,0,0,0) ] [ -(90) ?light(1,0,0,0,0) ] ?light(1,0,0,0);"
        "#arm : ?light(q,x,y,z,k) : k < 2 || q > 0.85 : F(1) ?light(0,0,0,0,k+1);"
        "#mast : ?light(q,x,y,z) : * : F(1) ?light(0,0,0,0);";
    lsys::Project project;
    project.host.read_file = [&star](const std::string&) {
        return lsys::FileContents{true, star, {}};
    };
    std::vector<lsys::Tree> places(3);
    places[1].position.x = 6.0F;
    places[2].position.x = 100.0F;
    lsys::ForestOptions options;
    options.scene = {{"rho", "0"}, {"heroes", "1"}};
    const auto ignored = lsys::forest_of_places({"star.lsys"}, places, options, project);
    options.scene.emplace_back("surroundings", "sensed");
    const auto sensed = lsys::forest_of_places({"star.lsys"}, places, options, project);
    REQUIRE(ignored);
    REQUIRE(sensed);
    CHECK(ignored->species()[0].generations.size() == 1);
    CHECK(sensed->species()[0].generations.size() == 6);
    CHECK(sensed->count().segments < ignored->count().segments);
}

TEST_CASE("invalid places are refused") {
    const auto text_of = [](const lsys::Tree& place) {
        const auto forest = lsys::forest_of_places({"tree.lsys"}, {&place, 1}, {}, tree_project());
        REQUIRE_FALSE(forest);
        return forest.messages().all().front().message;
    };
    lsys::Tree place;
    place.species = 1;
    CHECK(text_of(place) == "place 0 is of species 1, and there are 1 grammars");
    place = {};
    place.scale = 0.0F;
    CHECK(text_of(place) == "the scale of place 0 is 0, which is not above 0");
    place = {};
    place.position.y = std::nanf("");
    CHECK(text_of(place) == "place 0 has a position or yaw that is not finite");
    CHECK(lsys::forest_of_places({"tree.lsys"}, {}, {}, tree_project()));
    CHECK_FALSE(lsys::grow_forest({}, {}, tree_project()));
}

TEST_CASE("a forest is saved with its preset, baked, as statistics and in frames") {
    lsys::ForestOptions options;
    options.scene = {{"count", "9"}, {"heroes", "2"}};
    const auto forest = lsys::grow_forest({"tree.lsys"}, options, tree_project());
    REQUIRE(forest);
    for (const lsys::Options& files :
         {lsys::Options{{"preset", "web"}}, lsys::Options{{"preset", "unreal"}}, lsys::Options{}}) {
        Received received;
        const auto written =
            lsys::write_forest(*forest, "wood.glb", received.receiver(), files, tree_project());
        REQUIRE(written);
        CHECK(*written == std::vector<std::string>{"wood.glb"});
        CHECK(received.files["wood.glb"].starts_with("glTF"));
    }
    Received baked;
    REQUIRE(
        lsys::write_forest(*forest, "wood.obj", baked.receiver(), {{"bake", ""}}, tree_project()));
    CHECK(baked.files.contains("wood.mtl"));
    Received counts;
    REQUIRE(lsys::write_forest(*forest, "wood.json", counts.receiver(), {}, tree_project()));
    CHECK(counts.files["wood.json"].find("\"trees\":9") != std::string::npos);
    const auto still = lsys::write_forest(*forest, "wood.glb", counts.receiver(), {{"frames", "3"}},
                                          tree_project());
    REQUIRE_FALSE(still);
    CHECK(still.messages().all().back().message ==
          "frames show a forest that grows, which is placed by domination or has several stages");
    options.scene.push_back({"stages", "2,4"});
    const auto growing = lsys::grow_forest({"tree.lsys"}, options, tree_project());
    REQUIRE(growing);
    Received frames;
    REQUIRE(lsys::write_forest(*growing, "wood.glb", frames.receiver(), {{"frames", "2"}},
                               tree_project()));
    CHECK(frames.complete == std::vector<std::string>{"wood.0001.glb", "wood.0002.glb"});
    const auto ground = lsys::make_ground(*forest, tree_project());
    REQUIRE(ground);
    CHECK(ground->index_count() > 0);
}

TEST_CASE("forests and files of the C interface") {
    const Folder folder;
    std::ofstream(folder / "tree.lsys") << kTree;
    const std::string path = folder / "tree.lsys";
    const std::array<const char*, 1> files{path.c_str()};
    const std::array<lsys_option, 2> scene{lsys_option{"count", "12"}, lsys_option{"heroes", "2"}};
    lsys_forest* forest = nullptr;
    lsys_messages* messages = nullptr;
    REQUIRE(lsys_grow_forest(files.data(), 1, nullptr, scene.data(), scene.size(), nullptr, &forest,
                             &messages) == LSYS_OK);
    lsys_messages_free(messages);
    CHECK(lsys_forest_tree_count(forest) == 12);
    lsys_instances* instances = nullptr;
    REQUIRE(lsys_make_instances(forest, 5, nullptr, &instances, nullptr) == LSYS_OK);
    REQUIRE(lsys_instances_count(instances) >= 12);
    const lsys_instance_group* groups = lsys_instances_groups(instances);
    const lsys_instance_group& last = groups[lsys_instances_group_count(instances) - 1];
    CHECK(last.first_instance + last.instance_count == lsys_instances_count(instances));
    CHECK(lsys_instances_all(instances)[0].group == 0);
    lsys_mesh* mesh = lsys_instances_mesh(instances, last.mesh);
    REQUIRE(mesh != nullptr);
    CHECK(lsys_mesh_vertex_count(mesh) > 0);
    std::array<float, 16> matrix{};
    lsys_instances_read_matrices(instances, 0, 1, matrix.data(), 0);
    CHECK(matrix[15] == 1.0F);
    lsys_instances_free(instances);
    CHECK(lsys_mesh_part_count(mesh) > 0); // the mesh does not depend on the freed instances
    lsys_mesh_free(mesh);

    const auto receive = [](void* user, const char* name, const char* bytes, size_t size, int) {
        (*static_cast<std::map<std::string, std::string>*>(user))[name].append(bytes, size);
        return 0;
    };
    std::map<std::string, std::string> received;
    const lsys_option expand{"expand", ""};
    CHECK(lsys_write_forest(forest, "a.gltf", &expand, 1, receive, &received, nullptr, nullptr) ==
          LSYS_OK);
    CHECK(received["a.gltf"].find("\"asset\"") != std::string::npos);
    CHECK(lsys_save_forest(forest, (folder / "a.stl").c_str(), nullptr, 0, nullptr, &messages) ==
          LSYS_FAILED);
    CHECK(lsys_messages_count(messages) == 1);
    lsys_messages_free(messages);
    lsys_forest_free(forest);

    lsys_grammar* grammar = nullptr;
    lsys_plant* plant = nullptr;
    REQUIRE(lsys_compile_file(path.c_str(), nullptr, nullptr, &grammar, nullptr) == LSYS_OK);
    REQUIRE(lsys_grow(grammar, -1, nullptr, nullptr, &plant, nullptr) == LSYS_OK);
    const lsys_option godot{"preset", "godot"};
    CHECK(lsys_save_plant(plant, (folder / "b.glb").c_str(), &godot, 1, nullptr, nullptr) ==
          LSYS_OK);
    CHECK(std::filesystem::exists(folder / "b.LOD0.glb"));
    const auto stop = [](void*, const char*, const char*, size_t, int) { return 1; };
    CHECK(lsys_write_plant(plant, "b.glb", nullptr, 0, stop, nullptr, nullptr, nullptr) ==
          LSYS_CANCELLED);
    lsys_plant_free(plant);
    lsys_grammar_free(grammar);
    lsys_forest_free(nullptr);
    lsys_instances_free(nullptr);
}
