// SPDX-License-Identifier: MIT
#include "runtime/program/console.h"

#include "grammar/rendering/render_diagnostic.h"
#include "runtime/program/files.h"
#include "runtime/program/output_budget.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <istream>
#include <memory>
#include <ostream>
#include <sstream>

namespace lsys {

namespace {

bool wants_colour(const Io& io, ColourMode mode) {
    switch (mode) {
    case ColourMode::Always:
        return true;
    case ColourMode::Never:
        return false;
    case ColourMode::Auto:
        break;
    }
    const char* const no_colour = std::getenv("NO_COLOR"); // https://no-color.org
    return io.err_is_terminal && (no_colour == nullptr || *no_colour == '\0');
}

/// The errors among `diagnostics`, which are all that --quiet prints.
Diagnostics errors_only(const Diagnostics& diagnostics) {
    Diagnostics errors;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        if (diagnostic.severity == Severity::Error) {
            errors.add(diagnostic);
        }
    }
    return errors;
}

Result<void> output_result(std::ostream& out) {
    if (out.good()) {
        return {};
    }
    const int reason = errno;
    std::string message = "cannot write standard output";
    if (reason != 0) {
        message += ": ";
        message += errno_text(reason);
    }
    return Error{message};
}

} // namespace

Console::Console(const Io& io, const MessageOptions& options) : io_(io), options_(options) {}

Console::Console(const Io& io, const MessageOptions& options, Messages& collected)
    : io_(io), options_(options), collected_(&collected) {}

bool Console::interrupted() const {
    return io_.interrupted != nullptr && io_.interrupted->load(std::memory_order_relaxed);
}

bool Console::shows_progress() const {
    return io_.err_is_terminal && !options_.quiet && options_.format != MessageFormat::Json &&
           collected_ == nullptr;
}

void Console::print_message(std::string_view severity, std::string_view message) const {
    if (options_.format == MessageFormat::Json) {
        nlohmann::ordered_json object = nlohmann::ordered_json::object();
        object["severity"] = severity;
        object["message"] = message;
        io_.err << object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                << '\n';
    } else {
        io_.err << io_.program << ": " << severity << ": " << message << '\n';
    }
}

void Console::error(std::string_view message) const {
    if (collected_ != nullptr) {
        collected_->add_error(std::string(message));
        return;
    }
    print_message("error", message);
}

void Console::help(std::string_view message) const {
    if (collected_ != nullptr) {
        collected_->add_help(std::string(message));
    } else if (options_.format != MessageFormat::Json) {
        print_message("help", message);
    }
}

void Console::info(std::string_view message) const {
    if (collected_ != nullptr) {
        collected_->add_info(std::string(message));
    } else if (!options_.quiet) {
        if (options_.format == MessageFormat::Json) {
            print_message("note", message);
        } else {
            io_.err << io_.program << ": " << message << '\n';
        }
    }
}

void Console::line(std::string_view text) const {
    if (options_.format == MessageFormat::Json || collected_ != nullptr) {
        info(text);
    } else if (!options_.quiet) {
        io_.err << text << '\n';
    }
}

void Console::records(std::string_view lines) const {
    if (collected_ != nullptr) {
        collected_->add_info(std::string(lines));
    } else if (!options_.quiet) {
        io_.err << lines;
    }
}

void Console::detail(std::string_view message) const {
    if (options_.verbose) {
        info(message);
    }
}

RenderOptions Console::render_options() const {
    RenderOptions render;
    render.format = options_.format;
    render.program = io_.program;
    render.colour = options_.format != MessageFormat::Json && wants_colour(io_, options_.colour);
    return render;
}

void Console::show(const Messages& messages) const {
    if (collected_ != nullptr) {
        collected_->append(messages);
        return;
    }
    for (const Message& message : messages.all()) {
        switch (message.kind) {
        case Message::Kind::Diagnostics:
            print(message.diagnostics, message.sources ? *message.sources : SourceMap());
            break;
        case Message::Kind::Error:
            error(message.text);
            break;
        case Message::Kind::Help:
            help(message.text);
            break;
        case Message::Kind::Info:
            info(message.text);
            break;
        case Message::Kind::Detail:
            detail(message.text);
            break;
        }
    }
}

std::string
messages_text(const Messages& messages, const MessageOptions& options, const char* program) {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    err.exceptions(std::ios::badbit); // else a lack of memory would cut the text off
    Console({in, out, err, false, nullptr, program}, options).show(messages);
    return std::move(err).str();
}

ExitStatus report_error(const Error& error, const Console& console) {
    console.error(error.message);
    if (error.kind == ErrorKind::Limit) {
        console.help("raise the limit with `--max-memory`");
        return ExitStatus::Limit;
    }
    return ExitStatus::Failure;
}

ExitStatus report_result(const Result<void>& result, const Console& console) {
    return result ? ExitStatus::Ok : report_error(result.error(), console);
}

ExitStatus Console::show(Diagnostic diagnostic, ExitStatus status) const {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    static_cast<void>(show(diagnostics, SourceMap()));
    return status;
}

void Console::print(const Diagnostics& diagnostics, const SourceMap& sources) const {
    std::string text;
    render_all(options_.quiet ? errors_only(diagnostics) : diagnostics, sources, render_options(),
               text);
    io_.err << text << std::flush;
}

ExitStatus Console::show(Diagnostics& diagnostics, const SourceMap& sources) const {
    apply_levels(options_.levels, sources, diagnostics);
    diagnostics.sort_by_place();
    if (collected_ != nullptr) {
        collected_->add(diagnostics, std::make_shared<const SourceMap>(sources));
    } else {
        print(diagnostics, sources);
    }
    const auto is_limit = [](const Diagnostic& diagnostic) {
        return diagnostic.code == DiagnosticCode::LimitReached;
    };
    if (std::any_of(diagnostics.all().begin(), diagnostics.all().end(), is_limit)) {
        return ExitStatus::Limit;
    }
    return diagnostics.has_errors() ? ExitStatus::AuthorErrors : ExitStatus::Ok;
}

Result<void> Console::take_output(std::size_t bytes) const {
    if (io_.output_budget == nullptr || io_.output_budget->take(bytes)) {
        return {};
    }
    return Error{fmt::format("the output is larger than {} bytes, the limit of `--max-output`",
                             io_.output_budget->max_bytes())};
}

Result<void> Console::write(std::string_view text) const {
    if (Result<void> taken = take_output(text.size()); !taken) {
        return taken;
    }
    errno = 0;
    io_.out.write(text.data(), static_cast<std::streamsize>(text.size()));
    return output_result(io_.out);
}

Result<void> Console::flush() const {
    errno = 0;
    io_.out.flush();
    return output_result(io_.out);
}

ExitStatus Console::finish(ExitStatus status) const {
    if (!io_.out.good() && status != ExitStatus::Ok) {
        return status; // the failed write has been reported already
    }
    const Result<void> done = flush();
    if (done) {
        return status;
    }
    error(done.error().message);
    return more_severe(status, ExitStatus::Failure);
}

} // namespace lsys
