// SPDX-License-Identifier: Apache-2.0
// `aquarama adjust`: edits the file of manual adjustments on top of projectors and wall files. A
// running master notices the change.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/characters.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/adjustments.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama {

namespace {

// Options of all subcommands; each uses some of them. Lengths are pixels.
struct AdjustOptions {
    std::string rig, channel, with;
    glm::dvec2 place{}, by{};
    double radius = 0, soft = 0, width = 0;  // 0: what the file's schema says
    std::vector<std::string> corners;
    bool isOfPicture = false;
    std::size_t number = 0;
};

// One entry of the file as a text for a person.
struct AdjustmentLine {
    config::SourcePlace place;
    std::string text;
};

// The file on the disk, and its rig.
class AdjustedRig {
  public:
    explicit AdjustedRig(const std::string& path)
        : path_{path}, rig_{config::parseRig(config::readTextFile(path), path)} {
        if (rig_.adjustments.empty())
            throw Error(path +
                        ": names no adjustments; add the line adjustments: \"by_hand.txtpb\" and "
                        "start the show again");
        const std::string file = config::besideFile(path, rig_.adjustments);
        if (!std::filesystem::exists(file)) writeWhole(file, {});
        config::readRigFiles(rig_, path);
        text_ = config::readTextFile(file);
    }

    [[nodiscard]] const std::string& text() const { return text_; }

    // In the order of the file.
    [[nodiscard]] std::vector<AdjustmentLine> lines() const {
        const config::Adjustments all = config::adjustmentsOf(rig_);
        std::vector<AdjustmentLine> lines;
        for (const auto& point : all.points) lines.push_back({point.source, textOf(point)});
        for (const auto& mask : all.masks) lines.push_back({mask.source, textOf(mask)});
        for (const auto& limit : all.blends) lines.push_back({limit.source, textOf(limit)});
        std::ranges::sort(lines, {}, [](const AdjustmentLine& line) {
            return std::pair{line.place.line, line.place.column};
        });
        return lines;
    }

    // Checks the new text with the whole rig, then replaces the file.
    void write(const std::string& text) {
        const auto bytes = std::as_bytes(std::span(text));
        rig_.files[rig_.adjustments] =
            std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
        wall::checkGeometry(rig_, path_);
        writeWhole(config::besideFile(path_, rig_.adjustments), bytes);
        text_ = text;
        print();
    }

    // Numbers begin at 1, as `remove` takes them.
    void print() const {
        int number = 0;
        for (const AdjustmentLine& line : lines())
            std::cout << fmt::format("{:3}  {}\n", ++number, line.text);
        std::cout << config::besideFile(path_, rig_.adjustments) << ": " << number
                  << " adjustments\n";
    }

  private:
    [[nodiscard]] const std::string& nameOf(std::size_t channel) const {
        return rig_.channels[channel].name;
    }
    static const char* textOf(config::PixelsOf picture) {
        return picture == config::PixelsOf::Picture ? "of its picture" : "of the panorama";
    }
    [[nodiscard]] std::string textOf(const config::ControlPoint& point) const {
        return fmt::format("move {} at {:g} {:g} {} by {:g} {:g}, radius {:g}",
                           nameOf(point.channel),
                           point.place.x,
                           point.place.y,
                           textOf(point.pixelsOf),
                           point.byPixels.x,
                           point.byPixels.y,
                           point.radiusPixels);
    }
    [[nodiscard]] std::string textOf(const config::MaskedArea& mask) const {
        return fmt::format("mask {}, {} corners {}, {:g} soft",
                           mask.channel ? nameOf(*mask.channel) : "all channels",
                           mask.corners.size(),
                           textOf(mask.pixelsOf),
                           mask.softPixels);
    }
    [[nodiscard]] std::string textOf(const config::BlendLimit& limit) const {
        return fmt::format("blend {} with {} over at most {:g}",
                           nameOf(limit.channel),
                           limit.with ? nameOf(*limit.with) : "its neighbours",
                           limit.widthPixels);
    }

    std::string path_;
    config::Rig rig_;
    std::string text_;
};

// Throws Error where the rig is wrong with the new entry; the file is then unchanged.
void append(const AdjustOptions& options, const std::string& entry) {
    AdjustedRig rig(options.rig);
    std::string text = rig.text();
    if (!text.empty() && !text.ends_with('\n')) text += '\n';
    rig.write(text + entry + "\n");
}

// A place in the text format of protobuf.
std::string placeText(const AdjustOptions& options, glm::dvec2 place) {
    return fmt::format("{} {{ x_px: {} y_px: {} }}",
                       options.isOfPicture ? "picture" : "panorama",
                       place.x,
                       place.y);
}

// A radius of 0 is left out: the default of the schema holds.
void movePoint(const AdjustOptions& options) {
    append(options,
           fmt::format("points {{ channel: \"{}\" {} right_px: {} down_px: {}{} }}",
                       options.channel,
                       placeText(options, options.place),
                       options.by.x,
                       options.by.y,
                       options.radius > 0 ? fmt::format(" radius_px: {}", options.radius) : ""));
}

// Reads the number at a place and moves the place past it; empty where there is none.
std::optional<double> takeNumber(const char*& at, const char* end) {
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    at = read.ptr;
    return read.ec == std::errc{} && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

[[noreturn]] void refuseCorner(const std::string& text) {
    const std::string foreign = foreignCharacterIn(text);
    throw Error("CORNERS \"" + text +
                "\" is no corner: write X,Y as in 10,20.5, with a point before decimals" +
                (foreign.empty() ? "" : "; " + foreign));
}

// Reads "X,Y". Throws Error for any other text.
glm::dvec2 cornerIn(const std::string& text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto x = takeNumber(at, end);
    const bool hasComma = x && at != end && *at++ == ',';
    const auto y = hasComma ? takeNumber(at, end) : std::nullopt;
    if (y && at == end) return {*x, *y};
    refuseCorner(text);
}

// A mask without a channel holds for all of them.
void mask(const AdjustOptions& options) {
    std::string entry = "masks {";
    if (!options.channel.empty()) entry += fmt::format(" channel: \"{}\"", options.channel);
    for (const std::string& corner : options.corners)
        entry += " " + placeText(options, cornerIn(corner));
    if (options.soft > 0) entry += fmt::format(" soft_px: {}", options.soft);
    append(options, entry + " }");
}

// A limit without `with` holds for all neighbours of the channel.
void limitBlend(const AdjustOptions& options) {
    append(options,
           fmt::format("blends {{ channel: \"{}\"{} width_px: {} }}",
                       options.channel,
                       options.with.empty() ? "" : fmt::format(" with: \"{}\"", options.with),
                       options.width));
}

// Also creates the file where the rig names one that does not exist yet.
void list(const AdjustOptions& options) {
    AdjustedRig(options.rig).print();
}

// Throws Error where the list has no such number.
void removeOne(const AdjustOptions& options) {
    AdjustedRig rig(options.rig);
    const std::vector<AdjustmentLine> lines = rig.lines();
    if (options.number < 1 || options.number > lines.size())
        throw Error(
            fmt::format("there are {} adjustments, and no number {}; see aquarama adjust list",
                        lines.size(),
                        options.number));
    rig.write(config::withoutEntry(rig.text(), lines[options.number - 1].place));
}

// A subcommand with the argument RIG, which all of them take.
template <class Run>
AddedCommand<AdjustOptions> addOne(CommandLine& line,
                                   CLI::App& parent,
                                   const std::string& name,
                                   const std::string& what,
                                   Run run) {
    const auto added = line.addTo<AdjustOptions>(parent, name, what, run);
    added.app.add_option("RIG", added.options.rig, "the rig, which names its adjustments")
        ->required();
    return added;
}

void describePicture(const AddedCommand<AdjustOptions>& to) {
    to.app.add_flag("--picture",
                    to.options.isOfPicture,
                    "places are pixels of the channel's picture, not of the panorama");
}

void addMove(CommandLine& line, CLI::App& parent) {
    const auto move = addOne(
        line, parent, "move", "move what a channel shows at a place, and around it", movePoint);
    move.app.add_option("CHANNEL", move.options.channel)->required();
    const CLI::Validator ofPlace = cli::number(-65536, 65536), ofMove = cli::number(-2000, 2000);
    const auto addPixels =
        [&](const char* name, double& value, const char* what, const CLI::Validator& range) {
            move.app.add_option(name, value, what)->required()->check(range);
        };
    addPixels("X", move.options.place.x, "pixels from the left", ofPlace);
    addPixels("Y", move.options.place.y, "pixels from the top", ofPlace);
    addPixels("RIGHT", move.options.by.x, "pixels of the panorama", ofMove);
    addPixels("DOWN", move.options.by.y, "pixels of the panorama", ofMove);
    move.app.add_option("--radius", move.options.radius, "nothing beyond it moves")
        ->check(cli::number(2, 32768));
    describePicture(move);
}

void addMask(CommandLine& line, CLI::App& parent) {
    const auto masked = addOne(line, parent, "mask", "a polygon without light", mask);
    masked.app.add_option("CORNERS", masked.options.corners, "X,Y X,Y X,Y ...")->required();
    masked.app.add_option("--channel", masked.options.channel, "all when left out");
    masked.app.add_option("--soft", masked.options.soft, "width of its edge, pixels")
        ->check(cli::number(0, 4096));
    describePicture(masked);
}

}  // namespace

// `aquarama adjust` alone is an error that names the subcommands.
void addAdjust(CommandLine& line) {
    struct Nothing {};
    const auto adjust = line.add<Nothing>(
        "adjust", "edit control points, masks and limits of blends by hand", [](const Nothing&) {
            throw CLI::RequiredError("adjust: move, mask, blend, list or remove");
        });
    addMove(line, adjust.app);
    addMask(line, adjust.app);
    const auto blend = addOne(line, adjust.app, "blend", "how wide channels blend", limitBlend);
    blend.app.add_option("CHANNEL", blend.options.channel)->required();
    blend.app.add_option("WIDTH", blend.options.width, "at most; pixels of the panorama")
        ->required()
        ->check(cli::number(1, 16384));
    blend.app.add_option("--with", blend.options.with, "all its neighbours when left out");
    addOne(line, adjust.app, "list", "all of them, with their numbers", list);
    const auto removed = addOne(line, adjust.app, "remove", "one of them", removeOne);
    removed.app.add_option("NUMBER", removed.options.number, "of the list")
        ->required()
        ->check(cli::wholeNumber(0, 1'000'000));
    adjust.app.footer("The file keeps its comments; a running wall shows the change in a second.");
}

}  // namespace aquarama
