// SPDX-License-Identifier: Apache-2.0
#include "console/touch/touch_command.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "common/ask/request_client.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/keyboard.h"
#include "common/cli/outputs.h"
#include "common/config/adjustments.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"
#include "console/cues/tracker_port.h"
#include "console/touch/plane_fit.h"
#include "console/touch/port_loan.h"
#include "console/touch/still_place.h"
#include "console/touch/wall_marks.h"

namespace aquarama::console {

namespace {

// Most trackers send to this one unless told otherwise.
constexpr const char* kUsualListen = "udp://127.0.0.1:3333";
constexpr const char* kLoopback = "127.0.0.1";
// For each mark.
constexpr double kPatienceSeconds = 120;
constexpr auto kBetweenKeys = std::chrono::milliseconds(20);
// How far a hand that is held still moves, and a person who stands; shares of the plane.
constexpr double kSpreadOfHands = 0.02;
constexpr double kSpreadOfPeople = 0.05;

double secondsNow() {
    using std::chrono::steady_clock;
    return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
}

// Who works at the wall: reads what is said, and may end it by a key or a signal.
class Crew {
  public:
    // Throws Error once the crew wants to end.
    void listen() {
        std::string keys;
        const bool isOpen = hasKeys_ && keyboard_.read(keys, kBetweenKeys);
        if (!isOpen) std::this_thread::sleep_for(kBetweenKeys);
        hasKeys_ = isOpen;
        constexpr const char* kEnding = "qQ\x03\x04";
        if (isEnded_ || keys.find_first_of(kEnding) != std::string::npos)
            throw Error("ended before the last mark; nothing was changed");
    }
    // What there is to do now: one line that is rewritten on a terminal, else a line where it is
    // new.
    void tell(const std::string& what) {
        if (what == told_) return;
        told_ = what;
        std::cout << (isOnScreen_ ? "\r\x1b[K  " : "  ") << what << (isOnScreen_ ? "" : "\n")
                  << std::flush;
    }
    void say(const std::string& line) {
        const bool hasOpenLine = isOnScreen_ && !told_.empty();
        told_.clear();
        std::cout << (hasOpenLine ? "\r\x1b[K" : "") << line << std::endl;
    }

  private:
    std::atomic<bool> isEnded_ = false;
    cli::SignalWatch watch_{[this] { isEnded_ = true; }};
    cli::Keyboard keyboard_;
    bool hasKeys_ = true;
    bool isOnScreen_ = isatty(STDOUT_FILENO) != 0;
    std::string told_;
};

// The grid on the wall while this object lives; then what was there before.
class GridOnWall {
  public:
    // Throws Error where no master answers, or nobody would see the grid.
    explicit GridOnWall(const ask::AskedMaster& master, const std::string& rig)
        : master_{master.connect()} {
        const v1::Show shown = master_.status().show();
        if (shown.black())
            throw Error("the wall is black; switch it on: aquarama set " + rig + " black off");
        if (shown.pattern() == v1::PATTERN_SCAN)
            throw Error("a calibration scans the wall; wait for its end");
        before_ = static_cast<v1::WantedShow::Shown>(shown.pattern());
        show(v1::WantedShow::GRID);
    }
    ~GridOnWall() {
        try {
            show(before_);
        } catch (const std::exception& problem) {
            cli::sayError("aquarama touch",
                          std::string("the grid stays on the wall: ") + problem.what());
        }
    }
    GridOnWall(const GridOnWall&) = delete;
    GridOnWall& operator=(const GridOnWall&) = delete;

  private:
    void show(v1::WantedShow::Shown pattern) {
        v1::Order order;
        order.mutable_show()->set_pattern(pattern);
        master_.carryOut(std::move(order), [](const std::string&) {});
    }
    ask::RequestClient master_;
    v1::WantedShow::Shown before_{};
};

// What the rig has, with what the options say instead; without corners where it has none. Only
// named addresses are past the loopback.
config::TouchedSurface surfaceOf(const TouchOptions& options, const config::Rig& rig) {
    config::TouchedSurface surface = rig.touch.value_or(
        config::TouchedSurface{.listen = *config::udpAddressIn(kUsualListen), .from = {kLoopback}});
    if (!options.listen.empty()) surface.listen = *config::udpAddressIn(options.listen);
    if (!options.from.empty()) surface.from.clear();
    for (const std::string& host : options.from) surface.from.push_back(config::shortestHost(host));
    constexpr double kUsualReach = 2.5;  // as rig.proto says
    if (options.arePeople && !surface.peopleReachMetres) surface.peopleReachMetres = kUsualReach;
    return surface;
}

// At once, or as soon as the console of this rig has given it up.
std::unique_ptr<TrackerPort> portOf(const config::TouchedSurface& surface) {
    const double giveUp = secondsNow() + kLoanSeconds;
    for (;;) try {
            return std::make_unique<TrackerPort>(surface.listen, surface.from);
        } catch (const Error&) {
            if (secondsNow() > giveUp) throw;
            std::this_thread::sleep_for(kBetweenKeys);
        }
}

// Why nobody was seen still.
std::string whyInVain(const TrackerPort& port, const config::TouchedSurface& surface) {
    if (port.isHeard())
        return "hold still, one alone; or the tracker does not see the mark: choose marks nearer "
               "to the middle (--share 0.5)";
    if (!port.stranger().empty())
        return "packets came from " + port.stranger() + " alone: name it by --from";
    return "no packet came to " + config::textOf(surface.listen) +
           ": let the tracker send TUIO there, or name another address by --listen";
}

// Waits at one mark. Throws Error where the crew ends it, or nobody is seen for long.
glm::dvec2 placeAt(TrackerPort& port,
                   const config::TouchedSurface& surface,
                   const std::vector<glm::dvec2>& before,
                   Crew& crew) {
    StillPlace still(surface.peopleReachMetres ? kSpreadOfPeople : kSpreadOfHands, before);
    const double giveUp = secondsNow() + kPatienceSeconds;
    while (secondsNow() < giveUp) {
        const double now = secondsNow();
        if (const auto place = still.see(port.hear(now), now)) return *place;
        crew.tell(still.text());
        crew.listen();
    }
    throw Error("nobody was seen still at the mark in two minutes: " + whyInVain(port, surface));
}

// Leads the crew through the marks.
SeenMarks see(const WallMarks& marks,
              TrackerPort& port,
              const config::TouchedSurface& surface,
              Crew& crew) {
    SeenMarks seen;
    std::vector<glm::dvec2> before;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        crew.say(fmt::format("mark {} of 3: {}", i + 1, marks.at(i).words));
        const glm::dvec2 place = placeAt(port, surface, before, crew);
        seen.at(i) = {marks.at(i).point, place};
        before.push_back(place);
        crew.say(fmt::format("  seen at {:.3f} {:.3f} of the tracker's plane", place.x, place.y));
    }
    return seen;
}

std::string cornerText(const char* name, const glm::dvec3& corner) {
    return fmt::format(
        "  {} {{ x_m: {:.3f} y_m: {:.3f} z_m: {:.3f} }}\n", name, corner.x, corner.y, corner.z);
}

// The block of the rig's file.
std::string textOf(const config::TouchedSurface& surface) {
    std::string text = fmt::format("touch {{\n  listen: \"{}\"\n", config::textOf(surface.listen));
    if (surface.from != std::vector<std::string>{kLoopback})
        for (const std::string& host : surface.from) text += fmt::format("  from: \"{}\"\n", host);
    text += cornerText("top_left", surface.topLeft) + cornerText("top_right", surface.topRight) +
            cornerText("bottom_left", surface.bottomLeft);
    if (surface.peopleReachMetres)
        text += fmt::format("  people {{ reach_m: {:g} }}\n", *surface.peopleReachMetres);
    return text + "}\n";
}

// The rig's file with another block, at its end. Throws Error where the rig would be wrong.
std::string withBlock(const std::string& path, const std::string& block) {
    std::string text = config::readTextFile(path);
    const config::Rig before = config::parseRig(text, path);
    if (before.touch) text = config::withoutEntry(text, before.places.touch);
    if (!text.empty() && !text.ends_with('\n')) text += '\n';
    text += "\n" + block;
    config::Rig rig = config::parseRig(text, path);
    config::readRigFiles(rig, path);
    wall::checkGeometry(rig, path);
    return text;
}

// Tells the result, and writes it where that is wished.
void conclude(const TouchOptions& options,
              const config::TouchedSurface& surface,
              const std::vector<PlaneFinding>& findings) {
    for (const PlaneFinding& finding : findings) std::cout << finding.text << '\n';
    const std::string block = textOf(surface);
    std::cout << '\n' << block << std::endl;
    const std::string text = withBlock(options.rig, block);
    if (!options.writes) {
        std::cout << "write this into " << options.rig << " instead of a touch that it has, or "
                  << "start again with --write\n";
        return;
    }
    if (std::ranges::any_of(findings, &PlaneFinding::isDoubt))
        throw Error(options.rig +
                    " is as it was, as the result is doubtful; do it again, or write the block "
                    "into it yourself");
    writeWhole(options.rig, std::as_bytes(std::span(text)));
    std::cout << "wrote " << options.rig << "; a running console takes it at once\n";
}

void mapTouch(const TouchOptions& options) {
    cli::holdSignals();
    const config::Rig rig = config::readRig(options.rig);
    if (options.writes) cli::requireFile("--write", options.rig);
    config::TouchedSurface surface = surfaceOf(options, rig);
    const WallMarks marks = surface.peopleReachMetres ? marksForPeople(rig, options.share)
                                                      : marksForHands(rig, options.share);
    const PortLoan loan(options.rig);
    const auto port = portOf(surface);
    const SeenMarks seen = [&] {
        const GridOnWall grid({.rig = options.rig, .address = options.master, .key = options.key},
                              options.rig);
        Crew crew;
        crew.say("the wall shows the grid; q ends, and shows again what was there");
        return see(marks, *port, surface, crew);
    }();
    fitCorners(seen, surface);
    conclude(options, surface, findingsOf(surface, seen, rig.sweetSpotMetres));
}

// For CLI::Validator: an empty text means that it is good.
std::string problemOfListen(const std::string& text) {
    if (config::udpAddressIn(text)) return {};
    return "\"" + text +
           "\" is no address of one machine; write that of a network card of this one, as in "
           "udp://192.168.7.1:3333";
}
std::string problemOfHost(const std::string& text) {
    if (!config::shortestHost(text).empty()) return {};
    return "\"" + text + "\" is no number of one machine, as 192.168.7.41";
}

}  // namespace

void addTouch(cli::CommandLine& line) {
    const auto [command, options] = line.add<TouchOptions>(
        "touch",
        "map a tracker of hands or people to the wall by three marks: aquarama touch RIG",
        mapTouch);
    command.add_option("RIG", options.rig, "whose show runs")->required();
    command.add_option("--listen", options.listen, "where the tracker sends, instead of the rig's")
        ->check(CLI::Validator(problemOfListen, ""));
    command.add_option("--from", options.from, "the tracker's machine, instead of the rig's")
        ->allow_extra_args(false)
        ->check(CLI::Validator(problemOfHost, ""));
    command.add_flag("--people", options.arePeople, "it sees people on the floor, not hands");
    command.add_option("--share", options.share, "marks lie within so much of the wall's middle")
        ->check(cli::number(0.1, 1))
        ->capture_default_str();
    command.add_flag("--write", options.writes, "write the result into the rig's file");
    command.add_option(
        "--master", options.master, "control address of the master, instead of the rig's");
    command.add_option("--key", options.key, "file of the operator's key, where the rig needs one");
    command.footer(
        "It shows the grid on the running wall, asks for a hand at three crossings, and prints the "
        "block touch.\nThe console of this user gives the port up meanwhile. The file keeps its "
        "other comments.");
}

}  // namespace aquarama::console
