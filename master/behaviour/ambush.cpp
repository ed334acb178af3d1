// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/ambush.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/home.h"
#include "master/behaviour/intention_generator.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// A post is kept for so long, and a place at the edge of one.
constexpr std::uint64_t kTicksOfPost = std::uint64_t{240} * 60;
constexpr std::uint64_t kTicksOfEdge = std::uint64_t{80} * 60;
// One post in so many is at a structure.
constexpr std::uint32_t kStructureOneIn = 4;
// A place at an edge is so far outside, and begins at this share of the height of the post; the
// fish sinks from there.
constexpr float kOutsideMetres = 0.35F;
constexpr float kBegins = 0.9F;
constexpr float kSinkSpeed = 0.1F;  // metres a second
constexpr float kLowestMetres = 0.4F;
// It begins up-current by the way of the water in this time, at most so far.
constexpr float kPostUpCurrentSeconds = 6;
constexpr float kPostMostUpCurrent = 0.8F;
// Nearer to the borders of the water and to the ground it would have to give way to them.
constexpr float kOffBorders = 1;
constexpr float kOffGround = 0.9F;
// A fish that hangs drifts so far from its place before it comes back; one that comes begins to
// hang so near. It sinks in short dives, which begin and end so far above its place.
constexpr float kDrifts = 2;
constexpr float kArrives = 0.6F;
constexpr float kDiveFrom = 0.15F;
constexpr float kDiveUntil = 0.03F;
// It comes from above, over what stands between: by so much of the way, at most for so many metres.
constexpr float kFromAbove = 0.4F;
constexpr float kMostAbove = 2.5F;
// Of the tilt, as a sine, that share is hanging; and of the slow gait that share is moving.
constexpr float kHangs = 0.5F;
constexpr float kMoves = 0.5F;
// Over a structure a post is so high; a fish without tilt waits so far over its site, and in so
// much of its length off it.
constexpr float kOverStructure = 1;
constexpr float kOverSite = 0.3F;
constexpr float kOffSite = 0.35F;

// A place to lie in wait: about its middle, from its radius outwards, from its height down.
struct Post {
    glm::vec3 middle{};
    float radius = 0;
    float height = 0;
};

std::uint32_t drawn(const Situation& situation, std::uint64_t period) {
    const std::uint32_t own = hashOf(situation.environment.seed, Stream::Posts, situation.fish);
    return hashOf(
        own,
        static_cast<std::uint32_t>((situation.environment.tick.value + own % period) / period));
}

std::size_t cloudsOf(const fish::SpeciesParameters& species) {
    return species.habits.cloud ? species.homes.size() : 0;
}

std::size_t structuresIn(const Situation& situation) {
    return situation.environment.surroundings->structures.size();
}
Post structureAt(const Situation& situation, std::size_t index) {
    const surroundings::Structure& structure =
        situation.environment.surroundings->structures[index];
    return {structure.crown, structure.radiusMetres, kOverStructure};
}

// The clouds of its prey, species by species.
std::size_t cloudsIn(const Situation& situation) {
    std::size_t count = 0;
    for (std::uint64_t kinds = situation.parameters.hunts; kinds != 0; kinds &= kinds - 1)
        count +=
            cloudsOf(situation.environment.speciesParameters[std::size_t(std::countr_zero(kinds))]);
    return count;
}
Post cloudAt(const Situation& situation, std::size_t index) {
    for (std::uint64_t kinds = situation.parameters.hunts; kinds != 0; kinds &= kinds - 1) {
        const fish::SpeciesParameters& prey =
            situation.environment.speciesParameters[std::size_t(std::countr_zero(kinds))];
        if (index < cloudsOf(prey))
            return {prey.homes[index],
                    static_cast<float>(prey.habits.home.radiusMetres),
                    static_cast<float>(prey.habits.cloud->heightMetres)};
        index -= cloudsOf(prey);
    }
    return {};
}

// Of so many posts the nearer of two that are drawn; of equally near ones the first.
std::optional<Post> nearerDrawn(const Situation& situation,
                                std::uint32_t now,
                                std::size_t count,
                                Post (*postAt)(const Situation&, std::size_t)) {
    if (count == 0) return {};
    const auto [first, second] = std::minmax({hashOf(now, 1) % count, hashOf(now, 2) % count});
    const Post one = postAt(situation, first);
    const Post other = postAt(situation, second);
    const glm::vec3 from = situation.senses.position;
    return place::lengthOf(other.middle - from) < place::lengthOf(one.middle - from) ? other : one;
}

// At a structure in one period of four, else at a cloud where there is one.
std::optional<Post> edgePost(const Situation& situation) {
    const std::uint32_t now = drawn(situation, kTicksOfPost);
    const std::size_t clouds = cloudsIn(situation);
    return now % kStructureOneIn == 0 || clouds == 0
               ? nearerDrawn(situation, now, structuresIn(situation), structureAt)
               : nearerDrawn(situation, now, clouds, cloudAt);
}

// The place nearest to a place that is off the borders of the water and over the ground.
glm::vec3 clearOf(const place::Obstacles& obstacles, glm::vec3 place) {
    const place::Region& water = obstacles.water;
    const glm::vec3 room = glm::max(water.halfExtent - glm::vec3{kOffBorders}, glm::vec3{0});
    glm::vec3 clear = glm::clamp(place, water.centre - room, water.centre + room);
    clear.y = std::max(clear.y, surroundings::groundAt(obstacles, {clear.x, clear.z}) + kOffGround);
    return clear;
}

// The place at the edge of a post now, relative to the fish.
glm::vec3 placeAtEdge(const Situation& situation, const Post& post) {
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const std::uint32_t own = hashOf(situation.environment.seed, Stream::Posts, situation.fish);
    const std::uint64_t ticks = situation.environment.tick.value + own % kTicksOfEdge;
    const std::uint32_t edge = hashOf(own, static_cast<std::uint32_t>(ticks / kTicksOfEdge));
    const float since =
        static_cast<float>(ticks % kTicksOfEdge) / static_cast<float>(kTicksPerSecond);
    const glm::vec3 out = place::directionOf(
        {signedUnitOf(hashOf(edge, 1)), 0, signedUnitOf(hashOf(edge, 2))}, {1, 0, 0});
    const glm::vec3 current = around.current.at(situation.senses.position, around.openCurrent);
    const glm::vec3 up =
        place::directionOf(current, {}) *
        -std::min(kPostMostUpCurrent, kPostUpCurrentSeconds * place::lengthOf(current));
    const float height = std::max(kLowestMetres, kBegins * post.height - kSinkSpeed * since);
    const glm::vec3 place =
        post.middle + out * (post.radius + kOutsideMetres) + up + glm::vec3{0, height, 0};
    return clearOf(around.obstacles, place) - situation.senses.position;
}

// The site of a kind that is nearest to a place, of those farther than `beyond` metres; of equally
// near ones the first; null where there is none.
const place::Site* nextSite(const Environment& environment,
                            config::SiteKind kind,
                            glm::vec3 from,
                            float beyond) {
    const std::vector<place::Site>& sites = environment.surroundings->sites;
    std::uint32_t next = fish::kNobody;
    PlacesKnown::findOutwards([&](float reachSquared) {
        float nearest = std::sqrt(reachSquared);
        environment.grids->sites.visit(from, reachSquared, sites.size(), [&](std::uint32_t i) {
            const float distance = place::lengthOf(sites[i].place - from);
            if (sites[i].kind != kind || distance <= beyond || distance > nearest) return;
            if (distance == nearest && i > next) return;
            nearest = distance;
            reachSquared = distance * distance;
            next = i;
        });
        return next != fish::kNobody;
    });
    return next == fish::kNobody ? nullptr : &sites[next];
}

// The site of this rank, from 0 on, by its distance from a place; where there are fewer the
// farthest, null where there is none.
const place::Site* siteOfRank(const Environment& environment,
                              config::SiteKind kind,
                              glm::vec3 from,
                              std::uint32_t rank) {
    const place::Site* found = nextSite(environment, kind, from, -1);
    for (std::uint32_t i = 0; found != nullptr && i < rank; ++i) {
        const place::Site* next =
            nextSite(environment, kind, from, place::lengthOf(found->place - from));
        if (next == nullptr) break;
        found = next;
    }
    return found;
}

// The site where a fish with a home waits now, relative to it: one of the nearest of their kind.
std::optional<glm::vec3> placeAtSite(const Situation& situation) {
    const config::Habits& habits = situation.parameters.habits;
    if (!habits.home.site || situation.parameters.homes.empty()) return {};
    const glm::vec3 home = homeOf(situation.parameters, situation.fish);
    const std::uint32_t wanted = drawn(situation, kTicksOfPost) % habits.hunt.ambush->posts;
    const place::Site* found = siteOfRank(situation.environment, *habits.home.site, home, wanted);
    const glm::vec3 over{0, kOverSite, 0};
    if (found == nullptr) return home + over - situation.senses.position;
    return found->place + found->normal * (kOffSite * situation.senses.length) + over -
           situation.senses.position;
}

// Head down: drifts with the water, sinks, and comes back when it has drifted off.
fish::Course hang(const Situation& situation, glm::vec3 towards, float tilt) {
    const Senses& senses = situation.senses;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const bool hangs = senses.heading.y < -kHangs * tilt;
    const float aside = place::lengthOf({towards.x, 0, towards.z});
    const float far = std::max(aside, towards.y);
    if (far > (hangs ? kDrifts : kArrives) || senses.urgency >= 1)
        return heading(situation,
                       towards + glm::vec3{0, kFromAbove * std::min(aside, kMostAbove), 0},
                       std::min(parameters.medium, parameters.slow + 0.4F * far / senses.length));
    const bool dives = senses.speed > kMoves * parameters.slow * senses.length;
    const float level = std::sqrt(1 - tilt * tilt);
    const glm::vec3 along = place::directionOf({senses.heading.x, 0, senses.heading.z}, {1, 0, 0});
    return {{along.x * level, -tilt, along.z * level},
            towards.y < -(dives ? kDiveUntil : kDiveFrom) ? parameters.slow : 0.0F,
            0};
}

// The sine of an angle of 0 to 90 degrees without libm: Bhaskara's approximation, exact to 0.002.
float sineOf(double degrees) {
    const double x = degrees * (180 - degrees);
    return static_cast<float>(4 * x / (40500 - x));
}

}  // namespace

std::optional<fish::Course> lieInWait(const Situation& situation) {
    const std::optional<config::Ambush>& ambush = situation.parameters.habits.hunt.ambush;
    if (!ambush) return {};
    if (situation.parameters.habits.home.kind != config::HomeKind::None) {
        const std::optional<glm::vec3> towards = placeAtSite(situation);
        if (!towards) return {};
        return keptPlace(situation, *towards + roomFrom(situation) * 0.2F, 0.2F);
    }
    const std::optional<Post> post = edgePost(situation);
    if (!post) return {};
    return hang(situation, placeAtEdge(situation, *post), sineOf(ambush->hangsDegrees));
}

}  // namespace aquarama::behaviour
