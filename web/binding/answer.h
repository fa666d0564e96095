// SPDX-License-Identifier: MIT
// Answer: the result of a request of the web package, a JSON object and blocks of bytes to which
// the object refers by their indexes. JavaScript reads both out of the memory of the module.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace lsys::web {

using Json = nlohmann::json;

/// Bytes, and their owner.
struct Block {
    const void* data = nullptr;
    std::size_t size = 0;
    std::shared_ptr<const void> owner;
};

struct Answer {
    Json head = Json::object(); // a JSON object; refers to blocks by index
    std::vector<Block> blocks;

    /// Adds the items of a container without a copy. Returns the index of the block.
    template <typename Items>
    std::size_t add(Items items) {
        auto owner = std::make_shared<const Items>(std::move(items));
        blocks.push_back({owner->data(), owner->size() * sizeof(*owner->data()), owner});
        return blocks.size() - 1;
    }
};

} // namespace lsys::web
