// SPDX-License-Identifier: Apache-2.0
#include "common/config/species.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/units/error.h"

namespace aquarama {
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
    EXPECT_DOUBLE_EQ(scad.size.meanMetres, 0.24);
    EXPECT_EQ(scad.profile.stations.size(), 15U);
    EXPECT_FLOAT_EQ(scad.fins.pelvic.angleRadians, 0.34906585F);
    EXPECT_NEAR(scad.swim.backLagRadians, 0.643 * 3.14159265, 1e-6);
    EXPECT_DOUBLE_EQ(scad.skeleton.rings[1].nodeMass, 11);
}

TEST(Species, anUnknownFieldIsRefusedWithItsPlace) {
    EXPECT_THAT(refusalOf(edited("eye {", "wings: 2\neye {")),
                MatchesRegex("fish\\.txtpb:[0-9]+:[0-9]+: .*wings.*"));
}

TEST(Species, aMissingFieldIsNamed) {
    EXPECT_THAT(refusalOf(edited("tail_tip_mass: 0.165", "")),
                MatchesRegex("fish\\.txtpb:[0-9]+:[0-9]+: skeleton lacks tail_tip_mass.*"));
}

TEST(Species, aValueThatNoFishHasIsRefusedWithItsRange) {
    EXPECT_THAT(refusalOf(edited("beat_hz: 3", "beat_hz: 300")), HasSubstr("beat_hz is 300"));
    EXPECT_THAT(refusalOf(edited("drag: 570", "drag: -1")), HasSubstr("drag is -1"));
    EXPECT_THAT(refusalOf(edited("drag: 570", "drag: nan")), HasSubstr("drag is nan"));
}

TEST(Species, aBodyOutOfOrderIsRefused) {
    EXPECT_THAT(refusalOf(edited("profile { s: 0.10", "profile { s: 0.01")),
                HasSubstr("profile stations must begin at s: 0 and rise"));
    EXPECT_THAT(refusalOf(edited("rings { s: 0.580", "rings { s: 0.380")),
                HasSubstr("apart or more"));
    EXPECT_THAT(refusalOf(edited("base { s: 0.465 y: 0.105 }", "base { s: 0.440 y: 0.105 }")),
                HasSubstr("second_dorsal begins before first_dorsal ends"));
}

TEST(Species, aNameThatIsNoFileNameIsRefused) {
    EXPECT_THAT(refusalOf(edited("\"bigeye_scad\"", "\"../scad\"")), HasSubstr("rename it"));
}

TEST(Species, aFileThatIsNotThereIsRefused) {
    EXPECT_THROW(static_cast<void>(readSpecies("no/such/fish.txtpb")), Error);
}

}  // namespace
}  // namespace aquarama
