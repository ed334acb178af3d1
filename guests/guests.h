// SPDX-License-Identifier: Apache-2.0
// What the phones of visitors are served: a page, and a WebSocket by which one of them steers and
// all feed the fish. Of the server's thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/web/pages.h"
#include "common/web/server.h"
#include "guests/allowance.h"
#include "guests/queue.h"
#include "guests/sessions.h"
#include "guests/token.h"
#include "guests/visitor_drawings.h"
#include "guests/wall_link.h"
#include "guests/wall_picture.h"

namespace aquarama::guests {

// The files of ./pages.
[[nodiscard]] std::span<const web::EmbeddedPage> embeddedPages();

// Codes by which a WebSocket is closed; guests.js knows them.
inline constexpr std::uint16_t kClosedElsewhere = 4001;  // the visitor has another page open
inline constexpr std::uint16_t kClosedTooMuch = 4002;    // it said too much, or guessed too often

// What a service is made of.
struct GuestsOptions {
    config::Guests place;
    DoorTokens::Key key;
    std::filesystem::path seatFile;  // what survives a restart
    QueueTimes times = {};
    DrawingPlace drawings = {};
    WallPicture* picture = nullptr;  // null: phones are shown none; outlives the service
};

// One connected phone.
class Phone final : public web::Service::Connection {
  public:
    Phone(class GuestService& service, web::Outbox& outbox);
    ~Phone() override;
    Phone(const Phone&) = delete;
    Phone& operator=(const Phone&) = delete;
    void hear(const std::string& text) override;

    web::Outbox& outbox;
    GuestId guest = {};          // empty: not let in yet
    Allowance messages{80, 40};  // what it may say
    int wrong = 0;               // digits that it guessed

  private:
    GuestService& service_;
};

// Serves one rig's visitors.
class GuestService final : public web::Service {
  public:
    static constexpr std::size_t kMostPhones = 600;

    // `clock`: seconds that only go on. Both outlive it.
    GuestService(GuestsOptions options, VisitedWall& wall, std::function<double()> clock);
    // Keeps the seats for the next run.
    ~GuestService() override;

    [[nodiscard]] std::optional<web::BodyLimit> admit(const web::HttpRequest& head,
                                                      web::HttpReply& refusal) override;
    [[nodiscard]] web::HttpReply answer(const web::HttpRequest& request) override;
    [[nodiscard]] std::unique_ptr<Connection> open(const web::HttpRequest& request,
                                                   web::Outbox& outbox,
                                                   web::HttpReply& refusal) override;
    void tick() override;
    // What the wall says; nothing: it does not answer.
    void heard(const std::optional<WallState>& wall);
    // What became of a drawing, and what a fish does (WallListener).
    void offered(std::uint64_t request, std::uint32_t number);
    void does(std::uint32_t fish, const FishDeed& deed) { drawings_.does(fish, deed); }

  private:
    friend class Phone;
    void hear(Phone& phone, const std::string& text);
    void enter(Phone& phone, const std::string& code);
    void resume(Phone& phone, const std::string& secret);
    void welcome(Phone& phone, const GuestId& guest);
    void steer(const Phone& phone, const Steering& steering);
    // In the direction of a place of the wall's picture, as shares of its size; nothing: ahead.
    void feed(Phone& phone, const std::optional<glm::vec2>& place);
    [[nodiscard]] web::HttpReply picture(const std::string& target);
    void gone(Phone& phone);
    [[nodiscard]] bool isOurs(const web::HttpRequest& request) const;
    [[nodiscard]] bool acceptsCode(Phone& phone, const std::string& code);
    [[nodiscard]] bool isOpen() const { return wall_ && wall_->isOpen; }
    // Who steers may have changed: the helm rests, and the phones are told.
    void advanceQueue();
    void holdHelm();
    void showSign();
    // At once, so that a phone is never told of what a killed program forgets; of a flood, at the
    // next tick.
    void keepNow();
    void keepSeats();
    void watchFish();
    void addPlace(const GuestId& guest, nlohmann::json& message) const;
    void tell(Phone& phone);
    void tellAll();

    GuestsOptions options_;
    VisitedWall& port_;
    std::function<double()> clock_;
    std::vector<std::string> hosts_;  // what a Host header may name
    DoorTokens tokens_;
    Sessions sessions_;
    VisitorDrawings drawings_;
    VisitorQueue queue_;
    double queueNow_ = 0;  // seconds for which the wall was open: turns rest while it is not
    double lastTick_ = 0;
    std::uint64_t ticks_ = 0;
    double lookedAt_ = 0;  // when a phone last asked for the wall's picture
    std::optional<WallState> wall_;
    std::set<Phone*> phones_;
    Steering helm_;
    double helmHeard_ = 0;
    std::string signText_;        // what the sign was made of
    Allowance entries_{40, 20};   // joins of all phones
    Allowance guesses_{10, 0.5};  // digits of all phones
    Allowance pellets_{2, 2};
    Allowance keeps_{50, 50};  // of seats, beside those of ticks
    bool isKept_ = true;       // all that phones were told of
    std::minstd_rand random_{std::random_device{}()};
};

}  // namespace aquarama::guests
