// SPDX-License-Identifier: Apache-2.0

#include "master/surroundings/pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/place/place.h"
#include "common/units/digest.h"

namespace aquarama::surroundings {

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

namespace {

constexpr float kFastestMetresPerSecond = 0.6F;
constexpr float kCorrectionPerSecond = 0.25F;  // of what is missing to the path
constexpr float kTimeToSpeedSeconds = 2;
constexpr float kMostThrust = 0.6F;      // of the thrusters'
constexpr float kFastestLook = 0.14F;    // radians a second
constexpr float kLookPerSecond = 0.35F;  // of what is missing to the direction
constexpr float kMostTilt = 0.6F;        // of the steepest pitch
// So far behind the place that it makes for, it waits for the submarine wholly.
constexpr float kWaitsFromMetres = 0.5F;
constexpr float kWaitsWhollyMetres = 1.5F;
constexpr float kOverSeconds = 0.25F;  // rises so much faster than it is kept from going on

// The circle about the middle of the water that leads through the eye.
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

// Cubic between b and c (Catmull & Rom 1974): value and derivative at u, 0 to 1.
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

float share(float value, float most) {
    return std::clamp(value, -most, most);
}

// Pushes that bring the velocity to what is wanted, against the drag.
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

void lookAt(glm::vec3 place, const Vessel& vessel, Push& push) {
    const glm::vec3 to = place - vessel.position;
    const float level = std::sqrt(to.x * to.x + to.z * to.z);
    constexpr float kTooNear = 0.5F;  // to say where it is
    if (level < kTooNear) return;
    const float missing = wrapped(place::angleOf(-to.x, -to.z) - vessel.attitude.yaw);
    push.turn = share(kLookPerSecond * missing, kFastestLook) / kFastestTurn;
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
    // What is looked at changes from stop to stop without swinging past.
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

Push followTour(const Tour& tour, const Vessel& vessel, glm::vec3 school, float& along) {
    const TourPoint point = pointOf(tour, along, school);
    const glm::vec3 missing = point.at - vessel.position;
    const float behind = place::lengthOf(missing);
    const float pace = std::clamp(
        (kWaitsWhollyMetres - behind) / (kWaitsWhollyMetres - kWaitsFromMetres), 0.0F, 1.0F);
    const float metresPerStop = place::lengthOf(point.perStop);
    const glm::vec3 course = place::directionOf(point.perStop, {}) * (tour.metresPerSecond * pace);
    glm::vec3 wanted = atMost(course + missing * kCorrectionPerSecond, kFastestMetresPerSecond);
    // What stands in the way is gone over.
    wanted.y +=
        std::max(0.0F, place::lengthOf(wanted) - place::lengthOf(vessel.velocity) - kOverSeconds);
    Push push;
    makeFor(wanted, vessel, push);
    lookAt(point.lookAt, vessel, push);
    if (metresPerStop > 0) {
        along += tour.metresPerSecond * pace * kTickSeconds / metresPerStop;
        const auto stops = static_cast<float>(tour.stops.size());
        if (along >= stops) along -= stops;
    }
    return push;
}

}  // namespace aquarama::surroundings
