// SPDX-License-Identifier: Apache-2.0
// The console's certificate for browsers of other machines, by a small authority of the rig's own:
// how it is made, and how it is renewed before it runs out.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/dates.h"
#include "console/access.h"
#include "console/alerts.h"

namespace aquarama::console {

// In a folder that its owner alone may read.
struct CertificateFiles {
    std::filesystem::path authority;  // to be installed on tablets
    std::filesystem::path authorityKey;
    std::filesystem::path certificate, key;  // of the console
};
[[nodiscard]] CertificateFiles certificateFilesIn(const std::filesystem::path& folder);

// What is made now, and by a program that was built then: before that no clock is right.
struct CertificateClock {
    UnixSeconds now = 0, built = 0;
};

// What makeCertificate() has made.
struct MadeCertificate {
    std::string fingerprint;      // of the authority, SHA-256
    bool isNewAuthority = false;  // to be installed on every tablet
    UnixSeconds until = 0;
};
// Makes a certificate for these addresses and names, valid for 397 days (browsers refuse longer
// ones) and no longer than the authority; and an authority for ten years where there is none, it
// has run out, or `takesNewAuthority`. Throws Error where a file cannot be written, the authority's
// key is elsewhere, or the clock is wrong for certain.
MadeCertificate makeCertificate(const CertificateFiles& files,
                                const std::vector<std::string>& names,
                                const CertificateClock& clock,
                                bool takesNewAuthority = false);

// Looks after the certificate of a console that runs. A month before it runs out, and where it is
// not valid yet, it is renewed by the rig's authority, for the same names and with the same key.
// One that somebody else has signed is only watched. One thread uses it.
class CertificateKeeper {
  public:
    // `certify`: the command that makes another, for texts. Throws Error where the certificate
    // cannot be read.
    CertificateKeeper(CertificateFiles files, std::string certify, UnixSeconds built);

    // Every ten seconds. Renews what is due, and says whether the files are others than those that
    // were last taken: somebody may have put another certificate there.
    [[nodiscard]] bool tend(UnixSeconds now);
    // The server has taken the files, or why not.
    void taken();
    void refused(const std::string& why);

    // What is to be alerted now: from 30 days before its end; anew from 7 days, and when it is
    // over. Also of the authority, from 90 days on. A change is logged, so once a day.
    [[nodiscard]] std::vector<Fault> faults(UnixSeconds now);
    [[nodiscard]] const CertificateFiles& files() const { return files_; }
    [[nodiscard]] const Validity& validity() const { return validity_; }

  private:
    // Size and time of change, of certificate and key.
    using Stamp = std::array<std::int64_t, 4>;
    [[nodiscard]] Stamp look() const;
    void read();
    [[nodiscard]] bool isDue(UnixSeconds now) const;

    CertificateFiles files_;
    std::string certify_;
    UnixSeconds built_;
    Stamp stamp_{};  // of what the server has
    Validity validity_;
    std::optional<Validity> authority_;  // none: not on this machine
    bool isOurs_ = false;                // the authority has signed it
    int callsToNextTry_ = 0;
    std::string whyNotRenewed_, whyNotTaken_;
    std::string logged_;  // the last line in the log
};

}  // namespace aquarama::console
