// SPDX-License-Identifier: Apache-2.0
// What `aquarama tour` keeps of a hall between two calls: a small file beside what the show was set
// to.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace aquarama {

// Of one step. Times are seconds of Unix time, 0 where there is none.
struct StepRecord {
    double seconds = 0;          // that it has taken
    double lookedAt = 0;         // the last look at it
    double doneAt = 0;           // 0: is to be done
    std::string confirmed = {};  // the finding that somebody has confirmed
};

// Of the whole tour.
struct TourRecord {
    std::map<std::string, StepRecord> steps = {};  // by name
    std::string backupFolder = {};  // where the copy of the hall goes; empty: nowhere
    double backupWrittenAt = 0;     // when the copy was written that was seen last
};

// A longer time between two looks is a pause: it is no part of a step.
inline constexpr double kLongestWork = 3600;

// Counts the time since the last look at a step, and makes it done or not.
void noteLook(StepRecord& step, double now, bool isDone);

// aquarama/shows/RIG.tour.json in the user's folder for state.
[[nodiscard]] std::filesystem::path tourFileOf(const std::string& rigPath);
// Nothing is done where there is no such file. Throws Error where it cannot be read.
[[nodiscard]] TourRecord readTour(const std::filesystem::path& file);
// Whole or not at all. Throws Error where it cannot be written.
void keepTour(const std::filesystem::path& file, const TourRecord& record);

}  // namespace aquarama
