// SPDX-License-Identifier: Apache-2.0
// A recording that is being written.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "common/base/job_thread.h"
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
    GrowingFile file_;
    world::WorldState state_;  // of the save that waits; of the thread while isSaving_
    std::atomic<bool> isSaving_ = false, isOpen_ = true;
    std::optional<JobThread> thread_;  // last: it uses all of the above
};

}  // namespace aquarama::simulation
