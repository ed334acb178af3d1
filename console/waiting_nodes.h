// SPDX-License-Identifier: Apache-2.0
// Nodes without a key that wait for a channel on the show's network, and giving them one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/enrol/discovery.h"
#include "console/access.h"
#include "console/console.pb.h"

namespace aquarama::console {

// A node, and the channel that it is given by its code. `keyFolder`: of the master's keys; `built`:
// when this program was.
struct Assignment {
    std::string rigFile, keyFolder;
    enrol::FoundNode node;
    std::string channel, code;
    UnixSeconds built = 0;
};
// Carries it out, which takes seconds. Why it is refused; empty: it is not.
[[nodiscard]] std::string assignNode(const Assignment& assignment);

// Looks for waiting nodes, where the rig has several machines.
class NodeSearch {
  public:
    // Where the network cannot be listened to, the log says so, and none is found.
    explicit NodeSearch(const config::Rig& rig);
    [[nodiscard]] bool isOn() const { return discovery_ != nullptr; }
    // Those that are there now, by letter.
    [[nodiscard]] std::vector<enrol::FoundNode> nodes() const;

  private:
    std::unique_ptr<enrol::Discovery> discovery_;
};

// As pages show them.
[[nodiscard]] browser::WaitingNodes listOf(const std::vector<enrol::FoundNode>& nodes,
                                           bool isSearched);

}  // namespace aquarama::console
