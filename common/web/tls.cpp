// SPDX-License-Identifier: Apache-2.0
// Connections over TLS.
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include "common/web/conversation.h"

namespace aquarama::web {

// The handshake comes first, within the time of a request.
void converseOverTls(Shared& shared, asio::ssl::context& tls, Socket socket) {
    using TlsStream = asio::ssl::stream<PlainStream>;
    const Executor executor = shared.io.get_executor();
    const auto greet = [](TlsStream& stream) -> asio::awaitable<bool> {
        beast::error_code error;
        co_await stream.async_handshake(asio::ssl::stream_base::server,
                                        asio::redirect_error(asio::use_awaitable, error));
        co_return !error;
    };
    asio::co_spawn(executor,
                   serve(shared, TlsStream{PlainStream{std::move(socket)}, tls}, executor, greet),
                   asio::detached);
}

}  // namespace aquarama::web
