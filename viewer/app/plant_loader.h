// PlantLoader: makes plants on a thread of its own, by the rules of NewestMaker.
#pragma once

#include "viewer/app/newest_maker.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

struct LoadOutcome {
    std::shared_ptr<const PlantDocument> document; // none: it could not be made
    Messages messages;
    std::vector<std::string> files; // that it is made of, as far as they are known
    ViewOptions options;            // of the request
    SteadyClock::time_point since;  // when the request began
    double seconds = 0.0;           // of the making
};

struct LoadRequest {
    ViewOptions options;
    SteadyClock::time_point since;
    bool again = false;
};

class PlantLoader {
public:
    /// `done` is called on the loader's thread whenever there is something to take().
    explicit PlantLoader(std::function<void()> done);

    void request(const ViewOptions& options, SteadyClock::time_point since) {
        maker_.request({options, since, false});
    }
    void repeat(SteadyClock::time_point since) { maker_.repeat(since); }
    [[nodiscard]] std::optional<LoadOutcome> take() { return maker_.take(); }
    [[nodiscard]] bool is_busy() const { return maker_.is_busy(); }

private:
    NewestMaker<LoadRequest, LoadOutcome> maker_;
};

} // namespace lsys::view
