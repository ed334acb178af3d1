// SPDX-License-Identifier: Apache-2.0
// Drawings that phones send: who may, what becomes of each, and what its maker is told. Of the
// server's thread. Times in seconds of the caller's clock.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/ask/drawing_reader.h"
#include "common/web/server.h"
#include "guests/allowance.h"
#include "guests/deed.h"
#include "guests/sessions.h"
#include "guests/wall_link.h"

namespace aquarama::guests {

// Has a picture read. `done` hears once what became of it, from the server's thread. False: too
// many wait.
using ReadPicture =
    std::function<bool(std::string picture, std::function<void(const ask::DrawingOutcome&)> done)>;

// What is drawn here, and how it is read.
struct DrawingPlace {
    std::vector<std::string> species;  // of the rig
    ReadPicture read;                  // none: nothing is drawn here
};

// All drawings of a rig's visitors.
class VisitorDrawings {
  public:
    static constexpr double kBetween = 30;          // of one visitor
    static constexpr std::size_t kMostUploads = 8;  // at once

    // All outlive it.
    VisitorDrawings(DrawingPlace place, Sessions& sessions, VisitedWall& wall);

    // Of a request with a picture, before it is sent: whether it may be. Its target is
    // /drawing/left, /middle or /right, the side where its maker stands.
    [[nodiscard]] std::optional<web::BodyLimit> admit(const web::HttpRequest& head,
                                                      double now,
                                                      web::HttpReply& refusal);
    // Has the picture of an admitted request read.
    [[nodiscard]] web::HttpReply take(const web::HttpRequest& request);
    // Whether a request is for drawings.
    [[nodiscard]] static bool isMeant(const web::HttpRequest& request);

    // What the wall says.
    void heard(std::shared_ptr<const WallDrawings> drawings);
    void offered(std::uint64_t request, std::uint32_t number);
    void does(std::uint32_t fish, const FishDeed& deed);
    // Asks the wall for what the fish of these visitors do.
    void watch(const std::set<GuestId>& guests);

    // What a visitor's phone shows; null where nothing is drawn.
    [[nodiscard]] nlohmann::json told(const GuestId& guest, double now) const;

  private:
    [[nodiscard]] bool isOpen() const { return place_.read && wall_; }
    // Why a picture may not be sent: here, or by this visitor now. Of a good reply there is none.
    [[nodiscard]] web::HttpReply objectionTo(const web::HttpRequest& head) const;
    [[nodiscard]] web::HttpReply objectionTo(const Visit& visit, double now);
    // The visitor who sends a request; empty: nobody.
    [[nodiscard]] GuestId senderOf(const web::HttpRequest& request) const;
    [[nodiscard]] const WallDrawing* find(std::uint32_t number) const;
    [[nodiscard]] nlohmann::json toldOf(std::uint32_t number) const;
    void wasRead(const GuestId& guest, int aside, const ask::DrawingOutcome& outcome);
    void refuse(const GuestId& guest, const std::string& word);

    DrawingPlace place_;
    Sessions& sessions_;
    VisitedWall& port_;
    Allowance pictures_{8, 0.5};           // of all phones
    std::shared_ptr<const char> uploads_;  // held once for each that is under way
    std::shared_ptr<const WallDrawings> wall_;
    std::map<std::uint64_t, GuestId> offers_;  // without an answer
    std::set<std::uint32_t> fresh_;            // numbers that the wall has not listed yet
    std::map<std::uint32_t, FishDeed> deeds_;  // of fish that are watched
};

}  // namespace aquarama::guests
