// SPDX-License-Identifier: MIT
#include "runtime/export/impl/json_template.h"

#include <fmt/format.h>

#include <iterator>

namespace lsys {

/// Formats values recursively. The documents of the writers of glTF have a bounded depth.
class JsonTemplateMaker {
public:
    explicit JsonTemplateMaker(const JsonReferences& references) : references_(references) {}

    void add(const nlohmann::ordered_json& value) {
        if (const auto found = references_.find(&value); found != references_.end()) {
            made_.gaps_.push_back({made_.text_.size(), found->second});
        } else if (value.is_object()) {
            add_members(value);
        } else if (value.is_array()) {
            add_items(value);
        } else {
            made_.text_ += value.dump();
        }
    }
    JsonTemplate take() { return std::move(made_); }

private:
    void add_members(const nlohmann::ordered_json& object) {
        char separator = '{';
        for (const auto& [name, member] : object.items()) {
            made_.text_ += separator;
            made_.text_ += nlohmann::ordered_json(name).dump() + ':';
            add(member);
            separator = ',';
        }
        made_.text_ += object.empty() ? "{}" : "}";
    }
    void add_items(const nlohmann::ordered_json& array) {
        char separator = '[';
        for (const nlohmann::ordered_json& item : array) {
            made_.text_ += separator;
            add(item);
            separator = ',';
        }
        made_.text_ += array.empty() ? "[]" : "]";
    }

    const JsonReferences& references_;
    JsonTemplate made_;
};

void JsonTemplate::append_number(std::string& text, std::size_t number) {
    const fmt::format_int digits(number);
    text.append(digits.data(), digits.size());
}

std::string JsonTemplate::key() const {
    std::string key = text_;
    for (const Gap& gap : gaps_) {
        fmt::format_to(std::back_inserter(key), " {} {} {}", gap.at,
                       static_cast<unsigned>(gap.reference.kind), gap.reference.number);
    }
    return key;
}

JsonTemplate make_json_template(const nlohmann::ordered_json& value,
                                const JsonReferences& references) {
    JsonTemplateMaker maker(references);
    maker.add(value);
    return maker.take();
}

} // namespace lsys
