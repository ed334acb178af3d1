// SPDX-License-Identifier: Apache-2.0

#include "master/capture/report/c3d.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <string>

#include "common/motion/repertoire.h"
#include "common/units/units.h"

namespace aquarama::report {

namespace {

constexpr std::size_t kDorsalTip = 21;  // behind the nose and five rings of four

struct Corner {
    const char* label;
    const char* description;
};
constexpr std::array kCorners{Corner{"DL", "dorsal left"},
                              Corner{"DR", "dorsal right"},
                              Corner{"VR", "ventral right"},
                              Corner{"VL", "ventral left"}};

std::string ringOf(std::size_t node) {
    return std::to_string(1 + (node - 1) / kCorners.size());
}

const Corner& cornerOf(std::size_t node) {
    return kCorners.at((node - 1) % kCorners.size());
}

}  // namespace

std::string markerLabel(std::size_t node) {
    if (node == 0) return "NOSE";
    if (node >= kDorsalTip) return node == kDorsalTip ? "TAIL_D" : "TAIL_V";
    return "R" + ringOf(node) + "_" + cornerOf(node).label;
}

std::string markerDescription(std::size_t node) {
    const std::string number = "nodal point " + std::to_string(node) + ", ";
    if (node == 0) return number + "nose";
    if (node >= kDorsalTip)
        return number + (node == kDorsalTip ? "dorsal" : "ventral") + " tip of the tail";
    return number + "ring " + ringOf(node) + " of 5, " + cornerOf(node).description;
}

namespace {

void append(std::string& text, double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), static_cast<float>(value)).ptr;
    text.append(digits.begin(), end);
}

}  // namespace

std::string csvOf(const Take& take) {
    std::string text = "time_s";
    for (std::size_t node = 0; node < body::kNodalPoints; ++node)
        for (const char* axis : {"_x_m", "_y_m", "_z_m"})
            text += ",n" + std::to_string(node) + axis;
    text += '\n';
    for (const TakeFrame& frame : take.frames) {
        append(text, frame.seconds);
        for (const glm::dvec3& node : frame.nodes)
            for (const double metres : {node.x, node.y, node.z}) append(text += ',', metres);
        text += '\n';
    }
    return text;
}

namespace {

constexpr std::size_t kBlockBytes = 512;
constexpr std::uint8_t kParameterBlock = 2;  // blocks count from 1; the header is the first
constexpr std::uint8_t kSignature = 0x50;
constexpr std::uint8_t kIntel = 84;
// Negative: coordinates are floats and need no factor.
constexpr float kScale = -1.0F;

void pad(motion::ByteWriter& out, std::size_t bytes) {
    while (out.written().size() < bytes) out.unsignedNumber(std::uint8_t{0});
}

std::size_t blocksFor(std::size_t bytes) {
    return (bytes + kBlockBytes - 1) / kBlockBytes;
}

// A group of parameters, or one of them with its data: name and number, how far on the next
// begins, what it is.
struct Record {
    std::string name;
    int group = 0;  // negative: this is the group itself
    std::vector<std::byte> data;
    std::string description;
};

Record group(int number, const std::string& name, const std::string& description) {
    return {.name = name, .group = -number, .data = {}, .description = description};
}

constexpr int kCharacter = -1;
constexpr int kInteger = 2;
constexpr int kReal = 4;

// The type of the elements and the array's dimensions, before the elements.
motion::ByteWriter dataOf(int type, const std::vector<std::size_t>& dimensions) {
    motion::ByteWriter data;
    data.unsignedNumber(static_cast<std::uint8_t>(type));
    data.unsignedNumber(static_cast<std::uint8_t>(dimensions.size()));
    for (const std::size_t size : dimensions) data.unsignedNumber(static_cast<std::uint8_t>(size));
    return data;
}

Record integer(int groupNumber, const std::string& name, std::size_t value) {
    motion::ByteWriter data = dataOf(kInteger, {});
    data.unsignedNumber(static_cast<std::uint16_t>(value));
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

Record real(int groupNumber, const std::string& name, float value) {
    motion::ByteWriter data = dataOf(kReal, {});
    data.float32(value);
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

Record text(int groupNumber, const std::string& name, const std::string& value) {
    motion::ByteWriter data = dataOf(kCharacter, {value.size()});
    data.characters(value);
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

// Filled up with blanks to one length.
Record texts(int groupNumber, const std::string& name, std::vector<std::string> values) {
    std::size_t length = 0;
    for (const std::string& value : values) length = std::max(length, value.size());
    motion::ByteWriter data = dataOf(kCharacter, {length, values.size()});
    for (std::string& value : values) {
        value.resize(length, ' ');
        data.characters(value);
    }
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

std::vector<Record> recordsOf(const Take& take, std::size_t dataBlock) {
    std::vector<std::string> labels;
    std::vector<std::string> descriptions;
    for (std::size_t node = 0; node < body::kNodalPoints; ++node) {
        labels.push_back(markerLabel(node));
        descriptions.push_back(markerDescription(node));
    }
    constexpr int kPoint = 1;
    constexpr int kAnalog = 2;
    constexpr int kOwn = 3;
    return {group(kPoint, "POINT", "nodal points"),
            integer(kPoint, "USED", body::kNodalPoints),
            integer(kPoint, "FRAMES", take.frames.size()),
            integer(kPoint, "DATA_START", dataBlock),
            real(kPoint, "SCALE", kScale),
            real(kPoint, "RATE", static_cast<float>(kTicksPerSecond)),
            texts(kPoint, "UNITS", {"m"}),
            texts(kPoint, "LABELS", labels),
            texts(kPoint, "DESCRIPTIONS", descriptions),
            text(kPoint, "X_SCREEN", "+X"),
            text(kPoint, "Y_SCREEN", "+Y"),
            group(kAnalog, "ANALOG", "none"),
            integer(kAnalog, "USED", 0),
            group(kOwn, "AQUARAMA", "who swims, and what"),
            text(kOwn, "SPECIES", take.species),
            text(kOwn, "SEGMENT", take.segment),
            real(kOwn, "BODY_LENGTH", static_cast<float>(take.lengthMetres))};
}

void write(motion::ByteWriter& out, const Record& record, bool isLast) {
    out.unsignedNumber(static_cast<std::uint8_t>(record.name.size()));
    out.unsignedNumber(static_cast<std::uint8_t>(record.group));
    out.characters(record.name);
    // From here to the next record; 0 ends the section.
    const std::size_t next = 2 + record.data.size() + 1 + record.description.size();
    out.unsignedNumber(static_cast<std::uint16_t>(isLast ? 0 : next));
    for (const std::byte byte : record.data)
        out.unsignedNumber(std::to_integer<std::uint8_t>(byte));
    out.unsignedNumber(static_cast<std::uint8_t>(record.description.size()));
    out.characters(record.description);
}

// Filled up to whole blocks.
std::vector<std::byte> parameterSection(const Take& take, std::size_t blocks) {
    motion::ByteWriter out;
    out.unsignedNumber(std::uint8_t{1});  // where the first record is, by custom
    out.unsignedNumber(kSignature);
    out.unsignedNumber(static_cast<std::uint8_t>(blocks));
    out.unsignedNumber(kIntel);
    const std::vector<Record> records = recordsOf(take, kParameterBlock + blocks);
    for (const Record& record : records) write(out, record, &record == &records.back());
    pad(out, blocks * kBlockBytes);
    return std::move(out).take();
}

void writeHeader(motion::ByteWriter& out, const Take& take, std::size_t dataBlock) {
    out.unsignedNumber(kParameterBlock);
    out.unsignedNumber(kSignature);
    out.unsignedNumber(static_cast<std::uint16_t>(body::kNodalPoints));
    out.unsignedNumber(std::uint16_t{0});  // analogue values a frame
    out.unsignedNumber(std::uint16_t{1});  // the first frame
    out.unsignedNumber(static_cast<std::uint16_t>(take.frames.size()));
    out.unsignedNumber(std::uint16_t{0});  // frames that were interpolated over a gap
    out.float32(kScale);
    out.unsignedNumber(static_cast<std::uint16_t>(dataBlock));
    out.unsignedNumber(std::uint16_t{0});  // analogue samples a frame
    out.float32(static_cast<float>(kTicksPerSecond));
    pad(out, kBlockBytes);
}

void writeFrame(motion::ByteWriter& out, const TakeFrame& frame) {
    constexpr float kSeenByNoCamera = 0.0F;  // and no residual: a modelled point
    for (const glm::dvec3& node : frame.nodes) {
        for (const double metres : {node.x, node.y, node.z})
            out.float32(static_cast<float>(metres));
        out.float32(kSeenByNoCamera);
    }
}

}  // namespace

std::vector<std::byte> c3dOf(const Take& take) {
    assert(take.frames.size() <= kMostFrames);
    const std::size_t blocks = blocksFor(parameterSection(take, 0).size());
    const std::size_t dataBlock = kParameterBlock + blocks;
    motion::ByteWriter out;
    writeHeader(out, take, dataBlock);
    for (const std::byte byte : parameterSection(take, blocks))
        out.unsignedNumber(std::to_integer<std::uint8_t>(byte));
    for (const TakeFrame& frame : take.frames) writeFrame(out, frame);
    pad(out, blocksFor(out.written().size()) * kBlockBytes);
    return std::move(out).take();
}

}  // namespace aquarama::report
