// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/vision.h"

#include <algorithm>
#include <array>
#include <utility>

#include <glm/common.hpp>

#include "common/place/place.h"

namespace aquarama::behaviour {

namespace {

// Solid part of the radius of a rock; the rest is growth.
constexpr float kSolidRock = 0.75F;
// Height that no dune exceeds.
constexpr float kHighestSandMetres = -8.0F;
constexpr int kSandSamples = 6;
// Sand rises less than this between the corners of a chart.
constexpr float kBetweenCornersMetres = 0.05F;

// A large body hides what is behind these balls along its middle line; in body lengths.
constexpr std::array kTrunk{0.2F, -0.05F, -0.3F};
constexpr float kTrunkRadius = 0.1F;

// A chart lists for each place the rocks that come within kChartReachMetres of it: those on a line
// stand near one of its places, where these are no farther apart than this.
constexpr float kBetweenPlacesMetres = 2 * place::kChartReachMetres;
// A rock so far outside the box about a line does not hide it: more than rounding can take off.
constexpr float kOutsideRockMetres = 0.01F;

// The box about a line, a little larger: most rocks that a chart lists do not reach into it.
struct BoxAbout {
    glm::vec3 least, most;

    explicit BoxAbout(const SightLine& ray)
        : least(glm::min(ray.from, ray.from + ray.offset) - kOutsideRockMetres),
          most(glm::max(ray.from, ray.from + ray.offset) + kOutsideRockMetres) {}

    // All at once without branches, because which fails cannot be predicted.
    [[nodiscard]] bool meets(glm::vec3 centre, float radius) const {
        return (centre.y + radius > least.y) & (centre.x + radius > least.x) &
               (centre.x - radius < most.x) & (centre.z + radius > least.z) &
               (centre.z - radius < most.z);
    }
};

bool rocksHide(const place::Obstacles& obstacles, const SightLine& ray) {
    const BoxAbout box(ray);
    const auto hides = [&](const place::Rock& rock) {
        const float radius = rock.radiusMetres * kSolidRock;
        return box.meets(rock.centre, radius) && ray.passes(rock.centre, radius);
    };
    const glm::vec2 from{ray.from.x, ray.from.z};
    const glm::vec2 along{ray.offset.x, ray.offset.z};
    const float metres = std::sqrt(along.x * along.x + along.y * along.y);
    const auto parts = static_cast<int>(metres / kBetweenPlacesMetres) + 1;
    for (int part = 0; part < parts; ++part) {
        const float share = (static_cast<float>(part) + 0.5F) / static_cast<float>(parts);
        if (place::anyRockNear(obstacles, from + along * share, box.least.y, hides)) return true;
    }
    return false;
}

// Samples the line; skipped where it stays above all sand.
bool sandHides(const place::Obstacles& obstacles, const SightLine& ray) {
    const float highest =
        std::min(kHighestSandMetres, obstacles.chart.highestSand() + kBetweenCornersMetres);
    if (std::min(ray.from.y, ray.from.y + ray.offset.y) > highest) return false;
    for (int i = 1; i <= kSandSamples; ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(kSandSamples + 1);
        const glm::vec3 at = ray.from + ray.offset * along;
        if (at.y < kHighestSandMetres && at.y < place::floorHeight(obstacles.place, {at.x, at.z}))
            return true;
    }
    return false;
}

bool bodiesHide(const Environment& environment,
                std::uint32_t fish,
                std::uint32_t object,
                const SightLine& ray) {
    const fish::FishView& view = *environment.view;
    // Bodies whose middle is near enough to the middle of the line to be on it.
    const float reach = 0.5F * place::lengthOf(ray.offset) + kLargeBodyMetres;
    const float reachSquared = reach * reach;
    bool hidden = false;
    environment.grids->large.visitAround(
        ray.from + ray.offset * 0.5F, reachSquared, [&](const auto& row) {
            for (const std::uint32_t body : row.index)
                hidden = hidden || (body != fish && body != object && bodyHides(view, body, ray));
        });
    return hidden;
}

constexpr float kTailBehind = 1 - fish::kNoseBodyLengths;

// In body lengths; the other sides come from the habits of the species.
constexpr float kBoxBehind = 0.5F;
// Factor on the box for a replica that is less agile (paper, section 5.2).
constexpr float kEnlarged = 1.5F;
// Factor on the box for the fish that is being avoided already (hysteresis).
constexpr float kHoldOn = 1.25F;
// Body lengths a second: a fish that moves away so fast is no threat.
constexpr float kPartingLengths = 0.1F;
// In formation the box shrinks to the body (Tu 1996, section 5.6), in body lengths. It is tested
// where a schoolmate will be after these seconds if neither turns.
constexpr Box kBody{0.45F, 0.5F, 0.17F, 0.12F};
constexpr float kSoon[] = {0.2F, 0.4F};

// Body axes without roll.
struct Axes {
    glm::vec3 ahead, up, right;
    [[nodiscard]] glm::vec3 of(glm::vec3 v) const {
        return {place::dot(v, ahead), place::dot(v, up), place::dot(v, right)};
    }
};

Axes axesOf(glm::vec3 heading) {
    const glm::vec3 right = place::directionOf({-heading.z, 0, heading.x}, {0, 0, 1});
    const glm::vec3 up{right.y * heading.z - right.z * heading.y,
                       right.z * heading.x - right.x * heading.z,
                       right.x * heading.y - right.y * heading.x};
    return {heading, up, right};
}

Box scaled(const Box& box, float scale) {
    return {box.ahead * scale, box.behind * scale, box.up * scale, box.aside * scale};
}

// Whether a middle line meets the slab between two planes; all along one axis, from the origin.
bool reaches(float at, float extent, float least, float most) {
    const float nose = at + extent * fish::kNoseBodyLengths;
    const float tail = at - extent * kTailBehind;
    return (std::max(nose, tail) >= least) & (std::min(nose, tail) <= most);
}

// The search for the most dangerous fish, and what it compares with.
struct Watch {
    const Environment& environment;
    const fish::SpeciesParameters& parameters;
    const fish::Mind& mind;
    Senses& senses;
    const fish::FishView& view = *environment.view;
    fish::Aim aim = fish::aimOf(mind);
    Axes axes = axesOf(senses.heading);
    glm::vec3 velocity = senses.heading * senses.speed;
    Box box = boxOf();

    [[nodiscard]] Box boxOf() const {
        const float scale =
            senses.length * (environment.adaptation.enlargedRegions ? kEnlarged : 1.0F);
        return {parameters.habits.box.aheadBodyLengths * scale,
                kBoxBehind * senses.length,
                parameters.habits.box.upBodyLengths * scale,
                parameters.habits.box.asideBodyLengths * scale};
    }

    // Whether it courts, charges or cleans another fish.
    [[nodiscard]] bool isWantedNear(std::uint32_t other) const {
        return other == aim.target && (aim.intention == fish::Intention::Mate ||
                                       aim.intention == fish::Intention::Charge ||
                                       aim.intention == fish::Intention::Clean);
    }

    // Whether another fish counts. One that it courts, cleans, hunts or follows it wants near, and
    // its cleaner; from its hunters prey flees instead.
    [[nodiscard]] bool isHeeded(std::uint32_t other) const {
        if (isWantedNear(other)) return false;
        if (aim.intention == fish::Intention::Visit &&
            environment.speciesParameters[view.kind[other]].habits.cleans)
            return false;
        if (other == senses.territory.charger.object) return false;
        std::uint64_t unheeded = parameters.hunts | parameters.shadows;
        if (parameters.habits.role == config::Role::Prey) unheeded |= parameters.huntedBy;
        return (unheeded >> view.kind[other] & 1U) == 0;
    }

    // A fish that is not in formation: the share of its middle line in the box, unless it moves
    // away.
    void heed(std::uint32_t other) {
        if (!isHeeded(other)) return;
        const glm::vec3 offset = view.position(other) - senses.position;
        const float squared = place::dot(offset, offset);
        const float length = view.fish[other].length;
        const float hold =
            other == mind.target && mind.intention == fish::Intention::AvoidFish ? kHoldOn : 1.0F;
        // Quick test: from farther away no part of the other fish is in the box.
        const float reach =
            hold * (std::max(box.ahead, box.behind) + box.aside + box.up) + kTailBehind * length;
        if (squared > reach * reach) return;
        const glm::vec3 drift = view.heading(other) * view.fish[other].speed - velocity;
        const float parting = place::dot(offset, drift);
        if (parting > kPartingLengths * senses.length * std::sqrt(squared)) return;
        note(other, offset, shareOf(view.heading(other) * length, scaled(box, hold), offset));
    }

    // A fish in formation: the share in the body at the times of kSoon.
    void heedSchoolmate(std::uint32_t other) {
        const glm::vec3 offset = view.position(other) - senses.position;
        const glm::vec3 drift = view.heading(other) * view.fish[other].speed - velocity;
        const Box body = scaled(kBody, senses.length);
        const glm::vec3 along = view.heading(other) * view.fish[other].length;
        // Most schoolmates part or pass beside, above or below. That is tested first, by all tests
        // at once without branches, because which one fails cannot be predicted.
        const auto meets = [&](glm::vec3 axis, float least, float most) {
            const float at = place::dot(offset, axis);
            const float moves = place::dot(drift, axis);
            const float extent = place::dot(along, axis);
            return reaches(at + moves * kSoon[0], extent, least, most) |
                   reaches(at + moves * kSoon[1], extent, least, most);
        };
        const bool mayMeet =
            (place::dot(offset, drift) <= 0) & meets(axes.right, -body.aside, body.aside) &
            meets(axes.up, -body.up, body.up) & meets(axes.ahead, -body.behind, body.ahead);
        if (!mayMeet) return;
        float share = 0;
        for (const float soon : kSoon)
            share = std::max(share, shareOf(along, body, offset + drift * soon));
        note(other, offset, share);
    }

    [[nodiscard]] float shareOf(glm::vec3 along, const Box& within, glm::vec3 offset) const {
        const glm::vec3 at = axes.of(offset);
        const glm::vec3 extent = axes.of(along);
        return shareInside(within, at + extent * fish::kNoseBodyLengths, at - extent * kTailBehind);
    }

    // Keeps the fish with the largest share; of equal ones the lower index.
    void note(std::uint32_t other, glm::vec3 offset, float share) {
        const bool worse = share > senses.collisionShare ||
                           (share == senses.collisionShare && other < senses.collision.object);
        if (share <= 0 || !worse) return;
        senses.collision = {other, offset, place::lengthOf(offset)};
        senses.collisionShare = share;
    }
};

void heedLargeBodies(Watch& watch, std::uint32_t fish) {
    // Half of a length that no fish reaches.
    constexpr float kLongestHalfMetres = 1.0F;
    const float reach = std::max(watch.box.ahead, watch.box.behind) + kLongestHalfMetres;
    const float reachSquared = reach * reach;
    const auto heedAll = [&](const SpatialGrid::Candidates& row) {
        for (const std::uint32_t other : row.index)
            if (other != fish) watch.heed(other);
    };
    watch.environment.grids->large.visitAround(watch.senses.position, reachSquared, heedAll);
}

}  // namespace

float conspicuousness(float lengthMetres) {
    return std::clamp(lengthMetres / kLargeBodyMetres, 1.0F, kMostConspicuous);
}

float sightMetres(const fish::SpeciesParameters& parameters,
                  float lengthMetres,
                  float conspicuous,
                  float clarityMetres) {
    return std::min(parameters.habits.visionBodyLengths * lengthMetres * conspicuous,
                    clarityMetres);
}

bool SightLine::passes(glm::vec3 centre, float radius) const {
    const glm::vec3 to = centre - from;
    const float squared = std::max(place::dot(offset, offset), 1.0e-6F);
    const float along = std::clamp(place::dot(to, offset) / squared, 0.0F, 1.0F);
    const glm::vec3 miss = to - offset * along;
    return place::dot(miss, miss) < radius * radius;
}

bool terrainHides(const place::Obstacles& obstacles, const SightLine& ray) {
    return rocksHide(obstacles, ray) || sandHides(obstacles, ray);
}

bool bodyHides(const fish::FishView& view, std::uint32_t body, const SightLine& ray) {
    const glm::vec3 middle = view.position(body);
    const float length = view.fish[body].length;
    if (!ray.passes(middle, length)) return false;
    for (const float place : kTrunk)
        if (ray.passes(middle + view.heading(body) * (place * length), kTrunkRadius * length))
            return true;
    return false;
}

bool isHidden(const Environment& environment,
              std::uint32_t fish,
              std::uint32_t object,
              const SightLine& ray) {
    return terrainHides(environment.surroundings->obstacles, ray) ||
           bodiesHide(environment, fish, object, ray);
}

float shareInside(const Box& box, glm::vec3 nose, glm::vec3 tail) {
    if (std::min(nose.x, tail.x) > box.ahead || std::max(nose.x, tail.x) < -box.behind) return 0;
    const glm::vec3 along = tail - nose;
    float enters = 0;
    float leaves = 1;
    // Clips the line to the slab of one axis: it is inside for [enters, leaves] of its length.
    const auto clip = [&](float from, float step, float least, float most) {
        if (std::abs(step) < 1.0e-6F) {
            if (from < least || from > most) leaves = -1;
            return;
        }
        float first = (least - from) / step;
        float last = (most - from) / step;
        if (first > last) std::swap(first, last);
        enters = std::max(enters, first);
        leaves = std::min(leaves, last);
    };
    clip(nose.x, along.x, -box.behind, box.ahead);
    clip(nose.y, along.y, -box.up, box.up);
    clip(nose.z, along.z, -box.aside, box.aside);
    return std::max(0.0F, leaves - enters);
}

void feelCollision(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   const fish::Mind& mind,
                   Senses& senses) {
    Watch watch{environment, parameters, mind, senses};
    // Fish that like to school tolerate schoolmates near, also while they feed among others; so do
    // those that graze.
    const bool bearsMates = (parameters.habits.role == config::Role::Prey &&
                             (mind.likes & fish::kLikesSchooling) != 0) ||
                            fish::aimOf(mind).intention == fish::Intention::Graze;
    for (std::size_t i = 0; i < senses.schoolmates.count; ++i) {
        const std::uint32_t other = senses.schoolmates.fish[i];
        if (bearsMates)
            watch.heedSchoolmate(other);
        else
            watch.heed(other);
    }
    for (std::size_t i = 0; i < senses.others.count; ++i) watch.heed(senses.others.fish[i]);
    heedLargeBodies(watch, fish);
}

}  // namespace aquarama::behaviour
