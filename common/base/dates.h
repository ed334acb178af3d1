// SPDX-License-Identifier: Apache-2.0
// Whether the clock of this machine can be believed, and until when certificates are valid. All
// times are seconds of Unix time; days are of UTC.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace aquarama {

inline constexpr double kSecondsOfDay = 86400;

// When the source of this program was committed, or SOURCE_DATE_EPOCH; 0 where the build knew
// neither. Written by the build for each program, as its commit.
[[nodiscard]] std::int64_t builtAt();

// By the system's clock, which somebody may set.
[[nodiscard]] double systemSeconds();
// "2026-11-25"
[[nodiscard]] std::string dayOf(double seconds);
// Of "2026-11-25", its beginning; nothing where the text is no day.
[[nodiscard]] std::optional<double> secondsOfDay(const std::string& day);

// Why a clock that says `now` is wrong for certain, as a sentence: it is more than a day before the
// program was built. Empty where that cannot be told.
[[nodiscard]] std::string clockDoubt(double now, double built);
// What to do about it.
inline constexpr const char* kSetTheClock =
    "set it (timedatectl set-ntp true, or date --set), and see that its battery is good";

// From when and until when a certificate holds.
struct Validity {
    double from = 0, until = 0;
};
// Throws Error where the file cannot be read or holds no certificate (PEM).
[[nodiscard]] Validity validityOf(const std::filesystem::path& certificate);

// What is to be said of a certificate weeks before it runs out. `isUrgent`: browsers refuse it, or
// will within a week.
struct ValidityConcern {
    bool isUrgent = false;
    std::string what;  // "runs out on 2026-12-24, in 29 days"
};
// From `noticeDays` before its end on; nothing before.
[[nodiscard]] std::optional<ValidityConcern> concernAbout(const Validity& validity,
                                                          double now,
                                                          double noticeDays);
// Of the certificate of a console, and of the authority, whose successor has to be installed on
// every tablet.
inline constexpr double kCertificateNoticeDays = 30;
inline constexpr double kAuthorityNoticeDays = 90;

}  // namespace aquarama
