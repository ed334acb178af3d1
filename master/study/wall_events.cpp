// SPDX-License-Identifier: Apache-2.0
#include "master/study/wall_events.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include <glm/geometric.hpp>

#include "master/behaviour/patches.h"
#include "master/behaviour/routines.h"
#include "master/study/occupation.h"

namespace aquarama::study {

namespace {

// One function for each kind of event that fish make: whether a fish takes part by what it does.

bool flees(const Deed& deed) {
    return deed.intention == fish::Intention::Escape && !deed.isExpelled;
}

bool dives(const Deed& deed) {
    return deed.aim == fish::Intention::Hide;
}

bool charges(const Deed& deed) {
    return deed.aim == fish::Intention::Charge;
}

// That of a dive or a charge belongs to it.
bool makesFastStart(const Deed& deed) {
    return deed.isStartled && !dives(deed) && !charges(deed) && !deed.isExpelled;
}

bool hunts(const Deed& deed) {
    return deed.isPredator && deed.aim == fish::Intention::Eat;
}

bool courts(const Deed& deed) {
    return deed.aim == fish::Intention::Mate;
}

bool goesForFood(const Deed& deed) {
    return !deed.isPredator && deed.aim == fish::Intention::Eat;
}

bool inspectsAClient(const Deed& deed) {
    return deed.inspects;
}

bool stopsToGraze(const Deed& deed) {
    return deed.stopsToGraze;
}

bool shadowsAnother(const Deed& deed) {
    return deed.shadows;
}

// A kind of event.
struct EventKind {
    WallEvent kind;
    const char* name;
    // Null for what noteSchools() and noteClouds() note.
    bool (*takesPart)(const Deed& deed);
    float nearMetres = kNearMetres;
    // So many fish that begin in so many seconds make an event; it goes on while one of them does
    // it.
    std::size_t leastFish = 1;
    double withinSeconds = kOneEventSeconds;
    // Where an event of this kind is near, which is before it in the table, it belongs to that.
    WallEvent partOf = kind;
};

// In the order of WallEvent.
constexpr std::array<EventKind, kWallEvents> kKinds{{
    {WallEvent::Flight, "flight", flees, kNearInFlightMetres},
    {WallEvent::FastStart,
     "fast start",
     makesFastStart,
     kNearInFlightMetres,
     1,
     kOneEventSeconds,
     WallEvent::Flight},
    {WallEvent::Chase, "chase", hunts},
    {WallEvent::Courtship, "courtship", courts},
    {WallEvent::FeedingRush, "feeding rush", goesForFood, kNearMetres, kFishOfARush, 1},
    {WallEvent::Split, "split of a school", nullptr},
    {WallEvent::Meeting, "meeting of a school", nullptr},
    {WallEvent::Dive, "dive", dives, kNearMetres, kFishOfADive},
    {WallEvent::Cleaning, "cleaning", inspectsAClient},
    {WallEvent::GrazeStop, "graze stop", stopsToGraze},
    {WallEvent::Charge, "charge", charges},
    {WallEvent::Shadowing, "shadowing", shadowsAnother},
    {WallEvent::Flip, "flip of a cloud", nullptr},
}};

constexpr bool areInOrder() {
    for (std::size_t i = 0; i < kKinds.size(); ++i)
        if (kKinds.at(i).kind != static_cast<WallEvent>(i)) return false;
    return true;
}
static_assert(areInOrder());

std::uint64_t ticksOf(double seconds) {
    return static_cast<std::uint64_t>(seconds * kTicksPerSecond);
}

// Whether a fish flees from one that does not hunt it. Of a hunter out of its sight it knows
// nothing.
bool isExpelled(const WatchedFish& now, const fish::Mind& mind, std::uint32_t fish) {
    if (mind.intention != fish::Intention::Escape || mind.target == fish::kNobody) return false;
    const std::uint64_t hunters = now.species[now.view.kind[fish]].huntedBy;
    return (hunters >> now.view.kind[mind.target] & 1U) == 0;
}

// Whether a fish leads a shoal at its patch, or is at one of its round.
bool leadsAtAPatch(const WatchedFish& now, const fish::Mind& mind, std::uint32_t fish) {
    const fish::SpeciesParameters& species = now.species[now.view.kind[fish]];
    if (fish::aimOf(mind).intention != fish::Intention::Graze) return false;
    const bool isThere = behaviour::isAtPatch(static_cast<behaviour::GrazeStage>(mind.stage));
    if (!isThere || behaviour::leaderOf(now.view, species, fish) != fish) return false;
    const fish::Household shoal = fish::householdOf(species, fish);
    return species.habits.graze->manner == config::GrazeManner::Loop ||
           shoal.last - shoal.first >= kFishOfAShoal;
}

Deed deedOf(const WatchedFish& now, std::uint32_t fish) {
    const fish::Mind& mind = now.minds[fish];
    // Who is away does nothing.
    if (now.view.shows(fish, fish::kAway)) return {};
    const StudiedFish studied{now.view, now.minds, now.species};
    const fish::Intention aim = fish::aimOf(mind).intention;
    return {.intention = mind.intention,
            .aim = aim,
            .isPredator = now.species[now.view.kind[fish]].habits.role == config::Role::Predator,
            .isStartled = now.view.shows(fish, fish::kStartled),
            .isExpelled = isExpelled(now, mind, fish),
            .inspects = inspects(studied, fish),
            .stopsToGraze = leadsAtAPatch(now, mind, fish),
            .shadows = aim == fish::Intention::Wander && ridesBesideAnother(studied, fish)};
}

// By fish.
std::vector<Deed> deedsOf(const WatchedFish& now) {
    std::vector<Deed> deeds(now.view.size());
    for (std::uint32_t fish = 0; fish < deeds.size(); ++fish) deeds[fish] = deedOf(now, fish);
    return deeds;
}

// A cloud faces a way where the mean of the headings of those that hover, in plan, is so long; so
// many must hover.
constexpr float kFaces = 0.5F;
constexpr std::size_t kFewestOfCloud = 5;

// The way that a cloud faces, a unit vector; 0 where it faces none.
glm::vec3 facingOf(const WatchedFish& now, std::uint32_t first, std::uint32_t last) {
    glm::vec3 sum{};
    std::size_t there = 0;
    for (std::uint32_t fish = first; fish < last; ++fish) {
        if (now.view.shows(fish, fish::kAway) ||
            now.minds[fish].intention != fish::Intention::Hover)
            continue;
        const glm::vec3 heading = now.view.heading(fish);
        sum += glm::vec3{heading.x, 0, heading.z};
        ++there;
    }
    const float length = glm::length(sum);
    return there >= kFewestOfCloud && length > kFaces * static_cast<float>(there) ? sum / length
                                                                                  : glm::vec3{};
}

// Parts of a school: a number of parts holds once it has lasted so long.
constexpr std::uint32_t kSecondsToSettle = 3;
constexpr std::size_t kLeastPart = 3;
constexpr std::size_t kShareOfPart = 10;  // a part holds one of so many fish at least
// A split or meeting is in view where so many of its species are; a flip where so many of its
// cloud are.
constexpr std::size_t kLeastInView = 5;

// Whether more than half of the fish swim in a school.
bool isSchool(const fish::FishView& view, const fish::SpeciesParameters& species) {
    std::size_t there = 0;
    std::size_t schooling = 0;
    for (std::size_t fish = species.first; fish < species.last; ++fish) {
        if (view.shows(fish, fish::kAway)) continue;
        ++there;
        schooling += view.shows(fish, fish::kSchooling) ? 1 : 0;
    }
    return 2 * schooling > there;
}

// What a school does whose number of parts changes; nothing where it comes or goes as a whole.
std::optional<WallEvent> changeOf(std::uint32_t before, std::uint32_t parts) {
    if (before == 0 || parts == 0) return {};
    return parts > before ? WallEvent::Split : WallEvent::Meeting;
}

bool isInView(std::uint32_t first, std::uint32_t last, const EventWatch::Sees& sees) {
    std::size_t inView = 0;
    for (std::uint32_t fish = first; fish < last; ++fish)
        if (sees(fish) && ++inView == kLeastInView) return true;
    return false;
}

}  // namespace

const char* nameOf(WallEvent kind) {
    return kKinds.at(static_cast<std::size_t>(kind)).name;
}

WatchedFish watchedFishOf(const world::World& world) {
    return {world.view(), world.minds(), world.speciesParameters(), world.tick()};
}

std::uint32_t partsOf([[maybe_unused]] const fish::FishView& view,
                      std::size_t first,
                      std::size_t last,
                      std::span<const std::uint32_t> groups) {
    assert(groups.size() == view.size() && first <= last && last <= groups.size());
    // A group is named by its lowest index, so it is among these.
    std::vector<std::size_t> sizes(last - first);
    std::size_t there = 0;
    for (std::size_t fish = first; fish < last; ++fish) {
        if (groups[fish] == fish::kNobody) continue;
        ++sizes[groups[fish] - first];
        ++there;
    }
    return static_cast<std::uint32_t>(std::ranges::count_if(sizes, [&](std::size_t size) {
        return size >= kLeastPart && size * kShareOfPart >= there;
    }));
}

EventWatch::EventWatch(const WatchedFish& now)
    : lastLook_(now.tick), before_(deedsOf(now)), parts_(now.species.size()) {
    for (const fish::SpeciesParameters& species : now.species) {
        if (!species.habits.cloud) continue;
        for (std::uint32_t fish = species.first; fish < species.last;) {
            const fish::Household cloud = fish::householdOf(species, fish);
            clouds_.push_back({cloud.first, cloud.last});
            fish = cloud.last;
        }
    }
}

void EventWatch::note(const WatchedFish& now, const Sees& sees) {
    assert(now.view.size() == before_.size());
    std::vector<Deed> deeds = deedsOf(now);
    // By kind, since one kind may be part of another that is before it in the table.
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
        const auto takesPart = kKinds.at(kind).takesPart;
        if (takesPart == nullptr) continue;
        follow(now, kind, deeds);
        for (std::uint32_t fish = 0; fish < deeds.size(); ++fish)
            if (takesPart(deeds[fish]) && !takesPart(before_[fish]))
                begin(kind, {fish, now.view.position(fish), now.tick, now.tick, sees(fish)});
    }
    before_ = std::move(deeds);
    lastLook_ = now.tick;
}

// Follows who goes on, and forgets who ended too long ago to make an event with one that begins
// now.
void EventWatch::follow(const WatchedFish& now, std::size_t kind, const std::vector<Deed>& deeds) {
    for (Actor& actor : actors_.at(kind)) {
        if (!kKinds.at(kind).takesPart(deeds[actor.fish]) || actor.seen < lastLook_) continue;
        actor.place = now.view.position(actor.fish);
        actor.seen = now.tick;
    }
    std::erase_if(actors_.at(kind), [&](const Actor& actor) {
        return actor.seen.value + ticksOf(kOneEventSeconds) < now.tick.value;
    });
}

std::vector<EventWatch::Actor*> EventWatch::near(std::size_t kind, const Actor& actor) {
    const float reach = kKinds.at(kind).nearMetres;
    std::vector<Actor*> near;
    for (Actor& other : actors_.at(kind))
        if (glm::distance(other.place, actor.place) < reach) near.push_back(&other);
    return near;
}

// Adds a fish to the event near it; or makes one of it and those near it, if they are enough.
void EventWatch::begin(std::size_t kind, Actor actor) {
    const EventKind& of = kKinds.at(kind);
    std::vector<Actor*> alike = near(kind, actor);
    std::vector<Actor*> company = alike;
    if (of.partOf != of.kind)
        std::ranges::copy(near(static_cast<std::size_t>(of.partOf), actor),
                          std::back_inserter(company));
    std::erase_if(alike, [&](const Actor* other) {
        return other->began.value + ticksOf(of.withinSeconds) < actor.began.value;
    });
    const auto belongs =
        std::ranges::find_if(company, [](const Actor* other) { return other->event != kNoEvent; });
    if (belongs != company.end()) {
        actor.event = (*belongs)->event;
    } else if (alike.size() + 1 >= of.leastFish) {
        actor.event = events_.size();
        events_.push_back({of.kind, actor.began});
        for (Actor* other : alike) {
            other->event = actor.event;
            events_.back().isInView |= other->isInView;
        }
    }
    if (actor.event != kNoEvent) events_[actor.event].isInView |= actor.isInView;
    actors_.at(kind).push_back(actor);
}

bool EventWatch::Parts::settlesAt(std::uint32_t count) {
    seconds = count == other ? seconds + 1 : 1;
    other = count;
    return count != settled && seconds >= kSecondsToSettle;
}

void EventWatch::noteSchools(const WatchedFish& now,
                             std::span<const std::uint32_t> groups,
                             const Sees& sees) {
    for (std::size_t kind = 0; kind < parts_.size(); ++kind) {
        const fish::SpeciesParameters& species = now.species[kind];
        Parts& parts = parts_[kind];
        const std::uint32_t count = partsOf(now.view, species.first, species.last, groups);
        if (!parts.settlesAt(count)) continue;
        const std::optional<WallEvent> change = changeOf(parts.settled, count);
        if (change && isSchool(now.view, species))
            events_.push_back({*change, now.tick, isInView(species.first, species.last, sees)});
        parts.settled = count;
    }
}

void EventWatch::noteClouds(const WatchedFish& now, const Sees& sees) {
    for (Cloud& cloud : clouds_) {
        const glm::vec3 facing = facingOf(now, cloud.first, cloud.last);
        const bool isFirst = cloud.facing == glm::vec3{};
        const bool isOther = facing != glm::vec3{} && glm::dot(facing, cloud.facing) < 0;
        cloud.seconds = isOther ? cloud.seconds + 1 : 0;
        if (isFirst) cloud.facing = facing;
        if (cloud.seconds < kSecondsToSettle) continue;
        events_.push_back({WallEvent::Flip, now.tick, isInView(cloud.first, cloud.last, sees)});
        cloud.facing = facing;
        cloud.seconds = 0;
    }
}

}  // namespace aquarama::study
