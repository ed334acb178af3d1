// SPDX-License-Identifier: Apache-2.0
// Notifications to the service manager that started the program (systemd): ready, alive, ending.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace aquarama::machine {

// The protocol of sd_notify(3): datagrams to the socket in NOTIFY_SOCKET, which is a path or, after
// an @, an abstract name. Without that variable it does nothing. No function waits: a datagram that
// does not fit is lost, except ready(), which alive() repeats.
class ServiceNotifier {
  public:
    // Reads the variables of this process. A WATCHDOG_USEC for another process is ignored.
    ServiceNotifier();
    ~ServiceNotifier();
    ServiceNotifier(const ServiceNotifier&) = delete;
    ServiceNotifier& operator=(const ServiceNotifier&) = delete;

    // One line of printable text, for systemctl status. From any thread.
    void status(const std::string& text);

    // The functions below are for the one loop that is watched.

    // The program is ready. From now on the manager measures the time between two calls of alive().
    void ready();
    // The loop has completed a round. May be called at any rate: it sends four times in the
    // interval that the manager allows, or once a second without an interval. The status names the
    // number of frames so far (0: no change). Before ready() it asks for more time instead.
    void alive(std::uint64_t frames);
    // Announces long work that is not a hang: the manager waits two minutes for endLongWork(). Call
    // it only between two calls of alive().
    void beginLongWork(const std::string& what);
    void endLongWork();
    // The process ends; alive() sends nothing from now on. Any thread.
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
