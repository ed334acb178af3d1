// SPDX-License-Identifier: Apache-2.0
#include "common/motion/repertoire.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string_view>

#include "common/base/byte_stream.h"
#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor_tables.h"

namespace aquarama::motion {
namespace {

// The head of the file, and the bounds of its numbers.
constexpr std::string_view kMagic = "AQREP";
constexpr std::uint16_t kVersion = 6;
constexpr std::size_t kLongestSpecies = 64;
constexpr std::size_t kHeadBytes = 11;  // name, version, length of the whole file
constexpr std::size_t kDigestBytes = 32;
constexpr float kLongestFishMetres = 60.0F;
constexpr float kShortestPeriodSeconds = 0.02F;  // a beat of 50 Hz; no fish is near it
constexpr float kLongestPeriodSeconds = 60.0F;
constexpr float kLongestStepBodyLengths = 1.0F;  // in 1/64 of a cycle; a burst is near 0.02
constexpr float kMostDrag = 1000.0F;  // 1 / body length, or 1 / s: stops within a thousandth of one
// How many numbers a SpeedResponse has.
constexpr std::size_t kResponses = kForwardGaits + 3;

template <class Pose>
void writePose(ByteWriter& out, const Pose& pose) {
    for (const auto& point : pose) {
        for (const std::int16_t component : point) out.int16(component);
    }
}

template <class Pose>
void readPose(ByteReader& in, Pose& pose) {
    for (auto& point : pose) {
        for (std::int16_t& component : point) component = in.int16();
    }
}

void writeIncrements(ByteWriter& out, const FrameIncrements& increments) {
    for (const FrameIncrement& step : increments) {
        const auto& [rotation, translation] = step;
        for (const float number : {rotation.w,
                                   rotation.x,
                                   rotation.y,
                                   rotation.z,
                                   translation.x,
                                   translation.y,
                                   translation.z}) {
            out.float32(number);
        }
    }
}

// The numbers of a TurnPath before its increments.
std::array<float*, 8> headOf(TurnPath& path) {
    auto& [before, speedBefore, after, speedAfter, increments] = path;
    return {
        &before.x, &before.y, &before.z, &speedBefore, &after.x, &after.y, &after.z, &speedAfter};
}

void writeSegment(ByteWriter& out, const ActionSegment& segment) {
    out.float32(segment.periodSeconds);
    out.unsignedNumber<std::uint8_t>(segment.playsToEnd ? 1 : 0);
    writeIncrements(out, segment.increments);
    for (TurnPath path : segment.entered) {
        for (const float* number : headOf(path)) out.float32(*number);
        writeIncrements(out, path.increments);
    }
    for (const NodalPose& pose : segment.nodes) writePose(out, pose);
    for (const FinAnglePair& fins : segment.fins) writePose(out, fins);
    for (const ControlPointPose& pose : segment.controlPoints) writePose(out, pose);
}

FrameIncrement readIncrement(ByteReader& in) {
    FrameIncrement step;
    for (float* number : {&step.rotation.w,
                          &step.rotation.x,
                          &step.rotation.y,
                          &step.rotation.z,
                          &step.translation.x,
                          &step.translation.y,
                          &step.translation.z}) {
        *number = in.float32();
    }
    return step;
}

// The sizes of a segment and of the paths by entry of a turn in the file.
constexpr std::size_t kIncrementsBytes = kPhases * 7 * sizeof(float);
constexpr std::size_t kEntryBytes = 8 * sizeof(float) + kIncrementsBytes;
constexpr std::size_t bytesOfSegment(bool withControlPoints) {
    // And of both fins.
    const std::size_t points =
        body::kNodalPoints + 2 + (withControlPoints ? body::kControlPoints : 0);
    return sizeof(float) + 1 + kIncrementsBytes + kPhases * points * 3 * sizeof(std::int16_t);
}

std::size_t entryCount(Action action) {
    return static_cast<std::size_t>(entriesOf(action));
}

// Written so that a NaN is not in bounds.
bool inBounds(const FrameIncrement& step) {
    const auto& q = step.rotation;
    const float squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    const auto near = [](float t) { return std::abs(t) <= kLongestStepBodyLengths; };
    return std::abs(squared - 1.0F) <= 1e-3F && near(step.translation.x) &&
           near(step.translation.y) && near(step.translation.z);
}

bool isDirection(const glm::vec3& v) {
    return std::abs(v.x * v.x + v.y * v.y + v.z * v.z - 1.0F) <= 1e-3F;
}

bool hasItsCourses(const TurnPath& path) {
    constexpr float kFastestBodyLengths =
        static_cast<float>(kFastestUnits) / kSpeedUnitsPerBodyLength;
    const auto isSpeed = [](float v) { return std::abs(v) <= kFastestBodyLengths; };
    return isDirection(path.courseBefore) && isDirection(path.courseAfter) &&
           isSpeed(path.speedBefore) && isSpeed(path.speedAfter);
}

// The numbers of a response in the order of the file.
std::array<float*, kResponses> numbersOf(SpeedResponse& response) {
    auto& [slow, medium, fast] = response.swimDrag;
    return {&slow, &medium, &fast, &response.retreatDrag, &response.glideDrag, &response.brakeRate};
}

// The fault of the segment of an action; empty where there is none.
std::optional<std::string> faultOf(const ActionSegment& segment, Action action) {
    if (!(segment.periodSeconds >= kShortestPeriodSeconds &&
          segment.periodSeconds <= kLongestPeriodSeconds)) {
        return "has a period outside 0.02 to 60 s";
    }
    if (!segment.controlPoints.empty() && segment.controlPoints.size() != kPhases) {
        return "has control points for some phases only";
    }
    if (!segment.entered.empty() && segment.entered.size() != entryCount(action)) {
        return "has paths for some of its entries only";
    }
    if (!std::ranges::all_of(segment.entered, hasItsCourses)) {
        return "has a course that is no direction, or a speed beyond 16 body lengths a second";
    }
    const auto moves = [](const FrameIncrements& steps) {
        return std::ranges::all_of(steps, inBounds);
    };
    if (!moves(segment.increments) ||
        !std::ranges::all_of(segment.entered, moves, &TurnPath::increments)) {
        return "moves the body frame by more than a body length, or by no rotation, in 1/64 cycle";
    }
    return std::nullopt;
}

// The fault of a repertoire, which names the segment; empty where there is none.
std::optional<std::string> faultOf(const Repertoire& repertoire) {
    const auto printable = [](char c) { return c > ' ' && c <= '~'; };
    if (repertoire.species.empty() || repertoire.species.size() > kLongestSpecies ||
        !std::ranges::all_of(repertoire.species, printable)) {
        return "has a species name that is not 1 to 64 printable characters";
    }
    if (!(repertoire.recordedLengthMetres > 0 &&
          repertoire.recordedLengthMetres <= kLongestFishMetres)) {
        return "has a recorded length outside 0 to 60 m";
    }
    SpeedResponse response = repertoire.response;
    const auto isDrag = [](const float* drag) { return *drag >= 0 && *drag <= kMostDrag; };
    if (!std::ranges::all_of(numbersOf(response), isDrag))
        return "has a drag outside 0 to 1000 per body length or second";
    for (int action = 0; action < kCapturedActions; ++action) {
        const auto named = static_cast<Action>(action);
        if (const auto fault = faultOf(repertoire.segments[indexOf(named)], named))
            return std::string("segment ") + nameOf(named) + " " + *fault;
    }
    return std::nullopt;
}

// source: the file, or the species that is to be written.
[[noreturn]] void refuse(const std::string& source, const std::string& fault) {
    throw Error(source + ": repertoire " + fault + "; capture the species again");
}

// The parts of a segment in a file, beside its poses of nodes: one byte for each action.
struct Parts {
    static constexpr std::uint8_t kControlPoints = 1, kEntries = 2;
    std::uint8_t bits = 0;

    [[nodiscard]] bool hasControlPoints() const { return (bits & kControlPoints) != 0; }
    [[nodiscard]] bool hasEntries() const { return (bits & kEntries) != 0; }
};
using Contents = std::array<Parts, kCapturedActions>;

Contents contentsOf(const Repertoire& repertoire) {
    Contents contents;
    for (std::size_t action = 0; action < contents.size(); ++action) {
        const ActionSegment& segment = repertoire.segments[action];
        const bool hasPoints = !segment.controlPoints.empty();
        const bool hasEntries = !segment.entered.empty();
        contents[action].bits = static_cast<std::uint8_t>((hasPoints ? Parts::kControlPoints : 0) |
                                                          (hasEntries ? Parts::kEntries : 0));
    }
    return contents;
}

// Whether each action has parts that it can have.
bool arePossible(const Contents& contents) {
    for (std::size_t action = 0; action < contents.size(); ++action) {
        const bool mayHaveEntries = entryCount(static_cast<Action>(action)) > 0;
        const int most = Parts::kControlPoints | (mayHaveEntries ? Parts::kEntries : 0);
        if ((contents[action].bits & ~most) != 0) return false;
    }
    return true;
}

// Memory of all segments.
std::size_t bytesOf(const Contents& contents) {
    std::size_t bytes = 0;
    for (std::size_t action = 0; action < contents.size(); ++action) {
        const std::size_t entries =
            contents[action].hasEntries() ? entryCount(static_cast<Action>(action)) : 0;
        bytes += bytesOfSegment(contents[action].hasControlPoints()) + entries * kEntryBytes;
    }
    return bytes;
}

void readIncrements(ByteReader& in, FrameIncrements& increments) {
    for (FrameIncrement& step : increments) step = readIncrement(in);
}

// Reads the content between length and digest, whose digest matches: a fault now was made when the
// file was written.
Repertoire readContent(ByteReader& in, const std::string& source) {
    Repertoire repertoire;
    repertoire.species = in.characters(in.unsignedNumber<std::uint8_t>());
    repertoire.recordedLengthMetres = in.float32();
    for (float* number : numbersOf(repertoire.response)) *number = in.float32();
    Contents contents;
    for (Parts& parts : contents) parts.bits = in.unsignedNumber<std::uint8_t>();
    if (!in.ok() || !arePossible(contents) || in.remaining() != bytesOf(contents)) {
        refuse(source, "is not as long as its head says");
    }
    for (std::size_t action = 0; action < contents.size(); ++action) {
        ActionSegment& segment = repertoire.segments[action];
        segment.periodSeconds = in.float32();
        const auto playsToEnd = in.unsignedNumber<std::uint8_t>();
        if (playsToEnd > 1) refuse(source, "has a mark that is neither 0 nor 1");
        segment.playsToEnd = playsToEnd == 1;
        readIncrements(in, segment.increments);
        segment.entered.resize(
            contents[action].hasEntries() ? entryCount(static_cast<Action>(action)) : 0);
        for (TurnPath& path : segment.entered) {
            for (float* number : headOf(path)) *number = in.float32();
            readIncrements(in, path.increments);
        }
        for (NodalPose& pose : segment.nodes) readPose(in, pose);
        for (FinAnglePair& fins : segment.fins) readPose(in, fins);
        segment.controlPoints.resize(contents[action].hasControlPoints() ? kPhases : 0);
        for (ControlPointPose& pose : segment.controlPoints) readPose(in, pose);
    }
    return repertoire;
}

// The mean of two poses, point by point.
template <class Pose>
Pose meanOf(const Pose& a, const Pose& b) {
    Pose mean{};
    for (std::size_t i = 0; i < mean.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            mean[i][axis] = static_cast<std::int16_t>(roundToEven((a[i][axis] + b[i][axis]) / 2.0));
    return mean;
}

}  // namespace

const char* nameOf(Action action) {
    constexpr std::array<const char*, kActions> kNames{"forward_slow",
                                                       "forward_medium",
                                                       "forward_fast",
                                                       "curve_left_wide_slow",
                                                       "curve_left_wide_medium",
                                                       "curve_left_wide_fast",
                                                       "curve_left_tight_slow",
                                                       "curve_left_tight_medium",
                                                       "curve_left_tight_fast",
                                                       "curve_right_wide_slow",
                                                       "curve_right_wide_medium",
                                                       "curve_right_wide_fast",
                                                       "curve_right_tight_slow",
                                                       "curve_right_tight_medium",
                                                       "curve_right_tight_fast",
                                                       "climb_slow",
                                                       "climb_medium",
                                                       "climb_fast",
                                                       "dive_slow",
                                                       "dive_medium",
                                                       "dive_fast",
                                                       "retreat",
                                                       "hover",
                                                       "pivot_left",
                                                       "pivot_right",
                                                       "pitch_up",
                                                       "pitch_down",
                                                       "turn_left_gradual",
                                                       "turn_left_sharp",
                                                       "turn_right_gradual",
                                                       "turn_right_sharp",
                                                       "start_left_small",
                                                       "start_left_middle",
                                                       "start_left_large",
                                                       "start_right_small",
                                                       "start_right_middle",
                                                       "start_right_large",
                                                       "glide"};
    return kNames.at(static_cast<std::size_t>(action));
}

std::vector<std::byte> encodeRepertoire(const Repertoire& repertoire) {
    if (const auto fault = faultOf(repertoire)) refuse(repertoire.species, *fault);
    const Contents contents = contentsOf(repertoire);
    ByteWriter out;
    out.characters(kMagic);
    out.unsignedNumber(kVersion);
    out.unsignedNumber(static_cast<std::uint32_t>(
        kHeadBytes + 1 + repertoire.species.size() + (1 + kResponses) * sizeof(float) +
        contents.size() + bytesOf(contents) + kDigestBytes));
    out.unsignedNumber(static_cast<std::uint8_t>(repertoire.species.size()));
    out.characters(repertoire.species);
    out.float32(repertoire.recordedLengthMetres);
    SpeedResponse response = repertoire.response;
    for (const float* number : numbersOf(response)) out.float32(*number);
    for (const Parts parts : contents) out.unsignedNumber(parts.bits);
    for (std::size_t action = 0; action < kCapturedActions; ++action)
        writeSegment(out, repertoire.segments[action]);
    out.characters(digestOf(out.written()).bytes);
    return std::move(out).take();
}

Repertoire decodeRepertoire(std::span<const std::byte> bytes, const std::string& source) {
    ByteReader head(bytes);
    if (head.characters(kMagic.size()) != kMagic) refuse(source, "does not begin with AQREP");
    const auto version = head.unsignedNumber<std::uint16_t>();
    const auto length = head.unsignedNumber<std::uint32_t>();
    if (head.ok() && version > kVersion) {
        throw Error(source + ": repertoire is of version " + std::to_string(version) +
                    ", written by a newer Aquarama; update this one, which reads version " +
                    std::to_string(kVersion));
    }
    if (head.ok() && version < kVersion) {
        refuse(source,
               "is of version " + std::to_string(version) + ", this program reads version " +
                   std::to_string(kVersion));
    }
    if (length != bytes.size() || head.remaining() < kDigestBytes) {
        refuse(source, "is truncated or has bytes after its end");
    }
    const auto content = bytes.first(bytes.size() - kDigestBytes);
    const Digest digest = digestOf(content);
    if (!std::ranges::equal(std::as_bytes(std::span(digest.bytes)), bytes.last(kDigestBytes))) {
        refuse(source, "is altered: its SHA-256 does not match");
    }
    ByteReader in(content.subspan(kHeadBytes));
    Repertoire repertoire = readContent(in, source);
    if (const auto fault = faultOf(repertoire)) refuse(source, *fault);
    addGlide(repertoire);
    return repertoire;
}

void addGlide(Repertoire& repertoire) {
    const ActionSegment& medium =
        repertoire.segments[static_cast<std::size_t>(Action::ForwardMedium)];
    ActionSegment& glide = repertoire.segments[static_cast<std::size_t>(Action::Glide)];
    glide = {};
    glide.periodSeconds = medium.periodSeconds;

    assert(medium.periodSeconds > 0);
    const GaitPath path = pathOf(medium);
    double forward = 0;
    for (std::size_t k = 0; k < kPhases; ++k) forward += path.mean[k].forward;
    glide.increments.fill({{1, 0, 0, 0}, {static_cast<float>(forward / kPhases), 0, 0}});

    // A turn ends almost straight, with all muscles at rest; the turn to the other side ends bent
    // the other way by as little, so the mean of both is straight. The mean of a beat would be
    // straight too, but too short: half of the muscles pull all the time.
    const ActionSegment& left =
        repertoire.segments[static_cast<std::size_t>(Action::TurnLeftGradual)];
    const ActionSegment& right =
        repertoire.segments[static_cast<std::size_t>(Action::TurnRightGradual)];
    glide.nodes.fill(meanOf(left.nodes.back(), right.nodes.back()));
    glide.fins.fill(meanOf(left.fins.back(), right.fins.back()));
    if (medium.controlPoints.empty()) return;
    glide.controlPoints.assign(kPhases,
                               meanOf(left.controlPoints.back(), right.controlPoints.back()));
}

}  // namespace aquarama::motion
