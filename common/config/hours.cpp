// SPDX-License-Identifier: Apache-2.0
#include "common/config/hours.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <utility>

#include "common/base/files.h"
#include "common/config/host.h"
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

// "192.168.7.21:4352", "[fd00::21]:4352" or "fd00::21": the host, and what stands after it.
std::pair<std::string, std::string> hostAndRestOf(const std::string& address) {
    const std::size_t bracket = address.find(']');
    if (address.starts_with('[') && bracket != std::string::npos)
        return {address.substr(1, bracket - 1), address.substr(bracket + 1)};
    const std::size_t colon = address.find(':');
    if (colon == std::string::npos || colon != address.rfind(':')) return {address, ""};
    return {address.substr(0, colon), address.substr(colon)};
}

// Of ":4352". PJLink's own where none is named, 0 where it is no port.
int portIn(const std::string& text) {
    constexpr int kMostPort = 65535;
    if (text.empty()) return kPjLinkPort;
    if (!text.starts_with(':')) return 0;
    const auto port = numbersIn<1>(text.substr(1), ':');
    return port && (*port)[0] <= kMostPort ? (*port)[0] : 0;
}

// The code of an input in capitals; empty where it is none. Class 1 has digits, class 2 letters
// too.
std::string inputCodeIn(std::string text) {
    constexpr std::string_view kKinds = "123456";
    constexpr std::string_view kNumbers = "123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    if (text.size() != 2) return {};
    text[1] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[1])));
    const bool isCode = kKinds.find(text[0]) != std::string_view::npos &&
                        kNumbers.find(text[1]) != std::string_view::npos;
    return isCode ? text : std::string{};
}

// Of PJLink: 32 bytes at most, of ASCII.
void checkPassword(const TextReader& file, const v1::ControlledProjector& in) {
    constexpr std::size_t kLongest = 32;
    if (in.password().size() > kLongest)
        file.refuse(in, "password", "a password of PJLink has at most 32 letters");
    if (!std::ranges::all_of(in.password(), [](char c) { return c >= ' ' && c <= '~'; }))
        file.refuse(in,
                    "password",
                    "a password of PJLink has letters without accents, digits and signs: give the "
                    "projector another");
}

// A projector is named by number: to look a name up may take a minute.
ControlledProjector projectorOf(const TextReader& file, const v1::ControlledProjector& in) {
    const auto [host, rest] = hostAndRestOf(in.address());
    const int port = portIn(rest);
    if (shortestHost(host).empty())
        file.refuse(in,
                    "address",
                    "address is a number of one machine, as 192.168.7.21, 192.168.7.21:4352 or "
                    "[fd00::21]:4352; \"" +
                        in.address() + "\" is none, and names are not looked up");
    if (port == 0) file.refuse(in, "address", "address is a number, and its port is 1 to 65535");
    checkPassword(file, in);
    const std::string input = inputCodeIn(in.input());
    if (in.has_input() && input.empty())
        file.refuse(in,
                    "input",
                    "input \"" + in.input() +
                        "\" is no code of PJLink: write 31 to 39 for HDMI, DVI and SDI, 11 to 19 "
                        "for RGB, 51 to 59 for network, as the projector's manual has them");
    return {in.name(), shortestHost(host), in.password(), port, input};
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

// A span of today goes before one of yesterday that has not ended.
const OpenSpan* spanAt(const Hours& hours, const CivilTime& now) {
    const OpenSpan* const span =
        spanAt(hours, {now.year, now.month, now.day}, now.weekday, now.minute);
    if (span != nullptr) return span;
    const int weekdayBefore = now.weekday == 1 ? 7 : now.weekday - 1;
    return spanAt(hours, dayBefore(now), weekdayBefore, now.minute + kMinutesOfDay);
}

// A zone's clock was put forward (or back, below 0) by so many seconds at a moment of Unix time.
struct ClockChange {
    long long at = 0;
    long long seconds = 0;  // 0: it was not
};

// Seconds by which the clock of the process's zone is ahead of UTC.
long long aheadOfUtc(long long unixSeconds) {
    const auto moment = static_cast<std::time_t>(unixSeconds);
    std::tm local{};
    localtime_r(&moment, &local);
    return local.tm_gmtoff;
}

// The last change of the three hours until `now`: no zone puts its clock on by more than two.
ClockChange changeBefore(const std::string& zone, long long now) {
    constexpr long long kBack = 3 * 3600LL;
    static_cast<void>(civilTime(zone, now));  // the process's zone from here on
    long long before = now - kBack, after = now;
    const long long seconds = aheadOfUtc(after) - aheadOfUtc(before);
    if (seconds == 0) return {};
    while (after - before > 1) {
        const long long middle = before + (after - before) / 2;
        (aheadOfUtc(middle) == aheadOfUtc(now) ? after : before) = middle;
    }
    return {after, seconds};
}

// A span that lies wholly in what the clock has left out just now, seen as if it had not.
const OpenSpan* leftOutSpanAt(const Hours& hours, long long now, const ClockChange& change) {
    constexpr int kSecondsOfMinute = 60;
    const int leftOut = static_cast<int>(change.seconds / kSecondsOfMinute);
    CivilTime then = civilTime(hours.zone, now);
    if (now - change.at >= change.seconds || then.minute < leftOut) return nullptr;
    const int end = civilTime(hours.zone, change.at).minute;
    then.minute -= leftOut;
    const OpenSpan* const span =
        spanAt(hours, {then.year, then.month, then.day}, then.weekday, then.minute);
    const bool isLeftOut = span != nullptr && span->from >= end - leftOut && span->to <= end;
    return isLeftOut ? span : nullptr;
}

// Carries out `take`, and keeps the mistakes that it refuses.
template <typename Take>
void collect(std::vector<FileMistake>& mistakes, const Take& take) {
    try {
        take();
    } catch (const FileError& error) {
        mistakes.insert(mistakes.end(), error.mistakes.begin(), error.mistakes.end());
    }
}

// Each day once.
void takeException(const TextReader& file, const v1::ExceptionDay& day, Hours& hours) {
    ExceptionDay exception = exceptionOf(file, day);
    if (std::ranges::count(hours.exceptions, exception.date, &ExceptionDay::date) > 0)
        file.refuse(day, "date", "the day is there already: put its spans together");
    hours.exceptions.push_back(std::move(exception));
}

// Two of one name or address would be switched as one, or each against the other.
void takeProjector(const TextReader& file, const v1::ControlledProjector& one, Hours& hours) {
    const ControlledProjector projector = projectorOf(file, one);
    for (const ControlledProjector& other : hours.projectors) {
        if (other.name == projector.name)
            file.refuse(one, "name", "there is a projector of that name already: give another");
        if (addressOf(other) == addressOf(projector))
            file.refuse(one,
                        "address",
                        "projector " + other.name + " has that address already: remove one");
    }
    hours.projectors.push_back(projector);
}

}  // namespace

Hours parseHours(const std::string& text, const std::string& source, v1::Hours* form) {
    v1::Hours in;
    TextReader file(text, source, in);
    file.check();
    Hours hours{in.zone(), {}, {}, {}};
    std::vector<FileMistake> mistakes;
    collect(mistakes, [&] {
        if (!isZone(in.zone()))
            file.refuse(
                in,
                "zone",
                "zone \"" + in.zone() + "\" is none of this machine: write Europe/Berlin or UTC");
    });
    for (const auto& span : in.open())
        collect(mistakes, [&] {
            if (span.days_size() == 0)
                file.refuse(span, "days", "say on which days: days: [MONDAY, SUNDAY]");
            hours.open.push_back(spanOf(file, span));
        });
    for (const auto& day : in.exceptions())
        collect(mistakes, [&] { takeException(file, day, hours); });
    for (const auto& one : in.projectors())
        collect(mistakes, [&] { takeProjector(file, one, hours); });
    if (!mistakes.empty()) throw FileError(source, std::move(mistakes));
    if (form != nullptr) *form = std::move(in);
    return hours;
}

std::string textOf(const v1::Hours& form) {
    google::protobuf::TextFormat::Printer printer;
    printer.SetUseUtf8StringEscaping(true);
    printer.SetUseShortRepeatedPrimitives(true);
    std::string text;
    printer.PrintToString(form, &text);
    return text;
}

// An IPv6 address stands in brackets before its port.
std::string addressOf(const ControlledProjector& projector) {
    const bool isSix = projector.host.find(':') != std::string::npos;
    return (isSix ? "[" + projector.host + "]" : projector.host) + ":" +
           std::to_string(projector.port);
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

std::filesystem::path consoleFolderOf(const std::string& rigPath) {
    return userFolder("XDG_STATE_HOME", ".local/state") / "console" /
           std::filesystem::path(rigPath).stem();
}

std::optional<OpenTimes> openTimesOn(const Hours& hours, const CivilTime& now) {
    const auto exception = std::ranges::find(
        hours.exceptions, CivilDate{now.year, now.month, now.day}, &ExceptionDay::date);
    const bool isException = exception != hours.exceptions.end();
    std::optional<OpenTimes> times;
    for (const OpenSpan& span : isException ? exception->open : hours.open) {
        if (!isException && std::ranges::find(span.weekdays, now.weekday) == span.weekdays.end())
            continue;
        times = times ? OpenTimes{std::min(times->from, span.from), std::max(times->to, span.to)}
                      : OpenTimes{span.from, span.to};
    }
    return times;
}

// Asked at any moment of a minute: changes of clocks are at whole minutes. While a time comes the
// second time, the clock of the hours stands at its last minute before.
WantedHours wantedAt(const Hours& hours, long long unixSeconds) {
    const ClockChange change = changeBefore(hours.zone, unixSeconds);
    const bool comesAgain = unixSeconds - change.at < -change.seconds;
    const CivilTime now = civilTime(hours.zone, comesAgain ? change.at - 1 : unixSeconds);
    const OpenSpan* span = spanAt(hours, now);
    if (span == nullptr && change.seconds > 0) span = leftOutSpanAt(hours, unixSeconds, change);
    if (span == nullptr) return {};
    return {true, span->scene, span->quality};
}

}  // namespace aquarama::config
