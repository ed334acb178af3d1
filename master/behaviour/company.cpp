// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/company.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/hours.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"
#include "master/behaviour/ways.h"

namespace aquarama::behaviour {

namespace {

// Periods of shadowing, in ticks, and how many hosts are drawn until one is in sight.
constexpr std::uint64_t kTicksOfBout = std::uint64_t{50} * 60;
constexpr std::uint32_t kShortestShadowing = 10 * 60;
constexpr std::uint32_t kShadowingSpread = 30 * 60;
constexpr std::uint64_t kLongerBouts = 3;
constexpr std::uint32_t kHostsTried = 12;

// A shadowing fish keeps this far over the back of its host.
constexpr float kOverBackMetres = 0.15F;
// From the middle of a host to its back, as a share of its length.
constexpr float kHalfHeight = 0.2F;
// Body lengths a second faster for each body length behind.
constexpr float kCompanyCatchUp = 1.2F;
constexpr float kNearLengths = 1.5F;
// Weight of the course of the other fish, in body lengths of way to the place beside it.
constexpr float kSameCourse = 1.2F;
// The leading partner waits from this many times the distance that the pair keeps.
constexpr float kPairIsApart = 2.0F;

// The course to a place beside another fish that swims, and then along with it.
fish::Course alongside(const Situation& situation, std::uint32_t other, glm::vec3 place) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const glm::vec3 towards = place - senses.position;
    const glm::vec3 course = view.heading(other);
    // Far off, the whole distance counts; near, only the part along the course, so that it does not
    // overtake.
    const float distance = place::lengthOf(towards) / senses.length;
    const float behind =
        distance > kNearLengths ? distance : place::dot(towards, course) / senses.length;
    const float theirs = view.fish[other].speed / senses.length;
    const float speed =
        std::clamp(theirs + kCompanyCatchUp * behind, 0.0F, situation.parameters.fast);
    return heading(situation, towards + course * (kSameCourse * senses.length), speed);
}

// Whether a fish is there and nearer than this.
bool isWithin(const Situation& situation, std::uint32_t other, float metres) {
    const fish::FishView& view = *situation.environment.view;
    return other < view.size() && !view.shows(other, fish::kAway) &&
           place::lengthOf(view.position(other) - situation.senses.position) < metres;
}

// How far the fish sees another of ordinary size, metres.
float sightOf(const Situation& situation) {
    return std::min(situation.parameters.habits.visionBodyLengths * situation.senses.length,
                    situation.environment.surroundings->clarityMetres);
}

// A random fish of a random kind among those that it likes to shadow; kNobody for an empty kind.
std::uint32_t drawnHost(const Situation& situation, std::uint32_t hash) {
    const std::uint64_t kinds = situation.parameters.shadows;
    // Picks one of the bits of the mask.
    auto skip = hash % static_cast<std::uint32_t>(std::popcount(kinds));
    std::uint64_t left = kinds;
    while (skip-- > 0) left &= left - 1;
    const fish::SpeciesParameters& host =
        situation.environment.speciesParameters[std::size_t(std::countr_zero(left))];
    if (host.last == host.first) return fish::kNobody;
    return host.first + hashOf(hash, 1) % (host.last - host.first);
}

// Distances in body lengths. Huth & Wissel 1992 use separate zones (repulsion to 0.5, alignment to
// 2, attraction to 5). Here the zones overlap and fade, so that the school settles at its spacing
// instead of switching at a border.
// Distance needed side by side, as a share of the distance needed in file.
constexpr float kAbreastToFile = 0.6F;
// Share of a push in file that acts along the file; the rest acts sideways.
constexpr float kAsideShare = 0.25F;
// Fish that meet at one level pass over and under each other: so much of height is added to that
// between them, body lengths.
constexpr float kOverOrUnder = 0.15F;
constexpr float kAlignFully = 2.0F;
constexpr float kAttractFully = 5.0F;
constexpr float kAttractAlarmed = 1.5F;
// Relative gain of cohesion at full alarm.
constexpr float kHuddle = 1.5F;

// Weights of the rules against the unit vector of the present course.
constexpr float kSeparate = 2.2F;
constexpr float kMostSeparation = 0.9F;
constexpr float kAlign = 1.05F;
constexpr float kCohere = 1.2F;

// A fish turns sharply if of seven schoolmates three have turned by more than 45 degrees.
constexpr float kTurnedCosine = 0.707F;
constexpr std::size_t kQuorum = 3;

// Weight and reach of roomFrom(); the reach in lengths of the longer of the two fish.
constexpr float kGiveWay = 1.5F;
constexpr float kRoomBodyLengths = 1.2F;

// Body lengths: below this distance no direction is defined.
constexpr float kNowhere = 1.0e-6F;

// A neighbour as seen from the fish, in units of `per`.
struct Neighbour {
    // In lengths of the fish itself, or of a larger fish that it meets.
    glm::vec3 offset;
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

// Separation from one neighbour. Fish are long: in file they need more room than side by side, so
// the component along the course is scaled before the distance is compared. The fish behind brakes
// and moves aside.
void giveWay(Company& company, const Neighbour& neighbour, glm::vec3 heading, float spacing) {
    const float ahead = place::dot(neighbour.offset, heading);
    glm::vec3 aside = neighbour.offset - heading * ahead;
    const float room = place::lengthOf(aside + heading * (ahead * kAbreastToFile));
    if (room >= spacing) return;
    const float tooNear = 1 - room / spacing;
    // Linear at first, then with the cube: weak at the spacing, strong at contact.
    const float repulsion = tooNear * (1 + 2 * tooNear * tooNear);
    aside.y += std::copysign(kOverOrUnder, aside.y);
    company.separation -=
        place::directionOf(aside + heading * (ahead * kAsideShare), {0, 1, 0}) * repulsion;
    company.brake += repulsion * std::max(0.0F, place::dot(neighbour.towards, heading));
}

// Sum of the pushes away from these neighbours.
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

// Weights of the school's steering against the unit vector of the present course.
constexpr float kKeepCourse = 0.8F;
constexpr float kKeepCourseTurning = 0.3F;
constexpr float kFollow = 0.7F;
constexpr float kWander = 0.55F;
// Share by which the random part decreases at full alarm.
constexpr float kAttentive = 0.7F;
constexpr float kGiveWayToHunter = 0.8F;

// Weight of the push away from obstacles.
constexpr float kSteerClear = 1.15F;

// Share by which a schooling fish slows down where it likes to be.
constexpr float kSlowsDown = 0.4F;
// Speeds of a schooling fish, in body lengths a second: limits, and pace around a goal.
constexpr float kSlowest = 0.85F;
constexpr float kFastest = 2.9F;
constexpr float kHaste = 2.0F;  // faster out of the way of the submarine
constexpr float kBaitBallPace = 2.1F;
// Body lengths a second slower for a push of 1 straight back.
constexpr float kBrakeBefore = 0.4F;
// Body lengths a second faster at full alarm.
constexpr float kAlarmedPace = 0.5F;

// Distant schoolmates that a fish looks at, and ticks for which it looks at the same ones.
constexpr std::uint32_t kGlimpses = 4;
constexpr std::uint64_t kTicksOfGlance = 60;
constexpr float kRejoin = 1.5F;
// The share by which a school spreads where it likes to be.
constexpr float kSpreads = 1.2F;
// And where the school likes to be: there its parts stay apart for a while, but nobody alone.
constexpr float kRejoinAtRest = 0.3F;
constexpr std::size_t kPart = 4;
// Weight of keeping its level in the ball, against the way around it.
constexpr float kKeepLevel = 1.0F;

// Offset to the goal in the shape of the school: heights are stretched where the school is flat.
glm::vec3 fromGoal(const surroundings::Goal& goal, glm::vec3 position) {
    glm::vec3 towards = goal.position - position;
    towards.y /= goal.flatness;
    return towards;
}

// Around the goal, left or right about by the sign of Goal::mill.
glm::vec3 circled(const surroundings::Goal& goal, glm::vec3 towards, float pull) {
    const float turn = goal.mill > 0 ? 1.0F : -1.0F;
    const glm::vec3 around{-towards.z * turn, 0, towards.x * turn};
    return place::directionOf(around, {1, 0, 0}) * 1.6F +
           place::directionOf(towards, {}) * (pull + 0.3F);
}

// Up or down to the level that the fish keeps in a bait ball.
glm::vec3 toLevel(const Environment& environment, std::uint32_t fish, glm::vec3 towards) {
    const float high = environment.schoolRadiusMetres;
    const float climb = towards.y + levelInBall(environment.seed, fish) * high;
    return {0, std::clamp(climb / (0.3F * high), -1.0F, 1.0F) * kKeepLevel, 0};
}

// The way of a fish in a bait ball: around its middle, and to its own level.
glm::vec3 wayInBall(const Environment& environment, std::uint32_t fish, glm::vec3 position) {
    const surroundings::Goal& goal = environment.goal;
    const glm::vec3 towards = fromGoal(goal, position);
    const float outside = place::lengthOf(towards) - environment.schoolRadiusMetres;
    const float pull = std::clamp(outside / environment.schoolRadiusMetres, 0.0F, 1.5F);
    return circled(goal, towards, pull) + toLevel(environment, fish, towards);
}

// A slowly changing random direction of each fish, so that no two hold exactly the same course.
glm::vec3 whim(std::uint32_t seed, std::size_t fish, Tick tick) {
    const std::uint32_t own = hashOf(seed, static_cast<std::uint32_t>(fish));
    // The period of five hours keeps the float exact enough.
    const float seconds = static_cast<float>(tick.value % (1U << 20U)) / 60.0F;
    return {place::valueNoise(own, {seconds * 0.5F, 0.5F}),
            0.6F * place::valueNoise(own, {seconds * 0.5F, 8.5F}),
            place::valueNoise(own, {seconds * 0.5F, 16.5F})};
}

// Wanted speed, body lengths a second: the mean of the goal's pace and that of the neighbours,
// faster to close up, slower behind others and before obstacles.
float wantedSpeed(const Situation& situation, const Company& company, float alarm) {
    const surroundings::Goal& goal = situation.environment.goal;
    const Senses& senses = situation.senses;
    float own = situation.parameters.medium;
    if (situation.environment.gathering == config::Gathering::Mill) {
        const float perLength = 1 / senses.length;
        const float behind =
            place::dot(goal.position - senses.position, senses.heading) * perLength;
        const float goalPace =
            place::lengthOf(goal.velocityMetresPerSecond) * perLength + 0.12F * behind;
        own = goalPace + (kBaitBallPace - goalPace) * std::abs(goal.mill);
    } else {
        // Where they like to be they slow down: by this alone a school stays.
        own *= 1 - kSlowsDown * likingOf(*situation.environment.surroundings, senses.position).now;
    }
    const float pace = company.speed > 0 ? 0.5F * (own + company.speed) : own;
    // An obstacle ahead slows it too, but a fish in the way of the submarine hurries.
    const float stop =
        senses.hurry > 0 ? -kHaste * senses.hurry
                         : kBrakeBefore * std::max(0.0F, -place::dot(senses.push, senses.heading));
    return std::clamp(
        pace + company.hurry - company.brake - stop + kAlarmedPace * alarm, kSlowest, kFastest);
}

// Schoolmates that a fish looks at beyond its neighbours, drawn at random once a second.
using Glance = std::array<std::uint32_t, kGlimpses>;
Glance glanceOf(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const std::uint32_t own = hashOf(situation.environment.seed, Stream::Glances, situation.fish);
    const auto when = static_cast<std::uint32_t>(situation.environment.tick.value / kTicksOfGlance);
    Glance glance{};
    for (std::uint32_t i = 0; i < kGlimpses; ++i) {
        glance[i] =
            parameters.first + hashOf(hashOf(own, when), i) % (parameters.last - parameters.first);
        situation.environment.view->fetch(glance[i]);
    }
    return glance;
}

// Mean direction to the distant schoolmates that it looks at: by it separated parts of a school
// find together again. At full alarm near ones count too, and all seek the middle.
glm::vec3 glimpses(const Situation& situation, const Glance& glance, float alarm) {
    const fish::FishView& view = *situation.environment.view;
    // The flashing of a whole school is seen as far as the water is clear.
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

// Alarm of a school, 0 to 1: 0 up to the fear that is heeded (f0), 1 from the fear at which each
// fish flees alone (f1). So a predator far off does not compress the school.
float alarmOf(const fish::SpeciesParameters& parameters, const fish::Feelings& feelings) {
    const float more = feelings.fear - parameters.habits.fear.from;
    return std::clamp(
        more / std::max(parameters.habits.fear.alone - parameters.habits.fear.from, 0.01F),
        0.0F,
        1.0F);
}

// A factor of a time of day; in full alarm a school is as by day.
float factorAt(const place::ByPhase& values, double timeOfDay, float alarm) {
    const float calm = place::valueAt(values, timeOfDay);
    return calm + (1 - calm) * alarm;
}

// A push away from a predator that grows before it is so near that each fish flees alone.
glm::vec3 clearing(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const float fear = situation.feelings.greatestFear - parameters.habits.fear.from;
    if (fear <= 0) return {};
    const float share = std::min(
        1.0F, fear / std::max(parameters.habits.fear.alone - parameters.habits.fear.from, 0.01F));
    return flightFrom(situation) * (kGiveWayToHunter * share);
}

}  // namespace

std::uint32_t partnerOf(const fish::SpeciesParameters& parameters, std::uint32_t fish) {
    assert(fish >= parameters.first);
    assert(fish < parameters.last);
    const std::uint32_t partner = parameters.first + ((fish - parameters.first) ^ 1U);
    return partner < parameters.last ? partner : fish::kNobody;
}

std::uint32_t shadowedBy(const Situation& situation) {
    if (situation.parameters.shadows == 0) return fish::kNobody;
    const Environment& environment = situation.environment;
    const std::uint32_t own = hashOf(environment.seed, Stream::Bouts, situation.fish);
    // One that lies in wait follows others in one period of two, and for longer.
    const bool waits = situation.parameters.habits.hunt.ambush.has_value();
    const std::uint64_t longer = waits ? kLongerBouts : 1;
    const std::uint64_t now = environment.tick.value + own % (longer * kTicksOfBout);
    const std::uint32_t bout =
        hashOf(own, static_cast<std::uint32_t>(now / (longer * kTicksOfBout)));
    const std::uint64_t passed = now % (longer * kTicksOfBout) / longer;
    if (passed > kShortestShadowing + bout % kShadowingSpread) return fish::kNobody;
    if (waits && bout % 2 != 0) return fish::kNobody;
    for (std::uint32_t i = 0; i < kHostsTried; ++i) {
        const std::uint32_t host = drawnHost(situation, hashOf(bout, Stream::Hosts, i));
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
    // Partners find each other as far as the water is clear, farther than they see others.
    if (!isWithin(situation, partner, situation.environment.surroundings->clarityMetres)) return {};
    const glm::vec3 from = senses.position - view.position(partner);
    const bool leads = situation.fish < partner;
    // The leading partner goes where it likes, but waits for the other.
    if (leads && place::lengthOf(from) < kPairIsApart * apart) return {};
    const glm::vec3 level = place::directionOf({from.x, 0.3F * from.y, from.z}, {0, 0, 1});
    return alongside(situation, partner, view.position(partner) + level * apart);
}

Company companyOf(const fish::FishView& view,
                  const Senses& senses,
                  std::uint32_t fish,
                  float alarm,
                  const Togetherness& together) {
    assert(fish < view.size());
    assert(alarm >= 0);
    assert(alarm <= 1);
    Company company;
    const float perLength = 1 / view.fish[fish].length;
    const float calm = kSpacing * together.spacing;
    const float spacing = calm + (kAlarmedSpacing - calm) * alarm;
    const float attract = kAttractFully + (kAttractAlarmed - kAttractFully) * alarm;
    for (std::size_t i = 0; i < senses.others.count; ++i) {
        // From a larger fish it keeps a distance in that fish's lengths.
        const std::uint32_t other = senses.others.fish[i];
        const float per = std::min(perLength, 1 / view.fish[other].length);
        giveWay(company, neighbourOf(view, senses, other, per), senses.heading, spacing);
    }
    std::size_t turned = 0;
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
        turned += place::dot(view.heading(other), senses.heading) < kTurnedCosine ? 1 : 0;
    }
    company.hasTurned = turned >= kQuorum;
    // Separation is limited: at a larger angle between the courses the tails would meet.
    const float parting = place::lengthOf(company.separation) * kSeparate;
    if (parting > kMostSeparation) company.separation *= kMostSeparation / parting;
    if (senses.schoolmates.count == 0) return company;
    const float share = 1 / static_cast<float>(senses.schoolmates.count);
    company.alignment *= share * together.alignment;
    company.cohesion *= share * (1 + kHuddle * alarm) * together.cohesion;
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

float levelInBall(std::uint32_t seed, std::uint32_t fish) {
    const std::uint32_t own = hashOf(seed, Stream::SchoolLevels, fish);
    // The sum of two uniform numbers: a triangular distribution.
    return unitOf(own) + unitOf(hashOf(own)) - 1;
}

float schoolRadiusMetres(std::size_t fish) {
    // A ball with one fish in (0.3 m)^3, grown in steps of 10 % (no libm, hence no cube root).
    float radius = 0.3F;
    while (radius * radius * radius < static_cast<float>(fish) * 0.015F) radius *= 1.1F;
    return radius;
}

fish::Course school(const Situation& situation) {
    const Environment& environment = situation.environment;
    const Senses& senses = situation.senses;
    const float alarm = alarmOf(situation.parameters, situation.feelings);
    const bool gathers = environment.gathering == config::Gathering::Mill;
    const Glance glance = gathers ? Glance{} : glanceOf(situation);
    const double time = environment.surroundings->timeOfDay;
    const float rest =
        gathers ? 0.0F : likingOf(*environment.surroundings, senses.position).place * (1 - alarm);
    const Togetherness together{factorAt(kSchoolSpacing, time, alarm) * (1 + kSpreads * rest),
                                factorAt(kSchoolAlignment, time, alarm),
                                factorAt(kSchoolCohesion, time, alarm)};
    const Company company = companyOf(*environment.view, senses, situation.fish, alarm, together);
    // Avoiding obstacles comes before following.
    const float follow = kFollow * std::max(0.0F, 1 - senses.urgency) * together.cohesion;
    const float apart = senses.schoolmates.count < kPart ? 0.0F : rest;
    const float rejoin = kRejoin + (kRejoinAtRest - kRejoin) * apart;
    const glm::vec3 way =
        gathers ? wayInBall(environment, situation.fish, senses.position)
                : glimpses(situation, glance, alarm) * rejoin + ownWay(situation) * (1 - alarm);
    const float keep = company.hasTurned && !gathers ? kKeepCourseTurning : kKeepCourse;
    const glm::vec3 desired = senses.heading * keep + pullOf(company) + way * follow +
                              whim(environment.seed, situation.fish, environment.tick) *
                                  (kWander * (1 - kAttentive * alarm)) +
                              clearing(situation) + wayRound(situation) * kSteerClear;
    return {place::levelled(place::directionOf(desired, senses.heading)),
            wantedSpeed(situation, company, alarm) * factorAt(kSchoolSpeed, time, alarm),
            senses.urgency};
}

}  // namespace aquarama::behaviour
