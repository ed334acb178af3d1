// SPDX-License-Identifier: Apache-2.0
// Gives a waiting node the key of a channel: makes it, and hands it over to whoever shows the code.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/enrol/discovery.h"

namespace aquarama::enrol {

// Hands a key over, which `makeKey` makes once the node has shown that it knows the code. Waits for
// the node, ten seconds at most. Throws Error where the code is another one, where the node does
// not answer or cannot keep the key, and as `makeKey` does.
void handOver(const FoundNode& node,
              std::string_view code,
              const std::function<config::KeyFile()>& makeKey);

// Today in UTC, in the form of key files. `built`: when this program was (builtAt()). Throws Error
// where the clock is wrong: a key that is made then would never have a known age.
[[nodiscard]] std::string dayOfNewKey(double now, double built);

// A key that its holder has in place of any other, made on this day; not written, and without the
// master's public key.
[[nodiscard]] config::KeyFile freshKey(const config::Rig& rig,
                                       const std::string& rigPath,
                                       const std::string& name,
                                       config::KeyRole role,
                                       const std::string& day);

// Assigns a channel of a rig to a waiting node. The node that had the channel can take part no
// more: the key in `folder`, which the rig's master reads, is another one. `day`: today. Throws
// Error where the rig needs no keys or has none, has no such channel, and as handOver().
void assignChannel(const std::string& rigPath,
                   const std::filesystem::path& folder,
                   const FoundNode& node,
                   const std::string& channel,
                   std::string_view code,
                   const std::string& day);

}  // namespace aquarama::enrol
