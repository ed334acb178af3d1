// SPDX-License-Identifier: Apache-2.0
// However a fish is ordered about, its body never jumps.
#include "common/motion/reconstruct.h"
#include "tests/common/motion/captured_species.h"
#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

constexpr std::size_t kFish = 4096;
constexpr int kSwitches = 150000;     // of each of seven species: a million
constexpr double kRateMargin = 0.15;  // of the secondary controller

float furthest(const body::NodalPoints& from, const body::NodalPoints& to) {
    float most = 0;
    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
        const glm::vec3 d = to[i] - from[i];
        most = std::max(most, d.x * d.x + d.y * d.y + d.z * d.z);
    }
    return std::sqrt(most);
}

body::NodalPoints poseOf(const Repertoire& repertoire, const FishRecord& record) {
    body::NodalPoints nodes;
    nodalPose(repertoire, present(record, record, 1.0F, {}), nodes);
    return nodes;
}

// At the recorded rates, from every phase.
float largestStepOf(const Repertoire& repertoire, const MotorTables& tables) {
    float most = 0;
    for (int action = 0; action < kActions; ++action) {
        const int rate = recordedPhaseRate(tables, static_cast<Action>(action));
        FishRecord record{.segment = firstSegmentOf(static_cast<Action>(action))};
        for (int phase = 0; phase < 65536; phase += 128) {
            record.phase = static_cast<std::uint16_t>(phase);
            const body::NodalPoints now = poseOf(repertoire, record);
            record.phase = static_cast<std::uint16_t>(phase + rate);
            most = std::max(most, furthest(now, poseOf(repertoire, record)));
        }
    }
    return most;
}

// Any action, glides among them, at any rate that the controller may ask for.
void orderAbout(School& school, std::mt19937& random) {
    std::uniform_real_distribution<double> tempo(1 - kRateMargin, 1 + kRateMargin);
    for (std::size_t i = 0; i < kFish; ++i) {
        if (random() % 8 != 0) continue;
        school.command(i, static_cast<Action>(random() % kActions));
        const double rate = school.commands.phaseRate[i] * tempo(random);
        school.commands.phaseRate[i] = static_cast<std::int16_t>(rate);
    }
}

bool isWarping(const FishRecord& record) {
    return record.warpFrame != record.warpLength;
}

class Switches : public OfEachSpecies {};

TEST_P(Switches, noNodalPointMovesFurtherInATickThanAQuarterMoreThanTheRecordingsDo) {
    const Repertoire& repertoire = repertoireOf(GetParam());
    const MotorTables& tables = tablesOf(GetParam());
    const float allowed = 1.25F * largestStepOf(repertoire, tables);
    std::mt19937 random(21);
    School school(kFish, tables);
    scatter(school, random);
    float furthestStep = 0;
    int switches = 0;
    for (int tick = 0; switches < kSwitches; ++tick) {
        orderAbout(school, random);
        const MotionStates last = school.states;
        school.tick();
        for (std::size_t i = 0; i < kFish; ++i) {
            const FishRecord before = recordOf(last, i);
            const FishRecord after = recordOf(school.states, i);
            const bool switched = after.segment != before.segment;
            switches += switched ? 1 : 0;
            // What a segment shows by itself is soon seen; warps are all looked at.
            if (tick >= 60 && !switched && !isWarping(before) && !isWarping(after)) continue;
            furthestStep = std::max(
                furthestStep, furthest(poseOf(repertoire, before), poseOf(repertoire, after)));
        }
    }
    EXPECT_LE(furthestStep, allowed);
    RecordProperty("share_of_allowed", std::to_string(furthestStep / allowed));
}

INSTANTIATE_TEST_SUITE_P(All,
                         Switches,
                         testing::ValuesIn(allSpeciesNames()),
                         OfEachSpecies::suffix);

}  // namespace
}  // namespace aquarama::motion
