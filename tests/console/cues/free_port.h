// SPDX-License-Identifier: Apache-2.0
// Ports of UDP for tests.
#pragma once

#include <memory>
#include <string>

#include "common/base/log.h"
#include "console/cues/udp_port.h"

namespace aquarama::test {

// A port of the loopback that is free, as these tests choose one after the other.
struct Port {
    config::UdpAddress address;
    std::unique_ptr<console::UdpPort> socket;
};
inline Port freePort(const std::string& host = "127.0.0.1") {
    static std::uint16_t next = 42'000;
    Port port;
    while (!port.socket) {
        port.address = {host, ++next};
        try {
            port.socket = std::make_unique<console::UdpPort>(port.address);
        } catch (const Error&) {  // another program's
            if (next == 65'000) throw;
        }
    }
    return port;
}

}  // namespace aquarama::test
