// SPDX-License-Identifier: MIT
// Tests `lsc check --fix`: one token or character of a correct grammar is changed, as by a typing
// mistake, and the result is repaired. If the repaired text compiles, it must be the original
// grammar; if more than one repair is possible, none may be applied.
#include "compiler/program/program_dump.h"
#include "grammar/format/impl/lexemes.h"
#include "runtime/base/random.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/host.h"
#include "runtime/repair/fixes.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace lsys;
namespace fs = std::filesystem;

/// Larger files are skipped: they are slow and have no additional kinds of statements.
constexpr std::uintmax_t kMaxFileBytes = 4000;

struct Compiled {
    bool has_errors = true;
    bool has_certain_fix = false;
    std::string program; // dump of the program, if the grammar has no errors
};

/// A project that reads files from disk.
Project disk_project() {
    return {make_file_host(nullptr), {}, 1, {}};
}

std::string program_text(const Grammar& grammar) {
    return grammar.program ? dump_without_labels(*grammar.program, grammar.names) : std::string();
}

Compiled compile(const std::string& path, const std::string& text) {
    const Project project = disk_project();
    const Result<CompiledText> made =
        compile_text(path, {text, Dialect::Lsys}, {}, project.limits.max_modules,
                     make_loader(project, project.limits.max_bytes));
    REQUIRE(made);
    const Diagnostics& diagnostics = made.value().diagnostics;
    Compiled compiled;
    compiled.has_errors = diagnostics.has_errors();
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        for (const Fix& fix : diagnostic.fixes) {
            compiled.has_certain_fix = compiled.has_certain_fix || fix.machine_applicable;
        }
    }
    compiled.program = compiled.has_errors ? std::string() : program_text(made.value().grammar);
    return compiled;
}

struct RightGrammar {
    std::string path;
    std::string text;
    std::string program;
};

/// The grammars of `folders` without errors.
std::vector<RightGrammar> right_grammars_in(const std::vector<std::string>& folders) {
    std::vector<std::string> paths;
    for (const std::string& folder : folders) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const std::string path = entry.path().string();
            if (entry.is_regular_file() && path.ends_with(".lsys") &&
                path.find("/runner/") == path.npos && entry.file_size() <= kMaxFileBytes) {
                paths.push_back(path);
            }
        }
    }
    std::sort(paths.begin(), paths.end());
    std::vector<RightGrammar> grammars;
    for (const std::string& path : paths) {
        std::string text = tests::read_text(path);
        Compiled compiled = compile(path, text);
        if (!compiled.has_errors) {
            grammars.push_back({path, std::move(text), std::move(compiled.program)});
        }
    }
    return grammars;
}

/// Samples and golden cases without errors.
std::vector<RightGrammar> right_grammars() {
    return right_grammars_in({LSYS_SOURCE_DIR "/samples", LSYS_SOURCE_DIR "/tests/ui"});
}

/// A correct grammar with one token or character changed.
struct Mutant {
    std::string kind; // such as "`;` removed"
    std::string text;
};

class Mutants {
public:
    explicit Mutants(const std::string& text) : text_(text), lexemes_(lexemes_of(text)) {}

    std::vector<Mutant> all() {
        for (const Lexeme& lexeme : lexemes_) {
            const bool is_ascii = std::none_of(lexeme.text.begin(), lexeme.text.end(), [](char c) {
                return (static_cast<unsigned char>(c) & 0x80u) != 0;
            });
            if (!is_comment(lexeme) && is_ascii) {
                add_mutants(lexeme);
            }
        }
        return std::move(mutants_);
    }

private:
    void replace(std::string kind, const Lexeme& lexeme, const std::string& replacement) {
        std::string mutant = text_;
        const auto at = static_cast<std::size_t>(lexeme.text.data() - text_.data());
        mutant.replace(at, lexeme.text.size(), replacement);
        mutants_.push_back({std::move(kind), std::move(mutant)});
    }

    void exchange(const Lexeme& lexeme, const char* signs) {
        for (const char* sign = signs; *sign != '\0'; ++sign) {
            replace("`" + std::string(lexeme.text) + "` typed as `" + *sign + "`", lexeme,
                    std::string(1, *sign));
        }
    }

    void add_mutants(const Lexeme& lexeme) {
        const std::string token(lexeme.text);
        if (token.size() == 1 && std::string_view(";:()[],{}").find(token) != token.npos) {
            replace("`" + token + "` removed", lexeme, "");
            replace("`" + token + "` doubled", lexeme, token + token);
        }
        const std::map<std::string, const char*> exchanged{{";", ":,"}, {":", ";,"}, {"(", "[{"},
                                                           {")", "]}"}, {"[", "("},  {"]", ")"},
                                                           {",", ";:."}};
        if (const auto found = exchanged.find(token); found != exchanged.end()) {
            exchange(lexeme, found->second);
        }
        if (token == "==") {
            replace("`==` typed as `=`", lexeme, "=");
        }
        if (lexeme.kind == LexemeKind::Keyword) {
            replace("`#` removed", lexeme, token.substr(1));
            replace("blank after `#`", lexeme, "# " + token.substr(1));
        }
        if (lexeme.kind == LexemeKind::Operator || lexeme.kind == LexemeKind::Number) {
            replace("operator or number doubled", lexeme, token + " " + token);
            replace("operator or number removed", lexeme, "");
        }
        for (std::size_t i = 0; i + 1 < token.size(); ++i) {
            const auto is_letter = [](char c) {
                return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
            };
            if (is_letter(token[i]) && is_letter(token[i + 1]) && token[i] != token[i + 1]) {
                std::string swapped = token;
                std::swap(swapped[i], swapped[i + 1]);
                replace("letters swapped", lexeme, swapped);
            }
        }
    }

    const std::string& text_;
    std::vector<Lexeme> lexemes_;
    std::vector<Mutant> mutants_;
};

/// The `number`-th change of one character of a grammar, equal in every run. Characters of comments
/// stay, because the compiler does not read them.
Mutant character_mutant(const RightGrammar& grammar, std::uint64_t number) {
    std::uint32_t draw = 0;
    const auto below = [&](std::size_t bound) {
        const PhiloxBlock block =
            philox4x32({static_cast<std::uint32_t>(number), draw++, 0, 0}, {7, 0});
        return static_cast<std::size_t>(block[0]) % bound;
    };
    std::vector<bool> is_comment_at(grammar.text.size() + 1, false);
    for (const Lexeme& lexeme : lexemes_of(grammar.text)) {
        const auto at = static_cast<std::size_t>(lexeme.text.data() - grammar.text.data());
        for (std::size_t i = 0; is_comment(lexeme) && i < lexeme.text.size(); ++i) {
            is_comment_at[at + i] = true;
        }
    }
    std::size_t at = 0;
    do {
        at = below(grammar.text.size());
    } while (is_comment_at[at]);
    // A character that occurs in the file, as in likely mistakes, or any printable one.
    const char other = below(2) == 0 ? grammar.text[below(grammar.text.size())]
                                     : static_cast<char>(' ' + below('~' - ' ' + 1));
    Mutant mutant{"", grammar.text};
    switch (below(4)) {
    case 0:
        mutant.kind = "character inserted";
        mutant.text.insert(at, 1, other);
        break;
    case 1:
        mutant.kind = "character removed";
        mutant.text.erase(at, 1);
        break;
    case 2:
        mutant.kind = "character replaced";
        // `;;` may be `L;` with a wrong character, or a doubled `;`, which a fix removes.
        if (at + 1 == mutant.text.size() || mutant.text[at + 1] != other) {
            mutant.text[at] = other;
        }
        break;
    default:
        mutant.kind = "characters exchanged";
        if (at + 1 < mutant.text.size()) {
            std::swap(mutant.text[at], mutant.text[at + 1]);
        }
        break;
    }
    return mutant;
}

struct Count {
    std::uint32_t tried = 0;
    std::uint32_t right = 0;      // repaired to the original grammar
    std::uint32_t wrong = 0;      // repaired to another grammar
    std::uint32_t unfinished = 0; // repaired in part: errors are left
};

class Census {
public:
    explicit Census(bool keeps_all) : keeps_all_(keeps_all) {}

    void run(const RightGrammar& grammar, const Mutant& mutant) {
        const Compiled broken = compile(grammar.path, mutant.text);
        if (!broken.has_errors && !broken.has_certain_fix) {
            return; // the change made another correct grammar
        }
        Count& count = counts_[mutant.kind];
        ++count.tried;
        if (!broken.has_certain_fix) {
            return;
        }
        repair::FixedGrammar fixed;
        const Result<void> done = repair::fix_text(
            grammar.path, {mutant.text, Dialect::Lsys}, {}, repair::FixScope(grammar.path, {}),
            disk_project(), repair::FixChoice::Certain, fixed);
        REQUIRE(done);
        if (fixed.fix_count == 0) {
            keep("lost", grammar, mutant, fixed);
            return;
        }
        if (fixed.compiled.diagnostics.has_errors()) {
            ++count.unfinished;
            keep("unfinished", grammar, mutant, fixed);
        } else if (const std::string program = program_text(fixed.compiled.grammar);
                   program == grammar.program || program == broken.program) {
            ++count.right; // the original grammar, or another correct one that the change made
        } else {
            ++count.wrong;
            keep("wrong", grammar, mutant, fixed);
        }
    }

    [[nodiscard]] Count count(const std::string& kind) const {
        const auto found = counts_.find(kind);
        return found == counts_.end() ? Count() : found->second;
    }
    [[nodiscard]] Count total() const {
        Count sum;
        for (const auto& [kind, count] : counts_) {
            sum.tried += count.tried;
            sum.right += count.right;
            sum.wrong += count.wrong;
            sum.unfinished += count.unfinished;
        }
        return sum;
    }

    [[nodiscard]] std::string table() const {
        std::string out;
        const auto row = [&](const std::string& kind, const Count& count) {
            char line[128];
            std::snprintf(line, sizeof line, "%-28s %6u %6u %6u %6u\n", kind.c_str(), count.tried,
                          count.right, count.wrong, count.unfinished);
            out += line;
        };
        out += "mutation                      tried  right  wrong  errors left\n";
        for (const auto& [kind, count] : counts_) {
            row(kind, count);
        }
        row("all", total());
        return out;
    }
    [[nodiscard]] const std::string& kept() const { return kept_; }

private:
    void keep(const char* what,
              const RightGrammar& grammar,
              const Mutant& mutant,
              const repair::FixedGrammar& fixed) {
        if (!keeps_all_ && (kept_.size() > 4000 || std::string_view(what) == "lost")) {
            return;
        }
        kept_ += std::string(what) + ", " + mutant.kind + ", " + grammar.path + "\n";
        const auto first_line = [&](const std::string& a, const std::string& b) {
            std::istringstream left(a);
            std::istringstream right(b);
            std::string line;
            for (std::string other; std::getline(left, line);) {
                if (!std::getline(right, other) || other != line) {
                    break;
                }
            }
            return line;
        };
        kept_ += "    was  " + first_line(grammar.text, mutant.text) + "\n";
        kept_ += "    made " + first_line(mutant.text, grammar.text) + "\n";
        for (const std::string& line : fixed.lines) {
            kept_ += "    " + line.substr(line.rfind('/') + 1) + "\n";
        }
    }

    bool keeps_all_;                      // else kept_ ends at about 4000 bytes
    std::map<std::string, Count> counts_; // by kind of mutant
    std::string kept_;                    // texts about mutants without the right repair
};

/// Repairs the mutants `first` to `end` - 1; each is made from the next sample, in turn.
void check_characters(Census& census, std::uint64_t first, std::uint64_t end) {
    const std::vector<RightGrammar> grammars = right_grammars_in({LSYS_SOURCE_DIR "/samples"});
    REQUIRE(!grammars.empty());
    for (std::uint64_t number = first; number < end; ++number) {
        const RightGrammar& grammar = grammars[number % grammars.size()];
        census.run(grammar, character_mutant(grammar, number));
    }
}

} // namespace

TEST_CASE("a repaired grammar equals the original") {
    // Test one of kMutantsPerTested mutants, the same ones in every run.
    constexpr std::uint64_t kMutantsPerTested = 16;
    Census census(false);
    std::uint64_t number = 0;
    for (const RightGrammar& grammar : right_grammars()) {
        for (const Mutant& mutant : Mutants(grammar.text).all()) {
            if (++number % kMutantsPerTested == 0) {
                census.run(grammar, mutant);
            }
        }
    }
    INFO(census.table() << census.kept());
    CHECK(census.total().wrong == 0);
    CHECK(census.total().unfinished == 0);
    // Most of these mutants have one plausible repair. Others have two: the character before a
    // missing `;` may be a mistyped `;`, for example the last digit of a number, and the second `)`
    // after a digit may be a mistyped digit.
    struct Repaired {
        const char* kind;
        std::uint32_t least_tenths;
    };
    for (const Repaired& wanted :
         {Repaired{"`;` removed", 6}, Repaired{"`;` doubled", 9}, Repaired{"`#` removed", 9},
          Repaired{"blank after `#`", 9}, Repaired{"`:` doubled", 9}, Repaired{"`)` doubled", 4}}) {
        const Count count = census.count(wanted.kind);
        INFO(wanted.kind);
        CHECK(count.tried > 0);
        CHECK(10 * count.right >= wanted.least_tenths * count.tried);
    }
}

TEST_CASE("a repaired character is the one that was meant") {
    constexpr std::uint64_t kMutants = 800;
    Census census(false);
    check_characters(census, 0, kMutants);
    INFO(census.table() << census.kept());
    CHECK(census.total().right > 0);
    CHECK(census.total().wrong == 0);
    CHECK(census.total().unfinished == 0);
}

// LSYS_MUTANTS is `FIRST-LAST`: the numbers of the mutants to test instead of the first 10,000.
TEST_CASE("all mutants of one character", "[.]") {
    const char* const range_text = std::getenv("LSYS_MUTANTS");
    unsigned long long first = 0;
    unsigned long long last = 9999;
    if (range_text != nullptr) {
        REQUIRE(std::sscanf(range_text, "%llu-%llu", &first, &last) == 2);
    }
    REQUIRE(first <= last);
    Census census(true);
    check_characters(census, first, last + 1);
    std::printf("%s%s", census.kept().c_str(), census.table().c_str());
    CHECK(census.total().wrong == 0);
    CHECK(census.total().unfinished == 0);
}

TEST_CASE("all mutants", "[.]") {
    Census census(true);
    for (const RightGrammar& grammar : right_grammars()) {
        for (const Mutant& mutant : Mutants(grammar.text).all()) {
            census.run(grammar, mutant);
        }
    }
    std::printf("%s%s", census.kept().c_str(), census.table().c_str());
    CHECK(census.total().wrong == 0);
    CHECK(census.total().unfinished == 0);
}
