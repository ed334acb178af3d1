// SPDX-License-Identifier: Apache-2.0
#include "common/config/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/config/scene.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

constexpr float kHighestStopMetres = -1;
constexpr int kFewestStops = 3;

static_assert(v1::Scene::OPEN_SEA - v1::Scene::REEF == static_cast<int>(PlaceKind::OpenSea));
static_assert(v1::Sites::CLEANING - v1::Sites::ANEMONE == static_cast<int>(SiteKind::Cleaning));

// Of a point or a half extent.
glm::vec3 pointOf(const auto& in) {
    return {in.x_m(), in.y_m(), in.z_m()};
}

WaterType waterTypeOf(const TextReader& file, const v1::SceneWater& in) {
    const auto found = std::ranges::find(kWaterTypeNames, in.jerlov());
    if (found == kWaterTypeNames.end())
        file.refuse(in,
                    "jerlov",
                    "jerlov is \"" + in.jerlov() +
                        "\", no type of water: write I, IA, IB, II, III, 1C or 3C");
    return static_cast<WaterType>(found - kWaterTypeNames.begin());
}

SceneWater waterOf(const TextReader& file, const v1::SceneWater& in) {
    const SceneWater water{.centre = pointOf(in.centre()),
                           .halfExtent = pointOf(in.half_extent()),
                           .leastLengthsCubed = in.least_room(),
                           .clarityMetres = in.clarity_m(),
                           .surfaceCelsius = in.surface_c(),
                           .celsiusPerMetre = in.celsius_per_metre(),
                           .jerlov = waterTypeOf(file, in),
                           .colourReturned = in.colour_returned()};
    if (water.centre.y + water.halfExtent.y >= 0)
        file.refuse(
            in, "centre", "the water reaches out of the sea, whose surface is y = 0: lower it");
    return water;
}

// Of a head or the place of a site.
glm::vec2 planOf(const auto& in) {
    return {in.x_m(), in.z_m()};
}

std::vector<Head> headsOf(const TextReader& file, const v1::Scene& in, PlaceKind place) {
    std::vector<Head> heads;
    for (const v1::Head& head : in.heads()) {
        if (place != PlaceKind::Reef)
            file.refuse(head, "an open sea has no boulders: remove the head, or take place: REEF");
        heads.push_back({.xz = planOf(head),
                         .radiusMetres = static_cast<float>(head.radius_m()),
                         .heightMetres = static_cast<float>(head.height_m()),
                         .place = file.placeOf(head)});
    }
    return heads;
}

std::vector<SiteGroup> sitesOf(const TextReader& file, const v1::Scene& in, PlaceKind place) {
    std::vector<SiteGroup> sites;
    for (const v1::Sites& group : in.sites()) {
        if (place != PlaceKind::Reef)
            file.refuse(group,
                        "an open sea has no boulders: remove the sites, or take place: REEF");
        SiteGroup& site = sites.emplace_back();
        site.kind = static_cast<SiteKind>(group.kind() - v1::Sites::ANEMONE);
        site.number = group.number();
        site.place = file.placeOf(group);
        if (!group.has_at()) continue;
        site.xz = planOf(group.at());
        if (site.number != 1)
            file.refuse(group, "number", "number is for sites without `at`: remove one of the two");
    }
    return sites;
}

SceneCurrent currentOf(const v1::Scene& in) {
    if (!in.has_current()) return {};
    return {.tideMetresPerSecond = in.current().tide_m_s(),
            .tideSeconds = in.current().tide_s(),
            .surgeMetresPerSecond = in.current().surge_m_s(),
            .surgeSeconds = in.current().surge_s()};
}

Day dayOf(const TextReader& file, const v1::Day& in) {
    const bool followsHall = in.follows() == v1::Day::HALL;
    if (followsHall && in.length_s() > 0)
        file.refuse(
            in, "length_s", "a day that follows the hall is as long as the hall's: drop it");
    return {.lengthSeconds = in.length_s(),
            .startsAt = in.starts_at(),
            .night = in.night(),
            .followsHall = followsHall};
}

bool isIn(const SceneWater& water, glm::vec3 place, float radius) {
    const glm::vec3 from = place - water.centre;
    return std::abs(from.x) + radius <= water.halfExtent.x &&
           std::abs(from.y) + radius <= water.halfExtent.y &&
           std::abs(from.z) + radius <= water.halfExtent.z;
}

std::vector<FoodDrop> dropsOf(const TextReader& file,
                              const v1::Scene& in,
                              const SceneWater& water) {
    std::vector<FoodDrop> drops;
    for (const v1::FoodDrop& drop : in.drops()) {
        const double before = drops.empty() ? 0 : drops.back().atSeconds;
        drops.push_back({.atSeconds = drop.at_s(),
                         .position = pointOf(drop.position()),
                         .pellets = drop.pellets()});
        if (!isIn(water, drops.back().position, 0))
            file.refuse(
                drop, "position", "food outside the water, where no fish comes: move it in");
        if (drop.at_s() < before)
            file.refuse(drop, "at_s", "at_s is before that of the drop above: sort them");
    }
    return drops;
}

Start startOf(const TextReader& file, const v1::Start& in, const SceneWater& water) {
    const Start start{.centre = pointOf(in.centre()),
                      .radiusMetres = in.radius_m(),
                      .headingRadians = in.heading_deg() * kRadiansPerDegree<double>,
                      .hunger = in.hunger(),
                      .libido = in.libido()};
    if (!isIn(water, start.centre, static_cast<float>(start.radiusMetres)))
        file.refuse(
            in, "centre", "the start reaches out of the water: move it in or make it smaller");
    return start;
}

CastMember memberOf(const TextReader& file, const v1::CastMember& in, const Scene& scene) {
    CastMember member{
        .species = in.species(), .fish = in.fish(), .place = file.placeOf(in, "species")};
    if (member.fish == 0 && scene.place != PlaceKind::OpenSea)
        file.refuse(in, "fish", "fish is 0: only an open sea may be without; remove the member");
    for (const v1::SitePoint& home : in.homes()) member.homes.push_back(planOf(home));
    if (in.has_start()) member.start = startOf(file, in.start(), scene.water);
    return member;
}

TourStop stopOf(const TextReader& file, const v1::TourStop& in) {
    TourStop stop{.at = pointOf(in.at()), .lookAt = {}, .place = file.placeOf(in)};
    if (in.has_look_at()) stop.lookAt = pointOf(in.look_at());
    if (stop.at.y > kHighestStopMetres)
        file.refuse(in, "at", "the stop is within a metre of the surface, y = 0: lower it");
    return stop;
}

SceneTour tourOf(const TextReader& file, const v1::Tour& in, PlaceKind place) {
    if (in.stops().empty() && place == PlaceKind::Reef)
        file.refuse(in, "a tour of a reef needs stops: add `stops { at { ... } }`, three at least");
    if (!in.stops().empty() && in.stops_size() < kFewestStops)
        file.refuse(in, "stops", "a closed path needs three stops: add some");
    SceneTour tour{.metresPerSecond = in.speed_m_s(), .stops = {}};
    for (const v1::TourStop& stop : in.stops()) tour.stops.push_back(stopOf(file, stop));
    return tour;
}

std::vector<CastMember> castOf(const TextReader& file, const v1::Scene& in, const Scene& scene) {
    std::vector<CastMember> cast;
    std::uint64_t fish = 0;
    for (const v1::CastMember& member : in.cast()) {
        cast.push_back(memberOf(file, member, scene));
        fish += member.fish();
        if (fish > kMostFish)
            file.refuse(member,
                        "fish",
                        "more than " + std::to_string(kMostFish) + " fish together: take fewer");
    }
    return cast;
}

}  // namespace

Scene parseScene(const std::string& text, const std::string& source) {
    v1::Scene in;
    TextReader file(text, source, in);
    file.check();
    Scene scene;
    scene.text = text;
    scene.name = in.name();
    scene.place = static_cast<PlaceKind>(in.place() - v1::Scene::REEF);
    scene.eye = pointOf(in.eye());
    scene.eyePlace = file.placeOf(in, "eye");
    if (scene.eye.y >= 0) file.refuse(in, "eye", "the eye is out of the sea: let y_m be below 0");
    scene.water = waterOf(file, in.water());
    scene.waterPlace = file.placeOf(in, "water");
    scene.gathering = in.gathering() == v1::Scene::MILL ? Gathering::Mill : Gathering::None;
    scene.plankton = in.plankton();
    scene.heads = headsOf(file, in, scene.place);
    scene.sites = sitesOf(file, in, scene.place);
    scene.current = currentOf(in);
    scene.livedSeconds = in.lived_s();
    scene.day = dayOf(file, in.day());
    scene.drops = dropsOf(file, in, scene.water);
    if (in.has_tour()) scene.tour = tourOf(file, in.tour(), scene.place);
    scene.idleSeconds = in.idle_s();
    scene.cast = castOf(file, in, scene);
    return scene;
}

Scene readScene(const std::string& path) {
    return parseScene(readTextFile(path), path);
}

std::vector<CastSpecies> readCastSpecies(const Scene& scene, const std::string& scenePath) {
    std::vector<CastSpecies> cast;
    for (const CastMember& member : scene.cast) {
        const std::string path = besideFile(scenePath, member.species);
        if (!std::filesystem::is_regular_file(path))
            throw Error(placed(
                scenePath,
                member.place,
                "there is no species file " + path + ": give its path from the scene's folder"));
        cast.push_back({path, readSpecies(path)});
    }
    return cast;
}

std::uint32_t fishIn(const Scene& scene) {
    std::uint32_t fish = 0;
    for (const CastMember& member : scene.cast) fish += member.fish;
    return fish;
}

}  // namespace aquarama::config
