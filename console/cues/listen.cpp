// SPDX-License-Identifier: Apache-2.0
#include "console/cues/listen.h"

#include "common/base/log.h"

namespace aquarama::console {

void listenTo(const char* what,
              const config::UdpAddress& where,
              std::string& problem,
              const std::function<void()>& open) {
    try {
        open();
        problem.clear();
        logInfo("{} at {}", what, config::textOf(where));
    } catch (const Error& failure) {
        if (problem.empty()) logWarning("{}: {}", what, failure.what());
        problem = failure.what();
    }
}

}  // namespace aquarama::console
