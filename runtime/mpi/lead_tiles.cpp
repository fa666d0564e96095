// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "runtime/base/size_text.h"
#include "runtime/cli/tileset_folder.h"
#include "runtime/mpi/crew.h"
#include "runtime/mpi/plan.h"
#include "runtime/mpi/share_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace lsys::mpi {

namespace {

using Clock = std::chrono::steady_clock;

/// State of a rank, as far as rank 0 knows.
struct RankState {
    lsc::TileTotals totals;
    lsc::TileTotals reported; // totals in the last printed line of progress
    std::string machine;
    std::uint64_t threads = 0; // 0: not known yet
    bool is_done = false;      // the rank has ended its work
};

/// Rank 0.
class Leader {
public:
    Leader(const lsc::TilesCommand& command,
           Ranks& ranks,
           const Console& console,
           const std::function<std::string()>& late)
        : command_(command), ranks_(ranks), console_(console), late_(late),
          states_(static_cast<std::size_t>(ranks.count())),
          // Progress has a line for each rank, so it is printed less often for many ranks.
          progress_interval_(std::chrono::seconds(kProgressSeconds + ranks.count())) {
        states_[0].is_done = true; // rank 0 sends no Done to itself
        states_[0].machine = Ranks::machine();
        states_[0].threads = command.run.threads;
    }

    ExitStatus run() {
        std::optional<TileForest> forest;
        const ExitStatus planned = plan_tiles(command_, console_, forest);
        if (planned == ExitStatus::Ok) {
            write(*forest);
        } else {
            stop_all(planned);
            NumberQueue nothing; // empty, only to wait
            while (!are_others_done()) {
                receive_messages(nullptr);
                nothing.wait_below(0, kIdleTime);
            }
        }
        if (status_ == ExitStatus::Ok && forest) {
            report(*forest);
        }
        if (const std::string late = late_(); status_ == ExitStatus::Interrupted && !late.empty()) {
            console_.error(late);
            status_ = ExitStatus::Limit;
        }
        console_.io().err << std::flush; // mpirun may end all ranks once one exits with an error
        for (int rank = 1; rank < ranks_.count(); ++rank) {
            ranks_.send(rank, MessageKind::End, {static_cast<std::uint64_t>(status_)}, "");
        }
        return status_;
    }

private:
    static constexpr int kProgressSeconds = 10;
    /// A request is answered with at most 1 / kShares of the rank's equal share of the remaining
    /// files, so that all ranks end at about the same time.
    static constexpr std::uint64_t kShares = 4;

    void write(const TileForest& forest) {
        lsc::TilesetFolder folder(command_, forest, console_);
        plan_ = forest.digest();
        end_ = folder.root();
        folder.make(plan_);
        note_failure(folder); // before a rank gets work
        {
            Crew crew(folder, command_.run.threads);
            crew.run([&] { return step(folder, crew); });
        }
        if (status_ == ExitStatus::Ok) {
            folder.write(folder.root()); // all other files are complete
            note_failure(folder);
        }
        states_[0].totals = folder.totals();
    }

    /// Exchanges messages. Returns false when all ranks have ended their work: then all files
    /// except tileset.json are written, or the job has failed.
    bool step(lsc::TilesetFolder& folder, Crew& crew) {
        receive_messages(&folder);
        note_failure(folder);
        if (is_stopping_ || next_ == end_) {
            crew.close();
        }
        if (crew.wants_files()) {
            const auto [begin, end] = take_files(crew.file_count_to_request());
            crew.add(begin, end);
        }
        states_[0].totals = folder.totals();
        print_progress();
        if (crew.is_finished() && are_others_done()) {
            return false;
        }
        crew.wait(are_others_done() ? kIdleTime : kAnswerTime);
        return true;
    }

    /// Stops all ranks after an error or an interruption of rank 0.
    void note_failure(const lsc::TilesetFolder& folder) {
        if (is_stopping_ || !folder.is_stopped()) {
            return;
        }
        const Result<void> written = folder.result();
        if (!written) {
            console_.error(fmt::format("rank 0: {}", written.error().message));
        }
        stop_all(written ? ExitStatus::Interrupted : kRankFailed);
    }

    void stop_all(ExitStatus status) {
        status_ = status;
        is_stopping_ = true;
        for (int rank = 1; rank < ranks_.count(); ++rank) {
            if (!state_of(rank).is_done) {
                ranks_.send(rank, MessageKind::Stop, {}, "");
            }
        }
    }

    /// `folder`: the files that rank 0 writes; null if it writes none.
    void receive_messages(lsc::TilesetFolder* folder) {
        while (const std::optional<Message> message = ranks_.receive()) {
            RankState& state = state_of(message->rank);
            switch (message->kind) {
            case MessageKind::Request:
                state.totals.files = message->numbers[2];
                state.totals.bytes = message->numbers[3];
                answer(*message, folder);
                break;
            case MessageKind::Failed:
                if (!is_stopping_) {
                    print_failure(*message);
                    stop(static_cast<ExitStatus>(message->numbers[0]), folder);
                }
                break;
            case MessageKind::Done:
                state.totals = {message->numbers[0], message->numbers[1], message->numbers[2]};
                state.threads = message->numbers[3];
                state.machine = message->text;
                state.is_done = true;
                break;
            case MessageKind::Files:
            case MessageKind::Stop:
            case MessageKind::End:
                break; // rank 0 never receives this kind
            }
        }
    }

    void answer(const Message& request, lsc::TilesetFolder* folder) {
        if (is_stopping_) {
            return; // the rank gets the message Stop instead
        }
        if (request.numbers[0] != plan_) {
            console_.error(fmt::format("rank {} would write another tileset than rank 0: the "
                                       "scene, its files or lsc-mpi differ on their machines",
                                       request.rank));
            stop(kRankFailed, folder);
            return;
        }
        const auto [begin, end] = take_files(request.numbers[1]);
        ranks_.send(request.rank, MessageKind::Files, {begin, end}, "");
    }

    /// Stops all ranks because of a failure of another rank.
    void stop(ExitStatus status, lsc::TilesetFolder* folder) {
        stop_all(status);
        if (folder != nullptr) {
            folder->stop(Error{});
        }
    }

    /// The numbers of the next files, at most `wanted`.
    std::pair<std::uint64_t, std::uint64_t> take_files(std::uint64_t wanted) {
        const std::uint64_t share =
            (end_ - next_) / (kShares * static_cast<std::uint64_t>(ranks_.count()));
        const std::uint64_t begin = next_;
        next_ = std::min(end_, next_ + std::min(wanted, std::max<std::uint64_t>(share, 1)));
        return {begin, next_};
    }

    void print_failure(const Message& failed) const {
        const auto status = static_cast<ExitStatus>(failed.numbers[0]);
        if (status == ExitStatus::Interrupted) {
            console_.info(fmt::format("rank {} was interrupted", failed.rank));
        } else if (failed.numbers[1] != 0) {
            console_.error(fmt::format("rank {}: {}", failed.rank, failed.text));
        } else {
            console_.io().err << failed.text;
            console_.error(
                fmt::format("rank {} cannot plan the tileset, which rank 0 can", failed.rank));
        }
    }

    void print_progress() {
        if (Clock::now() - last_progress_ < progress_interval_) {
            return;
        }
        last_progress_ = Clock::now();
        for (int rank = 0; rank < ranks_.count(); ++rank) {
            RankState& state = state_of(rank);
            if (state.totals.files != state.reported.files) {
                console_.info(rank_line(rank));
                state.reported = state.totals;
            }
        }
        console_.info(fmt::format("{} of {} files are handed out", next_, end_ + 1));
    }

    [[nodiscard]] std::string rank_line(int rank) const {
        const RankState& state = state_of(rank);
        std::string text = fmt::format("rank {}", rank);
        if (state.threads != 0) {
            text += fmt::format(" on {}, {}", state.machine, counted(state.threads, "thread"));
        }
        return text + fmt::format(": {}, {}", counted(state.totals.files, "file"),
                                  byte_size_text(state.totals.bytes));
    }

    void report(const TileForest& forest) {
        lsc::TileTotals all;
        for (int rank = 0; rank < ranks_.count(); ++rank) {
            const lsc::TileTotals& totals = state_of(rank).totals;
            console_.info(rank_line(rank));
            all.files += totals.files;
            all.bytes += totals.bytes;
            all.trees += totals.trees;
        }
        const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
        console_.info(fmt::format("total of {}: {}, {}, in {:.1f} s",
                                  counted(static_cast<std::uint64_t>(ranks_.count()), "rank"),
                                  counted(all.files, "file"), byte_size_text(all.bytes), seconds));
        if (command_.stats) {
            status_ = report_result(
                console_.write(lsc::tileset_stats(forest, all, !command_.resume)), console_);
        }
    }

    [[nodiscard]] bool are_others_done() const {
        return std::all_of(states_.begin(), states_.end(),
                           [](const RankState& state) { return state.is_done; });
    }
    [[nodiscard]] RankState& state_of(int rank) { return states_[static_cast<std::size_t>(rank)]; }
    [[nodiscard]] const RankState& state_of(int rank) const {
        return states_[static_cast<std::size_t>(rank)];
    }

    const lsc::TilesCommand& command_;
    Ranks& ranks_;
    const Console& console_;
    const std::function<std::string()>& late_; // see lead_tiles()
    std::vector<RankState> states_;            // by rank
    std::uint64_t plan_ = 0;                   // TileForest::digest()
    std::uint64_t next_ = 0;                   // the next file to hand out
    std::uint64_t end_ = 0;                    // one more than the last file to hand out
    bool is_stopping_ = false;                 // stop_all() was called
    ExitStatus status_ = ExitStatus::Ok;
    Clock::time_point begin_ = Clock::now();
    Clock::time_point last_progress_ = begin_;
    Clock::duration progress_interval_;
};

} // namespace

ExitStatus lead_tiles(const lsc::TilesCommand& command,
                      Ranks& ranks,
                      const Console& console,
                      const std::function<std::string()>& late) {
    Result<void> usable = lsc::check_tileset_folder(command);
    if (usable && ranks.count() > 1 &&
        std::find(command.files.begin(), command.files.end(), "-") != command.files.end()) {
        usable = Error{"standard input reaches one process only; write the grammar to a file that "
                       "all machines share"};
    }
    const ExitStatus refused = usable ? ExitStatus::Ok : ExitStatus::Failure;
    static_cast<void>(Ranks::leading_number(static_cast<std::uint64_t>(refused)));
    if (!usable) {
        return report_error(usable.error(), console);
    }
    return Leader(command, ranks, console, late).run();
}

} // namespace lsys::mpi
