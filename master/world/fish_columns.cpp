// SPDX-License-Identifier: Apache-2.0
#include "master/world/fish_columns.h"

#include <type_traits>
#include <utility>

#include "common/base/digest.h"

namespace aquarama::world {

FishColumns::FishColumns(std::vector<motion::FishTraits> ofFish) : traits(std::move(ofFish)) {
    states.resize(traits.size());
    commands.resize(traits.size());
    minds.resize(traits.size());
    courses.resize(traits.size());
    memory.resize(traits.size());
    thought.resize(traits.size());
    view.resize(traits.size());
    placements.fish.reserve(traits.size());
}

void FishColumns::shiftTime(std::uint64_t ticks) {
    const auto shift = [&](auto& at) {
        using At = std::remove_reference_t<decltype(at)>;
        at = static_cast<At>(at > ticks ? at - ticks : 0);
    };
    for (std::size_t fish = 0; fish < traits.size(); ++fish) shift(minds[fish].thoughtAt);
    for (auto* column : {&memory.chosenAt, &memory.heldUntil, &memory.recoversAt})
        for (auto& at : *column) shift(at);
}

std::uint64_t FishColumns::hash(Tick tick) const {
    std::uint64_t hash = foldedOne(motion::hashOf(states) ^ minds.hash(), tick.value);
    hash = folded(hash, commands.action);
    hash = folded(hash, commands.phaseRate);
    hash = folded(hash, commands.pitch);
    hash = folded(hash, commands.yawRate);
    hash = folded(hash, commands.brake);
    const auto fold = [&](auto member) { hash = folded(hash, courses, member); };
    fold([](const fish::Course& course) { return course.direction.x; });
    fold([](const fish::Course& course) { return course.direction.y; });
    fold([](const fish::Course& course) { return course.direction.z; });
    fold(&fish::Course::speed);
    fold(&fish::Course::urgency);
    fold(&fish::Course::openToChange);
    fold(&fish::Course::startsFast);
    hash = folded(hash, memory.chosenAt);
    hash = folded(hash, memory.heldUntil);
    hash = folded(hash, memory.patience);
    hash = folded(hash, memory.recoversAt);
    for (const fish::Released& one : released.fish)
        hash = foldedOne(foldedOne(hash, one.fish), one.since.value);
    // The only place where kAway is kept as a sign.
    return fish::foldedWearers(folded(hash, view.signs), wearers);
}

std::size_t FishColumns::bytes() const {
    return states.bytes() + commands.bytes() + minds.bytes() + memory.bytes() + view.bytes() +
           bytesIn(traits, courses, thought, rushes, released.fish, wearers.ranges, wearers.fish);
}

}  // namespace aquarama::world
