// SPDX-License-Identifier: Apache-2.0
#include "common/osc/osc.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <lo/lo_lowlevel.h>

namespace aquarama::osc {

namespace {

// All that is aligned is aligned to this.
constexpr std::size_t kWord = 4;
// How a bundle begins, with the zero that ends the text.
constexpr std::string_view kBundle{"#bundle\0", 8};
constexpr std::size_t kBundleHeadBytes = 16;  // with its time

// Bytes that are not read yet.
using Rest = std::span<const std::byte>;
// lo_message is a pointer, to void until liblo 0.31 and to a struct since.
using Message = std::unique_ptr<std::remove_pointer_t<lo_message>, decltype(&lo_message_free)>;

std::string_view textOf(Rest bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The next text, which zeros end and fill up to whole words. Nothing where there is none.
std::optional<std::string_view> takeText(Rest& rest) {
    const std::string_view all = textOf(rest);
    const std::size_t size = all.find('\0');
    if (size == std::string_view::npos) return std::nullopt;
    const std::size_t padded = (size / kWord + 1) * kWord;
    if (padded > all.size()) return std::nullopt;
    if (all.substr(size, padded - size).find_first_not_of('\0') != std::string_view::npos)
        return std::nullopt;
    rest = rest.subspan(padded);
    return all.substr(0, size);
}

// False where so many bytes are not there.
bool skip(Rest& rest, std::size_t bytes) {
    if (rest.size() < bytes) return false;
    rest = rest.subspan(bytes);
    return true;
}

// Goes over the argument of a type tag. False where it is not whole, or the tag is not known.
bool skipArgument(char tag, Rest& rest) {
    switch (tag) {
        case 'i':
        case 'f':
            return skip(rest, 4);
        case 'h':
        case 'd':
        case 't':
            return skip(rest, 8);
        case 'T':
        case 'F':
            return true;
        case 's':
        case 'S':
            return takeText(rest).has_value();
        default:
            return false;
    }
}

// Why the bytes are no message that we read; empty where they are one.
std::string objectionTo(Rest rest) {
    const auto isPrintable = [](char c) { return c > ' ' && c <= '~'; };
    const auto address = takeText(rest);
    if (!address || !address->starts_with('/') || !std::ranges::all_of(*address, isPrintable))
        return "it begins with no address, as /aquarama/black";
    const auto tags = takeText(rest);
    if (!tags || !tags->starts_with(',')) return std::string(*address) + " has no type tags";
    if (tags->size() > kMostArguments + 1)
        return std::string(*address) + " has more than " + std::to_string(kMostArguments) +
               " arguments";
    for (const char tag : tags->substr(1))
        if (!skipArgument(tag, rest))
            return std::string(*address) +
                   " has an argument that is cut off, or no i, h, f, d, s, "
                   "S, t, T or F";
    return rest.empty() ? "" : std::string(*address) + " has more bytes than its type tags say";
}

// A value of liblo's, in this machine's byte order but not aligned.
template <class Value>
Value valueAt(const lo_arg* place) {
    Value value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

OscArgument argumentOf(char tag, const lo_arg* place) {
    constexpr unsigned kHalf = 32;
    switch (tag) {
        case 'i':
            return std::int64_t{valueAt<std::int32_t>(place)};
        case 'h':
            return valueAt<std::int64_t>(place);
        case 't': {
            const auto time = valueAt<lo_timetag>(place);
            return static_cast<std::int64_t>(std::uint64_t{time.sec} << kHalf | time.frac);
        }
        case 'f':
            return double{valueAt<float>(place)};
        case 'd':
            return valueAt<double>(place);
        case 'T':
        case 'F':
            return std::int64_t{tag == 'T'};
        default:
            return std::string(reinterpret_cast<const char*>(place));
    }
}

// By liblo, of bytes without objection; nothing where it has one of its own.
std::optional<OscMessage> messageOf(Rest bytes) {
    std::vector<std::byte> copy(bytes.begin(), bytes.end());  // it takes what may be written
    const Message read(lo_message_deserialise(copy.data(), copy.size(), nullptr), lo_message_free);
    if (!read) return std::nullopt;
    OscMessage message{std::string(*takeText(bytes)), {}};
    const std::string_view tags = lo_message_get_types(read.get());
    lo_arg** const values = lo_message_get_argv(read.get());
    for (std::size_t i = 0; i < tags.size(); ++i)
        message.arguments.push_back(argumentOf(tags[i], values[i]));
    return message;
}

// Adds the messages of a packet, or of a part of a bundle. Returns why it is refused.
std::string read(Rest bytes, int depth, OscPacket& packet);

// The parts of a bundle, each behind its size.
std::string readBundle(Rest rest, int depth, OscPacket& packet) {
    if (depth == kMostDepth) return "its bundles lie too deep in one another";
    if (!skip(rest, kBundleHeadBytes)) return "a bundle is cut off";
    while (!rest.empty()) {
        const Rest head = rest;
        if (!skip(rest, kWord)) return "a bundle is cut off";
        std::size_t size = 0;
        for (std::size_t i = 0; i < kWord; ++i)
            size = size << 8U | std::to_integer<unsigned>(head[i]);
        const Rest part = rest;
        if (size == 0 || !skip(rest, size)) return "a bundle is cut off";
        if (std::string why = read(part.first(size), depth + 1, packet); !why.empty()) return why;
    }
    return {};
}

std::string read(Rest bytes, int depth, OscPacket& packet) {
    if (textOf(bytes).starts_with(kBundle)) return readBundle(bytes, depth, packet);
    if (packet.messages.size() == kMostMessages)
        return "it has more than " + std::to_string(kMostMessages) + " messages";
    if (std::string why = objectionTo(bytes); !why.empty()) return why;
    auto message = messageOf(bytes);
    if (!message) return "it is no message of OSC";
    packet.messages.push_back(*std::move(message));
    return {};
}

void add(lo_message message, const OscArgument& argument) {
    using Small = std::numeric_limits<std::int32_t>;
    if (const auto* text = std::get_if<std::string>(&argument)) {
        lo_message_add_string(message, text->c_str());
    } else if (const auto* number = std::get_if<double>(&argument)) {
        lo_message_add_float(message, static_cast<float>(*number));
    } else {
        const std::int64_t whole = std::get<std::int64_t>(argument);
        if (whole >= Small::min() && whole <= Small::max())
            lo_message_add_int32(message, static_cast<std::int32_t>(whole));
        else
            lo_message_add_int64(message, whole);
    }
}

}  // namespace

OscPacket decode(std::span<const std::byte> bytes) {
    OscPacket packet;
    if (bytes.size() > kMostPacketBytes)
        return {{}, "it is larger than " + std::to_string(kMostPacketBytes) + " bytes"};
    packet.problem = read(bytes, 0, packet);
    if (!packet.problem.empty()) packet.messages.clear();
    return packet;
}

std::vector<std::byte> encode(const OscMessage& message) {
    const Message written(lo_message_new(), lo_message_free);
    for (const OscArgument& argument : message.arguments) add(written.get(), argument);
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> bytes(
        lo_message_serialise(written.get(), message.address.c_str(), nullptr, &size), std::free);
    const auto* const begin = static_cast<const std::byte*>(bytes.get());
    return {begin, begin + size};
}

}  // namespace aquarama::osc
