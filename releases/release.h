// SPDX-License-Identifier: Apache-2.0
// A release: a folder that is named as its version, with plain files, the list of their SHA-256 and
// the signature of that list by the key of the show.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/digest.h"

namespace aquarama::releases {

// Which release. Of two the one with the higher serial is newer: the second in which it was signed;
// 0 of one that nobody has signed. No version: none.
struct ReleaseId {
    std::string version;
    std::uint64_t serial = 0;
    friend bool operator==(const ReleaseId&, const ReleaseId&) = default;
    // Whether this names a release.
    explicit operator bool() const { return !version.empty(); }
};

// A file of a release. Its name has no folder.
struct ReleaseFile {
    std::string name;
    Digest digest;
};

// What its list says.
struct ReleaseContent {
    ReleaseId id;
    std::vector<ReleaseFile> files;
};

// The list, which `sha256sum -c` reads, and its signature.
inline constexpr const char* kListFile = "SHA256SUMS";
inline constexpr const char* kSignatureFile = "SHA256SUMS.sig";
// Bounds of what is read from a disk or a peer.
inline constexpr std::size_t kMostListBytes = std::size_t{64} << 10U;
inline constexpr std::size_t kMostSignatureBytes = 256;
// Of a file: more does not go onto the system partition, which is FAT.
inline constexpr std::uint64_t kMostReleaseFileBytes = (std::uint64_t{1} << 32U) - 1;

// Up to 64 letters, digits and . _ ~ -, the first a letter or a digit: no + by which boot loaders
// count tries, and no path.
[[nodiscard]] bool isVersion(std::string_view text);

// Writes list and signature, with the folder's name as the version. Throws Error where the folder
// has no files, or has other folders, or where it is no key.
ReleaseContent signRelease(const std::filesystem::path& folder,
                           std::uint64_t serial,
                           const std::string& secretPem,
                           const std::string& keySource);

// The public key of a show, and its file for errors.
struct ShowKey {
    std::string pem;
    std::string source;
};
// Throws Error where it cannot be read.
[[nodiscard]] ShowKey readShowKey(const std::filesystem::path& file);

// The release of a list that the holder of the key has signed. `source` names the list in errors.
// Throws Error: wrongly signed, or no list.
[[nodiscard]] ReleaseContent signedList(std::span<const std::byte> list,
                                        std::span<const std::byte> signature,
                                        const ShowKey& key,
                                        const std::string& source);

// Throws Error, which names release and file, where the folder is not what was signed: changed,
// cut, missing, more files, another name, wrongly signed.
ReleaseContent checkRelease(const std::filesystem::path& folder, const ShowKey& key);
// Throws Error where a release is older than serial `least`.
void requireSerial(const ReleaseContent& release, std::uint64_t least);

// Of the list in a folder, whoever has signed it; serial 0 where there is none.
[[nodiscard]] ReleaseId idIn(const std::filesystem::path& folder);

}  // namespace aquarama::releases
