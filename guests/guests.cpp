// SPDX-License-Identifier: Apache-2.0
#include "guests/guests.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "common/config/host.h"
#include "guests/sign.h"

namespace aquarama::guests {

namespace {

using nlohmann::json;
using web::HttpReply;
using web::HttpRequest;

constexpr std::size_t kMostBytes = 256;   // of what a phone says
constexpr int kMostWrong = 5;             // guesses of one phone
constexpr double kBetweenPellets = 20;    // of one phone, seconds
constexpr double kHelmHolds = 0.35;       // seconds after a phone was last heard
constexpr int kCountdown = 5;             // last seconds of a turn that the wall counts
constexpr std::uint64_t kTicksATell = 5;  // 10 ticks a second
constexpr std::uint64_t kTicksAKeep = 10;
constexpr double kLooks = 4;  // seconds after which nobody looks at the wall's picture
constexpr std::size_t kDigits = 3;
constexpr std::string_view kPicture = "/wall.jpg?";

// The loopback's names are ours as well. Browsers leave port 80 out.
std::vector<std::string> hostsOf(const config::Guests& place) {
    std::vector<std::string> hosts;
    for (const std::string& name : {config::bracketed(place.host),
                                    std::string("127.0.0.1"),
                                    std::string("[::1]"),
                                    std::string("localhost")}) {
        hosts.push_back(name + ":" + std::to_string(place.port));
        if (place.port == 80) hosts.push_back(name);
    }
    return hosts;
}

// Of an array of five whole numbers from -127 to 127; nothing where it is none.
std::optional<Steering> steeringIn(const json& helm) {
    constexpr std::array kAxes{
        &Steering::ahead, &Steering::aside, &Steering::up, &Steering::turn, &Steering::tilt};
    constexpr int kMost = std::numeric_limits<std::int8_t>::max();
    if (!helm.is_array() || helm.size() != kAxes.size()) return std::nullopt;
    Steering steering;
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
        if (!helm[i].is_number_integer()) return std::nullopt;
        const auto number = helm[i].get<std::int64_t>();
        if (number < -kMost || number > kMost) return std::nullopt;
        steering.*kAxes[i] = static_cast<std::int8_t>(number);
    }
    return steering;
}

// Of an array of two shares; nothing where it is none.
std::optional<glm::vec2> placeIn(const json& place) {
    const bool isPlace =
        place.is_array() && place.size() == 2 && place[0].is_number() && place[1].is_number();
    if (!isPlace) return std::nullopt;
    return glm::vec2{place[0].get<float>(), place[1].get<float>()};
}

// The text of a member; empty where it is none.
std::string textIn(const json& message, const char* member) {
    const auto found = message.find(member);
    return found != message.end() && found->is_string() ? found->get<std::string>() : "";
}

// Which need less of a code than small letters.
std::string capitals(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

void say(Phone& phone, const char* topic, const json& message) {
    phone.outbox.put(topic, std::make_shared<const std::string>(message.dump()), false);
}

}  // namespace

Phone::Phone(GuestService& service, web::Outbox& out) : outbox{out}, service_{service} {
    service_.phones_.insert(this);
}

Phone::~Phone() {
    service_.gone(*this);
}

void Phone::hear(const std::string& text) {
    service_.hear(*this, text);
}

GuestService::GuestService(GuestsOptions options, VisitedWall& wall, std::function<double()> clock)
    : options_{std::move(options)},
      port_{wall},
      clock_{std::move(clock)},
      hosts_{hostsOf(options_.place)},
      tokens_{options_.key},
      drawings_{options_.drawings, sessions_, wall},
      queue_{options_.times},
      lastTick_{clock_()} {
    queue_.restore(sessions_.restore(options_.seatFile, lastTick_), queueNow_);
}

GuestService::~GuestService() {
    keepSeats();
}

// By one of our own pages.
bool GuestService::isOurs(const HttpRequest& request) const {
    return std::ranges::find(hosts_, request.host) != hosts_.end() &&
           request.origin == "http://" + request.host;
}

// Only pictures are longer than what every request may have.
std::optional<web::BodyLimit> GuestService::admit(const HttpRequest& head, HttpReply& refusal) {
    if (!VisitorDrawings::isMeant(head)) return web::BodyLimit{};
    if (isOurs(head) && isOpen()) return drawings_.admit(head, clock_(), refusal);
    refusal = {.status = 403, .body = "off"};
    return std::nullopt;
}

// A path with a code is the page as well, which then says the code: whoever only looks at an
// address, as programs that preview it do, takes no seat.
HttpReply GuestService::answer(const HttpRequest& request) {
    if (std::ranges::find(hosts_, request.host) == hosts_.end())
        return {.status = 421, .body = "visitors are not served by that name\n"};
    if (VisitorDrawings::isMeant(request)) {
        HttpReply reply = drawings_.take(request);
        keepNow();
        return reply;
    }
    if (request.target.starts_with(kPicture)) return picture(request.target);
    if (request.method != "GET" && request.method != "HEAD")
        return {.status = 405, .body = "only GET\n"};
    HttpRequest page = request;
    if (page.target.starts_with("/P/") || page.target.starts_with("/p/")) page.target = "/";
    auto found = web::pageAt(embeddedPages(), page);
    return found ? *std::move(found) : HttpReply{.status = 404, .body = "there is no such page\n"};
}

// The newest; whoever asks for it sees to it that there will be a newer one. It shows the sign, so
// only who has seen that on the wall is given it: "/wall.jpg?SECRET.NUMBER".
HttpReply GuestService::picture(const std::string& target) {
    const std::string asker = target.substr(kPicture.size());
    if (sessions_.guestOf(asker.substr(0, asker.find('.'))).empty())
        return {.status = 401, .body = "the wall is shown to visitors who were let in\n"};
    lookedAt_ = clock_();
    const std::string jpeg = options_.picture == nullptr ? "" : options_.picture->jpeg();
    if (jpeg.empty()) return {.status = 204, .body = {}};
    return {.status = 200,
            .type = "image/jpeg",
            .body = jpeg,
            .headers = {{"Cache-Control", "no-store"}}};
}

std::unique_ptr<web::Service::Connection> GuestService::open(const HttpRequest& request,
                                                             web::Outbox& outbox,
                                                             HttpReply& refusal) {
    if (!isOurs(request))
        refusal = {.status = 403, .body = "a page of another origin may not ask this\n"};
    else if (request.target != "/g")
        refusal = {.status = 404, .body = "there is nothing here\n"};
    else if (phones_.size() >= kMostPhones)
        refusal = {.status = 503, .body = "there are too many phones; try again in a while\n"};
    else {
        auto phone = std::make_unique<Phone>(*this, outbox);
        tell(*phone);
        return phone;
    }
    return nullptr;
}

void GuestService::hear(Phone& phone, const std::string& text) {
    if (text.size() > kMostBytes || !phone.messages.take(clock_()))
        return phone.outbox.close(kClosedTooMuch);
    const json message = json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!message.is_object()) return;
    if (const std::string code = textIn(message, "enter"); !code.empty()) return enter(phone, code);
    if (const std::string secret = textIn(message, "resume"); !secret.empty())
        return resume(phone, secret);
    if (phone.guest.empty()) return;
    if (const auto helm = message.find("helm"); helm != message.end()) {
        if (const auto steering = steeringIn(*helm)) steer(phone, *steering);
        return;
    }
    if (const auto place = message.find("feed"); place != message.end())
        feed(phone, placeIn(*place));
    const std::size_t seats = queue_.seats().size();
    if (message.contains("join") && isOpen()) queue_.join(phone.guest);
    if (message.contains("leave")) queue_.leave(phone.guest, queueNow_);
    if (queue_.seats().size() != seats) keepNow();
    advanceQueue();
    tell(phone);
}

// Digits can be guessed, so guesses are few.
bool GuestService::acceptsCode(Phone& phone, const std::string& code) {
    const double now = clock_();
    if (code.size() != kDigits) return tokens_.acceptsWord(code, now);
    if (!guesses_.take(now)) return false;
    if (tokens_.acceptsDigits(code, now)) return true;
    if (++phone.wrong >= kMostWrong) phone.outbox.close(kClosedTooMuch);
    return false;
}

// Who is let in takes a seat at once, where there is one.
void GuestService::enter(Phone& phone, const std::string& code) {
    if (!phone.guest.empty()) return;
    if (!entries_.take(clock_())) return say(phone, "refused", {{"refused", "busy"}});
    if (!acceptsCode(phone, code)) return say(phone, "refused", {{"refused", "code"}});
    const auto secret = sessions_.admit(clock_());
    if (!secret) return say(phone, "refused", {{"refused", "busy"}});
    const GuestId guest = sessions_.guestOf(*secret);
    if (isOpen()) queue_.join(guest);
    keepNow();
    say(phone, "session", {{"session", *secret}});
    welcome(phone, guest);
}

void GuestService::resume(Phone& phone, const std::string& secret) {
    if (!phone.guest.empty()) return;
    const GuestId guest = sessions_.guestOf(secret);
    if (guest.empty()) return say(phone, "refused", {{"refused", "session"}});
    welcome(phone, guest);
}

// The latest page of a visitor counts.
void GuestService::welcome(Phone& phone, const GuestId& guest) {
    Visit& visit = *sessions_.find(guest);
    if (visit.phone != nullptr) {
        visit.phone->guest.clear();
        visit.phone->outbox.close(kClosedElsewhere);
    }
    visit.phone = &phone;
    phone.guest = guest;
    queue_.back(guest);
    advanceQueue();
    tell(phone);
}

void GuestService::gone(Phone& phone) {
    phones_.erase(&phone);
    if (phone.guest.empty()) return;
    Visit& visit = *sessions_.find(phone.guest);
    visit.phone = nullptr;
    visit.seen = clock_();
    queue_.lost(phone.guest, queueNow_);
    if (queue_.steering() == phone.guest) port_.steer(helm_ = {});
}

void GuestService::steer(const Phone& phone, const Steering& steering) {
    if (!isOpen() || queue_.steering() != phone.guest) return;
    helm_ = steering;
    helmHeard_ = clock_();
    port_.steer(helm_);
}

// Where the finger points, or where the eye looks: some metres before it.
void GuestService::feed(Phone& phone, const std::optional<glm::vec2>& place) {
    const double now = clock_();
    Visit& visit = *sessions_.find(phone.guest);
    if (!isOpen() || now < visit.mayFeed || !pellets_.take(now)) return;
    visit.mayFeed = now + kBetweenPellets;
    const auto between = [&](float least, float most) {
        return std::uniform_real_distribution<float>(least, most)(random_);
    };
    glm::vec3 before{between(-0.8F, 0.8F), between(0.0F, 0.5F), -between(2.0F, 3.0F)};
    if (place && options_.picture != nullptr)
        if (const auto direction = options_.picture->map().directionAt(*place))
            before = *direction * between(2.0F, 3.0F);
    port_.feed(wall_->eye.positionMetres + wall_->eye.worldFromWall * before);
}

void GuestService::heard(const std::optional<WallState>& wall) {
    const bool wasOpen = isOpen();
    wall_ = wall;
    drawings_.heard(wall ? wall->drawings : nullptr);
    if (isOpen() == wasOpen) return;
    helm_ = {};
    tellAll();
}

void GuestService::offered(std::uint64_t request, std::uint32_t number) {
    drawings_.offered(request, number);
    keepNow();
    tellAll();
}

// Those of phones that are there.
void GuestService::watchFish() {
    std::set<GuestId> guests;
    for (const Phone* const phone : phones_)
        if (!phone->guest.empty()) guests.insert(phone->guest);
    drawings_.watch(guests);
}

void GuestService::advanceQueue() {
    if (!isOpen()) return;
    const auto before = queue_.steering();
    if (queue_.pilot(queueNow_) == before) return;
    port_.steer(helm_ = {});
    tellAll();
}

// Of a phone that is silent nothing is held: its messages may be lost without the connection.
void GuestService::holdHelm() {
    if (helm_ == Steering{}) return;
    if (clock_() - helmHeard_ > kHelmHolds) helm_ = {};
    port_.steer(helm_);
}

// The three digits; while a turn ends, its last seconds.
void GuestService::showSign() {
    const double now = clock_();
    std::string characters = tokens_.digitsAt(now);
    bool isEnding = false;
    for (const GuestSeat& seat : queue_.seats()) {
        const double left = queue_.leftOf(seat, queueNow_);
        isEnding = isEnding || (queue_.steering() == seat.guest && left <= kCountdown);
        if (isEnding) characters = std::to_string(std::lround(std::ceil(left)));
        if (isEnding) break;
    }
    const std::string address = fmt::format("HTTP://{}:{}/P/{}",
                                            capitals(config::bracketed(options_.place.host)),
                                            options_.place.port,
                                            tokens_.wordAt(now));
    if (std::exchange(signText_, address + ' ' + characters) == signText_) return;
    port_.show(signOf(address, characters, isEnding));
}

void GuestService::keepNow() {
    if (keeps_.take(clock_()))
        keepSeats();
    else
        isKept_ = false;
}

void GuestService::keepSeats() {
    sessions_.keep(options_.seatFile, queue_, queueNow_);
    isKept_ = true;
}

void GuestService::tick() {
    const double now = clock_();
    if (isOpen()) queueNow_ += now - lastTick_;
    lastTick_ = now;
    advanceQueue();
    holdHelm();
    if (isOpen()) showSign();
    ++ticks_;
    if (ticks_ % kTicksATell == 0) {
        watchFish();
        tellAll();
    }
    if (!isKept_) keepSeats();
    if (ticks_ % kTicksAKeep != 0) return;
    if (options_.picture != nullptr && now - lookedAt_ < kLooks) options_.picture->ask();
    for (const GuestId& guest : sessions_.forget(now)) queue_.leave(guest, queueNow_);
    keepSeats();
}

void GuestService::tellAll() {
    for (Phone* const phone : phones_) tell(*phone);
}

// Of who is in line.
void GuestService::addPlace(const GuestId& guest, json& message) const {
    int place = 0;
    for (const GuestSeat& seat : queue_.seats()) {
        if (queue_.steering() != seat.guest) ++place;
        if (seat.guest != guest) continue;
        message["you"] = queue_.steering() == guest ? "steering" : "waiting";
        message["place"] = place;
        message["wait_s"] = std::lround(std::ceil(*queue_.waitOf(guest, queueNow_)));
        message["left_s"] = queue_.leftOf(seat, queueNow_);
    }
}

void GuestService::tell(Phone& phone) {
    if (!isOpen()) return say(phone, "state", {{"you", "closed"}});
    if (phone.guest.empty()) return say(phone, "state", {{"you", "stranger"}});
    const auto& seats = queue_.seats();
    json message{{"you", "guest"}, {"line", seats.size()}, {"most", VisitorQueue::kMostSeats}};
    message["wall"] = options_.picture != nullptr;
    message["feed_s"] =
        std::lround(std::ceil(std::max(sessions_.find(phone.guest)->mayFeed - clock_(), 0.0)));
    if (json drawings = drawings_.told(phone.guest, clock_()); !drawings.is_null())
        message["drawings"] = std::move(drawings);
    addPlace(phone.guest, message);
    say(phone, "state", message);
}

}  // namespace aquarama::guests
