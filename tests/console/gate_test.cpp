// SPDX-License-Identifier: Apache-2.0
#include "console/gate.h"

#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::console {
namespace {

using web::HttpRequest;

const Doors kPlain = doorsOf("127.0.0.1", 7480, false, {});
const Doors kTls = doorsOf("192.168.7.1", 443, true, {"master.local"});

int statusOf(const HttpRequest& request, const Doors& doors, bool acts) {
    const auto objection = objectionTo(request, doors, acts);
    return objection ? objection->status : 200;
}

TEST(Gate, aHostThatIsNoneOfOursIsRefusedAlsoOnTheLoopback) {
    for (const char* const host : {"127.0.0.1:7480", "localhost:7480", "[::1]:7480"})
        EXPECT_EQ(statusOf({.host = host}, kPlain, false), 200) << host;
    for (const char* const host : {"",
                                   "evil.example",
                                   "127.0.0.1",
                                   "127.0.0.1:80",
                                   "evil.example:7480",
                                   "127.0.0.1:7480.evil"})
        EXPECT_EQ(statusOf({.host = host}, kPlain, false), 421) << host;
    EXPECT_EQ(statusOf({.host = "master.local:443"}, kTls, false), 200);
}

TEST(Gate, whatActsNamesOurOriginOrShowsAToken) {
    const auto acting = [](const std::string& origin,
                           const std::string& site = "",
                           const std::string& authorization = "") {
        return statusOf({.host = "localhost:7480",
                         .origin = origin,
                         .authorization = authorization,
                         .fetchSite = site},
                        kPlain,
                        true);
    };
    EXPECT_EQ(acting("http://localhost:7480"), 200);
    EXPECT_EQ(acting("http://127.0.0.1:7480", "same-origin"), 200);
    EXPECT_EQ(acting("", "", "Bearer 1234"), 200);
    for (const char* const origin : {"",
                                     "null",
                                     "https://localhost:7480",
                                     "http://localhost",
                                     "http://localhost:7481",
                                     "http://evil.example",
                                     "http://localhost:7480.evil.example",
                                     "localhost:7480"})
        EXPECT_EQ(acting(origin), 403) << origin;
    EXPECT_EQ(acting("http://evil.example", "", "Bearer 1234"), 403);
    EXPECT_EQ(acting("http://localhost:7480", "cross-site"), 403);
    EXPECT_EQ(acting("", "", "Basic 1234"), 403);
}

// A console on the loopback behind a proxy of this machine.
Doors proxied() {
    Doors doors = kPlain;
    doors.proxy = proxyAt("https://Wall.example/", "127.0.0.1");
    return doors;
}

// What the proxy passes on for a browser.
HttpRequest passedOn(const std::string& proto = "https", const std::string& peer = "127.0.0.1") {
    return {.host = "wall.example",
            .origin = "https://wall.example",
            .forwardedFor = "203.0.113.9",
            .forwardedProto = proto,
            .peer = peer};
}

TEST(Gate, whoComesThroughTheProxyIsHeldToItsNameAndTls) {
    const Doors doors = proxied();
    const auto status = [&](const HttpRequest& request) {
        return statusOf(request, doorsFor(request, doors), true);
    };
    EXPECT_EQ(status(passedOn()), 200);
    EXPECT_EQ(status(passedOn("http")), 403) << "a browser without TLS";
    EXPECT_EQ(status(passedOn("")), 403) << "the proxy does not say";
    EXPECT_EQ(status(passedOn("https", "127.0.0.2")), 421) << "not the proxy";
    HttpRequest local = passedOn();
    local.host = "127.0.0.1:7480";
    EXPECT_EQ(status(local), 421) << "a proxy on this machine makes nobody local";
    local.origin = "http://127.0.0.1:7480";
    EXPECT_EQ(status(local), 421);
    HttpRequest other = passedOn();
    other.origin = "https://evil.example";
    EXPECT_EQ(status(other), 403);
    other.origin = "http://wall.example";
    EXPECT_EQ(status(other), 403);
    EXPECT_EQ(statusOf(passedOn(), doorsFor(passedOn(), kPlain), true), 421)
        << "without the option";
    // Beside it, the console is reached on its machine as ever.
    const HttpRequest own{
        .host = "127.0.0.1:7480", .origin = "http://127.0.0.1:7480", .peer = "127.0.0.1"};
    EXPECT_EQ(status(own), 200);
    EXPECT_EQ(doorsFor(own, doors).cookie, "aquarama_7480");
    const std::string cookie = cookieOf(doorsFor(passedOn(), doors), "abc");
    EXPECT_TRUE(cookie.starts_with("__Host-aquarama=abc;")) << cookie;
    EXPECT_NE(cookie.find("; Secure"), std::string::npos);
}

TEST(Gate, theClientIsTheOneThatTheProxyHasWrittenLast) {
    const auto client = [](const std::string& list, const std::string& peer) {
        HttpRequest request = passedOn("https", peer);
        request.forwardedFor = list;
        return clientOf(request, proxied());
    };
    EXPECT_EQ(client("203.0.113.9", "127.0.0.1"), "203.0.113.9");
    EXPECT_EQ(client("10.0.0.1, 203.0.113.9", "127.0.0.1"), "203.0.113.9");
    EXPECT_EQ(client("10.0.0.1,2001:db8::9", "127.0.0.1"), "2001:db8::9");
    EXPECT_EQ(client("203.0.113.9", "127.0.0.2"), "127.0.0.2") << "anybody may write the header";
    EXPECT_EQ(client("x\ny" + std::string(500, 'a'), "127.0.0.1").size(), 45U);
}

TEST(Gate, theAddressOfAProxyIsCheckedWhenItIsRead) {
    EXPECT_EQ(proxyAt("https://wall.example:443", "::1").host, "wall.example");
    EXPECT_EQ(proxyAt("https://wall.example:8443", "10.1.2.3").host, "wall.example:8443");
    for (const char* const url :
         {"", "wall.example", "http://wall.example", "https://", "https://a/b"})
        EXPECT_THROW(static_cast<void>(proxyAt(url, "127.0.0.1")), Error) << url;
    for (const char* const address : {"", "localhost", "127.0.0.1:80", "10.0.0.0/8"})
        EXPECT_THROW(static_cast<void>(proxyAt("https://wall.example", address)), Error) << address;
}

TEST(Gate, theSessionIsFoundAmongTheCookies) {
    const auto found = [](const std::string& cookie) {
        return sessionIn({.cookie = cookie}, kPlain);
    };
    EXPECT_EQ(found("aquarama_7480=abc"), "abc");
    EXPECT_EQ(found("x=1; aquarama_7480=abc; y=2"), "abc");
    for (const char* const none :
         {"", ";", "; ;", "aquarama_7481=abc", "xaquarama_7480=abc", "aquarama_7480"})
        EXPECT_EQ(found(none), "") << none;
    EXPECT_EQ(sessionIn({.cookie = "__Host-aquarama=abc"}, kTls), "abc");
}

TEST(Gate, aCookieIsNeverSeenByScriptsOrOtherSites) {
    const std::string plain = cookieOf(kPlain, "abc");
    for (const char* const part : {"HttpOnly", "SameSite=Strict", "Path=/"})
        EXPECT_NE(plain.find(part), std::string::npos) << part;
    EXPECT_NE(cookieOf(kTls, "abc").find("; Secure"), std::string::npos);
    EXPECT_TRUE(cookieOf(kTls, "abc").starts_with("__Host-aquarama=abc;"));
    EXPECT_NE(cookieOf(kPlain, "").find("Max-Age=0"), std::string::npos);
}

TEST(Gate, pagesAreServedWithTheirDigestAndNothingElse) {
    const auto page = pageAt({.target = "/"});
    ASSERT_TRUE(page);
    EXPECT_TRUE(page->body.starts_with("<!doctype html>"));
    EXPECT_TRUE(page->type.starts_with("text/html"));
    const std::string etag = page->headers.at(0).second;
    EXPECT_EQ(pageAt({.target = "/index.html", .etag = etag})->status, 304);
    EXPECT_TRUE(pageAt({.target = "/vendor/lit-html.js"})->type.starts_with("text/javascript"));
    for (const char* const none : {"/nothing", "", "/../console.css", "/texts/", "console.js"})
        EXPECT_FALSE(pageAt({.target = none})) << none;
}

}  // namespace
}  // namespace aquarama::console
