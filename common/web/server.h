// SPDX-License-Identifier: Apache-2.0
// A small web server: one thread, HTTP/1.1 and WebSockets, plain or over TLS. No header of Boost is
// seen outside of this folder.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace aquarama::web {

// What a browser or a program asks for. Headers that are absent are empty.
struct HttpRequest {
    std::string method = {}, target = {};
    std::string host = {}, origin = {}, cookie = {}, authorization = {};
    std::string contentType = {}, fetchSite = {}, etag = {};
    std::string forwardedFor = {}, forwardedProto = {};  // X-Forwarded-...: anybody may write them
    std::string peer = {};                               // address that the connection comes from
    std::string body = {};
};

// What the service answers. `headers` are added to those that every reply has.
struct HttpReply {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body = {};
    std::vector<std::pair<std::string, std::string>> headers = {};
};

// Bounds. What exceeds them is cut off and counted.
inline constexpr std::size_t kMostHeaderBytes = 8192;
inline constexpr std::size_t kMostBodyBytes = 65536;
inline constexpr std::size_t kMostMessageBytes = 65536;
// How long a client may take for its whole request, and for a handshake.
inline constexpr std::chrono::seconds kRequestTime{5};

// What the body of a request may be.
struct BodyLimit {
    std::size_t mostBytes = kMostBodyBytes;
    std::chrono::seconds within = kRequestTime;
    // Let go of when the request has ended, however it ends; so a service can count those with
    // long bodies.
    std::shared_ptr<const void> place = {};
};

// Shared by all who get it.
using Payload = std::shared_ptr<const std::string>;

// The sending end of a WebSocket. Holds the latest of each topic, so nothing grows with a slow
// reader. Of the server's thread.
class Outbox {
  public:
    virtual ~Outbox() = default;
    // Replaces what waits under this topic.
    virtual void put(const std::string& topic, Payload payload, bool isBinary) = 0;
    // Ends the connection with this code of the application (4000 to 4999).
    virtual void close(std::uint16_t code) = 0;
};

// What the server does for its clients. All calls come from the server's thread.
class Service {
  public:
    virtual ~Service() = default;
    // Before the body of a request is read, of which `head` has all else. Nothing: it is not read,
    // and `refusal` is said.
    [[nodiscard]] virtual std::optional<BodyLimit> admit(const HttpRequest& /*head*/,
                                                         HttpReply& /*refusal*/) {
        return BodyLimit{};
    }
    // For every request that opens no WebSocket.
    [[nodiscard]] virtual HttpReply answer(const HttpRequest& request) = 0;
    // One end of a WebSocket that was opened; destroyed when it is closed.
    class Connection {
      public:
        virtual ~Connection() = default;
        // A whole message of text, of kMostMessageBytes at most.
        virtual void hear(const std::string& text) = 0;
    };
    // Lets a WebSocket in, or says in `refusal` why not. The outbox outlives the connection.
    [[nodiscard]] virtual std::unique_ptr<Connection> open(const HttpRequest& request,
                                                           Outbox& outbox,
                                                           HttpReply& refusal) = 0;
    // Ten times a second.
    virtual void tick() = 0;
};

// Where to listen, and with which certificate.
struct ServerOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;       // 0: a free one
    std::string certificateFile;  // PEM; empty: without TLS
    std::string keyFile;
    std::size_t mostConnections = 512;  // above, the one that waits longest is cut off
};

// One thread calls run(); the others may call post() and stop().
class WebServer {
  public:
    // Listens. Throws Error: the address cannot be had, a certificate that cannot be read.
    WebServer(const ServerOptions& options, Service& service);
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    // Certificate and key of connections from now on; those that there are go on. Of the server's
    // thread. Throws Error where they do not fit, and keeps the last ones.
    void useCertificate(const std::string& certificateFile, const std::string& keyFile);

    void run();   // until stop()
    void stop();  // from any thread
    // Has the server's thread do something soon; from any thread.
    void post(std::function<void()> what);
    [[nodiscard]] std::uint16_t port() const;  // that it listens at
    // Connections that were cut off: too many, too large, too slow, or not HTTP.
    [[nodiscard]] std::uint64_t cutOff() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aquarama::web
