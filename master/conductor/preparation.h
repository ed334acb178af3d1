// SPDX-License-Identifier: Apache-2.0
// What a master answers before its show begins: that it prepares, and what.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "common/net/channels.h"

namespace aquarama::conductor {

// Answers nodes, consoles and commands on a thread of its own. As long as it lives, nobody else may
// use the channels.
class Preparation {
  public:
    explicit Preparation(net::MasterChannels& channels);
    // Ends the thread; the channels are free again.
    ~Preparation();
    Preparation(const Preparation&) = delete;
    Preparation& operator=(const Preparation&) = delete;

    // What is under way, as "capturing 3 of 7 species"; from any thread. Returns the sentence that
    // is answered.
    std::string tell(const std::string& what);
    // Another sentence; from any thread.
    void say(const std::string& sentence);

  private:
    void run();
    void answer(const net::FromPeer& from);

    net::MasterChannels& channels_;
    std::mutex mutex_;  // guards the sentence
    std::string sentence_ = "the master prepares";
    std::atomic<bool> isOver_ = false;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace aquarama::conductor
