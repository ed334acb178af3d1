// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/status_text.h"

#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/wire/journal_text.h"
#include "common/wire/wanted_show.h"

namespace aquarama::conductor {
namespace {

// Of the compass: 0 where the wall looks at first, 90 to the right of it.
int headingDegrees(const wire::Eye& eye) {
    const glm::vec3 nose = eye.worldFromWall * glm::vec3(0, 0, -1);
    const float degrees = glm::degrees(std::atan2(nose.x, -nose.z));
    return static_cast<int>(std::lround(degrees + 360)) % 360;
}

}  // namespace

std::string submarineText(const v1::StatusReply& status) {
    const wire::Eye eye = wire::readEye(status.eye()).value_or(wire::Eye{});
    const glm::vec3 at = eye.positionMetres;
    return fmt::format(
        "at {:.1f} {:.1f} {:.1f} m   depth {:.1f} m   heading {:03}   {:.2f} m/s   {}",
        at.x,
        at.y,
        at.z,
        -at.y,
        headingDegrees(eye),
        status.speed_m_s(),
        status.show().pilot().empty() ? "nobody steers" : status.show().pilot() + " steers");
}

namespace {

// What the wall shows, and what is to come.
std::string showText(const v1::StatusReply& status) {
    const wire::Show show = wire::readShow(status.show()).value_or(wire::Show{});
    const auto onOff = [](bool on) { return on ? "on" : "off"; };
    std::string text = fmt::format(
        "show          scene {}   quality {}   pattern {}   colour {:.2f}   brightness {:.2f}   "
        "black {}   freeze {}   guests {}   drawings {}   day {}   version {}   calibration "
        "{:016x}\n",
        show.scene,
        config::nameOf(show.quality),
        wire::nameOf(show.pattern),
        show.colourReturned,
        show.brightness,
        onOff(show.black),
        onOff(show.frozen),
        onOff(status.guests()),
        onOff(status.drawings()),
        wire::dayName(status.has_day() ? status.day() : v1::WantedShow::CLOCK),
        show.version,
        show.calibration);
    if (!status.change().empty()) text += fmt::format("to come       {}\n", status.change());
    return text;
}

}  // namespace

std::string statusText(const v1::StatusReply& status) {
    std::string text = fmt::format("{}   frame {}   tick {}\n",
                                   status.pace() == v1::PACE_LIVE ? "live" : "lockstep",
                                   status.frame(),
                                   status.tick());
    text += showText(status);
    text += fmt::format("frame time    median {:8.2f} ms   p99 {:8.2f} ms\n",
                        status.frame_median_ms(),
                        status.frame_p99_ms());
    text += fmt::format("release skew  median {:8.3f} ms   p99 {:8.3f} ms\n",
                        status.skew_median_ms(),
                        status.skew_p99_ms());
    text += fmt::format("submarine     {}\n", submarineText(status));
    if (status.has_journal())
        text += fmt::format("journal       {}\n", wire::journalText(status.journal(), "   "));
    if (status.has_standby())
        text += fmt::format("standby       {}\n", wire::standbyText(status.standby()));
    text += fmt::format("refused packets {}\n\n", status.refused_packets());
    text += fmt::format("{:<16} {:<10} {:>8} {:>8} {:>8}  {}\n",
                        "node",
                        "state",
                        "late",
                        "dropped",
                        "hash",
                        "machine");
    for (const v1::NodeStatus& node : status.nodes()) {
        text += fmt::format("{:<16} {:<10} {:>8} {:>8} {:>8}  {}\n",
                            node.name(),
                            wire::wordFor(node.condition()),
                            node.late(),
                            node.dropped(),
                            node.hash_mismatches() == 0 ? "same" : "differs",
                            node.machine().empty() ? "this" : node.machine());
    }
    return text;
}

}  // namespace aquarama::conductor
