// SPDX-License-Identifier: Apache-2.0
#include "console/gate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <arpa/inet.h>

#include "common/base/log.h"
#include "common/config/host.h"

namespace aquarama::console {

namespace {

using web::HttpReply;
using web::HttpRequest;

// How the Authorization header begins with a token (RFC 6750).
constexpr std::string_view kBearer = "Bearer ";

// Whole, with the port: browsers send it so.
bool isOwnHost(const std::string& host, const Doors& doors) {
    return std::ranges::find(doors.hosts, host) != doors.hosts.end();
}

// Scheme, name and port; "null" is none.
bool isOwnOrigin(const std::string& origin, const Doors& doors) {
    const std::string scheme = doors.isTls ? "https://" : "http://";
    return origin.starts_with(scheme) && isOwnHost(origin.substr(scheme.size()), doors);
}

// Nothing that the proxy passes on lacks both headers; docs/console.md has its settings.
bool hasPassedProxy(const HttpRequest& request, const Doors& doors) {
    return doors.proxy && request.peer == doors.proxy->address &&
           !(request.forwardedFor.empty() && request.forwardedProto.empty());
}

}  // namespace

// The loopback's three names are ours wherever we listen.
Doors doorsOf(const std::string& address,
              std::uint16_t port,
              bool isTls,
              const std::vector<std::string>& names) {
    const std::string end = ":" + std::to_string(port);
    Doors doors{{}, isTls, {}, {}};
    for (const char* const own : {"127.0.0.1", "localhost", "[::1]"})
        doors.hosts.push_back(own + end);
    doors.hosts.push_back(config::bracketed(address) + end);
    for (const std::string& name : names) doors.hosts.push_back(name + end);
    doors.cookie =
        isTls ? "__Host-aquarama" : "aquarama_" + std::to_string(port);  // no cookie knows a port
    return doors;
}

// Lower case, as browsers send hosts; without a path.
TlsProxy proxyAt(const std::string& publicUrl, const std::string& address) {
    constexpr std::string_view kScheme = "https://";
    constexpr std::string_view kOfHosts = "abcdefghijklmnopqrstuvwxyz0123456789.-:[]";
    std::string host = publicUrl.starts_with(kScheme) ? publicUrl.substr(kScheme.size()) : "";
    if (host.ends_with('/')) host.pop_back();
    std::ranges::transform(host, host.begin(), [](unsigned char c) { return std::tolower(c); });
    if (host.empty() || host.find_first_not_of(kOfHosts) != std::string::npos)
        throw Error("--public " + publicUrl +
                    ": is no address of a proxy that ends TLS; write https://NAME, without a path");
    if (host.ends_with(":443")) host.resize(host.size() - std::string_view(":443").size());
    in6_addr parsed{};
    if (inet_pton(AF_INET, address.c_str(), &parsed) != 1 &&
        inet_pton(AF_INET6, address.c_str(), &parsed) != 1)
        throw Error("--proxy " + address +
                    ": is no address that the proxy connects from; write its number, as 127.0.0.1");
    return {address, host};
}

// As a console of that name and TLS would be reached.
Doors doorsFor(const HttpRequest& request, const Doors& doors) {
    if (!hasPassedProxy(request, doors)) return doors;
    return {{doors.proxy->host}, true, "__Host-aquarama", doors.proxy};
}

// The proxy writes the last; what stands before it came from outside. Bounded, since it is kept.
std::string clientOf(const HttpRequest& request, const Doors& doors) {
    if (!hasPassedProxy(request, doors)) return request.peer;
    constexpr std::size_t kMostBytes = 45;  // of an address of version 6
    std::string last = request.forwardedFor.substr(request.forwardedFor.rfind(',') + 1);
    std::erase_if(last, [](unsigned char c) { return c <= ' ' || c >= 0x7F; });
    last.resize(std::min(last.size(), kMostBytes));
    return last;
}

// A browser names the origin with everything that acts; programs do not, and show a token instead.
std::optional<HttpReply> objectionTo(const HttpRequest& request, const Doors& doors, bool acts) {
    if (!isOwnHost(request.host, doors))
        return HttpReply{.status = 421,
                         .body =
                             "this console is not reached by that name; start it with --name, "
                             "behind a proxy with --public and --proxy\n"};
    if (hasPassedProxy(request, doors) && request.forwardedProto != "https")
        return HttpReply{.status = 403,
                         .body =
                             "the proxy passes on what came without TLS, or does not say "
                             "X-Forwarded-Proto: https\n"};
    if (!acts) return std::nullopt;
    const bool isProgram = request.origin.empty() && request.authorization.starts_with(kBearer);
    const bool isOurPage = isOwnOrigin(request.origin, doors) &&
                           (request.fetchSite.empty() || request.fetchSite == "same-origin");
    if (isProgram || isOurPage) return std::nullopt;
    return HttpReply{.status = 403, .body = "a page of another origin may not ask this\n"};
}

// Other programs of this machine set cookies for it as well.
std::string sessionIn(const HttpRequest& request, const Doors& doors) {
    const std::string wanted = doors.cookie + "=";
    std::size_t begin = 0;
    while (begin < request.cookie.size()) {
        const std::size_t end = std::min(request.cookie.find(';', begin), request.cookie.size());
        const std::string one = request.cookie.substr(begin, end - begin);
        const std::size_t first = one.find_first_not_of(' ');
        if (first != std::string::npos && one.compare(first, wanted.size(), wanted) == 0)
            return one.substr(first + wanted.size());
        begin = end + 1;
    }
    return {};
}

// A token goes before a cookie.
std::optional<Holder> holderOf(const HttpRequest& request,
                               const Doors& doors,
                               const Access& access) {
    if (request.authorization.starts_with(kBearer))
        return access.token(std::string_view(request.authorization).substr(kBearer.size()));
    const std::string secret = sessionIn(request, doors);
    return secret.empty() ? std::nullopt : access.session(secret, unixNow());
}

// Strict: no other site's link brings it along.
std::string cookieOf(const Doors& doors, const std::string& secret) {
    constexpr int kSeconds = 30 * 86400;
    return doors.cookie + "=" + secret + "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" +
           std::to_string(secret.empty() ? 0 : kSeconds) + (doors.isTls ? "; Secure" : "");
}

std::optional<HttpReply> pageAt(const HttpRequest& request) {
    return web::pageAt(embeddedPages(), request);
}

}  // namespace aquarama::console
