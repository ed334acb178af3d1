// SPDX-License-Identifier: Apache-2.0
// A show in a file: all that it was made of, so that it plays on any machine, all that reached it
// from outside, and hashes of its world by which a replay knows that it is the same
// (recording.proto).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/base/wall_hands.h"
#include "common/wire/messages.h"
#include "common/wire/state_codec.h"

namespace aquarama::wire {

inline constexpr std::uint32_t kRecordingVersion = 3;
// Still read: it has no checksums and no saves.
inline constexpr std::uint32_t kFormerRecordingVersion = 2;
// Bounds of what is read and written.
inline constexpr std::size_t kMostSceneBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMostSpeciesBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMostSavedBytes = std::size_t{256} << 20U;
inline constexpr std::uint64_t kMostRecordingBytes = std::uint64_t{1} << 38U;

// One species of a show: its file, the repertoire that moves it, and how many there are. The same
// on the master, in a recording and on a node.
struct SpeciesAssets {
    std::string file;  // for messages: in which file the text is
    std::string text;
    std::vector<std::byte> repertoire;
    std::uint32_t fish = 0;
    std::uint32_t drawings = 0;  // so many of them, the last, wait for visitors' drawings
    // Of the repertoire, where a journal names it only and `repertoire` is empty.
    std::optional<Digest> repertoireDigest = {};
};

// All that a show is made of, as bytes: the same bundle is the same world on any machine.
struct AssetBundle {
    std::uint32_t seed = 1;
    std::string sceneFile;            // for messages
    std::string scene;                // the text
    std::vector<SpeciesAssets> cast;  // as the scene's, the school first
    bool drawingsMayBeEaten = false;  // the fish that wear visitors' drawings
};

// Pellets that a visitor dropped.
struct RecordedFood {
    glm::vec3 position{};  // metres, world frame
    std::uint32_t pellets = 0;
};
// The submarine was put elsewhere.
struct RecordedSubmarine {
    glm::vec3 position{};  // metres, world frame
    glm::vec3 velocityMetresPerSecond{};
};
// The hall's clock was set: the time of day, 0 to 1 (1 excluded), and the length of a day at its
// pace, 0 where it stands still.
struct RecordedClock {
    double timeOfDay = 0.5, lengthSeconds = 0;
};
// A fish that waited came in with a visitor's drawing as its skin.
struct RecordedDrawing {
    std::uint32_t fish = 0;
    std::uint32_t number = 0;  // FishRecord::skin
    Digest picture;            // of the PNG
    int aside = 0;             // from where: -1 left, 0 middle, 1 right
};
// It swims away.
struct RecordedDeparture {
    std::uint32_t fish = 0;
};
// The time of day that the scene goes to within a time and keeps; nothing: that of its clock.
struct RecordedDay {
    std::optional<double> timeOfDay;
    double glideSeconds = 0;
};
// A hunter of this species comes before the wall.
struct RecordedRelease {
    std::uint32_t species = 0;  // its place in the cast
};
// An input that reached the world after `tick` and before the next.
struct RecordedInput {
    Tick tick;
    std::variant<RecordedFood,
                 RecordedSubmarine,
                 Steering,
                 RecordedClock,
                 WallHands,
                 RecordedDrawing,
                 RecordedDeparture,
                 RecordedDay,
                 RecordedRelease>
        input;
};

// A hash of the world at the tick, before any input that reaches it then.
struct RecordedHash {
    Tick tick;
    std::uint64_t hash = 0;
    friend bool operator==(const RecordedHash&, const RecordedHash&) = default;
};

// The whole world at the tick, before any input that reaches it then: where its state lies in the
// file. A reader that wants it reads it from there (readState()), as all of them are large.
struct RecordedSave {
    Tick tick;
    std::uint64_t at = 0, bytes = 0;
};

// When the world was at a tick.
struct RecordedMoment {
    Tick tick;
    std::uint64_t clockNs = 0;  // of the machine's CLOCK_BOOTTIME
    std::string boot;           // names its start
    std::uint64_t unixSeconds = 0;
    // Of the file so far: they took effect before the disk had them.
    std::uint64_t lateInputs = 0;
};

// A show as it was read from a file.
struct Recording {
    std::string source;          // its path, as it was named
    std::uint32_t protocol = 0;  // kProtocolMajor of the program that wrote it
    std::string build;
    AssetBundle assets;
    std::vector<RecordedInput> inputs;      // in the order in which they came
    std::vector<RecordedHash> checkpoints;  // in the order of ticks
    std::vector<RecordedSave> saves;        // in the order of ticks
    bool beginsWithSave = false;            // with the first of them; else at tick 0
    std::optional<RecordedMoment> moment;   // the last of them
    std::optional<RecordedHash> end;        // without: the recording was cut short
    std::uint64_t wholeBytes = 0;           // up to the end of the last whole entry
    std::uint64_t bytesLeftOver = 0;        // behind it: an entry that was being written, or damage

    [[nodiscard]] Tick lastTick() const;  // up to which anything is known
};

// The pieces of the file in order: first beginningOf(), at last endOf(). Repertoires are in it, or
// named by their digests.
enum class Repertoires : std::uint8_t { Inside, Named };
[[nodiscard]] Packet beginningOf(const AssetBundle& assets,
                                 Repertoires repertoires = Repertoires::Inside);
[[nodiscard]] Packet entryOf(const RecordedInput& input);
[[nodiscard]] Packet entryOf(const RecordedHash& checkpoint);
[[nodiscard]] Packet entryOf(Tick tick, std::span<const std::byte> savedState);
[[nodiscard]] Packet entryOf(const RecordedMoment& moment);
[[nodiscard]] Packet endOf(const RecordedHash& end);

// Whether a file with these first bytes is a recording.
[[nodiscard]] bool isRecording(std::span<const std::byte> firstBytes);

// Throws Error where it is no recording, of another version, or an entry cannot be. One that stops
// in the middle of an entry, or that is damaged, is read up to there. Takes no more memory than a
// small multiple of its size, without its saves.
[[nodiscard]] Recording decodeRecording(std::span<const std::byte> bytes,
                                        const std::string& source);
// As above, of a file. Throws Error also where it cannot be read or is too large.
[[nodiscard]] Recording readRecording(const std::string& path);
// As above, but only what the show was made of.
[[nodiscard]] AssetBundle readRecordedAssets(const std::string& path);
// The state of a save. Throws Error where the file has changed since it was read.
[[nodiscard]] std::vector<std::byte> readState(const Recording& recording,
                                               const RecordedSave& save);

// Reasons why a replay may differ from the show, a line each; none where all agrees.
[[nodiscard]] std::vector<std::string> doubtsAbout(const Recording& recording);

}  // namespace aquarama::wire
