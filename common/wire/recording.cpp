// SPDX-License-Identifier: Apache-2.0
#include "common/wire/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wire/messages.h"
#include "common/wire/recording.pb.h"

namespace aquarama::wire {
namespace {

constexpr std::string_view kMagic = "AQREC";
// Of a header behind its length: the tag and the length of the entry's field, then of the magic's.
constexpr std::size_t kMostBytesBeforeMagic = 16;
constexpr std::size_t kMostLengthBytes = 5;
constexpr std::size_t kMostRepertoireBytes = std::size_t{64} << 20U;
constexpr std::size_t kMostEntryBytes = kMostRepertoireBytes + kMostSpeciesBytes + 4096;
constexpr std::size_t kMostSmallEntryBytes = 256;             // of inputs and hashes
constexpr std::uint64_t kMostTick = std::uint64_t{1} << 32U;  // two years
constexpr float kMostMetres = 10'000;
constexpr std::uint32_t kMostPellets = 65'535;
constexpr double kMostDaySeconds = 1.0e9;
constexpr double kMostGlideSeconds = 3600;

// An entry after its length as a varint, as protobuf's own tools delimit messages.
Packet delimited(const v1::RecordingEntry& entry) {
    const std::size_t size = entry.ByteSizeLong();
    Packet bytes;
    for (std::size_t rest = size;; rest >>= 7U) {
        const bool more = rest > 0x7F;
        bytes.push_back(static_cast<std::byte>((rest & 0x7FU) | (more ? 0x80U : 0U)));
        if (!more) break;
    }
    const std::size_t start = bytes.size();
    bytes.resize(start + size);
    entry.SerializeToArray(bytes.data() + start, static_cast<int>(size));
    return bytes;
}

void append(Packet& bytes, const Packet& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
}

void write(const SpeciesAssets& species, v1::RecordedSpecies& message) {
    // The folders of one machine mean nothing on another.
    message.set_file(std::filesystem::path(species.file).filename().string());
    message.set_text(species.text);
    message.set_repertoire(species.repertoire.data(), species.repertoire.size());
    message.set_fish(species.fish);
    if (species.drawings > 0) message.set_drawings(species.drawings);
}

void write(const RecordedFood& food, v1::RecordedInput& message) {
    auto& written = *message.mutable_food();
    written.set_x(food.position.x);
    written.set_y(food.position.y);
    written.set_z(food.position.z);
    written.set_pellets(food.pellets);
}

void write(const RecordedSubmarine& submarine, v1::RecordedInput& message) {
    auto& written = *message.mutable_submarine();
    written.set_x(submarine.position.x);
    written.set_y(submarine.position.y);
    written.set_z(submarine.position.z);
    written.set_velocity_x(submarine.velocityMetresPerSecond.x);
    written.set_velocity_y(submarine.velocityMetresPerSecond.y);
    written.set_velocity_z(submarine.velocityMetresPerSecond.z);
}

void write(const Steering& steering, v1::RecordedInput& message) {
    auto& written = *message.mutable_steering();
    written.set_ahead(steering.ahead);
    written.set_aside(steering.aside);
    written.set_up(steering.up);
    written.set_turn(steering.turn);
    written.set_tilt(steering.tilt);
}

void write(const RecordedClock& clock, v1::RecordedInput& message) {
    message.mutable_clock()->set_time_of_day(clock.timeOfDay);
    message.mutable_clock()->set_length_s(clock.lengthSeconds);
}

void write(const WallHands& hands, v1::RecordedInput& message) {
    v1::RecordedHands& recorded = *message.mutable_hands();
    for (const WallHand& hand : hands) {
        recorded.add_ids(hand.id);
        for (const int axis : {0, 1, 2}) recorded.add_points(hand.point[axis]);
    }
}

void write(const RecordedDrawing& drawing, v1::RecordedInput& message) {
    v1::RecordedDrawing& recorded = *message.mutable_drawing();
    recorded.set_fish(drawing.fish);
    recorded.set_number(drawing.number);
    recorded.set_picture(bytesOf(drawing.picture));
    recorded.set_aside(drawing.aside);
}

void write(const RecordedDeparture& departure, v1::RecordedInput& message) {
    message.mutable_departure()->set_fish(departure.fish);
}

void write(const RecordedDay& day, v1::RecordedInput& message) {
    v1::RecordedDay& recorded = *message.mutable_day();
    if (day.timeOfDay) recorded.set_time_of_day(*day.timeOfDay);
    recorded.set_glide_s(day.glideSeconds);
}

void write(const RecordedRelease& release, v1::RecordedInput& message) {
    message.mutable_release()->set_species(release.species);
}

void write(const RecordedHash& hash, v1::RecordedHash& message) {
    message.set_tick(hash.tick.value);
    message.set_hash(hash.hash);
}

// Reads a recording entry by entry; every message says at which byte the file is wrong.
class Reader {
  public:
    Reader(std::span<const std::byte> bytes, std::string source)
        : bytes_(bytes), source_(std::move(source)) {}

    Recording read() {
        readHeader();
        while (recording_.assets.cast.size() < speciesCount_) readSpecies();
        while (!recording_.end && nextEntry()) readEvent();
        if (recording_.end && at_ != bytes_.size()) fail("goes on behind its end");
        return std::move(recording_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(source_ + ": byte " + std::to_string(start_) + ": the recording " + what +
                    "; take another copy of it");
    }

    // The length of the next entry; false where the file ends before or within it.
    bool nextLength(std::size_t& length) {
        length = 0;
        for (std::size_t i = 0; i < kMostLengthBytes && at_ + i < bytes_.size(); ++i) {
            const auto byte = std::to_integer<std::size_t>(bytes_[at_ + i]);
            length |= (byte & 0x7FU) << (7 * i);
            if (byte > 0x7F) continue;
            at_ += i + 1;
            return true;
        }
        if (bytes_.size() - at_ >= kMostLengthBytes) fail("is damaged");
        return false;
    }

    // False: the file ends here, perhaps in the middle of an entry.
    bool nextEntry() {
        start_ = at_;
        std::size_t length = 0;
        if (!nextLength(length) || length > bytes_.size() - at_) {
            if (length > kMostEntryBytes) fail("is damaged");
            recording_.bytesLeftOver = bytes_.size() - start_;
            return false;
        }
        if (length > kMostEntryBytes ||
            !entry_.ParseFromArray(bytes_.data() + at_, static_cast<int>(length)))
            fail("is damaged");
        at_ += length;
        entryBytes_ = length;
        return true;
    }

    // The version is checked before anything that may differ between versions.
    void readHeader() {
        if (!isRecording(bytes_)) throw Error(source_ + ": is not a recording of a show");
        if (!nextEntry() || !entry_.has_header()) fail("ends within its first entry");
        const v1::RecordingHeader& header = entry_.header();
        if (header.version() != kRecordingVersion)
            throw Error(source_ + ": is a recording of version " +
                        std::to_string(header.version()) + ", written by " +
                        printed(header.build()) + "; this program reads version " +
                        std::to_string(kRecordingVersion) + ": use the program that wrote it");
        if (!header.has_protocol() || !header.has_seed() || !header.has_scene() ||
            header.scene().size() > kMostSceneBytes || header.species_count() > kMostSpecies)
            fail("has a damaged header");
        recording_.protocol = header.protocol();
        recording_.build = printed(header.build());
        recording_.assets.seed = header.seed();
        recording_.assets.sceneFile = source_ + ": its scene";
        recording_.assets.scene = header.scene();
        recording_.assets.drawingsMayBeEaten = header.drawings_may_be_eaten();
        speciesCount_ = header.species_count();
    }

    // Names are shown with the recording's own, since the file of a species lies elsewhere.
    void readSpecies() {
        if (!nextEntry()) fail("ends before it has all its species");
        const v1::RecordedSpecies& species = entry_.species();
        if (!entry_.has_species() || !species.has_fish() || species.fish() > kMostFish - fish_ ||
            species.text().size() > kMostSpeciesBytes || species.drawings() > species.fish() ||
            species.repertoire().size() > kMostRepertoireBytes)
            fail("has a damaged species");
        fish_ += species.fish();
        const auto* first = reinterpret_cast<const std::byte*>(species.repertoire().data());
        recording_.assets.cast.push_back({source_ + ": its " + printed(species.file()),
                                          species.text(),
                                          {first, first + species.repertoire().size()},
                                          species.fish(),
                                          species.drawings()});
    }

    // What happened after the species: inputs, hashes, and the end.
    void readEvent() {
        if (entryBytes_ > kMostSmallEntryBytes) fail("is damaged");
        switch (entry_.entry_case()) {
            case v1::RecordingEntry::kInput:
                recording_.inputs.push_back(inputIn(entry_.input()));
                return;
            case v1::RecordingEntry::kCheckpoint:
                recording_.checkpoints.push_back(hashIn(entry_.checkpoint()));
                return;
            case v1::RecordingEntry::kEnd:
                recording_.end = hashIn(entry_.end());
                return;
            default:
                fail("has an entry that cannot be there");
        }
    }

    // Time never goes back.
    Tick tickIn(bool has, std::uint64_t tick) {
        if (!has || tick < lastTick_ || tick > kMostTick) fail("has a tick that cannot be");
        lastTick_ = tick;
        return {tick};
    }

    RecordedHash hashIn(const v1::RecordedHash& message) {
        if (!message.has_hash()) fail("has a damaged checkpoint");
        return {tickIn(message.has_tick(), message.tick()), message.hash()};
    }

    // A place or a velocity within bounds.
    glm::vec3 vectorIn(const std::array<float, 3>& numbers) const {
        // A number that is none is not below the bound.
        if (!std::ranges::all_of(numbers, [](float n) { return std::abs(n) <= kMostMetres; }))
            fail("has an input from nowhere");
        return {numbers[0], numbers[1], numbers[2]};
    }

    Steering steeringIn(const std::array<std::int32_t, 5>& axes) const {
        if (!std::ranges::all_of(
                axes, [](std::int32_t a) { return a >= -kFullSteering && a <= kFullSteering; }))
            fail("has a steering beyond full");
        const auto axis = [&](std::size_t i) { return static_cast<std::int8_t>(axes[i]); };
        return {axis(0), axis(1), axis(2), axis(3), axis(4)};
    }

    // A number that is none is within no bounds.
    RecordedClock clockIn(const v1::RecordedClock& clock) const {
        const bool isTime =
            clock.has_time_of_day() && clock.time_of_day() >= 0 && clock.time_of_day() < 1;
        const bool isLength =
            clock.has_length_s() && clock.length_s() >= 0 && clock.length_s() <= kMostDaySeconds;
        if (!isTime || !isLength) fail("has a clock that cannot be");
        return {clock.time_of_day(), clock.length_s()};
    }

    WallHands handsIn(const v1::RecordedHands& recorded) const {
        const auto count = static_cast<std::size_t>(recorded.ids_size());
        if (count > kMostWallHands || recorded.points_size() != 3 * recorded.ids_size())
            fail("has hands that cannot be");
        WallHands hands;
        for (int i = 0; i < recorded.ids_size(); ++i)
            hands.push_back({recorded.ids(i),
                             vectorIn({recorded.points(3 * i),
                                       recorded.points(3 * i + 1),
                                       recorded.points(3 * i + 2)})});
        return hands;
    }

    RecordedDrawing drawingIn(const v1::RecordedDrawing& drawing) const {
        const bool isDrawing = drawing.fish() < fish_ && drawing.number() > 0 &&
                               drawing.picture().size() == sizeof(Digest::bytes) &&
                               drawing.aside() >= -1 && drawing.aside() <= 1;
        if (!isDrawing) fail("has a drawing that cannot be");
        return {drawing.fish(), drawing.number(), digestIn(drawing.picture()), drawing.aside()};
    }

    RecordedDay dayIn(const v1::RecordedDay& day) const {
        const bool isTime =
            !day.has_time_of_day() || (day.time_of_day() >= 0 && day.time_of_day() < 1);
        const bool isGlide =
            day.has_glide_s() && day.glide_s() >= 0 && day.glide_s() <= kMostGlideSeconds;
        if (!isTime || !isGlide) fail("has a time of day that cannot be");
        return {day.has_time_of_day() ? std::optional(day.time_of_day()) : std::nullopt,
                day.glide_s()};
    }

    RecordedRelease releaseIn(const v1::RecordedRelease& release) const {
        if (!release.has_species() || release.species() >= speciesCount_)
            fail("releases a species that it has not");
        return {release.species()};
    }

    RecordedFood foodIn(const v1::RecordedFood& food) const {
        if (food.pellets() > kMostPellets) fail("has an input that cannot be");
        return {vectorIn({food.x(), food.y(), food.z()}), food.pellets()};
    }

    RecordedSubmarine submarineIn(const v1::RecordedSubmarine& moved) const {
        return {vectorIn({moved.x(), moved.y(), moved.z()}),
                vectorIn({moved.velocity_x(), moved.velocity_y(), moved.velocity_z()})};
    }

    RecordedDeparture departureIn(const v1::RecordedDeparture& departure) const {
        if (departure.fish() >= fish_) fail("has a drawing that cannot be");
        return {departure.fish()};
    }

    RecordedInput inputIn(const v1::RecordedInput& message) {
        return {tickIn(message.has_tick(), message.tick()), whatIn(message)};
    }

    decltype(RecordedInput::input) whatIn(const v1::RecordedInput& message) const {
        switch (message.input_case()) {
            case v1::RecordedInput::kFood:
                return foodIn(message.food());
            case v1::RecordedInput::kSubmarine:
                return submarineIn(message.submarine());
            case v1::RecordedInput::kSteering: {
                const v1::RecordedSteering& s = message.steering();
                return steeringIn({s.ahead(), s.aside(), s.up(), s.turn(), s.tilt()});
            }
            case v1::RecordedInput::kClock:
                return clockIn(message.clock());
            case v1::RecordedInput::kHands:
                return handsIn(message.hands());
            case v1::RecordedInput::kDrawing:
                return drawingIn(message.drawing());
            case v1::RecordedInput::kDeparture:
                return departureIn(message.departure());
            case v1::RecordedInput::kDay:
                return dayIn(message.day());
            case v1::RecordedInput::kRelease:
                return releaseIn(message.release());
            default:
                fail("has an input that this program does not know");
        }
    }

    // Names of files and builds are shown in terminals.
    static std::string printed(std::string text) {
        text.resize(std::min(text.size(), kMostNameBytes));
        std::ranges::replace_if(
            text, [](char c) { return c < ' ' || c > '~'; }, '?');
        return text;
    }

    std::span<const std::byte> bytes_;
    std::string source_;
    std::size_t at_ = 0, start_ = 0, entryBytes_ = 0;
    v1::RecordingEntry entry_;
    std::size_t speciesCount_ = 0;
    std::size_t fish_ = 0;
    std::uint64_t lastTick_ = 0;
    Recording recording_;
};

}  // namespace

Tick Recording::lastTick() const {
    if (end) return end->tick;
    Tick last = checkpoints.empty() ? Tick{} : checkpoints.back().tick;
    if (!inputs.empty()) last = std::max(last, inputs.back().tick);
    return last;
}

Packet beginningOf(const AssetBundle& assets) {
    v1::RecordingEntry entry;
    v1::RecordingHeader& header = *entry.mutable_header();
    header.set_magic(std::string(kMagic));
    header.set_version(kRecordingVersion);
    header.set_protocol(kProtocolMajor);
    header.set_build(AQUARAMA_VERSION);
    header.set_seed(assets.seed);
    header.set_scene(assets.scene);
    if (assets.drawingsMayBeEaten) header.set_drawings_may_be_eaten(true);
    header.set_species_count(static_cast<std::uint32_t>(assets.cast.size()));
    Packet bytes = delimited(entry);
    for (const SpeciesAssets& species : assets.cast) {
        write(species, *entry.mutable_species());
        append(bytes, delimited(entry));
    }
    return bytes;
}

Packet entryOf(const RecordedInput& input) {
    v1::RecordingEntry entry;
    entry.mutable_input()->set_tick(input.tick.value);
    std::visit([&](const auto& what) { write(what, *entry.mutable_input()); }, input.input);
    return delimited(entry);
}

Packet entryOf(const RecordedHash& checkpoint) {
    v1::RecordingEntry entry;
    write(checkpoint, *entry.mutable_checkpoint());
    return delimited(entry);
}

Packet endOf(const RecordedHash& end) {
    v1::RecordingEntry entry;
    write(end, *entry.mutable_end());
    return delimited(entry);
}

bool isRecording(std::span<const std::byte> firstBytes) {
    const auto head =
        firstBytes.first(std::min(firstBytes.size(), kMostBytesBeforeMagic + kMagic.size()));
    return std::string_view(reinterpret_cast<const char*>(head.data()), head.size()).find(kMagic) !=
           std::string_view::npos;
}

Recording decodeRecording(std::span<const std::byte> bytes, const std::string& source) {
    return Reader(bytes, source).read();
}

// The size is checked before memory is taken; a file that shrinks meanwhile reads as cut short.
Recording readRecording(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    if (!file || problem) throw Error(path + ": cannot be read; is there such a recording?");
    if (size > kMostRecordingBytes) throw Error(path + ": is too large for a recording");
    Packet bytes(size);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return decodeRecording(bytes, path);
}

std::vector<std::string> doubtsAbout(const Recording& recording) {
    std::vector<std::string> doubts;
    if (recording.build != AQUARAMA_VERSION)
        doubts.push_back("it was written by " + recording.build + " and this is " +
                         AQUARAMA_VERSION + ": fish may decide otherwise");
    if (recording.protocol != kProtocolMajor)
        doubts.push_back("it was written for protocol " + std::to_string(recording.protocol) +
                         " and this is " + std::to_string(kProtocolMajor));
    if (!recording.end)
        doubts.push_back(
            "it was cut short after tick " + std::to_string(recording.lastTick().value) + ", " +
            std::to_string(recording.bytesLeftOver) + " bytes of an unfinished entry are left out");
    return doubts;
}

}  // namespace aquarama::wire
