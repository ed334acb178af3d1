// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/edited_text.h"

namespace aquarama {

// A port that nobody listens on at the moment.
inline int freePort() {
    const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const bound = reinterpret_cast<sockaddr*>(&address);
    const bool isBound =
        bind(descriptor, bound, size) == 0 && getsockname(descriptor, bound, &size) == 0;
    close(descriptor);
    if (!isBound) throw std::runtime_error("no free port on the loopback");
    return ntohs(address.sin_port);
}

// config/NAME.txtpb on ports of its own.
inline std::string rigOnFreePorts(const std::string& name) {
    std::string text = test::shippedRigText(name);
    for (const char* address : {"control", "state"})
        text = test::withField(
            text, address, test::quoted("tcp://127.0.0.1:" + std::to_string(freePort())));
    return text;
}

}  // namespace aquarama
