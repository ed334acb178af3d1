// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/recording_file.h"

#include <filesystem>
#include <utility>

#include <pthread.h>

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
    thread_ = std::thread([this] { run(); });
}

RecordingFile::~RecordingFile() {
    stop();
}

void RecordingFile::add(wire::Packet entry) {
    put({std::move(entry), false});
}

void RecordingFile::save(const world::World& world) {
    {
        const std::lock_guard lock(mutex_);
        if (isSaving_) return;
        isSaving_ = true;
    }
    world.save(state_);
    put({{}, true});
}

bool RecordingFile::flush() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return isIdle_ && waiting_.empty(); });
    return isOpen_;
}

void RecordingFile::close() {
    stop();
    file_.close();
}

void RecordingFile::put(Item item) {
    {
        const std::lock_guard lock(mutex_);
        if (!isOpen_) return;
        waitingBytes_ += item.entry.size();
        if (waitingBytes_ > kMostWaitingBytes) {
            isOpen_ = false;
            logError("the disk is too slow for the recording; it ends here, the show goes on");
        }
        waiting_.push_back(std::move(item));
    }
    changed_.notify_all();
}

void RecordingFile::run() {
    pthread_setname_np(pthread_self(), "recording");
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return isStopped_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Item item = std::move(waiting_.front());
        waiting_.pop_front();
        isIdle_ = false;
        lock.unlock();
        if (isOpen_) write(item);
        lock.lock();
        waitingBytes_ -= item.entry.size();
        if (item.isSave) isSaving_ = false;
        isIdle_ = true;
        changed_.notify_all();
    }
}

void RecordingFile::write(const Item& item) {
    file_.appendOrLog(item.isSave ? wire::entryOf(state_.tick, world::encodeState(state_))
                                  : item.entry);
    if (!file_.isOpen()) isOpen_ = false;
}

void RecordingFile::stop() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        isStopped_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

}  // namespace aquarama::simulation
