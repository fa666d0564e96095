// SPDX-License-Identifier: MIT
// The functions that the module of WebAssembly exports. JavaScript gets memory from lsys_reserve(),
// writes a request and its files there, calls lsys_answer(), and reads the result: the addresses
// and sizes of the JSON text and of all blocks, as pairs of 32-bit numbers.
#include "web/binding/session.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#define LSYS_EXPORTED(name) __attribute__((export_name(name)))

extern "C" {
/// Provided by JavaScript; called while a word is derived.
__attribute__((import_module("lsys"), import_name("progress"))) void
lsys_progress(std::uint32_t generation, std::uint32_t generations, double modules);
}

namespace {

using lsys::web::Answer;
using lsys::web::Block;
using lsys::web::Session;

struct Module {
    Session session{[](const lsys::DerivationProgress& progress) {
        lsys_progress(progress.generation, progress.generations,
                      static_cast<double>(progress.modules));
    }};
    std::vector<char> input; // the request, then its files
    Answer answer;
    std::string head;                 // the JSON text of Answer::head
    std::vector<std::uint32_t> pairs; // address and size of `head`, then of each block
};

Module& module() {
    static Module the_module;
    return the_module;
}

std::uint32_t address_of(const void* data) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(data));
}

} // namespace

extern "C" {

/// The address of `size` bytes for a request and its files; 0 without memory.
LSYS_EXPORTED("lsys_reserve") char* lsys_reserve(std::uint32_t size) {
    try {
        module().input.resize(size);
        return module().input.data();
    } catch (const std::exception&) {
        return nullptr;
    }
}

/// Answers the request in the first `request_size` of `size` reserved bytes. Returns the address
/// of pairs (address, size): the head, then each block; 0 without memory for the answer.
LSYS_EXPORTED("lsys_answer")
const std::uint32_t* lsys_answer(std::uint32_t request_size, std::uint32_t size) {
    Module& all = module();
    try {
        const std::string_view input(all.input.data(), size);
        all.answer = all.session.answer(input.substr(0, request_size), input.substr(request_size));
        all.input = {};
        all.head = all.answer.head.dump(-1, ' ', false, lsys::web::Json::error_handler_t::replace);
        all.pairs = {address_of(all.head.data()), static_cast<std::uint32_t>(all.head.size())};
        for (const Block& block : all.answer.blocks) {
            all.pairs.push_back(address_of(block.data));
            all.pairs.push_back(static_cast<std::uint32_t>(block.size));
        }
        return all.pairs.data();
    } catch (const std::exception&) {
        all.answer = {};
        return nullptr;
    }
}

/// Frees the memory of the last answer.
LSYS_EXPORTED("lsys_release") void lsys_release() {
    module().answer = {};
    module().head = {};
}
}
