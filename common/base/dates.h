// SPDX-License-Identifier: Apache-2.0
// Whether the clock of this machine is plausible, and how long certificates are valid. All times
// are seconds of Unix time; days are of UTC.
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

// The present time by the system clock, which a user may change.
[[nodiscard]] double systemSeconds();
// "2026-11-25"
[[nodiscard]] std::string dayOf(double seconds);
// The first second of the day "2026-11-25". Empty where the text is not a day.
[[nodiscard]] std::optional<double> secondsOfDay(const std::string& day);

// A sentence that says why a clock at `now` is certainly wrong: it is more than a day before the
// program was built. Empty where the clock may be right.
[[nodiscard]] std::string clockDoubt(double now, double built);
// What the user should do about a wrong clock, for an error message.
inline constexpr const char* kSetTheClock =
    "set it (timedatectl set-ntp true, or date --set), and see that its battery is good";

// The period in which a certificate is valid.
struct Validity {
    double from = 0, until = 0;
};
// Reads the period from a PEM file. Throws Error where the file cannot be read or contains no
// certificate.
[[nodiscard]] Validity validityOf(const std::filesystem::path& certificate);

// A warning about a certificate that expires soon. `isUrgent`: browsers refuse it, or will within a
// week.
struct ValidityConcern {
    bool isUrgent = false;
    std::string what;  // "runs out on 2026-12-24, in 29 days"
};
// The warning, from `noticeDays` before the end of the period; empty earlier.
[[nodiscard]] std::optional<ValidityConcern> concernAbout(const Validity& validity,
                                                          double now,
                                                          double noticeDays);
// The values of `noticeDays`: for a console's certificate, and for its authority, whose successor
// must be installed on every tablet.
inline constexpr double kCertificateNoticeDays = 30;
inline constexpr double kAuthorityNoticeDays = 90;

}  // namespace aquarama
