// SPDX-License-Identifier: Apache-2.0
#include "master/journal/journal.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <fstream>
#include <functional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "master/world/world_state.h"

namespace aquarama::journal {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRecordings = ".aqrec";
constexpr const char* kSaves = ".saves";
constexpr const char* kSave = ".aqsav";
// A world that went on so many times, and never lived for five seconds, is given up.
constexpr int kMostShortLives = 3;
// What waits for a disk that stands still.
constexpr std::size_t kMostWaitingBytes = std::size_t{16} << 20U;

// Paths in a folder with an ending, by name.
std::vector<fs::path> filesIn(const fs::path& folder, const char* ending) {
    std::vector<fs::path> paths;
    std::error_code problem;
    for (fs::directory_iterator at(folder, problem), end; !problem && at != end;
         at.increment(problem))
        if (at->path().extension() == ending) paths.push_back(at->path());
    std::ranges::sort(paths);
    return paths;
}

Digest digestOfRepertoire(const wire::SpeciesAssets& species) {
    return species.repertoireDigest ? *species.repertoireDigest : digestOf(species.repertoire);
}

// An error of a file in a folder, for operators: the log has the path.
std::string withoutPath(const std::string& error, const fs::path& folder) {
    const std::size_t end = error.find(": ");
    const bool hasPath = error.starts_with(folder.string()) && end != std::string::npos;
    return hasPath ? "it " + error.substr(end + 2) : error;
}

fs::path savesOf(const fs::path& recording) {
    return fs::path(recording).replace_extension(kSaves);
}

// A new name for a recording, which sorts behind all before: the time, and a number where there is
// one of this second.
fs::path newRecordingIn(const fs::path& folder) {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 32> name{};
    std::strftime(name.data(), name.size(), "%Y-%m-%dT%H-%M-%SZ", &utc);
    for (int number = 0;; ++number) {
        fs::path path = folder / fmt::format("{}.{:03}{}", name.data(), number, kRecordings);
        if (!fs::exists(path)) return path;
    }
}

// Removes recordings, with their saves, that nobody wrote to for days.
void removeOldIn(const fs::path& folder) {
    std::error_code none;
    const auto oldest = fs::file_time_type::clock::now() - std::chrono::seconds(kSecondsOfAFile);
    for (const fs::path& path : recordingsIn(folder)) {
        const auto written = fs::last_write_time(path, none);
        if (none || written >= oldest) continue;
        fs::remove(path, none);
        fs::remove_all(savesOf(path), none);
    }
    for (const fs::path& saves : filesIn(folder, kSaves))
        if (fs::is_empty(saves, none)) fs::remove(saves, none);
}

}  // namespace

std::vector<fs::path> recordingsIn(const fs::path& folder) {
    return filesIn(folder, kRecordings);
}

std::uint64_t bytesIn(const fs::path& folder) {
    std::uint64_t bytes = 0;
    std::error_code problem, none;
    for (fs::recursive_directory_iterator at(folder, problem), end; !problem && at != end;
         at.increment(problem)) {
        const std::uintmax_t size = at->is_regular_file(none) ? at->file_size(none) : 0;
        if (!none) bytes += size;
    }
    return bytes;
}

bool makeOneWorld(const wire::AssetBundle& a, const wire::AssetBundle& b) {
    const auto isSame = [](const wire::SpeciesAssets& one, const wire::SpeciesAssets& other) {
        return one.text == other.text && one.fish == other.fish && one.drawings == other.drawings &&
               digestOfRepertoire(one) == digestOfRepertoire(other);
    };
    return a.seed == b.seed && a.scene == b.scene && a.drawingsMayBeEaten == b.drawingsMayBeEaten &&
           std::ranges::equal(a.cast, b.cast, isSame);
}

std::optional<LastWorld> lastWorldIn(const fs::path& folder, const wire::AssetBundle& assets) {
    std::vector<fs::path> recordings = recordingsIn(folder);
    std::ranges::reverse(recordings);
    int shortLives = 0;
    std::optional<LastWorld> found;
    for (const fs::path& path : recordings) {
        try {
            if (!makeOneWorld(wire::readRecordedAssets(path.string()), assets)) continue;
            std::vector<fs::path> saves = filesIn(savesOf(path), kSave);
            std::ranges::reverse(saves);
            const bool livedShortly = saves.size() < 2;
            if (!found) found = {wire::readRecording(path.string()), std::move(saves)};
            if (found->recording.saves.empty()) found.reset();  // killed as it began
            if (!livedShortly) return found;
            if (++shortLives == kMostShortLives) break;
        } catch (const Error& problem) {
            logWarning("{}; an earlier journal is tried", problem.what());
        }
    }
    if (shortLives < kMostShortLives) return found;
    logWarning("{}: its world went on {} times and did not live for five seconds; a new one begins",
               folder.string(),
               kMostShortLives);
    return std::nullopt;
}

FolderLock::FolderLock(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    if (file_ >= 0) ::close(file_);
    throw Error(error == EWOULDBLOCK
                    ? folder.string() + ": another show of this rig keeps its journal there"
                    : folder.string() + ": " + whyNotWritten(error));
}

FolderLock::~FolderLock() {
    ::close(file_);
}

Journal::Journal(fs::path folder, const wire::AssetBundle& assets, const world::World& world)
    : folder_{std::move(folder)},
      report_{std::make_shared<conductor::JournalReport>()},
      beginning_{wire::beginningOf(assets, wire::Repertoires::Named)} {
    world.save(state_);
    isSaving_ = true;
    thread_.emplace("journal", kMostWaitingBytes, [this] { sync(); });
    thread_->put(0, [this] {
        keepState();
        isSaving_ = false;
    });
}

Journal::~Journal() = default;

std::uint64_t Journal::add(wire::Packet entry) {
    put(std::move(entry), ++added_);
    return added_;
}

void Journal::note(wire::Packet entry) {
    put(std::move(entry), 0);
}

// A file with a gap is of no use: what comes behind is left out, until another file begins.
void Journal::put(wire::Packet entry, std::uint64_t number) {
    const std::size_t bytes = entry.size();
    const bool isTaken = thread_->put(bytes, [this, number, entry = std::move(entry)] {
        append(entry);
        if (number > 0) appended_ = number;
    });
    if (!isTaken) pause("its disk has stood still for too long");
}

void Journal::save(const world::World& world) {
    if (world.tick().value % ticksBetweenSaves() != 0 || isSaving_) return;
    isSaving_ = true;
    world.save(state_);
    const bool isTaken = thread_->put(0, [this] {
        keepState();
        isSaving_ = false;
    });
    if (!isTaken) isSaving_ = false;
}

std::uint64_t Journal::ticksBetweenSaves() const {
    return kTicksBetweenSaves * (1 + stateBytes_ / kBytesOfASave);
}

bool Journal::flush() {
    thread_->finish();
    return !pauses_;
}

void Journal::begin(const std::vector<std::byte>& state) {
    removeOldIn(folder_);
    path_ = newRecordingIn(folder_);
    file_ = GrowingFile(path_);
    file_.append(beginning_);
    file_.append(wire::entryOf(state_.tick, state));
    firstTick_ = state_.tick;
    pauses_ = false;
    report_->goesOn();
}

void Journal::append(const wire::Packet& entry) {
    if (pauses_) return;
    const conductor::JournalReport::DiskUse use(*report_);
    try {
        file_.append(entry);
    } catch (const Error& problem) {
        pause(problem.what());
    }
}

void Journal::sync() {
    if (pauses_ || appended_ == onDisk_) return;
    const conductor::JournalReport::DiskUse use(*report_);
    if (file_.sync())
        onDisk_ = appended_;
    else
        pause(path_.string() + ": " + whyNotWritten(errno));
}

void Journal::pause(const std::string& why) {
    if (pauses_.exchange(true)) return;
    report_->paused(withoutPath(why, folder_));
    logError("the journal of the show pauses: {}; the show goes on", why);
}

void Journal::keepState() {
    const std::vector<std::byte> state = world::encodeState(state_);
    stateBytes_ = state.size();
    const conductor::JournalReport::DiskUse use(*report_);
    try {
        recordState(state);
        if (!pauses_) keepFile(state);
    } catch (const Error& problem) {
        pause(problem.what());
    }
    measure();
}

void Journal::measure() {
    std::error_code none;
    const std::uintmax_t size = fs::file_size(path_, none);
    report_->measured(
        {.file = none ? 0 : size, .folder = bytesIn(folder_), .free = freeBytesAt(folder_)});
}

// What pauses, or is full, begins anew at the next minute.
void Journal::recordState(const std::vector<std::byte>& state) {
    const bool isFull = state_.tick.value >= firstTick_.value + kTicksOfAFile;
    const bool isDue = state_.tick.value % (kSavesBetweenRecorded * ticksBetweenSaves()) == 0;
    const bool isFirst = path_.empty();
    if (isFirst || (isDue && (pauses_ || isFull))) {
        begin(state);
        if (!isFirst) logInfo("the journal of the show goes on in {}", path_.string());
    } else if (isDue) {
        append(wire::entryOf(state_.tick, state));
    }
}

void Journal::keepFile(const std::vector<std::byte>& state) {
    OutputFile file(savePathOf(state_.tick), FileAccess::Usual, FileSafety::Quick);
    file.write(state);
    file.finish();
    saves_.push_back(savePathOf(state_.tick));
    report_->saved();
    std::error_code none;
    const std::size_t most = std::clamp(kBytesOfSaves / state.size(), std::size_t{2}, kMostSaves);
    while (saves_.size() > most) {
        fs::remove(saves_.front(), none);
        saves_.pop_front();
    }
}

fs::path Journal::savePathOf(Tick tick) const {
    return savesOf(path_) / fmt::format("{:012}{}", tick.value, kSave);
}

}  // namespace aquarama::journal
