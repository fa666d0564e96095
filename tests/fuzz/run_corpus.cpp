// SPDX-License-Identifier: MIT
// Runs a fuzz function without libFuzzer: over the files named on the command line, over about 16
// prefixes of each, and, in targets of grammars, over a few changed texts. With `--seconds N` it
// runs the function for N seconds over random changes of the files instead, which does not need
// clang: `TARGET --seconds 60 [--seed S] [--found FILE] FILE...`. An input that ends the process is
// written to `--found` (default found.input). With `--write FOLDER --count N` it writes N changed
// inputs into files of the folder, and runs none; their names are 0, 1, ... with the ending of the
// first file.
#include "tests/fuzz/input_changes.h"
#ifdef LSYS_CHANGES_GRAMMARS
#include "tests/fuzz/grammar_mutator.h"
#endif

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/time.h>
#include <unistd.h>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kMaxBytes = 8192; // of a changed input, as in scripts/fuzz
constexpr int kMaxSeconds = 20;         // of processor time for one input

struct Options {
    double seconds = 0.0;
    std::uint64_t seed = 1;
    std::string found = "found.input";
    std::string folder;      // of --write
    std::uint64_t count = 0; // of --count
    std::vector<std::string> files;
};

// For the signal handler.
const Options* options_of_run = nullptr;
const std::string* running_input = nullptr;

void run(const std::string& text, std::size_t size) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), size);
}

std::string read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_running_input(int signal) {
    if (running_input != nullptr) {
        const int file =
            open(options_of_run->found.c_str(), O_WRONLY | O_CREAT | O_TRUNC, S_IRUSR | S_IWUSR);
        static_cast<void>(!write(file, running_input->data(), running_input->size()));
        close(file);
    }
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

/// Sends SIGPROF after so many seconds of processor time; 0: never.
void limit_time(int seconds) {
    itimerval limit{};
    limit.it_value.tv_sec = seconds;
    setitimer(ITIMER_PROF, &limit, nullptr);
}

std::string changed(const std::vector<std::string>& texts, std::uint64_t seed) {
    const std::string& text = texts[seed % texts.size()];
#ifdef LSYS_CHANGES_GRAMMARS
    const std::string& other = texts[seed * 7919 % texts.size()];
    return seed % 5 == 0 ? crossed_grammars(text, other, seed) : changed_grammar(text, seed);
#else
    return changed_bytes(text, texts[seed * 7919 % texts.size()], seed);
#endif
}

/// The texts of the files, which are changed first.
std::vector<std::string> read_all(const std::vector<std::string>& paths) {
    std::vector<std::string> texts;
    for (const std::string& path : paths) {
        texts.push_back(read(path).substr(0, kMaxBytes));
    }
    return texts;
}

std::string
changed_input(const std::vector<std::string>& texts, const Options& options, std::uint64_t index) {
    return changed(texts, options.seed * 1'000'000'007U + index).substr(0, kMaxBytes);
}

void write_changes(const Options& options) {
    const std::vector<std::string> texts = read_all(options.files);
    const std::string ending = std::filesystem::path(options.files.front()).extension().string();
    for (std::uint64_t i = 0; i < options.count; ++i) {
        std::ofstream(options.folder + "/" + std::to_string(i) + ending, std::ios::binary)
            << changed_input(texts, options, i);
    }
}

/// Runs changed texts until the time is over. Every sixteenth that ran becomes a text to change.
void run_changes(const Options& options) {
    constexpr std::size_t kMaxTexts = 4096;
    using Clock = std::chrono::steady_clock;
    std::vector<std::string> texts = read_all(options.files);
    const std::size_t files = texts.size();
    options_of_run = &options;
    for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGPROF}) {
        std::signal(signal, write_running_input);
    }
    const Clock::time_point begin = Clock::now();
    std::uint64_t count = 0;
    while (std::chrono::duration<double>(Clock::now() - begin).count() < options.seconds) {
        const std::string text = changed_input(texts, options, count);
        running_input = &text;
        limit_time(kMaxSeconds);
        run(text, text.size());
        running_input = nullptr;
        if (++count % 16 == 0) {
            if (texts.size() < files + kMaxTexts) {
                texts.push_back(text);
            } else {
                texts[files + count / 16 % kMaxTexts] = text;
            }
        }
    }
    limit_time(0);
    std::printf("%llu executions\n", static_cast<unsigned long long>(count));
}

void run_file(const std::string& path) {
    const std::string text = read(path);
    const std::size_t stride = text.size() / 16 + 1;
    for (std::size_t size = 0; size < text.size(); size += stride) {
        run(text, size);
    }
    run(text, text.size());
#ifdef LSYS_CHANGES_GRAMMARS
    for (std::uint64_t seed = 1; seed <= 4 && text.size() <= kMaxBytes; ++seed) {
        const std::string text_with_changes = changed_grammar(text, seed);
        run(text_with_changes, text_with_changes.size());
    }
#endif
}

Options read_options(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--seconds" && i + 1 < argc) {
            options.seconds = std::stod(argv[++i]);
        } else if (argument == "--seed" && i + 1 < argc) {
            options.seed = std::stoull(argv[++i]);
        } else if (argument == "--found" && i + 1 < argc) {
            options.found = argv[++i];
        } else if (argument == "--write" && i + 1 < argc) {
            options.folder = argv[++i];
        } else if (argument == "--count" && i + 1 < argc) {
            options.count = std::stoull(argv[++i]);
        } else {
            options.files.push_back(argument);
        }
    }
    return options;
}

} // namespace

int main(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.files.empty()) {
        std::fputs("no files\n", stderr);
        return 1;
    }
    if (!options.folder.empty()) {
        write_changes(options);
        return 0;
    }
    if (options.seconds > 0.0) {
        run_changes(options);
        return 0;
    }
    for (const std::string& path : options.files) {
        run_file(path);
    }
    std::printf("%zu files\n", options.files.size());
    return 0;
}
