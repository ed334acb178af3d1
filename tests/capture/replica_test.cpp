// SPDX-License-Identifier: Apache-2.0
// The kinematic replica on what the simulated fish really swam: straight courses, level bodies,
// smooth changes.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/motion/motor.h"
#include "common/motion/reconstruct.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

constexpr double kDegrees = 57.29577951308232;

const motion::MotorTables& scadTables() {
    static const auto tables = motion::makeMotorTables(test::scadRepertoire());
    return *tables;
}

// One fish that plays captured segments.
class Replica {
  public:
    explicit Replica(motion::Action action) {
        states_.resize(1);
        commands_.resize(1);
        motion::setBodyFrame(states_, 0, {});
        states_.segment[0] = firstSegmentOf(action);
        command(action);
    }
    void command(motion::Action action) {
        commands_.action[0] = static_cast<std::uint8_t>(action);
        commands_.phaseRate[0] = motion::recordedPhaseRate(scadTables(), action);
    }
    void enterAt(int phase) { states_.phase[0] = static_cast<std::uint16_t>(phase); }
    void tick() {
        motion::MotorStep{.tables = &scadTables(),
                          .traits = traits_,
                          .commands = &commands_,
                          .states = &states_,
                          .first = 0,
                          .last = 1}
            .run();
    }
    [[nodiscard]] glm::quat meanFrame() const {
        return motion::meanRotation(scadTables(), states_, 0);
    }
    [[nodiscard]] glm::dvec3 place() const { return motion::bodyFrameOf(states_, 0).position; }
    [[nodiscard]] int ticksOf(int cycles) const { return cycles * 65536 / commands_.phaseRate[0]; }
    [[nodiscard]] int segment() const {
        return static_cast<int>(motion::actionOf(states_.segment[0]));
    }
    [[nodiscard]] body::NodalPoints pose() const {
        const motion::FishRecord record = motion::recordOf(states_, 0);
        body::NodalPoints nodes;
        motion::nodalPose(
            test::scadRepertoire(), motion::present(record, record, 1.0F, traits_[0]), nodes);
        return nodes;
    }

  private:
    motion::MotionStates states_;
    motion::MotorCommands commands_;
    std::array<motion::FishTraits, 1> traits_{
        motion::FishTraits{.id = 0, .lengthMillimetres = 240}};
};

double furthest(const body::NodalPoints& from, const body::NodalPoints& to) {
    double most = 0;
    for (std::size_t i = 0; i < body::kNodalPoints; ++i)
        most = std::max(most, static_cast<double>(glm::distance(from[i], to[i])));
    return most;
}

// The furthest that any nodal point moves in a tick of any segment as recorded, in the body frame.
double largestRecordedStep() {
    double most = 0;
    for (int action = 0; action < motion::kActions; ++action) {
        Replica replica(static_cast<motion::Action>(action));
        body::NodalPoints last = replica.pose();
        for (int tick = 0; tick < 120; ++tick) {
            replica.tick();
            const body::NodalPoints now = replica.pose();
            most = std::max(most, furthest(last, now));
            last = now;
        }
    }
    return most;
}

TEST(Replica, swimsAHundredCyclesStraightAndLevel) {
    for (const motion::Action action : {motion::Action::ForwardSlow,
                                        motion::Action::ForwardMedium,
                                        motion::Action::ForwardFast}) {
        Replica replica(action);
        const glm::vec3 course = replica.meanFrame() * glm::vec3(1, 0, 0);
        for (int tick = replica.ticksOf(100); tick > 0; --tick) {
            replica.tick();
            const glm::quat mean = replica.meanFrame();
            ASSERT_LT(
                std::asin(std::abs(static_cast<double>((mean * glm::vec3(0, 0, 1)).y))) * kDegrees,
                0.1)
                << "roll, " << motion::nameOf(action);
        }
        const glm::dvec3 way = glm::normalize(replica.place());
        EXPECT_LT(std::acos(std::min(1.0, glm::dot(way, glm::dvec3(course)))) * kDegrees, 0.3)
            << motion::nameOf(action);
        EXPECT_GT(glm::length(replica.place()), 10.0) << motion::nameOf(action);
    }
}

TEST(Replica, noChangeOfSegmentMovesAPointFurtherThanTheRecordingsDo) {
    const double allowed = 1.25 * largestRecordedStep();
    for (int from = 0; from < motion::kActions; ++from) {
        for (int to = 0; to < motion::kActions; ++to) {
            for (int phase = 0; phase < 65536; phase += 5003) {
                Replica replica(static_cast<motion::Action>(from));
                replica.enterAt(phase);
                replica.command(static_cast<motion::Action>(to));
                body::NodalPoints last = replica.pose();
                for (int tick = 0; tick < 80; ++tick) {
                    replica.tick();
                    const body::NodalPoints now = replica.pose();
                    ASSERT_LE(furthest(last, now), allowed)
                        << motion::nameOf(static_cast<motion::Action>(from)) << " at " << phase
                        << " to " << motion::nameOf(static_cast<motion::Action>(to));
                    last = now;
                }
                ASSERT_EQ(replica.segment(), to);
            }
        }
    }
}

}  // namespace
}  // namespace aquarama::capture
