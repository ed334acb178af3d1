// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/patches.h"
#include "master/behaviour/routines.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// A shoal stays 20 to 60 s, but not where less than this is left.
constexpr std::uint32_t kShortestGrazeTicks = 20 * 60;
constexpr std::uint32_t kGrazeSpreadTicks = 40 * 60;
constexpr float kTooLittle = 0.4F;
// It looks for so long before it goes on.
constexpr std::uint32_t kLooksTicks = 4 * 60;
// It gives up a patch that it does not reach in this time.
constexpr std::uint32_t kTravelTicks = 60 * 60;

// Of the time between two puffs of sand so much is drawn, to either side.
constexpr float kSandSpread = 0.43F;
constexpr std::uint32_t kPuffTicks = 90;

// On its way: height over the ground, how far ahead it looks at the ground and how often, and its
// pace: that of the medium gait, less a share drawn for each way.
constexpr float kOverGroundMetres = 0.3F;
constexpr float kGroundAheadMetres = 0.4F;
constexpr std::uint32_t kSamples = 5;
// Nearer to the ground than so many body lengths it rises first, so steeply.
constexpr float kRisesBelow = 0.25F;
constexpr float kRiseSlope = 1.5F;
constexpr float kPaceSpread = 0.2F;
// In file: the distance to the fish ahead in body lengths, how far it is followed, in metres, and
// how its distance changes the pace.
constexpr float kFileLengths = 1.3F;
constexpr float kFileMetres = 2.5F;
constexpr float kPacePerLength = 0.6F;
constexpr float kMostHurry = 0.8F;
// It has come to its patch at this distance, and a body length more.
constexpr float kArrivesMetres = 0.6F;

// The mouth is at a spot within this share of a body length, and this of a metre more.
constexpr float kReachLengths = 0.2F;
constexpr float kMouthReachMetres = 0.05F;
// The way to a spot counts more where it is behind, and up to this share more as drawn.
constexpr float kSpotBehind = 1.5F;
constexpr float kDrawnOfSpot = 1.5F;
// A fish that is off its spot by more does not bite; it goes down to it again.
constexpr float kOffMetres = 0.25F;
// A spot that is not reached in this time is given up.
constexpr std::uint32_t kSettleTicks = 7 * 60;
// It goes down to a spot from above: by so much of the way, at most so many body lengths.
constexpr float kSpotFromAbove = 0.35F;
constexpr float kSpotMostAbove = 0.45F;
// A spot within so many body lengths and not within 66 degrees ahead it does not turn to: it swims
// on first, on a slope of this tangent, so far or so long.
constexpr float kTooNearLengths = 0.8F;
constexpr float kSpotAheadCosine = 0.4F;
constexpr float kRunUpSlope = 0.2F;
constexpr float kSpotRunUpLengths = 1.6F;
constexpr std::uint32_t kSpotRunUpTicks = 150;
// To a spot that lies deeper below it than on this slope, and so many body lengths more, it does
// not turn either: it goes on downwards.
constexpr float kSteepest = 1.1F;
constexpr float kSlackLengths = 0.3F;
constexpr float kDiveSlope = 0.6F;
// Paces down to a spot, in those of the slow gait.
constexpr float kLeastSettlingPace = 0.6F;
constexpr float kSettlingPace = 2.0F;
// Nose down: sines of 30 and 58 degrees.
constexpr float kLeastDown = 0.5F;
constexpr float kMostDown = 0.85F;
// Height of its middle over the boulder, in body lengths, below which it is lifted, and below which
// it bites no more.
constexpr float kLiftedBelow = 0.35F;
constexpr float kMostLift = 3;
constexpr float kTooLow = 0.05F;
// What lacks to the spot is made up for in this time.
constexpr float kClosesSeconds = 1.2F;

// One act of grazing.
struct Grazer {
    const Situation& situation;
    fish::Mind& mind;
    DeferredEvents& events;
    const config::Graze& habit = *situation.parameters.habits.graze;
    const surroundings::Turf& turf = situation.environment.surroundings->turf;
    const surroundings::TurfPatch& patch = turf.patches[mind.target];
    const Senses& senses = situation.senses;
    std::uint64_t now = situation.environment.tick.value;

    [[nodiscard]] GrazeStage stage() const { return static_cast<GrazeStage>(mind.stage); }
    void enter(GrazeStage next) const {
        mind.stage = static_cast<std::uint8_t>(next);
        mind.sinceStage = 0;
    }
    // A number that is kept while the stage lasts.
    [[nodiscard]] std::uint32_t drawnOfStage(Stream stream) const {
        return hashOf(hashOf(situation.environment.seed, stream, situation.fish),
                      static_cast<std::uint32_t>(now - mind.sinceStage));
    }
    // Ticks since its last thought.
    [[nodiscard]] static constexpr std::uint32_t betweenThoughts() {
        return static_cast<std::uint32_t>(fish::kTicksBetweenThoughts);
    }

    [[nodiscard]] bool leads() const {
        return leaderOf(*situation.environment.view, situation.parameters, situation.fish) ==
               situation.fish;
    }
    [[nodiscard]] bool loops() const { return habit.manner == config::GrazeManner::Loop; }

    // Whether it lets go of sand in this thought: once in each period, at a time drawn.
    [[nodiscard]] bool puffs() const {
        if (habit.sandSeconds <= 0) return false;
        const auto period = static_cast<std::uint64_t>(static_cast<float>(habit.sandSeconds) *
                                                       static_cast<float>(kTicksPerSecond));
        const std::uint32_t drawn =
            hashOf(situation.environment.seed, Stream::Sand, situation.fish);
        const std::uint64_t since = now + drawn % period;
        const float when = unitOf(hashOf(drawn, static_cast<std::uint32_t>(since / period))) *
                           kSandSpread * static_cast<float>(period);
        const auto begins = static_cast<std::uint64_t>(when);
        return since % period >= begins && since % period < begins + betweenThoughts();
    }

    // Whether a shoal's leader goes on: two of the shoal were charged, little is left, or it has
    // been here long enough.
    [[nodiscard]] bool isDone() const {
        if (loops() || !leads()) return false;
        if (mind.charged == fish::kChargedTwice) return true;
        if (stage() == GrazeStage::Travel) return mind.sinceStage > kTravelTicks;
        return isDoneWithPatch();
    }

    // Whether little is left on its patch, or it has been there long enough.
    [[nodiscard]] bool isDoneWithPatch() const {
        const std::uint32_t stay =
            kShortestGrazeTicks +
            hashOf(hashOf(situation.environment.seed, Stream::Patches, situation.fish),
                   mind.target) %
                kGrazeSpreadTicks;
        return mind.sinceArrival > kLooksTicks &&
               (turf.shareOf(mind.target) < kTooLittle || mind.sinceArrival > stay);
    }

    // The bites of a bout.
    [[nodiscard]] std::uint32_t bitesOfBout() const {
        return habit.leastBites +
               drawnOfStage(Stream::Bites) % (habit.mostBites - habit.leastBites + 1);
    }
    // Bites that are due since the bout began.
    [[nodiscard]] std::uint32_t bitesAt(std::uint32_t ticks) const {
        return static_cast<std::uint32_t>(static_cast<float>(habit.bitesPerSecond) *
                                          static_cast<float>(ticks) /
                                          static_cast<float>(kTicksPerSecond));
    }

    [[nodiscard]] glm::vec3 toSpot() const { return patch.spots[mind.spot] - senses.position; }
    // From the mouth to the spot.
    [[nodiscard]] glm::vec3 lacking() const {
        return toSpot() - senses.heading * (fish::kNoseBodyLengths * senses.length);
    }

    // Of its middle over the surface of the boulder, body lengths.
    [[nodiscard]] float heightLengths() const {
        return (place::lengthOf(senses.position - patch.boulder) - patch.surfaceMetres) /
               senses.length;
    }

    // Another spot of the patch than the present one: a near one that is ahead.
    void takeSpot() const {
        const std::uint32_t drawn = drawnOfStage(Stream::Spots);
        const glm::vec3 level =
            place::directionOf({senses.heading.x, 0, senses.heading.z}, senses.heading);
        std::uint8_t best = mind.spot;
        float least = std::numeric_limits<float>::infinity();
        for (std::uint32_t spot = 0; spot < surroundings::kSpots; ++spot) {
            const glm::vec3 to = patch.spots[spot] - senses.position;
            const float far = place::lengthOf(to);
            const float behind = 1 - place::dot(place::directionOf(to, level), level);
            const float cost =
                far * (1 + kSpotBehind * behind) * (1 + kDrawnOfSpot * unitOf(hashOf(drawn, spot)));
            if (spot == mind.spot || cost >= least) continue;
            least = cost;
            best = static_cast<std::uint8_t>(spot);
        }
        mind.spot = best;
    }

    // Enters the stage that follows from where it is.
    void goOn() const {
        if (isAtPatch(stage()))
            goOnAtPatch();
        else
            goOnToPatch();
    }

    void goOnToPatch() const {
        if (stage() == GrazeStage::Travel)
            arrive();
        else if (stage() == GrazeStage::Done || mind.sinceStage >= kPuffTicks)
            enter(GrazeStage::Travel);
    }

    // It goes down to a spot once it is near its patch.
    void arrive() const {
        if (senses.patch.distance > kArrivesMetres + senses.length) return;
        mind.sinceArrival = 0;
        takeSpot();
        enter(GrazeStage::Settle);
    }

    void goOnAtPatch() const {
        const float off = place::lengthOf(lacking());
        if (stage() == GrazeStage::Bite)
            goOnBiting(off);
        else if (stage() == GrazeStage::Settle)
            goOnSettling(off);
        else if (off > kSpotRunUpLengths * senses.length || mind.sinceStage > kSpotRunUpTicks)
            enter(GrazeStage::Settle);
    }

    // Bites at the spot once the mouth is there. `off`: metres from the mouth to the spot.
    void goOnSettling(float off) const {
        if (off < kReachLengths * senses.length + kMouthReachMetres)
            enter(GrazeStage::Bite);
        else if (cannotTurnTo(lacking()))
            enter(GrazeStage::RunUp);
        else if (mind.sinceStage > kSettleTicks)
            leaveSpot();
    }

    // Until the bout is over, or it is too low or off its spot.
    void goOnBiting(float off) const {
        if (bitesAt(mind.sinceStage) > bitesOfBout()) {
            leaveSpot();
        } else if (heightLengths() < kTooLow) {
            takeSpot();
            enter(GrazeStage::Settle);
        } else if (off > kOffMetres + kReachLengths * senses.length) {
            enter(GrazeStage::Settle);
        }
    }

    // To another spot; on a loop to the next patch.
    void leaveSpot() const {
        takeSpot();
        enter(loops() ? GrazeStage::Done : GrazeStage::Settle);
    }

    void bite() const {
        const std::uint32_t before = mind.sinceStage - std::min(mind.sinceStage, betweenThoughts());
        if (bitesAt(mind.sinceStage) > bitesAt(before))
            events.push_back({fish::DeferredEventKind::Bite, situation.fish, mind.target});
    }

    [[nodiscard]] glm::vec3 current() const {
        const surroundings::Surroundings& around = *situation.environment.surroundings;
        return around.current.at(senses.position, around.openCurrent);
    }

    // Whether another fish of the shoal is near and goes to the same patch.
    [[nodiscard]] bool isOnSameWay(std::uint32_t other) const {
        const fish::FishView& view = *situation.environment.view;
        const bool isNear = place::lengthOf(view.position(other) - senses.position) < kFileMetres;
        return !view.shows(other, fish::kAway) && view.patch[other] == mind.target && isNear;
    }

    // The fish before this one in the file; kNobody for who leads.
    [[nodiscard]] std::uint32_t ahead() const {
        const fish::Household household = fish::householdOf(situation.parameters, situation.fish);
        if (loops() || leads()) return fish::kNobody;
        for (std::uint32_t other = situation.fish; other > household.first;) {
            --other;
            if (isOnSameWay(other)) return other;
        }
        return fish::kNobody;
    }

    // Height over the ground at an offset from here.
    [[nodiscard]] float overGround(glm::vec3 offset) const {
        const glm::vec3 at = senses.position + offset;
        return senses.position.y -
               surroundings::groundAt(situation.environment.surroundings->obstacles, {at.x, at.z});
    }

    // The slope, as a tangent, on which it swims close over the ground ahead along a level way.
    [[nodiscard]] float slopeOver(glm::vec3 level) const {
        float slope = -1;
        for (std::uint32_t i = 1; i <= kSamples; ++i) {
            const float metres = kGroundAheadMetres * static_cast<float>(i);
            slope = std::max(slope, (kOverGroundMetres - overGround(level * metres)) / metres);
        }
        return slope;
    }

    // Close over the ground to the patch, or behind the fish ahead.
    [[nodiscard]] fish::Course travel() const {
        const fish::FishView& view = *situation.environment.view;
        const std::uint32_t drawn =
            hashOf(hashOf(situation.environment.seed,
                          Stream::Patches,
                          fish::householdOf(situation.parameters, situation.fish).first),
                   mind.target);
        float pace = situation.parameters.medium * (1 - kPaceSpread * unitOf(drawn));
        glm::vec3 way = senses.patch.offset + patch.normal * kOverGroundMetres;
        const std::uint32_t file = ahead();
        if (file != fish::kNobody && senses.patch.distance > 2 * kArrivesMetres) {
            const glm::vec3 behind = view.position(file) - senses.position -
                                     view.heading(file) * (kFileLengths * senses.length);
            const float lengths =
                place::dot(behind, place::directionOf(way, senses.heading)) / senses.length;
            pace += std::clamp(kPacePerLength * lengths, -kMostHurry, kMostHurry);
            way = behind + view.heading(file) * (kFileLengths * senses.length);
        }
        const glm::vec3 level = place::directionOf({way.x, 0, way.z}, senses.heading);
        // Near the patch its own height counts.
        const float far = std::clamp(place::lengthOf({way.x, 0, way.z}) - 0.5F, 0.0F, 1.0F);
        const float slope = slopeOver(level) * far + way.y / kGroundAheadMetres * (1 - far);
        const glm::vec3 desired = level + glm::vec3{0, std::clamp(slope, -0.5F, 0.5F), 0};
        if (overGround({}) < kRisesBelow * senses.length)
            return {steeply(place::directionOf(desired + senses.push + glm::vec3{0, kRiseSlope, 0},
                                               senses.heading)),
                    situation.parameters.slow,
                    0};
        return heading(situation, desired + roomFrom(situation), pace);
    }

    // Whether a near spot is too far to the side or too steep below to be reached by a turn.
    [[nodiscard]] bool cannotTurnTo(glm::vec3 lacks) const {
        const float distance = place::lengthOf(lacks);
        if (distance > kTooNearLengths * senses.length) return false;
        return place::dot(lacks, senses.heading) < kSpotAheadCosine * distance;
    }

    // One step of the present stage.
    [[nodiscard]] fish::Course course() const {
        if (stage() == GrazeStage::Settle) return settle();
        if (stage() == GrazeStage::RunUp) return runUp();
        if (stage() != GrazeStage::Bite) return travel();
        bite();
        return hold();
    }

    // Down to the spot, from above.
    [[nodiscard]] fish::Course settle() const {
        const glm::vec3 lacks = lacking();
        const float length = senses.length;
        const float slow = situation.parameters.slow;
        const float aside = std::sqrt(lacks.x * lacks.x + lacks.z * lacks.z);
        if (-lacks.y > kSteepest * aside + kSlackLengths * length)
            return carefully({senses.heading.x, -kDiveSlope, senses.heading.z},
                             kSettlingPace * slow);
        const float above = std::min(kSpotFromAbove * aside, kSpotMostAbove * length);
        const glm::vec3 wish = (lacks + glm::vec3{0, above, 0}) / kClosesSeconds;
        const glm::vec3 through =
            place::directionOf(wish, {}) *
                std::min(place::lengthOf(wish), kSettlingPace * slow * length) -
            current();
        return carefully(through,
                         std::clamp(place::lengthOf(through) / length,
                                    kLeastSettlingPace * slow,
                                    kSettlingPace * slow));
    }

    // Straight on, level and off the rock.
    [[nodiscard]] fish::Course runUp() const {
        return carefully({senses.heading.x, kRunUpSlope, senses.heading.z},
                         kSettlingPace * situation.parameters.slow);
    }

    // Turns in its place unless something is in its way.
    [[nodiscard]] fish::Course carefully(glm::vec3 desired, float speed) const {
        const float lift = std::clamp(2 * (1 - heightLengths() / kLiftedBelow), 0.0F, kMostLift);
        const glm::vec3 way = place::directionOf(desired, senses.heading) + senses.push +
                              place::directionOf(senses.position - patch.boulder, {}) * lift;
        return {steeply(place::directionOf(way, senses.heading)),
                speed,
                senses.urgency < 1 ? 0.0F : senses.urgency};
    }

    // Keeps the mouth at the spot.
    [[nodiscard]] fish::Course hold() const {
        const glm::vec3 nose = noseDown();
        const float metres = place::dot(toSpot(), nose) - fish::kNoseBodyLengths * senses.length;
        const float speed = metres / kClosesSeconds - place::dot(current(), nose);
        return {nose,
                std::clamp(
                    speed / senses.length, -situation.parameters.slow, situation.parameters.slow),
                0};
    }

    // Towards the spot, 30 to 58 degrees down.
    [[nodiscard]] glm::vec3 noseDown() const {
        const glm::vec3 to = place::directionOf(toSpot(), senses.heading);
        const float y = std::clamp(to.y, -kMostDown, -kLeastDown);
        const glm::vec3 level = place::directionOf({to.x, 0, to.z}, senses.heading);
        return steeply(level * std::sqrt(1 - y * y) + glm::vec3{0, y, 0});
    }
};

}  // namespace

fish::Course graze(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    assert(situation.senses.patch.seen());
    const Grazer grazer{situation, mind, events};
    const bool puffs = grazer.puffs();
    if (puffs) {
        grazer.enter(GrazeStage::Puff);
        events.push_back({fish::DeferredEventKind::PuffSand, situation.fish, fish::kNobody});
    } else if (grazer.isDone()) {
        mind.charged = 0;
        grazer.enter(GrazeStage::Done);
    } else {
        grazer.goOn();
    }
    return grazer.course();
}

}  // namespace aquarama::behaviour
