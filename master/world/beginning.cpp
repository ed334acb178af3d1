// SPDX-License-Identifier: Apache-2.0
#include "master/world/beginning.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/routines.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::world {

namespace {

// Irwin-Hall distribution: the sum of four uniform numbers approximates a normal one. Scaled to
// standard deviation 1 by sqrt(3); no libm.
float bell(std::uint32_t hash) {
    float sum = 0;
    for (std::uint32_t i = 0; i < 4; ++i) sum += unitOf(hashOf(hash, i));
    return (sum - 2) * 1.7320508F;
}

// The rotation about the world's up that turns the x axis towards `course`. Sine and cosine of half
// the angle follow from square roots; no libm.
glm::quat facing(glm::vec3 course) {
    const glm::vec3 level = place::directionOf({course.x, 0, course.z}, {1, 0, 0});
    const float cosine = std::sqrt(std::max(0.0F, 0.5F * (1 + level.x)));
    const float sine = std::sqrt(std::max(0.0F, 0.5F * (1 - level.x)));
    return {cosine, 0, level.z > 0 ? -sine : sine, 0};
}

// Places of a school about its middle, in units of the distance between neighbours. The points of a
// face-centred cubic lattice, the closest packing, are sorted by their distance from the middle in
// the norm of an ellipsoid that is long along x; the nearest ones are taken. The lattice is turned,
// so that no row of it is level or along the way.
std::vector<glm::vec3> schoolCells(std::size_t fish) {
    // Lattice constant: points whose coordinates have an even sum then have nearest neighbours at
    // 1.
    constexpr float kStep = 0.70710678F;
    constexpr glm::vec3 kAxes{1.7F, 0.85F, 1.0F};
    constexpr glm::quat kTurn{0.8F, 0.3F, 0.4F, 0.331662479F};
    const auto most = static_cast<float>(fish) * 1.2F + 30.0F;
    // Grows until the ellipsoid is sure to hold more lattice points than there are fish.
    float radius = 1.0F;
    while (6.0F * kAxes.x * kAxes.y * kAxes.z * radius * radius * radius < most * 1.2F)
        radius += 0.25F;
    const auto reach = static_cast<int>(radius * kAxes.x / kStep) + 1;
    std::vector<std::pair<float, glm::vec3>> cells;  // how far out, and where
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            for (int k = -reach + ((i + j + reach) & 1); k <= reach; k += 2) {
                const glm::vec3 place = kTurn * (glm::vec3{i, j, k} * kStep);
                const glm::vec3 out = place / kAxes;
                const float distance = glm::dot(out, out);
                if (distance < radius * radius) cells.emplace_back(distance, place);
            }
    std::ranges::stable_sort(cells, {}, [](const auto& cell) { return cell.first; });
    assert(cells.size() >= fish);
    std::vector<glm::vec3> places;
    for (std::size_t at = 0; at < fish; ++at) places.push_back(cells[at].second);
    return places;
}

// A point drawn uniformly from the cube -1 to 1.
glm::vec3 signedUnits(std::uint32_t hash) {
    return {signedUnitOf(hashOf(hash, 0)),
            signedUnitOf(hashOf(hash, 1)),
            signedUnitOf(hashOf(hash, 2))};
}

// Writes the motion state of one fish: medium gait, no warp under way, a phase of its own.
void begin(std::uint32_t seed,
           std::size_t fish,
           const motion::BodyFrame& frame,
           motion::MotionStates& states) {
    motion::setBodyFrame(states, fish, frame);
    const std::uint32_t phase =
        hashOf(seed, Stream::BeginningPhase, static_cast<std::uint32_t>(fish)) >> 16U;
    states.phase[fish] = static_cast<std::uint16_t>(phase);
    states.segment[fish] = static_cast<std::uint8_t>(motion::Action::ForwardMedium);
    states.fromPhase[fish] = states.phase[fish];
    states.fromSegment[fish] = states.segment[fish];
    states.warpFrame[fish] = 0;
    states.warpLength[fish] = 0;
}

// A loosely spaced school about the goal. Each fish is a little off its lattice point and off the
// common course. A school that reaches out of the water is moved into it.
void placeSchool(std::uint32_t seed,
                 const surroundings::Goal& goal,
                 const place::Region& water,
                 std::size_t fish,
                 motion::MotionStates& states) {
    constexpr float kSpacingMetres = 0.25F;
    // Share of the spacing.
    constexpr float kOffCell = 0.22F;
    // Share of the unit vector of the course: 9 degrees at most.
    constexpr float kOffCourse = 0.16F;
    const glm::quat rotation = facing(goal.velocityMetresPerSecond);
    std::vector<glm::vec3> offsets = schoolCells(fish);
    glm::vec3 reach{1.0e-6F};
    for (std::size_t i = 0; i < fish; ++i) {
        const std::uint32_t own =
            hashOf(seed, Stream::BeginningPlace, static_cast<std::uint32_t>(i));
        offsets[i] = rotation * ((offsets[i] + signedUnits(own) * kOffCell) * kSpacingMetres);
        reach = glm::max(reach, glm::abs(offsets[i]));
    }
    // A school too large for the water is packed more densely.
    const glm::vec3 room = water.halfExtent * 0.85F;
    const glm::vec3 fits = room / reach;
    const float fit = std::min({1.0F, fits.x, fits.y, fits.z});
    const glm::vec3 play = glm::max(room - reach * fit, glm::vec3{0});
    const glm::vec3 middle = glm::clamp(goal.position, water.centre - play, water.centre + play);
    const glm::vec3 course = place::directionOf(goal.velocityMetresPerSecond, {1, 0, 0});
    for (std::size_t i = 0; i < fish; ++i) {
        const std::uint32_t own =
            hashOf(seed, Stream::BeginningHeading, static_cast<std::uint32_t>(i));
        const glm::vec3 place =
            glm::clamp(middle + offsets[i] * fit, water.centre - room, water.centre + room);
        begin(seed, i, {place, facing(course + signedUnits(own) * kOffCourse)}, states);
    }
}

// A bait ball that circles already: every fish on a ring about the goal, at its own level.
void placeBall(std::uint32_t seed,
               const surroundings::Goal& goal,
               float radius,
               const place::Region& water,
               std::size_t fish,
               motion::MotionStates& states) {
    constexpr float kInnermost = 0.7F;  // of the radius
    const glm::vec3 room = water.halfExtent * 0.85F;
    for (std::uint32_t i = 0; i < fish; ++i) {
        const std::uint32_t own = hashOf(seed, Stream::BeginningPlace, i);
        const glm::vec3 out = place::directionOf(
            {signedUnitOf(hashOf(own, 0)), 0, signedUnitOf(hashOf(own, 1))}, {1, 0, 0});
        const float away = radius * (kInnermost + unitOf(hashOf(own, 2)));
        const float rise = radius * goal.flatness * behaviour::levelInBall(seed, i);
        const glm::vec3 place = goal.position + out * away + glm::vec3{0, rise, 0};
        begin(seed,
              i,
              {glm::clamp(place, water.centre - room, water.centre + room),
               facing(glm::vec3{out.z, 0, -out.x} * goal.mill)},
              states);
    }
}

// The first place of a fish that does not school: near its home, or at the first place that it
// would go to.
glm::vec3 restingPlace(std::uint32_t seed,
                       const fish::SpeciesParameters& parameters,
                       const place::Region& water,
                       std::uint32_t fish) {
    const config::Habits& habits = parameters.habits;
    if (parameters.homes.empty())
        return behaviour::wanderingGoal(
            seed, water, static_cast<float>(habits.comfort.bestDepthMetres), fish, {});
    const std::uint32_t own = hashOf(seed, Stream::BeginningPlace, fish);
    glm::vec3 aside = signedUnits(own) * (0.5F * static_cast<float>(habits.home.radiusMetres));
    if (habits.cloud)
        aside.y = unitOf(hashOf(own)) * static_cast<float>(habits.cloud->heightMetres);
    return behaviour::homeOf(parameters, fish) + aside;
}

// Places the fish of a species each by itself, heading for the middle of the water.
void placeWanderers(std::uint32_t seed,
                    const fish::SpeciesParameters& parameters,
                    const place::Region& water,
                    motion::MotionStates& states) {
    for (std::uint32_t fish = parameters.first; fish < parameters.last; ++fish) {
        const glm::vec3 inner = water.halfExtent * 0.85F;
        const glm::vec3 place = glm::clamp(restingPlace(seed, parameters, water, fish),
                                           water.centre - inner,
                                           water.centre + inner);
        const glm::vec3 towards = water.centre - place;
        begin(seed, fish, {place, facing(towards)}, states);
    }
}

// Places fish at random within a cube about a Start, all with its heading.
void placeAbout(std::uint32_t seed,
                const config::Start& start,
                std::size_t first,
                std::size_t last,
                motion::MotionStates& states) {
    const auto angle = static_cast<float>(start.headingRadians) * 0.5F;
    // cos and sin of half the angle by their series: no libm.
    const float square = angle * angle;
    const float cosine = 1 - square * (0.5F - square * (1 / 24.0F - square / 720));
    const float sine = angle * (1 - square * (1 / 6.0F - square * (1 / 120.0F - square / 5040)));
    const glm::quat rotation{cosine, 0, sine, 0};
    for (std::size_t fish = first; fish < last; ++fish) {
        const std::uint32_t own =
            hashOf(seed, Stream::BeginningPlace, static_cast<std::uint32_t>(fish));
        const glm::vec3 share = signedUnits(own);
        const glm::vec3 place = start.centre + share * static_cast<float>(start.radiusMetres);
        begin(seed, fish, {place, rotation}, states);
    }
}

bool names(const std::vector<std::string>& list, const std::string& name) {
    return std::ranges::find(list, name) != list.end();
}

// Bits of the species of the cast that the list names.
std::uint64_t kindsNamed(const std::vector<WorldSpecies>& cast,
                         const std::vector<std::string>& list) {
    std::uint64_t kinds = 0;
    for (std::size_t i = 0; i < cast.size(); ++i)
        if (names(list, cast[i].name)) kinds |= std::uint64_t{1} << i;
    return kinds;
}

// Bits of the species of the cast that hunt this one.
std::uint64_t huntersOf(const std::vector<WorldSpecies>& cast, const std::string& name) {
    std::uint64_t kinds = 0;
    for (std::size_t i = 0; i < cast.size(); ++i)
        if (names(cast[i].habits.hunts, name)) kinds |= std::uint64_t{1} << i;
    return kinds;
}

// Whether fish of one kind charge those of another in their territory.
bool expels(const std::vector<WorldSpecies>& cast, std::size_t owner, std::size_t other) {
    return cast[owner].habits.territory && (owner == other || cast[other].habits.graze);
}

// Bits of the species of the cast that this one charges, and of those that charge it.
std::pair<std::uint64_t, std::uint64_t> expelling(const std::vector<WorldSpecies>& cast,
                                                  std::size_t kind) {
    std::uint64_t charges = 0;
    std::uint64_t chargedBy = 0;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        if (expels(cast, kind, i)) charges |= std::uint64_t{1} << i;
        if (expels(cast, i, kind)) chargedBy |= std::uint64_t{1} << i;
    }
    return {charges, chargedBy};
}

}  // namespace

std::vector<motion::FishTraits> traitsOf(const WorldOptions& options) {
    std::vector<motion::FishTraits> traits;
    std::uint32_t id = 0;
    for (const WorldSpecies& species : options.cast) {
        const config::SizeRange& size = species.size;
        for (std::uint32_t i = 0; i < species.fish; ++i, ++id) {
            const float own = bell(hashOf(options.seed, Stream::BeginningLength, id));
            // Visitors see their drawings best on large fish.
            const bool isDrawn = i >= species.fish - species.drawings;
            const float metres = isDrawn ? size.mostMetres
                                         : std::clamp(size.meanMetres + size.deviationMetres * own,
                                                      size.leastMetres,
                                                      size.mostMetres);
            traits.push_back({id, static_cast<std::uint16_t>(std::lround(metres * 1000))});
        }
    }
    return traits;
}

void placeFish(const WorldOptions& options,
               const surroundings::Goal& goal,
               std::span<const fish::SpeciesParameters> speciesParameters,
               const surroundings::Surroundings& surroundings,
               motion::MotionStates& states) {
    const place::Region& water = surroundings.obstacles.water;
    for (const fish::SpeciesParameters& parameters : speciesParameters) {
        const WorldSpecies& species = options.cast[parameters.kind];
        const std::size_t first = parameters.first;
        const std::size_t last = parameters.last;
        if (species.start)
            placeAbout(options.seed, *species.start, first, last, states);
        else if (first == 0 && species.habits.shares.schooling > 0)
            options.scene.gathering == config::Gathering::Mill
                ? placeBall(options.seed,
                            goal,
                            surroundings::millRadiusMetres(water, last, species.size.meanMetres),
                            water,
                            last,
                            states)
                : placeSchool(options.seed, goal, water, last, states);
        else
            placeWanderers(options.seed, parameters, water, states);
    }
}

void placeFishAt(motion::MotionStates& states,
                 std::size_t fish,
                 glm::vec3 place,
                 glm::vec3 course) {
    assert(fish < states.size());
    motion::setBodyFrame(states, fish, {place, facing(course)});
}

fish::SpeciesParameters makeSpeciesParameters(const std::vector<WorldSpecies>& cast,
                                              std::size_t kind,
                                              const fish::Gaits& gaits,
                                              const surroundings::Surroundings& surroundings,
                                              std::size_t first,
                                              std::size_t last) {
    assert(kind < cast.size());
    assert(kind < kMostSpecies);
    assert(first <= last);
    const config::Habits& habits = cast[kind].habits;
    behaviour::Homes homes = behaviour::homesOf(surroundings,
                                                habits,
                                                cast[kind].homes,
                                                static_cast<std::uint32_t>(first),
                                                static_cast<std::uint32_t>(last - first));
    const auto [charges, chargedBy] = expelling(cast, kind);
    return {.kind = static_cast<std::uint8_t>(kind),
            .first = static_cast<std::uint32_t>(first),
            .last = static_cast<std::uint32_t>(last),
            .hunts = kindsNamed(cast, habits.hunts),
            .huntedBy = huntersOf(cast, cast[kind].name),
            .shadows = kindsNamed(cast, habits.shadows),
            .expels = charges,
            .expelledBy = chargedBy,
            .size = cast[kind].size,
            .homes = std::move(homes.places),
            .fishAtAHome = homes.fishAtEach,
            .slow = gaits.speed[indexOf(motion::Action::ForwardSlow)],
            .medium = gaits.speed[indexOf(motion::Action::ForwardMedium)],
            .fast = gaits.speed[indexOf(motion::Action::ForwardFast)],
            .turnSeconds = 90.0F * kRadiansPerDegree<float> /
                           gaits.yawRate[indexOf(motion::Action::TurnLeftSharp)],
            .habits = habits};
}

}  // namespace aquarama::world
