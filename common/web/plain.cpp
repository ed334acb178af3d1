// SPDX-License-Identifier: Apache-2.0
// Connections without TLS.
#include "common/web/conversation.h"

namespace aquarama::web {

// Nothing comes before the first request.
void converse(Shared& shared, Socket socket) {
    const Executor executor = shared.io.get_executor();
    const auto greet = [](PlainStream&) -> asio::awaitable<bool> { co_return true; };
    asio::co_spawn(
        executor, serve(shared, PlainStream{std::move(socket)}, executor, greet), asio::detached);
}

}  // namespace aquarama::web
