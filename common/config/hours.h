// SPDX-License-Identifier: Apache-2.0
// When a wall is open, and what it shows then: a calendar, and what is wanted at a moment of it.
#pragma once

#include <compare>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace aquarama::v1 {
class Hours;  // hours.proto
}

namespace aquarama::config {

// The folder in which the console keeps what it knows of a rig, and the file of its hours there.
[[nodiscard]] std::filesystem::path consoleFolderOf(const std::string& rigPath);
inline constexpr const char* kHoursFile = "hours.txtpb";

// A moment as the clock on the wall of a hall shows it.
struct CivilTime {
    int year = 1970, month = 1, day = 1;  // months and days from 1
    int weekday = 4;                      // Monday 1 to Sunday 7
    int minute = 0;                       // of the day
};

// While it is open. Minutes of its day; `to` may be of the next one, up to 2880.
struct OpenSpan {
    std::vector<int> weekdays;
    int from = 0, to = 0;
    std::string scene, quality;  // empty: as it was
};

// A day of the calendar.
struct CivilDate {
    int year = 0, month = 0, day = 0;
    friend auto operator<=>(const CivilDate&, const CivilDate&) = default;
};

// A day that is not as its weekday.
struct ExceptionDay {
    CivilDate date;
    std::vector<OpenSpan> open;  // none: closed
};

// A projector that PJLink switches.
struct ControlledProjector {
    std::string name, host, password;  // the host as a number, in its shortest form
    int port = 0;
    std::string input = {};  // "31", "3A"; empty: as it was
};
// "192.168.7.21:4352", "[fd00::21]:4352"
[[nodiscard]] std::string addressOf(const ControlledProjector& projector);

// When the wall is open, and which projectors are switched with it.
struct Hours {
    std::string zone;
    std::vector<OpenSpan> open;
    std::vector<ExceptionDay> exceptions;
    std::vector<ControlledProjector> projectors;
};

// What is wanted of the wall at a moment.
struct WantedHours {
    bool isOpen = false;
    std::string scene = {}, quality = {};
    friend bool operator==(const WantedHours&, const WantedHours&) = default;
};

// Checks the text against hours.proto: throws Error with file:line:column, which for a mistake in a
// field is a FileError (text_file.h). `source`: the file's name in errors. `form`: gets the message
// of the text, where it is wanted.
[[nodiscard]] Hours parseHours(const std::string& text,
                               const std::string& source,
                               v1::Hours* form = nullptr);
// The text of a message, without comments.
[[nodiscard]] std::string textOf(const v1::Hours& form);

// The clock of a zone at a moment of Unix time. Changes the process's idea of local time: one
// thread calls it, and what follows. A zone that the system does not know is UTC.
[[nodiscard]] CivilTime civilTime(const std::string& zone, long long unixSeconds);
[[nodiscard]] bool isZone(const std::string& zone);

// From the first opening of a day to the last closing. Minutes of the day; `to` may be of the next
// one, up to 2880.
struct OpenTimes {
    int from = 0, to = 0;
    friend bool operator==(const OpenTimes&, const OpenTimes&) = default;
};
// Of the day of the calendar on which a moment is; nothing where the wall is closed on that day.
[[nodiscard]] std::optional<OpenTimes> openTimesOn(const Hours& hours, const CivilTime& now);

// A function of the calendar and the clock alone: whoever asks at whatever moment gets the same.
// Where the clock is put back, a time that comes twice counts when it first comes; where it is put
// forward, a time that does not come counts at that moment, and a span that lies wholly in what
// is left out is as much later as the clock was put forward.
[[nodiscard]] WantedHours wantedAt(const Hours& hours, long long unixSeconds);

}  // namespace aquarama::config
