// SPDX-License-Identifier: Apache-2.0
#include "console/errands.h"

#include <chrono>
#include <utility>

namespace aquarama::console {

namespace {

template <class Result>
bool isReady(const std::future<Result>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void Errands::runDoctor() {
    if (doctor_.valid()) return;
    state_.doctor.set_running(true);
    doctor_ = std::async(std::launch::async, work_.askDoctor, state_.rigFile);
}

void Errands::wantCalibrations(int ticks) {
    constexpr int kTicksBetween = 50;
    const bool isDue = !state_.calibrations || ticks >= readingDue_;
    if (!isDue || reading_.valid()) return;
    readingDue_ = ticks + kTicksBetween;
    reading_ = std::async(std::launch::async, work_.calibrationsOf, state_.rigFile);
}

void Errands::wantReleases(int ticks) {
    constexpr int kTicksBetween = 20;
    if ((state_.releases && ticks < askingDue_) || asking_.valid()) return;
    askingDue_ = ticks + kTicksBetween;
    asking_ = std::async(std::launch::async, work_.releasesOf, state_.rigFile);
}

// The doctor takes a while, so the pause begins at the end. Not beside a word of the crew: the look
// would not know it.
void Errands::wantTour(int ticks) {
    constexpr int kTicksBetween = 50;
    if (touring_.valid()) {
        touringDue_ = ticks + kTicksBetween;
    } else if (!errand_.valid() && (!state_.tour || ticks >= touringDue_)) {
        touring_ = std::async(std::launch::async, work_.tourOf, state_.rigFile);
    }
}

bool Errands::confirm(const browser::ConfirmStep& step, std::uint64_t command) {
    return begin(
        [confirm = work_.confirmStep, rig = state_.rigFile, step] {
            return confirm(rig, step.name(), step.found());
        },
        command);
}

bool Errands::change(const std::string& releaseWord, std::uint64_t command) {
    return begin(
        [change = work_.changeRelease, rig = state_.rigFile, releaseWord] {
            return change(rig, releaseWord);
        },
        command);
}

bool Errands::use(const std::string& calibration, std::uint64_t command) {
    return begin(
        [use = work_.useCalibration, rig = state_.rigFile, calibration] {
            return use(rig, calibration);
        },
        command);
}

bool Errands::assign(const Assignment& assignment, std::uint64_t command) {
    return begin([assign = work_.assignNode, assignment] { return assign(assignment); }, command);
}

bool Errands::begin(std::function<std::string()> errand, std::uint64_t command) {
    if (errand_.valid()) return false;
    command_ = command;
    errand_ = std::async(std::launch::async, std::move(errand));
    return true;
}

std::optional<Errands::Ended> Errands::hear() {
    if (isReady(doctor_)) {
        state_.doctor = doctor_.get();
        state_.doctor.set_running(false);
    }
    if (isReady(reading_)) state_.calibrations = reading_.get();
    if (isReady(asking_)) state_.releases = asking_.get();
    if (isReady(touring_)) state_.tour = touring_.get();
    if (!isReady(errand_)) return std::nullopt;
    readingDue_ = askingDue_ = touringDue_ = 0;
    return Ended{command_, errand_.get()};
}

}  // namespace aquarama::console
