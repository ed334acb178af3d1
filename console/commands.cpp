// SPDX-License-Identifier: Apache-2.0
// The commands of the console: who may give which, and how each is carried out. All of it on the
// server's thread.
#include <algorithm>
#include <chrono>
#include <future>
#include <map>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "common/machine/machine_power.h"
#include "console/console.h"

namespace aquarama::console {

namespace {

using What = browser::Command::WhatCase;

// What somebody must be for a command; empty for what is none.
std::optional<ConsoleRole> roleFor(What what) {
    static const std::map<What, ConsoleRole> kRoles{{What::kRunDoctor, ConsoleRole::Watcher},
                                                    {What::kPointAt, ConsoleRole::Watcher},
                                                    {What::kMind, ConsoleRole::Watcher},
                                                    {What::kBlack, ConsoleRole::Operator},
                                                    {What::kFreeze, ConsoleRole::Operator},
                                                    {What::kScene, ConsoleRole::Operator},
                                                    {What::kQuality, ConsoleRole::Operator},
                                                    {What::kPattern, ConsoleRole::Operator},
                                                    {What::kRestart, ConsoleRole::Operator},
                                                    {What::kAcknowledge, ConsoleRole::Operator},
                                                    {What::kHoldHours, ConsoleRole::Operator},
                                                    {What::kScan, ConsoleRole::Operator},
                                                    {What::kHoursText, ConsoleRole::Crew},
                                                    {What::kNewCode, ConsoleRole::Crew},
                                                    {What::kRevoke, ConsoleRole::Crew},
                                                    {What::kProjector, ConsoleRole::Crew},
                                                    {What::kUseCalibration, ConsoleRole::Crew},
                                                    {What::kPower, ConsoleRole::Crew},
                                                    {What::kMachine, ConsoleRole::Crew}};
    const auto role = kRoles.find(what);
    return role == kRoles.end() ? std::nullopt : std::optional(role->second);
}

// For the list of events.
std::string onOff(bool on) {
    return on ? "on" : "off";
}

// Of the machine of a node; a word that is none stays unspecified.
v1::MachineOfNode machineIn(const browser::Command& command) {
    v1::MachineOfNode machine;
    machine.set_run(command.run());
    machine.set_channel(command.machine().channel());
    if (command.machine().word() == "poweroff") machine.set_word(v1::POWER_OFF);
    if (command.machine().word() == "reboot") machine.set_word(v1::POWER_REBOOT);
    return machine;
}

// Of a command for the wall, for the master; empty where it is of something else.
std::optional<v1::Set> setOf(const browser::Command& command) {
    v1::Set set;
    set.set_request(command.id());
    switch (command.what_case()) {
        case What::kBlack:
            set.set_black(command.black());
            return set;
        case What::kFreeze:
            set.set_freeze(command.freeze());
            return set;
        case What::kScene:
            set.set_scene(command.scene());
            return set;
        case What::kQuality:
            set.set_quality(command.quality());
            return set;
        case What::kPattern:
            set.set_pattern(static_cast<v1::Pattern>(
                wire::patternNamed(command.pattern()).value_or(wire::Pattern::Scan)));
            return set;
        case What::kRestart:
            set.set_restart(command.restart());
            return set;
        case What::kMachine:
            *set.mutable_machine() = machineIn(command);
            return set;
        default:
            return std::nullopt;
    }
}

// What was asked for, as the list of events has it.
std::string textOf(const v1::Set& set) {
    if (set.has_black()) return "black " + onOff(set.black());
    if (set.has_freeze()) return "freeze " + onOff(set.freeze());
    if (set.has_scene()) return "scene " + set.scene();
    if (set.has_quality()) return "quality " + set.quality();
    if (set.has_restart()) return "restart node " + set.restart();
    if (set.has_machine())
        return (set.machine().word() == v1::POWER_OFF ? "poweroff of the machine of "
                                                      : "reboot of the machine of ") +
               set.machine().channel();
    if (set.has_scan())
        return set.scan().has_pattern() ? "a pattern of a scan" : "no pattern of a scan";
    return "pattern " + std::string(wire::nameOf(static_cast<wire::Pattern>(set.pattern())));
}

// A name that the master takes: a packet of ours is never malformed there.
bool isName(const std::string& text) {
    return !text.empty() && text.size() <= wire::kMostNameBytes &&
           std::ranges::all_of(
               text, [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7F; });
}

// Of a scene, a tier or a node, where the value is one.
std::optional<std::string> nameIn(const v1::Set& set) {
    if (set.has_scene()) return set.scene();
    if (set.has_quality()) return set.quality();
    if (set.has_restart()) return set.restart();
    if (set.has_machine()) return set.machine().channel();
    return std::nullopt;
}

// Of one value, as setOf() makes it.
bool isSendable(const v1::Set& set) {
    if (const auto name = nameIn(set); name && !isName(*name)) return false;
    if (set.has_machine()) return set.machine().word() != v1::POWER_UNSPECIFIED;
    return set.pattern() != v1::PATTERN_SCAN;
}

// A place of a picture, as shares of its size. A number that is none is no place.
bool isPlace(const browser::PointAt& at) {
    const auto isShare = [](float number) { return number >= 0 && number <= 1; };
    return isShare(at.x()) && isShare(at.y());
}

// The channels that show a pattern, a bit each; nothing where there is none of that name.
std::optional<std::uint64_t> litIn(const std::string& channel, const config::Rig& rig) {
    if (channel.empty()) return ~std::uint64_t{0};
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        if (rig.channels[i].name == channel) return config::bitOf(i);
    return std::nullopt;
}

// For the eye, so without the tag that a camera reads. Nothing where there is no such pattern.
std::optional<config::ScanPattern> scanPatternOf(const browser::ScanCommand& command,
                                                 const config::Rig& rig) {
    using Kind = config::ScanPattern::Kind;
    static const std::map<std::string, Kind> kKinds{{"white", Kind::Level},
                                                    {"columns", Kind::GrayColumns},
                                                    {"rows", Kind::GrayRows},
                                                    {"dots", Kind::Dots},
                                                    {"room", Kind::Room}};
    constexpr std::uint32_t kMostStep = 15;
    const auto kind = kKinds.find(command.kind());
    const auto lit = litIn(command.channel(), rig);
    if (kind == kKinds.end() || !lit || command.step() > kMostStep) return std::nullopt;
    return config::ScanPattern{.kind = kind->second,
                               .step = static_cast<std::uint8_t>(command.step()),
                               .lit = *lit,
                               .tagged = false};
}

// The beginning of a time, as versions of files are named; so it is no option of a command line.
bool isVersion(const std::string& name) {
    constexpr std::string_view kLetters = "0123456789T-";
    constexpr std::size_t kLeast = 17, kMost = 32;
    return name.size() >= kLeast && name.size() <= kMost &&
           name.find_first_not_of(kLetters) == std::string::npos;
}

}  // namespace

// What has ended is remembered: the same number is answered once more, and not carried out.
browser::Done Console::settle(std::uint64_t id,
                              const std::string& outcome,
                              const std::string& why) {
    constexpr std::size_t kRemembered = 128;
    browser::Done done;
    done.set_id(id);
    done.set_outcome(outcome);
    done.set_reason(why);
    if (outcome == "waiting") return done;
    settled_.push_back(done);
    if (settled_.size() > kRemembered) settled_.pop_front();
    return done;
}

// The only way to any command, whoever says it and how: roles are held to here.
browser::Done Console::carryOut(const Holder& holder, Visitor* visitor, const Command& command) {
    const auto known = std::ranges::find(settled_, command.id(), &browser::Done::id);
    if (known != settled_.end()) return *known;
    if (pending_.contains(command.id())) return settle(command.id(), "waiting", "");
    const auto needed = roleFor(command.what_case());
    if (!needed || command.id() == 0) {
        ++refused_;
        return settle(command.id(), "refused", "this is no command of this console");
    }
    if (holder.role < *needed) {
        ++refused_;
        note(holder.name, "refused: it needs " + std::string(nameOf(*needed)));
        return settle(
            command.id(), "refused", "only " + std::string(nameOf(*needed)) + " may do this");
    }
    return carryOutAllowed(holder, visitor, command);
}

// By where it goes.
browser::Done Console::carryOutAllowed(const Holder& holder,
                                       Visitor* visitor,
                                       const Command& command) {
    if (command.has_scan()) return showScan(holder, visitor, command);
    if (command.has_use_calibration()) return useKept(holder, visitor, command);
    if (const auto set = setOf(command)) return tellWall(holder, visitor, command, *set);
    return carryOutHere(holder, visitor, command);
}

// The master answers later; saidOfSet() passes that on.
browser::Done Console::tellWall(const Holder& holder,
                                Visitor* visitor,
                                const Command& command,
                                const v1::Set& set) {
    if (!wall_.heard()) return settle(command.id(), "refused", "the master does not answer");
    if (command.run() != wall_.run())
        return settle(command.id(),
                      "refused",
                      "the show was started again meanwhile: look, and say it once more");
    if (!isSendable(set)) return settle(command.id(), "refused", "there is nothing of that name");
    pending_[command.id()] = {visitor, holder.name, textOf(set)};
    link_->set(set);
    return settle(command.id(), "waiting", "");
}

// What needs no master, or only asks it.
browser::Done Console::carryOutHere(const Holder& holder,
                                    Visitor* visitor,
                                    const Command& command) {
    std::string refusal;
    switch (command.what_case()) {
        case What::kAcknowledge:
            refusal = acknowledge(holder, command.acknowledge());
            break;
        case What::kRunDoctor:
            runDoctor();
            break;
        case What::kPointAt:
            askFish(visitor, command.point_at());
            break;
        case What::kMind:
            link_->explain(command.mind());
            break;
        default:
            refusal = carryOutOfHall(holder, command);
    }
    if (visitor != nullptr) sendTopics(*visitor);
    return settle(command.id(), refusal.empty() ? "done" : "refused", refusal);
}

// It may have ended by itself meanwhile.
std::string Console::acknowledge(const Holder& holder, const std::string& alert) {
    if (!alerts_.acknowledge(alert)) return "there is no such alert any more";
    note(holder.name, "acknowledged: " + alert);
    return {};
}

// Hours, projectors, and people.
std::string Console::carryOutOfHall(const Holder& holder, const Command& command) {
    switch (command.what_case()) {
        case What::kHoldHours:
            opening_.hold(command.hold_hours(), unixNow());
            note(holder.name,
                 command.hold_hours() > 0 ? "the schedule is held" : "the schedule goes on");
            return {};
        case What::kHoursText:
            return takeHours(holder, command.hours_text());
        case What::kProjector:
            if (!opening_.setProjector(command.projector())) return "there is no such projector";
            note(holder.name, "switched projector " + command.projector().name());
            return {};
        case What::kPower:
            return switchMachine(holder, command.power());
        case What::kNewCode:
            code_ = access_.makeCode(
                static_cast<ConsoleRole>(std::clamp(static_cast<int>(command.new_code()), 1, 3)),
                unixNow());
            note(holder.name, "made a pairing code");
            return {};
        default:
            return sendAway(holder, command.revoke());
    }
}

// The service of the machine ends the show in order.
std::string Console::switchMachine(const Holder& holder, const std::string& word) {
    try {
        machine::sayPower(machine::powerFolder(), word);
    } catch (const Error& problem) {
        return problem.what();
    }
    note(holder.name, "machine: " + word);
    return {};
}

// A mistake is answered with its place in the text.
std::string Console::takeHours(const Holder& holder, const std::string& text) {
    try {
        opening_.setText(text);
    } catch (const Error& problem) {
        return problem.what();
    }
    note(holder.name, "changed the hours");
    return {};
}

// Its session ends, and so do its connections.
std::string Console::sendAway(const Holder& holder, const std::string& person) {
    access_.revoke(person);
    for (Visitor* one : visitors_)
        if (one->holder.id == person) one->outbox->close(kClosedUnpaired);
    note(holder.name, "sent a browser away");
    return {};
}

// Held by the page: a browser that goes takes it along.
browser::Done Console::showScan(const Holder& holder, Visitor* visitor, const Command& command) {
    const browser::ScanCommand& scan = command.scan();
    const auto pattern = scanPatternOf(scan, options_.rig);
    const bool isShown = !scan.kind().empty();
    if (isShown && (!pattern || visitor == nullptr))
        return settle(command.id(), "refused", "there is no such pattern, or no page to hold it");
    v1::Set set;
    set.set_request(command.id());
    set.mutable_scan()->set_holder(holder_);
    if (pattern) wire::writeScanPattern(*pattern, *set.mutable_scan()->mutable_pattern());
    browser::Done done = tellWall(holder, visitor, command, set);
    const bool isHeld = isShown && done.outcome() == "waiting";
    scan_ = isHeld ? ShownScan{visitor, command.id(), set.scan()} : ShownScan{};
    return done;
}

// One at a time, beside the frames; hearCalibrations() says how it ended.
browser::Done Console::useKept(const Holder& holder, Visitor* visitor, const Command& command) {
    const std::string& name = command.use_calibration();
    if (!isVersion(name)) return settle(command.id(), "refused", "there is no such calibration");
    if (calibrationUse_.valid())
        return settle(command.id(), "refused", "another one is being put in place; say it again");
    pending_[command.id()] = {visitor, holder.name, "calibration " + name};
    calibrationUseId_ = command.id();
    calibrationUse_ = std::async(std::launch::async, [rig = options_.master.rig, name] {
        return useCalibration(rig, name);
    });
    return settle(command.id(), "waiting", "");
}

// The answer comes by heardFish(); of too many questions the oldest is lost.
void Console::askFish(Visitor* visitor, const browser::PointAt& at) {
    if (!hub_ || visitor == nullptr || !isPlace(at) || channelIndexOf(at.channel()) < 0) return;
    constexpr std::size_t kMostAsked = 64;
    if (fishAsked_.size() >= kMostAsked) fishAsked_.erase(fishAsked_.begin());
    fishAsked_[++number_] = visitor;
    v1::FishRequest request;
    request.set_number(number_);
    request.set_frame(at.frame());
    request.set_x(at.x());
    request.set_y(at.y());
    hub_->askFish(at.channel(), request);
}

// One at a time, on a thread of its own: it takes seconds.
void Console::runDoctor() {
    if (doctorRun_.valid()) return;
    doctor_.set_running(true);
    doctorRun_ =
        std::async(std::launch::async, [rig = options_.master.rig] { return askDoctor(rig); });
}

}  // namespace aquarama::console
