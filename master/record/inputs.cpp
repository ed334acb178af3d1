// SPDX-License-Identifier: Apache-2.0
#include "master/record/inputs.h"

namespace aquarama {

namespace {

RecordedFood recordedOne(const DropFood& food) {
    return {food.position, food.pellets};
}
RecordedSubmarine recordedOne(const MoveSubmarine& moved) {
    return {moved.position, moved.velocityMetresPerSecond};
}
Steering recordedOne(const Steering& steering) {
    return steering;
}
DropFood inputOfOne(const RecordedFood& food) {
    return {food.position, food.pellets};
}
MoveSubmarine inputOfOne(const RecordedSubmarine& moved) {
    return {moved.position, moved.velocityMetresPerSecond};
}
Steering inputOfOne(const Steering& steering) {
    return steering;
}

}  // namespace

RecordedInput recorded(Tick tick, const WorldInput& input) {
    RecordedInput recorded{tick, {}};
    std::visit([&](const auto& what) { recorded.input = recordedOne(what); }, input);
    return recorded;
}

WorldInput inputOf(const RecordedInput& recorded) {
    return std::visit([](const auto& what) { return WorldInput{inputOfOne(what)}; },
                      recorded.input);
}

}  // namespace aquarama
