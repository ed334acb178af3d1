// SPDX-License-Identifier: Apache-2.0
// A session over any channels, also those in memory.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/net/channels.h"
#include "render_node/session/session.h"

namespace aquarama::session {

[[nodiscard]] std::unique_ptr<Session> makeSession(const std::string& name,
                                                   net::Connect connect,
                                                   const std::filesystem::path& blobDirectory);

}  // namespace aquarama::session
