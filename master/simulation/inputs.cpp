// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/inputs.h"

namespace aquarama::simulation {

namespace {

wire::RecordedFood recordedOne(const world::DropFood& food) {
    return {food.position, food.pellets};
}
wire::RecordedSubmarine recordedOne(const world::MoveSubmarine& moved) {
    return {moved.position, moved.velocityMetresPerSecond};
}
Steering recordedOne(const Steering& steering) {
    return steering;
}
world::DropFood inputOfOne(const wire::RecordedFood& food) {
    return {food.position, food.pellets};
}
world::MoveSubmarine inputOfOne(const wire::RecordedSubmarine& moved) {
    return {moved.position, moved.velocityMetresPerSecond};
}
Steering inputOfOne(const Steering& steering) {
    return steering;
}

}  // namespace

wire::RecordedInput recorded(Tick tick, const world::WorldInput& input) {
    wire::RecordedInput recorded{tick, {}};
    std::visit([&](const auto& what) { recorded.input = recordedOne(what); }, input);
    return recorded;
}

world::WorldInput inputOf(const wire::RecordedInput& recorded) {
    return std::visit([](const auto& what) { return world::WorldInput{inputOfOne(what)}; },
                      recorded.input);
}

}  // namespace aquarama::simulation
