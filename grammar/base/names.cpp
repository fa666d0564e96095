// SPDX-License-Identifier: MIT
#include "grammar/base/names.h"

#include "grammar/base/characters.h"
#include "grammar/base/contract.h"

#include <algorithm>

namespace lsys {

NameId Names::intern(std::string_view text) {
    if (const auto found = ids_.find(text); found != ids_.end()) {
        return found->second;
    }
    LSYS_CHECK(texts_.size() < static_cast<std::size_t>(kNoName), texts_.size());
    const auto id = static_cast<NameId>(texts_.size());
    ids_.emplace(texts_.emplace_back(text), id);
    return id;
}

NameId Names::find(std::string_view text) const {
    const auto found = ids_.find(text);
    return found == ids_.end() ? kNoName : found->second;
}

std::string_view Names::text(NameId id) const {
    const auto index = static_cast<std::size_t>(id);
    LSYS_CHECK(index < texts_.size(), index);
    return texts_[index];
}

void Names::set_written(NameId id, std::string_view original) {
    written_.insert_or_assign(id, std::string(original));
}

std::string_view Names::written(NameId id) const {
    const auto found = written_.find(id);
    return found == written_.end() ? text(id) : std::string_view(found->second);
}

bool is_identifier(std::string_view text) {
    return !text.empty() && is_letter(text[0]) &&
           std::all_of(text.begin(), text.end(), is_word_character);
}

bool is_sense_name(std::string_view text) {
    return text.starts_with('?') && is_identifier(text.substr(1));
}

} // namespace lsys
