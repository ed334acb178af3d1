// SPDX-License-Identifier: Apache-2.0
// What takes the console seconds and is done on threads of its own: the doctor's report, reading
// calibrations, and putting one in place.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>

#include "console/console.pb.h"
#include "console/state.h"

namespace aquarama::console {

// Of the server's thread, which never waits for them.
class Errands {
  public:
    // `state` outlives this, and is told what is found.
    explicit Errands(State& state) : state_{state} {}

    // One at a time.
    void runDoctor();
    // Reads calibrations where that is due: every five seconds while somebody looks, as there may
    // be thirty large files. `ticks`: tenths of a second since the start.
    void wantCalibrations(int ticks);
    // Puts a calibration in place, for the command of this number. False: another one is.
    [[nodiscard]] bool use(const std::string& calibration, std::uint64_t command);

    // What has ended: the command that put a calibration in place, and why it was refused (empty:
    // it was not).
    struct Used {
        std::uint64_t command = 0;
        std::string refusal;
    };
    // Looks at all of them, once a second.
    [[nodiscard]] std::optional<Used> hear();

  private:
    State& state_;
    std::future<browser::DoctorReport> doctor_;
    std::future<browser::Calibrations> reading_;
    int readingDue_ = 0;  // tick
    std::future<std::string> using_;
    std::uint64_t command_ = 0;
};

}  // namespace aquarama::console
