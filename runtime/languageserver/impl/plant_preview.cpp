// SPDX-License-Identifier: MIT
#include "runtime/languageserver/impl/plant_preview.h"

#include "grammar/ast/include_chain.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/export/base64.h"
#include "runtime/export/export.h"
#include "runtime/meshing/mesh_items.h"
#include "runtime/pipeline/constant_text.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace lsys {

namespace {

// Defaults of the limits of a request.
constexpr std::uint64_t kMaxModules = 4'000'000;
constexpr std::uint64_t kMaxTriangles = 1'000'000;
constexpr double kMaxSeconds = 10.0;
/// Max bytes of a word, skeleton or mesh.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30U;
constexpr std::uint32_t kCoarsestLevel = 4; // max of MeshOptions::level

/// A request, with all texts that its answer needs.
struct PlantJob {
    Json answer;     // the members that are known before the plant is grown
    Grammar grammar; // a grammar without errors
    std::vector<SourceSpan> statements;
    PlantOptions plant;
    std::map<std::string, std::string> uris; // by path
    PositionEncoding encoding = PositionEncoding::Utf16;
    Limits limits;
    std::uint64_t max_triangles = kMaxTriangles;
    double max_seconds = kMaxSeconds;
    bool textures = true;
};

/// The shortest decimal number that is read back as `value`; null if it is not finite.
Json number_of(float value) {
    return std::isfinite(value) ? Json::parse(fmt::format("{}", value)) : Json();
}

/// The parameter `name`, a whole number of at least `min`; `initial` if the parameter is missing.
std::uint64_t
whole_number(const Json& params, const char* name, std::uint64_t min, std::uint64_t initial) {
    const Json value = params.value(name, Json(initial));
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() < min) {
        throw RequestError(RpcError::InvalidParams,
                           fmt::format("`{}` is not a whole number from {} on", name, min));
    }
    return value.get<std::uint64_t>();
}

std::vector<Definition> definitions_of(const Json& params) {
    std::vector<Definition> all;
    const Json given = params.value("definitions", Json::object());
    for (const auto& [name, value] : given.items()) {
        all.push_back({name, value.get<float>()});
    }
    return all;
}

Json parameters_of(const Grammar& grammar) {
    Json all = Json::array();
    for (const Constant& constant : grammar.program->constants) {
        Json one{{"name", grammar.names.text(constant.name)},
                 {"comment", comment_of(constant, grammar)},
                 {"value", constant.is_random ? Json() : number_of(constant.value)}};
        if (constant.is_param) {
            one["minimum"] = number_of(constant.minimum);
            one["maximum"] = number_of(constant.maximum);
        }
        all.push_back(std::move(one));
    }
    return all;
}

/// The first error, else the last diagnostic, with its place.
std::string text_of(const Diagnostics& diagnostics, const SourceMap* sources) {
    const Diagnostic* shown = nullptr;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        if (shown == nullptr || shown->severity != Severity::Error) {
            shown = &diagnostic;
        }
    }
    if (shown == nullptr) {
        return {};
    }
    std::string text = shown->message;
    if (sources != nullptr && shown->span.file != kNoFile) {
        const SourceFile& file = sources->file(shown->span.file);
        text = fmt::format("line {}: {}", file.line_column(shown->span.begin).line, text);
    }
    return text;
}

/// The last error of a step as a text for users.
std::string text_of(const Messages& messages) {
    std::string text;
    for (const Message& message : messages.all()) {
        if (message.kind == Message::Kind::Diagnostics) {
            text = text_of(message.diagnostics, message.sources.get());
        } else if (message.kind == Message::Kind::Error) {
            text = message.text;
        }
    }
    return text;
}

/// Completes `answer` for a request that gives no plant.
Json failed(Json answer, std::string_view reason, std::string message) {
    answer["plant"] = nullptr;
    answer["reason"] = reason;
    answer["message"] = std::move(message);
    return answer;
}

Json stopped(const PlantJob& job, Stop stop, const Messages& messages) {
    const bool is_limit = stop == Stop::Limit || stop == Stop::OutOfMemory;
    return failed(job.answer, is_limit ? "limit" : "grammar", text_of(messages));
}

/// A file of a grammar. Converts places in the file to ranges of LSP.
class FilePlaces {
public:
    FilePlaces(const SourceFile& file, std::string uri, PositionEncoding encoding)
        : uri_(std::move(uri)), mark_(file.has_byte_order_mark() ? 3 : 0),
          text_((file.has_byte_order_mark() ? "\xEF\xBB\xBF" : "") + std::string(file.text())),
          positions_(text_, encoding) {}
    FilePlaces(const FilePlaces&) = delete;
    FilePlaces& operator=(const FilePlaces&) = delete;

    /// Adds a statement. Call sort() after the last one.
    void add(const SourceSpan& statement) { statements_.push_back(statement); }
    void sort() {
        std::sort(statements_.begin(), statements_.end(),
                  [](const SourceSpan& a, const SourceSpan& b) { return a.begin < b.begin; });
    }
    [[nodiscard]] const std::string& uri() const { return uri_; }
    /// The statement around a module; the module itself if there is none.
    [[nodiscard]] SourceSpan statement_of(const SourceSpan& module) const {
        auto after = std::upper_bound(
            statements_.begin(), statements_.end(), module.begin,
            [](std::uint32_t place, const SourceSpan& each) { return place < each.begin; });
        return after != statements_.begin() && module.end <= (--after)->end ? *after : module;
    }
    [[nodiscard]] Json range(const SourceSpan& span) const {
        const auto position = [this](std::uint32_t offset) {
            const TextPosition at = positions_.position(offset + mark_);
            return Json{{"line", at.line}, {"character", at.character}};
        };
        return {{"start", position(span.begin)}, {"end", position(span.end)}};
    }

private:
    std::string uri_;
    std::size_t mark_; // bytes of the byte order mark
    std::string text_; // text of the file with its byte order mark
    TextPositions positions_;
    std::vector<SourceSpan> statements_; // do not overlap
};

/// The places in the grammar that wrote the drawn modules.
class Sources {
public:
    Sources(const PlantJob& job, const Bytecode& bytecode) : bytecode_(bytecode) {
        const SourceMap& sources = *job.grammar.sources;
        for (std::uint32_t i = 0; i < sources.file_count(); ++i) {
            const SourceFile& file = sources.file(static_cast<FileId>(i));
            files_.try_emplace(file.path(), file, job.uris.at(file.path()), job.encoding);
        }
        for (const SourceSpan& statement : job.statements) {
            files_.at(sources.file(statement.file).path()).add(statement);
        }
        for (auto& [path, file] : files_) {
            file.sort();
        }
        numbers_.assign(bytecode.template_codes.size(), kNoSegment);
    }

    /// The number of the source with this origin; kNoSegment if it is unknown.
    [[nodiscard]] std::uint32_t number(const Origin& origin) {
        if (origin.place == kNone) {
            return kNoSegment;
        }
        std::uint32_t& number = numbers_[origin.place];
        if (number == kNoSegment) {
            number = static_cast<std::uint32_t>(all_.size());
            all_.push_back(describe(origin.place));
        }
        return number;
    }
    [[nodiscard]] Json take() { return std::move(all_); }

private:
    [[nodiscard]] Json describe(std::uint32_t place) const {
        const ProductionId writer = production_with(bytecode_, place);
        Json source{{"production", nullptr}};
        if (writer != kNoProduction) {
            source["production"] = bytecode_.productions[static_cast<std::size_t>(writer)].name;
        }
        const std::optional<Site> site = place_of(bytecode_, place);
        const auto found =
            site ? files_.find(bytecode_.files[static_cast<std::size_t>(site->span.file)])
                 : files_.end();
        if (found != files_.end()) {
            const FilePlaces& file = found->second;
            source["uri"] = file.uri();
            source["range"] = file.range(site->span);
            source["statement"] = file.range(file.statement_of(site->span));
        }
        return source;
    }

    const Bytecode& bytecode_;
    std::map<std::string, FilePlaces> files_; // by path
    std::vector<std::uint32_t> numbers_;      // by Origin::place; kNoSegment: no number yet
    Json all_ = Json::array();
};

/// The number of the source of each item, in the order of number_items().
std::vector<std::uint32_t> sources_of_items(const Skeleton& skeleton, Sources& sources) {
    std::vector<std::uint32_t> numbers;
    for (const LargeVector<Origin>* const origins :
         {&skeleton.segment_origins, &skeleton.polygon_origins, &skeleton.object_origins}) {
        for (const Origin& origin : *origins) {
            numbers.push_back(sources.number(origin));
        }
    }
    return numbers;
}

std::uint64_t triangles_of(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (const MeshPart& part : mesh.parts) {
        count += part.index_count / 3;
    }
    return count;
}

/// Grows, meshes and exports the plant of a request.
Json grow(PlantJob& job, const Project& project, const std::string& generator) {
    const Stopwatch watch;
    Outcome<Plant> grown = grow_plant(job.plant, job.grammar, project);
    if (!grown) {
        return stopped(job, grown.stop(), grown.messages());
    }
    Plant& plant = grown.value();
    Sources sources(job, job.grammar.bytecode);
    const std::vector<std::uint32_t> numbers = sources_of_items(plant.skeleton, sources);
    number_items(plant.skeleton);
    MeshOptions options;
    options.segments = true;
    options.tangents = false;
    options.texture_coordinates = true;
    options.max_bytes = kMaxBytes;
    Mesh mesh;
    std::uint64_t triangles = 0;
    for (options.level = 0; options.level <= kCoarsestLevel; ++options.level) {
        Outcome<Mesh> meshed = mesh_plant(plant, plant.skeleton, options, project);
        if (!meshed && (meshed.stop() != Stop::Limit || options.level == kCoarsestLevel)) {
            return stopped(job, meshed.stop(), meshed.messages());
        }
        mesh = meshed ? std::move(meshed.value()) : Mesh();
        triangles = triangles_of(mesh);
        if (meshed && triangles <= job.max_triangles) {
            break;
        }
    }
    if (options.level > kCoarsestLevel) {
        return failed(job.answer, "limit",
                      fmt::format("the plant has {} triangles, more than the limit of {}",
                                  triangles, job.max_triangles));
    }
    for (VertexSegments& items : mesh.segments) {
        for (std::uint32_t& item : items) {
            item = item < numbers.size() ? numbers[item] : kNoSegment;
        }
    }
    std::string glb;
    ExportInfo info;
    info.grammar = job.plant.file;
    info.generator = generator;
    info.seed = plant.seed;
    info.generations = plant.generations;
    info.textures = job.textures;
    info.item_numbers = true;
    if (triangles > 0) {
        const Outcome<void> written =
            export_mesh(mesh, plant.skeleton, ExportFormat::Glb, info, [&](std::string_view bytes) {
                glb += bytes;
                return !project.is_cancelled();
            });
        if (!written) {
            return stopped(job, written.stop(), written.messages());
        }
    }
    Json answer = job.answer;
    answer["plant"] = {
        {"glb", base64(glb)},         {"modules", plant.modules},         {"triangles", triangles},
        {"level", options.level},     {"generations", plant.generations}, {"seed", plant.seed},
        {"seconds", watch.seconds()}, {"sources", sources.take()}};
    return answer;
}

std::string refused_reason(bool by_client) {
    return by_client ? "the request was cancelled" : "a newer request replaces this one";
}

} // namespace

void PlantPreview::start(const Json& id, const Json& params, Workspace& workspace) {
    Document* document = &workspace.document(params.at("textDocument").at("uri"));
    auto job = std::make_shared<PlantJob>();
    GrammarOptions options;
    options.optional_definitions = definitions_of(params);
    if (params.contains("generations")) {
        job->plant.generations = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(whole_number(params, "generations", 0, 0), kNone - 1));
    }
    options.generations = job->plant.generations;
    if (params.contains("seed")) {
        job->plant.seed = whole_number(params, "seed", 0, 0);
    }
    job->limits.max_modules = whole_number(params, "maxModules", 1, kMaxModules);
    job->limits.max_bytes = kMaxBytes;
    job->max_triangles = whole_number(params, "maxTriangles", 1, kMaxTriangles);
    job->max_seconds = params.value("maxSeconds", kMaxSeconds);
    job->textures = params.value("textures", true);
    if (!(job->max_seconds > 0.0 && job->max_seconds <= 3600.0)) {
        throw RequestError(RpcError::InvalidParams,
                           "`maxSeconds` is not a number above 0 and up to 3600");
    }

    job->encoding = workspace.editor.encoding;
    CheckedDocument checked = workspace.check_whole(*document, options);
    Grammar& grammar = checked.compiled.grammar;
    job->answer = {{"version", document->version},
                   {"parameters", grammar.program ? parameters_of(grammar) : Json::array()},
                   {"lastGeneration",
                    grammar.bytecode.generations ? Json(*grammar.bytecode.generations) : Json()}};
    if (!checked.failure.empty() || !checked.compiled.has_bytecode) {
        const std::string message =
            !checked.failure.empty()
                ? checked.failure
                : text_of(checked.compiled.diagnostics, checked.compiled.grammar.sources.get());
        jobs_.cancel(document->path);
        send_({{"jsonrpc", "2.0"},
               {"id", id},
               {"result", failed(std::move(job->answer), "grammar", message)}});
        return;
    }
    for (std::uint32_t i = 0; i < grammar.sources->file_count(); ++i) {
        const std::string& path = grammar.sources->file(static_cast<FileId>(i)).path();
        job->uris.emplace(path, workspace.uri_of(normalised_path(path)));
    }
    job->plant.file = checked.path;
    job->plant.origins = true;
    job->statements = std::move(checked.compiled.statements);
    job->grammar = std::move(grammar);
    {
        const std::lock_guard lock(mutex_);
        running_[document->path] = {id.dump(), false};
    }
    const auto run = [this, job, id, path = document->path](const LatestJob::Flags& flags) {
        Project project = files_;
        project.host.cancelled = &flags.cancelled;
        project.limits = job->limits;
        Json result;
        if (!flags.cancelled) {
            result = catch_out_of_memory(
                [&] { return grow(*job, project, generator_); },
                [&] { return failed(job->answer, "limit", "the plant needs more memory"); });
        }
        const bool is_cancelled = flags.cancelled; // may change until the response is sent
        bool by_client = false;
        {
            const std::lock_guard lock(mutex_);
            const auto running = running_.find(path);
            if (running != running_.end() && running->second.id == id.dump()) {
                by_client = running->second.is_cancelled_by_client;
                running_.erase(running);
            }
        }
        Json response{{"jsonrpc", "2.0"}, {"id", id}};
        if (!is_cancelled || (flags.out_of_time && !by_client)) {
            response["result"] =
                !is_cancelled
                    ? std::move(result)
                    : failed(job->answer, "limit",
                             fmt::format("the plant takes longer than {:g} s", job->max_seconds));
        } else {
            response["error"] = {{"code", static_cast<int>(by_client ? RpcError::RequestCancelled
                                                                     : RpcError::ServerCancelled)},
                                 {"message", refused_reason(by_client)}};
        }
        send_(response);
    };
    jobs_.start(document->path, run,
                std::chrono::milliseconds(std::llround(job->max_seconds * 1000.0)));
}

void PlantPreview::cancel(const Json& id) {
    const std::lock_guard lock(mutex_);
    for (auto& [path, running] : running_) {
        if (running.id == id.dump()) {
            running.is_cancelled_by_client = true;
            jobs_.cancel(path);
        }
    }
}

} // namespace lsys
