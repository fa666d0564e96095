// SPDX-License-Identifier: MIT
// Derives a grammar in every way that must give the same result: from its text and from its .lsb
// file, formatted, with one thread and with three, in chunks of a few modules, with folded modules,
// streamed, and continued from a saved state; then draws and meshes the word, stored and streamed.
// At a difference it prints what differs, and the grammar, and aborts.
#include "compiler/bytecode/module_file.h"
#include "grammar/base/source.h"
#include "grammar/format/format.h"
#include "runtime/derive/fold_reached.h"
#include "runtime/derive/state_file.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word_text.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/user_mesh.h"
#include "runtime/turtle/turtle.h"
#include "tests/fuzz/compiled.h"
#include "tests/fuzz/small_derivation.h"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// What a derivation gives: the word, or the error with its place.
struct Result {
    std::optional<lsys::Stop> stop;
    std::string text;

    friend bool operator==(const Result&, const Result&) = default;
};

std::string text_of(const lsys::DerivationEnd& end) {
    const lsys::RuntimeError& error = end.error;
    return std::to_string(static_cast<int>(error.kind)) + " of production " +
           std::to_string(static_cast<std::uint32_t>(error.production)) + " at " +
           std::to_string(error.generation) + ":" + std::to_string(error.position);
}

/// Whether a derivation ended because of memory or size; where it ends may depend on how it runs.
bool is_limit(const Result& result) {
    return result.stop == lsys::Stop::Limit || result.stop == lsys::Stop::OutOfMemory;
}

Result result_of(const lsys::Bytecode& bytecode,
                 SmallDerivation& derivation,
                 std::optional<lsys::Stop> stop) {
    Result result{stop, {}};
    if (stop) {
        result.text = text_of(derivation.derivation().end());
        return result;
    }
    lsys::WordPrinter printer(bytecode);
    static_cast<void>(printer.print(derivation.word(), [&](std::string_view piece) {
        result.text += piece;
        return true;
    }));
    return result;
}

Result derived(const lsys::Bytecode& bytecode, const Division& division) {
    SmallDerivation derivation(bytecode, division);
    const std::optional<lsys::Stop> stop = derivation.derive();
    return result_of(bytecode, derivation, stop);
}

Result streamed(const lsys::Bytecode& bytecode) {
    SmallDerivation stored(bytecode); // only its options are used
    lsys::WordPrinter printer(bytecode);
    std::string text;
    const lsys::StreamOutcome outcome =
        lsys::derive_streamed(bytecode, stored.options(), [&](const lsys::StreamChunk& chunk) {
            printer.append(chunk.codes, chunk.parameters, text);
            return true;
        });
    if (!outcome.end.stop) {
        const std::string_view quote = text.empty() ? "" : printer.quote();
        return {std::nullopt, std::string(quote) + text + std::string(quote)};
    }
    return {outcome.end.stop, text_of(outcome.end)};
}

/// Derives half of the generations, saves, reads the state, and derives the rest.
std::optional<Result> resumed(const lsys::Bytecode& bytecode, const lsys::Bytecode& other) {
    SmallDerivation first(bytecode);
    lsys::Derivation& derivation = first.derivation();
    const std::uint32_t half = first.options().generations / 2;
    if (derivation.start() || derivation.run_to(half)) {
        return std::nullopt;
    }
    std::string bytes;
    const lsys::StateHeader header{lsys::digest(bytecode), first.options().seed,
                                   first.options().generations, half};
    static_cast<void>(lsys::write_state(header, derivation.word(), derivation.sense_state(),
                                        [&](std::string_view piece) {
                                            bytes += piece;
                                            return true;
                                        }));
    lsys::Result<lsys::SavedState> state = lsys::read_state(bytes, other);
    if (!state) {
        return Result{lsys::Stop::Failed, state.error().message};
    }
    SmallDerivation second(other, {3, 5});
    const std::optional<lsys::Stop> stop =
        second.resume(std::move(state.value()), first.options().generations);
    return result_of(other, second, stop);
}

/// The meshes of a skeleton as text, with one or with three threads.
std::string meshes_of(const lsys::Skeleton& skeleton, std::uint32_t threads) {
    static const lsys::UserMesh tetrahedron =
        lsys::read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
                       SmallDerivation::kMaxBytes)
            .value();
    const std::vector<lsys::UserMesh> files(skeleton.mesh_files.size(), tetrahedron);
    std::string text;
    for (const lsys::MeshMethod method :
         {lsys::MeshMethod::Tubes, lsys::MeshMethod::Cylinders, lsys::MeshMethod::Boxes}) {
        lsys::MeshOptions options;
        options.method = method;
        options.sides = 5;
        options.subdivisions = 1;
        options.max_bytes = SmallDerivation::kMaxBytes;
        options.threads = threads;
        lsys::Mesh mesh;
        if (const std::optional<lsys::Stop> stop =
                lsys::make_mesh(skeleton, files, options, mesh)) {
            text += "stop " + std::to_string(static_cast<int>(*stop)) + "\n";
            continue;
        }
        for (std::uint64_t line = 0; line < lsys::line_count(mesh); ++line) {
            lsys::append_line(mesh, line, text);
        }
    }
    return text;
}

/// The meshes of the word that `feed` gives to a turtle; empty if it cannot be drawn.
template <typename Feed>
std::string drawn(const lsys::Bytecode& bytecode, std::uint32_t threads, const Feed& feed) {
    lsys::TurtleOptions options;
    options.max_bytes = SmallDerivation::kMaxBytes;
    options.seed = bytecode.settings.seed;
    options.generations = SmallDerivation(bytecode).options().generations;
    lsys::Turtle turtle(bytecode, options);
    if (!feed(turtle) || turtle.finish()) {
        return {};
    }
    constexpr std::size_t kMaxSegments = 200; // meshes of more take too long for a fuzz target
    return turtle.drawn().segments > kMaxSegments ? std::string()
                                                  : meshes_of(turtle.skeleton(), threads);
}

std::string drawn_whole(const lsys::Bytecode& bytecode, std::uint32_t threads) {
    SmallDerivation derivation(bytecode);
    if (derivation.derive()) {
        return {};
    }
    return drawn(bytecode, threads,
                 [&](lsys::Turtle& turtle) { return !turtle.feed(derivation.word()); });
}

std::string drawn_streamed(const lsys::Bytecode& bytecode) {
    SmallDerivation stored(bytecode); // only its options are used
    return drawn(bytecode, 3, [&](lsys::Turtle& turtle) {
        const lsys::StreamOutcome outcome =
            lsys::derive_streamed(bytecode, stored.options(), [&](const lsys::StreamChunk& chunk) {
                return !turtle.feed(chunk.codes, chunk.parameters);
            });
        return !outcome.end.stop;
    });
}

class Comparison {
public:
    explicit Comparison(std::string text) : text_(std::move(text)) {}

    void run() {
        const CompiledText compiled = compile_text(text_, lsys::Dialect::Lsys, "");
        if (!compiled.bytecode) {
            return;
        }
        const lsys::Bytecode& bytecode = *compiled.bytecode;
        const lsys::Bytecode loaded = from_file(bytecode);
        check("compiled from the formatted text", lsys::digest(bytecode), digest_of_formatted());
        const Result whole = derived(bytecode, {});
        if (is_limit(whole)) {
            return;
        }
        check("with three threads", whole, derived(bytecode, {3, 7}));
        check("in chunks of one module", whole, derived(bytecode, {1, 1}));
        check("from the .lsb file", whole, derived(loaded, {}));
        compare_folded(bytecode, whole);
        if (const std::optional<Result> rest = resumed(bytecode, loaded)) {
            check("continued from a saved state", whole, *rest);
        }
        const bool streams = !lsys::streaming_obstacle(bytecode);
        if (streams) {
            compare_streamed(bytecode, whole);
        }
        compare_drawn(bytecode, streams);
    }

private:
    /// `bytecode` read back from a .lsb file, of which it must make the same bytes again.
    lsys::Bytecode from_file(const lsys::Bytecode& bytecode) const {
        const std::string bytes = lsys::write_module_file(bytecode);
        lsys::Result<lsys::Bytecode> read = lsys::read_module_file(bytes);
        if (!read) {
            fail("the .lsb file is refused", "", read.error().message);
        }
        check("bytes of the .lsb file", bytes, lsys::write_module_file(read.value()));
        return std::move(read.value());
    }
    std::uint64_t digest_of_formatted() const {
        const lsys::SourceFile file("fuzz", text_); // removes a byte order mark
        const CompiledText formatted =
            compile_text(lsys::format_text(file.text()), lsys::Dialect::Lsys, "");
        return formatted.bytecode ? lsys::digest(*formatted.bytecode) : 0;
    }
    void compare_folded(const lsys::Bytecode& bytecode, const Result& whole) const {
        const lsys::DeriveOptions options = SmallDerivation(bytecode).options();
        const std::optional<lsys::Bytecode> folded =
            lsys::fold_reached(bytecode, options.seed, options.generations);
        if (folded) {
            const Result result = derived(*folded, {});
            if (!is_limit(result)) {
                check("with folded modules", whole, result);
            }
        }
    }
    void compare_streamed(const lsys::Bytecode& bytecode, const Result& whole) const {
        const Result result = streamed(bytecode);
        if (is_limit(result)) {
            return;
        }
        if (whole.stop == lsys::Stop::Diagnosed && result.stop == whole.stop) {
            return; // streaming visits modules in another order and may meet another error first
        }
        check("streamed", whole, result);
    }
    void compare_drawn(const lsys::Bytecode& bytecode, bool streams) const {
        const std::string whole = drawn_whole(bytecode, 1);
        check("meshed with three threads", whole, drawn_whole(bytecode, 3));
        if (streams && !whole.empty()) {
            const std::string pieces = drawn_streamed(bytecode);
            check("meshed while derived", whole, pieces);
        }
    }

    template <typename Value>
    void check(std::string_view what, const Value& expected, const Value& found) const {
        if (expected != found) {
            fail(what, shown(expected), shown(found));
        }
    }
    static std::string shown(const std::string& text) { return text; }
    static std::string shown(std::uint64_t number) { return std::to_string(number); }
    static std::string shown(const Result& result) {
        return (result.stop ? "stop " + std::to_string(static_cast<int>(*result.stop)) + ", "
                            : "") +
               result.text;
    }
    [[noreturn]] void
    fail(std::string_view what, const std::string& expected, const std::string& found) const {
        constexpr std::size_t kShown = 400;
        std::fprintf(stderr, "DIFFERENT: %s\n  expected: %s\n  found:    %s\n---- grammar\n%s\n",
                     std::string(what).c_str(), expected.substr(0, kShown).c_str(),
                     found.substr(0, kShown).c_str(), text_.c_str());
        std::abort();
    }

    std::string text_;
};

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Comparison(std::string(data, data + size)).run();
    return 0;
}
