#include "grammar/base/names.h"

#include "grammar/base/contract.h"

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
    const auto letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    if (text.empty() || !letter(text[0])) {
        return false;
    }
    for (const char c : text) {
        if (!letter(c) && !(c >= '0' && c <= '9')) {
            return false;
        }
    }
    return true;
}

} // namespace lsys
