// SPDX-License-Identifier: Apache-2.0
// A hall as one file that travels: a zip archive with the rig and what it names, and within it a
// sealed one with what only the show's user may read. It comes from anywhere: sizes, names and
// digests are checked before anything is written to a disk.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/formats/archive.h"

namespace aquarama {

// A hall that is not at a place at the moment. Names of files have '/' between folders.
struct TravellingHall {
    std::string rig;                          // name of its file, one of `files`
    std::vector<formats::ArchiveFile> files;  // of the hall's folder
    // keys/NAME, drawings/NAME (a file of the rig's folder of keys, or of drawings) and
    // hours.txtpb, which has the passwords of projectors.
    std::vector<formats::ArchiveFile> secrets;
};
inline constexpr const char* kKeysOfHall = "keys/";
inline constexpr const char* kDrawingsOfHall = "drawings/";

// The most bytes of the file of a hall.
inline constexpr std::size_t kMostHallBytes = std::size_t{1} << 30U;

// Where the passphrase comes from; called where there are secrets.
using AskPassphrase = std::function<std::string()>;

// The file of a hall. Throws Error where it is too large, as sealed() does, and as `ask` does.
[[nodiscard]] std::vector<std::byte> encodeHall(const TravellingHall& hall,
                                                const AskPassphrase& ask);
// The hall of a file, which `source` names in errors. Throws Error where the file is none, is
// damaged, was changed since it was sealed, or holds what a hall does not have; where the
// passphrase is wrong; and as `ask` does.
[[nodiscard]] TravellingHall decodeHall(std::span<const std::byte> bytes,
                                        const std::string& source,
                                        const AskPassphrase& ask);

}  // namespace aquarama
