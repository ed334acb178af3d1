// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/convergence.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/motion/reconstruct.h"
#include "common/motion/repertoire.h"

namespace aquarama::session {
namespace {

constexpr float kFarthestMetres = 3;
constexpr float kLeastSeconds = 1;
constexpr float kMostSeconds = 8;
// The most that is added to the speed of a fish, metres a second, where the time allows it.
constexpr float kAddedSpeed = 0.5F;
// A smooth step is so much steeper in its middle than in the mean.
constexpr float kSteepest = 1.5F;
constexpr std::uint8_t kPoseTicks = 40;

motion::PresentedFish shownFish(const wire::StateFrame& frame, std::size_t fish) {
    const motion::FishRecord& after = frame.after[fish];
    return motion::present(frame.fraction < 1.0F ? frame.before[fish] : after,
                           after,
                           frame.fraction,
                           motion::FishTraits{});
}

glm::quat rotationOf(const motion::PresentedFish& fish) {
    return {fish.rotation.w, fish.rotation.x, fish.rotation.y, fish.rotation.z};
}

double worldOf(const wire::StateFrame& frame) {
    return static_cast<double>(frame.tick.value) - 1 + static_cast<double>(frame.fraction);
}

float smoothStep(float share) {
    const float x = std::clamp(share, 0.0F, 1.0F);
    return x * x * (3 - 2 * x);
}

}  // namespace

void Convergence::begin(const wire::StateFrame& shown, const wire::StateFrame& first) {
    assert(shown.after.size() == first.after.size());
    begun_ = worldOf(first);
    gliding_.clear();
    for (std::size_t fish = 0; fish < first.after.size(); ++fish)
        if (const auto one = glidingBetween(shown, first, fish)) gliding_.push_back(*one);
}

std::optional<Convergence::Gliding> Convergence::glidingBetween(const wire::StateFrame& shown,
                                                                const wire::StateFrame& first,
                                                                std::size_t fish) {
    const motion::FishRecord &from = shown.after[fish], &to = first.after[fish];
    if (isAway(from) || isAway(to)) return std::nullopt;
    const motion::PresentedFish picture = shownFish(shown, fish);
    const motion::PresentedFish master = shownFish(first, fish);
    Gliding one{.fish = fish, .metres = picture.positionMetres - master.positionMetres};
    const float distance = glm::length(one.metres);
    if (!(distance < kFarthestMetres)) return std::nullopt;
    one.turn = rotationOf(picture) * glm::conjugate(rotationOf(master));
    if (one.turn.w < 0) one.turn = -one.turn;
    one.seconds = std::clamp(kSteepest * distance / kAddedSpeed, kLeastSeconds, kMostSeconds);
    one.from = from.segment;
    one.fromPhase = from.phase;
    one.to = to.segment;
    return one;
}

void Convergence::apply(wire::StateFrame& frame) {
    if (gliding_.empty()) return;
    frame.areOfTick = false;
    const auto tick = static_cast<double>(frame.tick.value);
    apply(tick, frame.after);
    if (!frame.before.empty()) apply(tick - 1, frame.before);
    const double seconds = (tick - 1 - begun_) / kTicksPerSecond;
    std::erase_if(gliding_,
                  [&](const Gliding& one) { return seconds >= static_cast<double>(one.seconds); });
}

void Convergence::apply(double world, std::vector<motion::FishRecord>& records) {
    const double ticks = std::max(world - begun_, 0.0);
    for (const Gliding& one : gliding_) {
        if (one.fish >= records.size() || isAway(records[one.fish])) continue;
        motion::FishRecord& record = records[one.fish];
        const auto share = static_cast<float>(ticks / kTicksPerSecond) / one.seconds;
        move(record, one, 1 - smoothStep(share));
        if (ticks < kPoseTicks && record.segment == one.to)
            pose(record, one, static_cast<std::uint8_t>(ticks));
    }
}

void Convergence::move(motion::FishRecord& record, const Gliding& one, float left) {
    motion::BodyFrame body = motion::bodyFrameOf(record);
    body.position += left * one.metres;
    body.rotation = glm::slerp(glm::quat{1, 0, 0, 0}, one.turn, left) * body.rotation;
    const std::uint32_t skin = record.skin;
    motion::setFromRecord(scratch_, 0, record);
    motion::setBodyFrame(scratch_, 0, body);
    record = motion::recordOf(scratch_, 0);
    record.skin = skin;
}

void Convergence::pose(motion::FishRecord& record, const Gliding& one, std::uint8_t ticks) {
    record.fromSegment = one.from;
    record.fromPhase = one.fromPhase;
    record.warpFrame = ticks;
    record.warpLength = kPoseTicks;
}

}  // namespace aquarama::session
