// SPDX-License-Identifier: Apache-2.0
// The master of a rig with two machines: it stands by, takes over and steps down, by the lease.
#pragma once

#include <memory>

#include "commands/master_options.h"
#include "common/net/channels.h"

namespace aquarama {

// Whether a show has a standby. One that keeps no journal has none.
[[nodiscard]] bool hasStandby(const config::Rig& rig, const MasterOptions& options);
// Which of both machines is the master is decided by the lease; the other one stands by. True: the
// other one is the master now, and this one is to stand by anew.
[[nodiscard]] bool showByLease(const config::Rig& rig,
                               const MasterOptions& options,
                               std::unique_ptr<net::MasterChannels> channels);

}  // namespace aquarama
