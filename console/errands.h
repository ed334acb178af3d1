// SPDX-License-Identifier: Apache-2.0
// What takes the console seconds and is done on threads of its own: the doctor's report, reading
// calibrations and putting one in place, giving a node a channel, speaking with the depot of
// releases, and looking how far a new hall is.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "console/console.pb.h"
#include "console/files_of_show.h"
#include "console/releases_of_hall.h"
#include "console/state.h"
#include "console/tour_of_hall.h"
#include "console/waiting_nodes.h"

namespace aquarama::console {

// The work of the errands; each is done on a thread of its own. Tests put their own in place.
struct ErrandWork {
    std::function<browser::DoctorReport(const std::string& rigPath)> askDoctor = console::askDoctor;
    std::function<browser::Calibrations(const std::string& rigPath)> calibrationsOf =
        console::calibrationsOf;
    std::function<std::string(const std::string& rigPath, const std::string& name)> useCalibration =
        console::useCalibration;
    std::function<std::string(const Assignment& assignment)> assignNode = console::assignNode;
    std::function<browser::Releases(const std::string& rigPath)> releasesOf = console::releasesOf;
    std::function<std::string(const std::string& rigPath, const std::string& word)> changeRelease =
        console::changeRelease;
    std::function<browser::Tour(const std::string& rigPath)> tourOf = console::tourOf;
    std::function<std::string(
        const std::string& rigPath, const std::string& step, const std::string& found)>
        confirmStep = console::confirmStep;
};

// Of the server's thread, which never waits for them.
class Errands {
  public:
    // `state` outlives this, and is told what is found.
    explicit Errands(State& state, ErrandWork work = {}) : state_{state}, work_{std::move(work)} {}

    // One at a time.
    void runDoctor();
    // Reads calibrations where that is due: every five seconds while somebody looks, as there may
    // be thirty large files. `ticks`: tenths of a second since the start.
    void wantCalibrations(int ticks);
    // Asks the depot of releases where that is due: every two seconds while somebody looks.
    void wantReleases(int ticks);
    // Looks how far the hall is where that is due: five seconds after the last look, while somebody
    // looks.
    void wantTour(int ticks);
    // Puts a calibration in place, gives a node a channel, says a word to the depot, or takes a
    // finding of the tour as right, for the command of this number. False: another command waits
    // for such an errand.
    [[nodiscard]] bool use(const std::string& calibration, std::uint64_t command);
    [[nodiscard]] bool assign(const Assignment& assignment, std::uint64_t command);
    [[nodiscard]] bool change(const std::string& releaseWord, std::uint64_t command);
    [[nodiscard]] bool confirm(const browser::ConfirmStep& step, std::uint64_t command);

    // What has ended: the command, and why it was refused (empty: it was not).
    struct Ended {
        std::uint64_t command = 0;
        std::string refusal;
    };
    // Looks at all of them, once a second.
    [[nodiscard]] std::optional<Ended> hear();

  private:
    State& state_;
    ErrandWork work_;
    std::future<browser::DoctorReport> doctor_;
    std::future<browser::Calibrations> reading_;
    int readingDue_ = 0;  // tick
    std::future<browser::Releases> asking_;
    int askingDue_ = 0;  // tick
    std::future<browser::Tour> touring_;
    int touringDue_ = 0;  // tick
    [[nodiscard]] bool begin(std::function<std::string()> errand, std::uint64_t command);

    std::future<std::string> errand_;  // of a command
    std::uint64_t command_ = 0;
};

}  // namespace aquarama::console
