// SPDX-License-Identifier: Apache-2.0
#include "common/cli/clip.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <unistd.h>

#include "common/units/error.h"

namespace aquarama::cli {

namespace {

namespace fs = std::filesystem;

std::string reason() {
    return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): this process has one thread
}

}  // namespace

bool showsAllChannels(const std::string& of) {
    return of == "panorama" || of == "hall";
}

std::vector<std::string> channelsFor(const config::Rig& rig, const std::string& of) {
    std::vector<std::string> names;
    for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
    if (showsAllChannels(of)) return names;
    if (std::ranges::find(names, of) != names.end()) return {of};
    std::string known = "panorama, hall";
    for (const std::string& name : names) known += ", " + name;
    throw Error("--clip-of " + of + ": rig \"" + rig.name +
                "\" has no such channel; choose one of " + known);
}

ClipPipes::ClipPipes(std::vector<std::string> channels) : channels_(std::move(channels)) {
    std::string pattern = (fs::temp_directory_path() / "aquarama-clip-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw Error(pattern + ": no folder can be made for the clip's sockets (" + reason() +
                    "); set TMPDIR to a folder of a local disk");
    folder_ = pattern;
}

ClipPipes::~ClipPipes() {
    std::error_code none;
    fs::remove_all(folder_, none);
}

std::string ClipPipes::pipeOf(const std::string& channel) const {
    const bool isFilmed = std::ranges::find(channels_, channel) != channels_.end();
    return isFilmed ? (folder_ / channel).string() : "";
}

}  // namespace aquarama::cli
