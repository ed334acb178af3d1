// SPDX-License-Identifier: Apache-2.0
// What command line and rig choose for a run of the master.
#pragma once

#include <memory>
#include <string>

#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/lease/mastership.h"
#include "common/machine/service_notifier.h"
#include "master/conductor/conductor.h"
#include "master/simulation/living_world.h"
#include "master/supervisor/supervise.h"

namespace aquarama {

// `lockstep`: frame n shows tick n. `resume`: the show continues after a crash of its master.
struct MasterOptions {
    supervisor::ShowOptions show;
    bool lockstep = false;
    bool resume = false;
    bool standsBy = false;         // it becomes the master of a show alone that it has followed
    std::shared_ptr<LogFile> log;  // only of a live show
    machine::ServiceNotifier* service = nullptr;  // null: nobody is notified
    // As the conductor's; null: of a rig without a standby.
    lease::Mastership* mastership = nullptr;
    std::string machine = {};
};

// The file of a scene: a name lies beside the rig's scene. Throws Error, which lists the scenes
// that exist.
[[nodiscard]] std::string sceneFile(const config::Rig& rig,
                                    const std::string& rigPath,
                                    const std::string& name);
// What a show is made of, by its rig; the number of fish is the scene's.
[[nodiscard]] simulation::AssetChoice choiceOf(const config::Rig& rig,
                                               const supervisor::ShowOptions& options);
// The conductor's options for this run; where its worlds come from is left out.
[[nodiscard]] conductor::ConductorOptions conductorOptions(const config::Rig& rig,
                                                           const MasterOptions& options);

}  // namespace aquarama
