// SPDX-License-Identifier: Apache-2.0

#include "master/behaviour/company.h"

#include <algorithm>
#include <array>
#include <bit>

#include "common/place/place.h"
#include "common/units/random_streams.h"
#include "master/behaviour/feeding.h"
#include "master/behaviour/routines.h"

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

namespace {

// Distances in body lengths. Huth & Wissel 1992 have zones (repulse 0.5, align 2, attract 5); here
// the zones fade into one another, so that the school settles at its spacing instead of dithering
// at a border.
constexpr float kAbreastToFile = 0.6F;  // room abreast for room in file
constexpr float kAsideShare = 0.25F;    // of a push in file that is along it: the rest is sideways
constexpr float kAlignFully = 2.0F;
constexpr float kAttractFully = 5.0F;
constexpr float kAttractAlarmed = 1.5F;
constexpr float kHuddle = 1.5F;  // times as much more, alarmed

constexpr float kSeparate = 2.2F;  // weights against the unit vector of one's own course
constexpr float kMostSeparation = 0.9F;
constexpr float kAlign = 0.9F;
constexpr float kCohere = 1.2F;

constexpr float kGiveWay = 1.5F;          // of one that keeps to itself
constexpr float kRoomBodyLengths = 1.2F;  // of the longer of two fish

constexpr float kNowhere = 1.0e-6F;  // lengths: no way leads to what is nearer

struct Neighbour {
    glm::vec3 offset;  // in lengths: of the fish itself, or of a larger one that it meets
    glm::vec3 towards;
    float distance;
};

Neighbour neighbourOf(const fish::FishView& view,
                      const Senses& senses,
                      std::uint32_t other,
                      float per) {
    const glm::vec3 offset = (view.position(other) - senses.position) * per;
    const float distance = place::lengthOf(offset);
    return {offset, distance > kNowhere ? offset / distance : glm::vec3{0, 1, 0}, distance};
}

// Fish are long: in file they need more room than abreast; there the one behind brakes and moves
// aside.
void giveWay(Company& company, const Neighbour& neighbour, glm::vec3 heading, float spacing) {
    const float ahead = place::dot(neighbour.offset, heading);
    const glm::vec3 aside = neighbour.offset - heading * ahead;
    const float room = place::lengthOf(aside + heading * (ahead * kAbreastToFile));
    if (room >= spacing) return;
    const float tooNear = 1 - room / spacing;
    const float repulsion = tooNear * (1 + 2 * tooNear * tooNear);
    company.separation -=
        place::directionOf(aside + heading * (ahead * kAsideShare), {0, 1, 0}) * repulsion;
    company.brake += repulsion * std::max(0.0F, place::dot(neighbour.towards, heading));
}

glm::vec3 roomFromThose(const Situation& situation, const Neighbours& those) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    glm::vec3 away{};
    for (std::size_t i = 0; i < those.count; ++i) {
        const std::uint32_t other = those.fish[i];
        if ((situation.parameters.hunts >> view.kind[other] & 1U) != 0) continue;
        const float room = kRoomBodyLengths * std::max(senses.length, view.fish[other].length);
        const glm::vec3 offset = view.position(other) - senses.position;
        const float tooNear = std::max(0.0F, 1 - place::lengthOf(offset) / room);
        away -= place::directionOf(offset, {0, 1, 0}) * (kGiveWay * tooNear);
    }
    return away;
}

}  // namespace

Company companyOf(const fish::FishView& view,
                  const Senses& senses,
                  std::uint32_t fish,
                  float alarm) {
    Company company;
    const float perLength = 1 / view.fish[fish].length;
    const float spacing = kSpacing + (kAlarmedSpacing - kSpacing) * alarm;
    const float attract = kAttractFully + (kAttractAlarmed - kAttractFully) * alarm;
    for (std::size_t i = 0; i < senses.others.count; ++i) {
        // Of a larger fish one stays clear by its length.
        const std::uint32_t other = senses.others.fish[i];
        const float per = std::min(perLength, 1 / view.fish[other].length);
        giveWay(company, neighbourOf(view, senses, other, per), senses.heading, spacing);
    }
    for (std::size_t i = 0; i < senses.schoolmates.count; ++i) {
        const std::uint32_t other = senses.schoolmates.fish[i];
        const Neighbour mate = neighbourOf(view, senses, other, perLength);
        giveWay(company, mate, senses.heading, spacing);
        const float tooFar =
            std::clamp((mate.distance - spacing) / (attract - spacing), 0.0F, 1.0F);
        const float inStep =
            std::clamp((kAttractFully - mate.distance) / (kAttractFully - kAlignFully), 0.0F, 1.0F);
        company.cohesion += mate.towards * tooFar;
        company.alignment += view.heading(other) * inStep;
        company.speed += view.fish[other].speed * perLength;
    }
    // Parting by more than a slant would bring the tails together.
    const float parting = place::lengthOf(company.separation) * kSeparate;
    if (parting > kMostSeparation) company.separation *= kMostSeparation / parting;
    if (senses.schoolmates.count == 0) return company;
    const float share = 1 / static_cast<float>(senses.schoolmates.count);
    company.alignment *= share;
    company.cohesion *= share * (1 + kHuddle * alarm);
    company.hurry = place::dot(company.cohesion, senses.heading);
    company.speed *= share;
    return company;
}

glm::vec3 pullOf(const Company& company) {
    return company.separation * kSeparate + company.alignment * kAlign + company.cohesion * kCohere;
}

glm::vec3 roomFrom(const Situation& situation) {
    return roomFromThose(situation, situation.senses.schoolmates) +
           roomFromThose(situation, situation.senses.others);
}

namespace {

constexpr float kKeepCourse = 0.8F;  // weights against the unit vector of one's own course
constexpr float kFollow = 0.7F;
constexpr float kWander = 0.55F;
constexpr float kAttentive = 0.7F;  // so much less of that, alarmed
constexpr float kGiveWayToHunter = 0.8F;

constexpr float kSlowest = 0.85F;  // body lengths a second
constexpr float kFastest = 2.9F;
constexpr float kMillPace = 1.9F;
constexpr float kBaitBallPace = 2.1F;
constexpr float kBrakeBefore = 0.4F;  // body lengths a second, for a push of 1 straight back
constexpr float kAlarmedPace = 0.5F;  // more than at ease

constexpr std::uint32_t kGlimpses = 4;
constexpr std::uint64_t kTicksOfGlance = 60;
constexpr float kRejoin = 1.5F;
constexpr float kKeepLevel = 1.0F;  // against the way round the ball

// How far from the goal, in the shape of the school: a ball, flatter where the water is shallow.
glm::vec3 fromGoal(const surroundings::Goal& goal, glm::vec3 position) {
    glm::vec3 towards = goal.position - position;
    towards.y /= goal.flatness;
    return towards;
}

// Where the school as a whole goes: along with the goal, and towards it from outside the school.
glm::vec3 followed(const surroundings::Goal& goal, glm::vec3 towards, float pull) {
    return place::directionOf(towards, {}) * pull + goal.velocityMetresPerSecond * 2.0F;
}

// Round the goal.
glm::vec3 circled(const surroundings::Goal& goal, glm::vec3 towards, float pull) {
    const float turn = goal.mill > 0 ? 1.0F : -1.0F;
    const glm::vec3 around{-towards.z * turn, 0, towards.x * turn};
    return place::directionOf(around, {1, 0, 0}) * 1.6F +
           place::directionOf(towards, {}) * (pull + 0.3F);
}

glm::vec3 toLevel(const Environment& environment, std::uint32_t fish, glm::vec3 towards) {
    const float high = environment.schoolRadiusMetres;
    const float climb = towards.y + levelInBall(environment.seed, fish) * high;
    return {0, std::clamp(climb / (0.3F * high), -1.0F, 1.0F) * kKeepLevel, 0};
}

glm::vec3 commonWay(const Environment& environment, std::uint32_t fish, glm::vec3 position) {
    const surroundings::Goal& goal = environment.goal;
    const glm::vec3 towards = fromGoal(goal, position);
    const float outside = place::lengthOf(towards) - environment.schoolRadiusMetres;
    const float pull = std::clamp(outside / environment.schoolRadiusMetres, 0.0F, 1.5F);
    const glm::vec3 follow = followed(goal, towards, pull);
    if (environment.gathering == config::Gathering::Mill)
        return circled(goal, towards, pull) + toLevel(environment, fish, towards);
    if (goal.mill == 0) return follow;
    return follow + (circled(goal, towards, pull) - follow) * std::abs(goal.mill);
}

// A slow whim of each fish, so that no two hold quite the same course.
glm::vec3 whim(std::uint32_t seed, std::size_t fish, Tick tick) {
    const std::uint32_t own = hashOf(seed, static_cast<std::uint32_t>(fish));
    const float seconds = static_cast<float>(tick.value % (1U << 20U)) / 60.0F;
    return {place::valueNoise(own, {seconds * 0.5F, 0.5F}),
            0.6F * place::valueNoise(own, {seconds * 0.5F, 8.5F}),
            place::valueNoise(own, {seconds * 0.5F, 16.5F})};
}

// The pace of the goal and of those about, quicker where the school is ahead and slower behind
// others' tails.
float wantedSpeed(const Situation& situation, const Company& company, float alarm) {
    const surroundings::Goal& goal = situation.environment.goal;
    const Senses& senses = situation.senses;
    float own = situation.parameters.medium;
    if (situation.environment.gathering != config::Gathering::None) {
        const float perLength = 1 / senses.length;
        const float behind =
            place::dot(goal.position - senses.position, senses.heading) * perLength;
        const float goalPace =
            place::lengthOf(goal.velocityMetresPerSecond) * perLength + 0.12F * behind;
        const bool ball = situation.environment.gathering == config::Gathering::Mill;
        const float round = ball ? kBaitBallPace : kMillPace;
        own = goalPace + (round - goalPace) * std::abs(goal.mill);
    }
    const float pace = company.speed > 0 ? 0.5F * (own + company.speed) : own;
    // What it heads for slows it too.
    const float stop = kBrakeBefore * std::max(0.0F, -place::dot(senses.push, senses.heading));
    return std::clamp(
        pace + company.hurry - company.brake - stop + kAlarmedPace * alarm, kSlowest, kFastest);
}

// Whom it catches sight of, of its own kind.
using Glance = std::array<std::uint32_t, kGlimpses>;
Glance glanceOf(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const std::uint32_t own =
        hashOf(hashOf(situation.environment.seed, Stream::Glances), situation.fish);
    const auto when = static_cast<std::uint32_t>(situation.environment.tick.value / kTicksOfGlance);
    Glance glance{};
    for (std::uint32_t i = 0; i < kGlimpses; ++i) {
        glance[i] =
            parameters.first + hashOf(hashOf(own, when), i) % (parameters.last - parameters.first);
        situation.environment.view->fetch(glance[i]);
    }
    return glance;
}

// Beyond its neighbours a fish sees others of its kind, a few at a time: so parts of a school that
// lost one another find together again; alarmed, all seek the middle.
glm::vec3 glimpses(const Situation& situation, const Glance& glance, float alarm) {
    const fish::FishView& view = *situation.environment.view;
    // A school is a large, flashing thing: it is seen as far as the water is clear.
    const float sight = situation.environment.surroundings->clarityMetres;
    glm::vec3 sum{};
    for (const std::uint32_t other : glance) {
        const glm::vec3 offset = view.position(other) - situation.senses.position;
        const float distance = place::lengthOf(offset);
        const bool seen = distance > kSightMetres * (1 - alarm) && distance < sight &&
                          !view.shows(other, fish::kAway) &&
                          inFieldOfView(situation.senses.heading, offset);
        if (seen) sum += offset / (distance * static_cast<float>(kGlimpses));
    }
    return sum;
}

// 0 up to the fear that is heeded, 1 from that on with which each flees for itself: a predator that
// only goes about far off does not press a school together.
float alarmOf(const fish::SpeciesParameters& parameters, const fish::Feelings& feelings) {
    const float more = feelings.fear - parameters.habits.fearFrom;
    return std::clamp(
        more / std::max(parameters.habits.fearAlone - parameters.habits.fearFrom, 0.01F),
        0.0F,
        1.0F);
}

// Schoolmates give way to a predator before it comes so near that each flees for itself.
glm::vec3 clearing(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const float fear = situation.feelings.greatestFear - parameters.habits.fearFrom;
    if (fear <= 0) return {};
    const float share = std::min(
        1.0F, fear / std::max(parameters.habits.fearAlone - parameters.habits.fearFrom, 0.01F));
    return flightFrom(situation) * (kGiveWayToHunter * share);
}

}  // namespace

float levelInBall(std::uint32_t seed, std::uint32_t fish) {
    const std::uint32_t own = hashOf(hashOf(seed, Stream::SchoolLevels), fish);
    return unitOf(own) + unitOf(hashOf(own)) - 1;
}

float schoolRadiusMetres(std::size_t fish) {
    // A ball at one fish in (0.3 m)^3; grown in steps, as there is no exact cube root.
    float radius = 0.3F;
    while (radius * radius * radius < static_cast<float>(fish) * 0.015F) radius *= 1.1F;
    return radius;
}

fish::Course school(const Situation& situation) {
    const Environment& environment = situation.environment;
    const Senses& senses = situation.senses;
    const float alarm = alarmOf(situation.parameters, situation.feelings);
    const bool gathers = environment.gathering != config::Gathering::None;
    const Glance glance = gathers ? Glance{} : glanceOf(situation);
    const Company company = companyOf(*environment.view, senses, situation.fish, alarm);
    // What must be avoided comes before where one would like to go.
    const float follow = kFollow * std::max(0.0F, 1 - senses.urgency);
    const glm::vec3 way = gathers ? commonWay(environment, situation.fish, senses.position)
                                  : glimpses(situation, glance, alarm) * kRejoin;
    const glm::vec3 desired = senses.heading * kKeepCourse + pullOf(company) + way * follow +
                              whim(environment.seed, situation.fish, environment.tick) *
                                  (kWander * (1 - kAttentive * alarm)) +
                              clearing(situation) + wayRound(situation);
    return {place::levelled(place::directionOf(desired, senses.heading)),
            wantedSpeed(situation, company, alarm),
            senses.urgency};
}

}  // namespace aquarama::behaviour
