// SPDX-License-Identifier: MIT
#include "runtime/library/impl/file_call.h"

#include "runtime/library/impl/call.h"
#include "runtime/program/run_files.h"

#include <fmt/format.h>

#include <lsys/api.h>
#include <sstream>
#include <utility>

namespace lsys::v0 {

::lsys::Outcome<std::vector<std::string>>
write_files(Call& call,
            const FileReceiver* receive,
            const std::vector<std::string>& inputs,
            const std::function<ExitStatus(const OutputContext& context)>& write) {
    std::istringstream in; // the console uses no stream of the process
    std::ostringstream out;
    ::lsys::Messages messages;
    MessageOptions options;
    options.levels = call.project().levels;
    Io io{in, out, out, false, call.cancel_flag(), "lsys"};
    io.output_budget = &call.output_budget();
    RunFiles files;
    note_read(&files, inputs);
    io.files = &files;
    const Console console(io, options, messages);
    std::vector<std::string> paths;
    ::lsys::FileReceiver receiver;
    if (receive != nullptr) {
        receiver = call.guarded_sink([receive](const ::lsys::FilePiece& piece) {
            return (*receive)({piece.name, piece.bytes, piece.is_last});
        });
    }
    const OutputContext context{console, call.project(), fmt::format("liblsys {}", version()),
                                receive != nullptr ? &receiver : nullptr, &paths};
    const ExitStatus status = write(context);
    if (status != ExitStatus::Ok) {
        return {stop_of(status), std::move(messages)};
    }
    return {std::move(paths), std::move(messages)};
}

} // namespace lsys::v0
