// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/config/species.h"
#include "tests/support/cast.h"

namespace aquarama::config {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string fileOf(const std::string& species) {
    std::ostringstream text;
    text << std::ifstream(AQUARAMA_SOURCE_DIR "/config/species/" + species + ".txtpb").rdbuf();
    return text.str();
}

TEST(Habits, ofThePreyAreRead) {
    const Habits scad = test::castMember("bigeye_scad").habits;
    EXPECT_EQ(scad.role, Role::Prey);
    EXPECT_FLOAT_EQ(scad.hunger.appetiteParticles, 4.0F);
    EXPECT_FLOAT_EQ(scad.hunger.digestionPerSecond, 0.004F);
    EXPECT_FLOAT_EQ(scad.libidoPerSecond, 0.0006F);
    EXPECT_TRUE(scad.spawnsInRush);
    EXPECT_FLOAT_EQ(scad.fear.metres, 1.6F);
    EXPECT_FLOAT_EQ(scad.fear.from, 0.25F);
    EXPECT_FLOAT_EQ(scad.fear.alone, 0.6F);
    EXPECT_DOUBLE_EQ(scad.shares.schooling, 1);
    EXPECT_DOUBLE_EQ(scad.shares.darkness, 0);
    EXPECT_DOUBLE_EQ(scad.comfort.depthMetres.most, 30);
    EXPECT_DOUBLE_EQ(scad.comfort.bestDepthMetres, 9);
    EXPECT_DOUBLE_EQ(scad.comfort.light.least, 0.25);
    EXPECT_DOUBLE_EQ(scad.comfort.waterCelsius.most, 30);
    EXPECT_DOUBLE_EQ(scad.paces.medium, 0.65);
    EXPECT_DOUBLE_EQ(scad.gradualShare, 0.85);
    EXPECT_FLOAT_EQ(scad.visionBodyLengths, 14.0F);
    EXPECT_FLOAT_EQ(scad.box.aheadBodyLengths, 1.2F);
    EXPECT_FLOAT_EQ(scad.persistence, 0.2F);
    EXPECT_EQ(scad.home.kind, HomeKind::School);
    EXPECT_EQ(scad.hours.active, Activity::Always);
    EXPECT_TRUE(scad.hunger.eatsPlankton);
    EXPECT_TRUE(scad.hunts.empty());
}

TEST(Habits, ofAPacifistAreRead) {
    const Habits tang = test::castMember("blue_tang").habits;
    EXPECT_EQ(tang.role, Role::Pacifist);
    EXPECT_FLOAT_EQ(tang.libidoPerSecond, 0.003F);
    EXPECT_FALSE(tang.spawnsInRush);
    EXPECT_EQ(tang.home.kind, HomeKind::Place);
    EXPECT_LT(tang.home.radiusMetres, tang.home.leashMetres);
    EXPECT_TRUE(tang.home.onTheReef);
    EXPECT_DOUBLE_EQ(tang.pairBodyLengths, 3);
    EXPECT_EQ(tang.hours.active, Activity::Day);
    EXPECT_DOUBLE_EQ(tang.hours.retires, 0.45);
    EXPECT_DOUBLE_EQ(tang.hours.rises, 0.4);
    EXPECT_FALSE(test::castMember("parrotfish").habits.hunger.eatsPlankton) << "it grazes";
    EXPECT_THAT(test::castMember("trumpetfish").habits.shadows,
                testing::ElementsAre("parrotfish", "blue_tang"));
}

TEST(Habits, ofThePredatorAreReadWithItsPreyInOrder) {
    const Habits shark = test::castMember("blacktip_reef_shark").habits;
    EXPECT_EQ(shark.role, Role::Predator);
    EXPECT_THAT(shark.hunts,
                testing::ElementsAre("bigeye_scad",
                                     "fusilier",
                                     "sea_goldie",
                                     "green_chromis",
                                     "sergeant",
                                     "powder_blue_tang",
                                     "blue_tang",
                                     "parrotfish"));
    EXPECT_DOUBLE_EQ(shark.hunt.chaseSeconds, 8);
    EXPECT_DOUBLE_EQ(shark.hunt.giveUpMetres, 6);
    EXPECT_DOUBLE_EQ(shark.hunt.restSeconds, 120);
    EXPECT_DOUBLE_EQ(shark.hunt.restByDaySeconds, 240);
    EXPECT_FALSE(shark.hunt.ambush) << "it stalks";
    EXPECT_FLOAT_EQ(shark.fear.metres, 0.0F) << "it fears nobody";
    EXPECT_FALSE(shark.hunger.eatsPlankton);
}

TEST(Habits, ofOneThatHuntsFromAmbushAreRead) {
    const Habits trumpetfish = test::castMember("trumpetfish").habits;
    ASSERT_TRUE(trumpetfish.hunt.ambush);
    EXPECT_DOUBLE_EQ(trumpetfish.hunt.ambush->hangsDegrees, 60);
    EXPECT_EQ(trumpetfish.hunt.ambush->posts, 1U);
    EXPECT_DOUBLE_EQ(trumpetfish.hunt.restByDaySeconds, trumpetfish.hunt.restSeconds)
        << "where only one rest is given";
}

struct Mistake {
    const char* name;
    const char* species;
    const char* right;  // as the species' file has it
    const char* wrong;
    const char* at;  // the error points to the first of this in the mistake's text
    const char* says;
};

// file:line:column of a position, by counting.
std::string placeOf(const std::string& text, std::size_t position) {
    const auto end = text.begin() + static_cast<long>(position);
    const auto line = std::count(text.begin(), end, '\n') + 1;
    const std::size_t before = text.rfind('\n', position - 1);
    return "fish.txtpb:" + std::to_string(line) + ":" + std::to_string(position - before) + ": ";
}

class HabitMistake : public testing::TestWithParam<Mistake> {};

TEST_P(HabitMistake, isRefusedInOneLineThatNamesThePlace) {
    const Mistake& mistake = GetParam();
    std::string text = fileOf(mistake.species);
    const std::size_t start = text.find(mistake.right, text.find("habits {"));
    ASSERT_NE(start, std::string::npos);
    text.replace(start, std::string(mistake.right).size(), mistake.wrong);
    const std::string at = mistake.at;
    const std::size_t wrong =
        at.front() == '^' ? text.find(at.substr(1), text.find("\nhabits {")) : text.find(at, start);
    ASSERT_NE(wrong, std::string::npos);
    try {
        static_cast<void>(parseSpecies(text, "fish.txtpb"));
        FAIL() << "accepted";
    } catch (const Error& error) {
        const std::string said = error.what();
        EXPECT_THAT(said, StartsWith(placeOf(text, wrong)));
        EXPECT_THAT(said, HasSubstr(mistake.says));
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
}

// `at` with a ^ in front is looked for from the beginning of the habits.
INSTANTIATE_TEST_SUITE_P(
    Each,
    HabitMistake,
    testing::Values(
        Mistake{"anUnknownRole", "bigeye_scad", "role: PREY", "role: MERMAID", "hunger", "MERMAID"},
        Mistake{"noRole", "bigeye_scad", "role: PREY", "", "^habits", "lacks role"},
        Mistake{"noPlankton", "bigeye_scad", " plankton: true", "", "^hunger", "lacks plankton"},
        Mistake{"noFear",
                "bigeye_scad",
                "fear { whole_m: 1.6 heeded_from: 0.25 alone_from: 0.6 }",
                "",
                "^role",
                "add fear"},
        Mistake{"thresholdsExchanged",
                "bigeye_scad",
                "heeded_from: 0.25 alone_from: 0.6",
                "heeded_from: 0.6 alone_from: 0.25",
                "alone_from",
                "must be more than heeded_from"},
        Mistake{"aFearPastAll",
                "bigeye_scad",
                "alone_from: 0.6",
                "alone_from: 1.6",
                "alone_from",
                "must be from 0 to 1"},
        Mistake{"preyThatHunts",
                "bigeye_scad",
                "persistence: 0.2",
                "hunt { prey: \"clownfish\" chase_s: 1 give_up_m: 1 rest_s: 1 } persistence: 0.2",
                "hunt",
                "only a predator hunts"},
        Mistake{"aRushOfWhoNeverMates",
                "blacktip_reef_shark",
                "persistence: 0.7",
                "persistence: 0.7 spawns: RUSH",
                "spawns",
                "it never mates"},
        Mistake{"aPacifistThatSchools",
                "clownfish",
                "shares {",
                "shares { schooling: 1",
                "schooling",
                "only prey schools"},
        Mistake{"aPredatorThatFears",
                "blacktip_reef_shark",
                "persistence: 0.7",
                "persistence: 0.7 fear { whole_m: 1 heeded_from: 0.2 alone_from: 0.5 }",
                "fear",
                "fears nobody"},
        Mistake{"aPredatorThatPairs",
                "blacktip_reef_shark",
                "persistence: 0.7",
                "persistence: 0.7 pair_bl: 2",
                "pair_bl",
                "keeps no partner"},
        Mistake{"aPredatorWithoutPrey",
                "blacktip_reef_shark",
                "prey: \"bigeye_scad\"\n    prey: \"fusilier\"\n    prey: \"sea_goldie\"\n"
                "    prey: \"green_chromis\"\n    prey: \"sergeant\"\n"
                "    prey: \"powder_blue_tang\"\n    prey: \"blue_tang\"\n"
                "    prey: \"parrotfish\"",
                "",
                "^hunt {",
                "lacks prey"},
        Mistake{"aCannibal",
                "blacktip_reef_shark",
                "prey: \"blue_tang\"",
                "prey: \"blacktip_reef_shark\"",
                "prey",
                "names the species itself"},
        Mistake{"preyNamedTwice",
                "blacktip_reef_shark",
                "prey: \"blue_tang\"",
                "prey: \"bigeye_scad\"",
                "prey",
                "twice"},
        Mistake{"itsOwnShadow",
                "trumpetfish",
                "shadows: \"parrotfish\"",
                "shadows: \"trumpetfish\"",
                "shadows",
                "names the species itself"},
        Mistake{"likesThatContradict",
                "bigeye_scad",
                "brightness: 1",
                "brightness: 0.7 darkness: 0.4",
                "darkness",
                "no fish likes both"},
        Mistake{"pacesThatDoNotSum",
                "bigeye_scad",
                "medium: 0.65",
                "medium: 0.6",
                "^paces",
                "must sum to 1"},
        Mistake{"aNegativePace",
                "bigeye_scad",
                "medium: 0.65",
                "medium: -0.65",
                "medium",
                "must be from"},
        Mistake{"depthsExchanged",
                "bigeye_scad",
                "least_depth_m: 2",
                "least_depth_m: 32",
                "most_depth_m",
                "must be more than least_depth_m"},
        Mistake{"aBestDepthBelowAll",
                "bigeye_scad",
                "best_depth_m: 9",
                "best_depth_m: 40",
                "best_depth_m",
                "must be from least_depth_m to most_depth_m"},
        Mistake{"lightsExchanged",
                "bigeye_scad",
                "least_light: 0.25 most_light: 1",
                "least_light: 1 most_light: 0.25",
                "most_light",
                "exchange them"},
        Mistake{"ice", "bigeye_scad", "coldest_c: 22", "coldest_c: -20", "coldest_c", "must be"},
        Mistake{"aNoseWorseThanItsEyes",
                "bigeye_scad",
                "smell_bl: 16",
                "smell_bl: 10",
                "smell_bl",
                "is less than vision_bl"},
        Mistake{"noBox", "bigeye_scad", "ahead_bl: 1.2", "ahead_bl: 0", "ahead_bl", "must be"},
        Mistake{"aPersistenceThatIsNaN",
                "bigeye_scad",
                "persistence: 0.2",
                "persistence: nan",
                "persistence",
                "must be from"},
        Mistake{"aSchoolWithARadius",
                "bigeye_scad",
                "kind: SCHOOL",
                "kind: SCHOOL radius_m: 2",
                "radius_m",
                "has no radius_m"},
        Mistake{"aStrikeFromFartherThanItNotices",
                "trumpetfish",
                "strikes_m: 0.12",
                "strikes_m: 2",
                "strikes_m",
                "more than notices_m"},
        Mistake{"postsWithoutAKindOfSite",
                "trumpetfish",
                "hangs_deg: 60",
                "posts: 3",
                "posts",
                "posts are sites of its home"},
        Mistake{"aCleanerWithoutAHome",
                "cleaner_wrasse",
                "home { kind: PLACE radius_m: 0.35 leash_m: 1.5 at: CLEANING }",
                "",
                "cleans",
                "it cleans at its home"},
        Mistake{"preyThatCleans",
                "bigeye_scad",
                "persistence: 0.2",
                "cleans { inspect_s: 12 } persistence: 0.2",
                "cleans",
                "only a pacifist cleans"},
        Mistake{"aLonerAtHomeWithTheSchool",
                "clownfish",
                "kind: PLACE radius_m: 0.35 leash_m: 1 at: ANEMONE",
                "kind: SCHOOL",
                "kind",
                "nobody of this species schools"},
        Mistake{"aLeashShorterThanTheHome",
                "clownfish",
                "leash_m: 1",
                "leash_m: 0.2",
                "leash_m",
                "less than radius_m"},
        Mistake{"nothingToEat",
                "clownfish",
                "plankton: true",
                "plankton: false",
                "plankton",
                "eat nothing"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace aquarama::config
