// SPDX-License-Identifier: Apache-2.0
#include "common/config/scene.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/config/text_file.h"

namespace aquarama::config {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kConfig = AQUARAMA_SOURCE_DIR "/config";

const std::string kScene = R"(name: "small"
place: OPEN_SEA
eye { x_m: 0 y_m: -9 z_m: 1.5 }
water {
  centre { x_m: 1 y_m: -9 z_m: -6 }
  half_extent { x_m: 6 y_m: 3 z_m: 4.5 }
  least_room: 3
  clarity_m: 15
  surface_c: 27
  celsius_per_metre: -0.25
  jerlov: "1C"
  colour_returned: 0.25
}
gathering: MILL
plankton: 40
day { length_s: 600 starts_at: 0.25 night: 0.1 }
drops { at_s: 10 position { x_m: 1 y_m: -8 z_m: -5 } pellets: 12 }
drops { at_s: 20.5 position { x_m: 2 y_m: -8 z_m: -5 } pellets: 3 }
cast { species: "scad.txtpb" fish: 0 }
cast {
  species: "shark.txtpb"
  fish: 2
  start { centre { x_m: -2 y_m: -9 z_m: -6 } radius_m: 0.5 heading_deg: 90 hunger: 0.9 libido: 0.2 }
}
)";

TEST(Scene, isReadInItsUnits) {
    const Scene scene = parseScene(kScene, "small.txtpb");
    EXPECT_EQ(scene.text, kScene);
    EXPECT_EQ(fishIn(scene), 2U);
    EXPECT_EQ(scene.name, "small");
    EXPECT_EQ(scene.place, PlaceKind::OpenSea);
    EXPECT_EQ(scene.eye, glm::vec3(0, -9, 1.5F));
    EXPECT_EQ(scene.water.halfExtent, glm::vec3(6, 3, 4.5F));
    EXPECT_DOUBLE_EQ(scene.water.leastLengthsCubed, 3);
    EXPECT_DOUBLE_EQ(scene.water.clarityMetres, 15);
    EXPECT_DOUBLE_EQ(scene.water.surfaceCelsius, 27);
    EXPECT_DOUBLE_EQ(scene.water.celsiusPerMetre, -0.25);
    EXPECT_EQ(scene.water.jerlov, WaterType::C1);
    EXPECT_DOUBLE_EQ(scene.water.colourReturned, 0.25);
    EXPECT_EQ(scene.gathering, Gathering::Mill);
    EXPECT_EQ(scene.plankton, 40U);
    EXPECT_DOUBLE_EQ(scene.day.lengthSeconds, 600);
    EXPECT_DOUBLE_EQ(scene.day.startsAt, 0.25);
    EXPECT_DOUBLE_EQ(scene.day.night, 0.1);
    ASSERT_EQ(scene.drops.size(), 2U);
    EXPECT_DOUBLE_EQ(scene.drops[1].atSeconds, 20.5);
    EXPECT_EQ(scene.drops[1].pellets, 3U);
    ASSERT_EQ(scene.cast.size(), 2U);
    EXPECT_EQ(scene.cast[0].fish, 0U);
    EXPECT_FALSE(scene.cast[0].start);
    const Start& start = scene.cast[1].start.value();
    EXPECT_EQ(start.centre, glm::vec3(-2, -9, -6));
    EXPECT_NEAR(start.headingRadians, 1.5707963, 1e-6);
    EXPECT_DOUBLE_EQ(start.hunger, 0.9);
    EXPECT_DOUBLE_EQ(start.libido, 0.2);
}

TEST(Scene, fillsInWhatIsLeftOut) {
    std::string text = kScene;
    const auto drop = [&text](const std::string& part) {
        text.erase(text.find(part), part.size());
    };
    drop(
        "  least_room: 3\n  clarity_m: 15\n  surface_c: 27\n  celsius_per_metre: -0.25\n  jerlov: "
        "\"1C\"\n");
    drop("day { length_s: 600 starts_at: 0.25 night: 0.1 }");
    drop(" heading_deg: 90 hunger: 0.9 libido: 0.2");
    const Scene scene = parseScene(text, "small.txtpb");
    EXPECT_DOUBLE_EQ(scene.water.leastLengthsCubed, 4);
    EXPECT_DOUBLE_EQ(scene.water.clarityMetres, 12);
    EXPECT_EQ(scene.water.jerlov, WaterType::IA);
    EXPECT_DOUBLE_EQ(scene.day.lengthSeconds, 0);
    EXPECT_DOUBLE_EQ(scene.day.startsAt, 0.5);
    EXPECT_FALSE(scene.day.followsHall);
    EXPECT_DOUBLE_EQ(scene.cast[1].start->hunger, 0);
}

TEST(Scene, aDayMayFollowTheHall) {
    std::string text = kScene;
    const std::string length = "length_s: 600 starts_at: 0.25";
    text.replace(text.find(length), length.size(), "follows: HALL");
    EXPECT_TRUE(parseScene(text, "small.txtpb").day.followsHall);
    EXPECT_FALSE(parseScene(kScene, "small.txtpb").day.followsHall);
}

std::string withTour(const std::string& tour) {
    return kScene + tour;
}

TEST(Scene, aTourIsRead) {
    EXPECT_FALSE(parseScene(kScene, "small.txtpb").tour);
    EXPECT_DOUBLE_EQ(parseScene(kScene, "small.txtpb").idleSeconds, 20);
    const Scene round = parseScene(withTour("tour {} idle_s: 5"), "small.txtpb");
    ASSERT_TRUE(round.tour);
    EXPECT_TRUE(round.tour->stops.empty());
    EXPECT_DOUBLE_EQ(round.tour->metresPerSecond, 0.4);
    EXPECT_DOUBLE_EQ(round.idleSeconds, 5);
    const std::string stop = "stops { at { x_m: 1 y_m: -9 z_m: -2 } } ";
    const Scene stops = parseScene(
        withTour("tour { speed_m_s: 0.3 " + stop + stop +
                 "stops { at { x_m: 0 y_m: -8 z_m: -3 } look_at { x_m: 4 y_m: -5 z_m: -6 } } }"),
        "small.txtpb");
    ASSERT_EQ(stops.tour->stops.size(), 3U);
    EXPECT_FALSE(stops.tour->stops[0].lookAt);
    EXPECT_EQ(stops.tour->stops[2].at, glm::vec3(0, -8, -3));
    EXPECT_EQ(stops.tour->stops[2].lookAt, glm::vec3(4, -5, -6));
}

TEST(Scene, aTourThatCannotBeIsRefusedWithItsPlace) {
    const auto refusal = [](const std::string& tour, bool onAReef = false) -> std::string {
        std::string text = withTour("\n" + tour);
        if (onAReef) text.replace(text.find("OPEN_SEA"), 8, "REEF");
        if (onAReef) text.replace(text.find("fish: 0"), 7, "fish: 1");
        try {
            (void)parseScene(text, "small.txtpb");
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    };
    const std::string stop = "stops { at { x_m: 1 y_m: -9 z_m: -2 } } ";
    EXPECT_THAT(refusal("tour { " + stop + stop + "}"), HasSubstr("needs three stops"));
    EXPECT_THAT(refusal("tour { speed_m_s: 3 }"), HasSubstr("speed_m_s"));
    EXPECT_THAT(refusal("idle_s: 0"), HasSubstr("idle_s"));
    EXPECT_THAT(refusal("tour { " + stop + stop + "stops { at { x_m: 1 y_m: -0.5 z_m: 0 } } }"),
                HasSubstr("lower it"));
    EXPECT_THAT(refusal("tour { " + stop + stop + "stops { } }"), HasSubstr("at"));
    EXPECT_EQ(refusal("tour { }"), "accepted");
    EXPECT_THAT(refusal("tour { }", true), HasSubstr("a tour of a reef needs stops"));
    EXPECT_THAT(refusal("tour { }", true), StartsWith("small.txtpb:"));
}

std::vector<std::string> shippedScenes() {
    std::vector<std::string> paths;
    for (const auto& entry : fs::recursive_directory_iterator(kConfig + "/scenes"))
        if (entry.is_regular_file()) paths.push_back(entry.path().string());
    std::ranges::sort(paths);
    return paths;
}

TEST(Scene, theScenesThatComeWithAquaramaAreValid) {
    EXPECT_GE(shippedScenes().size(), 13U);
    for (const std::string& path : shippedScenes()) {
        const Scene scene = readScene(path);
        EXPECT_EQ(readCastSpecies(scene, path).size(), scene.cast.size());
    }
}

// One built in code has the same.
TEST(Scene, hasTheSchemasDefaults) {
    const Scene read = parseScene(R"(name: "sea" place: REEF eye { x_m: 0 y_m: -6 z_m: 0 }
water { centre { x_m: 0 y_m: -5 z_m: -5 } half_extent { x_m: 5 y_m: 1 z_m: 3 } }
gathering: NONE plankton: )" + std::to_string(kMostPlankton) +
                                      R"( cast { species: "scad.txtpb" fish: 1 } tour {
stops { at { x_m: 0 y_m: -5 z_m: 0 } } stops { at { x_m: 1 y_m: -5 z_m: 0 } }
stops { at { x_m: 0 y_m: -5 z_m: 1 } } })",
                                  "sea.txtpb");
    const SceneWater water;
    EXPECT_EQ(read.water.leastLengthsCubed, water.leastLengthsCubed);
    EXPECT_EQ(read.water.clarityMetres, water.clarityMetres);
    EXPECT_EQ(read.water.surfaceCelsius, water.surfaceCelsius);
    EXPECT_EQ(read.water.celsiusPerMetre, water.celsiusPerMetre);
    EXPECT_EQ(read.water.jerlov, water.jerlov);
    EXPECT_EQ(read.water.colourReturned, water.colourReturned);
    EXPECT_EQ(read.day.lengthSeconds, Day{}.lengthSeconds);
    EXPECT_EQ(read.day.startsAt, Day{}.startsAt);
    EXPECT_EQ(read.day.night, Day{}.night);
    EXPECT_EQ(read.tour.value().metresPerSecond, SceneTour{}.metresPerSecond);
    EXPECT_EQ(read.idleSeconds, Scene{}.idleSeconds);
    EXPECT_EQ(read.plankton, kMostPlankton);
}

// Yu & Terzopoulos 1998, section 5.
TEST(Scene, theReefHasThePapersCast) {
    const std::string path = kConfig + "/scenes/reef_1998.txtpb";
    const Scene scene = readScene(path);
    const auto cast = readCastSpecies(scene, path);
    std::uint32_t fish = 0;
    std::uint32_t schooling = 0;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        fish += scene.cast[i].fish;
        if (cast[i].species.habits.shares.schooling > 0) schooling += scene.cast[i].fish;
    }
    EXPECT_EQ(cast.size(), 7U);
    EXPECT_EQ(fish, 60U);
    EXPECT_EQ(schooling, 51U);
    EXPECT_GE(scene.day.night, 0.5) << "the wall is never dark";
}

struct Mistake {
    std::string name;
    std::string good, bad;  // `good` is replaced by `bad` in kScene
    std::string at;   // the error points to the first of this in the mistake's line or after it
    std::string why;  // and says this
};

std::ostream& operator<<(std::ostream& out, const Mistake& mistake) {
    return out << mistake.name;
}

// file:line:column of a position in a text, by counting.
std::string placeOf(const std::string& text, std::size_t position) {
    const auto end = text.begin() + static_cast<long>(position);
    const auto line = std::count(text.begin(), end, '\n') + 1;
    const std::size_t before = position == 0 ? std::string::npos : text.rfind('\n', position - 1);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    return "bad.txtpb:" + std::to_string(line) + ":" + std::to_string(position - start + 1) + ": ";
}

class BadScene : public testing::TestWithParam<Mistake> {};

TEST_P(BadScene, isRefusedInOneLineThatNamesThePlace) {
    const Mistake& mistake = GetParam();
    const std::size_t start = kScene.find(mistake.good);
    ASSERT_NE(start, std::string::npos);
    std::string text = kScene;
    text.replace(start, mistake.good.size(), mistake.bad);
    const std::size_t lineStart = kScene.rfind('\n', start) + 1;
    const std::size_t wrong = mistake.at.empty() ? 0 : text.find(mistake.at, lineStart);
    ASSERT_NE(wrong, std::string::npos);
    try {
        (void)parseScene(text, "bad.txtpb");
        FAIL() << "accepted";
    } catch (const Error& error) {
        const std::string said = error.what();
        EXPECT_THAT(said, StartsWith(placeOf(text, wrong)));
        EXPECT_THAT(said, HasSubstr(mistake.why));
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
}

// `at` empty: the whole file, 1:1.
INSTANTIATE_TEST_SUITE_P(
    Scene,
    BadScene,
    testing::Values(
        Mistake{"unknownField", "plankton: 40", "plankton: 40 whales: 1", ": 1", "whales"},
        Mistake{"wrongType", "plankton: 40", "plankton: \"many\"", "\"many\"", "Expected"},
        Mistake{"missingName", "name: \"small\"", "", "", "lacks name"},
        Mistake{"missingPlace", "place: OPEN_SEA", "", "", "lacks place"},
        Mistake{"unknownPlace", "OPEN_SEA", "LAGOON", "eye", "LAGOON"},
        Mistake{"unspecifiedPlace", "OPEN_SEA", "PLACE_UNSPECIFIED", "place", "write REEF"},
        Mistake{"missingEye", "eye { x_m: 0 y_m: -9 z_m: 1.5 }", "", "", "lacks eye"},
        Mistake{"eyeOutOfTheSea", "y_m: -9 z_m: 1.5", "y_m: 0.5 z_m: 1.5", "eye", "out of the sea"},
        Mistake{"eyeNowhere", "z_m: 1.5", "z_m: nan", "z_m", "must be from"},
        Mistake{"noWaterCentre",
                "water {\n  centre { x_m: 1 y_m: -9 z_m: -6 }\n",
                "water {\n",
                "water",
                "lacks centre"},
        Mistake{"waterAboveTheSurface",
                "centre { x_m: 1 y_m: -9",
                "centre { x_m: 1 y_m: -2.5",
                "centre",
                "reaches out of the sea"},
        Mistake{"flatWater", "x_m: 6 y_m: 3", "x_m: 6 y_m: 0", "y_m: 0", "must be from"},
        Mistake{"noRoom", "least_room: 3", "least_room: 0", "least_room", "must be from"},
        Mistake{"ink", "jerlov: \"1C\"", "jerlov: \"4C\"", "jerlov", "no type of water"},
        Mistake{"murk", "clarity_m: 15", "clarity_m: 0", "clarity_m", "must be from"},
        Mistake{"boilingWater", "surface_c: 27", "surface_c: 100", "surface_c", "must be from"},
        Mistake{"noGathering", "gathering: MILL", "", "", "lacks gathering"},
        Mistake{"unspecifiedGathering",
                "MILL",
                "GATHERING_UNSPECIFIED",
                "gathering",
                "write NONE or MILL"},
        Mistake{"soup", "plankton: 40", "plankton: 60001", "plankton", "must be from"},
        Mistake{"negativePlankton", "plankton: 40", "plankton: -1", "-1", "Expected"},
        Mistake{"dayBeforeItBegins", "length_s: 600", "length_s: -1", "length_s", "must be from"},
        Mistake{"hallOfItsOwnLength",
                "starts_at: 0.25",
                "follows: HALL",
                "length_s",
                "as long as the hall's"},
        Mistake{"brightNight", "night: 0.1", "night: 1.1", "night", "must be from"},
        Mistake{"foodOutsideTheWater",
                "x_m: 1 y_m: -8",
                "x_m: 9 y_m: -8",
                "position",
                "outside the water"},
        Mistake{"noPellets", "pellets: 12", "pellets: 0", "pellets", "must be from"},
        Mistake{"dropsOutOfOrder", "at_s: 20.5", "at_s: 5", "at_s", "sort them"},
        Mistake{"noCast",
                kScene.substr(kScene.find("cast {")),
                "",
                "",
                "the file lacks cast: give 1 to 64"},
        Mistake{"castWithoutAFile", "\"scad.txtpb\"", "\"\"", "species", "is empty"},
        Mistake{"castWithoutANumber", " fish: 0", "", "cast", "lacks fish"},
        Mistake{"tooManyOfOneSpecies", "fish: 0", "fish: 1000001", "fish", "together"},
        Mistake{"tooManyTogether", "fish: 0", "fish: 999999", "fish: 2", "together"},
        Mistake{"reefWithoutFish", "place: OPEN_SEA", "place: REEF", "fish: 0", "only an open sea"},
        Mistake{"startOutsideTheWater",
                "x_m: -2 y_m: -9",
                "x_m: -4.8 y_m: -9",
                "centre",
                "out of the water"},
        Mistake{"startAboveTheWater", "radius_m: 0.5", "radius_m: 3.5", "centre", "out of the"},
        Mistake{"headingRoundAndRound", "heading_deg: 90", "heading_deg: 270", "heading", "must"},
        Mistake{"starvation", "hunger: 0.9", "hunger: 1.9", "hunger", "must be from"},
        Mistake{"frenzy", "libido: 0.2", "libido: -0.2", "libido", "must be from"}),
    [](const auto& test) { return test.param.name; });

TEST(Cast, ofASpeciesThatIsNotThereIsRefusedAtItsPlaceInTheScene) {
    const std::string path = kConfig + "/scenes/small.txtpb";
    const Scene scene = parseScene(kScene, path);
    try {
        (void)readCastSpecies(scene, path);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), StartsWith(path + ":19:8: "));
        EXPECT_THAT(error.what(), HasSubstr("config/scenes/scad.txtpb"));
    }
}

TEST(Cast, ofARigWhoseSceneIsNotThereIsRefusedAtItsPlaceInTheRig) {
    Rig rig = readRig(kConfig + "/desk.txtpb");
    EXPECT_EQ(scenePathOf(rig, kConfig + "/desk.txtpb"), kConfig + "/scenes/reef.txtpb");
    rig.scene = "scenes/moon.txtpb";
    try {
        (void)scenePathOf(rig, kConfig + "/desk.txtpb");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::MatchesRegex(".*desk\\.txtpb:[0-9]+:1: .*moon.*"));
    }
}

TEST(FileKind, isToldByWhatTheFileHolds) {
    const auto kindAt = [](const std::string& path) { return fileKindOf(readTextFile(path)); };
    EXPECT_EQ(kindAt(kConfig + "/desk.txtpb"), FileKind::Rig);
    EXPECT_EQ(kindAt(kConfig + "/species/clownfish.txtpb"), FileKind::Species);
    for (const std::string& path : shippedScenes()) EXPECT_EQ(kindAt(path), FileKind::Scene);
    EXPECT_EQ(fileKindOf(kScene + "whales: 3 }}"), FileKind::Scene) << "in spite of a mistake";
    EXPECT_EQ(fileKindOf("not a word of it"), FileKind::Rig);
}

}  // namespace
}  // namespace aquarama::config
