// SPDX-License-Identifier: Apache-2.0
#include "common/config/hours.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "common/config/hours.pb.h"
#include "common/config/rig.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

constexpr int kMinutesOfDay = 1440;
constexpr int kPjLinkPort = 4352;

// Whole numbers with one character between them; nothing where the text is anything else.
template <std::size_t count>
std::optional<std::array<int, count>> numbersIn(const std::string& text, char between) {
    std::array<int, count> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && (at == end || *at++ != between)) return std::nullopt;
        if (at == end || *at < '0' || *at > '9') return std::nullopt;
        const auto [next, problem] = std::from_chars(at, end, numbers[i]);
        if (problem != std::errc{}) return std::nullopt;
        at = next;
    }
    return at == end ? std::optional(numbers) : std::nullopt;
}

int minuteOf(const TextReader& file, const v1::OpenSpan& in, const std::string& field) {
    const std::string& text = field == "from" ? in.from() : in.to();
    const auto time = numbersIn<2>(text, ':');
    const bool isMidnight = time && field == "to" && *time == std::array{24, 0};
    if (!isMidnight && (!time || (*time)[0] > 23 || (*time)[1] > 59))
        file.refuse(in, field, field + " \"" + text + "\" is no time: write 09:30");
    return 60 * (*time)[0] + (*time)[1];
}

OpenSpan spanOf(const TextReader& file, const v1::OpenSpan& in) {
    OpenSpan span{{},
                  minuteOf(file, in, "from"),
                  minuteOf(file, in, "to"),
                  in.scene(),
                  in.quality()};
    if (span.to <= span.from) span.to += kMinutesOfDay;
    for (const int day : in.days()) span.weekdays.push_back(day);
    if (in.has_quality() && in.quality() != "auto" && !tierNamed(in.quality()))
        file.refuse(in, "quality", "quality is low, medium, high, ultra or auto");
    return span;
}

// Of a month; February has 29, so that a date need not know its year.
int daysOf(int month) {
    constexpr std::array kDays{31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month >= 1 && month <= 12 ? kDays[static_cast<std::size_t>(month - 1)] : 0;
}

ExceptionDay exceptionOf(const TextReader& file, const v1::ExceptionDay& in) {
    const auto date = numbersIn<3>(in.date(), '-');
    if (!date || (*date)[0] < 1970 || (*date)[2] < 1 || (*date)[2] > daysOf((*date)[1]))
        file.refuse(in, "date", "date \"" + in.date() + "\" is no day: write 2026-12-24");
    ExceptionDay day{{(*date)[0], (*date)[1], (*date)[2]}, {}};
    for (const v1::OpenSpan& span : in.open()) {
        if (span.days_size() > 0)
            file.refuse(span, "days", "an exception is of its date alone: remove the days");
        day.open.push_back(spanOf(file, span));
    }
    return day;
}

ControlledProjector projectorOf(const TextReader& file, const v1::ControlledProjector& in) {
    const std::size_t colon = in.address().find(':');
    ControlledProjector projector{
        in.name(), in.address().substr(0, colon), in.password(), kPjLinkPort};
    const auto port = colon == std::string::npos
                          ? std::optional(std::array{kPjLinkPort})
                          : numbersIn<1>(in.address().substr(colon + 1), ':');
    const bool isHost = numbersIn<4>(projector.host, '.').has_value();
    if (!isHost || !port || (*port)[0] < 1 || (*port)[0] > 65535)
        file.refuse(in, "address", "address is a number, as 192.168.7.21 or 192.168.7.21:4352");
    projector.port = (*port)[0];
    constexpr std::size_t kLongestPassword = 32;  // of PJLink
    if (in.password().size() > kLongestPassword)
        file.refuse(in, "password", "a password of PJLink has at most 32 letters");
    return projector;
}

// Whether a day's span holds at a minute that may be of the day after it, from 1440 on.
const OpenSpan* lastAt(const std::vector<OpenSpan>& spans, int weekday, int minute) {
    const OpenSpan* found = nullptr;
    for (const OpenSpan& span : spans) {
        const bool isItsDay =
            weekday == 0 || std::ranges::find(span.weekdays, weekday) != span.weekdays.end();
        if (isItsDay && minute >= span.from && minute < span.to) found = &span;
    }
    return found;
}

// The span of the day of `date` that holds so many minutes after its midnight.
const OpenSpan* spanAt(const Hours& hours, const CivilDate& date, int weekday, int minute) {
    const auto exception = std::ranges::find(hours.exceptions, date, &ExceptionDay::date);
    if (exception != hours.exceptions.end()) return lastAt(exception->open, 0, minute);
    return lastAt(hours.open, weekday, minute);
}

bool isLeapYear(int year) {
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

CivilDate dayBefore(const CivilTime& now) {
    if (now.day > 1) return {now.year, now.month, now.day - 1};
    if (now.month == 1) return {now.year - 1, 12, 31};
    const int days = now.month == 3 && !isLeapYear(now.year) ? 28 : daysOf(now.month - 1);
    return {now.year, now.month - 1, days};
}

}  // namespace

Hours parseHours(const std::string& text, const std::string& source) {
    v1::Hours in;
    TextReader file(text, source, in);
    file.check();
    Hours hours{in.zone(), {}, {}, {}};
    if (!isZone(in.zone()))
        file.refuse(in, "zone", "zone \"" + in.zone() + "\" is none of this machine: write Europe/Berlin or UTC");
    for (const v1::OpenSpan& span : in.open()) {
        if (span.days_size() == 0) file.refuse(span, "say on which days: days: [MONDAY, SUNDAY]");
        hours.open.push_back(spanOf(file, span));
    }
    for (const v1::ExceptionDay& day : in.exceptions()) {
        hours.exceptions.push_back(exceptionOf(file, day));
        const CivilDate& date = hours.exceptions.back().date;
        if (std::ranges::count(hours.exceptions, date, &ExceptionDay::date) > 1)
            file.refuse(day, "date", "the day is there already: put its spans together");
    }
    for (const v1::ControlledProjector& projector : in.projectors())
        hours.projectors.push_back(projectorOf(file, projector));
    return hours;
}

bool isZone(const std::string& zone) {
    constexpr std::size_t kLongest = 64;
    if (zone.empty() || zone.size() > kLongest || zone.front() == '/' ||
        zone.find("..") != std::string::npos)
        return false;
    return zone == "UTC" || std::filesystem::is_regular_file("/usr/share/zoneinfo/" + zone);
}

CivilTime civilTime(const std::string& zone, long long unixSeconds) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread calls this, as the header says
    const char* const before = std::getenv("TZ");
    if (before == nullptr || zone != before) {
        setenv("TZ", zone.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
        tzset();
    }
    const auto moment = static_cast<std::time_t>(unixSeconds);
    std::tm local{};
    localtime_r(&moment, &local);
    return {local.tm_year + 1900,
            local.tm_mon + 1,
            local.tm_mday,
            local.tm_wday == 0 ? 7 : local.tm_wday,
            60 * local.tm_hour + local.tm_min};
}

WantedHours wantedAt(const Hours& hours, const CivilTime& now) {
    const OpenSpan* span =
        spanAt(hours, {now.year, now.month, now.day}, now.weekday, now.minute);
    if (span == nullptr)
        span = spanAt(hours,
                      dayBefore(now),
                      now.weekday == 1 ? 7 : now.weekday - 1,
                      now.minute + kMinutesOfDay);
    if (span == nullptr) return {};
    return {true, span->scene, span->quality};
}

}  // namespace aquarama::config
