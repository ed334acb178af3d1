// SPDX-License-Identifier: Apache-2.0
#include "console/commands.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/ask/request_client.h"
#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/config/rules.h"
#include "common/config/text_file.h"
#include "common/machine/machine_power.h"
#include "common/wire/wanted_show.h"

namespace aquarama::console {

namespace {

using ask::Answer;
using ask::Outcome;
using ask::refused;
using What = browser::Command::WhatCase;

// What somebody must be for a command; empty for what is none.
std::optional<ConsoleRole> roleFor(const browser::Command& command) {
    static const std::map<What, ConsoleRole> kRoles{{What::kRunDoctor, ConsoleRole::Watcher},
                                                    {What::kPointAt, ConsoleRole::Watcher},
                                                    {What::kMind, ConsoleRole::Watcher},
                                                    {What::kAcknowledge, ConsoleRole::Operator},
                                                    {What::kHoldHours, ConsoleRole::Operator},
                                                    {What::kScan, ConsoleRole::Operator},
                                                    {What::kPicture, ConsoleRole::Operator},
                                                    {What::kHoursText, ConsoleRole::Crew},
                                                    {What::kHours, ConsoleRole::Crew},
                                                    {What::kNewCode, ConsoleRole::Crew},
                                                    {What::kRevoke, ConsoleRole::Crew},
                                                    {What::kProjector, ConsoleRole::Crew},
                                                    {What::kUseCalibration, ConsoleRole::Crew},
                                                    {What::kPower, ConsoleRole::Crew},
                                                    {What::kAssign, ConsoleRole::Crew},
                                                    {What::kRelease, ConsoleRole::Crew},
                                                    {What::kConfirmStep, ConsoleRole::Crew},
                                                    {What::kOrder, ConsoleRole::Operator}};
    const auto role = kRoles.find(command.what_case());
    if (command.order().has_power()) return ConsoleRole::Crew;
    return role == kRoles.end() ? std::nullopt : std::optional(role->second);
}

// "drawing 12 let in"
std::string textOf(const v1::Moderation& moderation) {
    static const std::map<v1::Moderation::Verdict, std::string> kVerdicts{
        {v1::Moderation::LET_IN, "let in"},
        {v1::Moderation::TAKE_DOWN, "taken down"},
        {v1::Moderation::KEEP, "kept past the day"},
        {v1::Moderation::KEEP_NO_MORE, "kept no more"}};
    if (moderation.verdict() == v1::Moderation::END_DAY) return "the day of drawings ended";
    const auto verdict = kVerdicts.find(moderation.verdict());
    const std::string which = moderation.number() == 0
                                  ? "all drawings "
                                  : "drawing " + std::to_string(moderation.number()) + " ";
    return which + (verdict == kVerdicts.end() ? "decided" : verdict->second);
}

std::string textOf(const v1::Power& power) {
    const bool isOff = power.word() == v1::Power::POWEROFF;
    return (isOff ? "poweroff of the machine of " : "reboot of the machine of ") + power.channel();
}

// What was asked for, as the list of events has it.
std::string textOf(const v1::Order& order) {
    switch (order.order_case()) {
        case v1::Order::kRestart:
            return "restart node " + order.restart().channel();
        case v1::Order::kPower:
            return textOf(order.power());
        case v1::Order::kScan:
            return order.scan().has_pattern() ? "a pattern of a scan" : "no pattern of a scan";
        case v1::Order::kDrawing:
            return "a drawing of a " + order.drawing().species();
        case v1::Order::kModeration:
            return textOf(order.moderation());
        case v1::Order::kRelease:
            return "release of a " + order.release().species();
        default:
            return wire::textOf(order.show());
    }
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

// Ends the day of visitors' drawings.
v1::Order orderOfDayEnd() {
    v1::Order order;
    order.set_request(ask::freshRequest());
    order.mutable_moderation()->set_verdict(v1::Moderation::END_DAY);
    return order;
}

// Why a picture shows no drawing, in a line; of a word that is new, the word.
std::string lineOf(const ask::DrawingRefused& refusal) {
    static const std::map<std::string, std::string> kLines{
        {"too_large", "the picture is too large: at most 16 MB and 50 megapixels"},
        {"not_a_picture", "this is no JPEG, PNG or WebP that can be read"},
        {"no_sheet", "no sheet is in the picture"},
        {"several_sheets", "more than one sheet is in the picture"},
        {"too_few_corners", "too few corners of the sheet are seen"},
        {"other_version", "the sheet is of another version"},
        {"unknown_species", "the fish of this sheet does not live here"},
        {"not_flat", "the sheet is bent"},
        {"cut_off", "a part of the fish is cut off"},
        {"too_small", "the sheet is too small in the picture"},
        {"too_dark", "the picture is too dark"},
        {"unreadable", "the picture cannot be read"}};
    const auto line = kLines.find(refusal.word);
    return line == kLines.end() ? refusal.word : line->second;
}

// Why no picture of a sheet is taken now; empty where one is.
std::string objectionToPicture(const browser::Wall& wall, std::size_t drawings) {
    if (!wall.heard()) return "the master does not answer";
    if (!wall.status().has_drawings_version()) return "the rig has no drawings";
    if (!wall.status().drawings()) return "drawings are off; switch them on";
    if (drawings >= std::size_t{wire::kMostDrawings})
        return "no room for more drawings; take some down";
    return {};
}

browser::ToBrowser mistakesOf(std::uint64_t request, const config::FileError& error) {
    browser::ToBrowser message;
    message.mutable_mistakes()->set_request(request);
    for (const config::FileMistake& from : error.mistakes) {
        browser::Mistake& mistake = *message.mutable_mistakes()->add_mistakes();
        mistake.set_field(from.field);
        mistake.set_what(from.why);
    }
    return message;
}

v1::OrderReply replyOf(std::uint64_t request, const Answer& answer) {
    v1::OrderReply reply;
    reply.set_request(request);
    reply.set_outcome(static_cast<v1::OrderReply::Outcome>(answer.outcome));
    reply.set_reason(answer.reason);
    return reply;
}

}  // namespace

std::string titleOfPicture(const std::string& fileName) {
    constexpr std::size_t kMostNameBytes = 88;
    std::string name = fileName.empty() ? "a sheet" : legible(fileName, kMostNameBytes);
    std::ranges::replace_if(
        name, [](unsigned char letter) { return letter < ' '; }, ' ');
    return "picture of " + name;
}

// The only way to any command, whoever gives it and how: roles are held to here.
v1::OrderReply Commands::carryOut(const Holder& holder, Visitor* visitor, const Command& command) {
    const std::uint64_t id = command.id();
    if (const Answer* known = book_.find(id)) return replyOf(id, *known);
    const auto needed = roleFor(command);
    if (!needed || id == 0) {
        ++state_.refused;
        return replyOf(id, refused("this is no command of this console"));
    }
    if (holder.role < *needed) {
        ++state_.refused;
        const std::string role(nameOf(*needed));
        visitors_.note(holder.name, "refused: it needs " + role);
        return replyOf(id, book_.enter(id, refused("only " + role + " may do this")));
    }
    return replyOf(id, book_.enter(id, carryOutAllowed(holder, visitor, command)));
}

// By where it goes.
Answer Commands::carryOutAllowed(const Holder& holder, Visitor* visitor, const Command& command) {
    switch (command.what_case()) {
        case What::kScan:
            return showScan(holder, visitor, command);
        case What::kUseCalibration:
            return useKept(holder, visitor, command);
        case What::kAssign:
            return assignNode(holder, visitor, command);
        case What::kRelease:
            return changeRelease(holder, visitor, command);
        case What::kConfirmStep:
            return confirmStep(holder, visitor, command);
        case What::kPicture:
            return readPicture(holder, visitor, command);
        case What::kOrder:
            return passOn(holder, visitor, command);
        default:
            break;
    }
    const std::string refusal = carryOutHere(holder, visitor, command);
    if (visitor != nullptr) visitors_.sendTopics(*visitor);
    return refusal.empty() ? Answer{} : refused(refusal);
}

Answer Commands::passOn(const Holder& holder, Visitor* visitor, const Command& command) {
    v1::Order order = command.order();
    order.set_request(command.id());
    order.set_run(command.run());
    const bool isWhole = order.order_case() != v1::Order::ORDER_NOT_SET && !order.has_scan();
    if (!isWhole || !config::keepsRules(order)) return refused("there is nothing of that name");
    return tellWall(holder, visitor, order);
}

// The master answers later; said() passes that on.
Answer Commands::tellWall(const Holder& holder, Visitor* visitor, const v1::Order& order) {
    if (!state_.wall.heard()) return refused("the master does not answer");
    if (order.run() != state_.wall.run())
        return refused("the show was started again meanwhile: look, and say it once more");
    const bool isQuiet = visitor == nullptr && order.has_show() && wire::isOfFader(order.show());
    waiting_[order.request()] = {visitor, holder.name, textOf(order), isQuiet};
    master_->give(order);
    return {Outcome::Waiting, ""};
}

// Whoever asked may have gone; the event is noted all the same.
void Commands::said(std::uint64_t request, const Answer& answer) {
    const bool isEnded = answer.outcome != Outcome::Waiting;
    if (isEnded && saidOfOwn(request, answer)) return;
    const auto waiting = waiting_.find(request);
    if (waiting == waiting_.end()) return;
    if (const Answer* before = book_.find(request); !isEnded && before && *before == answer) return;
    tell(waiting->second, request, book_.enter(request, answer));
    if (!isEnded) return;
    noteEnd(waiting->second, answer);
    waiting_.erase(waiting);
}

// A scan that is not shown is not said again.
bool Commands::saidOfOwn(std::uint64_t request, const Answer& answer) {
    if (request == scan_.request && answer.outcome != Outcome::Done) scan_ = {};
    const bool isOfHours = opened_ && request == opened_->request;
    const bool isOfDay = request == dayEnd_;
    if (isOfHours) saidOfHours(answer);
    if (isOfDay) saidOfDay(answer);
    return isOfHours || isOfDay;
}

void Commands::tell(const Waiting& who, std::uint64_t request, const Answer& answer) {
    browser::ToBrowser message;
    *message.mutable_done() = replyOf(request, answer);
    const std::string topic = fmt::format("done {}", request);
    if (who.visitor != nullptr) visitors_.sendTo(*who.visitor, topic, message);
    if (!who.person.empty()) visitors_.sendToPerson(who.person, topic, message);
}

void Commands::noteEnd(const Waiting& of, const Answer& answer) {
    const bool isDone = answer.outcome == Outcome::Done;
    if (isDone && of.isQuiet) return;
    const std::string found = answer.reason.empty() ? "" : ": " + answer.reason;
    visitors_.note(of.who, of.what + (isDone ? "" : ", refused") + found);
}

// What is refused now is refused in a second as well: that is told once. An order that did not
// arrive is sent again.
void Commands::saidOfHours(const Answer& answer) {
    const config::WantedHours wanted = std::exchange(opened_, {})->wanted;
    if (answer.outcome == Outcome::Lost) return;
    state_.opening.done(wanted, unixNow());
    visitors_.note("schedule",
                   (wanted.isOpen ? "opened " + wanted.scene : std::string("closed")) +
                       (answer.outcome == Outcome::Done ? "" : ", refused: " + answer.reason));
}

// By a clock that is wrong the wall stays as it is.
void Commands::keepHours() {
    if (!state_.doubtOfClock.empty()) return;
    state_.opening.switchProjectors(unixNow(), isInStep(state_.wall));
    const auto due = state_.opening.due(unixNow());
    if (!due || opened_ || !state_.wall.heard()) return;
    const v1::Order order = orderOfHours(*due);
    opened_ = {order.request(), *due};
    master_->give(order);
}

// Said until it is answered; where there are no drawings there is no day to end.
void Commands::keepDay() {
    if (!state_.opening.isDayToEnd() || dayEnd_ != 0 || !state_.wall.heard()) return;
    if (!state_.wall.status().has_drawings_version()) return state_.opening.dayEnded();
    const v1::Order order = orderOfDayEnd();
    dayEnd_ = order.request();
    master_->give(order);
}

void Commands::saidOfDay(const Answer& answer) {
    dayEnd_ = 0;
    if (answer.outcome == Outcome::Lost) return;
    state_.opening.dayEnded();
    visitors_.note("schedule",
                   answer.outcome == Outcome::Done
                       ? "the drawings of the day are taken down, but for those that are kept"
                       : "the drawings of the day stay: " + answer.reason);
}

// The master ends it by itself three seconds after the last word.
void Commands::keepScan() {
    if (scan_.visitor == nullptr) return;
    if (scan_.visitor->ticksToLook > 0 && scan_.visitor->wants("calibrations"))
        return master_->give(orderOf(scan_.held));
    scan_.visitor->holdsScan = false;  // the page was left
    scan_ = {};
}

void Commands::forget(const Visitor& visitor) {
    for (auto& [request, waiting] : waiting_)
        if (waiting.visitor == &visitor) waiting.visitor = nullptr;
    if (scan_.visitor == &visitor) scan_ = {};
}

// What needs no master, or only asks it.
std::string Commands::carryOutHere(const Holder& holder, Visitor* visitor, const Command& command) {
    switch (command.what_case()) {
        case What::kAcknowledge:
            return acknowledge(holder, command.acknowledge());
        case What::kRunDoctor:
            errands_.runDoctor();
            return {};
        case What::kPointAt:
            if (visitor != nullptr) visitors_.askFish(*visitor, command.point_at());
            return {};
        case What::kMind:
            master_->explain(command.mind());
            return {};
        case What::kHoursText:
        case What::kHours:
            return takeHours(holder, visitor, command);
        default:
            return carryOutOfHall(holder, command);
    }
}

// It may have ended by itself meanwhile.
std::string Commands::acknowledge(const Holder& holder, const std::string& alert) {
    if (!state_.alerts.acknowledge(alert)) return "there is no such alert any more";
    visitors_.note(holder.name, "acknowledged: " + alert);
    return {};
}

// Projectors, machines, people, and whether the hours hold.
std::string Commands::carryOutOfHall(const Holder& holder, const Command& command) {
    switch (command.what_case()) {
        case What::kHoldHours:
            state_.opening.hold(command.hold_hours(), unixNow());
            visitors_.note(
                holder.name,
                command.hold_hours() > 0 ? "the schedule is held" : "the schedule goes on");
            return {};
        case What::kProjector:
            if (!state_.opening.setProjector(command.projector()))
                return "there is no such projector";
            visitors_.note(holder.name, "switched projector " + command.projector().name());
            return {};
        case What::kPower:
            return switchMachine(holder, command.power());
        case What::kNewCode:
            state_.code = state_.access.makeCode(
                static_cast<ConsoleRole>(std::clamp(static_cast<int>(command.new_code()), 1, 3)),
                unixNow());
            visitors_.note(holder.name, "made a pairing code");
            return {};
        default:
            return sendAway(holder, command.revoke());
    }
}

// The service of the machine ends the show in order.
std::string Commands::switchMachine(const Holder& holder, const std::string& word) {
    try {
        machine::sayPower(machine::powerFolder(), word);
    } catch (const Error& problem) {
        return problem.what();
    }
    visitors_.note(holder.name, "machine: " + word);
    return {};
}

// A page is told all mistakes by field. The reply has the first: of a form by its field, of a text
// by its place.
std::string Commands::takeHours(const Holder& holder, Visitor* visitor, const Command& command) {
    try {
        command.has_hours() ? state_.opening.setForm(command.hours())
                            : state_.opening.setText(command.hours_text());
    } catch (const config::FileError& error) {
        if (visitor != nullptr)
            visitors_.sendTo(*visitor, "mistakes", mistakesOf(command.id(), error));
        const config::FileMistake& first = error.mistakes.front();
        return command.has_hours() ? first.field + ": " + first.why : error.what();
    } catch (const Error& problem) {
        return problem.what();
    }
    visitors_.note(holder.name, "changed the hours");
    return {};
}

// Its session ends, and so do its connections.
std::string Commands::sendAway(const Holder& holder, const std::string& person) {
    state_.access.revoke(person);
    visitors_.sendAway(person);
    visitors_.note(holder.name, "sent a browser away");
    return {};
}

// Held by the page: a browser that goes takes it along.
Answer Commands::showScan(const Holder& holder, Visitor* visitor, const Command& command) {
    const browser::ScanCommand& scan = command.scan();
    const auto pattern = scanPatternOf(scan, state_.rig);
    const bool isShown = !scan.kind().empty();
    if (isShown && (!pattern || visitor == nullptr))
        return refused("there is no such pattern, or no page to hold it");
    v1::Order order;
    order.set_request(command.id());
    order.set_run(command.run());
    order.mutable_scan()->set_holder(holder_);
    if (pattern) wire::writeScanPattern(*pattern, *order.mutable_scan()->mutable_pattern());
    Answer answer = tellWall(holder, visitor, order);
    if (scan_.visitor != nullptr) scan_.visitor->holdsScan = false;
    scan_ = {};
    if (isShown && answer.outcome == Outcome::Waiting) {
        scan_ = {visitor, command.id(), order.scan()};
        visitor->holdsScan = true;
    }
    return answer;
}

// What is said of it meanwhile comes by said(): first of the picture, then of its drawing.
Answer Commands::readPicture(const Holder& holder, Visitor* visitor, const Command& command) {
    const browser::SheetPicture& picture = command.picture();
    if (!read_) return refused("no pictures are read here: aquarama-drawings is not installed");
    const std::string why = objectionToPicture(state_.wall, state_.drawings.size());
    if (!why.empty()) return refused(why);
    const auto done = [this, id = command.id(), aside = picture.aside()](
                          const ask::DrawingOutcome& outcome) { offer(id, aside, outcome); };
    if (!read_(picture.picture(), done))
        return refused("too many pictures wait to be read; send it once more in a while");
    waiting_[command.id()] = {visitor,
                              holder.name,
                              titleOfPicture(picture.name()),
                              false,
                              visitor == nullptr ? holder.id : ""};
    return {Outcome::Waiting, "the picture is read"};
}

void Commands::offer(std::uint64_t id, int aside, const ask::DrawingOutcome& outcome) {
    if (const auto* refusal = std::get_if<ask::DrawingRefused>(&outcome))
        return said(id, refused(lineOf(*refusal)));
    const auto& read = std::get<ask::ReadDrawing>(outcome);
    v1::Order order;
    order.set_request(id);
    order.mutable_drawing()->set_skin(read.skin);
    order.mutable_drawing()->set_species(read.species);
    order.mutable_drawing()->set_aside(std::clamp(aside, -1, 1));
    if (!config::keepsRules(order)) return said(id, refused("the drawing is too large"));
    if (!state_.wall.heard()) return said(id, {Outcome::Lost, "the master does not answer"});
    master_->give(order);
}

Answer Commands::awaitErrand(bool isBegun,
                             const Holder& holder,
                             Visitor* visitor,
                             const Command& command,
                             const std::string& what) {
    if (!isBegun) return refused("something else is under way; say it again");
    waiting_[command.id()] = {visitor, holder.name, what};
    return {Outcome::Waiting, ""};
}

Answer Commands::useKept(const Holder& holder, Visitor* visitor, const Command& command) {
    const std::string& name = command.use_calibration();
    if (!isVersion(name)) return refused("there is no such calibration");
    return awaitErrand(
        errands_.use(name, command.id()), holder, visitor, command, "calibration " + name);
}

Answer Commands::assignNode(const Holder& holder, Visitor* visitor, const Command& command) {
    const browser::AssignCommand& wanted = command.assign();
    const auto node = std::ranges::find(state_.waiting, wanted.letter(), &enrol::FoundNode::letter);
    const auto channel =
        std::ranges::find(state_.rig.channels, wanted.channel(), &config::Channel::name);
    if (node == state_.waiting.end()) return refused("no node of this letter waits any more");
    if (channel == state_.rig.channels.end()) return refused("there is no such channel");
    const Assignment assignment{.rigFile = state_.rigFile,
                                .keyFolder = state_.keyFolder,
                                .node = *node,
                                .channel = channel->name,
                                .code = wanted.code(),
                                .built = state_.built};
    return awaitErrand(errands_.assign(assignment, command.id()),
                       holder,
                       visitor,
                       command,
                       "node " + node->letter + " gets the channel " + channel->name);
}

Answer Commands::changeRelease(const Holder& holder, Visitor* visitor, const Command& command) {
    const std::string& word = command.release();
    if (!isReleaseWord(word)) return refused("releases know \"go\" and \"back\" only");
    return awaitErrand(
        errands_.change(word, command.id()), holder, visitor, command, "release: " + word);
}

// Only what was found: a page shows no other.
Answer Commands::confirmStep(const Holder& holder, Visitor* visitor, const Command& command) {
    const browser::ConfirmStep& step = command.confirm_step();
    const browser::Tour tour = state_.tour.value_or(browser::Tour{});
    const bool isFound = std::ranges::any_of(tour.steps(), [&](const browser::TourStep& known) {
        return known.name() == step.name() && known.found() == step.found();
    });
    if (!isFound) return refused("the tour has found something else by now: look again");
    return awaitErrand(errands_.confirm(step, command.id()),
                       holder,
                       visitor,
                       command,
                       "tour: " + step.name() + " is right");
}

}  // namespace aquarama::console
