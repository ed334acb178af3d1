// SPDX-License-Identifier: Apache-2.0
#include "releases/boot.h"

#include <algorithm>
#include <regex>

namespace aquarama::releases {

namespace {

bool mayStart(const BootEntry& entry) {
    return !entry.triesLeft || *entry.triesLeft > 0;
}

// Whether the boot loader would not come to the good one of this release.
bool isInTheWay(const BootEntry& entry, const ReleaseId& release) {
    return entry.release.serial > release.serial || (entry.release == release && !mayStart(entry));
}

}  // namespace

std::optional<BootEntry> entryOf(const std::string& fileName) {
    static const std::regex form(R"(aquarama-([A-Za-z0-9._~-]+?)(\+(\d{1,4})(-\d{1,4})?)?\.conf)");
    std::smatch match;
    if (!std::regex_match(fileName, match, form) || !isVersion(match[1].str())) return std::nullopt;
    BootEntry entry{.release = {match[1], 0}, .file = fileName};
    if (match[2].matched) entry.triesLeft = std::stoi(match[3]);
    return entry;
}

std::string fileOf(const ReleaseId& release, std::optional<int> triesLeft) {
    return "aquarama-" + release.version +
           (triesLeft ? "+" + std::to_string(*triesLeft) : std::string()) + ".conf";
}

std::vector<BootStep> stepsToStart(const std::vector<BootEntry>& entries,
                                   const ReleaseId& release) {
    std::vector<BootStep> steps;
    const bool isThere = std::ranges::any_of(entries, [&](const BootEntry& entry) {
        return entry.release == release && mayStart(entry);
    });
    if (!isThere)
        steps.push_back(
            {BootStep::What::Write,
             {.release = release, .triesLeft = kTries, .file = fileOf(release, kTries)}});
    for (const BootEntry& entry : entries)
        if (isInTheWay(entry, release)) steps.push_back({BootStep::What::Remove, entry});
    return steps;
}

// Another entry of the same release stays: on FAT, which a power cut may leave with two names for
// one file, its removal would take the content of both.
std::vector<BootStep> stepsToBless(const std::vector<BootEntry>& entries,
                                   const ReleaseId& release) {
    const auto ofRelease = [&](const BootEntry& entry) { return entry.release == release; };
    const bool isGood = std::ranges::any_of(
        entries, [&](const BootEntry& entry) { return ofRelease(entry) && !entry.triesLeft; });
    const auto counted = std::ranges::find_if(entries, ofRelease);
    if (isGood || counted == entries.end()) return {};
    return {{BootStep::What::Rename, *counted, fileOf(release, {})}};
}

std::vector<BootStep> stepsToForget(const std::vector<BootEntry>& entries,
                                    const std::vector<ReleaseId>& kept) {
    std::vector<BootStep> steps;
    for (const BootEntry& entry : entries)
        if (std::ranges::find(kept, entry.release) == kept.end())
            steps.push_back({BootStep::What::Remove, entry});
    return steps;
}

}  // namespace aquarama::releases
