// SPDX-License-Identifier: Apache-2.0
// What browsers are sent: what each page shows, and no more. All of it on the server's thread.
#include <algorithm>
#include <array>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/machine/machine_power.h"
#include "console/console.h"

namespace aquarama::console {

// One of the topics of its look.
bool Console::Visitor::wants(const char* topic) const {
    const auto& topics = look.topics();
    return std::ranges::find(topics, topic) != topics.end();
}

// What the console itself knows is added to what the master has said.
void Console::sendWall() {
    wall_.set_now_s(unixNow());
    wall_.set_held_until_s(opening_.heldUntil(unixNow()));
    wall_.set_watching(static_cast<std::uint32_t>(visitors_.size()));
    wall_.set_refused_requests(refused_ + server_->cutOff());
    browser::ToBrowser message;
    *message.mutable_wall() = wall_;
    sendToAll("wall", message);
}

// A page gets what it shows, and no other page does.
void Console::sendTopics(Visitor& visitor) {
    using Send = void (Console::*)(Visitor&);
    static constexpr std::array<std::pair<const char*, Send>, 7> kTopics{
        {{"log", &Console::sendLog},
         {"panorama", &Console::sendPanorama},
         {"calibrations", &Console::sendCalibrations},
         {"doctor", &Console::sendDoctor},
         {"history", &Console::sendWholeHistory},
         {"hours", &Console::sendHours},
         {"people", &Console::sendPeople}}};
    if (!visitor.wants("history")) visitor.hasHistory = false;
    for (const auto& [topic, send] : kTopics)
        if (visitor.wants(topic)) (this->*send)(visitor);
}

// What it found last, also while it runs once more.
void Console::sendDoctor(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_doctor() = doctor_;
    sendTo(visitor, "doctor", message);
}

// Once; then tendVisitors() sends what is newer.
void Console::sendWholeHistory(Visitor& visitor) {
    if (!std::exchange(visitor.hasHistory, true)) sendHistory(visitor, true);
}

// Where it has changed.
void Console::sendLog(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_log() = tailOf(logOf(options_.master.rig), visitor.look);
    std::string text = jsonOf(message);
    if (text != visitor.sentLog)
        visitor.outbox->put("log", std::make_shared<const std::string>(text), false);
    visitor.sentLog = std::move(text);
}

// All of it under a topic of its own: what is newer does not replace it while it waits.
void Console::sendHistory(Visitor& visitor, bool isAll) {
    browser::ToBrowser message;
    *message.mutable_history() = isAll ? figures_.history() : figures_.lastSecond();
    sendTo(visitor, isAll ? "history" : "history of a second", message);
}

// With the projectors, which have hours too.
void Console::sendHours(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_hours() = hoursFor(visitor);
    sendTo(visitor, "hours", message);
    *message.mutable_projectors() = opening_.projectors();
    sendTo(visitor, "projectors", message);
}

// Read again every five seconds while somebody looks: there may be thirty large files.
void Console::sendCalibrations(Visitor& visitor) {
    constexpr int kTicksBetween = 5 * kTicksASecond;
    const bool isDue = !calibrations_ || ticks_ >= calibrationsDue_;
    if (isDue && !calibrationsRead_.valid()) {
        calibrationsDue_ = ticks_ + kTicksBetween;
        calibrationsRead_ = std::async(std::launch::async,
                                       [rig = options_.master.rig] { return calibrationsOf(rig); });
    }
    if (!calibrations_) return;
    browser::ToBrowser message;
    *message.mutable_calibrations() = *calibrations_;
    message.mutable_calibrations()->set_held_scan(scan_.visitor == &visitor);
    sendTo(visitor, "calibrations", message);
}

// Once, and again when it is another.
void Console::sendPanorama(Visitor& visitor) {
    if (panorama_.panorama().meshes().empty() || std::exchange(visitor.hasPanorama, true)) return;
    browser::ToBrowser message;
    *message.mutable_panorama() = panorama_.panorama();
    sendTo(visitor, "panorama", message);
}

// To the crew alone.
void Console::sendPeople(Visitor& visitor) {
    if (visitor.holder.role != ConsoleRole::Crew) return;
    browser::ToBrowser message;
    *message.mutable_people() = peopleFor(visitor.holder);
    sendTo(visitor, "people", message);
}

// Under its topic: an older one that waits still is replaced.
void Console::sendTo(Visitor& visitor,
                     const std::string& topic,
                     const browser::ToBrowser& message) {
    visitor.outbox->put(topic, std::make_shared<const std::string>(jsonOf(message)), false);
}

// Written once, shared by all.
void Console::sendToAll(const std::string& topic, const browser::ToBrowser& message) {
    if (visitors_.empty()) return;
    const auto payload = std::make_shared<const std::string>(jsonOf(message));
    for (Visitor* visitor : visitors_) visitor->outbox->put(topic, payload, false);
}

// All that a page needs to draw itself.
browser::ToBrowser Console::snapshotFor(const Visitor& visitor) const {
    constexpr std::uint32_t kSchema = 1;
    browser::ToBrowser message;
    browser::Snapshot& snapshot = *message.mutable_snapshot();
    snapshot.set_schema(kSchema);
    snapshot.set_build(options_.build);
    snapshot.set_rig(options_.rig.name);
    snapshot.set_role(static_cast<browser::Role>(visitor.holder.role));
    snapshot.set_name(visitor.holder.name);
    snapshot.set_has_power(machine::takesPowerWord(machine::powerFolder()));
    for (const config::Channel& from : options_.rig.channels) {
        browser::Channel& channel = *snapshot.add_channels();
        channel.set_name(from.name);
        channel.set_machine(from.machine);
        channel.set_width_px(static_cast<std::uint32_t>(from.sizePixels.x));
        channel.set_height_px(static_cast<std::uint32_t>(from.sizePixels.y));
    }
    for (const std::string& scene : scenesBeside(options_.master.rig, options_.rig.scene))
        snapshot.add_scenes(scene);
    *snapshot.mutable_wall() = wall_;
    snapshot.mutable_wall()->set_now_s(unixNow());
    *snapshot.mutable_events() = events_.list();
    *snapshot.mutable_alerts() = alertList();
    *snapshot.mutable_hours() = hoursFor(visitor);
    *snapshot.mutable_projectors() = opening_.projectors();
    return message;
}

browser::Hours Console::hoursFor(const Visitor& visitor) const {
    browser::Hours hours = opening_.hours(unixNow());
    if (!doubtOfClock_.empty()) hours.set_next("stays");  // they rest
    if (visitor.holder.role == ConsoleRole::Crew) return hours;
    hours.clear_text();
    if (!hours.problem().empty())
        hours.set_problem("only crew may see where");  // it quotes the text
    for (browser::ControlledProjector& one : *hours.mutable_projectors()) one.clear_password();
    return hours;
}

// In the order in which they began.
browser::AlertList Console::alertList() const {
    browser::AlertList list;
    for (const StandingAlert& from : alerts_.standing()) {
        browser::Alert& alert = *list.add_alerts();
        alert.set_key(from.key);
        alert.set_text(from.text);
        alert.set_since_s(from.since);
        alert.set_state(from.isAcknowledged ? "acknowledged" : from.isOver ? "over" : "firing");
    }
    return list;
}

// For the crew; secrets and hashes are in none of it.
browser::People Console::peopleFor(const Holder& holder) const {
    browser::People people;
    people.set_code(code_);
    for (const Holder& from : access_.people()) {
        browser::Person& person = *people.add_people();
        person.set_id(from.id);
        person.set_name(from.name);
        person.set_role(static_cast<browser::Role>(from.role));
        person.set_since_s(from.since);
        person.set_self(from.id == holder.id);
    }
    return people;
}

}  // namespace aquarama::console
