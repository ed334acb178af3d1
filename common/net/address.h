// SPDX-License-Identifier: Apache-2.0
// Checks addresses such as "tcp://127.0.0.1:7400" before a socket sees them.
#pragma once

#include <string>

namespace aquarama::net {

// Throws Error where the address is malformed; port "*" (any free one) only where one binds.
void requireConnectAddress(const std::string& address);
// Also where it reaches past this machine: nothing is encrypted or authenticated yet. Gives the
// address to bind: "localhost" may mean anything to a resolver, here it is 127.0.0.1.
[[nodiscard]] std::string bindAddress(const std::string& address);

}  // namespace aquarama::net
