// SPDX-License-Identifier: Apache-2.0
#include "common/machine/service_notifier.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::machine {

namespace {

using namespace std::chrono_literals;

// The time for long work that is not a hang, such as compiling shaders without a graphics card.
constexpr std::chrono::microseconds kPatience = 120s;
// The time that each request before ready() asks for: more than the time between two calls of
// alive().
constexpr std::chrono::microseconds kPatienceWhileWaiting = 30s;

// A variable of the environment; empty where it is not set.
std::string variable(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets them
    return value != nullptr ? value : "";
}

// The number in a text; 0 where the text is not a number.
std::int64_t numberIn(const std::string& text) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? number : 0;
}

// The interval that the manager allows between two notifications; 0: this process is not watched.
std::chrono::microseconds allowedTime() {
    const std::string process = variable("WATCHDOG_PID");
    const bool isOfAnother = !process.empty() && numberIn(process) != getpid();
    const std::int64_t allowed = isOfAnother ? 0 : numberIn(variable("WATCHDOG_USEC"));
    return std::chrono::microseconds(std::max<std::int64_t>(allowed, 0));
}

// The address of a socket: a path, or an abstract name after an @.
bool isAddress(const std::string& text) {
    return (text.starts_with('/') || text.starts_with('@')) && text.size() > 1 &&
           text.size() < sizeof(sockaddr_un::sun_path);
}

std::string setting(std::string_view name, std::chrono::microseconds time) {
    return std::string(name) + "=" + std::to_string(time.count());
}

}  // namespace

ServiceNotifier::ServiceNotifier() : allowed_{allowedTime()} {
    between_ = allowed_.count() > 0 ? Clock::duration(allowed_) / 4 : Clock::duration(1s);
    const std::string address = variable("NOTIFY_SOCKET");
    if (address.empty()) return;
    if (!isAddress(address)) {
        logWarning(
            "NOTIFY_SOCKET \"{}\" is no path of a socket: the service manager is told "
            "nothing",
            address);
        return;
    }
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket_ >= 0) address_ = address;
}

ServiceNotifier::~ServiceNotifier() {
    if (socket_ >= 0) close(socket_);
}

bool ServiceNotifier::send(std::string_view text) const {
    if (address_.empty()) return true;
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    std::memcpy(to.sun_path, address_.data(), address_.size());
    if (to.sun_path[0] == '@') to.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
    const ssize_t sent = sendto(socket_,
                                text.data(),
                                text.size(),
                                MSG_DONTWAIT | MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&to),
                                size);
    return sent == static_cast<ssize_t>(text.size());
}

void ServiceNotifier::status(const std::string& text) {
    assert(text.find('\n') == std::string::npos);
    send("STATUS=" + text);
}

void ServiceNotifier::ready() {
    isReady_ = true;
    if (!isReadySaid_) isReadySaid_ = send("READY=1");
}

void ServiceNotifier::alive(std::uint64_t frames) {
    const Clock::time_point now = Clock::now();
    if (address_.empty() || isStopping_ || now - said_ < between_) return;
    said_ = now;
    if (!isReady_) {
        send(setting("EXTEND_TIMEOUT_USEC", kPatienceWhileWaiting));
        return;
    }
    ready();
    send("WATCHDOG=1");
    if (frames > 0) status("frame " + std::to_string(frames));
}

void ServiceNotifier::beginLongWork(const std::string& what) {
    const bool isWatched = isReady_ && allowed_.count() > 0;
    send("STATUS=" + what + "\n" +
         setting(isWatched ? "WATCHDOG_USEC" : "EXTEND_TIMEOUT_USEC",
                 std::max(kPatience, allowed_)));
}

void ServiceNotifier::endLongWork() {
    if (isReady_ && allowed_.count() > 0) send(setting("WATCHDOG_USEC", allowed_) + "\nWATCHDOG=1");
}

void ServiceNotifier::stopping() {
    if (!isStopping_.exchange(true)) send("STOPPING=1");
}

}  // namespace aquarama::machine
