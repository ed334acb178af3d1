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

// Goes past one character; false where it is not there.
bool skip(const char*& at, const char* end, char wanted) {
    return at != end && *at++ == wanted;
}

// A number without sign, and goes past it; false where there is none, or it is too large.
bool readNumber(const char*& at, const char* end, int& number) {
    if (at == end || *at < '0' || *at > '9') return false;
    const auto [next, problem] = std::from_chars(at, end, number);
    at = next;
    return problem == std::errc{};
}

// Whole numbers with one character between them; nothing where the text is anything else.
template <std::size_t count>
std::optional<std::array<int, count>> numbersIn(const std::string& text, char between) {
    std::array<int, count> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && !skip(at, end, between)) return std::nullopt;
        if (!readNumber(at, end, numbers[i])) return std::nullopt;
    }
    return at == end ? std::optional(numbers) : std::nullopt;
}

// Minutes since midnight; nothing where the text is no time of a day.
std::optional<int> minuteIn(const std::string& text) {
    const auto time = numbersIn<2>(text, ':');
    if (!time || (*time)[0] > 23 || (*time)[1] > 59) return std::nullopt;
    return 60 * (*time)[0] + (*time)[1];
}

// Of the field `from` or `to`; the latter may be midnight.
int minuteOf(const TextReader& file, const v1::OpenSpan& in, const std::string& field) {
    const std::string& text = field == "from" ? in.from() : in.to();
    if (field == "to" && text == "24:00") return kMinutesOfDay;
    const auto minute = minuteIn(text);
    if (!minute) file.refuse(in, field, field + " \"" + text + "\" is no time: write 09:30");
    return *minute;
}

// The part of a schema as plain data; refuses what no single field can tell.
OpenSpan spanOf(const TextReader& file, const v1::OpenSpan& in) {
    OpenSpan span{
        {}, minuteOf(file, in, "from"), minuteOf(file, in, "to"), in.scene(), in.quality()};
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

// Nothing where the text is no day of a calendar.
std::optional<CivilDate> dateIn(const std::string& text) {
    constexpr int kFirstYear = 1970;
    const auto date = numbersIn<3>(text, '-');
    if (!date) return std::nullopt;
    const auto [year, month, day] = *date;
    if (year < kFirstYear || day < 1 || day > daysOf(month)) return std::nullopt;
    return CivilDate{year, month, day};
}

// A day that is not as its weekday. Its spans have no days of their own.
ExceptionDay exceptionOf(const TextReader& file, const v1::ExceptionDay& in) {
    const auto date = dateIn(in.date());
    if (!date) file.refuse(in, "date", "date \"" + in.date() + "\" is no day: write 2026-12-24");
    ExceptionDay day{*date, {}};
    for (const v1::OpenSpan& span : in.open()) {
        if (span.days_size() > 0)
            file.refuse(span, "days", "an exception is of its date alone: remove the days");
        day.open.push_back(spanOf(file, span));
    }
    return day;
}

// Of "192.168.7.21:4352"; PJLink's own where none is named, 0 where it is no port.
int portIn(const std::string& address) {
    const std::size_t colon = address.find(':');
    if (colon == std::string::npos) return kPjLinkPort;
    constexpr int kMostPort = 65535;
    const auto port = numbersIn<1>(address.substr(colon + 1), ':');
    return port && (*port)[0] <= kMostPort ? (*port)[0] : 0;
}

// A projector is named by number: names mean anything to a resolver.
ControlledProjector projectorOf(const TextReader& file, const v1::ControlledProjector& in) {
    ControlledProjector projector{in.name(),
                                  in.address().substr(0, in.address().find(':')),
                                  in.password(),
                                  portIn(in.address())};
    if (!numbersIn<4>(projector.host, '.') || projector.port == 0)
        file.refuse(in, "address", "address is a number, as 192.168.7.21 or 192.168.7.21:4352");
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

// Of the Gregorian calendar.
bool isLeapYear(int year) {
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

// The day whose spans may still hold after midnight.
CivilDate dayBefore(const CivilTime& now) {
    if (now.day > 1) return {now.year, now.month, now.day - 1};
    if (now.month == 1) return {now.year - 1, 12, 31};
    const int days = now.month == 3 && !isLeapYear(now.year) ? 28 : daysOf(now.month - 1);
    return {now.year, now.month - 1, days};
}

}  // namespace

namespace {

// Each of them once.
void takeExceptions(const TextReader& file, const v1::Hours& in, Hours& hours) {
    for (const v1::ExceptionDay& day : in.exceptions()) {
        ExceptionDay exception = exceptionOf(file, day);
        if (std::ranges::count(hours.exceptions, exception.date, &ExceptionDay::date) > 0)
            file.refuse(day, "date", "the day is there already: put its spans together");
        hours.exceptions.push_back(std::move(exception));
    }
}

}  // namespace

Hours parseHours(const std::string& text, const std::string& source) {
    v1::Hours in;
    TextReader file(text, source, in);
    file.check();
    Hours hours{in.zone(), {}, {}, {}};
    if (!isZone(in.zone()))
        file.refuse(
            in,
            "zone",
            "zone \"" + in.zone() + "\" is none of this machine: write Europe/Berlin or UTC");
    for (const v1::OpenSpan& span : in.open()) {
        if (span.days_size() == 0) file.refuse(span, "say on which days: days: [MONDAY, SUNDAY]");
        hours.open.push_back(spanOf(file, span));
    }
    takeExceptions(file, in, hours);
    for (const v1::ControlledProjector& projector : in.projectors())
        hours.projectors.push_back(projectorOf(file, projector));
    return hours;
}

// A name of the system's list; no path that leads out of it.
bool isZone(const std::string& zone) {
    constexpr std::size_t kLongest = 64;
    if (zone.empty() || zone.size() > kLongest || zone.front() == '/' ||
        zone.find("..") != std::string::npos)
        return false;
    return zone == "UTC" || std::filesystem::is_regular_file("/usr/share/zoneinfo/" + zone);
}

// The C library knows the changes of summer time; C++20's zones are not in GCC 12.
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

// A span of today goes before one of yesterday that has not ended.
WantedHours wantedAt(const Hours& hours, const CivilTime& now) {
    const OpenSpan* span = spanAt(hours, {now.year, now.month, now.day}, now.weekday, now.minute);
    if (span == nullptr)
        span = spanAt(hours,
                      dayBefore(now),
                      now.weekday == 1 ? 7 : now.weekday - 1,
                      now.minute + kMinutesOfDay);
    if (span == nullptr) return {};
    return {true, span->scene, span->quality};
}

}  // namespace aquarama::config
