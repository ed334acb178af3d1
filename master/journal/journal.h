// SPDX-License-Identifier: Apache-2.0
// The journal of a show: a folder with recordings of its worlds, one after the other, and saves of
// the last ten minutes. A master that was killed goes on from it. Each recording begins with a save
// of the whole world.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/job_thread.h"
#include "common/base/output_file.h"
#include "common/base/units.h"
#include "common/wire/recording.h"
#include "master/conductor/journal_report.h"
#include "master/world/world.h"

namespace aquarama::journal {

// Saves: every five seconds into a file of its own, which is kept for ten minutes; every minute
// into the recording. Of a world whose state is larger than 4 MB they are as much rarer, and its
// files are fewer.
inline constexpr std::uint64_t kTicksBetweenSaves = 300;
inline constexpr std::uint64_t kSavesBetweenRecorded = 12;
inline constexpr std::size_t kMostSaves = 120;
inline constexpr std::size_t kBytesOfASave = std::size_t{4} << 20U;
inline constexpr std::size_t kBytesOfSaves = kMostSaves * kBytesOfASave;
// A recording goes on in another file after a day, and is removed after three.
inline constexpr std::uint64_t kTicksOfAFile = std::uint64_t{24} * 3600 * 60;
inline constexpr std::uint64_t kSecondsOfAFile = std::uint64_t{3} * 24 * 3600;

// Whether both bundles make the same world. Names of files mean nothing.
[[nodiscard]] bool makeOneWorld(const wire::AssetBundle& a, const wire::AssetBundle& b);

// The last world of a journal.
struct LastWorld {
    wire::Recording recording;
    std::vector<std::filesystem::path> saves;  // files, the newest first
};

// The last world of these assets in a folder, as far as it was saved. Nothing where it went on from
// there a few times and never lived for five seconds. What cannot be read is a line in the log.
[[nodiscard]] std::optional<LastWorld> lastWorldIn(const std::filesystem::path& folder,
                                                   const wire::AssetBundle& assets);

// The recordings of a journal, the newest last.
[[nodiscard]] std::vector<std::filesystem::path> recordingsIn(const std::filesystem::path& folder);
// Of all files in a folder, also in folders of it.
[[nodiscard]] std::uint64_t bytesIn(const std::filesystem::path& folder);

// Held while a process writes journals to a folder.
class FolderLock {
  public:
    // Throws Error where another process holds it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int file_ = -1;
};

// Of one show. All writing is on a thread of its own: a disk that stands still, or is full, delays
// no tick. Then the journal pauses, which is an error in the log, and goes on with a save a minute
// after there is room again.
class Journal {
  public:
    // Begins a recording of a world of these assets.
    Journal(std::filesystem::path folder,
            const wire::AssetBundle& assets,
            const world::World& world);
    // Writes what waits.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // Of the tick thread. Appends an entry, which the disk is asked to have at once; returns its
    // number.
    std::uint64_t add(wire::Packet entry);
    // Appends one that may be lost in a power cut.
    void note(wire::Packet entry);
    // Whether the entry of a number is on the disk.
    [[nodiscard]] bool isOnDisk(std::uint64_t number) const { return onDisk_ >= number; }
    // Saves a world as it is now, where its tick is one of those. Skipped where the save before
    // still waits for the disk.
    void save(const world::World& world);
    // Returns when all that was appended is written. False: the journal pauses.
    bool flush();
    // What operators are told of it.
    [[nodiscard]] const std::shared_ptr<conductor::JournalReport>& report() const {
        return report_;
    }

  private:
    void put(wire::Packet entry, std::uint64_t number);
    // Of the thread of jobs.
    void begin(const std::vector<std::byte>& state);  // another file
    void append(const wire::Packet& entry);
    void sync();
    void keepState();
    void recordState(const std::vector<std::byte>& state);
    void keepFile(const std::vector<std::byte>& state);
    void measure();
    [[nodiscard]] std::uint64_t ticksBetweenSaves() const;
    void pause(const std::string& why);
    [[nodiscard]] std::filesystem::path savePathOf(Tick tick) const;

    std::filesystem::path folder_;
    std::shared_ptr<conductor::JournalReport> report_;
    wire::Packet beginning_;   // of every file
    std::uint64_t added_ = 0;  // of the tick thread
    // Of the thread of jobs.
    std::filesystem::path path_;
    GrowingFile file_;
    Tick firstTick_;                           // of the file
    std::deque<std::filesystem::path> saves_;  // of this recording, the oldest first
    std::uint64_t appended_ = 0;               // the last that the disk is to have
    // Of both.
    world::WorldState state_;  // of the save that waits, while isSaving_
    std::atomic<std::uint64_t> onDisk_ = 0;
    std::atomic<std::size_t> stateBytes_ = 0;  // of the last save
    std::atomic<bool> isSaving_ = false, pauses_ = false;
    std::optional<JobThread> thread_;  // last: it uses all of the above
};

}  // namespace aquarama::journal
