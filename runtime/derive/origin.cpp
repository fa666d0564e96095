// SPDX-License-Identifier: MIT
#include "runtime/derive/origin.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>

namespace lsys {

namespace {

std::string place_text(const Bytecode& bytecode, std::uint32_t index) {
    const ProductionId writer = production_with(bytecode, index);
    std::string text = "from ";
    text += writer == kNoProduction ? std::string("the axiom")
                                    : bytecode.productions[static_cast<std::size_t>(writer)].name;
    if (const std::optional<Site> place = place_of(bytecode, index)) {
        fmt::format_to(std::back_inserter(text), " at {}:{}:{}",
                       bytecode.files[static_cast<std::size_t>(place->span.file)], place->line,
                       place->column);
    }
    return text;
}

} // namespace

void OriginPrinter::append(const Origin& origin, std::string& text) {
    if (origin.place == kNone) {
        fmt::format_to(std::back_inserter(text),
                       "origin unknown, in the saved state of generation {}", origin.generation);
        return;
    }
    if (places_.empty()) {
        places_.resize(bytecode_.template_codes.size());
    }
    std::string& place = places_[origin.place];
    if (place.empty()) {
        place = place_text(bytecode_, origin.place);
    }
    fmt::format_to(std::back_inserter(text), "{}, generation {}", place, origin.generation);
}

} // namespace lsys
