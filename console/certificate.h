// SPDX-License-Identifier: Apache-2.0
// The console's certificate for browsers of other machines, by a small authority of the rig's own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aquarama::console {

// In a folder that its owner alone may read.
struct CertificateFiles {
    std::filesystem::path authority;  // to be installed on tablets
    std::filesystem::path authorityKey;
    std::filesystem::path certificate, key;  // of the console
};
[[nodiscard]] CertificateFiles certificateFilesIn(const std::filesystem::path& folder);

// Makes a certificate for these addresses and names, valid for 397 days (browsers refuse longer
// ones), and the authority where there is none. Returns the authority's fingerprint (SHA-256).
// Throws Error where a file cannot be written.
std::string makeCertificate(const CertificateFiles& files, const std::vector<std::string>& names);

}  // namespace aquarama::console
