// SPDX-License-Identifier: Apache-2.0
#include "master/world/world.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/base/random_streams.h"
#include "common/motion/headings.h"
#include "common/place/place.h"
#include "common/school/school_motion.h"
#include "master/behaviour/routines.h"
#include "master/behaviour/think.h"
#include "master/behaviour/ways.h"
#include "master/fish/minds.h"
#include "master/world/beginning.h"
#include "master/world/release.h"
#include "master/world/visits.h"

namespace aquarama::world {

namespace {

// Limits of an absence, in ticks.
constexpr std::uint32_t kShortestAbsence = 20 * 60;
constexpr std::uint32_t kLongestAbsence = 60 * 60;
// Beyond this distance haze hides a fish of the size of the school.
constexpr float kHazeMetres = 12;
// Share of the half extent of the water in which places are drawn.
constexpr float kShore = 0.85F;
// Distance of such a place from surface, sand and rocks.
constexpr float kSurfaceRoomMetres = 1;
constexpr float kFloorRoomMetres = 1;
constexpr float kRockRoomMetres = 1;
constexpr std::uint32_t kPlacesTried = 16;

// A random place in the water, over the sand and under the surface; rocks are not considered.
glm::vec3 placeDrawn(const place::Obstacles& obstacles, std::uint32_t hash) {
    const glm::vec3 share{
        signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
    glm::vec3 place = obstacles.water.centre + obstacles.water.halfExtent * share * kShore;
    const float lowest = place::floorHeight(obstacles.place, {place.x, place.z}) + kFloorRoomMetres;
    place.y = std::min(std::max(place.y, lowest), -kSurfaceRoomMetres);
    return place;
}

bool isClear(const place::Obstacles& obstacles, glm::vec3 place) {
    static_assert(kRockRoomMetres <= place::kChartReachMetres);
    const auto isIn = [&](const place::Rock& rock) {
        return place::lengthOf(place - rock.centre) < rock.radiusMetres + kRockRoomMetres;
    };
    return !place::anyRockNear(obstacles, {place.x, place.z}, place.y - 2 * kRockRoomMetres, isIn);
}

// The middle of a school is found anew so often.
constexpr std::uint64_t kTicksBetweenMiddles = 8;
// Sizes of the parts of a tick's work. They depend on the number of fish alone, never on the number
// of threads, so that the order of events is always the same.
constexpr std::size_t kFishInChunk = 512;
constexpr std::size_t kSlotsInSlice = 1024;
// A thinker is prefetched this many thoughts ahead.
constexpr std::size_t kFetchedAhead = 3;
// Fish that a predator hunts see from so far that it begins to rush; and of so many predators.
constexpr float kRushSeenMetres = 4.0F;
constexpr std::size_t kMostRushes = 64;

// Mean length of the school's fish; of a scad where there is no cast.
float meanLengthMetres(const WorldOptions& options) {
    return options.cast.empty() ? 0.24F : options.cast.front().size.meanMetres;
}

// Prefetches the data of a fish that will think soon. The rest of what it needs it shares with the
// fish of its cell, which are in the cache already.
void fetch(const fish::Minds& minds,
           const fish::FishView& view,
           const fish::Courses& courses,
           std::uint32_t fish) {
    __builtin_prefetch(&minds[fish]);
    view.fetch(fish);
    __builtin_prefetch(&courses[fish]);
}

// A fresh mind, in the mood that the scene asks for.
fish::Mind beginningMind(const fish::SpeciesParameters& parameters,
                         const std::optional<config::Start>& start,
                         std::uint32_t seed,
                         std::uint32_t fish,
                         float length) {
    fish::Mind mind = behaviour::freshMind(parameters, seed, fish, length);
    if (start)
        fish::setMood(
            parameters, static_cast<float>(start->hunger), static_cast<float>(start->libido), mind);
    return mind;
}

std::uint64_t ticksIn(double seconds) {
    return static_cast<std::uint64_t>(seconds * static_cast<double>(kTicksPerSecond));
}

}  // namespace

std::vector<Absence> makeAbsences(std::span<const fish::SpeciesParameters> speciesParameters) {
    std::size_t hunted = 0;
    for (const fish::SpeciesParameters& parameters : speciesParameters)
        if (parameters.huntedBy != 0) hunted += parameters.last - parameters.first;
    std::vector<Absence> absences;
    absences.reserve(hunted);
    return absences;
}

Absence absenceFrom(std::uint32_t seed, std::uint32_t fish, Tick now) {
    const std::uint32_t hash =
        hashOf(hashOf(seed, Stream::Absence, fish), static_cast<std::uint32_t>(now.value));
    return {fish, {now.value + kShortestAbsence + hash % (kLongestAbsence - kShortestAbsence)}};
}

glm::vec3 arrivalPlace(const surroundings::Surroundings& surroundings,
                       std::uint32_t fish,
                       Tick tick) {
    const std::uint32_t own = hashOf(hashOf(surroundings.seed, Stream::Arrival, fish),
                                     static_cast<std::uint32_t>(tick.value));
    glm::vec3 best = surroundings.obstacles.water.centre;
    float farthest = -1;
    for (std::uint32_t i = 0; i < kPlacesTried; ++i) {
        const glm::vec3 place = placeDrawn(surroundings.obstacles, hashOf(own, i));
        if (!isClear(surroundings.obstacles, place)) continue;
        const float far =
            std::min(place::lengthOf(place - surroundings.submarine.position), kHazeMetres);
        if (far <= farthest) continue;
        farthest = far;
        best = place;
    }
    return best;
}

SchoolGoal::SchoolGoal(const WorldOptions& options,
                       const place::Region& water,
                       std::size_t fish,
                       float lengthMetres)
    : gathering_(options.scene.gathering),
      seed_(options.seed),
      members_(fish),
      water_(water),
      radiusMetres_(gathering_ == config::Gathering::Mill
                        ? surroundings::millRadiusMetres(water, fish, lengthMetres)
                        : behaviour::schoolRadiusMetres(fish)) {
    goal_ = gathering_ == config::Gathering::Mill
                ? surroundings::millGoal(seed_, water_, radiusMetres_, {0})
                : surroundings::Goal{.position = water.centre};
}

void SchoolGoal::moveTo(Tick tick, const motion::MotionStates& states) {
    if (gathering_ == config::Gathering::Mill) {
        goal_ = surroundings::millGoal(seed_, water_, radiusMetres_, tick);
        return;
    }
    if (tick.value % kTicksBetweenMiddles != 0) return;
    // Sums of integers: the same in any order.
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
    std::int64_t count = 0;
    for (std::size_t fish = 0; fish < members_; ++fish) {
        if (motion::isAway(states, fish)) continue;
        x += states.x[fish];
        y += states.y[fish];
        z += states.z[fish];
        ++count;
    }
    if (count == 0) return;
    const auto metres = [&](std::int64_t sum) {
        return static_cast<float>(sum / count) * motion::kPositionUnitMetres;
    };
    goal_.position = {metres(x), metres(y), metres(z)};
}

World::World(const WorldOptions& options)
    : seed_(options.seed),
      adaptation_(options.adaptation),
      columns_(traitsOf(options)),
      surroundings_(surroundings::makeSurroundings(
          options.scene, options.seed, columns_.traits.size(), meanLengthMetres(options))),
      voyage_(surroundings::voyageOf(options.scene, options.seed, surroundings_.obstacles.water)),
      pilot_(surroundings::pilotOf(voyage_, options.scene.eye)),
      grids_(surroundings_.obstacles.water, columns_.traits.size(), surroundings_.food.size()),
      school_(options,
              surroundings_.obstacles.water,
              options.cast.empty() ? 0 : options.cast.front().fish,
              meanLengthMetres(options)),
      pool_(options.threads) {
    if (options.cast.size() > kMostSpecies)
        throw Error("a cast of " + std::to_string(options.cast.size()) +
                    " species: there is room for " + std::to_string(kMostSpecies));
    columns_.wearers.mayBeEaten = options.drawingsMayBeEaten;
    for (const WorldSpecies& species : options.cast) addKind(species, options.cast);
    grids_.know(surroundings_, speciesParameters_);
    meals_ = makeMeals(columns_.traits.size());
    absences_ = makeAbsences(speciesParameters_);
    makeRoomForEvents();
    for (auto* column : {&columns_.advection.x, &columns_.advection.y, &columns_.advection.z})
        column->resize(columns_.traits.size());
    lookFrom(pilot_.vessel, columns_.wearers);
    begin(options);
    live(static_cast<std::uint64_t>(options.scene.livedSeconds *
                                    static_cast<double>(kTicksPerSecond)));
}

// Lets so many ticks pass, rounded down to whole thoughts, before the show begins with tick 0.
void World::live(std::uint64_t ticks) {
    ticks -= ticks % fish::kTicksBetweenThoughts;
    for (unseen_ = ticks; unseen_ > 0; --unseen_) advance();
    columns_.shiftTime(ticks);
    surroundings::shiftTime(surroundings_.food, ticks);
    for (Absence& absence : absences_) absence.until.value -= ticks;
    tick_ = {};
    counts_ = {};
}

void World::addKind(const WorldSpecies& species, const std::vector<WorldSpecies>& cast) {
    assert(species.tables != nullptr);
    const std::size_t first = kinds_.empty() ? 0 : kinds_.back().last;
    const std::size_t last = first + species.fish;
    for (std::size_t at = first; at < last; at += kFishInChunk) {
        chunks_.push_back({kinds_.size(), at, std::min(last, at + kFishInChunk)});
    }
    kinds_.push_back({species.tables, fish::gaitsOf(*species.tables), first, last});
    if (species.drawings > 0)
        columns_.wearers.add({static_cast<std::uint8_t>(kinds_.size() - 1),
                              static_cast<std::uint32_t>(last - species.drawings),
                              static_cast<std::uint32_t>(last)});
    speciesParameters_.push_back(makeSpeciesParameters(
        cast, kinds_.size() - 1, kinds_.back().gaits, surroundings_, first, last));
}

// Places all fish and gives them commands, minds and a first view, so that tick 0 can be shown.
void World::begin(const WorldOptions& options) {
    placeFish(options, school_.goal(), speciesParameters_, surroundings_, columns_.states);
    for (const fish::SpeciesParameters& parameters : speciesParameters_) {
        const Kind& kind = kinds_[parameters.kind];
        fish::startCommands(
            kind.gaits, seed_, kind.first, kind.last, columns_.commands, columns_.memory);
        for (std::uint32_t fish = parameters.first; fish < parameters.last; ++fish) {
            motion::setSpeedBodyLengths(columns_.states, fish, parameters.medium);
            columns_.minds[fish] =
                beginningMind(parameters,
                              options.cast[parameters.kind].start,
                              seed_,
                              fish,
                              static_cast<float>(columns_.traits[fish].lengthMillimetres) * 0.001F);
            columns_.view.kind[fish] = parameters.kind;
        }
        look(kind, kind.first, kind.last, surroundings_.timeOfDay);
    }
    for (const fish::Wearer& wearer : columns_.wearers.fish) {
        motion::setAway(columns_.states, wearer.fish);
        columns_.view.signs[wearer.fish] = fish::kAway;
    }
    grids_.expect(columns_.view, speciesParameters_);
    for (std::size_t fish = 0; fish < columns_.traits.size(); ++fish)
        columns_.courses[fish] = {columns_.view.heading(fish), 1, 0};
}

// Reserves room for the events of a tick, so that thoughts allocate nothing: where a predator
// begins to rush all fish may think at a tick, and each reports one event at most.
void World::makeRoomForEvents() {
    events_.slices.resize((columns_.traits.size() + kSlotsInSlice - 1) / kSlotsInSlice);
    for (behaviour::DeferredEvents& slice : events_.slices) slice.reserve(kSlotsInSlice);
    events_.all.reserve(columns_.traits.size());
    columns_.rushes.reserve(kMostRushes);
}

void World::save(WorldState& state) const {
    state.tick = tick_;
    state.states = columns_.states;
    state.commands = columns_.commands;
    state.minds = columns_.minds;
    state.courses = columns_.courses;
    state.memory = columns_.memory;
    state.signs = columns_.view.signs;
    state.wearers = columns_.wearers.fish;
    state.released = columns_.released.fish;
    state.food = surroundings_.food;
    state.turf = surroundings_.turf.fill;
    state.structures = surroundings_.structures;
    state.hands = surroundings_.hands;
    state.clock = surroundings_.clock;
    state.dayCue = surroundings_.dayCue;
    state.timeOfDay = surroundings_.timeOfDay;
    state.nextDrop = surroundings_.nextDrop;
    state.pilot = pilot_;
    state.goal = school_.goal();
    state.meals = meals_;
    state.absences = absences_;
    state.counts = counts_;
}

void World::restore(const WorldState& state) {
    assert(state.states.size() == columns_.states.size());
    tick_ = state.tick;
    columns_.states = state.states;
    columns_.commands = state.commands;
    columns_.minds = state.minds;
    columns_.courses = state.courses;
    columns_.memory = state.memory;
    columns_.wearers.fish = state.wearers;
    columns_.released.fish = state.released;
    surroundings_.food = state.food;
    surroundings_.turf.fill = state.turf;
    surroundings_.structures = state.structures;
    surroundings_.hands = state.hands;
    surroundings_.clock = state.clock;
    surroundings_.dayCue = state.dayCue;
    surroundings_.timeOfDay = state.timeOfDay;
    surroundings_.daylight = place::daylightAt(surroundings_.climate.day, state.timeOfDay);
    surroundings_.nextDrop = static_cast<std::size_t>(state.nextDrop);
    pilot_ = state.pilot;
    surroundings_.submarine.position = pilot_.vessel.position;
    surroundings_.submarine.velocityMetresPerSecond = pilot_.vessel.velocity;
    lookFrom(pilot_.vessel, columns_.wearers);
    school_.goOnFrom(state.goal);
    meals_ = state.meals;
    absences_ = state.absences;
    counts_ = state.counts;
    for (const Kind& kind : kinds_) look(kind, kind.first, kind.last, state.timeOfDay);
    columns_.view.signs = state.signs;
}

void restore(World& world, std::span<const std::byte> bytes, const std::string& source) {
    WorldState own;
    world.save(own);
    const StateBounds bounds{world.speciesParameters(), world.surroundings()};
    world.restore(decodeState(bytes, own, bounds, source));
}

void World::apply(const WorldInput& input) {
    if (const auto* food = std::get_if<DropFood>(&input))
        surroundings::dropPellets(surroundings_.food,
                                  seed_,
                                  surroundings_.obstacles,
                                  food->position,
                                  food->pellets,
                                  tick_);
    if (const auto* moved = std::get_if<MoveSubmarine>(&input)) {
        pilot_.vessel.position = moved->position;
        pilot_.vessel.velocity = moved->velocityMetresPerSecond;
        showSubmarine();
    }
    const auto* clock = std::get_if<SetClock>(&input);
    if (clock != nullptr && surroundings_.climate.day.followsHall)
        surroundings::setClock(surroundings_, {tick_, clock->timeOfDay, clock->lengthSeconds});
    if (const auto* hands = std::get_if<WallHands>(&input))
        surroundings::holdHands(surroundings_.hands, *hands, tick_);
    if (const auto* drawing = std::get_if<EnterDrawing>(&input))
        enter(waterNow(), *drawing, columns_);
    if (const auto* drawing = std::get_if<LeaveDrawing>(&input)) leave(*drawing, tick_, columns_);
    if (const auto* day = std::get_if<SetDay>(&input))
        surroundings::setDay(surroundings_, day->timeOfDay, ticksIn(day->glideSeconds), tick_);
    if (const auto* cue = std::get_if<ReleaseHunter>(&input)) release(waterNow(), *cue, columns_);
    if (const auto* steered = std::get_if<Steering>(&input))
        surroundings::steer(pilot_, voyage_, *steered, tick_);
}

WaterAtTick World::waterNow() const {
    return {surroundings_, speciesParameters_, seed_, tick_};
}

void World::moveSubmarine() {
    surroundings::advancePilot(
        pilot_, voyage_, school_.goal().position, tick_, fastestWith(columns_, speciesParameters_));
    showSubmarine();
}

// Copies the state of the submarine to where fish perceive it.
void World::showSubmarine() {
    surroundings_.submarine.position = pilot_.vessel.position;
    surroundings_.submarine.velocityMetresPerSecond = pilot_.vessel.velocity;
    surroundings::placeHands(surroundings_.hands, pilot_.vessel, tick_);
    lookFrom(pilot_.vessel, columns_.wearers);
}

void World::advance() {
    school_.moveTo(tick_, columns_.states);
    receive();
    if (unseen_ == 0) moveSubmarine();
    leadWearers(waterNow(), columns_, absences_);
    leadReleased(waterNow(), columns_);
    beginTick();
    swallow();
    findRushes();
    behaviour::rememberPlaces(environment(), surroundings_.structures);
    thinkAll();
    pool_.run(chunks_.size(), [this](std::size_t i) { swim(chunks_[i]); });
    performEvents();
    ++tick_.value;
}

// Advances the surroundings, looks at all fish and rebuilds the grids. The thread that has the
// first part also advances the surroundings, while others look at fish: neither reads what the
// other writes.
void World::beginTick() {
    const double timeOfDay = surroundings_.timeOfDay;
    grids_.rebuild(
        columns_.view,
        surroundings_.food,
        speciesParameters_,
        [this](std::size_t jobs, const auto& job) { pool_.run(jobs, job); },
        [this, timeOfDay](std::size_t first, std::size_t last) {
            if (first == 0) surroundings::advanceSurroundings(surroundings_, tick_, unseen_);
            for (const Kind& kind : kinds_)
                look(kind, std::max(first, kind.first), std::min(last, kind.last), timeOfDay);
        });
}

// Writes the view of fish [first, last) from their motion states and minds, and the time of day of
// the tick before. Headings are computed
// for 256 fish at a time, by vectors.
void World::look(const Kind& kind, std::size_t first, std::size_t last, double timeOfDay) {
    constexpr std::size_t kAtATime = 256;
    std::array<float, kAtATime> x;
    std::array<float, kAtATime> y;
    std::array<float, kAtATime> z;
    for (std::size_t from = first; from < last; from += kAtATime) {
        const std::size_t to = std::min(last, from + kAtATime);
        motion::meanHeadings(
            *kind.tables, columns_.states, from, to, {x.data(), y.data(), z.data()});
        const fish::SpeciesParameters& parameters = speciesParameters_[columns_.view.kind[from]];
        const bool mates = fish::matesAt(parameters, timeOfDay);
        for (std::size_t fish = from; fish < to; ++fish) {
            const std::size_t i = fish - from;
            const float length =
                static_cast<float>(columns_.traits[fish].lengthMillimetres) * 0.001F;
            const float lengthsASecond =
                static_cast<float>(columns_.states.speed[fish]) / motion::kSpeedUnitsPerBodyLength;
            columns_.view.fish[fish] = {
                {static_cast<float>(columns_.states.x[fish]) * motion::kPositionUnitMetres,
                 static_cast<float>(columns_.states.y[fish]) * motion::kPositionUnitMetres,
                 static_cast<float>(columns_.states.z[fish]) * motion::kPositionUnitMetres},
                {x[i], y[i], z[i]},
                lengthsASecond * length,
                length};
            fish::showMood(
                parameters, columns_.minds, static_cast<std::uint32_t>(fish), mates, columns_.view);
            if (motion::isStart(motion::actionOf(columns_.states.segment[fish])))
                columns_.view.signs[fish] |= fish::kStartled;
        }
    }
}

behaviour::Environment World::environment() const {
    return {.view = &columns_.view,
            .grids = &grids_,
            .surroundings = &surroundings_,
            .speciesParameters = speciesParameters_,
            .gathering = school_.gathering(),
            .goal = school_.goal(),
            .schoolRadiusMetres = school_.radiusMetres(),
            .seed = seed_,
            .tick = tick_,
            .adaptation = adaptation_,
            .wearers = columns_.wearers.fish.empty() ? nullptr : &columns_.wearers,
            .released = columns_.released.fish.empty() ? nullptr : &columns_.released};
}

// Thoughts of this tick. Fish think in the order in which they stand in the grid, because
// consecutive thinkers then read the same neighbours. The result does not depend on the order: a
// thought changes nothing that another reads.
void World::thinkAll() {
    const behaviour::SpatialGrid& grid = grids_.fish;
    const behaviour::Environment around = environment();
    pool_.run(events_.slices.size(), [&](std::size_t i) {
        const std::size_t first = std::min(grid.size(), i * kSlotsInSlice);
        const std::size_t last = std::min(grid.size(), first + kSlotsInSlice);
        std::array<std::uint32_t, kSlotsInSlice + kFetchedAhead> thinkers{};
        std::size_t count = 0;
        for (std::size_t slot = first; slot < last; ++slot) {
            // The next slot overwrites a fish that does not think now.
            thinkers[count] = grid.index()[slot];
            count += thinks(thinkers[count]) ? 1 : 0;
        }
        behaviour::DeferredEvents& events = events_.slices[i];
        events.clear();
        for (std::size_t t = 0; t < count; ++t) {
            if (t + kFetchedAhead < count)
                fetch(columns_.minds, columns_.view, columns_.courses, thinkers[t + kFetchedAhead]);
            behaviour::think(around, thinkers[t], columns_.minds, columns_.courses, events);
            columns_.thought[thinkers[t]] = 1;
        }
    });
}

// Every few ticks, and at once where a predator near it has begun to rush.
bool World::thinks(std::uint32_t fish) const {
    const fish::Wearer* const wearer = columns_.wearers.of(fish);
    if (wearer != nullptr && wearer->visit == fish::Visit::Asleep) return false;
    const bool isAlarmed = columns_.view.shows(fish, fish::kAlarmed);
    if (fish::thinksAt(tick_, fish, isAlarmed)) return true;
    return std::ranges::any_of(columns_.rushes, [&](std::uint32_t predator) {
        const std::uint64_t hunts = speciesParameters_[columns_.view.kind[predator]].hunts;
        const glm::vec3 apart = columns_.view.position(fish) - columns_.view.position(predator);
        return (hunts >> columns_.view.kind[fish] & 1U) != 0 &&
               place::dot(apart, apart) < kRushSeenMetres * kRushSeenMetres;
    });
}

// The predators that began to rush at the last tick.
void World::findRushes() {
    columns_.rushes.clear();
    for (const fish::SpeciesParameters& parameters : speciesParameters_) {
        if (parameters.habits.role != config::Role::Predator) continue;
        for (std::uint32_t fish = parameters.first; fish < parameters.last; ++fish) {
            const fish::Mind& mind = columns_.minds[fish];
            if (mind.sinceStage == 0 && mind.thoughtAt + 1 == tick_.value &&
                behaviour::isRushing(mind) && columns_.rushes.size() < kMostRushes)
                columns_.rushes.push_back(fish);
        }
    }
}

// Commands and moves the fish of one chunk; chunks are independent.
void World::swim(const Chunk& chunk) {
    const Kind& own = kinds_[chunk.kind];
    fish::SecondaryController{&own.gaits,
                              &columns_.view,
                              &columns_.courses,
                              &columns_.states,
                              &columns_.thought,
                              seed_,
                              tick_,
                              &columns_.commands,
                              &columns_.memory}
        .run(chunk.first, chunk.last);
    school::Carrier{&surroundings_.obstacles, &surroundings_.current, surroundings_.openCurrent}
        .carry(columns_.traits, columns_.states, chunk.first, chunk.last, columns_.advection);
    motion::MotorStep{own.tables.get(),
                      columns_.traits,
                      &columns_.commands,
                      &columns_.states,
                      chunk.first,
                      chunk.last,
                      &columns_.advection}
        .run();
}

// Applies the events of all slices sorted by fish, so that the result does not depend on the order
// of the grid.
void World::performEvents() {
    events_.all.clear();
    for (const behaviour::DeferredEvents& slice : events_.slices)
        events_.all.insert(events_.all.end(), slice.begin(), slice.end());
    assert(events_.all.size() <= columns_.traits.size());
    std::ranges::sort(events_.all, {}, &fish::DeferredEvent::fish);
    for (const fish::DeferredEvent& event : events_.all) perform(event);
}

// Folds in all that decides how the world goes on and is no function of seed, scene and tick.
std::uint64_t World::hash() const {
    std::uint64_t hash = columns_.hash(tick_);
    for (const Absence& absence : absences_)
        hash = foldedOne(foldedOne(hash, absence.fish), absence.until.value);
    for (const Meals::Swallow& swallow : meals_.swallows)
        hash = foldedOne(foldedOne(foldedOne(hash, swallow.fish), swallow.particle),
                         swallow.ticksLeft);
    return surroundings::foldedPilot(surroundings::foldedSurroundings(hash, surroundings_), pilot_);
}

std::size_t World::bytes() const {
    return grids_.bytes() + columns_.bytes() + meals_.swallows.capacity() * sizeof(Meals::Swallow) +
           absences_.capacity() * sizeof(Absence);
}

void World::records(std::vector<motion::FishRecord>& records) const {
    records.resize(columns_.states.size());
    for (std::size_t fish = 0; fish < columns_.states.size(); ++fish)
        records[fish] = motion::recordOf(columns_.states, fish);
    for (const fish::Wearer& wearer : columns_.wearers.fish)
        records[wearer.fish].skin = wearer.number;
}

std::span<const std::uint32_t> World::placed() const {
    if (columns_.placements.since.value + 1 != tick_.value) return {};
    return columns_.placements.fish;
}

}  // namespace aquarama::world
