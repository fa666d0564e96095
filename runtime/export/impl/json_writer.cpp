// SPDX-License-Identifier: MIT
#include "runtime/export/impl/json_writer.h"

#include "grammar/base/contract.h"

namespace lsys {

JsonWriter& JsonWriter::begin(char open, char close) {
    char* const at = begin_value(2);
    *at = open;
    out_.advance_to(at + 1);
    closing_ += close;
    comma_ = false;
    return *this;
}

JsonWriter& JsonWriter::end() {
    LSYS_CHECK(!closing_.empty());
    char* const at = out_.room(1);
    *at = closing_.back();
    out_.advance_to(at + 1);
    closing_.pop_back();
    comma_ = true;
    return *this;
}

JsonWriter& JsonWriter::name(std::string_view key) {
    char* at = begin_value(key.size() + 4);
    *at++ = '"';
    at = put_text(at, key);
    out_.advance_to(put_text(at, "\":"));
    comma_ = false;
    return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
    literal("\"");
    out_.put(json_text(text));
    out_.put("\"");
    return *this;
}

JsonWriter& JsonWriter::literal(std::string_view json) {
    out_.advance_to(begin_value(1));
    out_.put(json);
    return *this;
}

std::string json_document(const std::function<void(JsonWriter&)>& write) {
    std::string text;
    const ByteSink append = [&text](std::string_view piece) {
        text += piece;
        return true;
    };
    PieceWriter out(append);
    JsonWriter json(out);
    write(json);
    static_cast<void>(out.finish());
    return text;
}

} // namespace lsys
