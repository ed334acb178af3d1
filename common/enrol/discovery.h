// SPDX-License-Identifier: Apache-2.0
// How waiting nodes are found on the show's network: they announce themselves by multicast DNS
// (RFC 6762, 6763) as services _aquarama-node._tcp, whose names are letters.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace aquarama::enrol {

// A node that waits for a key.
struct FoundNode {
    std::string letter;     // "A"; no other waiting node of this network has it
    std::string address;    // tcp://192.168.7.3:41234
    std::string publicKey;  // under which it is spoken to
    friend bool operator==(const FoundNode&, const FoundNode&) = default;
};

// The addresses of this machine on its networks, IPv4; that of the loopback where it has no other.
[[nodiscard]] std::vector<std::string> ownAddresses();

// Announces a waiting node, on a thread of its own, until it is destroyed.
class Announcement {
  public:
    // `port`: where it is spoken to. Throws Error where the machine has no multicast.
    Announcement(std::string publicKey, std::uint16_t port);
    ~Announcement();
    Announcement(const Announcement&) = delete;
    Announcement& operator=(const Announcement&) = delete;

    // A letter that no other node has; empty while that is being found out.
    [[nodiscard]] std::string letter() const;
    // Announces the addresses anew where they have changed, as by DHCP. To be called every second.
    void followAddresses();

  private:
    class Service;
    std::unique_ptr<Service> service_;
};

// Finds waiting nodes, on a thread of its own.
class Discovery {
  public:
    // Throws Error where the machine has no multicast.
    Discovery();
    ~Discovery();
    Discovery(const Discovery&) = delete;
    Discovery& operator=(const Discovery&) = delete;

    // Those that are there now, by letter. From any thread.
    [[nodiscard]] std::vector<FoundNode> nodes() const;

  private:
    class Browser;
    std::unique_ptr<Browser> browser_;
};

}  // namespace aquarama::enrol
