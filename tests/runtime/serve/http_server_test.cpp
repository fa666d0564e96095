// SPDX-License-Identifier: MIT
// The server over real sockets, with a client of bare system calls.
#include "runtime/serve/http_server.h"
#include "tests/support/tile_forest.h"

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <atomic>
#include <future>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace lsys {
namespace {

const TileForest& forest() {
    static const TileForest made = tests::make_small_tile_forest();
    return made;
}

/// A server on a port of its own, until the end of the scope.
class RunningServer {
public:
    explicit RunningServer(std::uint32_t max_connections = 64) : service_(forest(), 1U << 24U) {
        ServerOptions options;
        options.port = 0;
        options.threads = 2;
        options.max_connections = max_connections;
        std::promise<std::string> address;
        thread_ = std::thread([this, options, &address] {
            result_ = serve_tiles(
                service_, options, [&](const std::string& at) { address.set_value(at); },
                [this] { return ends_.load(); });
        });
        const std::string at = address.get_future().get();
        port_ = static_cast<std::uint16_t>(std::stoi(at.substr(at.rfind(':') + 1)));
    }
    ~RunningServer() { stop(); }
    void stop() {
        ends_ = true;
        if (thread_.joinable()) {
            thread_.join();
        }
        CHECK(result_);
    }
    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] TileService& service() { return service_; }

private:
    TileService service_;
    std::atomic<bool> ends_{false};
    Result<void> result_;
    std::uint16_t port_ = 0;
    std::thread thread_;
};

class Client {
public:
    explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_port = htons(port);
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&at), sizeof at) == 0;
    }
    ~Client() { ::close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    void send(const std::string& text) const {
        std::size_t sent = 0;
        while (sent < text.size()) {
            const auto count =
                ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
            if (count <= 0) {
                return;
            }
            sent += static_cast<std::size_t>(count);
        }
    }
    /// Reads up to the end of the connection.
    std::string read_all() const {
        std::string text;
        std::string piece(65'536, '\0');
        for (;;) {
            const auto count = ::recv(socket_, piece.data(), piece.size(), 0);
            if (count <= 0) {
                return text;
            }
            text.append(piece, 0, static_cast<std::size_t>(count));
        }
    }

private:
    int socket_;
    bool connected_ = false;
};

std::string ask(std::uint16_t port, const std::string& request) {
    const Client client(port);
    client.send(request);
    return client.read_all();
}

std::string request_of(const std::string& target,
                       const std::string& more = "Connection: close\r\n") {
    return "GET " + target + " HTTP/1.1\r\nHost: here\r\n" + more + "\r\n";
}

std::string body_of(const std::string& response) {
    const std::size_t end = response.find("\r\n\r\n");
    return end == std::string::npos ? std::string() : response.substr(end + 4);
}

TEST_CASE("a tile comes over the network with its bytes") {
    const RunningServer server;
    const std::string response = ask(server.port(), request_of("/0/0/0.glb"));
    CHECK(response.starts_with("HTTP/1.1 200 OK\r\n"));
    CHECK(response.find("\r\nContent-Type: model/gltf-binary\r\n") != std::string::npos);
    CHECK(body_of(response) == forest().content({}).bytes);
    const std::string tileset = ask(server.port(), request_of("/tileset.json"));
    CHECK(body_of(tileset) == forest().tileset({}));
    CHECK(ask(server.port(), request_of("/none")).starts_with("HTTP/1.1 404 "));
}

TEST_CASE("a connection takes several requests, also at once") {
    const RunningServer server;
    const Client client(server.port());
    client.send(request_of("/health", "") + request_of("/0/0/0.glb", "") +
                "HEAD /0/0/0.glb HTTP/1.1\r\nHost: here\r\n\r\n" + request_of("/health"));
    const std::string text = client.read_all();
    std::size_t count = 0;
    for (std::size_t at = text.find("HTTP/1.1 200"); at != std::string::npos;
         at = text.find("HTTP/1.1 200", at + 1)) {
        ++count;
    }
    CHECK(count == 4);
    CHECK(text.ends_with("\r\n\r\nok\n"));
}

TEST_CASE("bad requests are refused and the connection ends") {
    const RunningServer server;
    CHECK(ask(server.port(), "nonsense\r\n\r\n").starts_with("HTTP/1.1 400 "));
    CHECK(ask(server.port(), std::string("\0\1\2\r\n\r\n", 7)).starts_with("HTTP/1.1 400 "));
    CHECK(ask(server.port(), request_of("/health", "X: " + std::string(20'000, 'x') + "\r\n"))
              .starts_with("HTTP/1.1 431 "));
    CHECK(ask(server.port(), request_of("/" + std::string(20'000, 'x'))).starts_with("HTTP/1.1 4"));
    CHECK(
        ask(server.port(), "POST /health HTTP/1.1\r\nHost: here\r\nContent-Length: 5\r\n\r\nhello")
            .starts_with("HTTP/1.1 413 "));
    CHECK(ask(server.port(), "POST /health HTTP/1.1\r\nHost: here\r\nConnection: close\r\n\r\n")
              .starts_with("HTTP/1.1 405 "));
    CHECK(ask(server.port(), "POST /health HTTP/1.1\r\nHost: here\r\nContent-Length: 3\r\n"
                             "Expect: 100-continue\r\n\r\n")
              .starts_with("HTTP/1.1 413 "));
    CHECK(ask(server.port(), "POST /health HTTP/1.1\r\nHost: here\r\n"
                             "Transfer-Encoding: chunked\r\n\r\n")
              .starts_with("HTTP/1.1 413 "));
    CHECK(ask(server.port(), "GET /health HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 400 "));
    CHECK(ask(server.port(), "GET /health HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n")
              .starts_with("HTTP/1.1 400 "));
    CHECK(body_of(ask(server.port(), request_of("/health"))) == "ok\n");
}

TEST_CASE("the target of a request may name the host") {
    const RunningServer server;
    CHECK(body_of(ask(server.port(), request_of("http://here/health"))) == "ok\n");
    CHECK(body_of(ask(server.port(), request_of("HTTP://here:80/health"))) == "ok\n");
    const std::string page = body_of(ask(server.port(), request_of("/")));
    CHECK(body_of(ask(server.port(), request_of("http://here"))) == page);
    CHECK(body_of(ask(server.port(), request_of("http://here?a/b"))) == page);
    CHECK(body_of(ask(server.port(), "GET /health HTTP/1.0\r\n\r\n")) == "ok\n"); // no host
    CHECK(body_of(ask(server.port(), "\r\n" + request_of("/health"))) == "ok\n");
}

TEST_CASE("connections beyond the limit are closed, and requests cut short do no harm") {
    RunningServer server(8);
    {
        std::vector<std::unique_ptr<Client>> idle;
        for (int i = 0; i < 40; ++i) {
            idle.push_back(std::make_unique<Client>(server.port()));
        }
        while (server.service().counts().refused_connections < 32) {
            std::this_thread::yield();
        }
        CHECK(server.service().counts().connections == 8);
        CHECK(idle.back()->read_all().empty());
        idle.front()->send("GET /0/0/0.glb HTTP/1.1\r\nHo");
        idle[1]->send(request_of("/0/0/0.glb")); // without reading the answer
    }
    while (server.service().counts().connections != 0) {
        std::this_thread::yield();
    }
    CHECK(body_of(ask(server.port(), request_of("/health"))) == "ok\n");
}

TEST_CASE("the server ends with idle connections, and after responses") {
    RunningServer server;
    const Client idle(server.port());
    const Client used(server.port());
    used.send(request_of("/health", ""));
    while (server.service().counts().connections != 2) {
        std::this_thread::yield();
    }
    server.stop();
    CHECK(idle.read_all().empty());
    const std::string answer = used.read_all();
    CHECK((answer.empty() || answer.ends_with("ok\n")));
}

TEST_CASE("an address is refused if it is invalid, in use, or public without permission") {
    TileService service(forest(), 0);
    const auto serve = [&service](const std::string& address, std::uint16_t port) {
        ServerOptions options;
        options.address = address;
        options.port = port;
        return serve_tiles(
            service, options, [](const std::string&) {}, [] { return true; });
    };
    CHECK(serve("here", 0).error().message == "`here` is not an address such as 127.0.0.1 or ::1");
    CHECK(serve("0.0.0.0", 0).error().message ==
          "`0.0.0.0` can be reached from other machines; --public allows that");
    CHECK(serve("127.0.0.1", 0));
    const RunningServer server;
    CHECK(serve("127.0.0.1", server.port()).error().message.starts_with("cannot listen at "));
}

} // namespace
} // namespace lsys
