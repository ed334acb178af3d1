// SPDX-License-Identifier: Apache-2.0
#include "console/visitors.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "common/machine/machine_power.h"
#include "console/waiting_nodes.h"

namespace aquarama::console {

namespace {

// A place of a picture, as shares of its size. NaN is refused.
bool isPlace(const browser::PointAt& at) {
    const auto isShare = [](float number) { return number >= 0 && number <= 1; };
    return isShare(at.x()) && isShare(at.y());
}

constexpr int kTicksOfALook = 3 * kTicksASecond;

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

// One of the topics of its look.
bool Visitor::wants(const char* topic) const {
    // Findings of the tour quote files that may hold passwords.
    if (std::string_view(topic) == "tour" && holder.role != ConsoleRole::Crew) return false;
    const auto& topics = look.topics();
    return std::ranges::find(topics, topic) != topics.end();
}

void Visitors::add(Visitor& visitor) {
    visitors_.insert(&visitor);
    sendTo(visitor, "0", snapshotFor(visitor));  // before all other topics
}

void Visitors::remove(Visitor& visitor) {
    visitors_.erase(&visitor);
    std::erase_if(fishAsked_, [&](const auto& one) { return one.second == &visitor; });
}

void Visitors::sendAway(const std::string& person) {
    for (Visitor* one : visitors_)
        if (one->holder.id == person) one->outbox->close(kClosedUnpaired);
}

void Visitors::note(const std::string& who, const std::string& what) {
    state_.events.add(who, what);
    browser::ToBrowser message;
    *message.mutable_events() = state_.events.list();
    sendToAll("events", message);
}

void Visitors::sendWall(std::uint64_t refused) {
    const UnixSeconds now = unixNow();
    state_.wall.set_now_s(now);
    state_.wall.set_held_until_s(state_.opening.heldUntil(now));
    state_.wall.set_on_battery(state_.opening.isOnBattery());
    state_.wall.set_watching(static_cast<std::uint32_t>(visitors_.size()));
    state_.wall.set_refused_requests(refused);
    const DrawingCounts drawings = state_.drawings.counts();
    state_.wall.set_drawings_waiting(drawings.waiting);
    state_.wall.set_drawings_swimming(drawings.swimming);
    browser::ToBrowser message;
    *message.mutable_wall() = state_.wall;
    sendToAll("wall", message);
}

// While they are read for the first time there is nothing to send.
void Visitors::sendCalibrations(Visitor& visitor) {
    if (!state_.calibrations) return;
    browser::ToBrowser message;
    *message.mutable_calibrations() = *state_.calibrations;
    message.mutable_calibrations()->set_held_scan(visitor.holdsScan);
    sendTo(visitor, "calibrations", message);
}

bool Visitors::isLookedAt(const char* topic) const {
    return std::ranges::any_of(visitors_, [topic](const Visitor* visitor) {
        return visitor->ticksToLook > 0 && visitor->wants(topic);
    });
}

std::optional<std::uint32_t> Visitors::heardFish(const v1::FishReply& reply) {
    const auto asked = fishAsked_.find(reply.number());
    if (asked == fishAsked_.end()) return std::nullopt;
    browser::ToBrowser message;
    browser::Mind& mind = *message.mutable_mind();
    mind.set_fish(reply.has_fish() ? static_cast<int>(reply.fish()) : -1);
    sendTo(*asked->second, "mind", message);
    fishAsked_.erase(asked);
    return reply.has_fish() ? std::optional(reply.fish()) : std::nullopt;
}

void Visitors::tick() {
    for (Visitor* visitor : visitors_) {
        if (visitor->ticksToLook > 0 && --visitor->ticksToLook == 0) visitor->hasHistory = false;
        for (auto& [channel, ticks] : visitor->picturesUnderWay) --ticks;
        std::erase_if(visitor->picturesUnderWay, [](const auto& one) { return one.second <= 0; });
    }
    askPictures();
}

void Visitors::everySecond() {
    browser::ToBrowser alerts;
    *alerts.mutable_alerts() = alertList();
    sendToAll("alerts", alerts);
    if (state_.panorama.update())
        for (Visitor* visitor : visitors_) visitor->hasPanorama = false;
    for (Visitor* visitor : visitors_) {
        visitor->messages = 0;
        if (visitor->holder.until > 0 && visitor->holder.until < unixNow())
            visitor->outbox->close(kClosedUnpaired);
        if (visitor->ticksToLook <= 0) continue;
        sendTopics(*visitor);
    }
}

// A page gets what it shows, and no other page does.
void Visitors::sendTopics(Visitor& visitor) {
    using Send = void (Visitors::*)(Visitor&);
    static constexpr std::array<std::pair<const char*, Send>, 10> kTopics{
        {{"log", &Visitors::sendLog},
         {"drawings", &Visitors::sendDrawings},
         {"panorama", &Visitors::sendPanorama},
         {"calibrations", &Visitors::sendCalibrations},
         {"doctor", &Visitors::sendDoctor},
         {"history", &Visitors::sendHistory},
         {"hours", &Visitors::sendHours},
         {"people", &Visitors::sendPeople},
         {"machines", &Visitors::sendMachines},
         {"tour", &Visitors::sendTour}}};
    if (!visitor.wants("history")) visitor.hasHistory = false;
    for (const auto& [topic, send] : kTopics)
        if (visitor.wants(topic)) (this->*send)(visitor);
}

// What it found last, also while it runs once more.
void Visitors::sendDoctor(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_doctor() = state_.doctor;
    sendTo(visitor, "doctor", message);
}

// Where it has changed.
void Visitors::sendLog(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_log() = tailOf(logOf(state_.rigFile), visitor.look);
    std::string text = jsonOf(message);
    if (text != visitor.sentLog)
        visitor.outbox->put("log", std::make_shared<const std::string>(text), false);
    visitor.sentLog = std::move(text);
}

// First all of it, under a topic of its own: what is newer does not replace it while it waits.
void Visitors::sendHistory(Visitor& visitor) {
    const bool isAll = !std::exchange(visitor.hasHistory, true);
    browser::ToBrowser message;
    *message.mutable_history() = isAll ? state_.figures.history() : state_.figures.lastSecond();
    sendTo(visitor, isAll ? "history" : "history of a second", message);
}

// With the projectors, which have hours too.
void Visitors::sendHours(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_hours() = hoursFor(visitor);
    sendTo(visitor, "hours", message);
    *message.mutable_projectors() = state_.opening.projectors();
    sendTo(visitor, "projectors", message);
}

// Once, and again when it is another.
void Visitors::sendPanorama(Visitor& visitor) {
    if (state_.panorama.panorama().meshes().empty() || std::exchange(visitor.hasPanorama, true))
        return;
    browser::ToBrowser message;
    *message.mutable_panorama() = state_.panorama.panorama();
    sendTo(visitor, "panorama", message);
}

// Where they have changed.
void Visitors::sendDrawings(Visitor& visitor) {
    if (std::exchange(visitor.sentDrawings, state_.drawings.version()) == state_.drawings.version())
        return;
    browser::ToBrowser message;
    *message.mutable_drawings() = state_.drawings.message();
    sendTo(visitor, "drawings", message);
}

void Visitors::heardDrawings() {
    for (Visitor* visitor : visitors_)
        if (visitor->ticksToLook > 0 && visitor->wants("drawings")) sendDrawings(*visitor);
}

// To the crew alone.
void Visitors::sendPeople(Visitor& visitor) {
    if (visitor.holder.role != ConsoleRole::Crew) return;
    browser::ToBrowser message;
    *message.mutable_people() = peopleFor(visitor.holder);
    sendTo(visitor, "people", message);
}

// Those that wait for a channel, and what all run; of that nothing before the depot was asked once.
void Visitors::sendMachines(Visitor& visitor) {
    browser::ToBrowser message;
    *message.mutable_waiting_nodes() = listOf(state_.waiting, state_.searchesNodes);
    sendTo(visitor, "waiting nodes", message);
    if (!state_.releases) return;
    *message.mutable_releases() = *state_.releases;
    sendTo(visitor, "releases", message);
}

// Before the first look there is nothing to send.
void Visitors::sendTour(Visitor& visitor) {
    if (!state_.tour) return;
    browser::ToBrowser message;
    *message.mutable_tour() = *state_.tour;
    sendTo(visitor, "tour", message);
}

// Under its topic: an older one that waits still is replaced.
void Visitors::sendTo(Visitor& visitor,
                      const std::string& topic,
                      const browser::ToBrowser& message) {
    visitor.outbox->put(topic, std::make_shared<const std::string>(jsonOf(message)), false);
}

void Visitors::sendToPerson(const std::string& person,
                            const std::string& topic,
                            const browser::ToBrowser& message) {
    for (Visitor* visitor : visitors_)
        if (visitor->holder.id == person) sendTo(*visitor, topic, message);
}

// Written once, shared by all.
void Visitors::sendToAll(const std::string& topic, const browser::ToBrowser& message) {
    if (visitors_.empty()) return;
    const auto payload = std::make_shared<const std::string>(jsonOf(message));
    for (Visitor* visitor : visitors_) visitor->outbox->put(topic, payload, false);
}

// All that a page needs to draw itself.
browser::ToBrowser Visitors::snapshotFor(const Visitor& visitor) const {
    constexpr std::uint32_t kSchema = 1;
    browser::ToBrowser message;
    browser::Snapshot& snapshot = *message.mutable_snapshot();
    snapshot.set_schema(kSchema);
    snapshot.set_build(state_.build);
    snapshot.set_rig(state_.rig.name);
    snapshot.set_role(static_cast<browser::Role>(visitor.holder.role));
    snapshot.set_name(visitor.holder.name);
    snapshot.set_has_power(machine::takesPowerWord(machine::powerFolder()));
    snapshot.set_has_guests(state_.rig.guests.has_value());
    snapshot.set_has_drawings(state_.rig.drawings.has_value());
    snapshot.set_has_depot(!state_.rig.sides.depot.empty());
    snapshot.set_reads_pictures(readsPictures_);
    for (const config::Channel& from : state_.rig.channels) {
        browser::Channel& channel = *snapshot.add_channels();
        channel.set_name(from.name);
        channel.set_machine(from.machine);
        channel.set_width_px(static_cast<std::uint32_t>(from.sizePixels.x));
        channel.set_height_px(static_cast<std::uint32_t>(from.sizePixels.y));
    }
    for (const std::string& scene : scenesBeside(state_.rigFile, state_.rig.scene))
        snapshot.add_scenes(scene);
    *snapshot.mutable_wall() = state_.wall;
    snapshot.mutable_wall()->set_now_s(unixNow());
    *snapshot.mutable_events() = state_.events.list();
    *snapshot.mutable_alerts() = alertList();
    *snapshot.mutable_hours() = hoursFor(visitor);
    *snapshot.mutable_projectors() = state_.opening.projectors();
    return message;
}

browser::Hours Visitors::hoursFor(const Visitor& visitor) const {
    browser::Hours hours = state_.opening.hours(unixNow());
    if (!state_.doubtOfClock.empty()) hours.set_next("stays");  // they rest
    if (visitor.holder.role == ConsoleRole::Crew) return hours;
    hours.clear_text();
    if (!hours.problem().empty())
        hours.set_problem("only crew may see where");  // it quotes the text
    for (v1::ControlledProjector& one : *hours.mutable_form()->mutable_projectors())
        one.clear_password();
    return hours;
}

// In the order in which they began.
browser::AlertList Visitors::alertList() const {
    browser::AlertList list;
    for (const StandingAlert& from : state_.alerts.standing()) {
        browser::Alert& alert = *list.add_alerts();
        alert.set_key(from.key);
        alert.set_text(from.text);
        alert.set_since_s(from.since);
        alert.set_state(from.isAcknowledged ? "acknowledged" : from.isOver ? "over" : "firing");
    }
    return list;
}

// For the crew; secrets and hashes are in none of it.
browser::People Visitors::peopleFor(const Holder& holder) const {
    browser::People people;
    people.set_code(state_.code);
    for (const Holder& from : state_.access.people()) {
        browser::Person& person = *people.add_people();
        person.set_id(from.id);
        person.set_name(from.name);
        person.set_role(static_cast<browser::Role>(from.role));
        person.set_since_s(from.since);
        person.set_self(from.id == holder.id);
    }
    return people;
}

// To those who look and have drawn the one before; an old answer is to nobody.
void Visitors::heardPicture(const std::string& channel, const v1::FramePicture& picture) {
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

// To all who have that page open.
void Visitors::heardMind(const v1::Explanation& explanation) {
    browser::ToBrowser message;
    browser::Mind& mind = *message.mutable_mind();
    mind.set_fish(static_cast<int>(explanation.fish()));
    *mind.mutable_explanation() = explanation;
    for (Visitor* visitor : visitors_)
        if (visitor->wants("mind")) sendTo(*visitor, "mind", message);
}

// -1 where the rig has none of that name.
int Visitors::channelIndexOf(const std::string& channel) const {
    const auto found = std::ranges::find(state_.rig.channels, channel, &config::Channel::name);
    return found == state_.rig.channels.end()
               ? -1
               : static_cast<int>(found - state_.rig.channels.begin());
}

// A look is forgotten after three seconds without a word.
bool Visitors::isWatched(const Visitor& visitor, int channel) const {
    const auto& channels = visitor.look.channels();
    const std::string& name = state_.rig.channels[static_cast<std::size_t>(channel)].name;
    return visitor.ticksToLook > 0 && std::ranges::find(channels, name) != channels.end();
}

// The widest that somebody wants who has drawn the last one; 0: nobody.
std::uint32_t Visitors::wantedWidth(int channel) const {
    constexpr std::uint32_t kLeast = 64, kMost = 960;
    std::uint32_t width = 0;
    for (const Visitor* visitor : visitors_)
        if (isWatched(*visitor, channel) && !visitor->picturesUnderWay.contains(channel))
            width = std::max(width, std::clamp(visitor->look.width_px(), kLeast, kMost));
    return width;
}

// Asked once more after a second without an answer.
void Visitors::askPictures() {
    if (nodes_ == nullptr) return;
    for (int channel = 0; channel < static_cast<int>(state_.rig.channels.size()); ++channel) {
        PictureState& state = pictures_[channel];
        if (state.ticksToAsk > 0 && --state.ticksToAsk > 0) continue;
        const std::uint32_t width = wantedWidth(channel);
        if (width == 0) continue;
        state = {kTicksASecond, ++number_};
        nodes_->askPicture(
            state_.rig.channels[static_cast<std::size_t>(channel)].name, number_, width);
    }
}

// Said every second; what is new in it is answered at once.
void Visitors::takeLook(Visitor& visitor, const browser::Look& look) {
    const bool isNew = look.SerializeAsString() != visitor.look.SerializeAsString();
    visitor.look = look;
    visitor.ticksToLook = kTicksOfALook;
    if (isNew) sendTopics(visitor);
}

// The answer comes by heardFish(); of too many questions the oldest is lost.
void Visitors::askFish(Visitor& visitor, const browser::PointAt& at) {
    if (nodes_ == nullptr || !isPlace(at) || channelIndexOf(at.channel()) < 0) return;
    constexpr std::size_t kMostAsked = 64;
    if (fishAsked_.size() >= kMostAsked) fishAsked_.erase(fishAsked_.begin());
    fishAsked_[++number_] = &visitor;
    v1::FishRequest request;
    request.set_number(number_);
    request.set_frame(at.frame());
    request.set_x(at.x());
    request.set_y(at.y());
    nodes_->askFish(at.channel(), request);
}

}  // namespace aquarama::console
