// SPDX-License-Identifier: Apache-2.0
#include "common/config/species.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/support/all_species.h"

namespace aquarama::config {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

const std::string kPath = AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb";

std::string scadText() {
    std::ostringstream text;
    text << std::ifstream(kPath).rdbuf();
    return text.str();
}

// The scad's file with one place changed.
std::string edited(const std::string& from, const std::string& to) {
    std::string text = scadText();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string refusalOf(const std::string& text) {
    try {
        static_cast<void>(parseSpecies(text, "fish.txtpb"));
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Species, theScadIsReadInItsUnits) {
    const Species scad = readSpecies(kPath);
    EXPECT_EQ(scad.name, "bigeye_scad");
    EXPECT_FLOAT_EQ(scad.size.meanMetres, 0.24F);
    EXPECT_EQ(scad.profile.stations.size(), 15U);
    EXPECT_FLOAT_EQ(scad.fins.pelvic.angleRadians, 0.34906585F);
    EXPECT_NEAR(scad.swim.backLagRadians, 123.7 * 3.14159265358979 / 180, 1e-9);
    EXPECT_DOUBLE_EQ(scad.skeleton.rings[1].nodeMass, 11);
}

// A gait that rows and beats the tail, a stroke without a beat, a fin twisted by more than half a
// turn. The error names the line of the gait.
TEST(Species, finsThatCannotRowAreRefused) {
    EXPECT_THAT(refusalOf(edited("slow { beat_hz: 2 gain: 0.793 }",
                                 "\nslow { beat_hz: 2 gain: 0.793\nrows: 1 }")),
                testing::AllOf(testing::HasSubstr("a gait that rows has gain: 0"),
                               testing::HasSubstr("fish.txtpb:117:1: ")));
    EXPECT_THAT(refusalOf(edited("beat_hz: 2.5 stroke_deg: 55", "beat_hz: 0 stroke_deg: 55")),
                testing::HasSubstr("row at 0.1 Hz at least"));
    EXPECT_THAT(refusalOf(edited("feather_deg: 80", "feather_deg: 80 twist_deg: 120")),
                testing::HasSubstr("more than 180 degrees"));
}

// Of the scad's file with another version; the rest of it is unknown to a reader of another one.
std::string refusalOfVersion(const std::string& version) {
    return refusalOf("# A fish.\n" + version + " unheard_of { of: 1 }\n" +
                     edited("version: 2\n", ""));
}

TEST(Species, aFileOfAnotherVersionIsRefusedForThatAloneAtItsPlace) {
    const std::string earlier =
        " of a species is of an earlier release; this one reads version 2: docs/species.md says "
        "what has changed";
    EXPECT_EQ(refusalOfVersion(""), "fish.txtpb:1:1: version 1" + earlier) << "left out";
    EXPECT_EQ(refusalOfVersion("version: 1"), "fish.txtpb:2:10: version 1" + earlier);
    EXPECT_EQ(refusalOfVersion("version: 3"),
              "fish.txtpb:2:10: version 3 of a species is of a later release; this one reads up to "
              "version 2: update the programs");
}

TEST(Species, aVersionThatIsNoWholeNumberIsRefusedAsSuch) {
    EXPECT_EQ(refusalOf(edited("version: 2", "version: \"2\"")).find("of an earlier release"),
              std::string::npos);
    EXPECT_THAT(refusalOf(edited("version: 2", "version: \"2\"")),
                HasSubstr("write a whole number"));
}

struct WrongSpecies {
    const char* name;
    const char* right;  // as the scad's file has it
    const char* wrong;
    const char* says;
};

class SpeciesMistake : public testing::TestWithParam<WrongSpecies> {};

TEST_P(SpeciesMistake, isRefusedAtItsPlaceWithWhatToDo) {
    const std::string refusal = refusalOf(edited(GetParam().right, GetParam().wrong));
    EXPECT_THAT(refusal, MatchesRegex("fish\\.txtpb:[0-9]+:[0-9]+: .*"));
    EXPECT_THAT(refusal, HasSubstr(GetParam().says));
}

const char* const kAnalFront = "base { s: 0.505 y: -0.105 }";

INSTANTIATE_TEST_SUITE_P(
    Each,
    SpeciesMistake,
    testing::Values(
        WrongSpecies{
            "aMissingField", "tail_tip_mass: 0.165", "", "skeleton lacks tail_tip_mass: add it"},
        WrongSpecies{"anUnknownField", "eye {", "wings: 2 eye {", "wings"},
        WrongSpecies{
            "aNegativeMass", "node_mass: 11", "node_mass: -11", "node_mass is -11: it must be"},
        WrongSpecies{
            "noMass", "nose_mass: 1.1", "nose_mass: 0", "nose_mass is 0: it must be from 0.001"},
        WrongSpecies{"anInfiniteMass", "node_mass: 11", "node_mass: inf", "node_mass is inf"},
        WrongSpecies{"noNumber", "drag: 452", "drag: nan", "drag is nan: it must be from 0"},
        WrongSpecies{
            "aBeatThatNoFishHas", "beat_hz: 3", "beat_hz: 300", "beat_hz is 300: it must be"},
        WrongSpecies{
            "ringsOutOfOrder", "rings { s: 0.580", "rings { s: 0.380", "move this one back"},
        WrongSpecies{
            "aFlatRing", "half_height: 0.093", "half_height: 0", "half_height is 0: it must be"},
        WrongSpecies{
            "aThinRing", "half_width: 0.051", "half_width: 0", "half_width is 0: it must be"},
        WrongSpecies{"fourRings",
                     "rings { s: 0.850 half_height: 0.040 half_width: 0.010 node_mass: 1.1 }",
                     "",
                     "skeleton has 4 rings: give 5"},
        WrongSpecies{
            "aBodyWithoutHeight", "s: 0.380 up: 0.113", "s: 0.380 up: 0", "up is 0: it must be"},
        WrongSpecies{
            "aSectionWithCorners", "full_up: 2.1", "full_up: 9", "full_up is 9: it must be"},
        WrongSpecies{"aFinThatTurnsOver",
                     "stroke_deg: 55",
                     "stroke_deg: 180",
                     "stroke_deg is 180: it must be"},
        WrongSpecies{"aFinThatOpensOntoItsHead",
                     "open_deg: 90",
                     "open_deg: 130",
                     "open_deg is 130: it must be"},
        WrongSpecies{"aRippleWithoutWaves", "waves: 1.5", "", "hovering lacks waves: add it"},
        WrongSpecies{"aThreadOfOnePoint",
                     "eye {",
                     "threads { at { s: 0.5 y: 0 } root_width: 0.01 } eye {",
                     "threads has 1 at: give 2 to 32"},
        WrongSpecies{"anEyeOnAStalk", "bulge: 0.2", "bulge: 3", "bulge is 3: it must be"},
        WrongSpecies{"profileOutOfOrder", "profile { s: 0.10", "profile { s: 0.01", "sort them"},
        WrongSpecies{"profileThatStartsLate",
                     "profile { s: 0.00",
                     "profile { s: 0.01",
                     "must begin at s: 0"},
        WrongSpecies{"dorsalFinsThatOverlap",
                     "base { s: 0.465 y: 0.105 }",
                     "base { s: 0.440 y: 0.105 }",
                     "second_dorsal begins before first_dorsal ends: move it back"},
        WrongSpecies{"aDorsalFinOnTheNose",
                     "base { s: 0.325 y: 0.106 }",
                     "base { s: 0.02 y: 0.02 }",
                     "first_dorsal begins on the head"},
        WrongSpecies{"aDorsalFinOnTheTail",
                     "base { s: 0.765 y: 0.027 }",
                     "base { s: 0.865 y: 0.027 }",
                     "second_dorsal ends behind the last profile station: shorten it"},
        WrongSpecies{"anAnalFinOnTheBreast",
                     kAnalFront,
                     "base { s: 0.3 y: -0.1 }",
                     "anal begins before pelvic ends: move it back"},
        WrongSpecies{"aFinThatRunsHeadwards",
                     "base { s: 0.360 y: 0.108 }",
                     "base { s: 0.320 y: 0.108 }",
                     "must run from head to tail: sort it"},
        WrongSpecies{
            "aFinOfOnePoint",
            "edge { s: 0.385 y: -0.160 } edge { s: 0.397 y: -0.150 } edge { s: 0.395 y: -0.132 }",
            "edge { s: 0.385 y: -0.160 }",
            "has 1 edge: give 2 to 32"},
        WrongSpecies{"aPectoralFinOnTheNose",
                     "base { s: 0.268 y: 0.000 }",
                     "base { s: 0.01 y: 0.000 }",
                     "base of pectoral must lie behind the head"},
        WrongSpecies{"aPectoralFinWithoutABase",
                     "base { s: 0.268 y: 0.000 }",
                     "base { s: 0.268 y: -0.036 }",
                     "ends where it begins: spread it"},
        WrongSpecies{
            "sizesExchanged", "least_m: 0.20", "least_m: 0.25", "least_m is more than mean_m"},
        WrongSpecies{"aColourBeyondWhite", "blue: 0.79", "blue: 1.79", "blue is 1.79: it must be"},
        WrongSpecies{"aNameThatIsNoFileName", "\"bigeye_scad\"", "\"../scad\"", "rename it"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(Species, howFinsMoveIsReadInRadiansAndRowingChangesTheCapture) {
    const std::string text = edited("stroke_deg: 55", "stroke_deg: 45");
    const FinMotion motion = parseSpecies(text, "fish.txtpb").finMotion;
    EXPECT_FLOAT_EQ(motion.rowing.strokeRadians, 0.7853982F);
    EXPECT_FLOAT_EQ(motion.hovering.waves, 1.5F);
    EXPECT_FALSE(motion.hovering.isOpposed);
    EXPECT_NE(parseSpecies(text, "fish.txtpb").motion, readSpecies(kPath).motion);
    const std::string rippled = edited("waves: 1.5", "waves: 1.2");
    EXPECT_EQ(parseSpecies(rippled, "fish.txtpb").motion, readSpecies(kPath).motion);
}

TEST(Species, theOnlyDorsalFinMayNotReachTheTail) {
    std::string text = scadText();
    const std::size_t from = text.find("  second_dorsal {");
    text.erase(from, text.find("  anal {") - from);
    EXPECT_EQ(refusalOf(text), "accepted");
    const std::string rear = "base { s: 0.450 y: 0.106 }";
    text.replace(text.find(rear), rear.size(), "base { s: 0.950 y: 0.106 }");
    EXPECT_THAT(refusalOf(text), HasSubstr("first_dorsal ends behind the last profile station"));
}

TEST(Species, keepsItsControlPointsOnlyIfItSaysSo) {
    EXPECT_TRUE(parseSpecies(scadText(), "fish.txtpb").recordsControlPoints);
    const std::string text = edited("recorded_control_points: true", "");
    EXPECT_FALSE(parseSpecies(text, "fish.txtpb").recordsControlPoints);
}

TEST(Species, allOfTheCastAreReadUnderTheirFilesNames) {
    for (const std::string& name : test::allSpeciesNames())
        EXPECT_EQ(test::castMember(name).name, name);
}

TEST(Species, aFileThatIsNotThereIsRefused) {
    EXPECT_THROW(static_cast<void>(readSpecies("no/such/fish.txtpb")), Error);
}

}  // namespace
}  // namespace aquarama::config
