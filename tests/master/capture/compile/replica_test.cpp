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

namespace aquarama {
namespace {

constexpr double kDegrees = 57.29577951308232;

const MotorTables& scadTables() {
    static const auto tables = makeMotorTables(scadRepertoire());
    return *tables;
}

// One fish that plays captured segments.
class Replica {
  public:
    explicit Replica(Action action) {
        states_.resize(1);
        commands_.resize(1);
        setBodyFrame(states_, 0, {});
        states_.segment[0] = static_cast<std::uint8_t>(action);
        command(action);
    }
    void command(Action action) {
        commands_.segment[0] = static_cast<std::uint8_t>(action);
        commands_.phaseRate[0] = recordedPhaseRate(scadTables(), action);
    }
    void enterAt(int phase) { states_.phase[0] = static_cast<std::uint16_t>(phase); }
    void tick() {
        MotorStep{.tables = &scadTables(),
                  .traits = traits_,
                  .commands = &commands_,
                  .states = &states_,
                  .first = 0,
                  .last = 1}
            .run();
    }
    [[nodiscard]] glm::quat meanFrame() const { return meanRotation(scadTables(), states_, 0); }
    [[nodiscard]] glm::dvec3 place() const { return bodyFrameOf(states_, 0).position; }
    [[nodiscard]] int ticksOf(int cycles) const { return cycles * 65536 / commands_.phaseRate[0]; }
    [[nodiscard]] int segment() const { return states_.segment[0]; }
    [[nodiscard]] NodalPoints pose() const {
        const FishRecord record = recordOf(states_, 0);
        NodalPoints nodes;
        nodalPose(scadRepertoire(), present(record, record, 1.0F, traits_[0]), nodes);
        return nodes;
    }

  private:
    MotionStates states_;
    MotorCommands commands_;
    std::array<FishTraits, 1> traits_{FishTraits{.id = 0, .lengthMillimetres = 240}};
};

double furthest(const NodalPoints& from, const NodalPoints& to) {
    double most = 0;
    for (std::size_t i = 0; i < kNodalPoints; ++i)
        most = std::max(most, static_cast<double>(glm::distance(from[i], to[i])));
    return most;
}

// The furthest that any nodal point moves in a tick of any segment as recorded, in the body frame.
double largestRecordedStep() {
    double most = 0;
    for (int action = 0; action < kActions; ++action) {
        Replica replica(static_cast<Action>(action));
        NodalPoints last = replica.pose();
        for (int tick = 0; tick < 120; ++tick) {
            replica.tick();
            const NodalPoints now = replica.pose();
            most = std::max(most, furthest(last, now));
            last = now;
        }
    }
    return most;
}

TEST(Replica, swimsAHundredCyclesStraightAndLevel) {
    for (const Action action : {Action::ForwardSlow, Action::ForwardMedium, Action::ForwardFast}) {
        Replica replica(action);
        const glm::vec3 course = replica.meanFrame() * glm::vec3(1, 0, 0);
        for (int tick = replica.ticksOf(100); tick > 0; --tick) {
            replica.tick();
            const glm::quat mean = replica.meanFrame();
            ASSERT_LT(
                std::asin(std::abs(static_cast<double>((mean * glm::vec3(0, 0, 1)).y))) * kDegrees,
                0.1)
                << "roll, " << nameOf(action);
        }
        const glm::dvec3 way = glm::normalize(replica.place());
        EXPECT_LT(std::acos(std::min(1.0, glm::dot(way, glm::dvec3(course)))) * kDegrees, 0.3)
            << nameOf(action);
        EXPECT_GT(glm::length(replica.place()), 10.0) << nameOf(action);
    }
}

TEST(Replica, noChangeOfSegmentMovesAPointFurtherThanTheRecordingsDo) {
    const double allowed = 1.25 * largestRecordedStep();
    for (int from = 0; from < kActions; ++from) {
        for (int to = 0; to < kActions; ++to) {
            for (int phase = 0; phase < 65536; phase += 5003) {
                Replica replica(static_cast<Action>(from));
                replica.enterAt(phase);
                replica.command(static_cast<Action>(to));
                NodalPoints last = replica.pose();
                for (int tick = 0; tick < 80; ++tick) {
                    replica.tick();
                    const NodalPoints now = replica.pose();
                    ASSERT_LE(furthest(last, now), allowed)
                        << nameOf(static_cast<Action>(from)) << " at " << phase << " to "
                        << nameOf(static_cast<Action>(to));
                    last = now;
                }
                ASSERT_EQ(replica.segment(), to);
            }
        }
    }
}

}  // namespace
}  // namespace aquarama
