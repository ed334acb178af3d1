// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/companion.h"

#include <algorithm>
#include <bit>

#include "common/place/angle.h"
#include "common/units/random_streams.h"
#include "master/behaviour/act/pursue.h"

namespace aquarama::behaviour {

namespace {

constexpr std::uint64_t kTicksOfBout = 50 * 60;
constexpr std::uint32_t kShortestShadowing = 10 * 60;  // ticks
constexpr std::uint32_t kShadowingSpread = 30 * 60;
constexpr std::uint32_t kHostsTried = 4;

constexpr float kOverBackMetres = 0.15F;
constexpr float kHalfHeight = 0.2F;  // of a host's length, from its middle to its back
constexpr float kCatchUp = 1.2F;     // body lengths a second for a body length behind
constexpr float kNearLengths = 1.5F;
constexpr float kSameCourse = 1.2F;   // against the way to the place: metres
constexpr float kPairIsApart = 2.0F;  // times the distance that it keeps

// At a place beside another that swims: there, and then along with it.
fish::Course alongside(const Situation& situation, std::uint32_t other, glm::vec3 place) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const glm::vec3 towards = place - senses.position;
    const glm::vec3 course = view.heading(other);
    // Far off it only has to come; near, it must not overtake.
    const float distance = place::lengthOf(towards) / senses.length;
    const float behind =
        distance > kNearLengths ? distance : place::dot(towards, course) / senses.length;
    const float theirs = view.fish[other].speed / senses.length;
    const float speed = std::clamp(theirs + kCatchUp * behind, 0.0F, situation.parameters.fast);
    return heading(situation, towards + course * (kSameCourse * senses.length), speed);
}

bool isWithin(const Situation& situation, std::uint32_t other, float metres) {
    const fish::FishView& view = *situation.environment.view;
    return other < view.size() && !view.shows(other, fish::kAway) &&
           place::lengthOf(view.position(other) - situation.senses.position) < metres;
}

float sightOf(const Situation& situation) {
    return std::min(situation.parameters.habits.visionBodyLengths * situation.senses.length,
                    situation.environment.surroundings->clarityMetres);
}

// A fish of one of the kinds it likes to shadow.
std::uint32_t drawnHost(const Situation& situation, std::uint32_t hash) {
    const std::uint64_t kinds = situation.parameters.shadows;
    auto skip = hash % static_cast<std::uint32_t>(std::popcount(kinds));
    std::uint64_t left = kinds;
    while (skip-- > 0) left &= left - 1;
    const fish::SpeciesParameters& host =
        situation.environment.speciesParameters[std::size_t(std::countr_zero(left))];
    if (host.last == host.first) return fish::kNobody;
    return host.first + hashOf(hash, 1) % (host.last - host.first);
}

}  // namespace

std::uint32_t partnerOf(const fish::SpeciesParameters& parameters, std::uint32_t fish) {
    const std::uint32_t partner = parameters.first + ((fish - parameters.first) ^ 1U);
    return partner < parameters.last ? partner : fish::kNobody;
}

std::uint32_t shadowedBy(const Situation& situation) {
    if (situation.parameters.shadows == 0) return fish::kNobody;
    const Environment& environment = situation.environment;
    const std::uint32_t own = hashOf(hashOf(environment.seed, Stream::Bouts), situation.fish);
    const std::uint64_t now = environment.tick.value + own % kTicksOfBout;
    const std::uint32_t bout = hashOf(own, static_cast<std::uint32_t>(now / kTicksOfBout));
    if (now % kTicksOfBout > kShortestShadowing + bout % kShadowingSpread) return fish::kNobody;
    for (std::uint32_t i = 0; i < kHostsTried; ++i) {
        const std::uint32_t host = drawnHost(situation, hashOf(hashOf(bout, Stream::Hosts), i));
        if (isWithin(situation, host, sightOf(situation))) return host;
    }
    return fish::kNobody;
}

std::optional<fish::Course> keptCompany(const Situation& situation) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const std::uint32_t host = shadowedBy(situation);
    if (host != fish::kNobody) {
        const float over = kOverBackMetres + kHalfHeight * view.fish[host].length;
        return alongside(situation, host, view.position(host) + glm::vec3{0, over, 0});
    }
    const auto apart =
        static_cast<float>(situation.parameters.habits.pairBodyLengths) * senses.length;
    if (apart <= 0) return {};
    const std::uint32_t partner = partnerOf(situation.parameters, situation.fish);
    // Partners know each other, and look for each other as far as the water is clear.
    if (!isWithin(situation, partner, situation.environment.surroundings->clarityMetres)) return {};
    const glm::vec3 from = senses.position - view.position(partner);
    const bool leads = situation.fish < partner;
    // The one that leads goes where it likes, but waits.
    if (leads && place::lengthOf(from) < kPairIsApart * apart) return {};
    const glm::vec3 level = place::directionOf({from.x, 0.3F * from.y, from.z}, {0, 0, 1});
    return alongside(situation, partner, view.position(partner) + level * apart);
}

}  // namespace aquarama::behaviour
