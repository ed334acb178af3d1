// SPDX-License-Identifier: Apache-2.0
// One connection of the web server, over plain TCP or TLS; included by the sources of this folder
// only. Boost's headers are slow to compile: each kind of stream has a source of its own.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>  // before Asio, whose awaitable.hpp of Boost 1.74 forgets it

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "common/web/server.h"

namespace aquarama::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
// Names of Boost's types, with the executor of one thread.
using Tcp = asio::ip::tcp;
using Executor = asio::io_context::executor_type;
using Socket = asio::basic_stream_socket<Tcp, Executor>;
// A TCP stream with a deadline for its operations.
using PlainStream = beast::basic_stream<Tcp, Executor>;
using Clock = std::chrono::steady_clock;

// What all connections of a server share.
struct Shared {
    asio::io_context& io;
    Service& service;
    // How to end each connection that has said nothing whole yet, the longest first.
    std::list<std::function<void()>> waiting = {};
    std::size_t connections = 0;
    std::atomic<std::uint64_t> cutOff = 0;
};

// One place in the list of those that wait, and in the number of connections.
class Seat {
  public:
    Seat(Shared& shared, std::function<void()> cut) : shared_{shared} {
        ++shared_.connections;
        place_ = shared_.waiting.insert(shared_.waiting.end(), std::move(cut));
        waits_ = true;
    }
    ~Seat() {
        settle();
        --shared_.connections;
    }
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;
    // It has said something whole: it is not cut off for others any more.
    void settle() {
        if (std::exchange(waits_, false)) shared_.waiting.erase(place_);
    }

  private:
    Shared& shared_;
    std::list<std::function<void()>>::iterator place_;
    bool waits_ = false;
};

// The waiting messages of one WebSocket.
class TopicOutbox final : public Outbox {
  public:
    explicit TopicOutbox(const Executor& executor) : wake{executor, Clock::time_point::max()} {}
    void put(const std::string& topic, Payload payload, bool isBinary) override {
        if (waiting.size() < kMostTopics || waiting.contains(topic))
            waiting[topic] = {std::move(payload), isBinary};
        wake.cancel();
    }
    void close(std::uint16_t code) override {
        closeCode = code;
        wake.cancel();
    }

    // A new topic beyond this number is dropped, so that an outbox is bounded.
    static constexpr std::size_t kMostTopics = 200;
    std::map<std::string, std::pair<Payload, bool>> waiting;
    asio::basic_waitable_timer<Clock, asio::wait_traits<Clock>, Executor>
        wake;  // cancelled when there is something
    // Once it is set, what still waits is not sent.
    std::optional<std::uint16_t> closeCode;
    // Set by listen() when the client has gone.
    bool isClosed = false;
};

// A request as Boost has it.
using BeastRequest = http::request<http::string_body>;
// Between the types of Beast and the plain ones of the service; defined in server.cpp. `peer`: the
// address that the connection comes from. The plain request has no body.
[[nodiscard]] HttpRequest requestOf(const BeastRequest& in, const std::string& peer);
[[nodiscard]] http::response<http::string_body> responseOf(const BeastRequest& in, HttpReply reply);

// Defined in plain.cpp and tls.cpp.
void converse(Shared& shared, Socket socket);
void converseOverTls(Shared& shared, asio::ssl::context& tls, Socket socket);

// Sends what waits, one topic at a time, until the connection fails or a close code was sent.
template <class Stream>
asio::awaitable<void> speak(beast::websocket::stream<Stream>& socket, TopicOutbox& outbox) {
    beast::error_code error;
    while (!outbox.isClosed && !error) {
        if (outbox.closeCode) {
            co_await socket.async_close(beast::websocket::close_reason(*outbox.closeCode),
                                        asio::redirect_error(asio::use_awaitable, error));
            co_return;
        }
        if (outbox.waiting.empty()) {
            beast::error_code woken;
            co_await outbox.wake.async_wait(asio::redirect_error(asio::use_awaitable, woken));
            outbox.wake.expires_at(Clock::time_point::max());
            continue;
        }
        const auto next = outbox.waiting.extract(outbox.waiting.begin());
        socket.binary(next.mapped().second);
        co_await socket.async_write(asio::buffer(*next.mapped().first),
                                    asio::redirect_error(asio::use_awaitable, error));
    }
}

// A WebSocket from its upgrade to its end. Each of its two coroutines keeps it alive.
template <class Stream>
struct LiveSocket {
    LiveSocket(Stream&& stream, const Executor& executor)
        : socket{std::move(stream)}, outbox{executor} {}
    beast::websocket::stream<Stream> socket;
    TopicOutbox outbox;
    std::unique_ptr<Service::Connection> connection;
};

// Hands each whole message of text to the service; others are ignored. Its end ends speak() as
// well.
template <class Stream>
asio::awaitable<void> listen(Shared& shared, std::shared_ptr<LiveSocket<Stream>> live) {
    beast::error_code error;
    beast::flat_buffer buffer;
    while (!error) {
        co_await live->socket.async_read(buffer, asio::redirect_error(asio::use_awaitable, error));
        if (error) break;
        if (live->socket.got_text())
            live->connection->hear(beast::buffers_to_string(buffer.data()));
        buffer.consume(buffer.size());
    }
    if (error == beast::websocket::error::message_too_big) ++shared.cutOff;
    live->connection.reset();
    live->outbox.isClosed = true;
    live->outbox.wake.cancel();
}

// Holds the socket alive while speak() runs.
template <class Stream>
asio::awaitable<void> speakFor(std::shared_ptr<LiveSocket<Stream>> live) {
    co_await speak(live->socket, live->outbox);
}

// Returns whether the connection may serve another request.
template <class Stream>
asio::awaitable<bool> sayTo(Stream& stream, const BeastRequest& request, HttpReply reply) {
    beast::error_code error;
    auto response = responseOf(request, std::move(reply));
    co_await http::async_write(stream, response, asio::redirect_error(asio::use_awaitable, error));
    co_return !error && response.keep_alive();
}

// The address at its other end, of version 4 also where a socket of version 6 has taken it; empty
// where it has gone already.
template <class Stream>
std::string peerOf(Stream& stream) {
    beast::error_code gone;
    const auto end = beast::get_lowest_layer(stream).socket().remote_endpoint(gone);
    if (gone) return {};
    const asio::ip::address address = end.address();
    const bool isMapped = address.is_v6() && address.to_v6().is_v4_mapped();
    return isMapped ? asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string()
                    : address.to_string();
}

// The stream has no deadline from here on: the WebSocket's pings find out a dead client. A refusal
// is said as plain HTTP.
template <class Stream>
asio::awaitable<void> upgrade(Shared& shared,
                              Stream stream,
                              BeastRequest request,
                              Executor executor) {
    beast::get_lowest_layer(stream).expires_never();
    const std::string peer = peerOf(stream);
    auto live = std::make_shared<LiveSocket<Stream>>(std::move(stream), executor);
    HttpReply refusal;
    live->connection = shared.service.open(requestOf(request, peer), live->outbox, refusal);
    if (!live->connection) {
        auto& lower = live->socket.next_layer();
        beast::get_lowest_layer(lower).expires_after(kRequestTime);
        co_await sayTo(lower, request, std::move(refusal));
        co_return;
    }
    live->socket.set_option(beast::websocket::stream_base::timeout{
        kRequestTime, std::chrono::seconds(20), /*keep_alive_pings=*/true});
    live->socket.read_message_max(kMostMessageBytes);
    live->socket.auto_fragment(false);
    beast::error_code error;
    co_await live->socket.async_accept(request, asio::redirect_error(asio::use_awaitable, error));
    if (error) co_return;
    asio::co_spawn(executor, speakFor(live), asio::detached);
    co_await listen(shared, live);
}

// Of one request, as far as it has come.
using Parser = http::request_parser<http::string_body>;

// The rest of a request whose head was read.
template <class Stream>
asio::awaitable<beast::error_code> readBody(Stream& stream,
                                            beast::flat_buffer& buffer,
                                            Parser& parser,
                                            const BodyLimit& admission) {
    if (parser.content_length().value_or(0) > admission.mostBytes)
        co_return http::make_error_code(http::error::body_limit);
    parser.body_limit(admission.mostBytes);
    beast::get_lowest_layer(stream).expires_after(admission.within);
    beast::error_code error;
    co_await http::async_read(
        stream, buffer, parser, asio::redirect_error(asio::use_awaitable, error));
    co_return error;
}

// Says why the body of a request is not read. What the client sends of it meanwhile is passed
// over: a connection that is closed before takes the answer with it.
template <class Stream>
asio::awaitable<void> refuseBody(Stream& stream, BeastRequest& head, HttpReply refusal) {
    head.keep_alive(false);
    co_await sayTo(stream, head, std::move(refusal));
    beast::get_lowest_layer(stream).expires_after(kRequestTime);
    std::array<char, 16384> waste{};
    beast::error_code error;
    while (!error)
        co_await stream.async_read_some(asio::buffer(waste),
                                        asio::redirect_error(asio::use_awaitable, error));
}

// The next request. Its `place` is the service's. Nothing where the connection ends: it was refused
// or cut off, or had no more to say.
template <class Stream>
asio::awaitable<std::optional<BeastRequest>> nextRequest(Shared& shared,
                                                         Stream& stream,
                                                         beast::flat_buffer& buffer,
                                                         const std::string& peer,
                                                         bool hasServed,
                                                         std::shared_ptr<const void>& place) {
    Parser parser;
    parser.header_limit(kMostHeaderBytes);
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // until it is admitted
    beast::get_lowest_layer(stream).expires_after(kRequestTime);
    beast::error_code error;
    co_await http::async_read_header(
        stream, buffer, parser, asio::redirect_error(asio::use_awaitable, error));
    if (!error) {
        HttpReply refusal;
        const auto admission = shared.service.admit(requestOf(parser.get(), peer), refusal);
        if (!admission) {
            co_await refuseBody(stream, parser.get(), std::move(refusal));
            co_return std::nullopt;
        }
        place = admission->place;
        error = co_await readBody(stream, buffer, parser, *admission);
    }
    if (!error) co_return parser.release();
    const bool isIdle = hasServed && !parser.got_some();  // and may go at any time
    if (error != http::error::end_of_stream && !isIdle) ++shared.cutOff;
    co_return std::nullopt;
}

// Requests one after another, until one becomes a WebSocket. `greet` makes the stream ready.
template <class Stream, class Greet>
asio::awaitable<void> serve(Shared& shared, Stream stream, Executor executor, Greet greet) {
    Seat seat{shared, [&stream] { beast::get_lowest_layer(stream).cancel(); }};
    beast::get_lowest_layer(stream).expires_after(kRequestTime);
    beast::flat_buffer buffer;
    const std::string peer = peerOf(stream);
    bool goesOn = co_await greet(stream);
    if (!goesOn) ++shared.cutOff;
    bool hasServed = false;
    while (goesOn) {
        std::shared_ptr<const void> place;
        auto request = co_await nextRequest(shared, stream, buffer, peer, hasServed, place);
        if (!request) break;
        seat.settle();
        hasServed = true;
        if (beast::websocket::is_upgrade(*request)) {
            co_await upgrade(shared, std::move(stream), *std::move(request), executor);
            co_return;
        }
        HttpRequest whole = requestOf(*request, peer);
        whole.body = std::move(request->body());
        goesOn = co_await sayTo(stream, *request, shared.service.answer(whole));
    }
}

}  // namespace aquarama::web
