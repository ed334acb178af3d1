// SPDX-License-Identifier: Apache-2.0
// The life of the console: what master and nodes say, and what is due.
#include "console/console.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>

#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/wire/wanted_show.h"

namespace aquarama::console {

namespace {

// What the master is told where the hours want this.
v1::Order orderOfHours(const config::WantedHours& wanted) {
    v1::Order order;
    order.set_request(ask::freshRequest());
    v1::WantedShow& show = *order.mutable_show();
    show.set_black(!wanted.isOpen);
    if (!wanted.scene.empty()) show.set_scene(wanted.scene);
    if (wanted.quality == "auto") show.set_quality(v1::WantedShow::AUTO);
    if (const auto tier = config::tierNamed(wanted.quality)) show.set_quality(wire::tierOf(tier));
    return order;
}

// What is said of a scan again and again; nobody asks how it went.
v1::Order orderOf(const v1::HeldScan& scan) {
    v1::Order order;
    order.set_request(ask::freshRequest());
    *order.mutable_scan() = scan;
    return order;
}

// The shutters of projectors wait for that.
bool isInStep(const browser::Wall& wall) {
    return wall.heard() && std::ranges::all_of(wall.nodes(), [](const browser::Node& node) {
               return node.condition() == "in step";
           });
}

// "2026-11-25 09:30"
std::string minuteOf(UnixSeconds seconds) {
    return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

// Little-endian: channel, 0, width, height of 16 bits each, frame of 64; then the JPEG.
web::Payload framed(int channel, const v1::FramePicture& picture) {
    std::string bytes;
    const auto add = [&](std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFFU);
    };
    add(static_cast<std::uint64_t>(channel), 2);
    add(0, 2);
    add(picture.width_px(), 2);
    add(picture.height_px(), 2);
    add(picture.frame(), 8);
    return std::make_shared<const std::string>(bytes + picture.jpeg());
}

}  // namespace

Console::Console(ConsoleOptions options, Access& access)
    : options_{std::move(options)},
      access_{access},
      events_{stateFolderOf(options_.master.rig) / "events.jsonl"},
      opening_{stateFolderOf(options_.master.rig)},
      panorama_{options_.master.rig} {
    wall_.set_heard(false);
}

Console::~Console() = default;

// What the links hear comes to the server's thread, where all of this is used.
void Console::begin(web::WebServer& server, Doors doors) {
    server_ = &server;
    doors_ = std::move(doors);
    const auto here = [this](auto what) { server_->post(std::move(what)); };
    if (!options_.rig.watchAddress.empty())
        hub_ = std::make_unique<PictureHub>(
            options_.rig.watchAddress,
            watchKeysOf(options_.master.rig, options_.keyFolder),
            PictureListener{[=, this](const std::string& channel, const v1::FramePicture& picture) {
                                here([=, this] { heardPicture(channel, picture); });
                            },
                            [=, this](const std::string& channel, const v1::FishReply& reply) {
                                here([=, this] { heardFish(channel, reply); });
                            }});
    link_ = std::make_unique<ShowLink>(
        options_.master,
        ShowListener{
            [=, this](const v1::StatusReply& status, std::uint64_t run) {
                here([this, wall = wallOf(status, run, options_.build)] { heardWall(wall); });
            },
            [=, this](const std::string& preparing) {
                here([=, this] { wallIsSilent(preparing); });
            },
            [=, this](std::uint64_t id, const std::string& outcome, const std::string& why) {
                here([=, this] { saidOfSet(id, outcome, why); });
            },
            [=, this](const v1::Explanation& explanation) {
                here([=, this] { heardMind(explanation); });
            }});
    note("console", "started, build " + options_.build);
    if (!access_.hasPeople()) showCode(ConsoleRole::Crew);
}

// Their threads end here; nothing is posted any more.
void Console::end() {
    link_.reset();
    hub_.reset();
}

// In the terminal, and where the service's log goes.
void Console::showCode(ConsoleRole role) {
    const std::string code = access_.makeCode(role, unixNow());
    logInfo("pairing code {} lets one browser in as {}, within ten minutes", code, nameOf(role));
}

// Everybody who is connected sees it at once.
void Console::note(const std::string& who, const std::string& what) {
    events_.add(who, what);
    browser::ToBrowser message;
    *message.mutable_events() = events_.list();
    sendToAll("events", message);
}
// --- what master and nodes say

// Changes are told from looks at the wall, so it does not matter who made them.
void Console::heardWall(const browser::Wall& wall) {
    if (wall_.run() != 0)
        for (const std::string& line : changesOf(wall_, wall)) note("wall", line);
    wall_ = wall;
    wall_.set_heard_s(unixNow());
}

// What was last heard stays, and is marked as old. How far a preparation is, pages show; only its
// beginning is an event.
void Console::wallIsSilent(const std::string& preparing) {
    if (!preparing.empty() && wall_.preparing().empty()) note("wall", preparing);
    if (wall_.heard() && preparing.empty()) note("wall", "the master does not answer");
    wall_.set_heard(false);
    wall_.set_preparing(preparing);
}

// What is refused now is refused in a second as well: it is said, and not repeated. What nobody has
// heard is said again.
void Console::saidOfHours(const std::string& outcome, const std::string& why) {
    const config::WantedHours wanted = *std::exchange(beingOpened_, {});
    if (outcome == "lost") return;
    opening_.done(wanted);
    note("schedule",
         (wanted.isOpen ? "opened " + wanted.scene : std::string("closed")) +
             (outcome == "done" ? "" : ", refused: " + why));
}

// Whoever asked may have gone; the event is noted all the same.
void Console::saidOfSet(std::uint64_t id, const std::string& outcome, const std::string& why) {
    const bool isEnded = outcome != "waiting";
    if (id == scan_.id && outcome != "done" && isEnded) scan_ = {};
    if (id == openingId_ && isEnded && beingOpened_) return saidOfHours(outcome, why);
    const auto pending = pending_.find(id);
    if (pending == pending_.end()) return;
    browser::ToBrowser message;
    *message.mutable_done() = settle(id, outcome == "lost" ? "refused" : outcome, why);
    if (Visitor* visitor = pending->second.visitor)
        sendTo(*visitor, fmt::format("done {}", id), message);
    if (!isEnded) return;
    note(pending->second.who,
         pending->second.what + (outcome == "done" ? "" : ", refused: " + why));
    pending_.erase(id);
}

// To those who look and have drawn the one before; an old answer is to nobody.
void Console::heardPicture(const std::string& channel, const v1::FramePicture& picture) {
    const int index = channelIndexOf(channel);
    if (index < 0 || pictures_[index].number != picture.number()) return;
    pictures_[index].ticksToAsk = 0;
    const web::Payload payload = framed(index, picture);  // once for all who look
    for (Visitor* visitor : visitors_) {
        if (!isWatched(*visitor, index) || visitor->picturesUnderWay.contains(index)) continue;
        visitor->picturesUnderWay[index] = kTicksOfALook;
        visitor->outbox->put("picture " + std::to_string(index), payload, true);
    }
}

// The fish is asked for what goes on in it at once.
void Console::heardFish(const std::string& channel, const v1::FishReply& reply) {
    const auto asked = fishAsked_.find(reply.number());
    if (asked == fishAsked_.end()) return;
    browser::ToBrowser message;
    browser::Mind& mind = *message.mutable_mind();
    mind.set_channel(channel);
    mind.set_frame(reply.frame());
    mind.set_fish(reply.has_fish() ? static_cast<int>(reply.fish()) : -1);
    sendTo(*asked->second, "mind", message);
    if (reply.has_fish()) link_->explain(reply.fish());
    fishAsked_.erase(asked);
}

// To all who have that page open.
void Console::heardMind(const v1::Explanation& explanation) {
    browser::ToBrowser message;
    browser::Mind& mind = *message.mutable_mind();
    mind.set_fish(static_cast<int>(explanation.fish()));
    mind.set_tick(explanation.tick());
    for (const std::string& line : explanation.lines()) mind.add_lines(line);
    for (Visitor* visitor : visitors_)
        if (visitor->wants("mind")) sendTo(*visitor, "mind", message);
}

// --- what is due

// -1 where the rig has none of that name.
int Console::channelIndexOf(const std::string& channel) const {
    const auto found = std::ranges::find(options_.rig.channels, channel, &config::Channel::name);
    return found == options_.rig.channels.end()
               ? -1
               : static_cast<int>(found - options_.rig.channels.begin());
}

// A look is forgotten after three seconds without a word.
bool Console::isWatched(const Visitor& visitor, int channel) const {
    const auto& channels = visitor.look.channels();
    const std::string& name = options_.rig.channels[static_cast<std::size_t>(channel)].name;
    return visitor.ticksToLook > 0 && std::ranges::find(channels, name) != channels.end();
}

// The widest that somebody wants who has drawn the last one; 0: nobody.
std::uint32_t Console::wantedWidth(int channel) const {
    constexpr std::uint32_t kLeast = 64, kMost = 960;
    std::uint32_t width = 0;
    for (const Visitor* visitor : visitors_)
        if (isWatched(*visitor, channel) && !visitor->picturesUnderWay.contains(channel))
            width = std::max(width, std::clamp(visitor->look.width_px(), kLeast, kMost));
    return width;
}

// Asked once more after a second without an answer.
void Console::askPictures() {
    if (!hub_) return;
    for (int channel = 0; channel < static_cast<int>(options_.rig.channels.size()); ++channel) {
        PictureState& state = pictures_[channel];
        if (state.ticksToAsk > 0 && --state.ticksToAsk > 0) continue;
        const std::uint32_t width = wantedWidth(channel);
        if (width == 0) continue;
        state = {kTicksASecond, ++number_};
        hub_->askPicture(
            options_.rig.channels[static_cast<std::size_t>(channel)].name, number_, width);
    }
}

// Ten times a second; the wall is sent five times.
void Console::tick() {
    constexpr int kTicksOfAWall = 2;
    ++ticks_;
    for (Visitor* visitor : visitors_) {
        if (visitor->ticksToLook > 0 && --visitor->ticksToLook == 0) visitor->hasHistory = false;
        for (auto& [channel, ticks] : visitor->picturesUnderWay) --ticks;
        std::erase_if(visitor->picturesUnderWay, [](const auto& one) { return one.second <= 0; });
    }
    askPictures();
    figures_.add(wall_);
    if (ticks_ % kTicksASecond == 0) everySecond();
    if (ticks_ % kTicksOfAWall == 0) sendWall();
}

// That somebody set it explains the times of events before and after. A code of the first start
// ends with the time that it was made for.
void Console::watchClock(UnixSeconds now) {
    constexpr double kOfBusyMachine = 60;
    const auto look = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(look - lastLook_).count();
    const bool isSet = lastSecond_ > 0 && std::abs(now - lastSecond_ - passed) > kOfBusyMachine;
    if (isSet) {
        note("console",
             fmt::format("the clock was set, or the machine slept: after {} came {} (UTC)",
                         minuteOf(lastSecond_),
                         minuteOf(now)));
        if (!access_.hasPeople()) showCode(ConsoleRole::Crew);
    }
    lastSecond_ = now;
    lastLook_ = look;
    std::string doubt = clockDoubt(now, options_.built);
    if (doubtOfClock_.empty() && !doubt.empty())
        logWarning("{}; hours and certificates rest; {}", doubt, kSetTheClock);
    doubtOfClock_ = std::move(doubt);
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
        note("console", "another certificate, valid until " + dayOf(keeper.validity().until));
    } catch (const Error& problem) {
        keeper.refused(problem.what());
    }
}

std::vector<Fault> Console::faultsNow(UnixSeconds now) const {
    std::vector<Fault> faults = faultsOf(wall_, now);
    for (Fault& fault : faultsOf(opening_.projectors())) faults.push_back(std::move(fault));
    if (!opening_.problem().empty())
        faults.push_back({"hours",
                          "there are no hours, and nothing is switched: their text cannot be "
                          "read; the crew mends it on the page of the schedule",
                          0});
    if (!doubtOfClock_.empty())
        faults.push_back(
            {"clock", doubtOfClock_ + "; hours and certificates rest; " + kSetTheClock, 0});
    if (options_.certificate != nullptr)
        for (Fault& fault : options_.certificate->faults(now)) faults.push_back(std::move(fault));
    return faults;
}

// One change at a time: its end is waited for. By a clock that is wrong the wall stays as it is.
void Console::keepHours() {
    if (!doubtOfClock_.empty()) return;
    opening_.switchProjectors(unixNow(), isInStep(wall_));
    const auto due = opening_.due(unixNow());
    if (!due || beingOpened_ || !wall_.heard()) return;
    const v1::Order order = orderOfHours(*due);
    openingId_ = order.request();
    beingOpened_ = due;
    link_->give(order);
}

// Also what people should notice although they look at nothing.
void Console::everySecond() {
    const UnixSeconds now = unixNow();
    watchClock(now);
    tendCertificate(now);
    keepHours();
    keepScan();
    const bool isQuiet = doubtOfClock_.empty() && opening_.isClosed(now);
    const auto lines = alerts_.update(faultsNow(now), now, isQuiet);
    for (const std::string& line : lines) note("alert", line);
    for (const auto& [who, what] : projectorBook_.update(opening_.projectors(), now))
        note(who, what);
    browser::ToBrowser alerts;
    *alerts.mutable_alerts() = alertList();
    sendToAll("alerts", alerts);
    hearDoctor();
    hearCalibrations();
    if (panorama_.update())
        for (Visitor* visitor : visitors_) visitor->hasPanorama = false;
    tendVisitors();
    if (options_.service != nullptr) options_.service->alive(0);
}

void Console::tendVisitors() {
    for (Visitor* visitor : visitors_) {
        visitor->messages = 0;
        if (visitor->holder.until > 0 && visitor->holder.until < unixNow())
            visitor->outbox->close(kClosedUnpaired);
        if (visitor->ticksToLook <= 0) continue;
        if (visitor->hasHistory) sendHistory(*visitor, false);
        sendTopics(*visitor);
    }
}

// Looked at each second, never waited for.
void Console::hearDoctor() {
    constexpr std::chrono::seconds kNow{0};
    if (!doctorRun_.valid() || doctorRun_.wait_for(kNow) != std::future_status::ready) return;
    doctor_ = doctorRun_.get();
    doctor_.set_running(false);
}

// Likewise.
void Console::hearCalibrations() {
    constexpr std::chrono::seconds kNow{0};
    if (calibrationsRead_.valid() && calibrationsRead_.wait_for(kNow) == std::future_status::ready)
        calibrations_ = calibrationsRead_.get();
    if (!calibrationUse_.valid() || calibrationUse_.wait_for(kNow) != std::future_status::ready)
        return;
    const std::string refusal = calibrationUse_.get();
    calibrationsDue_ = 0;
    saidOfSet(calibrationUseId_, refusal.empty() ? "done" : "refused", refusal);
}

// The master ends it by itself three seconds after the last word.
void Console::keepScan() {
    if (scan_.visitor == nullptr) return;
    if (scan_.visitor->ticksToLook <= 0 || !scan_.visitor->wants("calibrations"))
        scan_ = {};  // the page was left
    else
        link_->give(orderOf(scan_.held));
}

}  // namespace aquarama::console
