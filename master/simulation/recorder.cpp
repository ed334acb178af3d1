// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/recorder.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "common/units/error.h"
#include "common/units/log.h"
#include "master/simulation/inputs.h"

namespace aquarama::simulation {

namespace {

bool wrote(std::ofstream& file, const wire::Packet& bytes) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return static_cast<bool>(file.flush());
}

std::string reason() {
    return std::system_category().message(errno);
}

}  // namespace

void requireNewRecording(const std::string& path) {
    if (std::filesystem::exists(path))
        throw Error(path + ": is there already; a recording never overwrites a file: name another");
}

RecordingFile::RecordingFile(std::string path, const wire::AssetBundle& assets)
    : path_(std::move(path)) {
    requireNewRecording(path_);
    file_.open(path_, std::ios::binary);
    if (!file_ || !wrote(file_, wire::beginningOf(assets)))
        throw Error(path_ + ": cannot be written: " + reason());
}

void RecordingFile::add(const wire::Packet& entry) {
    if (!file_.is_open() || wrote(file_, entry)) return;
    logError("{}: the show is recorded no further: {}", path_, reason());
    file_.close();
}

RecordedWorld::RecordedWorld(conductor::Simulation& world, RecordingFile& file)
    : SimulationDecorator(world), file_(file) {
    file_.add(wire::entryOf(now()));
}

RecordedWorld::~RecordedWorld() {
    file_.add(wire::endOf(now()));
}

void RecordedWorld::advance() {
    for (const world::WorldInput& input : std::exchange(pending_, {})) {
        file_.add(wire::entryOf(recorded(world_.tick(), input)));
        world_.apply(input);
    }
    world_.advance();
    if (world_.tick().value % kTicksBetweenCheckpoints == 0) file_.add(wire::entryOf(now()));
}

}  // namespace aquarama::simulation
