// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/status.h"

#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <spdlog/fmt/fmt.h>

#include "master/conductor/ask.h"

namespace aquarama::conductor {
namespace {

const char* wordFor(wire::NodeCondition condition) {
    switch (condition) {
        case wire::NodeCondition::Absent:
            return "absent";
        case wire::NodeCondition::Preparing:
            return "preparing";
        case wire::NodeCondition::InStep:
            return "in step";
        case wire::NodeCondition::Late:
            break;
    }
    return "late";
}

// Of the compass: 0 where the wall looks at first, 90 to the right of it.
int headingDegrees(const wire::Eye& eye) {
    const glm::vec3 nose = eye.worldFromWall * glm::vec3(0, 0, -1);
    const float degrees = glm::degrees(std::atan2(nose.x, -nose.z));
    return static_cast<int>(std::lround(degrees + 360)) % 360;
}

}  // namespace

std::string submarineText(const wire::StatusReply& status) {
    const glm::vec3 at = status.eye.positionMetres;
    return fmt::format(
        "at {:.1f} {:.1f} {:.1f} m   depth {:.1f} m   heading {:03}   {:.2f} m/s   {}",
        at.x,
        at.y,
        at.z,
        -at.y,
        headingDegrees(status.eye),
        status.speedMetresPerSecond,
        status.pilot.empty() ? "nobody steers" : status.pilot + " steers");
}

std::string statusText(const wire::StatusReply& status) {
    std::string text = fmt::format("{}{}   frame {}   tick {}\n",
                                   status.pace == wire::Pace::Live ? "live" : "lockstep",
                                   status.paused ? ", paused" : "",
                                   status.frame.value,
                                   status.tick.value);
    text += fmt::format("frame time    median {:8.2f} ms   p99 {:8.2f} ms\n",
                        status.frameMedianMs,
                        status.frameP99Ms);
    text += fmt::format("release skew  median {:8.3f} ms   p99 {:8.3f} ms\n",
                        status.skewMedianMs,
                        status.skewP99Ms);
    text += fmt::format("submarine     {}\n", submarineText(status));
    text += fmt::format("refused packets {}\n\n", status.refusedPackets);
    text += fmt::format("{:<16} {:<10} {:>8} {:>8}\n", "node", "state", "late", "dropped");
    for (const wire::NodeStatus& node : status.nodes) {
        text += fmt::format("{:<16} {:<10} {:>8} {:>8}\n",
                            node.name,
                            wordFor(node.condition),
                            node.late,
                            node.dropped);
    }
    return text;
}

std::string runStatus(const std::string& controlAddress) {
    return statusText(RequestClient(controlAddress).ask<wire::StatusReply>(wire::StatusRequest{}));
}

}  // namespace aquarama::conductor
