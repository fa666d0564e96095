// SPDX-License-Identifier: MIT
#include "runtime/serve/http_server.h"

#include "runtime/base/workers.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/bind_executor.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/span.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/system/system_error.hpp>
#include <chrono>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kIdleTimeout{10};
constexpr seconds kSendTimeout{120};
constexpr seconds kFinishTimeout{5};
constexpr milliseconds kPollInterval{100};
constexpr std::uint32_t kMaxHeaderBytes = 16 * 1024;

class Session;

/// Members that all sessions use. Only the network thread uses them, except `service`, which the
/// threads of `pool` call, too.
struct Shared {
    TileService& service;
    std::set<Session*> sessions;
    bool is_stopping = false;
    asio::thread_pool pool;      // makes tiles
    asio::io_context network{1}; // destroyed first, with the remaining sessions

    Shared(TileService& tiles, std::size_t threads) : service(tiles), pool(threads) {}
};

std::string_view view_of(beast::string_view text) {
    return {text.data(), text.size()};
}

/// The path and query of the target of a request. The absolute form, `http://HOST/PATH`, names the
/// host, too (RFC 9112, section 3.2.2).
std::string_view path_of_target(std::string_view target) {
    constexpr std::string_view kScheme = "http://";
    const std::string_view beginning = target.substr(0, kScheme.size());
    const auto text = [](std::string_view view) {
        return beast::string_view(view.data(), view.size());
    };
    if (!beast::iequals(text(beginning), text(kScheme))) { // only a path
        return target;
    }
    const std::size_t path = target.find_first_of("/?", kScheme.size());
    return path == std::string_view::npos || target[path] == '?' ? "/" : target.substr(path);
}

/// A connection: reads a request, lets the pool answer it, and writes the response.
class Session : public std::enable_shared_from_this<Session> {
public:
    Session(Shared& shared, tcp::socket socket) : shared_(shared), stream_(std::move(socket)) {
        shared_.sessions.insert(this);
        ++shared_.service.counts().connections;
    }
    ~Session() {
        shared_.sessions.erase(this);
        --shared_.service.counts().connections;
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void read() {
        parser_.emplace();
        parser_->header_limit(kMaxHeaderBytes);
        is_idle_ = true;
        stream_.expires_after(kIdleTimeout);
        // Only the header: with `Expect: 100-continue`, a client waits before it sends a body.
        http::async_read_header(stream_, buffer_, *parser_,
                                [self = shared_from_this()](beast::error_code error, std::size_t) {
                                    self->is_idle_ = false;
                                    self->answer(error);
                                });
    }
    /// Closes the connection if it waits for a request; otherwise it is closed after the current
    /// response.
    void stop() {
        if (is_idle_) {
            close();
        }
    }
    void close() {
        beast::error_code ignored;
        stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
        stream_.close();
    }

private:
    void answer(beast::error_code error) {
        if (error == http::error::bad_method && skip_empty_line()) {
            read();
            return;
        }
        if (error == http::error::header_limit) {
            refuse(http::status::request_header_fields_too_large);
            return;
        }
        if (error &&
            error.category() == http::make_error_code(http::error::bad_version).category() &&
            error != http::error::end_of_stream && error != http::error::partial_message) {
            refuse(http::status::bad_request);
            return;
        }
        if (error) { // closed by the client, or idle for too long
            close();
            return;
        }
        if (!parser_->is_done()) { // a body follows
            refuse(http::status::payload_too_large);
            return;
        }
        const http::request<http::empty_body>& request = parser_->get();
        const std::size_t hosts = request.count(http::field::host);
        if (hosts > 1 || (hosts == 0 && request.version() != 10)) { // RFC 9112, section 3.2
            refuse(http::status::bad_request);
            return;
        }
        asio::post(shared_.pool, [self = shared_from_this()]() mutable {
            self->respond();
            // write() runs on the network thread, where sessions also end.
            asio::io_context& network = self->shared_.network;
            asio::post(network, [self = std::move(self)] { self->write(); });
        });
    }

    /// Skips an empty line before a request (RFC 9112, section 2.2). False if there is none.
    bool skip_empty_line() {
        const std::string_view text(static_cast<const char*>(buffer_.data().data()),
                                    buffer_.size());
        const bool is_empty = text.starts_with("\r\n");
        buffer_.consume(is_empty ? 2 : 0);
        return is_empty;
    }

    void respond() {
        const http::request<http::empty_body>& request = parser_->get();
        const auto field = [&](http::field name) { return view_of(request[name]); };
        try {
            response_ = shared_.service.respond(
                {view_of(request.method_string()), path_of_target(view_of(request.target())),
                 field(http::field::accept_encoding), field(http::field::if_none_match),
                 field(http::field::range), field(http::field::if_range)});
        } catch (const std::bad_alloc&) {
            response_ = {};
            response_.status = 503;
        }
    }

    void refuse(http::status status) {
        response_ = {};
        response_.status = static_cast<unsigned>(status);
        ++shared_.service.counts().responses[response_.status / 100];
        is_last_ = true;
        write();
    }

    void write() {
        const bool is_bodiless = response_.status == 204 || response_.status == 304;
        message_.emplace();
        message_->result(response_.status);
        message_->version(parser_->get().version() == 10 ? 10 : 11);
        for (const auto& [name, value] : response_.fields) {
            message_->insert(beast::string_view(name.data(), name.size()), value);
        }
        if (response_.body != nullptr && !response_.is_head) {
            message_->body() = {response_.body->data() + response_.first, response_.length};
        }
        if (!is_bodiless) {
            message_->content_length(response_.length);
        }
        is_last_ = is_last_ || shared_.is_stopping || !parser_->get().keep_alive();
        message_->keep_alive(!is_last_);
        stream_.expires_after(kSendTimeout);
        http::async_write(stream_, *message_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                              self->response_.body.reset();
                              if (error || self->is_last_) {
                                  self->close();
                              } else {
                                  self->read();
                              }
                          });
    }

    Shared& shared_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_{kMaxHeaderBytes + 4096};
    std::optional<http::request_parser<http::empty_body>> parser_;
    TileResponse response_;
    std::optional<http::response<http::span_body<const char>>> message_;
    bool is_idle_ = false; // waits for a request
    bool is_last_ = false; // the connection is closed after the current response
};

/// Accepts connections.
class Listener {
public:
    Listener(Shared& shared, std::uint32_t max_connections)
        : shared_(shared), acceptor_(shared.network), retry_(shared.network),
          max_connections_(max_connections) {}

    /// Returns the error message; empty on success.
    std::string open(const tcp::endpoint& endpoint) {
        beast::error_code error;
        acceptor_.open(endpoint.protocol(), error);
        if (!error) {
            acceptor_.set_option(asio::socket_base::reuse_address(true), error);
        }
        if (!error) {
            acceptor_.bind(endpoint, error);
        }
        if (!error) {
            acceptor_.listen(asio::socket_base::max_listen_connections, error);
        }
        return error ? error.message() : std::string();
    }
    [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

    void accept() {
        acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
            if (shared_.is_stopping) {
                return;
            }
            if (error) { // for example, no file descriptor is left
                retry_.expires_after(kPollInterval);
                retry_.async_wait([this](beast::error_code) { accept(); });
                return;
            }
            if (shared_.sessions.size() >= max_connections_) {
                ++shared_.service.counts().refused_connections;
                socket.close(error);
            } else {
                try {
                    socket.set_option(tcp::no_delay(true), error);
                    std::make_shared<Session>(shared_, std::move(socket))->read();
                } catch (const std::bad_alloc&) {
                    ++shared_.service.counts().refused_connections;
                }
            }
            accept();
        });
    }
    void close() {
        beast::error_code ignored;
        acceptor_.close(ignored);
        retry_.cancel();
    }

private:
    Shared& shared_;
    tcp::acceptor acceptor_;
    asio::steady_timer retry_; // accepts again after an error
    std::uint32_t max_connections_;
};

/// Calls should_stop() periodically; once it returns true, closes the connections.
class Stopper {
public:
    Stopper(Shared& shared, Listener& listener, const std::function<bool()>& should_stop)
        : shared_(shared), listener_(listener), should_stop_(should_stop), timer_(shared.network) {}

    void wait() {
        timer_.expires_after(kPollInterval);
        timer_.async_wait([this](beast::error_code) { check(); });
    }

private:
    void check() {
        if (!shared_.is_stopping && should_stop_()) {
            shared_.is_stopping = true;
            end_ = std::chrono::steady_clock::now() + kFinishTimeout;
            listener_.close();
            const std::set<Session*> sessions = shared_.sessions;
            for (Session* const session : sessions) {
                session->stop();
            }
        }
        if (!shared_.is_stopping) {
            wait();
        } else if (!shared_.sessions.empty() && std::chrono::steady_clock::now() < end_) {
            wait();
        } else {
            shared_.network.stop();
        }
    }

    Shared& shared_;
    Listener& listener_;
    const std::function<bool()>& should_stop_;
    asio::steady_timer timer_;
    std::chrono::steady_clock::time_point end_; // when the remaining connections are closed
};

} // namespace

Result<void> serve_tiles(TileService& service,
                         const ServerOptions& options,
                         const std::function<void(const std::string&)>& ready,
                         const std::function<bool()>& should_stop) {
    beast::error_code error;
    const asio::ip::address address = asio::ip::make_address(options.address, error);
    if (error) {
        return Error{
            fmt::format("`{}` is not an address such as 127.0.0.1 or ::1", options.address)};
    }
    if (!address.is_loopback() && !options.is_public) {
        return Error{fmt::format("`{}` can be reached from other machines; --public allows that",
                                 options.address)};
    }
    std::optional<Shared> made;
    try {
        made.emplace(service, Workers(options.threads).count());
    } catch (const boost::system::system_error& failed) { // no thread, or no handle for events
        return Error{fmt::format("cannot start the threads: {}", failed.code().message())};
    }
    Shared& shared = *made;
    Listener listener(shared, options.max_connections);
    if (const std::string mistake = listener.open({address, options.port}); !mistake.empty()) {
        return Error{
            fmt::format("cannot listen at {}:{}: {}", options.address, options.port, mistake)};
    }
    listener.accept();
    Stopper stopper(shared, listener, should_stop);
    stopper.wait();
    const std::string host =
        address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
    ready(fmt::format("http://{}:{}/", host, listener.port()));
    while (!shared.network.stopped()) {
        try {
            shared.network.run();
        } catch (const std::bad_alloc&) { // closes this connection; the others continue
        }
    }
    shared.pool.join();
    return {};
}

} // namespace lsys
