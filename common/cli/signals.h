// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM as a call on a thread of their own, so that whatever waits can be told to
// stop.
#pragma once

#include <functional>
#include <thread>

namespace aquarama::cli {

// Before any other thread is made: all of them leave these signals to the watch.
void holdSignals();

class SignalWatch {
  public:
    explicit SignalWatch(std::function<void()> onSignal);

  private:
    std::jthread thread_;
};

}  // namespace aquarama::cli
