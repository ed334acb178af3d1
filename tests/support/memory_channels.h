// SPDX-License-Identifier: Apache-2.0
// The network's twin without sockets, for tests: states may be lost, everything may be late.
#pragma once

#include <memory>

#include "common/net/channels.h"

namespace aquarama::test {

struct MemoryNetFaults {
    net::Duration delay{};         // of every message
    unsigned lostStatesPer64 = 0;  // control is as reliable as TCP; states are not
    std::uint32_t seed = 1;        // of what is lost
};

// One master and any number of nodes that reach it; its ends may outlive it.
class MemoryNet {
  public:
    explicit MemoryNet(const MemoryNetFaults& faults = {});
    [[nodiscard]] std::unique_ptr<net::MasterChannels> master();
    [[nodiscard]] std::unique_ptr<net::NodeChannels> node();

    struct Hub;

  private:
    std::shared_ptr<Hub> hub_;
};

}  // namespace aquarama::test
