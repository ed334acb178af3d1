// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "common/config/angle.h"
#include "common/config/scene.h"
#include "common/config/scene.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

constexpr Range kShare{0, 1};
constexpr Range kSideways{-1000, 1000};
constexpr Range kHeight{-1000, 1000};
constexpr Range kHalfExtent{0.2, 1000};
constexpr Range kTurn{-180, 180};
constexpr std::uint32_t kMostPelletsADrop = 256;
constexpr int kMostDrops = 1000;
constexpr int kMostMembers = 64;
constexpr float kHighestStopMetres = -1;
constexpr int kFewestStops = 3;
constexpr int kMostStops = 64;

glm::vec3 readPoint(const TextPlace& at) {
    return {at.number("x_m", kSideways), at.number("y_m", kHeight), at.number("z_m", kSideways)};
}

PlaceKind readPlace(const TextPlace& root) {
    const std::string place = root.choice("place");
    if (place != "REEF" && place != "OPEN_SEA")
        root.refuse("place", "place is " + place + ": write REEF or OPEN_SEA");
    return place == "REEF" ? PlaceKind::Reef : PlaceKind::OpenSea;
}

Gathering readGathering(const TextPlace& root) {
    const std::string gathering = root.choice("gathering");
    if (gathering == "NONE") return Gathering::None;
    if (gathering == "JOURNEY") return Gathering::Journey;
    if (gathering != "MILL")
        root.refuse("gathering", "gathering is " + gathering + ": write NONE, JOURNEY or MILL");
    return Gathering::Mill;
}

WaterType readWaterType(const TextPlace& at) {
    if (!at.has("jerlov")) return SceneWater{}.jerlov;
    const std::string type = at.text("jerlov");
    const auto found = std::ranges::find(kWaterTypeNames, type);
    if (found == kWaterTypeNames.end())
        at.refuse(
            "jerlov",
            "jerlov is \"" + type + "\", no type of water: write I, IA, IB, II, III, 1C or 3C");
    return static_cast<WaterType>(found - kWaterTypeNames.begin());
}

SceneWater readWater(const TextPlace& at) {
    SceneWater water;
    water.centre = readPoint(at.in("centre"));
    const TextPlace half = at.in("half_extent");
    water.halfExtent = {half.number("x_m", kHalfExtent),
                        half.number("y_m", kHalfExtent),
                        half.number("z_m", kHalfExtent)};
    if (water.centre.y + water.halfExtent.y >= 0)
        at.refuse("centre", "the water reaches out of the sea, whose surface is y = 0: lower it");
    water.leastLengthsCubed = at.numberOr("least_room", {0.1, 1000}, water.leastLengthsCubed);
    water.clarityMetres = at.numberOr("clarity_m", {0.5, 100}, water.clarityMetres);
    water.surfaceCelsius = at.numberOr("surface_c", {-2, 45}, water.surfaceCelsius);
    water.celsiusPerMetre = at.numberOr("celsius_per_metre", {-5, 5}, water.celsiusPerMetre);
    water.jerlov = readWaterType(at);
    return water;
}

Day readDay(const TextPlace& at) {
    return {.lengthSeconds = at.numberOr("length_s", {0, 1e6}, 0),
            .startsAt = at.numberOr("starts_at", kShare, 0.5),
            .night = at.numberOr("night", kShare, Day{}.night)};
}

bool isIn(const SceneWater& water, glm::vec3 place, float radius) {
    const glm::vec3 from = place - water.centre;
    return std::abs(from.x) + radius <= water.halfExtent.x &&
           std::abs(from.y) + radius <= water.halfExtent.y &&
           std::abs(from.z) + radius <= water.halfExtent.z;
}

FoodDrop readDrop(const TextPlace& at, const SceneWater& water) {
    const FoodDrop drop{
        .atSeconds = at.number("at_s", {0, 1e6}),
        .position = readPoint(at.in("position")),
        .pellets = static_cast<std::uint32_t>(at.number("pellets", {1, kMostPelletsADrop}))};
    if (!isIn(water, drop.position, 0))
        at.refuse("position", "food outside the water, where no fish comes: move it in");
    return drop;
}

Start readStart(const TextPlace& at, const SceneWater& water) {
    const Start start{.centre = readPoint(at.in("centre")),
                      .radiusMetres = at.number("radius_m", {0, 1000}),
                      .headingRadians = radiansOf(at.numberOr("heading_deg", kTurn, 0)),
                      .hunger = at.numberOr("hunger", kShare, 0),
                      .libido = at.numberOr("libido", kShare, 0)};
    if (!isIn(water, start.centre, static_cast<float>(start.radiusMetres)))
        at.refuse("centre", "the start reaches out of the water: move it in or make it smaller");
    return start;
}

CastMember readMember(const TextPlace& at, const Scene& scene) {
    CastMember member;
    member.species = at.text("species");
    member.place = at.placeOf("species");
    member.fish = static_cast<std::uint32_t>(at.number("fish", {0, kMostFish}));
    if (member.fish == 0 && scene.place != PlaceKind::OpenSea)
        at.refuse("fish", "fish is 0: only an open sea may be without; remove the member");
    if (at.has("start")) member.start = readStart(at.in("start"), scene.water);
    return member;
}

TourStop readStop(const TextPlace& at) {
    TourStop stop{.at = readPoint(at.in("at")), .lookAt = {}, .place = at.place()};
    if (at.has("look_at")) stop.lookAt = readPoint(at.in("look_at"));
    if (stop.at.y > kHighestStopMetres)
        at.refuse("at", "the stop is within a metre of the surface, y = 0: lower it");
    return stop;
}

SceneTour readTour(const TextPlace& at, PlaceKind place) {
    SceneTour tour{.metresPerSecond = at.numberOr("speed_m_s", {0.1, 0.6}, 0.4), .stops = {}};
    const int count = at.count("stops");
    if (count == 0 && place == PlaceKind::Reef)
        at.refuse("a tour of a reef needs stops: add `stops { at { ... } }`, three at least");
    if (count > 0 && count < kFewestStops)
        at.refuse("stops", "a closed path needs three stops: add some", 0);
    if (count > kMostStops)
        at.refuse(
            "stops", "more than " + std::to_string(kMostStops) + " stops: take fewer", kMostStops);
    for (int i = 0; i < count; ++i) tour.stops.push_back(readStop(at.in("stops", i)));
    return tour;
}

std::vector<CastMember> readCast(const TextPlace& root, const Scene& scene) {
    const int count = root.count("cast");
    if (count < 1)
        root.refuse(
            "the scene has no cast: add `cast { species: ... fish: ... }` for each species");
    if (count > kMostMembers)
        root.refuse("cast",
                    "more than " + std::to_string(kMostMembers) + " members: merge some",
                    kMostMembers);
    std::vector<CastMember> cast;
    std::uint64_t fish = 0;
    for (int i = 0; i < count; ++i) {
        cast.push_back(readMember(root.in("cast", i), scene));
        fish += cast.back().fish;
        if (fish > kMostFish)
            root.in("cast", i).refuse(
                "fish", "more than " + std::to_string(kMostFish) + " fish together: take fewer");
    }
    return cast;
}

}  // namespace

Scene parseScene(const std::string& text, const std::string& source) {
    v1::Scene message;
    const TextReader reader(text, source, message);
    const TextPlace root = reader.root();
    Scene scene;
    scene.name = root.text("name");
    scene.place = readPlace(root);
    scene.eye = readPoint(root.in("eye"));
    scene.eyePlace = root.placeOf("eye");
    if (scene.eye.y >= 0) root.refuse("eye", "the eye is out of the sea: let y_m be below 0");
    scene.water = readWater(root.in("water"));
    scene.waterPlace = root.placeOf("water");
    scene.gathering = readGathering(root);
    scene.plankton = static_cast<std::uint32_t>(root.number("plankton", {0, kMostPlankton}));
    if (root.has("day")) scene.day = readDay(root.in("day"));
    const int drops = root.count("drops");
    if (drops > kMostDrops)
        root.refuse("drops",
                    "more than " + std::to_string(kMostDrops) + " drops of food: take fewer",
                    kMostDrops);
    for (int i = 0; i < drops; ++i) {
        scene.drops.push_back(readDrop(root.in("drops", i), scene.water));
        if (i > 0 && scene.drops.back().atSeconds < scene.drops[scene.drops.size() - 2].atSeconds)
            root.in("drops", i).refuse("at_s", "at_s is before that of the drop above: sort them");
    }
    if (root.has("tour")) scene.tour = readTour(root.in("tour"), scene.place);
    scene.idleSeconds = root.numberOr("idle_s", {1, 86400}, Scene{}.idleSeconds);
    scene.cast = readCast(root, scene);
    return scene;
}

Scene readScene(const std::string& path) {
    return parseScene(readTextFile(path), path);
}

}  // namespace aquarama::config
