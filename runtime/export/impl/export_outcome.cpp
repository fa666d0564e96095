// SPDX-License-Identifier: MIT
#include "runtime/export/impl/export_outcome.h"

#include "runtime/base/size_text.h"
#include "runtime/export/impl/piece_writer.h"

#include <fmt/format.h>

namespace lsys {

namespace {

const char* name_of(ExportSubject subject) {
    return subject == ExportSubject::Plant ? "plant" : "forest";
}

} // namespace

Messages messages_of(Diagnostic diagnostic) {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    Messages messages;
    messages.add(std::move(diagnostics), nullptr);
    return messages;
}

Messages messages_of(std::string error) {
    Messages messages;
    messages.add_error(std::move(error));
    return messages;
}

Outcome<void> nothing_to_draw(ExportSubject subject) {
    return {Stop::Failed,
            messages_of(fmt::format("the {} has nothing to draw, so no file is written",
                                    name_of(subject)))};
}

Outcome<void> too_large_for_format(ExportSubject subject, bool has_frames) {
    const char* const help = subject != ExportSubject::Plant ? ""
                             : has_frames
                                 ? "; another format, fewer frames or a coarser --level may hold it"
                                 : "; another format, fewer sides or a coarser --level may hold it";
    return {Stop::Limit,
            messages_of(fmt::format("the {} is larger than a file of this format can be{}",
                                    name_of(subject), help))};
}

Outcome<void> too_many_joints() {
    return {Stop::Limit,
            messages_of(plant_limit_diagnostic(
                "the skin", fmt::format("{} joints", grouped_digits(kMaxJoints)),
                "ask for fewer generations with `-n`, or for a numbered series in a format "
                "without skins: `-o tree.ply`"))};
}

Outcome<void> finish(PieceWriter& out) {
    return out.finish() ? Outcome<void>() : Outcome<void>(Stop::Cancelled, {});
}

} // namespace lsys
