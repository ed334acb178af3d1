// SPDX-License-Identifier: Apache-2.0
#include "console/console.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "console/cues/listen.h"

namespace aquarama::console {

namespace {

// Of a clock that nobody sets.
double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Who offers the pictures of the rig's folder.
const Holder kFolder{
    .id = {}, .hash = {}, .name = "folder of drawings", .role = ConsoleRole::Operator};

// "2026-11-25 09:30"
std::string minuteOf(UnixSeconds seconds) {
    return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

}  // namespace

Console::Console(const ConsoleOptions& options, Access& access)
    : options_{options},
      state_{options.rig, options.master.rig, options.build, access},
      visitors_{state_},
      errands_{state_},
      commands_{state_, visitors_, errands_},
      tracker_{options.rig, options.master.rig},
      search_{options.rig} {
    state_.keyFolder = options.keyFolder;
    state_.built = options.built;
    state_.searchesNodes = search_.isOn();
}

Console::~Console() = default;

// What the links hear comes to the server's thread, where all of this is used.
void Console::begin(web::WebServer& server, Doors doors) {
    server_ = &server;
    doors_ = std::move(doors);
    const auto here = [this](auto what) { server_->post(std::move(what)); };
    if (!state_.rig.sides.watch.empty())
        hub_ = std::make_unique<ask::PictureHub>(
            state_.rig.sides.watch,
            ask::watchKeysOf(state_.rigFile, options_.keyFolder),
            ask::PictureListener{
                [=, this](const std::string& channel, const v1::FramePicture& picture) {
                    here([=, this] { visitors_.heardPicture(channel, picture); });
                },
                [=, this](const v1::FishReply& reply) {
                    here([=, this] {
                        // The fish is asked for what goes on in it at once.
                        if (const auto fish = visitors_.heardFish(reply)) link_->explain(*fish);
                    });
                }});
    link_ = std::make_unique<ShowLink>(
        options_.master,
        ShowListener{[=, this](const v1::StatusReply& status, std::uint64_t run) {
                         here([this, wall = wallOf(status, run)] { heardWall(wall); });
                     },
                     [=, this](const std::string& preparing) {
                         here([=, this] { wallIsSilent(preparing); });
                     },
                     [=, this](std::uint64_t request, const ask::Answer& answer) {
                         here([=, this] { commands_.said(request, answer); });
                     },
                     [=, this](const v1::Explanation& explanation) {
                         here([=, this] { visitors_.heardMind(explanation); });
                     },
                     [=, this](const v1::DrawingsReply& reply) {
                         here([=, this] { heardDrawings(reply); });
                     }});
    visitors_.watch(hub_.get());
    commands_.reach(link_.get());
    beginDrawings();
    listenToDesk();
    tracker_.everySecond();
    visitors_.note("console", "started, build " + state_.build);
    if (!state_.access.hasPeople()) showCode(ConsoleRole::Crew);
}

// Their threads end here; nothing is posted any more.
void Console::end() {
    reader_.reset();
    link_.reset();
    hub_.reset();
}

// The reader's answers come from its thread.
void Console::beginDrawings() {
    if (!state_.rig.drawings) return;
    reader_ = std::make_unique<ask::DrawingReader>();
    visitors_.readPictures(reader_->isInstalled());
    if (!reader_->isInstalled()) return;
    commands_.readBy([this](std::string picture, auto done) {
        return reader_->read(std::move(picture), [this, done](const ask::DrawingOutcome& outcome) {
            server_->post([=] { done(outcome); });
        });
    });
    if (state_.rig.drawings->folder.empty()) return;
    const auto take = [this](const std::string& name, std::string picture) -> std::uint64_t {
        browser::Command command;
        command.set_id(ask::freshRequest());
        command.mutable_picture()->set_name(name);
        command.mutable_picture()->set_picture(std::move(picture));
        const auto reply = commands_.carryOut(kFolder, nullptr, command);
        return reply.outcome() == v1::OrderReply::WAITING ? reply.request() : 0;
    };
    const auto refuse = [this](const std::string& name, const std::string& why) {
        visitors_.note(kFolder.name, titleOfPicture(name) + ", refused: " + why);
    };
    folder_ = std::make_unique<DrawingFolder>(
        std::filesystem::path(state_.rigFile).parent_path() / state_.rig.drawings->folder,
        PictureTaker{
            take, [this](std::uint64_t command) { return commands_.answerTo(command); }, refuse});
}

bool Console::takesDrawings() const {
    return state_.wall.heard() && state_.wall.status().drawings() &&
           state_.drawings.size() < std::size_t{wire::kMostDrawings};
}

// In the terminal, and where the service's log goes.
void Console::showCode(ConsoleRole role) {
    const std::string code = state_.access.makeCode(role, unixNow());
    logInfo("pairing code {} lets one browser in as {}, within ten minutes", code, nameOf(role));
}

// Changes are told from looks at the wall, so it does not matter who made them.
void Console::heardWall(const browser::Wall& wall) {
    if (state_.wall.run() != 0)
        for (const std::string& line : changesOf(state_.wall, wall)) visitors_.note("wall", line);
    state_.wall = wall;
    state_.wall.set_heard_s(unixNow());
    if (wall.status().has_drawings_version() || state_.drawings.size() == 0) return;
    state_.drawings.clear();
    visitors_.heardDrawings();
}

void Console::heardDrawings(const v1::DrawingsReply& reply) {
    state_.drawings.hear(reply);
    visitors_.heardDrawings();
    askForSkin();
}

// One at a time; also each second, as an answer may be lost.
void Console::askForSkin() {
    if (const std::uint32_t number = state_.drawings.wanted()) link_->askSkin(number);
}

// What was last heard stays, and is marked as old. How far a preparation is, pages show; only its
// beginning is an event.
void Console::wallIsSilent(const std::string& preparing) {
    if (!preparing.empty() && state_.wall.preparing().empty()) visitors_.note("wall", preparing);
    if (state_.wall.heard() && preparing.empty())
        visitors_.note("wall", "the master does not answer");
    state_.wall.set_heard(false);
    state_.wall.set_preparing(preparing);
}

// Ten times a second; the wall is sent five times.
void Console::tick() {
    constexpr int kTicksOfAWall = 2;
    ++ticks_;
    visitors_.tick();
    state_.figures.add(state_.wall);
    hearDesks();
    if (folder_) folder_->tick(takesDrawings());
    for (const std::string& line : faders_.update(state_.wall, steadySeconds()))
        visitors_.note("wall", line);
    if (ticks_ % kTicksASecond == 0) everySecond();
    if (ticks_ % kTicksOfAWall == 0) visitors_.sendWall(state_.refused + server_->cutOff());
}

void Console::hearDesks() {
    if (desk_)
        desk_->tick(shownBy(state_.wall.status(), state_.wall.heard(), state_.drawings.counts()));
    if (dmx_) dmx_->tick(steadySeconds());
    if (const auto hands = tracker_.tick()) link_->touch(*hands);
}

// That somebody set it explains the times of events before and after. A code of the first start
// ends with the time that it was made for.
void Console::watchClock(UnixSeconds now) {
    constexpr double kOfBusyMachine = 60;
    const auto look = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(look - lastLook_).count();
    const bool isSet = lastSecond_ > 0 && std::abs(now - lastSecond_ - passed) > kOfBusyMachine;
    if (isSet) {
        visitors_.note(
            "console",
            fmt::format("the clock was set, or the machine slept: after {} came {} (UTC)",
                        minuteOf(lastSecond_),
                        minuteOf(now)));
        if (!state_.access.hasPeople()) showCode(ConsoleRole::Crew);
    }
    lastSecond_ = now;
    lastLook_ = look;
    std::string doubt = clockDoubt(now, options_.built);
    if (state_.doubtOfClock.empty() && !doubt.empty())
        logWarning("{}; hours and certificates rest; {}", doubt, kSetTheClock);
    state_.doubtOfClock = std::move(doubt);
}

// Again each second: a network card may come late.
void Console::listenToDesk() {
    const auto give = [this](const std::string& who, const v1::Order& order) {
        return giveOrder({.id = {}, .hash = {}, .name = who, .role = ConsoleRole::Operator}, order);
    };
    const config::Cues& cues = state_.rig.cues;
    if (cues.dmx && !dmx_) dmx_ = std::make_unique<DmxDesk>(*cues.dmx, give, openUniverse);
    if (desk_ || !cues.osc) return;
    listenTo("cues by OSC", cues.osc->listen, deskProblem_, [&] {
        desk_ = std::make_unique<OscDesk>(*cues.osc, give);
    });
}

v1::OrderReply Console::giveOrder(const Holder& holder, const v1::Order& order) {
    browser::Command command;
    command.set_id(order.request() != 0 ? order.request() : ask::freshRequest());
    command.set_run(order.run() != 0 ? order.run() : state_.wall.run());
    *command.mutable_order() = order;
    return commands_.carryOut(holder, nullptr, command);
}

// The server takes what was renewed, or what somebody has put there.
void Console::tendCertificate(UnixSeconds now) {
    constexpr int kTicksBetween = 10 * kTicksASecond;
    if (options_.certificate == nullptr || ticks_ % kTicksBetween != 0) return;
    CertificateKeeper& keeper = *options_.certificate;
    if (!keeper.tend(now)) return;
    try {
        server_->useCertificate(keeper.files().certificate.string(), keeper.files().key.string());
        keeper.taken();
        visitors_.note("console",
                       "another certificate, valid until " + dayOf(keeper.validity().until));
    } catch (const Error& problem) {
        keeper.refused(problem.what());
    }
}

// Of the folder of pictures; empty where there is none.
std::string Console::problemOfDrawings() const {
    if (folder_) return folder_->problem();
    if (!reader_ || state_.rig.drawings->folder.empty()) return {};
    return "the pictures of the folder are not read; install aquarama-drawings, and start the "
           "console again";
}

std::vector<Fault> Console::faultsNow(UnixSeconds now) const {
    std::vector<Fault> faults = faultsOf(state_.wall, state_.build, now);
    for (Fault& fault : faultsOf(state_.opening.projectors())) faults.push_back(std::move(fault));
    if (!state_.opening.problem().empty())
        faults.push_back({"hours",
                          "there are no hours, and nothing is switched: their text cannot be "
                          "read; the crew mends it on the page of the schedule",
                          0});
    if (!state_.doubtOfClock.empty())
        faults.push_back(
            {"clock", state_.doubtOfClock + "; hours and certificates rest; " + kSetTheClock, 0});
    if (!deskProblem_.empty()) faults.push_back({"cues", "cues: " + deskProblem_, 5});
    if (dmx_ && !dmx_->problem().empty())
        faults.push_back({"dmx", "cues by DMX: " + dmx_->problem(), 5});
    if (std::string problem = problemOfDrawings(); !problem.empty())
        faults.push_back({"drawings", "drawings: " + problem, 5});
    if (!tracker_.problem().empty()) faults.push_back({"touch", "hands: " + tracker_.problem(), 5});
    if (options_.certificate != nullptr)
        for (Fault& fault : options_.certificate->faults(now)) faults.push_back(std::move(fault));
    return faults;
}

// Also what people should notice although they look at nothing.
void Console::everySecond() {
    const UnixSeconds now = unixNow();
    watchClock(now);
    tendCertificate(now);
    listenToDesk();
    tracker_.everySecond();
    commands_.keepHours();
    commands_.keepDay();
    askForSkin();
    commands_.keepScan();
    const bool isQuiet = state_.doubtOfClock.empty() && state_.opening.isClosed(now);
    const auto lines = state_.alerts.update(faultsNow(now), now, isQuiet);
    for (const std::string& line : lines) visitors_.note("alert", line);
    for (const auto& [who, what] : projectorBook_.update(state_.opening.projectors(), now))
        visitors_.note(who, what);
    if (visitors_.isLookedAt("calibrations")) errands_.wantCalibrations(ticks_);
    if (visitors_.isLookedAt("machines")) errands_.wantReleases(ticks_);
    if (visitors_.isLookedAt("tour")) errands_.wantTour(ticks_);
    if (const auto ended = errands_.hear())
        commands_.said(ended->command,
                       ended->refusal.empty() ? ask::Answer{}
                                              : ask::Answer{ask::Outcome::Refused, ended->refusal});
    state_.waiting = search_.nodes();
    visitors_.everySecond();
    if (options_.service != nullptr) options_.service->alive(0);
}

}  // namespace aquarama::console
