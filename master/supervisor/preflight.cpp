// SPDX-License-Identifier: Apache-2.0
#include "master/supervisor/preflight.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <utility>

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::supervisor {

namespace {

namespace fs = std::filesystem;

// Whether an environment variable has a value.
bool isSet(const char* variable) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

// The first bytes of a file, enough to tell its kind; fewer where it is shorter.
std::string firstBytesOf(const std::string& path) {
    std::array<char, 21> bytes{};
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

// Whether another socket listens there: tries to bind one.
bool isTaken(const addrinfo& place) {
    const int probe = socket(place.ai_family, place.ai_socktype, place.ai_protocol);
    if (probe < 0) return false;
    const int yes = 1;  // as the master does: a connection that has just ended is in nobody's way
    setsockopt(probe, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const bool taken = bind(probe, place.ai_addr, place.ai_addrlen) != 0 && errno == EADDRINUSE;
    close(probe);
    return taken;
}

}  // namespace

// Tests for a display of X11 or Wayland, by the environment alone.
void requireDisplay() {
    if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY"))
        throw Error(
            "there is no display to open windows on: set DISPLAY, or draw without windows by "
            "--headless");
}

// An address that is not numeric passes.
void requireFreePort(const std::string& address) {
    assert(address.starts_with("tcp://"));
    const std::size_t host = address.find("//") + 2;
    const std::size_t colon = address.rfind(':');
    std::string name = address.substr(host, colon - host);
    if (name.starts_with('[')) name = name.substr(1, name.size() - 2);
    if (name == "localhost") name = "127.0.0.1";  // as the master takes it
    addrinfo numeric{};
    numeric.ai_socktype = SOCK_STREAM;
    numeric.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (getaddrinfo(name.c_str(), address.substr(colon + 1).c_str(), &numeric, &found) != 0) return;
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> place(found, &freeaddrinfo);
    if (isTaken(*place))
        throw Error("cannot listen at " + address +
                    ": another program does; end the other show, or choose another port in the "
                    "rig");
}

void requireRecording(const std::string& path) {
    if (!std::ifstream(path)) throw Error(path + ": cannot be read; check the path");
    if (!looksLikeRecording(path))
        throw Error(path + ": is no recording of a show; make one by aquarama run --record FILE");
}

// The letters by which a recording is known come after some lengths.
bool looksLikeRecording(const std::string& path) {
    return firstBytesOf(path).find("AQREC") != std::string::npos;
}

// Its letters are the first bytes of the file.
bool looksLikeRepertoire(const std::string& path) {
    return firstBytesOf(path).starts_with("AQREP");
}

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

std::string ClipPipes::pipeOf(const std::string& channel) const {
    const bool isFilmed = std::ranges::find(channels_, channel) != channels_.end();
    return isFilmed ? (folder_.path() / channel).string() : "";
}

}  // namespace aquarama::supervisor
