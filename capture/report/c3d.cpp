// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <string>

#include "capture/report/take.h"
#include "common/base/byte_stream.h"
#include "common/base/units.h"

namespace aquarama::report {

namespace {

// Names of markers.

constexpr std::size_t kDorsalTip = 21;  // after the nose and five rings of four

// A corner of a ring, in the order of the nodal points.
struct Corner {
    const char* label;
    const char* description;
};
constexpr std::array kCorners{Corner{"DL", "dorsal left"},
                              Corner{"DR", "dorsal right"},
                              Corner{"VR", "ventral right"},
                              Corner{"VL", "ventral left"}};

// The number of a node's ring, 1 to 5. Not for nose and tail.
std::string ringOf(std::size_t node) {
    return std::to_string(1 + (node - 1) / kCorners.size());
}

// The corner of a node of a ring.
const Corner& cornerOf(std::size_t node) {
    return kCorners.at((node - 1) % kCorners.size());
}

}  // namespace

std::string markerLabel(std::size_t node) {
    assert(node < body::kNodalPoints);
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

// CSV.

// std::to_chars does not depend on the locale. 32 characters hold any float.
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

// C3D. The file has three sections, each of whole blocks: the header (one block), the parameters,
// and the data. Numbers are little-endian.

constexpr std::size_t kBlockBytes = 512;
constexpr std::uint8_t kParameterBlock = 2;  // blocks count from 1; the header is block 1
constexpr std::uint8_t kSignature = 0x50;    // in the second byte of header and parameters
constexpr std::uint8_t kIntel = 84;          // little-endian, IEEE floats
// POINT:SCALE. Negative: the coordinates are floats in the file's unit and need no factor.
constexpr float kScale = -1.0F;

// Appends zeros up to a size.
void pad(ByteWriter& out, std::size_t bytes) {
    while (out.written().size() < bytes) out.unsignedNumber(std::uint8_t{0});
}

// The number of blocks that hold so many bytes.
std::size_t blocksFor(std::size_t bytes) {
    return (bytes + kBlockBytes - 1) / kBlockBytes;
}

// A record of the parameter section: a group of parameters, or one parameter with its data.
struct Record {
    std::string name;
    int group = 0;                // number of the group; negative: this record is the group itself
    std::vector<std::byte> data;  // empty for a group
    std::string description;
};

Record group(int number, const std::string& name, const std::string& description) {
    return {.name = name, .group = -number, .data = {}, .description = description};
}

// Types of elements: the number of bytes, but -1 for characters.
constexpr int kCharacter = -1;
constexpr int kInteger = 2;
constexpr int kReal = 4;

// The head of a parameter's data: the type of the elements, the number of dimensions and each of
// them, in a byte each. No dimensions mean a scalar. The elements follow.
ByteWriter dataOf(int type, const std::vector<std::size_t>& dimensions) {
    ByteWriter data;
    data.unsignedNumber(static_cast<std::uint8_t>(type));
    data.unsignedNumber(static_cast<std::uint8_t>(dimensions.size()));
    for (const std::size_t size : dimensions) {
        assert(size <= 255);
        data.unsignedNumber(static_cast<std::uint8_t>(size));
    }
    return data;
}

// An unsigned 16-bit parameter.
Record integer(int groupNumber, const std::string& name, std::size_t value) {
    ByteWriter data = dataOf(kInteger, {});
    data.unsignedNumber(static_cast<std::uint16_t>(value));
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

Record real(int groupNumber, const std::string& name, float value) {
    ByteWriter data = dataOf(kReal, {});
    data.float32(value);
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

Record text(int groupNumber, const std::string& name, const std::string& value) {
    ByteWriter data = dataOf(kCharacter, {value.size()});
    data.characters(value);
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

// An array of strings, each padded with blanks to the length of the longest, as the format demands.
Record texts(int groupNumber, const std::string& name, std::vector<std::string> values) {
    std::size_t length = 0;
    for (const std::string& value : values) length = std::max(length, value.size());
    ByteWriter data = dataOf(kCharacter, {length, values.size()});
    for (std::string& value : values) {
        value.resize(length, ' ');
        data.characters(value);
    }
    return {.name = name, .group = groupNumber, .data = std::move(data).take(), .description = ""};
}

// All groups and parameters; `dataBlock` is the number of the first block of the data section.
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

// Length of the name, number of the group, name, offset of the next record, data, description.
void write(ByteWriter& out, const Record& record, bool isLast) {
    assert(record.name.size() <= 127);
    out.unsignedNumber(static_cast<std::uint8_t>(record.name.size()));
    out.unsignedNumber(static_cast<std::uint8_t>(record.group));
    out.characters(record.name);
    // The offset counts from its own first byte; 0 marks the last record.
    const std::size_t next = 2 + record.data.size() + 1 + record.description.size();
    out.unsignedNumber(static_cast<std::uint16_t>(isLast ? 0 : next));
    for (const std::byte byte : record.data)
        out.unsignedNumber(std::to_integer<std::uint8_t>(byte));
    out.unsignedNumber(static_cast<std::uint8_t>(record.description.size()));
    out.characters(record.description);
}

// Padded to `blocks` blocks. With 0 blocks it is not padded: so c3dOf() finds its size.
std::vector<std::byte> parameterSection(const Take& take, std::size_t blocks) {
    assert(blocks <= 255);
    ByteWriter out;
    out.unsignedNumber(std::uint8_t{1});  // reserved; 1 by convention
    out.unsignedNumber(kSignature);
    out.unsignedNumber(static_cast<std::uint8_t>(blocks));
    out.unsignedNumber(kIntel);
    const std::vector<Record> records = recordsOf(take, kParameterBlock + blocks);
    for (const Record& record : records) write(out, record, &record == &records.back());
    pad(out, blocks * kBlockBytes);
    return std::move(out).take();
}

void writeHeader(ByteWriter& out, const Take& take, std::size_t dataBlock) {
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

// Four floats for each marker: x, y, z and a word about how it was measured.
void writeFrame(ByteWriter& out, const TakeFrame& frame) {
    // The fourth word holds the cameras that saw the point and its residual: here none.
    constexpr float kSeenByNoCamera = 0.0F;
    for (const glm::dvec3& node : frame.nodes) {
        for (const double metres : {node.x, node.y, node.z})
            out.float32(static_cast<float>(metres));
        out.float32(kSeenByNoCamera);
    }
}

}  // namespace

std::vector<std::byte> c3dOf(const Take& take) {
    assert(take.frames.size() <= kMostFrames);
    // The size of the parameter section does not depend on the numbers in it, which say where the
    // data section begins: so it is built once to measure it and once to write it.
    const std::size_t blocks = blocksFor(parameterSection(take, 0).size());
    const std::size_t dataBlock = kParameterBlock + blocks;
    ByteWriter out;
    writeHeader(out, take, dataBlock);
    for (const std::byte byte : parameterSection(take, blocks))
        out.unsignedNumber(std::to_integer<std::uint8_t>(byte));
    for (const TakeFrame& frame : take.frames) writeFrame(out, frame);
    pad(out, blocksFor(out.written().size()) * kBlockBytes);
    return std::move(out).take();
}

}  // namespace aquarama::report
