// SPDX-License-Identifier: Apache-2.0
// One kinematic fish under the motor of the show.
#pragma once

#include <array>
#include <memory>

#include "common/motion/motor.h"
#include "master/capture/fidelity/script.h"
#include "master/capture/fidelity/trace.h"

namespace aquarama {

// Swims forward_medium from phase 0, at its speed, until it is told otherwise. It is one metre
// long: what it does is in body lengths.
class Replica {
  public:
    explicit Replica(const Repertoire& repertoire);

    void command(Manoeuvre manoeuvre);
    // A segment at so many times its recorded tempo; backwards when that is negative.
    void play(Action action, double tempo);
    void tick();

    // Exchanges a segment that is not playing.
    void learn(Action action, const ActionSegment& segment);
    [[nodiscard]] Action playing() const { return static_cast<Action>(states_.segment[0]); }

    // Where a cyclic segment plays, changes its phase to that whose pose is nearest; the mean frame
    // stays where it is.
    void bringToPhaseOf(const NodeVectors& pose);

    [[nodiscard]] TracePoint point() const;

  private:
    Repertoire repertoire_;
    std::shared_ptr<const MotorTables> tables_;
    MotionStates states_;
    MotorCommands commands_;
};

}  // namespace aquarama
