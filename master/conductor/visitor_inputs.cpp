// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/visitor_inputs.h"

#include <chrono>

#include <glm/geometric.hpp>

namespace aquarama::conductor {
namespace {

// Between two inputs of food from one visitor.
constexpr net::Duration kBetweenPinches = std::chrono::milliseconds(200);
constexpr float kReachMetres = 8.0F;  // from the eye

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
    if (world_ == nullptr || !arbitration_.accepts(peer, steering, now)) return true;
    return world_->betweenTicks([steering](Simulation& simulation) { simulation.apply(steering); });
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
        for (const std::string& line : simulation.explain(fish)) explanation.add_lines(line);
        explanations_.tryPut({peer, sender_.packetOf(std::move(message))});
        wake_();
    });
}

void VisitorInputs::answer() {
    while (const auto explanation = explanations_.tryTake())
        sender_.send(explanation->first, explanation->second);
}

}  // namespace aquarama::conductor
