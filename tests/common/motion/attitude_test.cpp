// SPDX-License-Identifier: Apache-2.0
// What was recorded level and heading along x is the same motion wherever a fish looks, and keeps
// it upright.
#include "common/motion/motor_tables.h"
#include "tests/common/motion/captured_species.h"
#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

constexpr std::array<Action, 5> kStraight{Action::ForwardSlow,
                                          Action::ForwardMedium,
                                          Action::ForwardFast,
                                          Action::Glide,
                                          Action::Retreat};

glm::quat looking(double headingDegrees, double pitchDegrees) {
    return aboutAxis(headingDegrees, {0, 1, 0}) * aboutAxis(pitchDegrees, {0, 0, 1});
}

std::int16_t pitchCommand(double degrees) {
    return static_cast<std::int16_t>(std::lround(std::sin(degrees * kDegree) * 32768));
}

// The second fish swims as the first, but along another course and in another size.
class Twins {
  public:
    Twins(const MotorTables& tables, Action action, double heading, double pitch, int millimetres)
        : school_(2, tables), turn_(looking(heading, pitch)) {
        const std::array<double, 2> pitches{0, pitch};
        for (const std::size_t fish : {0U, 1U}) {
            school_.play(fish, action);
            school_.commands.pitch[fish] = pitchCommand(pitches[fish]);
        }
        // The mean frames, not the swaying body frames, lie along the two courses.
        const glm::quat sway = glm::quat(glm::conjugate(school_.mean(0)));
        setBodyFrame(school_.states, 0, {glm::vec3(0), sway});
        setBodyFrame(school_.states, 1, {glm::vec3(0), turn_ * sway});
        school_.traits[0].lengthMillimetres = 1000;
        school_.traits[1].lengthMillimetres = static_cast<std::uint16_t>(millimetres);
    }
    School& school() { return school_; }

    // Body lengths between the first fish's path, turned and scaled, and the second's.
    [[nodiscard]] double apart() const {
        const double small = school_.traits[0].lengthMillimetres * 1e-3;
        const double large = school_.traits[1].lengthMillimetres * 1e-3;
        const glm::dvec3 expected = glm::dquat(turn_) * school_.place(0) / small;
        return glm::length(school_.place(1) / large - expected);
    }
    // Degrees between the two orientations, the first turned.
    [[nodiscard]] double askew() const {
        const glm::quat expected = turn_ * bodyFrameOf(school_.states, 0).rotation;
        const glm::dquat d = glm::conjugate(expected) * bodyFrameOf(school_.states, 1).rotation;
        return 2 * std::asin(std::min(1.0, std::hypot(d.x, d.y, d.z))) / kDegree;
    }
    [[nodiscard]] bool areInStep() const {
        const MotionStates& s = school_.states;
        return s.phase[0] == s.phase[1] && s.segment[0] == s.segment[1] && s.speed[0] == s.speed[1];
    }

  private:
    School school_;
    glm::quat turn_;
};

class Attitude : public OfEachSpecies {};

// A tick rounds a place to 2^-17 m and an orientation to 3e-6 rad; in a glide it is always the same
// step that is rounded.
TEST_P(Attitude, swimmingIsTheSameAtAnyHeadingPitchAndSize) {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> heading(-180, 180);
    std::uniform_real_distribution<double> pitch(-60, 60);
    for (int trial = 0; trial < 40; ++trial) {
        const Action action = kStraight[static_cast<std::size_t>(trial) % kStraight.size()];
        const int length = static_cast<int>(400 + random() % 4000);
        Twins twins(tablesOf(GetParam()), action, heading(random), pitch(random), length);
        for (int tick = 0; tick < 300; ++tick) {
            twins.school().tick();
            ASSERT_TRUE(twins.areInStep());
            ASSERT_LT(twins.askew(), 0.02) << nameOf(action);
        }
        EXPECT_LT(twins.apart(), 0.01) << nameOf(action);
    }
}

TEST_P(Attitude, turningIsTheSameAtAnyHeadingAndSize) {
    std::mt19937 random(32);
    std::uniform_real_distribution<double> heading(-180, 180);
    for (int action = 0; action < kActions; ++action) {
        if (!isTurn(static_cast<Action>(action))) continue;
        for (int trial = 0; trial < 10; ++trial) {
            const int length = static_cast<int>(400 + random() % 4000);
            Twins twins(tablesOf(GetParam()), Action::ForwardMedium, heading(random), 0, length);
            for (const std::size_t fish : {0U, 1U})
                twins.school().command(fish, static_cast<Action>(action));
            for (int tick = 0; tick < 250; ++tick) {
                twins.school().tick();
                ASSERT_TRUE(twins.areInStep());
                ASSERT_LT(twins.askew(), 0.05) << nameOf(static_cast<Action>(action));
            }
            EXPECT_LT(twins.apart(), 0.02) << nameOf(static_cast<Action>(action));
        }
    }
}

// Of the increment itself, which steering follows only afterwards: on its side or on its back, a
// fish goes the same way in its own axes.
TEST_P(Attitude, aTickGoesTheSameWayInTheBodysAxesHoweverTheBodyLies) {
    std::mt19937 random(33);
    std::normal_distribution<float> normal;
    constexpr std::size_t kFish = 512;
    School level(kFish, tablesOf(GetParam()));
    School lying(kFish, tablesOf(GetParam()));
    std::vector<glm::dquat> lies;
    for (std::size_t i = 0; i < kFish; ++i) {
        const auto action = static_cast<Action>(random() % kActions);
        const auto phase = static_cast<std::uint16_t>(random());
        for (School* school : {&level, &lying}) {
            school->play(i, action);
            school->states.phase[i] = phase;
            school->traits[i].lengthMillimetres = 4000;
        }
        const glm::quat any(normal(random), normal(random), normal(random), normal(random));
        setBodyFrame(lying.states, i, {glm::vec3(0), glm::normalize(any)});
        lies.emplace_back(bodyFrameOf(lying.states, i).rotation);
    }
    level.tick();
    lying.tick();
    for (std::size_t i = 0; i < kFish; ++i) {
        const glm::dvec3 moved = glm::conjugate(lies[i]) * lying.place(i);
        EXPECT_LT(glm::distance(moved, level.place(i)), 4.0 / 65536) << "fish " << i;
    }
}

// The commanded pitch less the present one, as sines.
float pitchError(const School& school, std::size_t fish) {
    return static_cast<float>(school.commands.pitch[fish]) / 32768.0F -
           static_cast<float>(std::sin(school.pitch(fish) * kDegree));
}

// A slope, or pitching in place, is left where it would lead away from the commanded pitch, as the
// secondary controller does.
void endSlope(School& school, std::size_t fish) {
    const auto commanded = static_cast<Action>(school.commands.action[fish]);
    if (!pitches(commanded)) return;
    const float off = pitchError(school, fish);
    const bool climbs =
        commanded == Action::PitchUp || (isSlope(commanded) && commanded < Action::DiveSlow);
    if (takesSlope(commanded, off) && climbs == (off > 0)) return;
    school.command(fish, isSlope(commanded) ? gaitOf(commanded) : Action::Hover);
}

// The roll of a fish that pitches on a curve, degrees: the played yaw is about its own axis and so
// rolls it, until the levelling rolls it back as fast.
double rollOnCurve(const School& school, std::size_t fish) {
    const double yaw = double{recordedTurnRate(*school.tables, school.states.segment[fish])};
    const double rolls =
        std::abs(yaw * std::sin(school.pitch(fish) * kDegree));  // radians a second
    return rolls / (double{kRollGain} * kTicksPerSecond) / kDegree;
}

// Told at random to turn either way and to climb or dive, a fish may bank; but a second and a half
// after its last turn it is upright. What a curve rolled it goes at the rate of the levelling.
TEST_P(Attitude, whenNotManoeuvringAFishIsUprightWithinFiveDegrees) {
    std::mt19937 random(34);
    constexpr std::size_t kFish = 128;
    constexpr int kCalmTicks = 90;
    School school(kFish, tablesOf(GetParam()));
    std::vector<int> calm(kFish);
    std::vector<double> leans(kFish);  // degrees
    int looks = 0;
    double worst = 0;
    for (std::size_t i = 0; i < kFish; ++i) school.play(i, Action::ForwardMedium);
    for (int tick = 0; tick < 60 * 60; ++tick) {
        for (std::size_t i = 0; i < kFish; ++i) {
            if (random() % 100 == 0) {
                school.command(i, static_cast<Action>(random() % kActions));
                const double pitch = std::uniform_real_distribution<double>(-45, 45)(random);
                school.commands.pitch[i] = pitchCommand(pitch);
                school.commands.yawRate[i] = static_cast<std::int16_t>(random() % 18000 - 9000);
            } else if (isTurn(static_cast<Action>(school.commands.action[i]))) {
                school.command(i, kStraight[random() % kStraight.size()]);  // one turn at a time
            }
            endSlope(school, i);
        }
        school.tick();
        for (std::size_t i = 0; i < kFish; ++i) {
            const auto action = actionOf(school.states.segment[i]);
            const bool turns = isTurn(action) || isStart(action) || pitches(action);
            calm[i] = turns ? 0 : calm[i] + 1;
            leans[i] = std::max(rollOnCurve(school, i), (1 - double{kRollGain}) * leans[i]);
            if (calm[i] < kCalmTicks || (tick + static_cast<int>(i)) % 8 != 0) continue;
            worst = std::max(worst, std::abs(school.roll(i)) - leans[i]);
            ++looks;
        }
    }
    EXPECT_GT(looks, 5000);
    EXPECT_LT(worst, 5.0);
}

// A turn in a climb would tip the nose down and roll the fish (trap of body increments); pitch hold
// and levelling let it come out as it went in, on its new course.
TEST_P(Attitude, aTurnInAClimbChangesTheCourseAndLeavesTheClimb) {
    for (const double pitch : {-40.0, 30.0}) {
        School level(1, tablesOf(GetParam()));
        School climbing(1, tablesOf(GetParam()));
        setBodyFrame(climbing.states, 0, {glm::vec3(0), looking(0, pitch)});
        climbing.commands.pitch[0] = pitchCommand(pitch);
        for (School* school : {&level, &climbing}) {
            school->play(0, Action::ForwardMedium);
            school->tick(60);
            school->command(0, Action::TurnLeftSharp);
            school->tick();
            school->command(0, Action::ForwardMedium);
            school->tick(90);
            // What the turn did to the pitch is swum back, as the secondary controller does.
            const float off = pitchError(*school, 0);
            if (takesSlope(Action::ForwardMedium, off))
                school->command(0, slopeOf(Action::ForwardMedium, off > 0));
            for (int tick = 0; tick < 3000; ++tick) {
                endSlope(*school, 0);
                school->tick();
            }
        }
        EXPECT_NEAR(climbing.heading(0), level.heading(0), 16) << pitch;
        EXPECT_NEAR(climbing.pitch(0), pitch, 1);
        EXPECT_LT(std::abs(climbing.roll(0)), 1);
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         Attitude,
                         testing::ValuesIn(allSpeciesNames()),
                         OfEachSpecies::suffix);

}  // namespace
}  // namespace aquarama::motion
