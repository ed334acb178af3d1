// SPDX-License-Identifier: Apache-2.0
// One kinematic fish under the motor of the show.
#pragma once

#include <array>
#include <memory>

#include "common/motion/motor.h"
#include "master/capture/report/script.h"

namespace aquarama::report {

// Swims forward_medium from phase 0, at its speed, until it is told otherwise. It is one metre
// long: what it does is in body lengths.
class Replica {
  public:
    explicit Replica(const motion::Repertoire& repertoire);

    void command(Manoeuvre manoeuvre);
    // A segment at so many times its recorded tempo; backwards when that is negative.
    void play(motion::Action action, double tempo);
    void tick();

    // Exchanges a segment that is not playing.
    void learn(motion::Action action, const motion::ActionSegment& segment);
    [[nodiscard]] motion::Action playing() const {
        return static_cast<motion::Action>(states_.segment[0]);
    }

    // Where a cyclic segment plays, changes its phase to that whose pose is nearest; the mean frame
    // stays where it is.
    void bringToPhaseOf(const capture::NodeVectors& pose);

    [[nodiscard]] TracePoint point() const;

  private:
    motion::Repertoire repertoire_;
    std::shared_ptr<const motion::MotorTables> tables_;
    motion::MotionStates states_;
    motion::MotorCommands commands_;
};

}  // namespace aquarama::report
