// SPDX-License-Identifier: MIT
#include "runtime/mpi/ranks.h"

#include "runtime/base/workers.h"
#include "runtime/platform/processors.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <mpi.h>

namespace lsys::mpi {

namespace {

std::uint32_t count_bits(const std::vector<std::uint64_t>& words) {
    std::uint32_t count = 0;
    for (const std::uint64_t word : words) {
        count += static_cast<std::uint32_t>(std::popcount(word));
    }
    return count;
}

/// Sends a text from rank 0 to all.
void broadcast(std::string& text) {
    std::uint64_t size = Ranks::leading_number(text.size());
    text.resize(size);
    // MPI counts elements in an `int`.
    constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30U;
    for (std::uint64_t at = 0; at < size; at += kMaxBytes) {
        MPI_Bcast(text.data() + at, static_cast<int>(std::min(kMaxBytes, size - at)), MPI_CHAR, 0,
                  MPI_COMM_WORLD);
    }
}

} // namespace

Ranks::Ranks() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
        MPI_Abort(MPI_COMM_WORLD, 2); // an MPI without threads; no such MPI is known
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
    MPI_Finalize();
}

std::string Ranks::machine() {
    std::string name(MPI_MAX_PROCESSOR_NAME, '\0');
    int length = 0;
    MPI_Get_processor_name(name.data(), &length);
    name.resize(static_cast<std::size_t>(length));
    return name;
}

std::vector<std::string> Ranks::leading_arguments(std::span<const std::string> arguments) const {
    std::string text; // each argument ends with a zero byte
    if (leads()) {
        for (const std::string& argument : arguments) {
            text += argument + '\0';
        }
    }
    broadcast(text);
    std::vector<std::string> leading;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\0', at);
        leading.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return leading;
}

std::uint64_t Ranks::leading_number(std::uint64_t number) {
    MPI_Bcast(&number, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return number;
}

std::uint32_t Ranks::processors_per_rank() {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int ranks = 1;
    MPI_Comm_size(machine, &ranks);
    std::vector<std::uint64_t> allowed = platform::allowed_processors();
    std::uint64_t words = allowed.size();
    MPI_Allreduce(MPI_IN_PLACE, &words, 1, MPI_UINT64_T, MPI_MAX, machine);
    allowed.resize(words);
    std::vector<std::uint64_t> allowed_on_machine(words);
    MPI_Allreduce(allowed.data(), allowed_on_machine.data(), static_cast<int>(words), MPI_UINT64_T,
                  MPI_BOR, machine);
    MPI_Comm_free(&machine);
    const std::uint32_t machine_processors =
        words == 0 ? Workers(0).count() : count_bits(allowed_on_machine);
    const std::uint32_t usable = words == 0 ? machine_processors : count_bits(allowed);
    return std::max(1U, std::min(usable, machine_processors / static_cast<std::uint32_t>(ranks)));
}

void Ranks::abort(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
}

void Ranks::send(int rank,
                 MessageKind kind,
                 const Message::Numbers& numbers,
                 const std::string& text) {
    std::string bytes(sizeof numbers, '\0');
    std::memcpy(bytes.data(), numbers.data(), sizeof numbers);
    bytes += text;
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, static_cast<int>(kind),
             MPI_COMM_WORLD);
}

std::optional<Message> Ranks::receive() {
    int has_arrived = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_arrived, &status);
    if (has_arrived == 0) {
        return std::nullopt;
    }
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    Message message;
    message.rank = status.MPI_SOURCE;
    message.kind = static_cast<MessageKind>(status.MPI_TAG);
    std::memcpy(message.numbers.data(), bytes.data(), sizeof message.numbers);
    message.text = bytes.substr(sizeof message.numbers);
    return message;
}

} // namespace lsys::mpi
