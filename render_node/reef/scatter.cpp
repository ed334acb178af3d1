// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/scatter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/place/sites.h"
#include "render_node/reef/angles.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

namespace {

// Where a form grows, how large it becomes, and how it stands.
struct Way {
    Form form;
    // Weights on surfaces that face up, sideways and down.
    float above, aside, below;
    // Limits of its size, metres.
    float least, most;
    // 0: along the rock's normal, 1: towards the light.
    float upright;
    // Share of the swell that its top follows.
    float sway;
};
constexpr std::array kWays{
    Way{Form::Staghorn, 3.0F, 0.6F, 0.0F, 0.22F, 0.75F, 0.7F, 0.0F},
    Way{Form::Bush, 4.0F, 2.0F, 0.0F, 0.12F, 0.40F, 0.4F, 0.0F},
    Way{Form::Fingers, 2.2F, 1.2F, 0.0F, 0.12F, 0.42F, 0.6F, 0.0F},
    Way{Form::Table, 2.4F, 1.0F, 0.0F, 0.24F, 0.85F, 0.9F, 0.0F},
    Way{Form::Brain, 1.4F, 0.15F, 0.0F, 0.10F, 0.40F, 0.7F, 0.0F},
    Way{Form::Lobes, 2.0F, 0.7F, 0.0F, 0.16F, 0.58F, 0.6F, 0.0F},
    Way{Form::Leaves, 2.0F, 2.4F, 0.0F, 0.20F, 0.60F, 0.5F, 0.0F},
    Way{Form::Crust, 0.8F, 1.2F, 2.0F, 0.08F, 0.24F, 0.0F, 0.0F},
    Way{Form::Fan, 1.0F, 3.0F, 0.3F, 0.28F, 0.95F, 0.5F, 0.05F},
    Way{Form::Whips, 0.5F, 0.5F, 0.0F, 0.45F, 1.20F, 0.8F, 0.10F},
    Way{Form::Tubes, 0.6F, 1.0F, 0.6F, 0.22F, 0.60F, 0.6F, 0.0F},
    Way{Form::Barrel, 0.4F, 0.2F, 0.0F, 0.35F, 0.85F, 0.8F, 0.0F},
    Way{Form::Leather, 1.6F, 0.8F, 0.0F, 0.18F, 0.50F, 0.5F, 0.03F},
    Way{Form::SoftTree, 0.3F, 0.9F, 2.0F, 0.18F, 0.50F, 0.2F, 0.05F},
    Way{Form::Anemone, 0.30F, 0.10F, 0.0F, 0.20F, 0.40F, 0.4F, 0.16F},
    Way{Form::Feathers, 0.35F, 0.3F, 0.0F, 0.16F, 0.30F, 0.5F, 0.10F},
};
// Turf fills the rest of the rock.
constexpr Way kTurfPatch{Form::Turf, 1.0F, 1.0F, 1.0F, 0.06F, 0.17F, 0.3F, 0.16F};

// A place on a rock or on the sand, world frame, with its unit normal.
struct Spot {
    glm::vec3 place{};
    glm::vec3 normal{};
};

// What already grows on a rock, for the test of distance.
struct Planted {
    glm::vec3 place{};
    float size = 0.0F;
};

// All that is needed to choose the instances of one rock. rock and stone are null for the open
// sand.
struct Bed {
    const place::PlaceKey* place;
    const place::Rock* rock;
    // As rockBed() has it.
    const Mesh* stone;
    glm::quat turn;
    // Rocks near enough to touch or shade it.
    std::vector<place::Rock> others;
};

// Shape and turn of a rock follow from its seed.
std::size_t shapeOf(const place::Rock& rock) {
    return hashOf(rock.seed, 31) % kRockShapes;
}

glm::quat turnOf(const place::Rock& rock) {
    return glm::angleAxis(kTwoPi * unitOf(hashOf(rock.seed, 32)), glm::vec3{0, 1, 0});
}

glm::vec4 packed(const glm::quat& turn) {
    return {turn.x, turn.y, turn.z, turn.w};
}

// A random vertex of the rock, in the world.
Spot spotOn(const Bed& bed, Dice& dice) {
    assert(bed.rock != nullptr);
    assert(bed.stone != nullptr);
    assert(!bed.stone->vertices.empty());
    const auto count = static_cast<float>(bed.stone->vertices.size());
    const SolidVertex& vertex = bed.stone->vertices[static_cast<std::size_t>(dice.unit() * count)];
    return {bed.rock->centre + bed.turn * (vertex.position * bed.rock->radiusMetres),
            glm::normalize(bed.turn * glm::vec3(vertex.normal))};
}

// Whether a place is below the sand or inside another rock.
bool isBuried(const Bed& bed, glm::vec3 place) {
    if (place.y < place::floorHeight(*bed.place, {place.x, place.z}) + 0.04F) return true;
    return std::ranges::any_of(bed.others, [&](const place::Rock& other) {
        return glm::distance(other.centre, place) < 0.72F * other.radiusMetres;
    });
}

// Whether something of this size would stand too close to its neighbours. Linear in what grows on
// the rock.
bool isCrowded(std::span<const Planted> planted, glm::vec3 place, float size) {
    return std::ranges::any_of(planted, [&](const Planted& other) {
        return glm::distance(other.place, place) < 0.55F * (other.size + size);
    });
}

// A number for the patch that contains a place. Patches are cells of this many metres with bent
// borders; in each, two forms and one palette dominate.
std::uint32_t patchAt(const place::PlaceKey& place, glm::vec3 at, float metres) {
    const glm::vec3 bent =
        at / metres + 0.45F * glm::vec3{solidNoise(place.seed, at / metres * 1.9F),
                                        0,
                                        solidNoise(place.seed ^ 9U, at / metres * 1.9F)};
    const glm::ivec3 cell{glm::floor(bent)};
    const std::uint32_t column = hashOf(place.seed, static_cast<std::uint32_t>(cell.x));
    return hashOf(column, static_cast<std::uint32_t>(cell.z));
}

// The probability that a spot is settled: higher where it faces the light, low on patches that stay
// bare.
float coverAt(const place::PlaceKey& place, const Spot& spot) {
    const float light = glm::smoothstep(-0.5F, 0.7F, spot.normal.y);
    const float luck = solidNoise(place.seed ^ 0x77U, spot.place * 0.9F);
    return glm::mix(0.12F, 1.0F, light) *
           glm::mix(0.25F, 1.0F, glm::smoothstep(-0.35F, 0.25F, luck));
}

// A form for a spot, chosen by weight. up: y of the normal. The two forms of the patch have 6 and
// 10 times their weight; the second is always a hard coral.
const Way& wayFor(float up, std::uint32_t patch, Dice& dice) {
    const std::size_t first = patch % kWays.size();
    // One of the first eight forms, the hard corals.
    const std::size_t second = hashOf(patch) % 8;
    const auto weightOf = [&](std::size_t i) {
        const Way& way = kWays.at(i);
        const float weight = up > 0.45F ? way.above : up > -0.25F ? way.aside : way.below;
        return weight * (i == first ? 6.0F : i == second ? 10.0F : 1.0F);
    };
    float sum = 0.0F;
    for (std::size_t i = 0; i < kWays.size(); ++i) sum += weightOf(i);
    float pick = dice.unit() * sum;
    for (std::size_t i = 0; i < kWays.size(); ++i) {
        pick -= weightOf(i);
        if (pick <= 0.0F) return kWays.at(i);
    }
    return kWays.front();
}

// The rotation of an instance: fans stand across the swell, all others are turned at random.
glm::quat stance(const Way& way, glm::vec3 normal, Dice& dice) {
    const glm::vec3 up =
        glm::normalize(glm::mix(normal, glm::vec3{0, 1, 0}, way.upright) +
                       0.12F * glm::vec3{dice.between(-1, 1), 0, dice.between(-1, 1)});
    if (way.form != Form::Fan) return glm::quat_cast(frameAbout(up, kTwoPi * dice.unit()));
    const glm::vec3 swell = glm::normalize(glm::vec3{0.50F + dice.between(-0.5F, 0.5F), 0, 0.86F});
    const glm::vec3 x = glm::normalize(glm::cross(up, swell));
    return glm::quat_cast(glm::mat3{x, up, glm::cross(x, up)});
}

// An instance without its spot. size: scale, metres; turn: rotation from its own frame to the
// world.
struct Placement {
    Form form;
    float size;
    glm::quat turn;
    glm::vec4 tintAndSway;
};

// Fills in an instance; its occlusion is that of a point just above the spot.
Instance instanceOf(const place::PlaceKey& place,
                    std::span<const place::Rock> rocks,
                    const Spot& spot,
                    const Placement& placement,
                    Dice& dice) {
    const int shape = static_cast<int>(dice.unit() * kShapesOfForm);
    const glm::vec3 above = spot.place + spot.normal * 0.15F;
    return {glm::vec4(spot.place, placement.size),
            packed(placement.turn),
            placement.tintAndSway,
            {sunVisibility(rocks, above), ambientOcclusion(rocks, above, glm::vec3{0, 1, 0})},
            place::floorHeight(place, {spot.place.x, spot.place.z}),
            static_cast<std::uint32_t>(prototypeOf(placement.form, shape))};
}

// Adds an instance of a form, sunk a little into the ground.
void plant(std::vector<Instance>& all,
           const Bed& bed,
           const Way& way,
           const Spot& spot,
           float size,
           Dice& dice) {
    const std::uint32_t patch = patchAt(*bed.place, spot.place, 4.5F);
    const glm::vec4 tint{tintOf(way.form, patch, dice), way.sway};
    const Spot sunk{spot.place - spot.normal * (0.05F * size), spot.normal};
    const Placement placement{way.form, size, stance(way, spot.normal, dice), tint};
    all.push_back(instanceOf(*bed.place, bed.others, sunk, placement, dice));
}

const Way& wayOf(Form form) {
    return *std::ranges::find(kWays, form, &Way::form);
}

// Plants one large coral on top of a boulder, so that each boulder has an outline of its own: a
// table, a thicket or a fan. The best of 25 random spots is the highest and most upright.
void crownRock(std::vector<Instance>& all,
               const Bed& bed,
               std::vector<Planted>& planted,
               Dice& dice) {
    constexpr std::array kCrowns{Form::Table, Form::Staghorn, Form::Table, Form::Fan, Form::Lobes};
    const float radius = bed.rock->radiusMetres;
    Spot best = spotOn(bed, dice);
    for (int attempt = 0; attempt < 24; ++attempt) {
        const Spot spot = spotOn(bed, dice);
        if (spot.place.y + 0.5F * spot.normal.y > best.place.y + 0.5F * best.normal.y) best = spot;
    }
    if (isBuried(bed, best.place)) return;
    const Form form = kCrowns.at(dice.seed() % kCrowns.size());
    const Way& way = wayOf(form);
    const float size = glm::clamp(0.52F * radius, 0.3F, 1.15F) * dice.between(0.8F, 1.15F);
    planted.push_back({best.place, size});
    plant(all, bed, way, best, size, dice);
}

// The spot of the rock's surface that lies in a direction from its middle.
Spot spotTowards(const Bed& bed, glm::vec3 direction) {
    const auto alongOf = [&](const SolidVertex& vertex) {
        return glm::dot(bed.turn * glm::normalize(vertex.position), direction);
    };
    const SolidVertex& vertex = *std::ranges::max_element(bed.stone->vertices, {}, alongOf);
    return {bed.rock->centre + bed.turn * (vertex.position * bed.rock->radiusMetres),
            glm::normalize(bed.turn * glm::vec3(vertex.normal))};
}

// Plants what is seen of a site.
struct SiteBed {
    std::vector<Instance>& all;
    const Bed& bed;
    const place::Site& site;
    Dice dice{hashOf(site.seed, 81)};

    void grow(const Way& way, glm::vec3 direction, float size) {
        plant(all, bed, way, spotTowards(bed, glm::normalize(direction)), size, dice);
    }
    // A direction drawn near that of the site; `share` of its size.
    glm::vec3 beside(float share) {
        return site.normal + (share * site.sizeMetres / bed.rock->radiusMetres) *
                                 glm::vec3{dice.between(-1, 1), 0, dice.between(-1, 1)};
    }

    // One with two smaller ones.
    void growAnemones() {
        grow(wayOf(Form::Anemone), site.normal, site.sizeMetres);
        for (int i = 0; i < 2; ++i)
            grow(wayOf(Form::Anemone), beside(0.9F), 0.7F * site.sizeMetres);
    }
    void growBranchingCorals() {
        const Form form = dice.unit() < 0.65F ? Form::Staghorn : Form::Bush;
        grow(wayOf(form), site.normal, site.sizeMetres);
        grow(wayOf(Form::Staghorn), beside(0.8F), 0.7F * site.sizeMetres);
    }
    void growTurf() {
        for (int i = 0; i < 9; ++i) {
            const float size = dice.between(kTurfPatch.least, 0.12F);
            grow(kTurfPatch, beside(0.8F), size);
        }
    }
};

// Plants what is seen of a site: anemones, branching corals or short turf; nothing of the other
// kinds. The simulation knows the same sites.
void plantSite(std::vector<Instance>& all,
               const Bed& bed,
               std::vector<Planted>& planted,
               const place::Site& site) {
    SiteBed siteBed{all, bed, site};
    if (site.kind == config::SiteKind::Anemone)
        siteBed.growAnemones();
    else if (site.kind == config::SiteKind::Branching)
        siteBed.growBranchingCorals();
    else if (site.kind == config::SiteKind::Turf)
        siteBed.growTurf();
    else
        return;
    planted.push_back({spotTowards(bed, site.normal).place, 1.2F * site.sizeMetres});
}

// Covers a rock with corals, large ones first so that small ones fill the gaps, then with turf. The
// numbers grow with the rock. What its sites show comes first of all.
void coverRock(std::vector<Instance>& all, const Bed& bed, std::span<const place::Site> sites) {
    const float radius = bed.rock->radiusMetres;
    // Attempts, many of which fail.
    const auto corals = static_cast<int>(30.0F + 130.0F * std::pow(radius, 1.6F));
    Dice dice{hashOf(bed.rock->seed, 77)};
    std::vector<Planted> planted;
    for (const place::Site& site : sites)
        if (site.rockSeed == bed.rock->seed) plantSite(all, bed, planted, site);
    for (int crown = 0; crown < (radius > 1.2F ? 2 : 1); ++crown)
        crownRock(all, bed, planted, dice);
    for (int i = 0; i < corals; ++i) {
        // 1 for the first attempt, 0 for the last: the size falls with its cube.
        const float rank =
            1.0F - (static_cast<float>(i) + dice.unit()) / static_cast<float>(corals);
        const Spot spot = spotOn(bed, dice);
        if (dice.unit() > coverAt(*bed.place, spot) || isBuried(bed, spot.place)) continue;
        const Way& way = wayFor(spot.normal.y, patchAt(*bed.place, spot.place, 2.6F), dice);
        const float host = glm::clamp(0.42F + 0.38F * radius, 0.45F, 1.25F);
        const float size = host * glm::mix(way.least, way.most, rank * rank * rank);
        if (isCrowded(planted, spot.place, size)) continue;
        planted.push_back({spot.place, size});
        plant(all, bed, way, spot, size, dice);
    }
    const auto tufts = static_cast<int>(10.0F + 46.0F * radius * radius);
    for (int i = 0; i < tufts; ++i) {
        const Spot spot = spotOn(bed, dice);
        const float size = dice.between(kTurfPatch.least, kTurfPatch.most);
        if (spot.normal.y > -0.3F && !isBuried(bed, spot.place))
            plant(all, bed, kTurfPatch, spot, size, dice);
    }
}

// The spot of the sand at world x and z.
Spot onSand(const place::PlaceKey& place, glm::vec2 xz) {
    return {{xz.x, place::floorHeight(place, xz), xz.y}, {0, 1, 0}};
}

// Adds a small bleached stone, tilted at random.
void addPebble(
    std::vector<Instance>& all, const Bed& bed, const Spot& spot, float size, Dice& dice) {
    const glm::quat turn = glm::quat_cast(
        frameAbout(glm::normalize(glm::vec3{dice.between(-1, 1), 0.8F, dice.between(-1, 1)}),
                   kTwoPi * dice.unit()));
    // Lighter than living rock: bleached.
    const float light = dice.between(1.3F, 2.1F);
    const glm::vec3 above = spot.place + glm::vec3{0, 0.1F, 0};
    all.push_back(
        {glm::vec4(spot.place + glm::vec3{0, 0.15F * size, 0}, size),
         packed(turn),
         glm::vec4(glm::vec3{light}, 0.0F),
         {sunVisibility(bed.others, above), ambientOcclusion(bed.others, above, {0, 1, 0})},
         spot.place.y,
         static_cast<std::uint32_t>(dice.seed() % kRockShapes)});
}

// Scatters broken pieces and young corals about the foot of a rock.
void litterFoot(std::vector<Instance>& all, const Bed& bed) {
    const place::Rock& rock = *bed.rock;
    Dice dice{hashOf(rock.seed, 78)};
    const auto pieces = static_cast<int>(6.0F + 16.0F * rock.radiusMetres);
    for (int i = 0; i < pieces; ++i) {
        const float turn = kTwoPi * dice.unit();
        const float away =
            rock.radiusMetres * dice.between(0.75F, 1.15F) + 1.1F * dice.unit() * dice.unit();
        const Spot spot =
            onSand(*bed.place,
                   {rock.centre.x + away * std::cos(turn), rock.centre.z + away * std::sin(turn)});
        // Below 0.72 a pebble, mostly a small one; above it a young coral.
        const float share = dice.unit();
        // A rock that lies high on other rocks has no foot on the sand.
        if (spot.place.y < rock.centre.y - 1.2F * rock.radiusMetres) continue;
        if (share < 0.72F) {
            addPebble(
                all, bed, spot, dice.between(0.04F, 0.10F) + 0.16F * share * share * share, dice);
            continue;
        }
        const Way& way = wayFor(1.0F, patchAt(*bed.place, spot.place, 2.0F), dice);
        plant(all, bed, way, spot, dice.between(0.12F, 0.26F), dice);
    }
}

// Adds the rock itself, with a slight tint of its own.
void addRock(std::vector<Instance>& all, const Bed& bed) {
    assert(bed.rock != nullptr);
    const place::Rock& rock = *bed.rock;
    const float light = 0.9F + 0.2F * unitOf(hashOf(rock.seed, 33));
    const float warm = 0.05F * signedUnitOf(hashOf(rock.seed, 34));
    all.push_back({glm::vec4(rock.centre, rock.radiusMetres),
                   packed(bed.turn),
                   {light * (1.0F + warm), light, light * (1.0F - warm), 0.0F},
                   {1.0F, 1.0F},
                   place::floorHeight(*bed.place, {rock.centre.x, rock.centre.z}),
                   static_cast<std::uint32_t>(shapeOf(rock))});
}

// Scatters single corals and stones over the open sand, in loose groups.
void strew(std::vector<Instance>& all,
           const place::PlaceKey& place,
           std::span<const place::Rock> rocks) {
    // Groups in a square of 60 m about the origin, three to ten things in each.
    constexpr int kGroups = 90;
    constexpr float kReachMetres = 30.0F;
    Dice dice{hashOf(place.seed, 79)};
    const Bed bed{&place, nullptr, nullptr, {}, {rocks.begin(), rocks.end()}};
    for (int group = 0; group < kGroups; ++group) {
        const glm::vec2 middle{dice.between(-kReachMetres, kReachMetres),
                               dice.between(-kReachMetres, kReachMetres)};
        const int members = 3 + static_cast<int>(dice.unit() * 8.0F);
        const bool stony = dice.unit() < 0.6F;
        for (int i = 0; i < members; ++i) {
            const Spot spot =
                onSand(place, middle + 0.9F * glm::vec2{dice.between(-1, 1), dice.between(-1, 1)});
            if (isBuried(bed, spot.place + glm::vec3{0, 0.2F, 0})) continue;
            if (stony || i % 3 == 0) {
                addPebble(all, bed, spot, dice.between(0.03F, 0.13F), dice);
                continue;
            }
            const Way& way = wayFor(1.0F, patchAt(place, spot.place, 2.0F), dice);
            plant(all, bed, way, spot, dice.between(0.10F, 0.24F), dice);
        }
    }
}

// Adds the plants of the place, which the simulation knows too: kelp and seagrass.
void sow(std::vector<Instance>& all,
         const place::PlaceKey& place,
         std::span<const place::Rock> rocks) {
    for (const place::Plant& one : place::plantsOf(place)) {
        Dice dice{hashOf(one.seed, 80)};
        const bool kelp = one.kind == place::PlantKind::Kelp;
        const Form form = kelp ? Form::Kelp : Form::Seagrass;
        const float lean = kelp ? 0.07F : 0.15F;
        const glm::vec3 up =
            glm::normalize(glm::vec3{dice.between(-lean, lean), 1.0F, dice.between(-lean, lean)});
        // Kelp leans with the drift, grass in any direction.
        const float about = kelp ? dice.between(-0.7F, 0.7F) : kTwoPi * dice.unit();
        const glm::quat turn = glm::quat_cast(frameAbout(up, about));
        const glm::vec4 tint{tintOf(form, 0, dice), kelp ? 0.12F : 0.45F};
        all.push_back(instanceOf(
            place, rocks, {one.root, {0, 1, 0}}, {form, one.heightMetres, turn, tint}, dice));
    }
}

// The other rocks that are near enough to shade this one.
std::vector<place::Rock> near(std::span<const place::Rock> rocks, const place::Rock& rock) {
    std::vector<place::Rock> others;
    for (const place::Rock& other : rocks)
        if (other.seed != rock.seed && glm::distance(other.centre, rock.centre) <
                                           7.0F * other.radiusMetres + rock.radiusMetres)
            others.push_back(other);
    return others;
}

}  // namespace

std::vector<Instance> scatter(const place::PlaceKey& place) {
    std::vector<Mesh> beds;
    for (int shape = 0; shape < kRockShapes; ++shape) beds.push_back(rockBed(shape));
    const std::vector<place::Rock> rocks = place::rocksOf(place);
    const std::vector<place::Site> sites = place::sitesOf(place);
    std::vector<Instance> all;
    for (const place::Rock& rock : rocks) {
        const Bed bed{&place, &rock, &beds.at(shapeOf(rock)), turnOf(rock), near(rocks, rock)};
        addRock(all, bed);
        coverRock(all, bed, sites);
        litterFoot(all, bed);
    }
    strew(all, place, rocks);
    sow(all, place, rocks);
    // Stable, so that the order is the same on every machine.
    std::ranges::stable_sort(all, {}, &Instance::prototype);
    return all;
}

}  // namespace aquarama::scene
