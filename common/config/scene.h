// SPDX-License-Identifier: Apache-2.0
// A scene: which water, who swims in it, and what happens there, as its file says. World frame:
// metres, Y up, the surface is y = 0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/species.h"
#include "common/config/text_file.h"

namespace aquarama::config {

// As many particles as scene.proto allows.
inline constexpr std::uint32_t kMostPlankton = 60'000;

// What stands about the wall; in the schema's order, as Gathering.
enum class PlaceKind : std::uint8_t {
    Reef,     // sand, rocks and plants about the wall
    OpenSea,  // nothing but water
};

// Jerlov's optical types of sea water, the clearest first: I to III of the oceans, 1C and 3C of
// coasts.
enum class WaterType : std::uint8_t { I, IA, IB, II, III, C1, C3 };
// As scenes name them, in the order of the types.
inline constexpr std::array<std::string_view, 7> kWaterTypeNames{
    "I", "IA", "IB", "II", "III", "1C", "3C"};

// A pile of boulders that a scene adds to its reef: (x, z) of its middle, metres, the radius of its
// lowest boulder and the height of its crown above the sand.
struct Head {
    glm::vec2 xz{};
    float radiusMetres = 1, heightMetres = 1;
    SourcePlace place = {};
    friend bool operator==(const Head& a, const Head& b) {
        return a.xz == b.xz && a.radiusMetres == b.radiusMetres && a.heightMetres == b.heightMetres;
    }
};

// Sites of one kind: one at (x, z), or so many that the seed spreads.
struct SiteGroup {
    SiteKind kind = SiteKind::Hole;
    std::optional<glm::vec2> xz = {};
    std::uint32_t number = 1;
    SourcePlace place = {};
    friend bool operator==(const SiteGroup& a, const SiteGroup& b) {
        return a.kind == b.kind && a.xz == b.xz && a.number == b.number;
    }
};

// The motion of the water (common/place/current.h). Velocities at their greatest, metres a second,
// 0 in still water; periods in seconds.
struct SceneCurrent {
    double tideMetresPerSecond = 0, tideSeconds = 620;
    double surgeMetresPerSecond = 0, surgeSeconds = 7;
    friend bool operator==(const SceneCurrent&, const SceneCurrent&) = default;
};

// What a school is drawn to.
enum class Gathering : std::uint8_t {
    None,  // goes where its members go
    Mill,  // circles in the middle of the water: a bait ball
};

// Where the fish of a member begin, and in which mood; left out, they begin where the scene has
// room.
struct Start {
    glm::vec3 centre{};         // metres
    double radiusMetres = 1;    // about the centre
    double headingRadians = 0;  // about up; 0 is along +x, to the left (-z) positive
    double hunger = 0;          // 0 to 1
    double libido = 0;
};

// The fish of one species.
struct CastMember {
    std::string species;  // path of its file, relative to the scene's folder
    std::uint32_t fish = 0;
    // Wanted homes in plan (x, z), metres, one for each group; none: by the species alone.
    std::vector<glm::vec2> homes = {};
    std::optional<Start> start = {};
    SourcePlace place = {};  // of the path
};

// The water that fish keep to: a box. Where the fish would have less room than leastLengthsCubed
// each, in cubes of their mean length, it grows: sideways and away from the eye, and in the open
// sea downwards (common/place).
struct SceneWater {
    glm::vec3 centre{0.0F, -5.8F, -5.5F};
    glm::vec3 halfExtent{5.0F, 1.8F, 3.5F};
    double leastLengthsCubed = 4;
    double clarityMetres = 12;                            // no fish sees farther
    double surfaceCelsius = 28, celsiusPerMetre = -0.15;  // with depth
    WaterType jerlov = WaterType::IA;                     // what light does in it
    double colourReturned = 0.9;  // share of the colour that water takes, 0 as in nature
};

// The day of a scene (common/place/day.h): brightness 1 by day, `night` at night. Length 0: always
// as at the start. One that follows the hall has no length; it begins as the hall's clock says, or
// as `startsAt` says where no clock is read.
struct Day {
    double lengthSeconds = 0;
    double startsAt = 0.5;  // 0 midnight, 0.5 noon
    double night = 0.2;
    bool followsHall = false;
};

// Something for the fish: pellets that a visitor could have dropped.
struct FoodDrop {
    double atSeconds = 0;
    glm::vec3 position{};
    std::uint32_t pellets = 12;
};

// Where the submarine goes when nobody steers it: a closed path through all stops, in the open sea
// without any round the middle of the water through the eye.
struct TourStop {
    glm::vec3 at{};
    std::optional<glm::vec3> lookAt;  // without: where the school is drawn to
    SourcePlace place = {};
};
// The speed along it, and its stops in their order.
struct SceneTour {
    double metresPerSecond = 0.4;
    std::vector<TourStop> stops;
};

// What is shown on a wall. The values here are those of a scene built in code; where a file leaves
// something out it has what scene.proto says.
struct Scene {
    std::string text = {};  // of the file, as it was read: recorded, and sent to the nodes
    std::string name = "reef";
    PlaceKind place = PlaceKind::Reef;
    glm::vec3 eye{0.0F, -6.0F, 0.0F};  // where the submarine begins, looking along -z
    SourcePlace eyePlace = {};
    SceneWater water;
    SourcePlace waterPlace = {};
    Gathering gathering = Gathering::None;
    std::uint32_t plankton = 300;  // particles; eaten ones drift in again
    std::vector<Head> heads;
    std::vector<SiteGroup> sites;
    // So many reefs stand side by side in the water, and behind one another; not in files.
    glm::uvec2 reefs{1, 1};
    SceneCurrent current;
    double livedSeconds = 0;  // of the world, unseen, before a show begins
    Day day;
    std::vector<FoodDrop> drops;
    std::vector<CastMember> cast;   // at least one; the school first, which an open sea may lack
    std::optional<SceneTour> tour;  // without: the submarine stays at the eye
    double idleSeconds = 20;        // without a hand, until it steers itself
};

// Throws Error with file:line:column for what the schema does not allow, for water out of the sea
// and for starts out of the water. `source` is the file's name in errors. That the species are
// there is checked by readCastSpecies.
[[nodiscard]] Scene readScene(const std::string& path);
[[nodiscard]] Scene parseScene(const std::string& text, const std::string& source);

// Of a member of the cast: its species, and the file that it was read from.
struct CastSpecies {
    std::string path;
    Species species;
};

// Of each member of the cast, in its order. Throws Error at the member's place in the scene where
// there is no such file, or at the mistake in it.
[[nodiscard]] std::vector<CastSpecies> readCastSpecies(const Scene& scene,
                                                       const std::string& scenePath);

// Of all members together.
[[nodiscard]] std::uint32_t fishIn(const Scene& scene);

}  // namespace aquarama::config
