// SPDX-License-Identifier: Apache-2.0
// What a program tells the service manager that started it (systemd): that it is ready, that its
// loop goes round, that it ends.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace aquarama::machine {

// The protocol of sd_notify(3): datagrams to the socket that NOTIFY_SOCKET names, a path or, after
// an @, an abstract name. Without that variable it does nothing. No function waits: what the socket
// has no room for is lost, apart from ready(), which alive() says again.
class ServiceNotifier {
  public:
    // Of the variables of this process; a WATCHDOG_USEC for another process counts for nothing.
    ServiceNotifier();
    ~ServiceNotifier();
    ServiceNotifier(const ServiceNotifier&) = delete;
    ServiceNotifier& operator=(const ServiceNotifier&) = delete;

    // One line of printable text, for systemctl status. From any thread.
    void status(const std::string& text);

    // The functions below are for the one loop that is watched.

    // It serves; from now on the manager counts the time between two calls of alive().
    void ready();
    // The loop has gone round. Call it as often as you like: it says so four times in the time that
    // the manager allows (once a second where it allows any), with the number of frames so far in
    // the status (0: the status stays). Before ready() it asks for patience instead.
    void alive(std::uint64_t frames);
    // Work that takes long and is no hang: the manager waits two minutes for endLongWork(). Only
    // between alive() and alive().
    void beginLongWork(const std::string& what);
    void endLongWork();
    // The process ends; alive() is silent from now on. From any thread.
    void stopping();

  private:
    using Clock = std::chrono::steady_clock;

    bool send(std::string_view text) const;

    std::string address_;  // of the socket; empty: there is none
    int socket_ = -1;
    std::chrono::microseconds allowed_{};  // between two calls of alive(); 0: any time
    Clock::duration between_{};
    Clock::time_point said_{};
    bool isReady_ = false;
    bool isReadySaid_ = false;
    std::atomic<bool> isStopping_ = false;
};

}  // namespace aquarama::machine
