// SPDX-License-Identifier: Apache-2.0
#include "common/web/server.h"

#include "common/base/log.h"
#include "common/web/conversation.h"

namespace aquarama::web {

namespace {

// Empty where the request lacks the field.
std::string header(const BeastRequest& in, http::field field) {
    const auto value = in[field];
    return {value.data(), value.size()};
}

std::string header(const BeastRequest& in, const char* field) {
    const auto value = in[field];
    return {value.data(), value.size()};
}

// What every reply says: nothing of another origin runs or is asked, nobody frames it or keeps it.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src "
    "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

// What the service needs of it, in plain types.
HttpRequest requestOf(const BeastRequest& in, const std::string& peer) {
    const auto method = in.method_string();
    const auto target = in.target();
    return {.method = {method.data(), method.size()},
            .target = {target.data(), target.size()},
            .host = header(in, http::field::host),
            .origin = header(in, http::field::origin),
            .cookie = header(in, http::field::cookie),
            .authorization = header(in, http::field::authorization),
            .contentType = header(in, http::field::content_type),
            .fetchSite = header(in, "Sec-Fetch-Site"),
            .etag = header(in, http::field::if_none_match),
            .forwardedFor = header(in, "X-Forwarded-For"),
            .forwardedProto = header(in, "X-Forwarded-Proto"),
            .peer = peer};
}

// Pages are looked for again each time; their tag spares the content.
http::response<http::string_body> responseOf(const BeastRequest& in, HttpReply reply) {
    http::response<http::string_body> out{static_cast<http::status>(reply.status), in.version()};
    out.set(http::field::content_type, reply.type);
    out.set("Content-Security-Policy", kPolicy);
    out.set("X-Content-Type-Options", "nosniff");
    out.set("Referrer-Policy", "no-referrer");
    out.set("Cross-Origin-Resource-Policy", "same-origin");
    out.set(http::field::cache_control, "no-cache");
    for (const auto& [name, value] : reply.headers) out.set(name, value);
    out.keep_alive(in.keep_alive());
    const bool isHead = in.method() == http::verb::head;
    const std::size_t size = reply.body.size();
    if (!isHead) out.body() = std::move(reply.body);
    out.prepare_payload();
    if (isHead) out.content_length(size);
    return out;
}

// All but `io` and the atomic counter belongs to the thread that calls run().
struct WebServer::Impl {
    Impl(const ServerOptions& options, Service& service)
        : shared{io, service}, acceptor{io}, mostConnections{options.mostConnections} {
        try {
            listenAt(options);
        } catch (const boost::system::system_error& problem) {
            throw Error("browsers cannot be served at " + options.address + ":" +
                        std::to_string(options.port) + " (" + problem.code().message() +
                        "); another program has it, or the address is none of this machine's");
        }
        if (!options.certificateFile.empty())
            readCertificate(options.certificateFile, options.keyFile);
        asio::co_spawn(io, accept(), asio::detached);
        asio::co_spawn(io, keepTime(), asio::detached);
    }

    // Throws Boost's system_error, which the constructor turns into an Error.
    void listenAt(const ServerOptions& options) {
        const Tcp::endpoint end{asio::ip::make_address(options.address), options.port};
        acceptor.open(end.protocol());
        acceptor.set_option(Tcp::acceptor::reuse_address(true));
        acceptor.bind(end);
        acceptor.listen();
    }

    // TLS 1.2 and later. Connections that there are hold OpenSSL's part of the former context.
    // Throws Error where the certificate or its key cannot be read.
    void readCertificate(const std::string& certificateFile, const std::string& keyFile) {
        try {
            asio::ssl::context fresh(asio::ssl::context::tls_server);
            fresh.set_options(asio::ssl::context::no_tlsv1 | asio::ssl::context::no_tlsv1_1);
            fresh.use_certificate_chain_file(certificateFile);
            fresh.use_private_key_file(keyFile, asio::ssl::context::pem);
            tls.emplace(std::move(fresh));
        } catch (const boost::system::system_error& problem) {
            throw Error(certificateFile + ": is no certificate with its key beside it (" +
                        problem.code().message() + "); make another with --certify");
        }
    }

    // An error of one connection is passed over; a closed acceptor ends it.
    asio::awaitable<void> accept() {
        while (true) {
            beast::error_code error;
            Socket socket =
                co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
            if (error == asio::error::operation_aborted) co_return;
            if (error) continue;
            begin(std::move(socket));
        }
    }

    // At the limit, the connection that has waited longest without a whole request is cut off.
    // Where none waits, the new one is.
    void begin(Socket socket) {
        if (shared.connections >= mostConnections) {
            ++shared.cutOff;
            if (shared.waiting.empty()) return;  // closes this one
            shared.waiting.front()();
            shared.waiting.front() = [] {};  // ends soon; meanwhile the next is the first
            shared.waiting.splice(shared.waiting.end(), shared.waiting, shared.waiting.begin());
        }
        beast::error_code ignored;
        socket.set_option(Tcp::no_delay(true), ignored);
        constexpr int kSendBuffer = 256 * 1024;  // a slow reader hides no more than that
        socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
        if (tls)
            converseOverTls(shared, *tls, std::move(socket));
        else
            converse(shared, std::move(socket));
    }

    // Calls Service::tick() 100 ms after the last call has returned.
    asio::awaitable<void> keepTime() {
        asio::steady_timer timer{io};
        while (true) {
            timer.expires_after(std::chrono::milliseconds(100));
            beast::error_code error;
            co_await timer.async_wait(asio::redirect_error(asio::use_awaitable, error));
            shared.service.tick();
        }
    }

    Shared shared;  // outlives `io`, with whose end those of the connections come
    asio::io_context io{1};
    asio::basic_socket_acceptor<Tcp, Executor> acceptor;
    std::size_t mostConnections;
    std::optional<asio::ssl::context> tls;
};

WebServer::WebServer(const ServerOptions& options, Service& service)
    : impl_{std::make_unique<Impl>(options, service)} {}

WebServer::~WebServer() = default;

void WebServer::useCertificate(const std::string& certificateFile, const std::string& keyFile) {
    impl_->readCertificate(certificateFile, keyFile);
}

// One thread: nothing in the service needs a lock.
void WebServer::run() {
    impl_->io.run();
}

// Asio lets any thread call this.
void WebServer::stop() {
    impl_->io.stop();
}

// What is posted after the end of run() is not done.
void WebServer::post(std::function<void()> what) {
    asio::post(impl_->io, std::move(what));
}

// The port that the system chose where the options have 0.
std::uint16_t WebServer::port() const {
    return impl_->acceptor.local_endpoint().port();
}

std::uint64_t WebServer::cutOff() const {
    return impl_->shared.cutOff;
}

}  // namespace aquarama::web
