// SPDX-License-Identifier: MIT
// Session: answers the requests of one instance of the web package. Grammars, included files,
// meshes and pictures come from a list of files in memory; nothing is read from a disk.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant_growth.h"
#include "runtime/pipeline/project.h"
#include "web/binding/answer.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::web {

/// A plant that grows. `growth` refers to `grammar`.
struct Growing {
    Grammar grammar;
    std::optional<PlantGrowth> growth;
};

class Session {
public:
    /// `progress` is called while a word is derived; it may be empty.
    explicit Session(std::function<void(const DerivationProgress&)> progress);

    /// Answers one request, a JSON object with the name of an operation in `op` (operations.cpp has
    /// their list). `files`: the bytes of the items of `files` in the request, one after the other;
    /// the session keeps them until another request has `files`. A failure is an answer with
    /// messages and a `status` other than "ok"; only a lack of memory for the answer itself throws.
    [[nodiscard]] Answer answer(std::string_view request, std::string_view files);

    /// Host, limits and threads, which every call of the pipeline gets.
    [[nodiscard]] const Project& project() const { return project_; }
    [[nodiscard]] const std::map<std::string, std::string>& files() const { return files_; }

    std::unique_ptr<Growing> growing; // of the last request `begin-growth`; may be null

private:
    /// answer() without the handling of failures.
    [[nodiscard]] Outcome<void> run(std::string_view text, std::string_view files, Answer& answer);
    void take_files(const Json& list, std::string_view bytes); // sets files_

    std::map<std::string, std::string> files_; // by path
    Project project_;
};

} // namespace lsys::web
