// SPDX-License-Identifier: MIT
// Ranks: the processes of an MPI job, and their messages. The only code that calls MPI; all calls
// come from the main thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lsys::mpi {

/// The messages of a job. Rank 0 leads; the others are members.
enum class MessageKind : std::uint8_t {
    Request, // member to leader: hash of the plan, number of files wanted, files and bytes written
    Files,   // leader to member: begin and end of the numbers of files; equal if none are left
    Failed,  // member to leader: exit status, 1 if the tileset was planned, else 0; error message
    Stop,    // leader to member: the job ends early because of an error or an interruption
    Done, // member to leader, last message: files, bytes and trees written, threads; machine name
    End   // leader to member, after all are done: exit status
};

struct Message {
    using Numbers = std::array<std::uint64_t, 4>;

    int rank = 0; // rank of the sender
    MessageKind kind = MessageKind::Stop;
    Numbers numbers{};
    std::string text;
};

/// Starts MPI and ends it. Errors of MPI end the job: MPI prints them.
class Ranks {
public:
    Ranks();
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    [[nodiscard]] int rank() const { return rank_; }
    /// Number of ranks of the job.
    [[nodiscard]] int count() const { return count_; }
    /// Whether this is the leading rank, 0.
    [[nodiscard]] bool leads() const { return rank_ == 0; }
    /// The name of this machine.
    [[nodiscard]] static std::string machine();

    /// The `arguments` that rank 0 passes. All ranks must call it.
    [[nodiscard]] std::vector<std::string>
    leading_arguments(std::span<const std::string> arguments) const;
    /// The `number` that rank 0 passes. All ranks must call it.
    [[nodiscard]] static std::uint64_t leading_number(std::uint64_t number);
    /// Number of processors per rank: the processors of this machine that its ranks may use,
    /// divided by the number of ranks on it; at most the processors that this rank may use, at
    /// least 1. All ranks must call it.
    [[nodiscard]] static std::uint32_t processors_per_rank();

    /// Ends all processes of the job at once, including this process.
    void abort(int status);

    void send(int rank, MessageKind kind, const Message::Numbers& numbers, const std::string& text);
    /// The next message, if one has arrived.
    [[nodiscard]] std::optional<Message> receive();

private:
    int rank_ = 0;
    int count_ = 1;
};

} // namespace lsys::mpi
