// SPDX-License-Identifier: Apache-2.0
#include "common/wire/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <istream>
#include <sstream>
#include <string_view>
#include <utility>

#include <zlib.h>

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
constexpr std::size_t kMostEntryBytes = kMostSavedBytes + 4096;
static_assert(kMostRepertoireBytes + kMostSpeciesBytes < kMostSavedBytes);
// The checksum behind an entry: its tag, and four bytes.
constexpr std::byte kChecksumTag{15U << 3U | 5U};
constexpr std::size_t kChecksumBytes = 5;
constexpr std::size_t kMostSmallEntryBytes = 256;             // of inputs and hashes
constexpr std::uint64_t kMostTick = std::uint64_t{1} << 32U;  // two years
constexpr float kMostMetres = 10'000;
constexpr std::uint32_t kMostPellets = 65'535;
constexpr double kMostDaySeconds = 1.0e9;
constexpr double kMostGlideSeconds = 3600;

std::uint32_t checksumOf(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// An entry with its checksum, after its length as a varint, as protobuf's own tools delimit
// messages.
Packet delimited(const v1::RecordingEntry& entry) {
    const std::size_t size = entry.ByteSizeLong();
    Packet bytes;
    for (std::size_t rest = size + kChecksumBytes;; rest >>= 7U) {
        const bool more = rest > 0x7F;
        bytes.push_back(static_cast<std::byte>((rest & 0x7FU) | (more ? 0x80U : 0U)));
        if (!more) break;
    }
    const std::size_t start = bytes.size();
    bytes.resize(start + size);
    entry.SerializeToArray(bytes.data() + start, static_cast<int>(size));
    const std::uint32_t checksum = checksumOf(std::span(bytes).subspan(start));
    bytes.push_back(kChecksumTag);
    for (const unsigned shift : {0U, 8U, 16U, 24U})
        bytes.push_back(static_cast<std::byte>(checksum >> shift & 0xFFU));
    return bytes;
}

void append(Packet& bytes, const Packet& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
}

void write(const SpeciesAssets& species, Repertoires repertoires, v1::RecordedSpecies& message) {
    message.Clear();
    // The folders of one machine mean nothing on another.
    message.set_file(std::filesystem::path(species.file).filename().string());
    message.set_text(species.text);
    if (repertoires == Repertoires::Inside)
        message.set_repertoire(species.repertoire.data(), species.repertoire.size());
    else
        message.set_repertoire_digest(
            bytesOf(species.repertoireDigest.value_or(digestOf(species.repertoire))));
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
    Reader(std::istream& in, std::uint64_t bytes, std::string source)
        : in_(in), size_(bytes), source_(std::move(source)) {}

    AssetBundle readAssets() {
        readHeader();
        while (recording_.assets.cast.size() < speciesCount_) readSpecies();
        return std::move(recording_.assets);
    }

    Recording read() {
        recording_.assets = readAssets();
        while (!recording_.end && nextEntry()) readEvent();
        if (recording_.end && at_ != size_) fail("goes on behind its end");
        recording_.source = source_;
        recording_.wholeBytes = recording_.end ? at_ : start_;
        recording_.bytesLeftOver = size_ - recording_.wholeBytes;
        return std::move(recording_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(source_ + ": byte " + std::to_string(start_) + ": the recording " + what +
                    "; take another copy of it");
    }

    // The length of the next entry; 0 where the file ends before or within it, or is damaged.
    std::size_t nextLength() {
        std::size_t length = 0;
        for (std::size_t i = 0; i < kMostLengthBytes; ++i) {
            const int byte = in_.get();
            if (byte == std::istream::traits_type::eof()) return 0;
            ++at_;
            length |= static_cast<std::size_t>(byte & 0x7F) << (7 * i);
            if (byte <= 0x7F) return length;
        }
        return 0;
    }

    // Whether the bytes that were read end with their checksum.
    [[nodiscard]] bool isWhole() const {
        const std::size_t size = bytes_.size() - kChecksumBytes;
        std::uint32_t kept = 0;
        for (std::size_t i = 0; i < 4; ++i)
            kept |= std::to_integer<std::uint32_t>(bytes_[size + 1 + i]) << (8 * i);
        return bytes_[size] == kChecksumTag && kept == checksumOf(std::span(bytes_).first(size));
    }

    // False: there is no whole entry any more.
    bool nextEntry() {
        start_ = at_;
        const std::size_t length = nextLength();
        const std::size_t least = hasChecksums_ ? kChecksumBytes : 1;
        if (length < least || length > kMostEntryBytes || length > size_ - at_) return false;
        bytes_.resize(length);
        in_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(length));
        if (static_cast<std::size_t>(in_.gcount()) != length) return false;
        if (hasChecksums_ && !isWhole()) return false;
        at_ += length;
        if (!entry_.ParseFromArray(bytes_.data(), static_cast<int>(length))) fail("is damaged");
        return true;
    }

    // The version is checked before anything that may differ between versions: the checksum, too.
    void readVersion() {
        const std::size_t length = nextLength();
        if (length > kMostSceneBytes + 4096 || length > size_ - at_)
            fail("ends within its first entry");
        bytes_.resize(length);
        in_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(length));
        if (!entry_.ParseFromArray(bytes_.data(), static_cast<int>(length)))
            fail("has a damaged header");
        const v1::RecordingHeader& header = entry_.header();
        hasChecksums_ = header.version() == kRecordingVersion;
        if (!hasChecksums_ && header.version() != kFormerRecordingVersion)
            throw Error(source_ + ": is a recording of version " +
                        std::to_string(header.version()) + ", written by " +
                        printed(header.build()) + "; this program reads version " +
                        std::to_string(kRecordingVersion) + ": use the program that wrote it");
        at_ = 0;
        in_.seekg(0);
    }

    void readHeader() {
        std::array<std::byte, kMostBytesBeforeMagic + kMagic.size()> head{};
        in_.read(reinterpret_cast<char*>(head.data()), head.size());
        const bool isOne =
            isRecording(std::span(head).first(static_cast<std::size_t>(in_.gcount())));
        if (!isOne) throw Error(source_ + ": is not a recording of a show");
        in_.clear();
        in_.seekg(0);
        readVersion();
        if (!nextEntry() || !entry_.has_header()) fail("ends within its first entry");
        const v1::RecordingHeader& header = entry_.header();
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
            species.repertoire().size() > kMostRepertoireBytes ||
            (species.has_repertoire_digest() &&
             species.repertoire_digest().size() != sizeof(Digest::bytes)))
            fail("has a damaged species");
        fish_ += species.fish();
        const auto* first = reinterpret_cast<const std::byte*>(species.repertoire().data());
        recording_.assets.cast.push_back({source_ + ": its " + printed(species.file()),
                                          species.text(),
                                          {first, first + species.repertoire().size()},
                                          species.fish(),
                                          species.drawings(),
                                          {}});
        if (species.has_repertoire_digest())
            recording_.assets.cast.back().repertoireDigest = digestIn(species.repertoire_digest());
    }

    // What happened after the species: inputs, hashes, and the end.
    void readEvent() {
        const bool isSave = hasChecksums_ && entry_.has_save();
        if (!isSave && bytes_.size() > kMostSmallEntryBytes) fail("is damaged");
        switch (entry_.entry_case()) {
            case v1::RecordingEntry::kInput:
                recording_.inputs.push_back(inputIn(entry_.input()));
                return;
            case v1::RecordingEntry::kCheckpoint:
                recording_.checkpoints.push_back(hashIn(entry_.checkpoint()));
                return;
            case v1::RecordingEntry::kMoment:
                recording_.moment = momentIn(entry_.moment());
                return;
            case v1::RecordingEntry::kSave:
                recording_.saves.push_back(saveIn(entry_.save()));
                return;
            case v1::RecordingEntry::kEnd:
                recording_.end = hashIn(entry_.end());
                return;
            default:
                fail("has an entry that cannot be there");
        }
    }

    // Time never goes back: neither that of inputs, which are written ahead of it, nor that of the
    // rest.
    Tick tickIn(bool has, std::uint64_t tick, std::uint64_t& last) const {
        if (!has || tick < last || tick > kMostTick) fail("has a tick that cannot be");
        last = tick;
        return {tick};
    }

    RecordedHash hashIn(const v1::RecordedHash& message) {
        if (!message.has_hash()) fail("has a damaged checkpoint");
        return {tickIn(message.has_tick(), message.tick(), lastTick_), message.hash()};
    }

    RecordedMoment momentIn(const v1::RecordedMoment& moment) {
        if (moment.boot().size() > kMostNameBytes) fail("has a moment that cannot be");
        return {tickIn(moment.has_tick(), moment.tick(), lastTick_),
                moment.clock_ns(),
                moment.boot(),
                moment.unix_s(),
                moment.late_inputs()};
    }

    [[nodiscard]] bool nothingHappened() const {
        return recording_.inputs.empty() && recording_.checkpoints.empty() &&
               recording_.saves.empty() && !recording_.moment;
    }

    // The state is the last field before the checksum.
    RecordedSave saveIn(const v1::RecordedSave& save) {
        const std::size_t bytes = save.state().size();
        if (bytes == 0 || bytes > kMostSavedBytes) fail("has a save that cannot be");
        const std::uint64_t at = at_ - kChecksumBytes - bytes;
        const auto* state = reinterpret_cast<const std::byte*>(save.state().data());
        if (!std::equal(state, state + bytes, bytes_.end() - kChecksumBytes - bytes))
            fail("has a save that cannot be");
        recording_.beginsWithSave = recording_.beginsWithSave || nothingHappened();
        return {tickIn(save.has_tick(), save.tick(), lastTick_), at, bytes};
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
        return {tickIn(message.has_tick(), message.tick(), lastInput_), whatIn(message)};
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

    std::istream& in_;
    std::uint64_t size_;
    std::string source_;
    bool hasChecksums_ = true;
    std::uint64_t at_ = 0, start_ = 0;
    Packet bytes_;  // of the entry
    v1::RecordingEntry entry_;
    std::size_t speciesCount_ = 0;
    std::size_t fish_ = 0;
    std::uint64_t lastTick_ = 0, lastInput_ = 0;
    Recording recording_;
};

}  // namespace

Tick Recording::lastTick() const {
    if (end) return end->tick;
    Tick last = checkpoints.empty() ? Tick{} : checkpoints.back().tick;
    if (moment) last = std::max(last, moment->tick);
    if (!inputs.empty()) last = std::max(last, inputs.back().tick);
    return last;
}

Packet beginningOf(const AssetBundle& assets, Repertoires repertoires) {
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
        write(species, repertoires, *entry.mutable_species());
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

// The state comes last, so that a reader finds it by its length.
Packet entryOf(Tick tick, std::span<const std::byte> savedState) {
    v1::RecordingEntry entry;
    entry.mutable_save()->set_tick(tick.value);
    entry.mutable_save()->set_state(savedState.data(), savedState.size());
    return delimited(entry);
}

Packet entryOf(const RecordedMoment& moment) {
    v1::RecordingEntry entry;
    entry.mutable_moment()->set_tick(moment.tick.value);
    entry.mutable_moment()->set_clock_ns(moment.clockNs);
    entry.mutable_moment()->set_boot(moment.boot);
    entry.mutable_moment()->set_unix_s(moment.unixSeconds);
    if (moment.lateInputs > 0) entry.mutable_moment()->set_late_inputs(moment.lateInputs);
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
    std::istringstream in(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    return Reader(in, bytes.size(), source).read();
}

namespace {

// A file that shrinks meanwhile reads as cut short.
template <class Read>
auto readFile(const std::string& path, const Read& read) {
    std::ifstream file(path, std::ios::binary);
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    if (!file || problem) throw Error(path + ": cannot be read; is there such a recording?");
    if (size > kMostRecordingBytes) throw Error(path + ": is too large for a recording");
    return read(Reader(file, size, path));
}

}  // namespace

Recording readRecording(const std::string& path) {
    return readFile(path, [](Reader reader) { return reader.read(); });
}

AssetBundle readRecordedAssets(const std::string& path) {
    return readFile(path, [](Reader reader) { return reader.readAssets(); });
}

std::vector<std::byte> readState(const Recording& recording, const RecordedSave& save) {
    std::ifstream file(recording.source, std::ios::binary);
    std::vector<std::byte> state(save.bytes);
    file.seekg(static_cast<std::streamoff>(save.at));
    file.read(reinterpret_cast<char*>(state.data()), static_cast<std::streamsize>(save.bytes));
    if (!file) throw Error(recording.source + ": has changed while it was read; try again");
    return state;
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
        doubts.push_back("it was cut short after tick " +
                         std::to_string(recording.lastTick().value) + ", " +
                         std::to_string(recording.bytesLeftOver) +
                         " bytes of an unfinished or damaged entry are left out");
    return doubts;
}

}  // namespace aquarama::wire
