// SPDX-License-Identifier: Apache-2.0
#include "common/place/sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "common/base/random_streams.h"
#include "common/place/reefs.h"

namespace aquarama::place {

namespace {

// What a kind of site asks of its place: limits of the height of the normal, and of its size.
struct Demand {
    float leastUp, mostUp;
    float leastMetres, mostMetres;
};
// In the order of SiteKind.
constexpr std::array<Demand, config::kSiteKinds> kDemands{
    Demand{0.55F, 0.97F, 0.28F, 0.40F},   // anemone
    Demand{0.45F, 1.00F, 0.32F, 0.60F},   // branching coral
    Demand{-0.15F, 0.25F, 0.35F, 0.60F},  // ledge
    Demand{-0.10F, 0.55F, 0.14F, 0.30F},  // hole
    Demand{0.30F, 1.00F, 0.20F, 0.40F},   // turf
    Demand{0.80F, 1.00F, 0.30F, 0.40F},   // cleaning
};

// The middle of a site, from that of its boulder, in radii: the worn surface is mostly within.
constexpr float kSurface = 0.85F;
// A site is at least this far from the sand, from another boulder in its radii, and from other
// sites.
constexpr float kOverSandMetres = 0.12F;
constexpr float kClearRadii = 0.95F;
constexpr float kApartMetres = 0.3F;
// Places drawn for a site, and how many of the fitting ones are compared.
constexpr std::uint32_t kTries = 400;
constexpr int kCompared = 10;

// Fish that graze turn back nearer than this to the borders of their water.
constexpr float kBorderMetres = 1.1F;
constexpr float kBottomMetres = 0.3F;

bool isIn(const Region& water, glm::vec3 place) {
    const glm::vec3 from = place - water.centre;
    return std::abs(from.x) < water.halfExtent.x && std::abs(from.z) < water.halfExtent.z &&
           from.y < water.halfExtent.y;
}

// A direction of the unit sphere by rejection; no square root but one.
glm::vec3 directionDrawn(std::uint32_t hash) {
    glm::vec3 drawn{0, 1, 0};
    for (std::uint32_t i = 0; i < 8; ++i) {
        drawn = {signedUnitOf(hashOf(hash, 3 * i)),
                 signedUnitOf(hashOf(hash, 3 * i + 1)),
                 signedUnitOf(hashOf(hash, 3 * i + 2))};
        if (dot(drawn, drawn) <= 1) break;
    }
    return directionOf(drawn, {0, 1, 0});
}

// The sites of one place as they are added.
class Settling {
  public:
    explicit Settling(const PlaceKey& place) : place_(place), rocks_(rocksOf(place)) {
        for (const Rock& rock : rocks_) {
            if (!reachesInto(place.settled, rock)) continue;
            hosts_.push_back(rock);
            area_ += rock.radiusMetres * rock.radiusMetres;
        }
    }

    [[nodiscard]] std::vector<Site> take() && { return std::move(sites_); }

    // The site at a place in plan: on the boulder that is highest there, else on the nearest one.
    void settleAt(config::SiteKind kind, glm::vec2 xz, std::uint32_t seed) {
        const Rock* host = nullptr;
        float best = -std::numeric_limits<float>::infinity();
        for (const Rock& rock : rocks_) {
            const glm::vec2 from{xz.x - rock.centre.x, xz.y - rock.centre.z};
            const float squared = from.x * from.x + from.y * from.y;
            const float within = rock.radiusMetres * rock.radiusMetres - squared;
            // Under the place the height of its top; elsewhere far below any, by the distance.
            const float height = within > 0 ? rock.centre.y + std::sqrt(within)
                                            : -1.0e3F - std::sqrt(squared) + rock.radiusMetres;
            if (height <= best) continue;
            best = height;
            host = &rock;
        }
        if (host == nullptr) return;
        const glm::vec2 from{xz.x - host->centre.x, xz.y - host->centre.z};
        const float up = std::sqrt(std::max(
            0.0F, host->radiusMetres * host->radiusMetres - from.x * from.x - from.y * from.y));
        add(kind, *host, directionOf({from.x, up, from.y}, {0, 1, 0}), seed);
    }

    // One more site of a kind: of some places that fit the one farthest from others of its kind.
    void settle(config::SiteKind kind, std::uint32_t seed) {
        const Rock* host = nullptr;
        glm::vec3 normal{};
        float farthest = -1;
        int compared = 0;
        for (std::uint32_t i = 0; i < kTries && compared < kCompared; ++i) {
            const std::uint32_t own = hashOf(seed, i);
            const Rock* rock = drawnHost(own);
            if (rock == nullptr) return;
            const glm::vec3 direction = directionDrawn(hashOf(own, 1));
            if (!fits(kind, *rock, direction)) continue;
            ++compared;
            const float far = distanceToKind(kind, placeOn(*rock, direction));
            if (far <= farthest) continue;
            farthest = far;
            host = rock;
            normal = direction;
        }
        if (host != nullptr) add(kind, *host, normal, seed);
    }

  private:
    [[nodiscard]] static glm::vec3 placeOn(const Rock& rock, glm::vec3 direction) {
        return rock.centre + direction * (kSurface * rock.radiusMetres);
    }

    // A boulder drawn by its surface; null where there is none.
    [[nodiscard]] const Rock* drawnHost(std::uint32_t hash) const {
        float left = unitOf(hash) * area_;
        for (const Rock& rock : hosts_) {
            left -= rock.radiusMetres * rock.radiusMetres;
            if (left <= 0) return &rock;
        }
        return hosts_.empty() ? nullptr : &hosts_.back();
    }

    [[nodiscard]] bool fits(config::SiteKind kind, const Rock& rock, glm::vec3 direction) const {
        const Demand& demand = kDemands.at(static_cast<std::size_t>(kind));
        if (direction.y < demand.leastUp || direction.y > demand.mostUp) return false;
        const glm::vec3 place = placeOn(rock, direction);
        return isWhereKindLies(kind, place) && isFree(rock, place);
    }

    // Whether a place is in the settled water and over the sand, and turf where fish graze.
    [[nodiscard]] bool isWhereKindLies(config::SiteKind kind, glm::vec3 place) const {
        if (!isIn(place_.settled, place)) return false;
        if (kind == config::SiteKind::Turf && !isGrazed(place_.settled, place)) return false;
        return place.y >= floorHeight(place_, {place.x, place.z}) + kOverSandMetres;
    }

    // Whether no other boulder buries a place on a boulder, and no site is near.
    [[nodiscard]] bool isFree(const Rock& rock, glm::vec3 place) const {
        const bool buried = std::ranges::any_of(rocks_, [&](const Rock& other) {
            return other.seed != rock.seed &&
                   lengthOf(other.centre - place) < kClearRadii * other.radiusMetres;
        });
        return !buried && std::ranges::none_of(sites_, [&](const Site& other) {
            return lengthOf(other.place - place) < kApartMetres;
        });
    }

    [[nodiscard]] float distanceToKind(config::SiteKind kind, glm::vec3 place) const {
        float nearest = std::numeric_limits<float>::infinity();
        for (const Site& other : sites_)
            if (other.kind == kind) nearest = std::min(nearest, lengthOf(other.place - place));
        return nearest;
    }

    void add(config::SiteKind kind, const Rock& rock, glm::vec3 normal, std::uint32_t seed) {
        const Demand& demand = kDemands.at(static_cast<std::size_t>(kind));
        const float size =
            demand.leastMetres + (demand.mostMetres - demand.leastMetres) * unitOf(hashOf(seed, 7));
        sites_.push_back({kind, placeOn(rock, normal), normal, size, seed, rock.seed});
    }

    const PlaceKey& place_;
    std::vector<Rock> rocks_;
    std::vector<Rock> hosts_;  // that reach into the settled water
    float area_ = 0;           // of all hosts, squared radii
    std::vector<Site> sites_;
};

}  // namespace

bool isGrazed(const Region& water, glm::vec3 place) {
    const glm::vec3 from = place - water.centre;
    return std::abs(from.x) < water.halfExtent.x - kBorderMetres &&
           std::abs(from.z) < water.halfExtent.z - kBorderMetres &&
           from.y < water.halfExtent.y - kBorderMetres &&
           from.y > kBottomMetres - water.halfExtent.y;
}

std::vector<Site> sitesOf(const PlaceKey& place) {
    if (place.sites.empty()) return {};
    const PlaceKey first = firstReefOf(place);
    Settling settling(first);
    const std::uint32_t seed = hashOf(place.seed, Stream::Sites);
    for (std::uint32_t group = 0; group < place.sites.size(); ++group) {
        const config::SiteGroup& sites = place.sites[group];
        const std::uint32_t own = hashOf(seed, group);
        for (std::uint32_t i = 0; i < sites.number; ++i)
            sites.xz ? settling.settleAt(sites.kind, *sites.xz, hashOf(own, i))
                     : settling.settle(sites.kind, hashOf(own, i));
    }
    return inAllReefs(place, std::move(settling).take());
}

}  // namespace aquarama::place
