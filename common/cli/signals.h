// SPDX-License-Identifier: Apache-2.0
// SIGINT, SIGTERM and SIGHUP as a call on a thread of their own, so that a loop that waits for
// something else can be told to end.
#pragma once

#include <functional>
#include <thread>

namespace aquarama::cli {

// Blocks these signals. Call it before any other thread is made: threads inherit it, and leave the
// signals to the watch.
void holdSignals();

// Calls `onSignal` for each of these signals, on its own thread, as long as it lives.
class SignalWatch {
  public:
    explicit SignalWatch(std::function<void()> onSignal);

  private:
    std::jthread thread_;
};

}  // namespace aquarama::cli
