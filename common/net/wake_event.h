// SPDX-License-Identifier: Apache-2.0
// Lets another thread end a poll on sockets.
#pragma once

namespace aquarama::net {

class WakeEvent {
  public:
    WakeEvent();
    ~WakeEvent();
    WakeEvent(const WakeEvent&) = delete;
    WakeEvent& operator=(const WakeEvent&) = delete;

    void set() const;    // from any thread
    void clear() const;  // by the thread that polls
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

}  // namespace aquarama::net
