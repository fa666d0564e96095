// SPDX-License-Identifier: MIT
// PlantPreview: the request `lsys/plant`, the plant of a grammar as GLB for a picture beside its
// text. Grows plants on a thread of its own, so that the server answers other requests meanwhile.
// docs/editors.md describes the request.
#pragma once

#include "runtime/base/latest_job.h"
#include "runtime/languageserver/impl/workspace.h"
#include "runtime/pipeline/project.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace lsys {

class PlantPreview {
public:
    /// Receives responses, on the thread that makes them.
    using Send = std::function<void(const Json& response)>;

    /// `files` reads mesh files and pictures. The functions of its host must be safe to call at the
    /// same time as those of the workspace.
    PlantPreview(Project files, std::string generator, Send send)
        : files_(std::move(files)), generator_(std::move(generator)), send_(std::move(send)) {}

    /// Begins to grow the plant of a request, and ends the plants of earlier requests for the same
    /// document, which are answered with RpcError::ServerCancelled. Throws RequestError, and
    /// exceptions of Json, for invalid parameters; a request with invalid parameters ends no other
    /// request.
    void start(const Json& id, const Json& params, Workspace& workspace);
    /// Cancels the request with this id, if it is not answered yet.
    void cancel(const Json& id);
    /// Cancels all requests.
    void cancel_all() { jobs_.cancel_all(); }
    /// Returns when all requests are answered.
    void wait() { jobs_.wait(); }

private:
    Project files_;
    std::string generator_;
    Send send_;
    /// The last request of a document, until it is answered.
    struct Running {
        std::string id; // JSON
        bool is_cancelled_by_client = false;
    };
    std::mutex mutex_;                       // guards `running_`
    std::map<std::string, Running> running_; // by path of the document
    LatestJob jobs_;                         // last member: jobs use the others
};

} // namespace lsys
