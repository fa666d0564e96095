// SPDX-License-Identifier: MIT
// The handles of the C interface, and the calls that make them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lsys.h>
#include <lsys/forest.h>
#include <lsys/grammar.h>
#include <lsys/plant.h>
#include <lsys/word.h>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace api = lsys::v0;

struct lsys_grammar {
    api::Grammar value;
};
struct lsys_word {
    api::Word value;
};
struct lsys_plant {
    api::Plant value;
};
struct lsys_mesh {
    api::Mesh value;
};
struct lsys_messages {
    api::Messages value;
    std::string text;
};

struct lsys_forest {
    api::Forest value;
};
struct lsys_instances {
    api::Instances value;
};

namespace lsys::v0::c {

inline lsys_status c_status(api::Status status) {
    return static_cast<lsys_status>(status);
}

inline std::string text_or(const char* text, const char* otherwise) {
    return text != nullptr ? text : otherwise;
}

/// A C++ function that calls a function of C.
inline api::EnvironmentFunction environment_of(const lsys_environment& given) {
    return [given](const api::EnvironmentQuery& query) -> api::EnvironmentAnswers {
        static_assert(sizeof(lsys_sense_place) == sizeof(api::SensePlace));
        static_assert(offsetof(lsys_sense_place, up) == offsetof(api::SensePlace, up));
        const lsys_environment_query asked{
            query.generation, query.places.size(),
            reinterpret_cast<const lsys_sense_place*>(query.places.data()), query.parameters.data(),
            query.offsets.data()};
        const double* numbers = nullptr;
        std::size_t size = 0;
        if (const int status = given.answer(given.user, &asked, &numbers, &size); status != 0) {
            return {0, {}, "it returned " + std::to_string(status)};
        }
        return {size, std::vector<double>(numbers, numbers + size * asked.place_count), {}};
    };
}

inline api::Project project_of(const lsys_project* given) {
    api::Project project;
    if (given == nullptr) {
        return project;
    }
    project.threads = given->threads;
    if (given->max_modules != 0) {
        project.limits.max_modules = given->max_modules;
    }
    project.limits.max_bytes = given->max_bytes;
    project.policy = {given->untrusted != 0, text_or(given->root, ""), given->max_seconds,
                      given->max_output};
    const lsys_project host = *given;
    if (host.read_file != nullptr) {
        project.host.read_file = [host](const std::string& path) -> api::FileContents {
            const char* bytes = nullptr;
            std::size_t size = 0;
            if (host.read_file(host.user, path.c_str(), &bytes, &size) != 0) {
                return {false, {}, "no such file or directory"};
            }
            return {true, std::string(bytes, size), {}};
        };
    }
    for (std::size_t i = 0; i < host.environment_count; ++i) {
        project.host.environments[host.environments[i].name] = environment_of(host.environments[i]);
    }
    if (host.progress != nullptr) {
        project.host.progress = [host](const api::Progress& progress) {
            return host.progress(host.user, progress.generation, progress.generations,
                                 progress.modules) == 0;
        };
    }
    return project;
}

inline api::GrammarOptions options_of(const lsys_grammar_options* given) {
    api::GrammarOptions options;
    if (given == nullptr) {
        return options;
    }
    options.dialect = text_or(given->dialect, "");
    options.system = text_or(given->system, "");
    for (std::size_t i = 0; i < given->definition_count; ++i) {
        options.definitions.emplace_back(given->definitions[i].name, given->definitions[i].value);
    }
    for (std::size_t i = 0; i < given->setting_count; ++i) {
        options.settings.emplace_back(given->settings[i].key, given->settings[i].values);
    }
    if (given->generations >= 0) {
        options.generations = static_cast<std::uint32_t>(given->generations);
    }
    return options;
}

inline std::optional<std::uint32_t> generations_of(std::int64_t generations) {
    return generations < 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(generations));
}

inline std::optional<std::uint64_t> seed_of(const std::uint64_t* seed) {
    return seed == nullptr ? std::nullopt : std::optional(*seed);
}

inline void hand_over(const api::Messages& messages, lsys_messages** to) {
    if (to != nullptr) {
        *to = new lsys_messages{messages, messages.text()};
    }
}

/// Calls `work` and gives its value, as a handle, and its messages to the caller. An exception
/// means lack of memory: the library throws no others, and functions of C throw none.
template <typename Handle, typename Work>
lsys_status call(const Work& work, Handle** value, lsys_messages** messages) noexcept {
    *value = nullptr;
    if (messages != nullptr) {
        *messages = nullptr;
    }
    try {
        auto outcome = work();
        hand_over(outcome.messages(), messages);
        if (outcome) {
            *value = new Handle{std::move(*outcome)};
        }
        return c_status(outcome.status());
    } catch (...) {
        return LSYS_OUT_OF_MEMORY;
    }
}

/// A C++ callback that passes pieces to a function of C.
inline auto piece_writer(int (*write)(void* user, const char* piece, std::size_t size),
                         void* user) {
    return [write, user](std::string_view piece) {
        return write(user, piece.data(), piece.size()) == 0;
    };
}

/// Calls `work`, ignores its value, and gives its messages to the caller.
template <typename Work>
lsys_status call_without_value(const Work& work, lsys_messages** messages) noexcept {
    if (messages != nullptr) {
        *messages = nullptr;
    }
    try {
        const auto outcome = work();
        hand_over(outcome.messages(), messages);
        return c_status(outcome.status());
    } catch (...) {
        return LSYS_OUT_OF_MEMORY;
    }
}

} // namespace lsys::v0::c
