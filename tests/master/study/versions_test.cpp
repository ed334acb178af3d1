// SPDX-License-Identifier: Apache-2.0
// Whoever changes how fish move raises a version, and documents then show that their figures are of
// an earlier one (docs/studies.py --check).
#include <filesystem>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/base/digest.h"
#include "common/base/movement_versions.h"
#include "master/study/study.h"
#include "tests/common/motion/school.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::study {
namespace {

namespace fs = std::filesystem;

// A version and the digest of how fish move in it.
struct Entry {
    int version;
    std::uint64_t digest;
};
constexpr Entry kMotor{1, 0xa23d20ffaa81d337};
// The minds' digest is of fish that this version of the motor moves.
constexpr int kMotorOfMinds = 1;
constexpr Entry kMinds{2, 0x7b4c83918cb077c4};

constexpr const char* kVersions = "common/base/movement_versions.h";

std::string entryOf(int version, std::uint64_t digest) {
    return fmt::format("{{{}, {:#018x}}}", version, digest);
}

// Of eight fish of each species that play random commands for ten seconds.
std::uint64_t digestOfMotor() {
    std::uint64_t digest = 0;
    std::mt19937 random(1);
    for (const std::string& species : test::kCast) {
        motion::School school(8, *world::capturedTables(species));
        for (int tick = 0; tick < 600; ++tick) {
            motion::commandAtRandom(school, random);
            school.tick();
        }
        digest = foldedOne(digest, motion::hashOf(school.states));
    }
    return digest;
}

// Of a minute of a scene.
std::uint64_t digestOfScene(const Scenario& scenario, const fish::Adaptation& adaptation) {
    world::WorldOptions options = scenario.world;
    options.adaptation = adaptation;
    world::World world(options);
    Feeding feeding(scenario.ticksBetweenPinches, options.seed);
    for (int tick = 0; tick < 3600; ++tick) {
        feeding.before(world);
        world.advance();
    }
    return world.hash();
}

// Of the scenes of the study, with and without its adaptations, and of those of the routines.
std::uint64_t digestOfMinds() {
    const fs::path config = fs::path(test::sourceFolder()) / "config";
    std::uint64_t digest = 0;
    for (const Scenario& scenario : scenariosOf(config))
        for (const Condition& condition : {kConditions.front(), kConditions.back()})
            digest = foldedOne(digest, digestOfScene(scenario, condition.adaptation));
    for (const char* routine : {"ambush",
                                "charge",
                                "chase",
                                "clean",
                                "eat",
                                "escape",
                                "graze",
                                "hang",
                                "hide",
                                "leave",
                                "loop",
                                "mate",
                                "patrol",
                                "school",
                                "wander"})
        digest = foldedOne(
            digest,
            digestOfScene(
                readScenario(config / "scenes/routines" / (std::string(routine) + ".txtpb")), {}));
    return digest;
}

// What to do where a digest is another; the version is raised before.
std::string remedy(const char* version, bool isRaised, const char* entry) {
    return (isRaised ? std::string() : fmt::format("raise {} in {}; then ", version, kVersions)) +
           "enter the first in " + entry + " of this test";
}

TEST(Versions, ofTheMotorIsRaisedWhereItMovesFishOtherwise) {
    EXPECT_EQ(entryOf(kMotorVersion, digestOfMotor()), entryOf(kMotor.version, kMotor.digest))
        << remedy("kMotorVersion", kMotorVersion != kMotor.version, "kMotor");
}

// With another motor their digest is another, but their version need not be.
TEST(Versions, ofTheMindsIsRaisedWhereTheyDecideOtherwise) {
    const bool isRaised = kMindsVersion != kMinds.version || kMotorVersion != kMotorOfMinds;
    EXPECT_EQ(entryOf(kMindsVersion, digestOfMinds()), entryOf(kMinds.version, kMinds.digest))
        << remedy("kMindsVersion", isRaised, "kMinds");
    EXPECT_EQ(kMotorVersion, kMotorOfMinds) << "enter the first in kMotorOfMinds of this test";
}

}  // namespace
}  // namespace aquarama::study
