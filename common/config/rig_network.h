// SPDX-License-Identifier: Apache-2.0
// The addresses of a rig: of the show's own network, and of what else nodes reach.
#pragma once

#include <string>
#include <string_view>

#include <google/protobuf/message.h>

#include "common/config/rig.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

// Whether a host means this machine alone.
[[nodiscard]] bool isLoopback(std::string_view host);
// "127.0.0.1" and ":7400" of "tcp://127.0.0.1:7400".
[[nodiscard]] std::string_view hostOf(std::string_view address);
[[nodiscard]] std::string portOf(const std::string& address);

// Throw Error at the field that is wrong.
void checkAddress(const TextReader& file,
                  const google::protobuf::Message& in,
                  const std::string& field,
                  const std::string& address);
void checkNetwork(const TextReader& file, const v1::Network& in);
// After the rig's network was checked.
void checkStandby(const TextReader& file, const v1::Rig& in);

}  // namespace aquarama::config
