// SPDX-License-Identifier: Apache-2.0
#include "common/base/versions.h"

#include <algorithm>
#include <chrono>
#include <span>

#include <spdlog/fmt/chrono.h>

#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr const char* kNoteEnding = ".json";
constexpr std::size_t kMostNoteBytes = 1U << 16U;

fs::path historyOf(fs::path file) {
    return file.replace_extension(".history");
}

fs::path noteOf(fs::path version) {
    return version.replace_extension(kNoteEnding);
}

std::string textOf(const fs::path& file) {
    if (!fs::exists(file)) return {};
    const auto bytes = readWhole(file, kMostNoteBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool isSame(const fs::path& one, const fs::path& other) {
    return fs::is_regular_file(one) && fs::file_size(one) == fs::file_size(other) &&
           digestOf(std::span<const std::byte>(readWhole(one, kMostBlobBytes))) ==
               digestOf(std::span<const std::byte>(readWhole(other, kMostBlobBytes)));
}

// The name of a new version: the present time, but later than all kept versions, even if the clock
// is wrong.
fs::path freshVersion(const fs::path& file, const std::vector<FileVersion>& versions) {
    constexpr std::size_t kTimeLength = 17;
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    const std::string newest = versions.empty() ? "" : versions.front().name;
    const std::string time = std::max(fmt::format("{:%Y-%m-%dT%H%M%S}", fmt::gmtime(now)),
                                      newest.substr(0, kTimeLength));
    std::string name = time;
    for (int i = 2; name <= newest; ++i) name = fmt::format("{}-{:03}", time, i);
    return historyOf(file) / (name + file.extension().string());
}

// The note is written first, so that every version has one.
void keep(const fs::path& file, const std::string& note) {
    if (!fs::is_regular_file(file)) return;
    const auto versions = versionsOf(file);
    const auto kept = std::ranges::find(versions, true, &FileVersion::isInUse);
    const fs::path path = kept == versions.end() ? freshVersion(file, versions) : kept->path;
    if (!note.empty()) writeWhole(noteOf(path), std::as_bytes(std::span(note)));
    if (kept == versions.end()) writeWhole(path, readWhole(file, kMostBlobBytes));
}

void dropOldest(const fs::path& file) {
    auto versions = versionsOf(file);
    for (std::size_t count = versions.size(); count > kMostVersions; --count) {
        const auto oldest = std::find_if(
            versions.rbegin(), versions.rend(), [](const auto& one) { return !one.isInUse; });
        fs::remove(oldest->path);
        fs::remove(noteOf(oldest->path));
        versions.erase(std::next(oldest).base());
    }
}

}  // namespace

std::vector<FileVersion> versionsOf(const fs::path& file) {
    std::vector<FileVersion> versions;
    if (!fs::is_directory(historyOf(file))) return versions;
    for (const auto& entry : fs::directory_iterator(historyOf(file)))
        if (entry.path().extension() == file.extension())
            versions.push_back(
                {.name = entry.path().stem().string(), .path = entry.path(), .note = {}});
    std::ranges::sort(versions, std::greater{}, &FileVersion::name);
    for (FileVersion& version : versions) version.note = textOf(noteOf(version.path));
    const auto inUse = std::ranges::find_if(
        versions, [&](const FileVersion& version) { return isSame(file, version.path); });
    if (inUse != versions.end()) inUse->isInUse = true;
    return versions;
}

void keepVersion(const fs::path& file, const std::string& note) {
    keep(file, note);
    dropOldest(file);
}

void useVersion(const fs::path& file, const FileVersion& version) {
    const auto bytes = readWhole(version.path, kMostBlobBytes);
    keep(file, "");
    writeWhole(file, bytes);
    dropOldest(file);
}

}  // namespace aquarama
