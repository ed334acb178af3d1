// SPDX-License-Identifier: Apache-2.0
// A socket of UDP at one address of this machine; liblo's own would listen at all of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/config/host.h"

namespace aquarama::console {

// Never waits. One thread uses it.
class UdpPort {
  public:
    // What somebody has sent.
    struct Datagram {
        config::UdpAddress from;
        std::vector<std::byte> bytes;
    };

    // Throws Error where the address cannot be had.
    explicit UdpPort(const config::UdpAddress& at);
    ~UdpPort();
    UdpPort(const UdpPort&) = delete;
    UdpPort& operator=(const UdpPort&) = delete;

    // The next that has come, cut after `most` bytes; nothing where none waits.
    [[nodiscard]] std::optional<Datagram> receive(std::size_t most);
    // Lost where the network does not take it.
    void send(const config::UdpAddress& to, std::span<const std::byte> bytes);

  private:
    int socket_;
};

}  // namespace aquarama::console
