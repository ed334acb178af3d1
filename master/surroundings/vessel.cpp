// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/vessel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

// Radians a second of the critically damped springs by which pitch and roll settle: the hull is
// heavy below and rights itself.
constexpr float kPitchFrequency = 1.2F;
constexpr float kRollFrequency = 1.5F;
// Bank, in radians, for a turn of 1 rad/s at 1 m/s.
constexpr float kBankPerTurn = 0.2F;

// -128 counts as -127: both are full steering.
float shareOf(std::int8_t axis) {
    return std::max(static_cast<float>(axis) / float{kFullSteering}, -1.0F);
}

float towards(float from, float to, float most) {
    return from + std::clamp(to - from, -most, most);
}

// One tick of a critically damped spring that draws the angle to the target; semi-implicit Euler.
void settle(float target, float frequency, float& angle, float& rate) {
    rate += (frequency * (target - angle) - 2 * rate) * frequency * kTickSeconds;
    angle += rate * kTickSeconds;
}

// One tick of yaw, pitch and roll. The hull banks into its turns.
void turn(Vessel& vessel) {
    Attitude& is = vessel.attitude;
    Attitude& rate = vessel.rate;
    rate.yaw += kTurnDamping * (kFastestTurn * vessel.push.turn - rate.yaw) * kTickSeconds;
    is.yaw = wrapped(is.yaw + rate.yaw * kTickSeconds);
    settle(kSteepestPitch * vessel.push.tilt, kPitchFrequency, is.pitch, rate.pitch);
    is.pitch = std::clamp(is.pitch, -kSteepestPitch, kSteepestPitch);
    const float speedAhead = place::dot(vessel.velocity, noseOf(is));
    const float bank =
        std::clamp(kBankPerTurn * rate.yaw * speedAhead, -kStrongestBank, kStrongestBank);
    settle(bank, kRollFrequency, is.roll, rate.roll);
}

// Obstacles farther from the hull than this are not considered.
constexpr float kFeltMetres = 2;
// Greatest speed at which the hull is led away within the stand-off.
constexpr float kLeadAwayMetresPerSecond = 0.12F;
// Passes over all faces: where several obstacles meet, holding off one may lead towards another.
constexpr int kPasses = 4;

// The nearest face of an obstacle: unit vector away from it, and the distance of the hull from it.
struct Face {
    glm::vec3 away{0, 1, 0};
    float gapMetres = 0;
};

// The sand as a plane through the point below, with the slope over 25 cm: dunes are long.
Face sandFace(const Waters& waters, glm::vec3 at) {
    constexpr float kStep = 0.25F;
    const float here = place::floorHeight(waters.place, {at.x, at.z});
    const float slopeX = (place::floorHeight(waters.place, {at.x + kStep, at.z}) - here) / kStep;
    const float slopeZ = (place::floorHeight(waters.place, {at.x, at.z + kStep}) - here) / kStep;
    const glm::vec3 up = place::directionOf({-slopeX, 1, -slopeZ}, {0, 1, 0});
    return {up, (at.y - here) * up.y - kHullRadiusMetres};
}

Face ballFace(glm::vec3 centre, float radius, glm::vec3 at) {
    const glm::vec3 from = at - centre;
    return {place::directionOf(from, {0, 1, 0}),
            place::lengthOf(from) - radius - kHullRadiusMetres};
}

// A post with a round top: the nearest point of its axis as a ball.
Face stemFace(const place::Stem& stem, glm::vec3 at) {
    const glm::vec3 nearest{stem.foot.x, std::min(at.y, stem.topMetres), stem.foot.y};
    return ballFace(nearest, place::kStemRadiusMetres, at);
}

// Visits the faces that the hull may feel, always in the same order: borders, sand, rocks, stems.
// Rocks and stems that are far in plan are skipped.
template <class Visit>
void visitFaces(const Waters& waters, glm::vec3 at, const Visit& visit) {
    const glm::vec3 from = at - waters.region.centre;
    const glm::vec3 half = waters.region.halfExtent;
    for (const float side : {1.0F, -1.0F}) {
        visit(Face{{-side, 0, 0}, half.x - side * from.x});
        visit(Face{{0, -side, 0}, half.y - side * from.y});
        visit(Face{{0, 0, -side}, half.z - side * from.z});
    }
    visit(sandFace(waters, at));
    const auto isNear = [&](float x, float z, float radius) {
        const float reach = radius + kHullRadiusMetres + kFeltMetres;
        return std::abs(at.x - x) < reach && std::abs(at.z - z) < reach;
    };
    for (const place::Rock& rock : waters.rocks)
        if (isNear(rock.centre.x, rock.centre.z, rock.radiusMetres))
            visit(ballFace(rock.centre, rock.radiusMetres, at));
    for (const place::Stem& stem : waters.stems)
        if (isNear(stem.foot.x, stem.foot.y, place::kStemRadiusMetres)) visit(stemFace(stem, at));
}

// The faces within kFeltMetres, gathered once per tick into a fixed array. At most 128 are kept;
// further ones would be ignored.
class Faces {
  public:
    Faces(const Waters& waters, glm::vec3 at) {
        visitFaces(waters, at, [this](const Face& face) {
            if (face.gapMetres < kFeltMetres && count_ < faces_.size()) faces_[count_++] = face;
        });
    }
    [[nodiscard]] std::span<const Face> near() const { return {faces_.data(), count_}; }
    // Distance to the nearest face, at most kFeltMetres.
    [[nodiscard]] float gap() const {
        float least = kFeltMetres;
        for (const Face& face : near()) least = std::min(least, face.gapMetres);
        return least;
    }

  private:
    std::array<Face, 128> faces_;
    std::size_t count_ = 0;
};

// Greatest speed towards a face: from it constant braking ends at the stand-off, and in one tick
// the hull never goes farther than half the remaining way.
float allowedInward(float gapMetres) {
    const float left = std::max(0.0F, gapMetres - kStandOffMetres);
    return std::min(std::sqrt(2 * kBrakingMetres * left), 0.5F * left / kTickSeconds);
}

// The velocity with its part towards the face limited to what is allowed.
glm::vec3 heldOff(const Face& face, glm::vec3 velocity) {
    const float outward = place::dot(velocity, face.away);
    const float least = -allowedInward(face.gapMetres);
    if (outward < least) velocity += face.away * (least - outward);
    return velocity;
}

// Within the stand-off: the velocity with some speed away from the face, the more the deeper it is.
glm::vec3 ledAway(const Face& face, glm::vec3 velocity) {
    const float depth = std::clamp(1 - face.gapMetres / kStandOffMetres, 0.0F, 1.0F);
    const float missing = kLeadAwayMetresPerSecond * depth - place::dot(velocity, face.away);
    if (depth > 0 && missing > 0)
        velocity += face.away * std::min(missing, kBrakingMetres * kTickSeconds);
    return velocity;
}

}  // namespace

Push pushOf(const Steering& steering) {
    return {shareOf(steering.ahead),
            shareOf(steering.aside),
            shareOf(steering.up),
            shareOf(steering.turn),
            shareOf(steering.tilt)};
}

void pushVessel(Vessel& vessel, const Push& wanted, float slew) {
    assert(slew > 0);
    Push& push = vessel.push;
    const float most = slew * kTickSeconds;
    push = {towards(push.ahead, wanted.ahead, most),
            towards(push.aside, wanted.aside, most),
            towards(push.up, wanted.up, most),
            towards(push.turn, wanted.turn, most),
            towards(push.tilt, wanted.tilt, most)};
    turn(vessel);
    const glm::vec3 newtons = noseOf(vessel.attitude) * (kThrustNewtons * push.ahead) +
                              rightOf(vessel.attitude) * (kSideThrustNewtons * push.aside) +
                              glm::vec3{0, kSideThrustNewtons * push.up, 0};
    // Drag is integrated implicitly: at any speed it brakes and never reverses the motion.
    const float drag =
        kDragNewtonsPerSpeed + kDragNewtonsPerSpeedSquared * place::lengthOf(vessel.velocity);
    constexpr float kSecondsPerKilogram = kTickSeconds / kVesselKilograms;
    vessel.velocity =
        (vessel.velocity + newtons * kSecondsPerKilogram) / (1 + drag * kSecondsPerKilogram);
}

// The speed at which the drag, kSquared v^2 + kLinear v, equals the thrust.
float terminalSpeed(float newtons) {
    assert(newtons >= 0);
    constexpr float kLinear = kDragNewtonsPerSpeed;
    constexpr float kSquared = kDragNewtonsPerSpeedSquared;
    return (std::sqrt(kLinear * kLinear + 4 * kSquared * newtons) - kLinear) / (2 * kSquared);
}

Waters watersOf(const place::PlaceKey& place, const place::Region& fishWater, glm::vec3 eye) {
    Waters waters{place, place::roamingRegion(fishWater, eye), place::rocksOf(place), {}};
    for (const place::Plant& plant : place::plantsOf(place))
        if (plant.kind == place::PlantKind::Kelp)
            waters.stems.push_back(
                {{plant.root.x, plant.root.z}, plant.root.y + plant.heightMetres});
    return waters;
}

float gapAt(const Waters& waters, glm::vec3 position) {
    return Faces(waters, position).gap();
}

// In a tick the hull moves a twentieth of its radius at most, so that testing the end of the way
// tests all of it. Where the end is still inside an obstacle the move is refused.
void moveHull(const Waters& waters, glm::vec3& position, glm::vec3& velocity) {
    assert(std::isfinite(place::dot(position, position)));
    assert(std::isfinite(place::dot(velocity, velocity)));
    const Faces faces(waters, position);
    for (const Face& face : faces.near()) velocity = ledAway(face, velocity);
    for (int pass = 0; pass < kPasses; ++pass)
        for (const Face& face : faces.near()) velocity = heldOff(face, velocity);
    const glm::vec3 next = position + velocity * kTickSeconds;
    if (gapAt(waters, next) < std::min(0.0F, faces.gap()))
        velocity = {};
    else
        position = next;
}

}  // namespace aquarama::surroundings
