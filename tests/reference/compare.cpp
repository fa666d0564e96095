// SPDX-License-Identifier: MIT
#include "tests/reference/compare.h"

#include "grammar/base/paths.h"
#include "runtime/cli/lsc.h"
#include "runtime/platform/process.h"
#include "tests/reference/mesh_file.h"
#include "tests/reference/print.h"
#include "tests/reference/spelling.h"
#include "tests/support/png_file.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>

namespace lsys::reference {

namespace {

std::string number_text(float value) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, end.ptr);
}

// The number as messages write it: `1,140`.
std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t end = text.size(); end > 3; end -= 3) {
        text.insert(end - 3, ",");
    }
    return text;
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string png_text(const PictureFile& picture) {
    static constexpr int kColours[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                       PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    std::vector<std::uint8_t> samples;
    for (const std::uint16_t sample : picture.samples) {
        if (picture.depth == 16) {
            samples.push_back(static_cast<std::uint8_t>(sample >> 8U));
        }
        samples.push_back(static_cast<std::uint8_t>(sample));
    }
    return test::png_of(static_cast<std::uint32_t>(picture.columns),
                        static_cast<std::uint32_t>(picture.rows),
                        {static_cast<int>(picture.depth), kColours[picture.channels - 1]}, samples);
}

std::string joined(const std::vector<std::string>& words) {
    std::string text = "lsc";
    for (const std::string& word : words) {
        text += " " + word;
    }
    return text;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

// The first place where two texts differ, with the text around it.
std::string first_difference(const std::string& expected, const std::string& found) {
    const std::vector<std::string> expected_lines = lines_of(expected);
    const std::vector<std::string> found_lines = lines_of(found);
    for (std::size_t line = 0; line < std::max(expected_lines.size(), found_lines.size()); ++line) {
        const std::string a =
            line < expected_lines.size() ? expected_lines[line] : "(no such line)";
        const std::string b = line < found_lines.size() ? found_lines[line] : "(no such line)";
        if (a == b) {
            continue;
        }
        std::size_t at = 0;
        while (at < a.size() && at < b.size() && a[at] == b[at]) {
            ++at;
        }
        const std::size_t from = at > 60 ? at - 60 : 0;
        return "line " + std::to_string(line) + ", character " + std::to_string(at) +
               "\n  oracle: " + a.substr(from, 200) + "\n  lsc:    " + b.substr(from, 200) + "\n";
    }
    return "only the ends of lines differ\n";
}

// Whether a word can be an axiom: it is not empty, its brackets match, and no polygon lies within
// another polygon.
bool can_be_an_axiom(const Word& word) {
    int branches = 0;
    int polygons = 0;
    for (const Module& module : word) {
        branches += module.name == "[" ? 1 : module.name == "]" ? -1 : 0;
        polygons += module.name == "{" ? 1 : module.name == "}" ? -1 : 0;
        if (branches < 0 || polygons < 0 || polygons > 1) {
            return false;
        }
    }
    return !word.empty() && polygons == 0;
}

// Compares one case, whose files are in one folder, in several ways.
class Comparison {
public:
    Comparison(const Case& test_case, Derivation derivation)
        : test_case_(test_case), derivation_(std::move(derivation)),
          expected_(all_generations(test_case.grammar, derivation_)),
          file_(folder_.write(test_case.grammar, test_case.layout_seed)) {}

    std::string run() {
        const bool good = derivation_.error ? stops_alike() : derives_alike();
        return good ? "" : report_;
    }

    std::string run_plant() {
        const bool good = derivation_.error
                              ? stops_alike()
                              : derives_with_threads({"1", "2", "5"}) && compiles_alike() &&
                                    resumes_alike() && has_its_origins();
        return good ? "" : report_;
    }

private:
    std::vector<std::string> command(const std::string& name,
                                     const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {name, file_};
        const std::vector<std::string> options = options_of(test_case_.request);
        arguments.insert(arguments.end(), options.begin(), options.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    // Runs lsc. Checks its exit status and standard output.
    bool lsc_prints(const std::vector<std::string>& arguments, int status, const std::string& out) {
        const Run run = run_lsc(arguments);
        if (run.status == status && run.out == out) {
            return true;
        }
        std::string what =
            run.status != status ? "status " + std::to_string(run.status) + "\n" : "";
        what += run.out != out ? first_difference(out, run.out) : "";
        return fails(arguments, what + (run.status == status ? "" : run.err));
    }

    bool fails(const std::vector<std::string>& arguments, const std::string& what) {
        report_ = joined(arguments) + "\n" + what + "\n";
        for (const TextFile& file : print_grammar(test_case_.grammar, test_case_.layout_seed)) {
            report_ += "---- " + file.path + "\n" + file.text + "\n";
        }
        report_ += "---- without layout\n";
        for (const TextFile& file : print_grammar(test_case_.grammar, 0)) {
            report_ += "---- " + file.path + "\n" + file.text + "\n";
        }
        return false;
    }

    bool derives_with_threads(const std::vector<std::string>& counts) {
        return std::all_of(counts.begin(), counts.end(), [&](const std::string& threads) {
            return lsc_prints(command("dump", {"--all", "--threads", threads}), 0, expected_);
        });
    }

    // Saves the state of the middle generation, and checks every generation continued from it.
    bool resumes_alike() {
        const std::uint32_t half = derivation_.generations / 2;
        const std::string state = (folder_.path() / "half.state").string();
        const std::vector<std::string> lines = lines_of(expected_);
        std::string rest;
        for (std::size_t i = half; i < lines.size(); ++i) {
            rest += lines[i] + "\n";
        }
        return lsc_prints(command("dump", {"--steps", std::to_string(half), "--save-state", state}),
                          0, lines[half] + "\n") &&
               lsc_prints(command("dump", {"--all", "--from", state, "--threads", "5"}), 0, rest);
    }

    // A module keeps its origin when it is sensed.
    bool has_its_origins() {
        return lsc_prints(command("dump", {"--all", "--origins"}), 0,
                          all_origins(test_case_, derivation_, folder_.path(), 0, std::nullopt));
    }

    bool derives_alike() {
        const std::string last = lines_of(expected_).back() + "\n";
        const std::string count = std::to_string(derivation_.words.back().size()) + "\n";
        return derives_with_threads({"1", "2"}) && lsc_prints(command("dump", {}), 0, last) &&
               lsc_prints(command("dump", {"--count"}), 0, count) && compiles_alike() &&
               continues_alike() && origins_alike() && printed_word_parses();
    }

    // Checks the origins of all modules in derivations with one thread and with two threads,
    // streamed, from bytecode, and from a saved state.
    bool origins_alike() {
        const std::filesystem::path& folder = folder_.path();
        const std::string all = all_origins(test_case_, derivation_, folder, 0, std::nullopt);
        const std::string last =
            all_origins(test_case_, derivation_, folder, derivation_.generations, std::nullopt);
        const std::string body = last.substr(last.find('\n') + 1);
        const std::uint32_t half = derivation_.generations / 2;
        const std::string state = (folder / "half.state").string(); // written by continues_alike()
        return lsc_prints(command("dump", {"--all", "--origins", "--threads", "1"}), 0, all) &&
               lsc_prints(command("dump", {"--all", "--origins", "--threads", "2"}), 0, all) &&
               lsc_prints(command("dump", {"--origins"}), 0, body) &&
               (!can_stream() || lsc_prints(command("dump", {"--origins", "--stream"}), 0, body)) &&
               // A compiled grammar has names of files relative to the grammar.
               lsc_prints(compiled_dump({"--all", "--origins"}), 0,
                          all_origins(test_case_, derivation_, {}, 0, std::nullopt)) &&
               lsc_prints(command("dump", {"--all", "--origins", "--from", state}), 0,
                          all_origins(test_case_, derivation_, folder, half, half));
    }

    [[nodiscard]] bool can_stream() const {
        bool contexts = false;
        for (const Statement* statement : statements_in_order(test_case_.grammar)) {
            const Production& production = statement->production;
            contexts = contexts || production.left || production.right;
        }
        return !contexts && !sweeps() &&
               setting(test_case_.grammar, "rewriting").value_or("parallel") == "parallel";
    }

    [[nodiscard]] bool sweeps() const {
        const std::vector<const Statement*> statements = statements_in_order(test_case_.grammar);
        return std::any_of(statements.begin(), statements.end(), [](const Statement* statement) {
            const Stage stage = statement->production.stage;
            return stage == Stage::Down || stage == Stage::Up;
        });
    }

    // A file beside the grammar, because bytecode names files relative to its own folder.
    [[nodiscard]] std::string compiled_file() const {
        return (std::filesystem::path(file_).parent_path() / "out.lsb").string();
    }

    // Command line that dumps the bytecode file made by compiles_alike().
    [[nodiscard]] std::vector<std::string>
    compiled_dump(const std::vector<std::string>& more) const {
        Request rest = test_case_.request;
        rest.definitions.clear();
        std::vector<std::string> dump = {"dump", compiled_file()};
        const std::vector<std::string> options = options_of(rest);
        dump.insert(dump.end(), options.begin(), options.end());
        dump.insert(dump.end(), more.begin(), more.end());
        return dump;
    }

    // Checks a run that must fail: the message names production, generation and place, and the
    // output contains no wrong word.
    bool stops_alike() {
        const RunError& error = *derivation_.error;
        const std::vector<std::string> arguments = command("dump", {"--all"});
        const Run run = run_lsc(arguments);
        if (run.status != 1) {
            return fails(arguments,
                         "status " + std::to_string(run.status) + ", expected 1\n" + run.err);
        }
        if (expected_.compare(0, run.out.size(), run.out) != 0) {
            return fails(arguments, first_difference(expected_, run.out) + run.err);
        }
        std::vector<std::string> facts = {"generation " + std::to_string(error.generation),
                                          grouped(error.position)};
        if (!error.production.empty()) {
            facts.push_back("`" + error.production + "`");
        }
        for (const std::string& fact : facts) {
            if (run.err.find(fact) == std::string::npos) {
                return fails(arguments, "the message does not say " + fact + ":\n" + run.err);
            }
        }
        return true;
    }

    bool compiles_alike() {
        Request definitions_only;
        definitions_only.definitions = test_case_.request.definitions;
        std::vector<std::string> compile = {"compile", file_, "-o", compiled_file()};
        const std::vector<std::string> options = options_of(definitions_only);
        compile.insert(compile.end(), options.begin(), options.end());
        return lsc_prints(compile, 0, "") && lsc_prints(compiled_dump({"--all"}), 0, expected_);
    }

    // Checks a derivation in two runs: the first half of the generations, a saved state, then the
    // second half.
    bool continues_alike() {
        const std::uint32_t half = derivation_.generations / 2;
        const std::string state = (folder_.path() / "half.state").string();
        const std::vector<std::string> lines = lines_of(expected_);
        const std::string asked = std::to_string(derivation_.generations);
        std::vector<std::string> first =
            command("dump", {"--steps", std::to_string(half), "--save-state", state});
        std::vector<std::string> second = command("dump", {"--from", state});
        return lsc_prints(first, 0, lines[half] + "\n") &&
               lsc_prints(second, 0, lines.back() + "\n");
    }

    // "What is printed parses again as the axiom of the same file."
    bool printed_word_parses() {
        const Word& word = derivation_.words[derivation_.words.size() / 2];
        // An axiom is decomposed. If decomposition stopped at the depth limit, the word would be
        // decomposed further; and a sweep would change its parameters again.
        const bool settled = !setting(test_case_.grammar, "decompose_depth") && !sweeps();
        if (!settled || !can_be_an_axiom(word)) {
            return true;
        }
        Case again = test_case_;
        again.request.generations = 0;
        for (File& file : again.grammar.files) {
            std::erase_if(file.statements, [](const Statement& statement) {
                return statement.kind == StatementKind::Axiom;
            });
        }
        const std::string text = print_word(word, test_case_.grammar.files[0].letters);
        const std::string path = folder_.write(again.grammar, 0);
        std::ofstream(path, std::ios::app | std::ios::binary) << "\n#w :" << text << ";\n";
        return lsc_prints(with_file(options_of(again.request), path), 0, text + "\n");
    }

    static std::vector<std::string> with_file(std::vector<std::string> options,
                                              const std::string& path) {
        options.insert(options.begin(), {"dump", path});
        return options;
    }

    const Case& test_case_;
    TemporaryFolder folder_;
    Derivation derivation_;
    std::string expected_;
    std::string file_;
    std::string report_;
};

} // namespace

Run run_lsc(const std::vector<std::string>& arguments) {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    Run run;
    run.status = lsc::run(arguments, Io{in, out, err, false});
    run.out = out.str();
    run.err = err.str();
    return run;
}

TemporaryFolder::TemporaryFolder() {
    static std::atomic<int> number{0};
    path_ = std::filesystem::temp_directory_path() /
            ("lsys-reference-" + std::to_string(platform::process_id()) + "-" +
             std::to_string(++number));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const Grammar& grammar, std::uint64_t layout_seed) const {
    const std::vector<TextFile> files = print_grammar(grammar, layout_seed);
    for (const TextFile& file : files) {
        write_file(path_ / file.path, file.text);
    }
    for (const MeshFile& mesh : grammar.meshes) {
        write_file(path_ / mesh.path, obj_text(mesh));
    }
    for (const PictureFile& picture : grammar.pictures) {
        write_file(path_ / picture.path, png_text(picture));
    }
    return path_text(path_ / files[0].path);
}

std::vector<std::string> options_of(const Request& request) {
    std::vector<std::string> options;
    if (request.generations) {
        options.insert(options.end(), {"-n", std::to_string(*request.generations)});
    }
    if (request.seed) {
        options.insert(options.end(), {"--seed", std::to_string(*request.seed)});
    }
    for (const auto& [name, value] : request.definitions) {
        options.insert(options.end(), {"-D", name + "=" + number_text(value)});
    }
    for (const std::string& name : request.programs) {
        options.insert(options.end(), {"--environment", name + "=" LSYS_ANSWERING_PROGRAM});
    }
    return options;
}

std::string all_generations(const Grammar& grammar, const Derivation& derivation) {
    std::string text;
    for (const Word& word : derivation.words) {
        text += print_word(word, grammar.files[0].letters) + "\n";
    }
    return text;
}

std::string all_origins(const Case& test_case,
                        const Derivation& derivation,
                        const std::filesystem::path& folder,
                        std::uint32_t first,
                        std::optional<std::uint32_t> saved) {
    const std::filesystem::path home =
        std::filesystem::path(test_case.grammar.files[0].path).parent_path();
    std::map<const ModuleUse*, std::string> places;
    for (const TextFile& file : print_grammar(test_case.grammar, test_case.layout_seed)) {
        for (const WrittenModule& written : file.modules) {
            const std::filesystem::path shown = file.shown;
            const std::filesystem::path path =
                folder.empty() && !home.empty() ? shown.lexically_relative(home) : folder / shown;
            places[written.module] = path.generic_string() + ":" + std::to_string(written.line) +
                                     ":" + std::to_string(written.column);
        }
    }
    std::string text;
    for (std::size_t i = first; i < derivation.words.size(); ++i) {
        text += "generation " + std::to_string(i) + ":\n";
        for (const Module& module : derivation.words[i]) {
            const Origin& origin = module.origin;
            text += print_word({module}, test_case.grammar.files[0].letters);
            if (saved && origin.generation <= *saved) {
                text += " origin unknown, in the saved state of generation " +
                        std::to_string(*saved) + "\n";
                continue;
            }
            text += " from " + (origin.production.empty() ? "the axiom" : origin.production) +
                    " at " + places.at(origin.written) + ", generation " +
                    std::to_string(origin.generation) + "\n";
        }
    }
    return text;
}

std::string difference(const Case& test_case) {
    return Comparison(test_case, derive(test_case.grammar, test_case.request)).run();
}

std::string difference_of_plant(const Case& test_case, const Derivation& derivation) {
    return Comparison(test_case, derivation).run_plant();
}

} // namespace lsys::reference
