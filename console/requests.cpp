// SPDX-License-Identifier: Apache-2.0
// What browsers and programs ask of the console: over HTTP, and over a WebSocket. All of it on the
// server's thread.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "console/console.h"
#include "console/cues/shown.h"
#include "console/metrics.h"

namespace aquarama::console {

namespace {

using web::HttpReply;
using web::HttpRequest;

// Browsers that are connected at a time; another one gets status 503.
constexpr std::size_t kMostVisitors = 64;
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

// The route of pictures of sheets, with what it says beside the picture:
// "/api/drawing?aside=-1&request=7".
constexpr std::string_view kPictureRoute = "/api/drawing";

// Without what follows a question mark.
std::string_view pathOf(std::string_view target) {
    return target.substr(0, target.find('?'));
}

// A whole number that a target says; 0 where it says none.
template <class Number>
Number numberIn(const std::string& target, const std::string& name) {
    const std::size_t query = target.find('?');
    if (query == std::string::npos) return 0;
    const std::string all = "&" + target.substr(query + 1);
    const std::size_t found = all.find("&" + name + "=");
    if (found == std::string::npos) return 0;
    const char* const begin = all.data() + found + name.size() + 2;
    Number number = 0;
    const auto [end, error] = std::from_chars(begin, all.data() + all.size(), number);
    return error == std::errc() && (*end == '&' || *end == '\0') ? number : 0;
}

// Of "/drawing/12.png?tag"; 0 where it is none.
std::uint32_t drawingIn(const std::string& target) {
    constexpr std::string_view kBefore = "/drawing/", kAfter = ".png";
    const std::string_view path = pathOf(target);
    if (!path.starts_with(kBefore) || !path.ends_with(kAfter)) return 0;
    std::uint32_t number = 0;
    const char* const last = path.data() + path.size() - kAfter.size();
    const auto [end, error] = std::from_chars(path.data() + kBefore.size(), last, number);
    return error == std::errc() && end == last ? number : 0;
}

// Text that is none becomes question marks: a reply is never malformed.
std::string jsonOfObject(const nlohmann::json& object) {
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// {"scene": "reef", "black": 0, ...}
nlohmann::json jsonOf(const std::vector<ShownValue>& shown) {
    nlohmann::json object;
    for (const auto& [name, value] : shown)
        std::visit([&](const auto& plain) { object[name] = plain; }, value);
    return object;
}

// What became of an order or a picture, in a line.
HttpReply lineOf(const v1::OrderReply& reply) {
    const std::string why = reply.reason().empty() ? "" : ": " + reply.reason();
    if (reply.outcome() == v1::OrderReply::DONE) return {.body = "done" + why + "\n"};
    if (reply.outcome() != v1::OrderReply::WAITING)
        return {.status = 403, .body = "refused" + why + "\n"};
    return {.status = 202, .body = fmt::format("waiting{}; request {}\n", why, reply.request())};
}

// A WebSocket of one visitor.
class VisitorConnection final : public web::Service::Connection {
  public:
    VisitorConnection(Console& console, std::unique_ptr<Visitor> visitor)
        : console_{console}, visitor_{std::move(visitor)} {}
    ~VisitorConnection() override { console_.forget(*visitor_); }
    VisitorConnection(const VisitorConnection&) = delete;
    VisitorConnection& operator=(const VisitorConnection&) = delete;
    void hear(const std::string& text) override { console_.hear(*visitor_, text); }

  private:
    Console& console_;
    std::unique_ptr<Visitor> visitor_;
};

}  // namespace

// Counted, and shown in the foot of every page.
HttpReply Console::refused(int status, const std::string& why) {
    ++state_.refused;
    return {.status = status, .body = why + "\n"};
}

// A long body is read only of who may send it.
std::optional<web::BodyLimit> Console::admit(const HttpRequest& head, HttpReply& refusal) {
    constexpr std::chrono::seconds kTimeForPicture{60};
    if (head.method != "POST" || pathOf(head.target) != kPictureRoute) return web::BodyLimit{};
    const Doors doors = doorsFor(head, doors_);
    const auto holder = holderOf(head, doors, state_.access);
    if (auto objection = objectionTo(head, doors, true)) {
        ++state_.refused;
        refusal = *std::move(objection);
    } else if (!holder) {
        refusal = refused(401, "not paired");
    } else if (holder->role < ConsoleRole::Operator) {
        refusal = refused(403, "only operator may do this");
    } else {
        return web::BodyLimit{.mostBytes = ask::kMostPictureBytes, .within = kTimeForPicture};
    }
    return std::nullopt;
}

// Nothing that is got acts; whoever sends it, host and origin come first.
HttpReply Console::answer(const HttpRequest& request) {
    const bool reads = request.method == "GET" || request.method == "HEAD";
    const Doors doors = doorsFor(request, doors_);
    if (auto objection = objectionTo(request, doors, !reads)) {
        ++state_.refused;
        return *std::move(objection);
    }
    if (request.method == "POST") return act(request);
    if (!reads) return refused(405, "only GET, HEAD and POST");
    if (auto page = pageAt(request)) return *std::move(page);
    const auto holder = holderOf(request, doors, state_.access);
    if (request.target == "/me")
        return {.type = "application/json",
                .body = jsonOfObject({{"name", holder ? holder->name : ""},
                                      {"role", holder ? nameOf(holder->role) : ""}})};
    return holder ? look(request) : refused(401, "not paired");
}

std::string Console::metrics(UnixSeconds now) const {
    OwnFigures own{.cutOff = server_->cutOff(), .isClockWrong = !state_.doubtOfClock.empty()};
    if (options_.certificate != nullptr)
        own.certificateDays = (options_.certificate->validity().until - now) / kSecondsOfDay;
    if (desk_) own.cues = desk_->counts();
    return metricsOf(state_.wall, state_.opening.projectors(), own);
}

// For whoever is let in; the pages themselves are for everybody.
HttpReply Console::look(const HttpRequest& request) {
    if (request.target == "/metrics")
        return {.type = "text/plain; version=0.0.4", .body = metrics(unixNow())};
    if (request.target == "/api/state")
        return {.type = "application/json",
                .body = jsonOfObject(jsonOf(
                    shownBy(state_.wall.status(), state_.wall.heard(), state_.drawings.counts())))};
    if (request.target.starts_with("/drawing/")) return drawingAt(request);
    if (request.target == "/bundle.zip") return bundle();
    if (request.target == "/bundle.tar")  // the link of 0.2.0
        return {.status = 308, .headers = {{"Location", "/bundle.zip"}}};
    return {.status = 404, .body = "there is no such page\n"};
}

HttpReply Console::bundle() {
    std::string events;
    const browser::EventList list = state_.events.list();
    for (const browser::Event& event : list.events())
        events += fmt::format("{:.0f} {}: {}\n", event.at_s(), event.who(), event.what());
    browser::ToBrowser status;
    *status.mutable_wall() = state_.wall;
    try {
        return {.type = "application/zip",
                .body = bundleOf(state_.rigFile,
                                 {{"events.txt", events}, {"status.json", jsonOf(status)}}),
                .headers = {{"Content-Disposition", "attachment; filename=\"aquarama.zip\""}}};
    } catch (const Error& problem) {
        return refused(500, problem.what());
    }
}

// A picture is for an hour the same; after that its tag spares the content.
HttpReply Console::drawingAt(const HttpRequest& request) const {
    const SkinPicture* picture = state_.drawings.picture(drawingIn(request.target));
    if (picture == nullptr) return {.status = 404, .body = "there is no picture of it\n"};
    const std::string tag = '"' + picture->tag + '"';
    const std::vector<std::pair<std::string, std::string>> headers{
        {"ETag", tag}, {"Cache-Control", "private, max-age=3600"}};
    if (request.etag == tag) return {.status = 304, .headers = headers};
    return {.type = "image/png", .body = *picture->png, .headers = headers};
}

// Forms of other pages can send neither JSON nor a picture without asking the browser first.
HttpReply Console::act(const HttpRequest& request) {
    const bool isPicture = pathOf(request.target) == kPictureRoute;
    const std::string type = isPicture ? "image/" : "application/json";
    if (!request.contentType.starts_with(type)) return refused(415, "only " + type);
    if (request.target == "/pair") return pair(request);
    if (request.target == "/leave") return leave(request);
    return actAs(request);
}

// What only some may do, each by its path.
HttpReply Console::actAs(const HttpRequest& request) {
    using Act = HttpReply (Console::*)(const HttpRequest&, const Holder&);
    static const std::map<std::string_view, Act> kActs{{"/command", &Console::obey},
                                                       {"/api/order", &Console::takeOrder},
                                                       {kPictureRoute, &Console::takePicture}};
    const auto act = kActs.find(pathOf(request.target));
    if (act == kActs.end()) return refused(404, "there is nothing to act on here");
    const auto holder = holderOf(request, doorsFor(request, doors_), state_.access);
    return holder ? (this->*act->second)(request, *holder) : refused(401, "not paired");
}

// The one thing that somebody without a session may do.
HttpReply Console::pair(const HttpRequest& request) {
    const PairingRequest asked = pairingIn(request.body);
    if (asked.code.empty()) return refused(400, "give the code that the console has shown");
    bool isSpent = false;
    const std::string client = clientOf(request, doors_);
    const auto secret =
        state_.access.pair(asked.code, {.name = asked.name, .client = client}, unixNow(), isSpent);
    if (secret) {
        state_.code.clear();
        visitors_.note("console", "a browser was let in");
        return {.body = "welcome\n",
                .headers = {{"Set-Cookie", cookieOf(doorsFor(request, doors_), *secret)}}};
    }
    if (isSpent)
        visitors_.note("console",
                       "five wrong pairing codes, from " + client + ": the code has ended");
    if (isSpent && !state_.access.hasPeople()) showCode(ConsoleRole::Crew);
    return refused(403, "this is not the code, or it has ended");
}

// The session ends on this side, whatever the browser does with its cookie.
HttpReply Console::leave(const HttpRequest& request) {
    const Doors doors = doorsFor(request, doors_);
    const auto holder = state_.access.session(sessionIn(request, doors), unixNow());
    if (holder) state_.access.revoke(holder->id);
    return {.body = "goodbye\n", .headers = {{"Set-Cookie", cookieOf(doors, "")}}};
}

// For programs, as Companion: one command in one request.
HttpReply Console::obey(const HttpRequest& request, const Holder& holder) {
    const auto message = readBrowser(request.body);
    if (!message || !message->has_command()) return refused(400, "this is no command");
    browser::ToBrowser reply;
    *reply.mutable_done() = commands_.carryOut(holder, nullptr, message->command());
    const bool isRefused = reply.done().outcome() == v1::OrderReply::REFUSED;
    return {.status = isRefused ? 403 : 200, .type = "application/json", .body = jsonOf(reply)};
}

// The same in a line, for who has no number of the run: a button of Companion, a script.
HttpReply Console::takeOrder(const HttpRequest& request, const Holder& holder) {
    const auto order = readOrder(request.body);
    if (!order) return refused(400, "this is no order; one is {\"show\": {\"black\": true}}");
    return lineOf(giveOrder(holder, *order));
}

// What becomes of it is told by an order of its request.
HttpReply Console::takePicture(const HttpRequest& request, const Holder& holder) {
    if (request.body.empty()) return refused(400, "send a picture of a sheet");
    browser::Command command;
    const auto asked = numberIn<std::uint64_t>(request.target, "request");
    command.set_id(asked != 0 ? asked : ask::freshRequest());
    command.mutable_picture()->set_picture(request.body);
    command.mutable_picture()->set_aside(numberIn<int>(request.target, "aside"));
    return lineOf(commands_.carryOut(holder, nullptr, command));
}

// The first message is a whole snapshot: a page shows nothing before it.
std::unique_ptr<web::Service::Connection> Console::open(const HttpRequest& request,
                                                        web::Outbox& outbox,
                                                        HttpReply& refusal) {
    const Doors doors = doorsFor(request, doors_);
    const auto holder = holderOf(request, doors, state_.access);
    if (auto objection = objectionTo(request, doors, true)) {
        ++state_.refused;
        refusal = *std::move(objection);
    } else if (request.target != "/ws") {
        refusal = refused(404, "the console is at /ws");
    } else if (!holder) {
        refusal = refused(401, "not paired");
    } else if (visitors_.count() >= kMostVisitors) {
        refusal = refused(503, "too many browsers look already; close one");
    } else {
        auto visitor = std::make_unique<Visitor>(Visitor{.holder = *holder, .outbox = &outbox});
        visitors_.add(*visitor);
        return std::make_unique<VisitorConnection>(*this, std::move(visitor));
    }
    return nullptr;
}

void Console::forget(Visitor& visitor) {
    commands_.forget(visitor);
    visitors_.remove(visitor);
}

// A visitor that is noisy is sent away, and may come again.
void Console::hear(Visitor& visitor, const std::string& text) {
    const auto message = readBrowser(text);
    if (!message) ++visitor.malformed;
    const bool isNoisy = ++visitor.messages > kMostMessagesASecond;
    if (isNoisy || visitor.malformed > kMostMalformed) visitor.outbox->close(kClosedNoisy);
    if (isNoisy || !message) {
        ++state_.refused;
        return;
    }
    switch (message->message_case()) {
        case browser::FromBrowser::kLook:
            return visitors_.takeLook(visitor, message->look());
        case browser::FromBrowser::kSeen:
            visitor.picturesUnderWay.erase(static_cast<int>(message->seen().channel()));
            return;
        case browser::FromBrowser::kHelm:
            if (visitor.holder.role >= ConsoleRole::Operator)
                link_->steer(steeringOf(message->helm()));
            return;
        case browser::FromBrowser::kCommand: {
            browser::ToBrowser reply;
            *reply.mutable_done() =
                commands_.carryOut(visitor.holder, &visitor, message->command());
            return visitors_.sendTo(
                visitor, fmt::format("done {}", message->command().id()), reply);
        }
        default:
            return;  // it is there
    }
}

}  // namespace aquarama::console
