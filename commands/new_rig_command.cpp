// SPDX-License-Identifier: Apache-2.0
// `aquarama new-rig`: asks for the wall's measures, or reads options, and writes a rig.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "commands/commands.h"
#include "commands/new_rig.h"
#include "common/base/characters.h"
#include "common/base/counted.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/rig.h"
#include "common/machine/connectors.h"
#include "common/wall/wall.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kKinds{"televisions", "cylinder", "flat"};

struct NewRigOptions {
    std::string file, kind, size, monitors;
    NewRigWishes wishes;
};

// The range of a number in an option or an answer.
struct Range {
    double least, most;
};
constexpr Range kCount{1, kMostNewChannels}, kMetres{0.1, 100}, kInches{5, 300}, kTurn{0, 90},
    kArc{5, 300}, kThrow{0.2, 20}, kMount{-20, 20}, kFrame{0, 0.5};

std::vector<std::string> wordsIn(const std::string& text) {
    std::string spaced = text;
    std::ranges::replace(spaced, ',', ' ');
    std::istringstream stream(spaced);
    return {std::istream_iterator<std::string>(stream), {}};
}

// Parses "1920x1080"; empty for any other text.
std::optional<glm::ivec2> sizeIfAny(const std::string& text) {
    glm::ivec2 size{};
    int end = 0;
    const bool isSize = std::sscanf(text.c_str(), "%5dx%5d%n", &size.x, &size.y, &end) ==
                            2 &&  // NOLINT(cert-err34-c)
                        end == static_cast<int>(text.size());
    const bool isInBounds = std::min(size.x, size.y) >= 64 && std::max(size.x, size.y) <= 16384;
    return isSize && isInBounds ? std::optional(size) : std::nullopt;
}

// A dialogue on the terminal. An empty answer selects the default in brackets. A wrong one gets one
// line, and the question is repeated.
class Dialogue {
  public:
    // Repeats the question until `take` accepts the answer.
    void ask(const std::string& question,
             const std::string& usual,
             const std::function<std::string(const std::string&)>& take) {
        for (;;) {
            std::cout << question << " [" << usual << "]: " << std::flush;
            std::string answer;
            if (!std::getline(std::cin, answer))
                throw Error("the answers ended; nothing is written");
            const std::string fault = take(answer.empty() ? usual : answer);
            if (fault.empty()) return;
            std::cout << "  " << fault << '\n';
        }
    }
    // Asks for a number, unless an option has given it.
    void number(const std::string& question,
                std::optional<double>& wish,
                double usual,
                Range range) {
        if (wish) return;
        ask(question, fmt::format("{:g}", usual), [&](const std::string& answer) -> std::string {
            std::string said = answer;
            const std::string plain = plainNumber(answer);
            if (!cli::number(range.least, range.most)(said).empty())
                return fmt::format("a number from {:g} to {:g}, please{}",
                                   range.least,
                                   range.most,
                                   plain.empty() ? "" : ": type " + plain);
            std::from_chars(answer.data(), answer.data() + answer.size(), wish.emplace());
            return {};
        });
    }
};

std::string listed(const std::vector<machine::Connector>& monitors) {
    std::string text;
    for (const machine::Connector& one : monitors)
        text += fmt::format("  {}  {} x {}  {}\n",
                            one.name,
                            one.monitor.sizePixels.x,
                            one.monitor.sizePixels.y,
                            one.monitor.product);
    return text.empty() ? "  none\n" : text;
}

void askKind(Dialogue& dialogue, NewRigWishes& wishes) {
    dialogue.ask(
        "What the world appears on: televisions, cylinder (a curved screen with "
        "projectors) or flat (a wall with projectors)",
        "televisions",
        [&](const std::string& answer) -> std::string {
            const auto found = std::ranges::find(kKinds, answer);
            if (found == kKinds.end()) return "one of televisions, cylinder, flat, please";
            wishes.kind = static_cast<WallKind>(found - kKinds.begin());
            return {};
        });
}

void askConnectors(Dialogue& dialogue,
                   NewRigWishes& wishes,
                   const std::vector<machine::Connector>& monitors) {
    if (!wishes.connectors.empty() || wishes.windows) return;
    std::string usual;
    for (const machine::Connector& one : monitors) usual += (usual.empty() ? "" : " ") + one.name;
    std::cout << "Monitors of this machine:\n" << listed(monitors);
    dialogue.ask("Their connectors from left to right, or windows for windows on this desktop",
                 usual.empty() ? "windows" : usual,
                 [&](const std::string& answer) -> std::string {
                     wishes.windows = answer == "windows";
                     wishes.connectors =
                         wishes.windows ? std::vector<std::string>{} : wordsIn(answer);
                     if (wishes.connectors.size() > kMostNewChannels) return "16 at most, please";
                     return {};
                 });
}

void askCount(Dialogue& dialogue, NewRigWishes& wishes) {
    if (wishes.count) return;
    std::optional<double> count;
    if (wishes.windows)
        dialogue.number("How many", count, 3, kCount);
    else
        count = static_cast<double>(wishes.connectors.size());
    wishes.count = static_cast<int>(*count);
}

void askMeasures(Dialogue& dialogue,
                 NewRigWishes& wishes,
                 const std::vector<machine::Connector>& monitors) {
    if (wishes.kind == WallKind::Televisions) {
        dialogue.number("Diagonal of each picture, inches",
                        wishes.diagonalInches,
                        usualDiagonal(monitors),
                        kInches);
        dialogue.number("Width of the frame round it, metres", wishes.bezel, 0.01, kFrame);
        if (*wishes.count > 1)
            dialogue.number(
                "Angle between neighbours, degrees (0: a straight row)", wishes.angle, 40, kTurn);
        return dialogue.number(
            "From the eye to the middle of the wall, metres", wishes.distance, 1.5, kMetres);
    }
    if (wishes.kind == WallKind::Cylinder) {
        dialogue.number(
            "Radius of the curve, metres (the eye is in its middle)", wishes.radius, 3, kMetres);
        dialogue.number("How far it reaches round, degrees", wishes.arc, 120, kArc);
    } else {
        dialogue.number("Width of the wall, metres", wishes.width, 6, kMetres);
        dialogue.number("From the eye to the wall, metres", wishes.distance, 3, kMetres);
    }
    dialogue.number("Height of the screen, metres", wishes.height, 2.4, kMetres);
    dialogue.number("Throw ratio of the projectors (distance by width of the picture)",
                    wishes.throwRatio,
                    1.5,
                    kThrow);
    dialogue.number(
        "How high they hang above the eye, metres", wishes.mount, *wishes.height / 2 + 0.3, kMount);
}

// Asks for everything that the options have not given.
void askAll(NewRigWishes& wishes, const std::vector<machine::Connector>& connected) {
    Dialogue dialogue;
    const std::vector<machine::Connector> monitors = wallMonitors(connected);
    askKind(dialogue, wishes);
    askConnectors(dialogue, wishes, monitors);
    askCount(dialogue, wishes);
    askMeasures(dialogue, wishes, monitors);
}

// Path of the reef's scene: beside the rig where it exists, else that of the installation.
std::string sceneFor(const std::string& rigFile) {
    const std::string beside = "scenes/reef.txtpb";
    if (fs::exists(fs::path(rigFile).parent_path() / beside)) return beside;
    return cli::findData("config/" + beside);
}

NewRigWishes wishesIn(const NewRigOptions& options) {
    NewRigWishes wishes = options.wishes;
    const auto kind = std::ranges::find(kKinds, options.kind);
    if (kind != kKinds.end()) wishes.kind = static_cast<WallKind>(kind - kKinds.begin());
    for (const std::string& word : wordsIn(options.monitors))
        wishes.connectors.push_back(machine::connectorName(word));
    if (!options.size.empty()) wishes.sizePixels = sizeIfAny(options.size);
    if (wishes.scene.empty()) wishes.scene = sceneFor(options.file);
    return wishes;
}

void requireNew(const std::string& file) {
    std::error_code none;
    if (fs::is_regular_file(file, none))
        throw Error(file + " is there already; choose another name, or remove it first");
}

void newRig(const NewRigOptions& options) {
    requireNew(options.file);
    cli::requireFile("FILE", options.file);
    NewRigWishes wishes = wishesIn(options);
    const std::vector<machine::Connector> connected = machine::connectedMonitors();
    if (!wishes.kind) {
        if (isatty(STDIN_FILENO) == 0)
            throw Error(
                "choose the kind of display (--screen televisions, cylinder or flat), or "
                "start it on a terminal to be asked");
        askAll(wishes, connected);
    }
    const RigPlan plan =
        planOf(std::move(wishes), connected, fs::path(options.file).stem().string());
    const std::string text = textOf(plan);
    try {
        const config::Rig rig = config::parseRig(text, options.file);
        static_cast<void>(config::scenePathOf(rig, options.file));
        wall::checkGeometry(rig, options.file);
    } catch (const Error& problem) {
        throw Error(std::string("these measures make no wall, and nothing is written: ") +
                    problem.what());
    }
    writeWhole(options.file, std::as_bytes(std::span(text)));
    std::cout << fmt::format(
        "wrote {}: {}\n", options.file, counted(plan.channels.size(), "channel"));
    for (const PlannedChannel& channel : plan.channels)
        std::cout << fmt::format("  {:<12} {:<8} {} x {}\n",
                                 channel.name,
                                 channel.connector.empty() ? "window" : channel.connector,
                                 channel.sizePixels.x,
                                 channel.sizePixels.y);
    std::cout << fmt::format("next: aquarama run {} --pattern grid, then without the pattern\n",
                             options.file);
}

// Adds an option with a number.
void addNumber(CLI::App& command,
               const std::string& name,
               std::optional<double>& wish,
               const std::string& what,
               Range range) {
    command.add_option(name, wish, what)->check(cli::number(range.least, range.most));
}

void describeMeasures(CLI::App& command, NewRigWishes& wishes) {
    addNumber(
        command, "--diagonal", wishes.diagonalInches, "of a television's picture, inches", kInches);
    addNumber(command, "--bezel", wishes.bezel, "width of a television's frame, metres", kFrame);
    addNumber(
        command, "--angle", wishes.angle, "angle between neighbouring televisions, degrees", kTurn);
    addNumber(command,
              "--distance",
              wishes.distance,
              "distance from the eye to the middle of a flat wall or of televisions, metres",
              kMetres);
    addNumber(command, "--radius", wishes.radius, "of a cylinder, metres", kMetres);
    addNumber(command, "--arc", wishes.arc, "angle that a cylinder covers, degrees", kArc);
    addNumber(command, "--width", wishes.width, "of a flat wall, metres", kMetres);
    addNumber(command, "--height", wishes.height, "of the screen, metres", kMetres);
    addNumber(command,
              "--throw",
              wishes.throwRatio,
              "throw ratio of the projectors: distance by width",
              kThrow);
    addNumber(
        command, "--mount", wishes.mount, "height of projectors above the eye, metres", kMount);
}

}  // namespace

void addNewRig(CommandLine& line) {
    const auto [command, options] = line.add<NewRigOptions>(
        "new-rig", "write a rig for this wall, from questions or options", newRig);
    const auto isSize = [](const std::string& text) {
        return sizeIfAny(text) ? std::string() : text + " is no size, as 1920x1080";
    };
    const auto isFileName = [](const std::string& text) {
        return text.ends_with(".txtpb") ? std::string() : text + " must end in .txtpb";
    };
    command.add_option("FILE", options.file, "the new rig, NAME.txtpb")
        ->required()
        ->check(CLI::Validator(isFileName, ""));
    command
        .add_option("--screen", options.kind, "televisions, cylinder or flat; asks when left out")
        ->check(CLI::IsMember({"televisions", "cylinder", "flat"}));
    command.add_option("--count", options.wishes.count, "televisions or projectors")
        ->check(cli::wholeNumber(1, kMostNewChannels));
    CLI::Option* monitors = command.add_option(
        "--monitors", options.monitors, "their connectors from left to right: HDMI-1,DP-2");
    command
        .add_flag("--windows",
                  options.wishes.windows,
                  "small windows on this desktop, not whole monitors")
        ->excludes(monitors);
    command
        .add_option("--size",
                    options.size,
                    "size of each picture, as 1920x1080; by default the monitors' own")
        ->check(CLI::Validator(isSize, ""));
    command.add_option("--scene", options.wishes.scene, "what is shown, from the rig's folder");
    describeMeasures(command, options.wishes);
}

}  // namespace aquarama
