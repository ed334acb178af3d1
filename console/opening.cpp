// SPDX-License-Identifier: Apache-2.0
#include "console/opening.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/calendar.h"
#include "common/config/text_file.h"

namespace aquarama::console {

namespace {

using nlohmann::json;

// Name in the state folder: what was brought about last.
constexpr const char* kDoneFile = "opening.json";
// How long before the opening lamps go on, and how long the shutters wait for the slowest lamp.
constexpr double kWarmUpSeconds = 180;
// A hold that was forgotten ends within this time.
constexpr double kMostHoldHours = 10;
constexpr double kHourSeconds = 3600;

// Whole or not at all.
void writeText(const std::filesystem::path& path, const std::string& text) {
    writeWhole(path, std::as_bytes(std::span(text)));
}

// "18:00"; of the next day as well, whose midnight is "00:00".
std::string clockOf(int minute) {
    constexpr int kHourMinutes = 60, kDayHours = 24;
    return fmt::format("{:02}:{:02}", minute / kHourMinutes % kDayHours, minute % kHourMinutes);
}

// Whether its lamp is known to be on its way. One that is gone, or does not say so, is not waited
// for.
bool comesOn(const ProjectorFacts& facts) {
    return facts.reach == ProjectorReach::Answers && facts.power != LampPower::On &&
           facts.power != LampPower::Unknown;
}

}  // namespace

// Whatever is wrong with what was kept, the console starts.
Opening::Opening(std::filesystem::path folder,
                 MakeProjector make,
                 std::filesystem::path batteryMark)
    : folder_{std::move(folder)}, make_{std::move(make)}, batteryMark_{std::move(batteryMark)} {
    if (!make_)
        make_ = [](const config::ControlledProjector& one) {
            return std::make_unique<ProjectorWatch>(one);
        };
    readHours();
    readDone();
    watchProjectors();
}

// The text is kept as it is, so that it can be mended on the page.
void Opening::readHours() {
    const std::filesystem::path path = folder_ / config::kHoursFile;
    try {
        if (!std::filesystem::exists(path)) return;
        text_ = config::readTextFile(path.string());
        hours_ = config::parseHours(text_, config::kHoursFile, &form_);
    } catch (const std::exception& problem) {
        problem_ = problem.what();
        logWarning("{} (in {}); there are no hours, and nothing is switched, until that is mended",
                   problem_,
                   folder_.string());
    }
}

// Without it the hours are brought about anew, which changes nothing where they were.
void Opening::readDone() {
    const std::filesystem::path path = folder_ / kDoneFile;
    try {
        if (!std::filesystem::exists(path)) return;
        const json kept = json::parse(config::readTextFile(path.string()));
        heldUntil_ = kept.at("held_until").get<double>();
        isDayToEnd_ = kept.value("day_to_end", false);
        if (kept.contains("open"))
            done_ = {kept.at("open").get<bool>(),
                     kept.at("scene").get<std::string>(),
                     kept.at("quality").get<std::string>()};
        doneAt_ = kept.value("done_at", 0.0);
        findNextChange();
    } catch (const std::exception& problem) {
        logWarning("{}: {}; the wall is brought to its hours anew", path.string(), problem.what());
    }
}

// Anew, when the hours are: addresses may be others.
void Opening::watchProjectors() {
    projectors_.clear();
    power_.reset();
    shut_.reset();
    watchedSince_ = 0;
    if (!hours_) return;
    for (const config::ControlledProjector& one : hours_->projectors)
        projectors_.push_back(make_(one));
}

// After each change, so that nothing is done twice after a start.
void Opening::keep() const {
    json kept{{"held_until", heldUntil_}, {"day_to_end", isDayToEnd_}};
    if (done_) {
        kept["open"] = done_->isOpen;
        kept["scene"] = done_->scene;
        kept["quality"] = done_->quality;
        kept["done_at"] = doneAt_;
    }
    const std::string text = kept.dump();
    keepIfPossible(folder_ / kDoneFile,
                   std::as_bytes(std::span(text)),
                   "after a start of the console the hours bring about again what they did");
}

// First read, then kept: a mistake changes nothing.
void Opening::setText(const std::string& text) {
    std::optional<config::Hours> hours;
    v1::Hours form;
    if (!text.empty()) hours = config::parseHours(text, config::kHoursFile, &form);
    writeText(folder_ / config::kHoursFile, text);
    if (text.empty()) std::filesystem::remove(folder_ / config::kHoursFile);
    text_ = text;
    problem_.clear();
    hours_ = std::move(hours);
    form_ = std::move(form);
    findNextChange();
    watchProjectors();
}

// An empty text would end the hours; an empty form is a mistake.
void Opening::setForm(const v1::Hours& form) {
    const std::string text = config::textOf(form);
    setText(text.empty() ? "\n" : text);
}

// Ends by itself: somebody forgets it.
void Opening::hold(double forHours, UnixSeconds now) {
    const double hours = std::clamp(forHours, 0.0, kMostHoldHours);
    heldUntil_ = hours > 0 ? now + hours * kHourSeconds : 0;
    keep();
}

// 0 where it is not held.
UnixSeconds Opening::heldUntil(UnixSeconds now) const {
    return heldUntil_ > now ? heldUntil_ : 0;
}

// By the clock of the rig's zone.
config::WantedHours Opening::wantedIn(UnixSeconds now) const {
    return config::wantedAt(*hours_, static_cast<long long>(now));
}

// What cannot be asked is no battery.
bool Opening::isOnBattery() const {
    std::error_code none;
    return !batteryMark_.empty() && std::filesystem::exists(batteryMark_, none);
}

// Of what was brought about; looked for once, as it may be days away.
void Opening::findNextChange() {
    constexpr int kDaysAhead = 8;  // of weekly hours
    holdsUntil_ = 0;
    if (!hours_ || doneAt_ == 0) return;
    const auto change = config::changeAfter(*hours_, static_cast<long long>(doneAt_), kDaysAhead);
    if (change) holdsUntil_ = static_cast<UnixSeconds>(change->at);
}

// What was brought about last is compared, not what the wall shows: an operator may have set that.
// That ends with the next change of the hours, also where this program did not run then: after a
// night without power the wall opens anew.
std::optional<config::WantedHours> Opening::due(UnixSeconds now) const {
    if (!hours_ || heldUntil(now) > 0) return std::nullopt;
    const config::WantedHours wanted = wantedIn(now);
    const bool holds = done_ == wanted && (holdsUntil_ == 0 || now < holdsUntil_);
    if (holds || (wanted.isOpen && isOnBattery())) return std::nullopt;
    return wanted;
}

// Written to the disk at once, so that a restart of the console repeats nothing.
void Opening::done(const config::WantedHours& wanted, UnixSeconds now) {
    const bool isClosing = done_ && done_->isOpen && !wanted.isOpen;
    if (isClosing && !opensAgainSoon(now)) isDayToEnd_ = true;
    done_ = wanted;
    doneAt_ = now;
    findNextChange();
    keep();
}

void Opening::dayEnded() {
    isDayToEnd_ = false;
    keep();
}

// A pause at noon ends no day.
bool Opening::opensAgainSoon(UnixSeconds now) const {
    constexpr int kMinutes = 240, kMinuteSeconds = 60;
    for (int minute = 1; hours_ && minute <= kMinutes; ++minute)
        if (wantedIn(now + minute * kMinuteSeconds).isOpen) return true;
    return false;
}

// Not closed while the schedule is held.
bool Opening::isClosed(UnixSeconds now) const {
    return hours_ && heldUntil(now) == 0 && (!wantedIn(now).isOpen || isOnBattery());
}

// On three minutes before the wall opens, and off once the wall has been made black, or on battery.
bool Opening::isLampWanted(UnixSeconds now) const {
    if (isOnBattery()) return false;
    const bool isBlack = done_ && !done_->isOpen;
    return !isBlack || wantedIn(now).isOpen || wantedIn(now + kWarmUpSeconds).isOpen;
}

// When the console was started again, or its hours were changed, while the wall is open.
bool Opening::isOpenAlready() const {
    if (shut_ || !done_ || !done_->isOpen) return false;
    return std::ranges::any_of(projectors_, [](const auto& one) {
        const ProjectorFacts facts = one->facts();
        return facts.power == LampPower::On && facts.isShut == false;
    });
}

// Before all have been asked for the first time nobody knows what shutters should do.
bool Opening::isFirstLook(UnixSeconds now) const {
    constexpr double kLongest = 30;
    if (shut_ || now - watchedSince_ > kLongest) return false;
    return std::ranges::any_of(projectors_, [](const auto& one) {
        return one->facts().reach == ProjectorReach::NotAsked;
    });
}

// All together, when the wall is in step and no lamp still comes on: lamps have three minutes since
// they were told to, which is before the opening; nodes have three after it. Once open, they stay.
bool Opening::mayOpenShutters(UnixSeconds now, bool isWallInStep) const {
    if (openSince_ == 0) return false;
    if (shut_ == false || isOpenAlready()) return true;
    if (!isWallInStep && now - openSince_ <= kWarmUpSeconds) return false;
    return now - litSince_ >= kWarmUpSeconds ||
           std::ranges::none_of(projectors_, [](const auto& one) { return comesOn(one->facts()); });
}

// Whoever works on them does not have them switched on meanwhile; then all is said anew.
void Opening::rest() {
    if (!power_ && !shut_) return;
    power_.reset();
    shut_.reset();
    for (const auto& one : projectors_) one->release();
}

// Since when the wall should be open, its lamps be on, and its projectors are looked at.
void Opening::noteOpening(UnixSeconds now) {
    if (watchedSince_ == 0) watchedSince_ = now;
    const bool isOpen = wantedIn(now).isOpen && !isOnBattery();
    if (!isOpen) openSince_ = 0;
    if (isOpen && openSince_ == 0) openSince_ = now;
    if (isLampWanted(now) && power_ != true) litSince_ = now;
}

// Said when it changes: what somebody sets on the page between holds.
void Opening::tellProjectors(bool power, std::optional<bool> shut) {
    if (power_ == power && shut_ == shut) return;
    power_ = power;
    shut_ = shut;
    for (const auto& one : projectors_) one->want(power, shut);
}

// Each second. Before the first look at all of them their shutters are left as they are.
void Opening::switchProjectors(UnixSeconds now, bool isWallInStep) {
    if (!hours_ || projectors_.empty()) return;
    if (heldUntil(now) > 0) return rest();
    noteOpening(now);
    std::optional<bool> shut = shut_;
    if (!isFirstLook(now)) shut = !mayOpenShutters(now, isWallInStep);
    tellProjectors(isLampWanted(now), shut);
}

// Until the hours want something else of it.
bool Opening::setProjector(const browser::ProjectorCommand& command) {
    bool isThere = false;
    for (std::size_t i = 0; i < projectors_.size(); ++i) {
        if (!command.name().empty() && hours_->projectors[i].name != command.name()) continue;
        isThere = true;
        projectors_[i]->want(command.has_power() ? std::optional(command.power()) : std::nullopt,
                             command.has_shut() ? std::optional(command.shut()) : std::nullopt);
    }
    return isThere;
}

// Minute by minute, as far as people look ahead.
browser::Hours Opening::hours(UnixSeconds now) const {
    constexpr int kMinutes = 60, kMinuteSeconds = 60;
    browser::Hours message;
    message.set_text(text_);
    message.set_problem(problem_);
    message.set_present(hours_.has_value());
    message.set_next("stays");
    if (!hours_) return message;
    *message.mutable_form() = form_;
    const config::WantedHours wanted = wantedIn(now);
    message.set_open(wanted.isOpen);
    message.set_scene(wanted.scene);
    message.set_quality(wanted.quality);
    for (int minute = 1; minute <= kMinutes; ++minute) {
        const UnixSeconds then = now - std::fmod(now, kMinuteSeconds) + minute * kMinuteSeconds;
        const config::WantedHours next = wantedIn(then);
        if (next == wanted) continue;
        message.set_next(!next.isOpen ? "closes" : wanted.isOpen ? "changes" : "opens");
        message.set_next_scene(next.scene);
        message.set_next_at(
            clockOf(config::civilTime(hours_->zone, static_cast<long long>(then)).minute));
        break;
    }
    return message;
}

// As they last answered; what is not known is left out.
browser::ProjectorList Opening::projectors() const {
    browser::ProjectorList list;
    for (std::size_t i = 0; i < projectors_.size(); ++i) {
        const ProjectorFacts facts = projectors_[i]->facts();
        browser::ProjectorState& state = *list.add_projectors();
        state.set_name(hours_->projectors[i].name);
        state.set_wanted_input(hours_->projectors[i].input);
        state.set_reach(nameOf(facts.reach));
        state.set_power(nameOf(facts.power));
        if (facts.isShut) state.set_shut(*facts.isShut);
        if (facts.lampHours) state.set_lamp_hours(*facts.lampHours);
        if (facts.wantedPower) state.set_wanted_power(*facts.wantedPower);
        state.set_input(facts.input.value_or("unknown"));
        state.set_tells_problems(facts.areProblemsKnown);
        for (const std::string& problem : facts.problems) state.add_problems(problem);
    }
    return list;
}

}  // namespace aquarama::console
