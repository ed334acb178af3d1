// SPDX-License-Identifier: Apache-2.0
#include "master/pilot/pilot.h"

#include <cmath>

#include "common/units/folded_hash.h"

namespace aquarama::pilot {

Voyage voyageOf(const config::Scene& scene, std::uint32_t seed, const place::Region& fishWater) {
    return {.waters = watersOf({seed, scene.place}, fishWater, scene.eye),
            .tour = tourOf(scene),
            .stays = !scene.tour,
            .idleTicks = static_cast<std::uint64_t>(scene.idleSeconds * kTicksPerSecond)};
}

Pilot pilotOf(const Voyage& voyage, glm::vec3 eye) {
    Pilot pilot;
    pilot.vessel.position = eye;
    pilot.autopilotFrom = {voyage.idleTicks};
    return pilot;
}

void steer(Pilot& pilot, const Voyage& voyage, const Steering& steering, Tick now) {
    if (steering == Steering{} && now >= pilot.heldUntil) return;  // it held nothing before
    pilot.steering = steering;
    pilot.everSteered = true;
    pilot.heldUntil = {now.value + (steering == Steering{} ? 0 : kTicksOfAHand)};
    pilot.autopilotFrom = {pilot.heldUntil.value + voyage.idleTicks};
}

void advancePilot(Pilot& pilot, const Voyage& voyage, glm::vec3 school, Tick now) {
    const bool steered = now < pilot.heldUntil;
    const bool alone = !steered && now >= pilot.autopilotFrom;
    // Where it stays, nothing moves it: not even water that it would be led out of.
    if (!pilot.everSteered && (voyage.stays || !alone)) return;
    if (alone && !pilot.touring) pilot.along = nearestAlong(voyage.tour, pilot.vessel.position);
    pilot.touring = alone;
    const Push wanted = steered ? pushOf(pilot.steering)
                        : alone ? followTour(voyage.tour, pilot.vessel, school, pilot.along)
                                : Push{};
    pushVessel(pilot.vessel, wanted, alone ? kAutopilotSlew : kHandsSlew);
    moveHull(voyage.waters, pilot.vessel.position, pilot.vessel.velocity);
}

std::uint64_t foldedPilot(std::uint64_t hash, const Pilot& pilot) {
    const Vessel& v = pilot.vessel;
    for (const glm::vec3 vector : {v.position, v.velocity})
        for (const float number : {vector.x, vector.y, vector.z}) hash = foldedOne(hash, number);
    for (const Attitude& attitude : {v.attitude, v.rate})
        for (const float angle : {attitude.yaw, attitude.pitch, attitude.roll})
            hash = foldedOne(hash, angle);
    for (const float share : {v.push.ahead, v.push.aside, v.push.up, v.push.turn, v.push.tilt})
        hash = foldedOne(hash, share);
    const Steering& s = pilot.steering;
    for (const std::int8_t axis : {s.ahead, s.aside, s.up, s.turn, s.tilt})
        hash = foldedOne(hash, axis);
    hash = foldedOne(hash, pilot.heldUntil.value);
    hash = foldedOne(hash, pilot.autopilotFrom.value);
    hash = foldedOne(hash, pilot.along);
    return foldedOne(hash, (pilot.touring ? 1 : 0) | (pilot.everSteered ? 2 : 0));
}

}  // namespace aquarama::pilot
