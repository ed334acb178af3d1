// SPDX-License-Identifier: Apache-2.0
// What a node without a key runs: it is found on the network, and answers who wants to give it one.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/keys.h"
#include "common/enrol/discovery.h"
#include "common/enrol/waiting_node.h"
#include "common/net/channels.h"

namespace aquarama::enrol {

// What a screen shows of a waiting node.
struct NodeSign {
    std::string letter;                  // empty while it is not known
    std::string code;                    // "K7M4-QD9X"
    std::vector<std::string> addresses;  // of the machine
    friend bool operator==(const NodeSign&, const NodeSign&) = default;
};

// Of one thread.
class NodeDoor {
  public:
    // Listens on every network of the machine, at any free port, and speaks with whoever knows the
    // key that it announces, encrypted (CURVE). Throws Error where it cannot listen.
    explicit NodeDoor(const WaitingNode::Keep& keep);
    // Answers what comes, and returns after `atMost` or with the key, once it is kept.
    [[nodiscard]] std::optional<config::KeyFile> serve(net::Duration atMost);
    [[nodiscard]] NodeSign sign() const;

  private:
    void answer();

    net::KeyPair own_ = net::makeKeyPair();
    std::unique_ptr<net::MasterChannels> channels_;
    WaitingNode node_;
    Announcement announcement_;
    net::Moment lookedAt_{};  // at the machine's addresses
};

}  // namespace aquarama::enrol
