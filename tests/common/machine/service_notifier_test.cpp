// SPDX-License-Identifier: Apache-2.0
#include "common/machine/service_notifier.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace aquarama::machine {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using namespace std::chrono_literals;

// A service manager: its socket, and what has arrived there.
class Manager {
  public:
    explicit Manager(const std::string& address) : address_{address} {
        sockaddr_un at{};
        at.sun_family = AF_UNIX;
        std::memcpy(at.sun_path, address.data(), address.size());
        if (at.sun_path[0] == '@') at.sun_path[0] = '\0';
        const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address.size());
        EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&at), size), 0);
        setenv("NOTIFY_SOCKET", address.c_str(), 1);
        unsetenv("WATCHDOG_PID");
        setenv("WATCHDOG_USEC", "400000", 1);
    }
    ~Manager() {
        close(socket_);
        unlink(address_.c_str());
        unsetenv("NOTIFY_SOCKET");
        unsetenv("WATCHDOG_USEC");
        unsetenv("WATCHDOG_PID");
    }
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;

    // Since the last call.
    [[nodiscard]] std::vector<std::string> heard() const {
        std::vector<std::string> messages;
        std::array<char, 4096> text{};
        for (;;) {
            const ssize_t size = recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
            if (size < 0) return messages;
            messages.emplace_back(text.data(), static_cast<std::size_t>(size));
        }
    }

  private:
    std::string address_;
    int socket_ = socket(AF_UNIX, SOCK_DGRAM, 0);
};

std::string ownAddress(const std::string& begin) {
    return begin + "aquarama-notify-" + std::to_string(getpid());
}

TEST(ServiceNotifier, saysThatItIsReadyAndAliveToAPathAndToAnAbstractName) {
    for (const std::string& begin : {testing::TempDir(), std::string("@")}) {
        const Manager manager(ownAddress(begin));
        ServiceNotifier service;
        service.status("waiting");
        service.ready();
        service.alive(7);
        service.alive(8);  // not yet due again
        service.stopping();
        service.stopping();
        EXPECT_THAT(
            manager.heard(),
            ElementsAre("STATUS=waiting", "READY=1", "WATCHDOG=1", "STATUS=frame 7", "STOPPING=1"));
    }
}

TEST(ServiceNotifier, saysSoFourTimesInTheTimeAllowed) {
    const Manager manager(ownAddress("@"));
    ServiceNotifier service;
    service.ready();
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < 350ms) {
        service.alive(0);
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_THAT(manager.heard(),
                ElementsAre("READY=1", "WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1"));
}

TEST(ServiceNotifier, asksForPatienceUntilItIsReadyAndForLongWork) {
    const Manager manager(ownAddress("@"));
    ServiceNotifier service;
    service.alive(0);
    service.beginLongWork("building");
    service.endLongWork();
    service.ready();
    service.beginLongWork("building");
    service.endLongWork();
    EXPECT_THAT(manager.heard(),
                ElementsAre("EXTEND_TIMEOUT_USEC=30000000",
                            "STATUS=building\nEXTEND_TIMEOUT_USEC=120000000",
                            "READY=1",
                            "STATUS=building\nWATCHDOG_USEC=120000000",
                            "WATCHDOG_USEC=400000\nWATCHDOG=1"));
}

TEST(ServiceNotifier, isNotWatchedByAWatchdogOfAnotherProcess) {
    const Manager manager(ownAddress("@"));
    setenv("WATCHDOG_PID", "1", 1);
    ServiceNotifier service;
    service.ready();
    service.beginLongWork("building");
    service.endLongWork();
    EXPECT_THAT(manager.heard(),
                ElementsAre("READY=1", "STATUS=building\nEXTEND_TIMEOUT_USEC=120000000"));
}

// Where the manager does not read, its socket is full at some time.
TEST(ServiceNotifier, neverWaitsAndSaysReadyAgain) {
    const Manager manager(ownAddress("@"));
    ServiceNotifier service;
    for (int i = 0; i < 10000; ++i) service.status(std::string(1000, 'x'));
    service.ready();
    const auto filled = manager.heard();
    EXPECT_LT(filled.size(), 10000U);
    EXPECT_NE(filled.back(), "READY=1");
    service.alive(0);
    EXPECT_THAT(manager.heard(), ElementsAre("READY=1", "WATCHDOG=1"));
}

TEST(ServiceNotifier, saysNothingWithoutASocketOrToOneThatIsNone) {
    {
        const Manager manager(ownAddress("@"));
        unsetenv("NOTIFY_SOCKET");
        ServiceNotifier service;
        service.ready();
        service.alive(1);
        EXPECT_THAT(manager.heard(), IsEmpty());
    }
    for (const std::string& address : {std::string("here"), "/" + std::string(200, 'x')}) {
        setenv("NOTIFY_SOCKET", address.c_str(), 1);
        ServiceNotifier service;
        service.ready();
        service.alive(1);
    }
    unsetenv("NOTIFY_SOCKET");
}

}  // namespace
}  // namespace aquarama::machine
