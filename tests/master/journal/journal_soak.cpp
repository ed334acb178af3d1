// SPDX-License-Identifier: Apache-2.0
// A day of the reef with its journal, as fast as it goes, and no nodes: whether memory stays flat,
// files go on in others, and journal and world count the same ticks.
//
//     aquarama_journal_soak [HOURS [MOST_SECONDS]]
//
// Prints a line for each hour of the world, and ends earlier where MOST_SECONDS have passed. Exit
// status 1 where something is wrong.
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <malloc.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "common/base/amounts.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "master/journal/journalled_world.h"

namespace {

using namespace aquarama;  // NOLINT(google-build-using-namespace): a program of one file
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kTicksOfMinute = 3600, kTicksOfHour = 60 * kTicksOfMinute;
constexpr std::uint64_t kTicksOfMoment = 60;
// Of what is allocated, above that of the first hour.
constexpr std::uint64_t kMostGrowth = std::uint64_t{1} << 20U;

// Ends the program at the first thing that is wrong.
void demand(bool isSo, const std::string& otherwise) {
    if (isSo) return;
    std::cerr << "aquarama_journal_soak: " << otherwise << '\n';
    std::exit(1);  // NOLINT(concurrency-mt-unsafe): the only thread that ends it
}

std::uint64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t allocatedBytes() {
    const auto memory = mallinfo2();
    return memory.uordblks + memory.hblkhd;
}

// What visitors do: food each minute, and a hand at the submarine every ten seconds. The disk has
// it before it takes effect, as live() waits for the disk two ticks later.
void visit(journal::JournalledWorld& world) {
    const std::uint64_t tick = world.tick().value, second = tick / kTicksOfMoment;
    if (tick % kTicksOfMoment != kTicksOfMoment - 2 || second % 10 != 0) return;
    if (second % 60 == 0) world.apply(world::DropFood{.position = {0, -3, -4}});
    world.apply(Steering{.ahead = static_cast<std::int8_t>(second % 20 * 10 - 95),
                         .turn = static_cast<std::int8_t>(second % 90)});
}

// How long a world lives, and since when it does.
struct Soak {
    Clock::time_point begin = Clock::now();
    std::uint64_t hours = 24;
    double mostSeconds = 1e9;
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    }
};

// A line of an hour. Returns what is allocated.
std::uint64_t tell(const Soak& soak, journal::JournalledWorld& world, const fs::path& folder) {
    const std::uint64_t allocated = allocatedBytes();
    const auto status = world.journal().report()->status(net::monotonicNow());
    std::cout << fmt::format(
                     "{}  allocated {:.1f} MB, resident {:.1f} MB, recordings {}, {} in this one, "
                     "{} in all, {:.0f} s\n",
                     timeOf(world.tick()),
                     static_cast<double>(allocated) / 1e6,
                     static_cast<double>(residentBytes()) / 1e6,
                     journal::recordingsIn(folder).size(),
                     sizeOf(status.file_bytes()),
                     sizeOf(status.folder_bytes()),
                     soak.seconds())
              << std::flush;
    demand(status.condition() == v1::JournalStatus::WRITTEN && status.pauses() == 0,
           "the journal was not written: " + status.reason());
    demand(status.late_inputs() == 0, "an input took effect before the disk had it");
    return allocated;
}

// Until its hours are over, or the time is.
void live(const Soak& soak, journal::JournalledWorld& world, const fs::path& folder) {
    std::uint64_t afterFirst = 0;
    const std::uint64_t first = world.tick().value;
    while (world.tick().value < first + soak.hours * kTicksOfHour) {
        visit(world);
        world.advance();
        const std::uint64_t lived = world.tick().value - first;
        if (lived % kTicksOfMoment != 0) continue;
        // As fast as the disk takes it: else what waits for it would grow.
        demand(world.journal().flush(), "the journal paused");
        const bool isOver = lived % kTicksOfMinute == 0 && soak.seconds() > soak.mostSeconds;
        if (lived % kTicksOfHour == 0 || isOver) {
            const std::uint64_t allocated = tell(soak, world, folder);
            if (afterFirst == 0) afterFirst = allocated;
            demand(allocated <= afterFirst + kMostGrowth, "memory grows after the first hour");
        }
        if (isOver) return;
    }
}

// That each second of the world is in the journal, once, from its first to its last.
void checkMoments(const fs::path& folder, Tick first, Tick last) {
    std::uint64_t next = (first.value / kTicksOfMoment + 1) * kTicksOfMoment;
    std::uint64_t bytes = 0;
    for (const fs::path& path : journal::recordingsIn(folder)) {
        const wire::Recording recording = wire::readRecording(path.string());
        demand(recording.bytesLeftOver == 0, path.string() + " does not read to its end");
        for (const wire::RecordedHash& hash : recording.checkpoints) {
            demand(hash.tick.value == next, fmt::format("tick {} is not in the journal", next));
            next += kTicksOfMoment;
        }
        bytes += recording.wholeBytes;
        if (recording.checkpoints.empty()) continue;  // it has just begun
        demand(recording.moment && recording.moment->tick == recording.checkpoints.back().tick,
               "moments and hashes differ");
    }
    demand(next > last.value, fmt::format("the journal ends before tick {}", last.value));
    const double days = static_cast<double>(last.value - first.value) / (24 * kTicksOfHour);
    std::cout << fmt::format("{} of recordings a day; every second from {} to {} is there\n",
                             sizeOf(static_cast<std::uint64_t>(static_cast<double>(bytes) / days)),
                             timeOf(first),
                             timeOf(last));
}

}  // namespace

int main(int count, char** arguments) {
    Soak soak;
    if (count > 1) soak.hours = std::strtoull(arguments[1], nullptr, 10);
    if (count > 2) soak.mostSeconds = std::strtod(arguments[2], nullptr);
    demand(soak.hours > 0 && soak.mostSeconds > 0, "HOURS and MOST_SECONDS are numbers above 0");
    const auto assets = simulation::readAssets(AQUARAMA_SOURCE_DIR "/config/scenes/reef.txtpb",
                                               simulation::AssetChoice{});
    const fs::path folder =
        fs::temp_directory_path() / ("aquarama-journal-soak-" + std::to_string(getpid()));
    auto world = journal::makeJournalled(folder, assets, journal::TimeAway::LeftOut);
    soak.begin = Clock::now();
    const Tick first = world->tick();
    live(soak, *world, folder);
    const Tick last = world->tick();
    const std::uint64_t hash = world->hash();
    std::cout << fmt::format("{} of the world in {:.0f} s: {:.0f} ticks a second\n",
                             durationOf(static_cast<double>(last.value - first.value) / 60),
                             soak.seconds(),
                             static_cast<double>(last.value - first.value) / soak.seconds());
    world.reset();
    checkMoments(folder, first, last);
    world = journal::makeJournalled(folder, assets, journal::TimeAway::LeftOut);
    demand(world->tick() == last && world->hash() == hash, "the world that goes on is another");
    std::cout << "the world that goes on from there is the same\n";
    world.reset();
    fs::remove_all(folder);
    return 0;
}
