// SPDX-License-Identifier: Apache-2.0
// Bounded waits of tests: what never comes fails after half a minute and does not hang.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include "common/net/channels.h"

namespace aquarama::test {

inline constexpr std::chrono::seconds kPatience{30};

// Waits until the condition holds. False: it did not within half a minute.
template <typename Condition>
[[nodiscard]] bool comesTrue(const Condition& condition) {
    const net::Moment end = net::monotonicNow() + kPatience;
    while (!condition()) {
        if (net::monotonicNow() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

// Runs the action on a thread of its own and waits for its end. False: it did not end within half a
// minute; it is left behind, so it must own whatever it uses.
template <typename Action>
[[nodiscard]] bool ends(Action action) {
    const auto ended = std::make_shared<std::promise<void>>();
    std::thread([ended, action = std::move(action)]() mutable {
        action();
        ended->set_value();
    }).detach();
    return ended->get_future().wait_for(kPatience) == std::future_status::ready;
}

}  // namespace aquarama::test
