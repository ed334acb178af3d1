// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/recording_file.h"

#include <filesystem>
#include <utility>

#include "common/base/log.h"
#include "master/world/world_state.h"

namespace aquarama::simulation {

namespace {

// A disk that stands still for longer than it takes to fill this ends the recording.
constexpr std::size_t kMostWaitingBytes = std::size_t{16} << 20U;

}  // namespace

void requireNewRecording(const std::string& path) {
    std::error_code none;
    if (std::filesystem::is_regular_file(path, none))
        throw Error(path + ": is there already; a recording never overwrites a file: name another");
}

RecordingFile::RecordingFile(const std::string& path, const wire::AssetBundle& assets) {
    requireNewRecording(path);
    file_ = GrowingFile(path);
    file_.append(wire::beginningOf(assets));
    thread_.emplace("recording", kMostWaitingBytes);
}

void RecordingFile::add(wire::Packet entry) {
    if (!isOpen_) return;
    const std::size_t bytes = entry.size();
    const bool isTaken = thread_->put(bytes, [this, entry = std::move(entry)] {
        file_.appendOrLog(entry);
        if (!file_.isOpen()) isOpen_ = false;
    });
    if (isTaken) return;
    isOpen_ = false;
    logError("the disk is too slow for the recording; it ends here, the show goes on");
}

void RecordingFile::save(const world::World& world) {
    if (!isOpen_ || isSaving_) return;
    isSaving_ = true;
    world.save(state_);
    const bool isTaken = thread_->put(0, [this] {
        file_.appendOrLog(wire::entryOf(state_.tick, world::encodeState(state_)));
        isSaving_ = false;
    });
    if (!isTaken) isSaving_ = false;
}

bool RecordingFile::flush() {
    thread_->finish();
    return isOpen_;
}

void RecordingFile::close() {
    thread_.reset();
    file_.close();
}

}  // namespace aquarama::simulation
