// SPDX-License-Identifier: Apache-2.0
#include "common/parts/part_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

#include "common/base/byte_stream.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::parts {

namespace {

constexpr std::string_view kMagic = "aquarama part";
constexpr std::uint16_t kFormat = 1;
constexpr std::size_t kDigestBytes = sizeof(Digest::bytes);
constexpr std::size_t kMostBuild = 1000;  // characters of its name

constexpr std::array<const char*, kWorkKinds> kKinds{"capture", "study", "search", "clip"};

[[noreturn]] void refuseDamaged(const std::string& path) {
    throw Error(path + ": is damaged or cut off; make this part again");
}

// The fields between the format's number and the content. Throws Error where one is wrong.
FinishedPart readFields(ByteReader& reader, const std::string& path) {
    FinishedPart part;
    part.path = path;
    const auto kind = reader.unsignedNumber<std::uint8_t>();
    part.number = reader.unsignedNumber<std::uint32_t>();
    part.work.of = reader.unsignedNumber<std::uint32_t>();
    part.work.arithmetic = reader.unsignedNumber<std::uint64_t>();
    reader.numbers(std::span<std::uint8_t>(part.work.inputs.bytes));
    part.work.build = reader.characters(reader.unsignedNumber<std::uint16_t>());
    if (!reader.ok() || kind >= kWorkKinds || part.number < 1 || part.number > part.work.of ||
        part.work.of > kMostParts)
        refuseDamaged(path);
    part.work.kind = static_cast<WorkKind>(kind);
    return part;
}

std::string described(const FinishedPart& part) {
    return "part " + std::to_string(part.number) + " of " + std::to_string(part.work.of) +
           " of a " + nameOf(part.work.kind);
}

// Throws Error where `other` is not of the work of `first`.
void requireSameWork(const FinishedPart& first, const FinishedPart& other) {
    if (first.work.kind != other.work.kind || first.work.of != other.work.of)
        throw Error(other.path + ": is " + described(other) + ", and " + first.path + " is " +
                    described(first) + "; merge the parts of one work");
    if (first.work.inputs != other.work.inputs)
        throw Error(other.path + ": was made of other inputs or options than " + first.path +
                    "; make one of both again");
    if (first.work.arithmetic != other.work.arithmetic)
        throw Error(other.path +
                    ": was computed by a machine with another C library or processor than " +
                    first.path + ", which differ in last bits; use machines of one kind");
}

void requireBuild(const FinishedPart& part, const std::string& build) {
    if (part.work.build == build) return;
    throw Error(part.path + ": was made by " + part.work.build + ", and this is " + build +
                "; merge with the program that made it, or make it again");
}

// Throws Error where parts, in order, are not each number once.
void requireAll(const std::vector<FinishedPart>& parts) {
    const std::uint32_t of = parts.front().work.of;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i)
        if (parts[i].number == parts[i + 1].number)
            throw Error(parts[i + 1].path + ": is the same part as " + parts[i].path +
                        "; name each part once");
    for (std::uint32_t number = 1; number <= of; ++number)
        if (number > parts.size() || parts[number - 1].number != number)
            throw Error("part " + std::to_string(number) + " of " + std::to_string(of) +
                        " is missing; make it, or name its file as well");
}

}  // namespace

const char* nameOf(WorkKind kind) {
    return kKinds.at(static_cast<std::size_t>(kind));
}

std::uint64_t arithmeticOfThisMachine() {
    constexpr int kSamples = 4096;
    std::uint64_t hash = 0;
    for (int i = 1; i <= kSamples; ++i) {
        const double x = 0.0071 * i;
        for (const double value : {std::sin(x),
                                   std::cos(x),
                                   std::atan2(x, 3.0),
                                   std::exp(-x),
                                   std::log(x),
                                   std::pow(x, 0.3),
                                   std::tanh(x),
                                   static_cast<double>(std::sin(static_cast<float>(x)))})
            hash = foldedOne(hash, value);
    }
    return hash;
}

std::vector<std::byte> encodePart(const FinishedPart& part) {
    assert(part.work.build.size() <= kMostBuild);
    ByteWriter writer;
    writer.characters(kMagic);
    writer.unsignedNumber(kFormat);
    writer.unsignedNumber(static_cast<std::uint8_t>(part.work.kind));
    writer.unsignedNumber(part.number);
    writer.unsignedNumber(part.work.of);
    writer.unsignedNumber(part.work.arithmetic);
    writer.numbers(std::span<const std::uint8_t>(part.work.inputs.bytes));
    writer.unsignedNumber(static_cast<std::uint16_t>(part.work.build.size()));
    writer.characters(part.work.build);
    writer.numbers(std::span<const std::byte>(part.content));
    writer.numbers(std::span<const std::uint8_t>(digestOf(writer.written()).bytes));
    return std::move(writer).take();
}

// The format is judged before the digest: a later one may end differently.
FinishedPart decodePart(std::span<const std::byte> bytes, const std::string& path) {
    ByteReader reader(bytes);
    if (reader.characters(kMagic.size()) != kMagic)
        throw Error(path + ": is no part of a work; name the files that --part wrote (.aqpart)");
    const auto format = reader.unsignedNumber<std::uint16_t>();
    if (reader.ok() && format != kFormat)
        throw Error(path + ": has version " + std::to_string(format) +
                    " of the format, and this "
                    "program reads " +
                    std::to_string(kFormat) + "; use the program that made it");
    if (reader.remaining() < kDigestBytes) refuseDamaged(path);
    Digest written;
    ByteReader(bytes.last(kDigestBytes)).numbers(std::span<std::uint8_t>(written.bytes));
    if (digestOf(bytes.first(bytes.size() - kDigestBytes)) != written) refuseDamaged(path);
    FinishedPart part = readFields(reader, path);
    if (reader.remaining() < kDigestBytes) refuseDamaged(path);
    part.content.resize(reader.remaining() - kDigestBytes);
    reader.numbers(std::span(part.content));
    return part;
}

std::vector<FinishedPart> readWork(const std::vector<std::string>& paths,
                                   const std::string& build) {
    assert(!paths.empty());
    std::vector<FinishedPart> parts;
    for (const std::string& path : paths) {
        parts.push_back(decodePart(readWhole(path, kMostPartBytes), path));
        requireSameWork(parts.front(), parts.back());
        requireBuild(parts.back(), build);
    }
    std::ranges::stable_sort(parts, {}, &FinishedPart::number);
    requireAll(parts);
    return parts;
}

Digest digestOfFile(const std::string& path) {
    constexpr std::size_t kPiece = std::size_t{16} << 20U;
    std::ifstream file(path, std::ios::binary);
    std::vector<char> piece(kPiece);
    ByteWriter digests;
    while (file) {
        file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        const auto content = std::span(piece).first(static_cast<std::size_t>(file.gcount()));
        digests.numbers(std::span<const std::uint8_t>(digestOf(std::as_bytes(content)).bytes));
    }
    if (!file.eof() || file.bad()) throw Error(path + ": cannot be read; see that it is there");
    return digestOf(digests.written());
}

}  // namespace aquarama::parts
