// SPDX-License-Identifier: Apache-2.0
// Earlier versions of a file, each whole, in a folder beside it: of hall.mpcdi in hall.history. A
// power cut at any moment leaves the file and each version whole or as they were.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aquarama {

// One earlier version of a file.
struct FileVersion {
    std::string name;  // when it was kept, in UTC: "2026-11-24T210301"
    std::filesystem::path path;
    std::string note;  // what was said of it; may be empty
    bool isInUse = false;
};

// More are not kept: the oldest goes, but never the one in use.
inline constexpr std::size_t kMostVersions = 30;

// The newest first; none where the file has none. Throws Error where the file or a version cannot
// be read.
[[nodiscard]] std::vector<FileVersion> versionsOf(const std::filesystem::path& file);

// Keeps the file as it is now. One that is kept already gets the note, where that is not empty.
// Throws Error where it cannot be read or written.
void keepVersion(const std::filesystem::path& file, const std::string& note);

// Puts a version in the place of the file, which is kept. Throws Error as keepVersion() does.
void useVersion(const std::filesystem::path& file, const FileVersion& version);

}  // namespace aquarama
