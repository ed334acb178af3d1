// SPDX-License-Identifier: Apache-2.0
// Marks that a crew finds: crossings of the grid on the lit wall, within reach, far apart; and
// their words, which are read back here as a person counts lines.
#include "console/touch/wall_marks.h"

#include <algorithm>
#include <cmath>
#include <regex>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wall/pattern.h"
#include "common/wall/wall.h"

namespace aquarama::console {
namespace {

using testing::HasSubstr;

config::Rig rigNamed(const std::string& name) {
    return config::readRig("config/" + name + ".txtpb");
}

// Degrees that a person counts: lines of five from a bright one.
int counted(const std::string& line, const std::regex& negative) {
    static const std::regex kBright("(\\d+) degrees"), kLines("(\\d)(st|nd|rd|th) line");
    std::smatch found;
    int degrees = 0;
    if (std::regex_search(line, found, kBright)) degrees += std::stoi(found[1]);
    if (std::regex_search(line, found, kLines)) degrees += 5 * std::stoi(found[1]);
    return std::regex_search(line, negative) ? -degrees : degrees;
}

// Of "...: where UPRIGHT crosses LEVEL": degrees to the right and up.
std::pair<int, int> directionIn(const std::string& words) {
    static const std::regex kWhere("where (.*) crosses (.*)$"), kLeft("left"), kDown("below|down");
    std::smatch found;
    EXPECT_TRUE(std::regex_search(words, found, kWhere)) << words;
    return {counted(found[1], kLeft), counted(found[2], kDown)};
}

double areaOf(const WallMarks& marks) {
    return glm::length(
        glm::cross(marks[1].point - marks[0].point, marks[2].point - marks[0].point));
}

// Of each rig: on the wall, lit, on a crossing of the pattern, and where the words say.
TEST(WallMarks, areCrossingsThatTheWordsLeadTo) {
    for (const char* name : {"theatre", "flat_3", "televisions_3", "dome_5"}) {
        const config::Rig rig = rigNamed(name);
        const wall::Wall wall(rig);
        for (const WallMark& mark : marksForHands(rig, 0.8)) {
            const glm::dvec3 from = mark.point - wall.patternOrigin();
            EXPECT_NEAR(wall::gridLight(from), 0.7, 0.31) << name << ": " << mark.words;
            const auto [right, up] = directionIn(mark.words);
            EXPECT_NEAR(wall::azimuthOf(from) / kRadiansPerDegree<double>, right, 1e-6)
                << mark.words;
            EXPECT_NEAR(wall::elevationOf(from) / kRadiansPerDegree<double>, up, 1e-6)
                << mark.words;
            const glm::dvec2 off = glm::abs(wall.screen().unrolled(mark.point) - 0.5);
            EXPECT_LE(std::max(off.x, off.y), 0.4) << name;
            bool isLit = false;
            for (std::size_t i = 0; i < wall.channels(); ++i)
                isLit = isLit || wall.channel(i).pixelOf(mark.point);
            EXPECT_TRUE(isLit) << name << ": " << mark.words;
        }
        EXPECT_GT(areaOf(marksForHands(rig, 0.8)), 0.05) << name;
    }
}

TEST(WallMarks, ofTheTheatreAreWithinReachAndSaidInWords) {
    const config::Rig rig = rigNamed("theatre");
    const WallMarks marks = marksForHands(rig, 0.8);
    for (const WallMark& mark : marks) {
        EXPECT_LE(mark.point.y, 0.5) << "2.1 m above the floor";
        EXPECT_GE(mark.point.y, -1.0);
    }
    EXPECT_NEAR(marks[0].point.x, -marks[1].point.x, 1e-9);
    EXPECT_NEAR(marks[0].point.x, marks[2].point.x, 1e-9) << "the plane is upright";
    EXPECT_LT(marks[0].point.x, -1.5) << "far apart";
    EXPECT_THAT(marks[0].words, HasSubstr("45 degrees left, 10 degrees up"));
    EXPECT_THAT(marks[0].words,
                HasSubstr("where the 3rd line left of the bright one 30 degrees left crosses the "
                          "2nd line above the bright one at eye level"));
    EXPECT_LT(std::abs(marksForHands(rig, 0.4)[0].point.x), std::abs(marks[0].point.x));
}

TEST(WallMarks, forPeopleAreOnTheFloorAtTheWallAndAtTheSweetSpot) {
    const config::Rig rig = rigNamed("theatre");
    const WallMarks marks = marksForPeople(rig, 0.8);
    for (const WallMark& mark : marks) EXPECT_DOUBLE_EQ(mark.point.y, -1.6);
    for (const std::size_t i : {0U, 1U})
        EXPECT_NEAR(std::hypot(marks.at(i).point.x, marks.at(i).point.z), 2.62 - 0.3, 1e-9);
    EXPECT_LT(marks[0].point.x, 0);
    EXPECT_THAT(marks[0].words, HasSubstr("45 degrees left"));
    EXPECT_EQ(glm::dvec2(marks[2].point.x, marks[2].point.z), glm::dvec2(0));
    EXPECT_THAT(marks[2].words, HasSubstr("2.6 m from the wall"));
}

TEST(WallMarks, tooSmallAShareHasNone) {
    EXPECT_THROW(marksForHands(rigNamed("theatre"), 0.01), Error);
    EXPECT_THROW(marksForPeople(rigNamed("theatre"), 0.01), Error);
}

}  // namespace
}  // namespace aquarama::console
