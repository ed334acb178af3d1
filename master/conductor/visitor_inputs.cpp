// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/visitor_inputs.h"

#include <chrono>

#include <glm/geometric.hpp>

namespace aquarama::conductor {
namespace {

// Between two inputs of food from one visitor.
constexpr net::Duration kBetweenPinches = std::chrono::milliseconds(200);
constexpr float kReachMetres = 8.0F;  // from the eye

// The enums of the schema are in the order of the code's; their first value says nothing.
static_assert(v1::Explanation::AVOID_OBSTACLE ==
              static_cast<int>(fish::Intention::AvoidObstacle) + 1);
static_assert(v1::Sighting::PREY == static_cast<int>(NearestSeen::Kind::Prey) + 1);

void write(const Explanation& from, v1::Explanation& message) {
    for (const std::string& line : from.lines) message.add_lines(line);
    if (!from.intention) return;
    message.set_intention(
        static_cast<v1::Explanation::Intention>(static_cast<int>(*from.intention) + 1));
    message.set_target(from.target);
    message.set_pursued_s(from.pursuedSeconds);
    message.set_hunger(from.feelings.hunger);
    message.set_libido(from.feelings.libido);
    message.set_fear(from.feelings.fear);
    for (const NearestSeen& one : from.seen) {
        v1::Sighting& sighting = *message.add_seen();
        sighting.set_kind(static_cast<v1::Sighting::Kind>(static_cast<int>(one.kind) + 1));
        sighting.set_name(one.name);
        sighting.set_distance_lengths(one.distanceLengths);
        sighting.set_degrees_right(one.degreesRight);
    }
}

}  // namespace

VisitorInputs::VisitorInputs(const Sender& sender, std::function<void()> wake)
    : sender_{sender}, wake_{std::move(wake)} {}

void VisitorInputs::enter(SimulationThread* world, std::uint32_t fish) {
    world_ = world;
    fish_ = fish;
}

bool VisitorInputs::feed(NodeSeat& seat,
                         const v1::Input& input,
                         const wire::Eye& eye,
                         net::Moment now) {
    return feed(seat.lastFed, input, eye, now);
}

bool VisitorInputs::feed(const std::string& user,
                         const v1::Input& input,
                         const wire::Eye& eye,
                         net::Moment now) {
    return feed(lastFed_[user], input, eye, now);
}

// The world bounds the number of pellets; here the rate of a visitor is bounded, and the reach.
bool VisitorInputs::feed(net::Moment& lastFed,
                         const v1::Input& input,
                         const wire::Eye& eye,
                         net::Moment now) {
    if (now - lastFed < kBetweenPinches || world_ == nullptr) return true;
    const glm::vec3 at{input.position(0), input.position(1), input.position(2)};
    const auto drop = [at](Simulation& simulation) {
        simulation.apply(world::DropFood{.position = at});
    };
    const bool isInReach = glm::distance(at, eye.positionMetres) < kReachMetres;
    if (!isInReach || !world_->betweenTicks(drop)) return false;
    lastFed = now;
    return true;
}

bool VisitorInputs::steer(const net::PeerId& peer, const v1::Input& input, net::Moment now) {
    const Steering steering = wire::steeringOf(input);
    if (world_ == nullptr || !arbitration_.accepts(peer, {steering, input.yields()}, now))
        return true;
    return world_->betweenTicks([steering](Simulation& simulation) { simulation.apply(steering); });
}

bool VisitorInputs::touch(const net::PeerId& peer, const v1::Input& input, net::Moment now) {
    if (world_ == nullptr || !trackers_.hear(peer, wire::handsOf(input), now)) return true;
    return world_->betweenTicks(
        [hands = trackers_.all(now)](Simulation& simulation) { simulation.apply(hands); });
}

// A mind is looked into between two ticks.
bool VisitorInputs::ask(const net::PeerId& peer, std::uint32_t fish) {
    if (world_ == nullptr) return true;  // the show is over
    return world_->betweenTicks([=, this](const Simulation& simulation) {
        v1::Envelope message;
        v1::Explanation& explanation = *message.mutable_explanation();
        explanation.set_fish(fish);
        explanation.set_school(fish_);
        explanation.set_tick(simulation.tick().value);
        write(simulation.explain(fish), explanation);
        explanations_.tryPut({peer, sender_.packetOf(std::move(message))});
        wake_();
    });
}

void VisitorInputs::answer() {
    while (const auto explanation = explanations_.tryTake())
        sender_.send(explanation->first, explanation->second);
}

}  // namespace aquarama::conductor
