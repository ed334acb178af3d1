// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/home.h"
#include "master/behaviour/hours.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

namespace {

// The wanted height over the home, as a share of that of the largest fish: of the smallest one, and
// what the rank by size adds. In a current of kStrongCurrent and more it is halved; where the fish
// is threatened it is less by up to kSinks.
constexpr float kLowest = 0.4F;
constexpr float kHeightBySize = 0.6F;
constexpr float kStrongCurrent = 0.3F;  // m/s
constexpr float kByCurrent = 0.5F;
constexpr float kSinks = 0.75F;
// The cloud's radius where it is threatened, as a share of that at ease.
constexpr float kShrinks = 0.6F;
// The cloud stands up-current of its home by the way of the water in this time, and at most by this
// share of its radius.
constexpr float kUpCurrentSeconds = 2;
constexpr float kMostUpCurrent = 0.6F;
// Every so often a fish takes another place in the cloud.
constexpr std::uint64_t kTicksAtAPlace = std::uint64_t{24} * 60;

// The way over ground to its place is made in this time, at most at a share of the medium gait; at
// less than so many lengths the fish is there.
constexpr float kArrivesSeconds = 2.5F;
constexpr float kMostPace = 0.8F;
constexpr float kThereLengths = 0.5F;
// In a current above this a fish turns against it (m/s).
constexpr float kFacesFrom = 0.02F;

// A dart at a particle: how long it lasts, how far the fish looks, and the threat from which it
// picks no more.
constexpr std::uint64_t kDartTicks = 26;
constexpr float kDartLengths = 2.5F;
constexpr float kPicksUntil = 0.2F;

// A point drawn from the unit disc, in plan, by the fish and the time.
glm::vec3 placeInCloud(const Situation& situation) {
    const std::uint32_t own =
        hashOf(situation.environment.seed, Stream::CloudPlaces, situation.fish);
    const std::uint64_t turn =
        (situation.environment.tick.value + own % kTicksAtAPlace) / kTicksAtAPlace;
    const std::uint32_t drawn = hashOf(own, static_cast<std::uint32_t>(turn));
    glm::vec3 place{};
    for (std::uint32_t i = 0; i < 4; ++i) {
        place = {signedUnitOf(hashOf(drawn, 2 * i)), 0, signedUnitOf(hashOf(drawn, 2 * i + 1))};
        if (place::dot(place, place) <= 1) break;
    }
    // A little higher or lower than its size alone would have it.
    place.y = 0.35F * signedUnitOf(hashOf(drawn, 9));
    return place;
}

// Where the fish wants to be, relative to it.
glm::vec3 wishOf(const Situation& situation, glm::vec3 current) {
    const config::Habits& habits = situation.parameters.habits;
    const float threat = situation.feelings.threat;
    const float strength = place::lengthOf(current);
    const auto radius = static_cast<float>(habits.home.radiusMetres);
    const float rank = sizeRankOf(situation.parameters, situation.senses.length);
    const float high =
        static_cast<float>(habits.cloud->heightMetres) * (kLowest + kHeightBySize * rank) *
        (1 - kByCurrent * std::min(1.0F, strength / kStrongCurrent)) * (1 - kSinks * threat) *
        place::valueAt(kCloudHeight, situation.environment.surroundings->timeOfDay);
    const glm::vec3 up = place::directionOf(current, {}) *
                         -std::min(kMostUpCurrent * radius, kUpCurrentSeconds * strength);
    glm::vec3 aside = placeInCloud(situation) * (radius * (1 - (1 - kShrinks) * threat));
    aside.y = high * (1 + placeInCloud(situation).y);
    return homeOf(situation.parameters, situation.fish) + aside + up - situation.senses.position;
}

// The number drawn for the dart that is under way; nothing between two darts.
std::optional<std::uint32_t> presentDart(const Situation& situation) {
    const auto gap = static_cast<std::uint64_t>(
        static_cast<float>(situation.parameters.habits.cloud->pickSeconds) *
        static_cast<float>(kTicksPerSecond));
    const std::uint32_t own = hashOf(situation.environment.seed, Stream::Picks, situation.fish);
    const std::uint64_t now = situation.environment.tick.value + own % gap;
    const std::uint32_t pick = hashOf(own, static_cast<std::uint32_t>(now / gap));
    // It begins at some time within the gap, so that nobody picks in time with another.
    const std::uint64_t begins = pick % (gap > kDartTicks ? gap - kDartTicks : 1);
    const std::uint64_t since = now % gap;
    if (since < begins || since >= begins + kDartTicks) return {};
    return pick;
}

// The particle that the fish darts at now, relative to it: one that it senses, else one too small
// to be drawn, up-current. Zero where it picks nothing now.
glm::vec3 pickOf(const Situation& situation, glm::vec3 current) {
    const Senses& senses = situation.senses;
    if (situation.feelings.threat > kPicksUntil) return {};
    const std::optional<std::uint32_t> pick = presentDart(situation);
    if (!pick) return {};
    if (senses.food.seen() && senses.food.distance < kDartLengths * senses.length)
        return senses.food.offset;
    const glm::vec3 against = place::directionOf(-current, senses.heading);
    const glm::vec3 aside{signedUnitOf(hashOf(*pick, 1)),
                          0.5F * signedUnitOf(hashOf(*pick, 2)),
                          signedUnitOf(hashOf(*pick, 3))};
    return place::directionOf(senses.heading + against * 0.6F + aside, senses.heading) *
           (kDartLengths * senses.length);
}

// Hidden fish stand beside one another: so far about the middle of the site, in its sizes.
constexpr float kAboutSite = 0.4F;
// A dive ends this near to its place.
constexpr float kInPlaceMetres = 0.08F;
// Ticks at the beginning of a dive in which it may be a fast start.
constexpr std::uint32_t kDiveStartTicks = 16;

// A unit vector, and a speed in body lengths a second.
struct Way {
    glm::vec3 course;
    float speed;
};

// The way through the water that brings the fish to a place relative to it, where it is within so
// many metres, and keeps it there.
Way throughWater(const Situation& situation, glm::vec3 wish, glm::vec3 current, float thereMetres) {
    const Senses& senses = situation.senses;
    const float most = kMostPace * situation.parameters.medium * senses.length;
    const float distance = place::lengthOf(wish);
    const float pace = distance < thereMetres ? 0.0F : std::min(most, distance / kArrivesSeconds);
    const glm::vec3 through = place::directionOf(wish, {}) * pace - current;
    const bool faces = place::lengthOf(current) > kFacesFrom;
    return {pace > 0 || faces ? place::directionOf(through, senses.heading) : senses.heading,
            place::lengthOf(through) / senses.length};
}

}  // namespace

glm::vec3 placeInShelter(const Situation& situation) {
    const place::Site& site =
        situation.environment.surroundings->sites[situation.senses.shelter.site.object];
    const std::uint32_t own = hashOf(site.seed, situation.fish);
    const glm::vec3 aside{
        signedUnitOf(hashOf(own, 1)), 0.5F * unitOf(hashOf(own, 2)), signedUnitOf(hashOf(own, 3))};
    return situation.senses.shelter.site.offset + aside * (kAboutSite * site.sizeMetres) +
           site.normal * (0.3F * situation.senses.length);
}

fish::Course keepStation(const Situation& situation, glm::vec3 wish) {
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const glm::vec3 current = around.current.at(situation.senses.position, around.openCurrent);
    const Way way = throughWater(situation, wish, current, kThereLengths * situation.senses.length);
    return heading(situation, way.course + roomFrom(situation), way.speed);
}

fish::Course keptPlace(const Situation& situation, glm::vec3 towards, float metres) {
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const glm::vec3 current = around.current.at(situation.senses.position, around.openCurrent);
    const Way way = throughWater(situation, towards, current, metres);
    return heading(situation, way.course, way.speed);
}

fish::Course hover(const Situation& situation) {
    assert(situation.parameters.habits.cloud);
    const Senses& senses = situation.senses;
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const glm::vec3 current = around.current.at(senses.position, around.openCurrent);
    const glm::vec3 pick = pickOf(situation, current);
    if (pick != glm::vec3{})
        return heading(situation, pick, 0.5F * (parameters.medium + parameters.fast));
    return keepStation(situation, wishOf(situation, current));
}

namespace {

HideStage stageOf(const fish::Mind& mind) {
    return static_cast<HideStage>(mind.stage);
}

// The clock of the stage begins anew only where the fish arrives.
void enter(fish::Mind& mind, HideStage next) {
    const HideStage before = stageOf(mind);
    mind.stage = static_cast<std::uint8_t>(next);
    if (isThere(next) != isThere(before)) mind.sinceStage = 0;
}

// It hides as from a rush once a predator has rushed.
void heedRush(const Senses& senses, fish::Mind& mind) {
    const bool rushed = std::ranges::any_of(std::span(senses.predators).first(senses.predatorCount),
                                            &Sighting::rushing);
    if (!rushed || isFromRush(stageOf(mind))) return;
    enter(mind, isThere(stageOf(mind)) ? HideStage::HiddenFromRush : HideStage::DiveFromRush);
}

// A dive ends near its place.
void arrive(const Senses& senses, fish::Mind& mind, float distance) {
    if (!isThere(stageOf(mind)) && distance < kInPlaceMetres + kThereLengths * senses.length)
        enter(mind, isFromRush(stageOf(mind)) ? HideStage::HiddenFromRush : HideStage::Hidden);
}

// Keeps its place, and turns its head outwards.
fish::Course stayHidden(const Situation& situation, const fish::Mind& mind, glm::vec3 towards) {
    const Senses& senses = situation.senses;
    const float slow = situation.parameters.slow;
    const glm::vec3 out = situation.environment.surroundings->sites[mind.target].normal;
    const bool strays =
        place::lengthOf(towards) > kInPlaceMetres + 2 * kThereLengths * senses.length;
    const glm::vec3 course = strays ? towards : glm::vec3{out.x, 0.2F, out.z};
    return {place::levelled(place::directionOf(course, senses.heading)),
            strays ? slow : 0.1F * slow,
            0};
}

// To its place, with a fast start where it is startled.
fish::Course dive(const Situation& situation, const fish::Mind& mind, glm::vec3 towards) {
    const Senses& senses = situation.senses;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const float lengths = place::lengthOf(towards) / senses.length;
    fish::Course course{
        steeply(place::directionOf(towards + senses.push * senses.length, senses.heading)),
        std::min(parameters.fast, parameters.slow + lengths),
        lengths > 2 ? 1.0F : 0.0F};
    course.startsFast =
        mind.sinceStage < kDiveStartTicks && lengths > 3 && situation.feelings.threat >= 1;
    return course;
}

}  // namespace

fish::Course hide(const Situation& situation, fish::Mind& mind) {
    assert(situation.senses.shelter.site.seen());
    heedRush(situation.senses, mind);
    const glm::vec3 towards = placeInShelter(situation);
    arrive(situation.senses, mind, place::lengthOf(towards));
    return isThere(stageOf(mind)) ? stayHidden(situation, mind, towards)
                                  : dive(situation, mind, towards);
}

}  // namespace aquarama::behaviour
