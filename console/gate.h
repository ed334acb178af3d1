// SPDX-License-Identifier: Apache-2.0
// What stands between a request and the console: which host and origin it names, and who sends it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/web/pages.h"
#include "console/access.h"

namespace aquarama::console {

// The files of ./pages.
[[nodiscard]] std::span<const web::EmbeddedPage> embeddedPages();

// A proxy before the console, which ends TLS.
struct TlsProxy {
    std::string address;  // that it connects from: its X-Forwarded-... headers count, no others
    std::string host;  // by which browsers reach it: "wall.example", or with a port that is not 443
};
// Of "https://wall.example:8443" and the address. Throws Error where one is malformed.
[[nodiscard]] TlsProxy proxyAt(const std::string& publicUrl, const std::string& address);

// How the console is reached.
struct Doors {
    std::vector<std::string> hosts;  // "127.0.0.1:7480": what a Host header may name
    bool isTls = false;
    std::string cookie;  // its name; other consoles of this machine have others
    std::optional<TlsProxy> proxy = {};
};
// Of a console that listens at this address; `names` reach it as well.
[[nodiscard]] Doors doorsOf(const std::string& address,
                            std::uint16_t port,
                            bool isTls,
                            const std::vector<std::string>& names);

// The doors that a request has come through: those of the proxy where it has passed that. A proxy
// on this machine makes nobody local: who comes through it is held to its name, TLS and cookie.
[[nodiscard]] Doors doorsFor(const web::HttpRequest& request, const Doors& doors);
// The address of whoever sends it, as the proxy says where it has passed that.
[[nodiscard]] std::string clientOf(const web::HttpRequest& request, const Doors& doors);

// Why a request is refused, whoever sends it: its host is none of ours, or a page of another origin
// sends it. Empty where it is not. `acts`: it may change something.
[[nodiscard]] std::optional<web::HttpReply> objectionTo(const web::HttpRequest& request,
                                                        const Doors& doors,
                                                        bool acts);

// Who sends it: by the cookie of a session, or the token of a machine.
[[nodiscard]] std::optional<Holder> holderOf(const web::HttpRequest& request,
                                             const Doors& doors,
                                             const Access& access);
// The secret of the session in its cookies; empty where there is none.
[[nodiscard]] std::string sessionIn(const web::HttpRequest& request, const Doors& doors);
// What sets the cookie of a session; an empty secret takes it away.
[[nodiscard]] std::string cookieOf(const Doors& doors, const std::string& secret);

// A page or a file of one; nothing where there is none at this path.
[[nodiscard]] std::optional<web::HttpReply> pageAt(const web::HttpRequest& request);

}  // namespace aquarama::console
