// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/pilot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/base/digest.h"
#include "common/place/place.h"

namespace aquarama::surroundings {

Voyage voyageOf(const config::Scene& scene, std::uint32_t seed, const place::Region& fishWater) {
    return {.waters = watersOf(place::placeOf(scene, seed), fishWater, scene.eye),
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

void advancePilot(Pilot& pilot, const Voyage& voyage, glm::vec3 school, Tick now, float most) {
    const bool steered = now < pilot.heldUntil;
    // No visitor steers, and none has for the idle time.
    const bool alone = !steered && now >= pilot.autopilotFrom;
    // A submarine that nobody ever steered and that has no tour stays exactly at its eye, even
    // where moveHull() would push it out of an obstacle.
    if (!pilot.everSteered && (voyage.stays || !alone)) return;
    if (alone && !pilot.touring) pilot.along = nearestAlong(voyage.tour, pilot.vessel.position);
    pilot.touring = alone;
    const Push wanted = steered ? pushOf(pilot.steering)
                        : alone ? followTour(voyage.tour, pilot.vessel, school, pilot.along, most)
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

namespace {

// Speeds in metres a second, angles in radians, gains a second.
constexpr float kFastestMetresPerSecond = 0.6F;
// Share of the distance to the path that is made up in a second.
constexpr float kCorrectionPerSecond = 0.25F;
constexpr float kTimeToSpeedSeconds = 2;
// Share of full thrust that the autopilot uses at most.
constexpr float kMostThrust = 0.6F;
// Fastest turn of the view, radians a second.
constexpr float kFastestLook = 0.14F;
// Share of the missing angle that is turned in a second.
constexpr float kLookPerSecond = 0.35F;
// Share of the steepest pitch that the autopilot uses at most.
constexpr float kMostTilt = 0.6F;
// When the submarine is farther behind its point than the first distance, the point slows; at the
// second it waits.
constexpr float kWaitsFromMetres = 0.5F;
constexpr float kWaitsWhollyMetres = 1.5F;
// Metres a second. When the submarine is slower than it wants to be by more than this, something
// blocks it: then it rises by the rest.
constexpr float kOverSeconds = 0.25F;

// A level circle of stops around the middle of the water, through the eye.
std::vector<Tour::Stop> circleOf(const config::Scene& scene) {
    constexpr int kStops = 12;
    const glm::vec3 middle{scene.water.centre.x, scene.eye.y, scene.water.centre.z};
    const glm::vec3 from = scene.eye - middle;
    std::vector<Tour::Stop> stops;
    for (int i = 0; i < kStops; ++i) {
        const auto [sine, cosine] = sineAndCosine(2 * place::kPi * static_cast<float>(i) / kStops);
        const glm::vec3 arm{from.x * cosine + from.z * sine, 0, from.z * cosine - from.x * sine};
        stops.push_back({middle + arm, scene.water.centre});
    }
    return stops;
}

// Catmull-Rom spline (Catmull & Rom 1974) between p[1] and p[2]: value, and below its derivative,
// at u from 0 to 1.
glm::vec3 between(const std::array<glm::vec3, 4>& p, float u) {
    const glm::vec3 cube = (p[1] - p[2]) * 3.0F + p[3] - p[0];
    const glm::vec3 square = p[0] * 2.0F - p[1] * 5.0F + p[2] * 4.0F - p[3];
    return p[1] + (((cube * u + square) * u) + (p[2] - p[0])) * (0.5F * u);
}
glm::vec3 slopeBetween(const std::array<glm::vec3, 4>& p, float u) {
    const glm::vec3 cube = (p[1] - p[2]) * 3.0F + p[3] - p[0];
    const glm::vec3 square = p[0] * 2.0F - p[1] * 5.0F + p[2] * 4.0F - p[3];
    return (cube * (3 * u) + square * 2.0F) * (0.5F * u) + (p[2] - p[0]) * 0.5F;
}

// The direction and size of v, no larger than `most`.
glm::vec3 atMost(glm::vec3 v, float most) {
    const float length = place::lengthOf(v);
    return length > most ? v * (most / length) : v;
}

// Clamped to -most to most.
float share(float value, float most) {
    return std::clamp(value, -most, most);
}

// Sets the three pushes that bring the velocity to the wanted one in kTimeToSpeedSeconds, against
// the drag.
void makeFor(glm::vec3 wanted, const Vessel& vessel, Push& push) {
    const float drag = kDragNewtonsPerSpeed + kDragNewtonsPerSpeedSquared * place::lengthOf(wanted);
    const glm::vec3 newtons =
        wanted * drag + (wanted - vessel.velocity) * (kVesselKilograms / kTimeToSpeedSeconds);
    const auto [sine, cosine] = sineAndCosine(vessel.attitude.yaw);
    push.ahead = share((-newtons.x * sine - newtons.z * cosine) / kThrustNewtons, kMostThrust);
    push.aside =
        share(place::dot(newtons, rightOf(vessel.attitude)) / kSideThrustNewtons, kMostThrust);
    push.up = share(newtons.y / kSideThrustNewtons, kMostThrust);
}

// Sets the pushes that turn and tilt the submarine towards a place. `fastest`: of the turn, radians
// a second.
void lookAt(glm::vec3 place, const Vessel& vessel, float fastest, Push& push) {
    const glm::vec3 to = place - vessel.position;
    const float level = std::sqrt(to.x * to.x + to.z * to.z);
    // Metres: at a nearer place the direction is not defined well enough.
    constexpr float kTooNear = 0.5F;
    if (level < kTooNear) return;
    const float missing = wrapped(place::angleOf(-to.x, -to.z) - vessel.attitude.yaw);
    push.turn = share(kLookPerSecond * missing, fastest) / kFastestTurn;
    push.tilt = share(place::angleOf(to.y, level) / kSteepestPitch, kMostTilt);
}

}  // namespace

Tour tourOf(const config::Scene& scene) {
    constexpr glm::vec3 kAhead{0, 0, -1000};
    if (!scene.tour) return {{{scene.eye, scene.eye + kAhead}}, 0};
    Tour tour{{}, static_cast<float>(scene.tour->metresPerSecond)};
    for (const config::TourStop& stop : scene.tour->stops)
        tour.stops.push_back({stop.at, stop.lookAt});
    if (tour.stops.empty()) tour.stops = circleOf(scene);
    return tour;
}

TourPoint pointOf(const Tour& tour, float along, glm::vec3 school) {
    assert(!tour.stops.empty());
    assert(along >= 0);
    const std::size_t count = tour.stops.size();
    const auto first = static_cast<std::size_t>(along);
    const float u = along - static_cast<float>(first);
    std::array<glm::vec3, 4> at;
    std::array<glm::vec3, 4> seen;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Tour::Stop& stop = tour.stops[(first + count - 1 + i) % count];
        at[i] = stop.at;
        seen[i] = stop.lookAt.value_or(school);
    }
    // The point to look at fades from stop to stop (smoothstep), so that it does not overshoot.
    const float faded = u * u * (3 - 2 * u);
    return {between(at, u), slopeBetween(at, u), seen[1] + (seen[2] - seen[1]) * faded};
}

float nearestAlong(const Tour& tour, glm::vec3 place) {
    constexpr int kLooks = 16;  // from stop to stop
    float nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < kLooks * tour.stops.size(); ++i) {
        const float along = static_cast<float>(i) / kLooks;
        const float distance = place::lengthOf(pointOf(tour, along, {}).at - place);
        if (distance >= least) continue;
        least = distance;
        nearest = along;
    }
    return nearest;
}

Push followTour(
    const Tour& tour, const Vessel& vessel, glm::vec3 school, float& along, float most) {
    const float speed = std::min(tour.metresPerSecond, most);
    const float fastest = std::min(kFastestMetresPerSecond, most);
    const TourPoint point = pointOf(tour, along, school);
    const glm::vec3 missing = point.at - vessel.position;
    const float behind = place::lengthOf(missing);
    // 1 near the path, 0 where the point has to wait.
    const float pace = std::clamp(
        (kWaitsWhollyMetres - behind) / (kWaitsWhollyMetres - kWaitsFromMetres), 0.0F, 1.0F);
    const float metresPerStop = place::lengthOf(point.perStop);
    const glm::vec3 course = place::directionOf(point.perStop, {}) * (speed * pace);
    glm::vec3 wanted = atMost(course + missing * kCorrectionPerSecond, fastest);
    // Rises over what blocks the way.
    wanted.y +=
        std::max(0.0F, place::lengthOf(wanted) - place::lengthOf(vessel.velocity) - kOverSeconds);
    Push push;
    makeFor(wanted, vessel, push);
    lookAt(point.lookAt, vessel, kFastestLook * (fastest / kFastestMetresPerSecond), push);
    if (metresPerStop > 0) {
        along += speed * pace * kTickSeconds / metresPerStop;
        const auto stops = static_cast<float>(tour.stops.size());
        if (along >= stops) along -= stops;
    }
    return push;
}

}  // namespace aquarama::surroundings
