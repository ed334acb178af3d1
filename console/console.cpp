// SPDX-License-Identifier: Apache-2.0
#include "console/console.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"

namespace aquarama::console {

namespace {

using web::HttpReply;
using web::HttpRequest;

// Browsers that are connected at a time; another one gets status 503.
constexpr std::size_t kMostVisitors = 64;
constexpr int kTicksASecond = 10;
// A look, or a picture that nobody has confirmed, is forgotten after three seconds.
constexpr int kTicksOfALook = 3 * kTicksASecond;
// A visitor that exceeds one of these two is disconnected with kClosedNoisy.
constexpr int kMostMessagesASecond = 200;
constexpr int kMostMalformed = 10;
// As kClosedUnpaired.
constexpr std::uint16_t kClosedNoisy = 4008;

// Hands at the submarine, brought into the range of the wire.
Steering steeringOf(const browser::Helm& helm) {
    const auto axis = [](int value) {
        return static_cast<std::int8_t>(std::clamp(value, -kFullSteering, int{kFullSteering}));
    };
    return {.ahead = axis(helm.ahead()),
            .aside = axis(helm.aside()),
            .up = axis(helm.up()),
            .turn = axis(helm.turn()),
            .tilt = axis(helm.tilt())};
}

// A code and a name of whoever types it; an empty code where the text is none.
struct PairingRequest {
    std::string code, name;
};
PairingRequest pairingIn(const std::string& body) {
    const auto asked = nlohmann::json::parse(body, nullptr, false);
    const auto text = [&](const char* field) -> std::string {
        if (!asked.is_object() || !asked.contains(field) || !asked[field].is_string()) return {};
        return asked[field].get<std::string>();
    };
    return {text("code"), text("name")};
}

// What the master is told where the hours want this.
v1::Set setOfHours(const config::WantedHours& wanted) {
    v1::Set set;
    set.set_request(ask::freshRequest());
    set.set_black(!wanted.isOpen);
    if (!wanted.scene.empty()) set.set_scene(wanted.scene);
    if (!wanted.quality.empty()) set.set_quality(wanted.quality);
    return set;
}

// What is said of a scan again and again; nobody asks how it went.
v1::Set setOf(const v1::HeldScan& scan) {
    v1::Set set;
    set.set_request(ask::freshRequest());
    *set.mutable_scan() = scan;
    return set;
}

// The shutters of projectors wait for that.
bool isInStep(const browser::Wall& wall) {
    return wall.heard() && std::ranges::all_of(wall.nodes(), [](const browser::Node& node) {
               return node.condition() == "in step";
           });
}

// Whether the page of a visitor shows this.
bool wants(const Console::Visitor& visitor, const char* topic) {
    const auto& topics = visitor.look.topics();
    return std::ranges::find(topics, topic) != topics.end();
}

// Text that is none becomes question marks: a reply is never malformed.
std::string jsonOfObject(const nlohmann::json& object) {
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
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

// A WebSocket of one visitor.
class VisitorConnection final : public web::Service::Connection {
  public:
    VisitorConnection(Console& console, std::unique_ptr<Console::Visitor> visitor)
        : console_{console}, visitor_{std::move(visitor)} {}
    ~VisitorConnection() override { console_.forget(*visitor_); }
    VisitorConnection(const VisitorConnection&) = delete;
    VisitorConnection& operator=(const VisitorConnection&) = delete;
    void hear(const std::string& text) override { console_.hear(*visitor_, text); }

  private:
    Console& console_;
    std::unique_ptr<Console::Visitor> visitor_;
};

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
            [=, this] { here([this] { wallIsSilent(); }); },
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

// --- requests

// Counted, and shown in the foot of every page.
HttpReply Console::refused(int status, const std::string& why) {
    ++refused_;
    return {.status = status, .body = why + "\n"};
}

// Nothing that is got acts; whoever sends it, host and origin come first.
HttpReply Console::answer(const HttpRequest& request) {
    const bool reads = request.method == "GET" || request.method == "HEAD";
    if (auto objection = objectionTo(request, doors_, !reads)) {
        ++refused_;
        return *std::move(objection);
    }
    if (request.method == "POST") return act(request);
    if (!reads) return refused(405, "only GET, HEAD and POST");
    if (auto page = pageAt(request)) return *std::move(page);
    const auto holder = holderOf(request, doors_, access_);
    if (request.target == "/me")
        return {.type = "application/json",
                .body = jsonOfObject({{"name", holder ? holder->name : ""},
                                      {"role", holder ? nameOf(holder->role) : ""}})};
    return holder ? look(request) : refused(401, "not paired");
}

// For whoever is let in; the pages themselves are for everybody.
HttpReply Console::look(const HttpRequest& request) {
    if (request.target == "/metrics")
        return {.type = "text/plain; version=0.0.4", .body = metricsOf(wall_, server_->cutOff())};
    if (request.target == "/bundle.tar") {
        std::string events;
        const browser::EventList list = events_.list();
        for (const browser::Event& event : list.events())
            events += fmt::format("{:.0f} {}: {}\n", event.at_s(), event.who(), event.what());
        browser::ToBrowser status;
        *status.mutable_wall() = wall_;
        return {.type = "application/x-tar",
                .body = bundleOf(options_.master.rig,
                                 {{"events.txt", events}, {"status.json", jsonOf(status)}}),
                .headers = {{"Content-Disposition", "attachment; filename=\"aquarama.tar\""}}};
    }
    return {.status = 404, .body = "there is no such page\n"};
}

// Forms of other pages cannot send JSON without asking the browser first.
HttpReply Console::act(const HttpRequest& request) {
    if (!request.contentType.starts_with("application/json"))
        return refused(415, "only application/json");
    if (request.target == "/pair") return pair(request);
    if (request.target == "/leave") return leave(request);
    if (request.target != "/command") return refused(404, "there is nothing to act on here");
    const auto holder = holderOf(request, doors_, access_);
    return holder ? obey(request, *holder) : refused(401, "not paired");
}

// The one thing that somebody without a session may do.
HttpReply Console::pair(const HttpRequest& request) {
    const PairingRequest asked = pairingIn(request.body);
    if (asked.code.empty()) return refused(400, "give the code that the console has shown");
    bool isSpent = false;
    const auto secret = access_.pair(asked.code, asked.name, unixNow(), isSpent);
    if (secret) {
        code_.clear();
        note("console", "a browser was let in");
        return {.body = "welcome\n", .headers = {{"Set-Cookie", cookieOf(doors_, *secret)}}};
    }
    if (isSpent) note("console", "five wrong pairing codes: the code has ended");
    if (isSpent && !access_.hasPeople()) showCode(ConsoleRole::Crew);
    return refused(403, "this is not the code, or it has ended");
}

// The session ends on this side, whatever the browser does with its cookie.
HttpReply Console::leave(const HttpRequest& request) {
    const auto holder = access_.session(sessionIn(request, doors_), unixNow());
    if (holder) access_.revoke(holder->id);
    return {.body = "goodbye\n", .headers = {{"Set-Cookie", cookieOf(doors_, "")}}};
}

// For programs, as Companion: one command in one request.
HttpReply Console::obey(const HttpRequest& request, const Holder& holder) {
    const auto message = readBrowser(request.body);
    if (!message || !message->has_command()) return refused(400, "this is no command");
    browser::ToBrowser reply;
    *reply.mutable_done() = carryOut(holder, nullptr, message->command());
    const bool isRefused = reply.done().outcome() == "refused";
    return {.status = isRefused ? 403 : 200, .type = "application/json", .body = jsonOf(reply)};
}

// The first message is a whole snapshot: a page shows nothing before it.
std::unique_ptr<web::Service::Connection> Console::open(const HttpRequest& request,
                                                        web::Outbox& outbox,
                                                        HttpReply& refusal) {
    const auto holder = holderOf(request, doors_, access_);
    if (auto objection = objectionTo(request, doors_, true)) {
        ++refused_;
        refusal = *std::move(objection);
    } else if (request.target != "/ws") {
        refusal = refused(404, "the console is at /ws");
    } else if (!holder) {
        refusal = refused(401, "not paired");
    } else if (visitors_.size() >= kMostVisitors) {
        refusal = refused(503, "too many browsers look already; close one");
    } else {
        auto visitor = std::make_unique<Visitor>(Visitor{.holder = *holder, .outbox = &outbox});
        visitors_.insert(visitor.get());
        sendTo(*visitor, "0", snapshotFor(*visitor));  // before all other topics
        return std::make_unique<VisitorConnection>(*this, std::move(visitor));
    }
    return nullptr;
}

// What it has asked for goes on, and is answered to nobody.
void Console::forget(Visitor& visitor) {
    visitors_.erase(&visitor);
    for (auto& [id, pending] : pending_)
        if (pending.visitor == &visitor) pending.visitor = nullptr;
    if (scan_.visitor == &visitor) scan_ = {};
    std::erase_if(fishAsked_, [&](const auto& one) { return one.second == &visitor; });
}

// --- what browsers say

// A visitor that is noisy is sent away, and may come again.
void Console::hear(Visitor& visitor, const std::string& text) {
    const auto message = readBrowser(text);
    if (!message) ++visitor.malformed;
    const bool isNoisy = ++visitor.messages > kMostMessagesASecond;
    if (isNoisy || visitor.malformed > kMostMalformed) visitor.outbox->close(kClosedNoisy);
    if (isNoisy || !message) {
        ++refused_;
        return;
    }
    switch (message->message_case()) {
        case browser::FromBrowser::kLook:
            return takeLook(visitor, message->look());
        case browser::FromBrowser::kSeen:
            visitor.picturesUnderWay.erase(static_cast<int>(message->seen().channel()));
            return;
        case browser::FromBrowser::kHelm:
            if (visitor.holder.role >= ConsoleRole::Operator)
                link_->steer(steeringOf(message->helm()));
            return;
        case browser::FromBrowser::kCommand: {
            browser::ToBrowser reply;
            *reply.mutable_done() = carryOut(visitor.holder, &visitor, message->command());
            return sendTo(visitor, fmt::format("done {}", message->command().id()), reply);
        }
        default:
            return;  // it is there
    }
}

// Said every second; what is new in it is answered at once.
void Console::takeLook(Visitor& visitor, const browser::Look& look) {
    const bool isNew = look.SerializeAsString() != visitor.look.SerializeAsString();
    visitor.look = look;
    visitor.ticksToLook = kTicksOfALook;
    if (isNew) sendTopics(visitor);
}

// --- what master and nodes say

// Changes are told from looks at the wall, so it does not matter who made them.
void Console::heardWall(const browser::Wall& wall) {
    if (wall_.run() != 0)
        for (const std::string& line : changesOf(wall_, wall)) note("wall", line);
    wall_ = wall;
    wall_.set_heard_s(unixNow());
}

// What was last heard stays, and is marked as old.
void Console::wallIsSilent() {
    if (wall_.heard()) note("wall", "the master does not answer");
    wall_.set_heard(false);
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
        if (wants(*visitor, "mind")) sendTo(*visitor, "mind", message);
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

// One change at a time: its end is waited for.
void Console::keepHours() {
    opening_.switchProjectors(unixNow(), isInStep(wall_));
    const auto due = opening_.due(unixNow());
    if (!due || beingOpened_ || !wall_.heard()) return;
    const v1::Set set = setOfHours(*due);
    openingId_ = set.request();
    beingOpened_ = due;
    link_->set(set);
}

// Also what people should notice although they look at nothing.
void Console::everySecond() {
    keepHours();
    keepScan();
    const auto lines =
        alerts_.update(faultsOf(wall_, unixNow()), unixNow(), opening_.isClosed(unixNow()));
    for (const std::string& line : lines) note("alert", line);
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
    if (scan_.visitor->ticksToLook <= 0 || !wants(*scan_.visitor, "calibrations"))
        scan_ = {};  // the page was left
    else
        link_->set(setOf(scan_.held));
}

// A page gets what it shows, and no other page does.
void Console::sendTopics(Visitor& visitor) {
    if (wants(visitor, "log")) sendLog(visitor);
    if (wants(visitor, "panorama")) sendPanorama(visitor);
    if (wants(visitor, "calibrations")) sendCalibrations(visitor);
    if (!wants(visitor, "history")) visitor.hasHistory = false;
    browser::ToBrowser message;
    if (wants(visitor, "doctor")) {
        *message.mutable_doctor() = doctor_;
        sendTo(visitor, "doctor", message);
    }
    if (wants(visitor, "history") && !std::exchange(visitor.hasHistory, true))
        sendHistory(visitor, true);
    if (wants(visitor, "hours")) sendHours(visitor);
    if (wants(visitor, "people")) sendPeople(visitor);
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
    snapshot.set_has_power(std::filesystem::is_directory(kPowerFolder));
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
    if (visitor.holder.role == ConsoleRole::Crew) return hours;
    hours.clear_text();
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
