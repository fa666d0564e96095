// SPDX-License-Identifier: MIT
#include "grammar/base/outcome.h"

#include <algorithm>
#include <iterator>

namespace lsys {

void Messages::add(Message::Kind kind, std::string text) {
    Message message;
    message.kind = kind;
    message.text = std::move(text);
    all_.push_back(std::move(message));
}

void Messages::add(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources) {
    const bool is_empty = diagnostics.count(Severity::Error) == 0 &&
                          diagnostics.count(Severity::Warning) == 0 &&
                          diagnostics.count(Severity::Note) == 0;
    if (is_empty) {
        return;
    }
    diagnostics.sort_by_place();
    Message message;
    message.diagnostics = std::move(diagnostics);
    message.sources = std::move(sources);
    all_.push_back(std::move(message));
}

void Messages::append(Messages other) {
    all_.insert(all_.end(), std::make_move_iterator(other.all_.begin()),
                std::make_move_iterator(other.all_.end()));
}

bool Messages::has_errors() const {
    return std::any_of(all_.begin(), all_.end(), [](const Message& message) {
        return message.kind == Message::Kind::Error || message.diagnostics.has_errors();
    });
}

} // namespace lsys
