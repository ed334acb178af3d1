// SPDX-License-Identifier: Apache-2.0
// `aquarama convert`: converts a wall file of any known format, or a rig's own geometry, to MPCDI.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/commands.h"
#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/config/text_file.h"
#include "common/formats/mpcdi.h"
#include "common/formats/vendors.h"
#include "common/formats/wall_file.h"
#include "common/wall/wall.h"

namespace aquarama {

namespace {

// Options of `convert`. `version` is that of MPCDI.
struct ConvertOptions {
    std::string in, out;
    std::string size;      // "1920x1080"; empty: as the file says
    std::string sampling;  // "nodes" or "centres"; empty: as the format has it
    bool upsideDown = false;
    int version = 2;
};

// Reads "1920x1080". Throws Error where the text is not a valid size of a picture.
glm::ivec2 sizeIn(const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const std::string_view width = std::string_view(text).substr(0, cross);
    const std::string_view height = std::string_view(text).substr(std::min(cross + 1, text.size()));
    const auto size = formats::pictureSize(formats::numberIn(width).value_or(0),
                                           formats::numberIn(height).value_or(0));
    if (!size) {
        const std::string foreign = foreignCharacterIn(text);
        throw Error("--size \"" + text + "\" is no size of a picture; write it as 1920x1080" +
                    (foreign.empty() ? "" : ": " + foreign));
    }
    return *size;
}

// An option that was not given leaves the default of the format.
formats::ReadOptions readOptionsOf(const ConvertOptions& options) {
    formats::ReadOptions reading{.upsideDown = options.upsideDown};
    if (!options.size.empty()) reading.sizePixels = sizeIn(options.size);
    if (options.sampling == "nodes") reading.sampling = formats::Sampling::Nodes;
    if (options.sampling == "centres") reading.sampling = formats::Sampling::Centres;
    return reading;
}

// 16 bits, linear.
formats::Mask maskOf(const wall::WarpMap& map) {
    constexpr float kMost = 65535;
    formats::Mask mask{
        .size = map.sizePixels, .components = 1, .bits = 16, .gamma = 1, .codes = {}};
    for (const glm::vec4& pixel : map.pointAndWeight)
        mask.codes.push_back(static_cast<std::uint16_t>(std::lround(pixel.w * kMost)));
    return mask;
}

// The points of the screen that a rig's projectors or panels light, by its geometry.
formats::WallFile wallFileOf(const config::Rig& rig) {
    const wall::Wall wall(rig);
    formats::WallFile file;
    file.profile = formats::Profile::Screen;
    file.origin = formats::DataOrigin::IdealEyePoint;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        if (rig.channels[i].wallFile)
            throw Error("channel \"" + rig.channels[i].name +
                        "\" has a wall file already: convert that one");
        const wall::WarpMap map = wall.warp(i);
        formats::Warp warp{.size = map.sizePixels, .samples = {}};
        for (const glm::vec4& pixel : map.pointAndWeight)
            warp.samples.push_back(pixel.w > 0
                                       ? glm::vec3(pixel)
                                       : glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        formats::FileChannel& channel = file.channels.emplace_back();
        channel.name = rig.channels[i].name;
        channel.sizePixels = map.sizePixels;
        channel.warp = std::move(warp);
        channel.blend = maskOf(map);
    }
    return file;
}

// Whether the file is one of our text files; then it is a rig, since scenes and species have no
// geometry.
bool isRig(const std::string& path) {
    return path.ends_with(".txtpb");
}

// Throws Error where the format is unknown or the rig's geometry is wrong.
formats::WallFile readAny(const ConvertOptions& options) {
    if (!isRig(options.in)) return formats::readWallFile(options.in, readOptionsOf(options));
    const config::Rig rig = config::readRig(options.in);
    wall::checkGeometry(rig, options.in);
    return wallFileOf(rig);
}

// Throws Error where the size is missing or larger than a display.
void requireSize(const formats::FileChannel& channel, const std::string& source) {
    const glm::ivec2 size = channel.sizePixels;
    if (size.x < 1 || size.y < 1)
        throw Error(source + ": does not say how many pixels \"" + channel.name +
                    "\" has; give them by --size");
    if (!formats::pictureSize(size.x, size.y))
        throw Error(fmt::format("{}: \"{}\" has {} x {} pixels, more than a display; correct it",
                                source,
                                channel.name,
                                size.x,
                                size.y));
}

// Whether the channel has no warp, or one with a sample at the centre of each pixel.
bool isPlain(const formats::FileChannel& channel) {
    return !channel.warp || (channel.warp->sampling == formats::Sampling::Centres &&
                             channel.warp->size == channel.sizePixels);
}

// Other tools expect the samples of a warp at the centres of pixels.
void resample(formats::WallFile& file, const std::string& source) {
    for (formats::FileChannel& channel : file.channels) {
        requireSize(channel, source);
        if (!isPlain(channel)) channel.warp = formats::resampled(*channel.warp, channel.sizePixels);
    }
}

// A summary of the channel for the terminal.
std::string lineOf(const formats::FileChannel& channel) {
    return fmt::format("{}: {} x {} pixels, {}{}{}{}",
                       channel.name,
                       channel.sizePixels.x,
                       channel.sizePixels.y,
                       channel.warp ? "warp" : "no warp",
                       channel.blend ? ", blend" : "",
                       channel.black ? ", black level" : "",
                       channel.colour ? ", colour" : "");
}

// Throws Error where OUT is not named .mpcdi, before anything is read.
void convert(const ConvertOptions& options) {
    if (!options.out.ends_with(".mpcdi"))
        throw Error(options.out + ": only MPCDI is written; name it NAME.mpcdi");
    formats::WallFile file = readAny(options);
    formats::sayRemarks(file.remarks);
    resample(file, options.in);
    formats::writeMpcdi(options.out, file, options.version);
    for (const formats::FileChannel& channel : file.channels) std::cout << lineOf(channel) << '\n';
    std::cout << options.out << ": written, profile "
              << formats::kProfileNames.at(static_cast<std::size_t>(file.profile)) << '\n';
}

}  // namespace

void addConvert(CommandLine& line) {
    const auto [command, options] = line.add<ConvertOptions>(
        "convert", "a warp file of another tool, or a rig's geometry, as MPCDI", convert);
    command
        .add_option("IN",
                    options.in,
                    "MPCDI, VIOSO, SCISS, Scalable, domeprojection, SimCAD, Paul Bourke, PFM, OBJ; "
                    "or a rig (.txtpb)")
        ->required();
    command.add_option("OUT", options.out, "NAME.mpcdi")->required();
    command.add_option(
        "--size", options.size, "WIDTHxHEIGHT of the projector's picture, where IN lacks it");
    command
        .add_option("--sampling",
                    options.sampling,
                    "position of the samples of a coarse grid, if IN does not tell")
        ->check(CLI::IsMember({"centres", "nodes"}));
    command.add_flag(
        "--upside-down", options.upsideDown, "IN's rows are in the opposite order to its format");
    command.add_option("--mpcdi", options.version, "version to write")
        ->check(CLI::IsMember({1, 2}))
        ->capture_default_str();
}

}  // namespace aquarama
