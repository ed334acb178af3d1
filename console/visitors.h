// SPDX-License-Identifier: Apache-2.0
// The browsers that are connected: what each page shows, and what each is sent.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/ask/picture_hub.h"
#include "common/web/server.h"
#include "common/wire/messages.h"
#include "console/access.h"
#include "console/console.pb.h"
#include "console/state.h"

namespace aquarama::console {

// Of a WebSocket whose session has ended; from RFC 6455's private range, 4000 to 4999.
inline constexpr std::uint16_t kClosedUnpaired = 4001;
inline constexpr int kTicksASecond = 10;

// One browser (or program) that is connected.
struct Visitor {
    Holder holder;
    web::Outbox* outbox = nullptr;
    browser::Look look = {};
    int ticksToLook = 0;                       // until the look is forgotten
    std::map<int, int> picturesUnderWay = {};  // channel -> ticks until it is asked again
    bool hasHistory = false, hasPanorama = false;
    bool holdsScan = false;          // shows a pattern of a scan
    std::uint64_t sentDrawings = 0;  // version of the list
    std::string sentLog = {};
    int messages = 0;  // in this second
    int malformed = 0;

    // Whether its page shows this.
    [[nodiscard]] bool wants(const char* topic) const;
};

// Of the server's thread. A look, or a picture that nobody has confirmed, is forgotten after three
// seconds.
class Visitors {
  public:
    // `state` outlives this.
    explicit Visitors(State& state) : state_{state} {}
    // Whether pictures of sheets are read here, as pages are told.
    void readPictures(bool are) { readsPictures_ = are; }

    // Where pictures and fish are asked for; null: nowhere. `nodes` outlives the visitors.
    void watch(ask::NodeProxy* nodes) { nodes_ = nodes; }
    // A visitor comes, gets a whole snapshot before all else, and goes.
    void add(Visitor& visitor);
    void remove(Visitor& visitor);
    [[nodiscard]] std::size_t count() const { return visitors_.size(); }
    // Ends the connections of a session.
    void sendAway(const std::string& person);

    // Adds an event, and sends the list to everybody.
    void note(const std::string& who, const std::string& what);
    // What a page shows now; what is new in it is answered at once.
    void takeLook(Visitor& visitor, const browser::Look& look);
    // Of a place in a picture; the answer comes by heardFish().
    void askFish(Visitor& visitor, const browser::PointAt& at);
    void sendTopics(Visitor& visitor);
    // Under its topic: an older one that waits still is replaced.
    void sendTo(Visitor& visitor, const std::string& topic, const browser::ToBrowser& message);
    // The same to all pages of a session.
    void sendToPerson(const std::string& person,
                      const std::string& topic,
                      const browser::ToBrowser& message);

    // From a node: a picture, and the fish at a place. Returns the fish, whose mind is asked for.
    void heardPicture(const std::string& channel, const v1::FramePicture& picture);
    [[nodiscard]] std::optional<std::uint32_t> heardFish(const v1::FishReply& reply);
    void heardMind(const v1::Explanation& explanation);
    // Visitors' drawings are others: sends them to whose page shows them.
    void heardDrawings();

    // Ten times a second: forgets old looks, asks for pictures.
    void tick();
    // Once a second: closes who has lost its pairing, and sends each what its page shows.
    void everySecond();
    // With what the console itself knows of the wall. `refused`: requests, by console and server.
    void sendWall(std::uint64_t refused);
    // Whether somebody's page shows this topic.
    [[nodiscard]] bool isLookedAt(const char* topic) const;

  private:
    // What a channel was last asked for. `ticksToAsk`: until it is asked again.
    struct PictureState {
        int ticksToAsk = 0;
        std::uint64_t number = 0;
    };
    void sendLog(Visitor& visitor);
    void sendDoctor(Visitor& visitor);
    void sendHistory(Visitor& visitor);
    void sendHours(Visitor& visitor);
    void sendCalibrations(Visitor& visitor);
    void sendDrawings(Visitor& visitor);
    void sendPeople(Visitor& visitor);
    void sendMachines(Visitor& visitor);
    void sendTour(Visitor& visitor);
    void sendPanorama(Visitor& visitor);
    void sendToAll(const std::string& topic, const browser::ToBrowser& message);
    [[nodiscard]] browser::ToBrowser snapshotFor(const Visitor& visitor) const;
    [[nodiscard]] browser::AlertList alertList() const;
    // Passwords and text are the crew's alone.
    [[nodiscard]] browser::Hours hoursFor(const Visitor& visitor) const;
    [[nodiscard]] browser::People peopleFor(const Holder& holder) const;
    void askPictures();
    // The widest that somebody wants who has drawn the last one; 0: nobody.
    [[nodiscard]] std::uint32_t wantedWidth(int channel) const;
    // -1 where the rig has none of that name.
    [[nodiscard]] int channelIndexOf(const std::string& channel) const;
    [[nodiscard]] bool isWatched(const Visitor& visitor, int channel) const;

    State& state_;
    ask::NodeProxy* nodes_ = nullptr;
    std::set<Visitor*> visitors_;
    std::map<int, PictureState> pictures_;
    std::map<std::uint64_t, Visitor*> fishAsked_;  // by the number of the question
    std::uint64_t number_ = 0;                     // of questions to nodes
    bool readsPictures_ = false;
};

}  // namespace aquarama::console
