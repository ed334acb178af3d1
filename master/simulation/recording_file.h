// SPDX-License-Identifier: Apache-2.0
// A recording that is being written.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/base/output_file.h"
#include "common/wire/recording.h"
#include "master/world/world.h"

namespace aquarama::simulation {

// Throws Error where a regular file of this name exists. A pipe or a device may exist.
void requireNewRecording(const std::string& path);

// A recording that grows. A thread of its own writes the entries in their order, so that a slow
// disk holds up nobody. However the program ends, the file is whole up to its last entry.
class RecordingFile {
  public:
    // Throws Error where the file exists or cannot be written.
    RecordingFile(const std::string& path, const wire::AssetBundle& assets);
    // Writes what waits.
    ~RecordingFile();
    RecordingFile(const RecordingFile&) = delete;
    RecordingFile& operator=(const RecordingFile&) = delete;

    // Appends an entry. Never throws, as a full disk must not end a show: the first entry that
    // cannot be written is reported in the log, and recording stops.
    void add(wire::Packet entry);
    // Appends the state of a world, which is copied now and encoded later. Left out where the one
    // before still waits.
    void save(const world::World& world);
    // Returns when all that was appended is in the file. False: it could not be written.
    bool flush();
    // Closes the file after the last entry. Throws Error where an entry could not be written.
    void close();

  private:
    // Either an entry, or the state that waits.
    struct Item {
        wire::Packet entry;
        bool isSave = false;
    };
    void put(Item item);
    void run();
    void write(const Item& item);
    void stop();

    GrowingFile file_;
    world::WorldState state_;  // of the save that waits; of the thread while isSaving_
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Item> waiting_;
    std::size_t waitingBytes_ = 0;
    bool isSaving_ = false, isIdle_ = true, isStopped_ = false;
    std::atomic<bool> isOpen_ = true;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace aquarama::simulation
