// SPDX-License-Identifier: Apache-2.0
#include "common/base/dates.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>

#include <openssl/pem.h>
#include <openssl/x509.h>
#include <spdlog/fmt/chrono.h>

#include "common/base/counted.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama {

namespace {

// Seconds of an OpenSSL time, whose years reach 9999, as timegm() counts them.
double secondsOf(const ASN1_TIME* time) {
    std::tm parts{};
    if (ASN1_TIME_to_tm(time, &parts) != 1) return 0;
    return static_cast<double>(timegm(&parts));
}

}  // namespace

double systemSeconds() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::string dayOf(double seconds) {
    return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(std::floor(seconds))));
}

std::optional<double> secondsOfDay(const std::string& day) {
    std::tm date{};
    const char* const end = strptime(day.c_str(), "%Y-%m-%d", &date);
    if (end == nullptr || *end != '\0') return std::nullopt;
    return static_cast<double>(timegm(&date));
}

// A tolerance of a day: the committer's clock may have been ahead.
std::string clockDoubt(double now, double built) {
    if (now > built - kSecondsOfDay) return {};
    return fmt::format("the clock of this machine says {}, before this program was built ({})",
                       dayOf(now),
                       dayOf(built));
}

Validity validityOf(const std::filesystem::path& certificate) {
    constexpr std::uintmax_t kMostBytes = 64U << 10U;
    const auto bytes = readWhole(certificate, kMostBytes);
    const std::unique_ptr<BIO, decltype(&BIO_free)> memory(
        BIO_new_mem_buf(bytes.data(), static_cast<int>(bytes.size())), &BIO_free);
    const std::unique_ptr<X509, decltype(&X509_free)> read(
        PEM_read_bio_X509(memory.get(), nullptr, nullptr, nullptr), &X509_free);
    if (!read)
        throw Error(certificate.string() +
                    ": is no certificate (PEM); put one there, or remove it and make another with "
                    "--certify");
    return {secondsOf(X509_get0_notBefore(read.get())), secondsOf(X509_get0_notAfter(read.get()))};
}

std::optional<ValidityConcern> concernAbout(const Validity& validity,
                                            double now,
                                            double noticeDays) {
    constexpr double kUrgentDays = 7;
    const double days = (validity.until - now) / kSecondsOfDay;
    const std::string end = dayOf(validity.until);
    if (now < validity.from)
        return ValidityConcern{true,
                               "is not valid before " + dayOf(validity.from) +
                                   ", and the clock of this machine says " + dayOf(now)};
    if (days <= 0) return ValidityConcern{true, "ran out on " + end};
    if (days > noticeDays) return std::nullopt;
    const int whole = static_cast<int>(days);
    return ValidityConcern{days <= kUrgentDays,
                           whole == 0 ? "runs out on " + end + ", within a day"
                                      : "runs out on " + end + ", in " +
                                            counted(static_cast<std::uint64_t>(whole), "day")};
}

}  // namespace aquarama
