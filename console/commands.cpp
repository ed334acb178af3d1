// SPDX-License-Identifier: Apache-2.0
// The commands of the console: who may give which, and how each is carried out. All of it on the
// server's thread.
#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "console/console.h"

namespace aquarama::console {

namespace {

using What = browser::Command::WhatCase;

// What somebody must be for a command; empty for what is none.
std::optional<ConsoleRole> roleFor(What what) {
    switch (what) {
        case What::kRunDoctor:
        case What::kPointAt:
        case What::kMind:
            return ConsoleRole::Watcher;
        case What::kBlack:
        case What::kFreeze:
        case What::kScene:
        case What::kQuality:
        case What::kPattern:
        case What::kRestart:
        case What::kAcknowledge:
        case What::kHoldHours:
            return ConsoleRole::Operator;
        case What::kHoursText:
        case What::kNewCode:
        case What::kRevoke:
        case What::kProjector:
            return ConsoleRole::Crew;
        case What::WHAT_NOT_SET:
            break;
    }
    return std::nullopt;
}

// For the list of events.
std::string onOff(bool on) {
    return on ? "on" : "off";
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
    return "pattern " + std::string(wire::nameOf(static_cast<wire::Pattern>(set.pattern())));
}

// A name that the master takes: a packet of ours is never malformed there.
bool isName(const std::string& text) {
    return !text.empty() && text.size() <= wire::kMostNameBytes &&
           std::ranges::all_of(
               text, [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7F; });
}

// Of one value, as setOf() makes it.
bool isSendable(const v1::Set& set) {
    if (set.has_scene()) return isName(set.scene());
    if (set.has_quality()) return isName(set.quality());
    if (set.has_restart()) return isName(set.restart());
    return set.pattern() != v1::PATTERN_SCAN;
}

// A place of a picture, as shares of its size. A number that is none is no place.
bool isPlace(const browser::PointAt& at) {
    const auto isShare = [](float number) { return number >= 0 && number <= 1; };
    return isShare(at.x()) && isShare(at.y());
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
    return setOf(command) ? tellWall(holder, visitor, command)
                          : carryOutHere(holder, visitor, command);
}

// The master answers later; saidOfSet() passes that on.
browser::Done Console::tellWall(const Holder& holder, Visitor* visitor, const Command& command) {
    const v1::Set set = *setOf(command);
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
