// SPDX-License-Identifier: Apache-2.0
#include "releases/machine.h"

#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <sstream>

#include "common/base/log.h"

namespace aquarama::releases {

namespace {

// In single quotes, as the shell takes any text.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

}  // namespace

std::string Machine::ask(const std::string& words) const {
    constexpr std::size_t kMostBytes = std::size_t{64} << 10U;
    FILE* const pipe = popen((quoted(program_) + " " + words).c_str(), "re");
    std::string said;
    std::array<char, 4096> part{};
    std::size_t count = 0;
    while (pipe != nullptr && (count = std::fread(part.data(), 1, part.size(), pipe)) > 0)
        if (said.size() < kMostBytes) said.append(part.data(), count);
    if (pipe == nullptr || pclose(pipe) != 0)
        throw Error(program_.string() + " " + words + ": has failed; see what it says");
    return said;
}

Machine::Started Machine::started() const {
    std::istringstream words(ask("started"));
    Started started;
    if (!(words >> started.version >> started.boot) || !isVersion(started.version))
        throw Error(program_.string() + " started: says no version and boot; see docs/releases.md");
    return started;
}

std::uint64_t Machine::frames() const {
    std::istringstream words(ask("frames"));
    std::uint64_t frames = 0;
    return words >> frames ? frames : std::numeric_limits<std::uint64_t>::max();
}

void Machine::show(bool isOn) const {
    static_cast<void>(ask(isOn ? "show" : "dark"));
}

std::string Machine::entry(const ReleaseId& release) const {
    return ask("entry " + release.version + " " + std::to_string(release.serial));
}

void Machine::reboot() const {
    static_cast<void>(ask("reboot"));
}

}  // namespace aquarama::releases
