// SPDX-License-Identifier: Apache-2.0
#include "common/config/calendar.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <set>

#include <spdlog/fmt/fmt.h>

#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/config/text_file.h"

namespace aquarama::config {

namespace {

constexpr long long kMinute = 60, kDay = 86400;

// Seconds by which the clock of a zone is ahead of UTC.
long long aheadOfUtc(const std::string& zone, long long unixSeconds) {
    const CivilTime civil = civilTime(zone, unixSeconds);
    std::tm shown{};
    shown.tm_year = civil.year - 1900;
    shown.tm_mon = civil.month - 1;
    shown.tm_mday = civil.day;
    shown.tm_min = civil.minute;
    return timegm(&shown) - unixSeconds / kMinute * kMinute;
}

// Seconds of "18:00" since midnight; nothing where the text is no time.
std::optional<long long> secondsIn(const std::string& text) {
    const auto digit = [&](std::size_t at) { return text[at] - '0'; };
    const auto isDigit = [&](std::size_t at) { return text[at] >= '0' && text[at] <= '9'; };
    if (text.size() != 5 || text[2] != ':' || !isDigit(0) || !isDigit(1) || !isDigit(3) ||
        !isDigit(4))
        return std::nullopt;
    const int hours = 10 * digit(0) + digit(1), minutes = 10 * digit(3) + digit(4);
    if (hours > 23 || minutes > 59) return std::nullopt;
    return (60LL * hours + minutes) * kMinute;
}

// What a clock shows as "2026-12-24 18:00", as if it were that of UTC.
long long shownIn(const std::string& text) {
    constexpr std::size_t kDayLength = 10;
    const bool hasBoth = text.size() > kDayLength && text[kDayLength] == ' ';
    const auto day = secondsOfDay(text.substr(0, kDayLength));
    const auto time = hasBoth ? secondsIn(text.substr(kDayLength + 1)) : std::nullopt;
    if (!day || dayOf(*day) != text.substr(0, kDayLength) || !time)
        throw Error("\"" + text + "\" is no day and time: write \"2026-12-24 18:00\"");
    return static_cast<long long>(*day) + *time;
}

}  // namespace

// What is wanted changes at whole minutes only.
std::optional<HoursChange> changeAfter(const Hours& hours, long long unixSeconds, int days) {
    const WantedHours before = wantedAt(hours, unixSeconds);
    const long long end = unixSeconds + days * kDay;
    for (long long at = (unixSeconds / kMinute + 1) * kMinute; at <= end; at += kMinute)
        if (WantedHours wanted = wantedAt(hours, at); wanted != before)
            return HoursChange{at, std::move(wanted)};
    return std::nullopt;
}

// A zone changes its clock once within two days, if at all: before or after the moment.
long long momentOf(const std::string& zone, const std::string& text) {
    const long long shown = shownIn(text);
    std::array moments{shown - aheadOfUtc(zone, shown - kDay),
                       shown - aheadOfUtc(zone, shown + kDay)};
    std::ranges::sort(moments);
    for (const long long moment : moments)
        if (moment + aheadOfUtc(zone, moment) == shown) return moment;
    throw Error("\"" + text + "\" does not come in " + zone +
                ": the clock is put forward past it; give another time");
}

std::string clockText(const std::string& zone, long long unixSeconds) {
    constexpr std::array kDays{
        "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"};
    const CivilTime civil = civilTime(zone, unixSeconds);
    const long long ahead = aheadOfUtc(zone, unixSeconds) / kMinute;
    return fmt::format("{}-{:02}-{:02} {:02}:{:02} {}{:02}:{:02} {}",
                       civil.year,
                       civil.month,
                       civil.day,
                       civil.minute / 60,
                       civil.minute % 60,
                       ahead < 0 ? '-' : '+',
                       std::abs(ahead) / 60,
                       std::abs(ahead) % 60,
                       kDays.at(static_cast<std::size_t>(civil.weekday - 1)));
}

std::string textOf(const WantedHours& wanted) {
    std::string text = wanted.isOpen ? "open" : "closed";
    if (!wanted.scene.empty()) text += ", scene " + wanted.scene;
    if (!wanted.quality.empty()) text += ", quality " + wanted.quality;
    return text;
}

std::vector<std::string> scenesOf(const Hours& hours) {
    std::set<std::string> names;
    const auto take = [&](const std::vector<OpenSpan>& spans) {
        for (const OpenSpan& span : spans)
            if (!span.scene.empty()) names.insert(span.scene);
    };
    take(hours.open);
    for (const ExceptionDay& day : hours.exceptions) take(day.open);
    return {names.begin(), names.end()};
}

std::string scenePathOf(const std::string& name,
                        const std::string& rigPath,
                        const std::string& rigScene) {
    const std::filesystem::path scene = besideFile(rigPath, rigScene);
    const std::filesystem::path path = scene.parent_path() / (name + ".txtpb");
    if (!std::filesystem::is_regular_file(path))
        throw Error(path.string() + ": is not there, and the hours of " + rigPath +
                    " name this scene; put it there, or correct the hours");
    return path.string();
}

}  // namespace aquarama::config
