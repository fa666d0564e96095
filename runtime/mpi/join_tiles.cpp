// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"
#include "runtime/cli/tileset_folder.h"
#include "runtime/mpi/crew.h"
#include "runtime/mpi/plan.h"
#include "runtime/mpi/share_tiles.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

namespace lsys::mpi {

namespace {

/// A rank that writes the files that rank 0 hands out.
class Member {
public:
    Member(const lsc::TilesCommand& command, Ranks& ranks, const Console& console)
        : command_(command), ranks_(ranks), console_(console) {}

    /// Tells rank 0 why this rank cannot take part, and waits for the end of the job.
    ExitStatus fail(ExitStatus status, const std::string& text) {
        send_failure(status, false, text);
        return finish({});
    }

    ExitStatus write(const TileForest& forest) {
        lsc::TilesetFolder folder(command_, forest, console_);
        plan_ = forest.digest();
        {
            Crew crew(folder, command_.run.threads);
            crew.run([&] { return step(folder, crew); });
        }
        return finish(folder.totals());
    }

private:
    /// Exchanges messages. Returns false when this rank has written all files that rank 0 handed
    /// out to it, or has stopped.
    bool step(lsc::TilesetFolder& folder, Crew& crew) {
        while (const std::optional<Message> message = ranks_.receive()) {
            if (message->kind == MessageKind::Files) {
                take_files(*message, folder, crew);
            } else if (message->kind == MessageKind::Stop) {
                is_told_to_stop_ = true;
                folder.stop(Error{});
            }
        }
        if (folder.is_stopped()) {
            if (!is_told_to_stop_ && !has_failed_) {
                const Result<void> written = folder.result();
                send_failure(written ? ExitStatus::Interrupted : kRankFailed, true,
                             written ? std::string() : written.error().message);
            }
            crew.close();
        }
        if (!has_asked_ && crew.wants_files()) {
            const lsc::TileTotals totals = folder.totals();
            ranks_.send(0, MessageKind::Request,
                        {plan_, crew.file_count_to_request(), totals.files, totals.bytes}, "");
            has_asked_ = true;
        }
        if (crew.is_finished()) {
            return false;
        }
        crew.wait(has_asked_ ? kAnswerTime : kIdleTime);
        return true;
    }

    void take_files(const Message& message, lsc::TilesetFolder& folder, Crew& crew) {
        has_asked_ = false;
        if (folder.is_stopped()) {
            return; // the crew is closed, or step() will close it
        }
        const std::uint64_t begin = message.numbers[0];
        const std::uint64_t end = message.numbers[1];
        std::error_code error;
        if (begin == end) {
            crew.close();
        } else if (!std::filesystem::is_directory(path_of(command_.output), error)) {
            folder.stop(Error{fmt::format("the folder `{}` of rank 0 is not there; all machines "
                                          "must share it",
                                          command_.output)});
        } else {
            crew.add(begin, end);
        }
    }

    void send_failure(ExitStatus status, bool has_planned, const std::string& text) {
        ranks_.send(0, MessageKind::Failed,
                    {static_cast<std::uint64_t>(status), has_planned ? 1U : 0U}, text);
        has_failed_ = true;
    }

    /// Tells rank 0 that this rank has ended its work; waits for the end of the job.
    ExitStatus finish(const lsc::TileTotals& totals) {
        ranks_.send(0, MessageKind::Done,
                    {totals.files, totals.bytes, totals.trees, command_.run.threads},
                    Ranks::machine());
        NumberQueue nothing; // empty, only to wait
        for (;;) {
            const std::optional<Message> message = ranks_.receive();
            if (message && message->kind == MessageKind::End) {
                return static_cast<ExitStatus>(message->numbers[0]);
            }
            if (!message) {
                nothing.wait_below(0, kIdleTime);
            }
        }
    }

    const lsc::TilesCommand& command_;
    Ranks& ranks_;
    const Console& console_;
    std::uint64_t plan_ = 0;       // TileForest::digest()
    bool has_asked_ = false;       // a Request has no answer yet
    bool has_failed_ = false;      // Failed was sent
    bool is_told_to_stop_ = false; // Stop was received
};

} // namespace

ExitStatus join_tiles(const lsc::TilesCommand& command, Ranks& ranks, const Io& io) {
    if (const std::uint64_t refused = Ranks::leading_number(0); refused != 0) {
        return static_cast<ExitStatus>(refused);
    }
    // Rank 0 prints its own messages about planning. The messages of this rank, which would be the
    // same, are sent only if planning fails here.
    std::ostringstream messages;
    Io collected{io.in, messages, messages, false, io.interrupted, io.program, io.revision};
    collected.output_budget = io.output_budget;
    const Console console(collected, command.messages);
    Member member(command, ranks, console);
    std::optional<TileForest> forest;
    const ExitStatus status = plan_tiles(command, console, forest);
    return status == ExitStatus::Ok ? member.write(*forest)
                                    : member.fail(status, std::move(messages).str());
}

} // namespace lsys::mpi
