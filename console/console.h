// SPDX-License-Identifier: Apache-2.0
// The operator's console: what browsers see of a show, and what they may ask of it.
#pragma once

#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/ask/request_client.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "console/access.h"
#include "console/alerts.h"
#include "console/certificate.h"
#include "console/console.pb.h"
#include "console/files_of_show.h"
#include "console/gate.h"
#include "console/opening.h"
#include "console/overview.h"
#include "console/panorama.h"
#include "console/picture_hub.h"
#include "console/show_link.h"
#include "console/web/server.h"

namespace aquarama::console {

struct ConsoleOptions {
    config::Rig rig;
    ask::AskedMaster master;     // of this rig, with the operator's key where it needs one
    std::string keyFolder = {};  // of the master's keys; empty: the rig's own
    std::string build;           // version and commit
    machine::ServiceNotifier* service = nullptr;  // hears of every second; null: nobody
    CertificateKeeper* certificate = nullptr;     // of the server; null: it is without TLS
    UnixSeconds built = 0;                        // no clock before that is right
};

// Of a WebSocket whose session has ended; from RFC 6455's private range, 4000 to 4999.
inline constexpr std::uint16_t kClosedUnpaired = 4001;

// Holds no truth of the show: killed and started again, nothing changes on the wall. All functions
// are called by the server's thread.
class Console final : public web::Service {
  public:
    // Throws Error where what it keeps cannot be read.
    Console(ConsoleOptions options, Access& access);
    ~Console() override;
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    // Before the server runs: listens to master and nodes, and is reached by these doors. Throws
    // Error where it cannot.
    void begin(web::WebServer& server, Doors doors);
    // After the server has run, while it is there: listens no more.
    void end();

    [[nodiscard]] web::HttpReply answer(const web::HttpRequest& request) override;
    [[nodiscard]] std::unique_ptr<Connection> open(const web::HttpRequest& request,
                                                   web::Outbox& outbox,
                                                   web::HttpReply& refusal) override;
    void tick() override;

    // One browser (or program) that is connected.
    struct Visitor {
        Holder holder;
        web::Outbox* outbox = nullptr;
        browser::Look look = {};
        int ticksToLook = 0;                       // until the look is forgotten
        std::map<int, int> picturesUnderWay = {};  // channel -> ticks until it is asked again
        bool hasHistory = false, hasPanorama = false;
        std::string sentLog = {};
        int messages = 0;  // in this second
        int malformed = 0;

        // Whether its page shows this.
        [[nodiscard]] bool wants(const char* topic) const;
    };
    // What a visitor says; called by its connection.
    void hear(Visitor& visitor, const std::string& text);
    // Called when the connection ends; the visitor is destroyed after it.
    void forget(Visitor& visitor);

  private:
    using Command = browser::Command;
    static constexpr int kTicksASecond = 10;
    // A look, or a picture that nobody has confirmed, is forgotten after three seconds.
    static constexpr int kTicksOfALook = 3 * kTicksASecond;
    // A command that the master has not answered yet.
    struct Pending {
        Visitor* visitor = nullptr;  // null: has gone
        std::string who, what;
    };
    // A pattern of a scan, said to the master each second while the page of `visitor` is open.
    struct ShownScan {
        Visitor* visitor = nullptr;  // null: none is shown
        std::uint64_t id = 0;        // of the command
        v1::HeldScan held;
    };
    // What a channel was last asked for. `ticksToAsk`: until it is asked again.
    struct PictureState {
        int ticksToAsk = 0;
        std::uint64_t number = 0;
    };

    // Requests (answer()).
    web::HttpReply act(const web::HttpRequest& request);
    web::HttpReply pair(const web::HttpRequest& request);
    web::HttpReply leave(const web::HttpRequest& request);
    web::HttpReply look(const web::HttpRequest& request);
    [[nodiscard]] std::string ownMetrics(UnixSeconds now) const;
    web::HttpReply obey(const web::HttpRequest& request, const Holder& holder);
    web::HttpReply refused(int status, const std::string& why);
    // In the log: a code for the first browser.
    void showCode(ConsoleRole role);

    // Commands.
    [[nodiscard]] browser::Done carryOut(const Holder& holder,
                                         Visitor* visitor,
                                         const Command& command);
    [[nodiscard]] browser::Done carryOutAllowed(const Holder& holder,
                                                Visitor* visitor,
                                                const Command& command);
    [[nodiscard]] browser::Done carryOutHere(const Holder& holder,
                                             Visitor* visitor,
                                             const Command& command);
    [[nodiscard]] browser::Done tellWall(const Holder& holder,
                                         Visitor* visitor,
                                         const Command& command,
                                         const v1::Order& order);
    // Each carries one out; why not, where it is refused.
    [[nodiscard]] std::string acknowledge(const Holder& holder, const std::string& alert);
    [[nodiscard]] std::string carryOutOfHall(const Holder& holder, const Command& command);
    [[nodiscard]] std::string takeHours(const Holder& holder, const std::string& text);
    [[nodiscard]] std::string switchMachine(const Holder& holder, const std::string& word);
    [[nodiscard]] std::string sendAway(const Holder& holder, const std::string& person);
    [[nodiscard]] browser::Done useKept(const Holder& holder,
                                        Visitor* visitor,
                                        const Command& command);
    [[nodiscard]] browser::Done showScan(const Holder& holder,
                                         Visitor* visitor,
                                         const Command& command);
    void askFish(Visitor* visitor, const browser::PointAt& at);
    void runDoctor();
    [[nodiscard]] browser::Done settle(std::uint64_t id,
                                       const std::string& outcome,
                                       const std::string& why);
    // Adds an event and sends the list to everybody.
    void note(const std::string& who, const std::string& what);

    // From the other threads, on the server's.
    void heardWall(const browser::Wall& wall);
    void wallIsSilent(const std::string& preparing);
    void saidOfSet(std::uint64_t id, const std::string& outcome, const std::string& why);
    void saidOfHours(const std::string& outcome, const std::string& why);
    void heardPicture(const std::string& channel, const v1::FramePicture& picture);
    void heardFish(const std::string& channel, const v1::FishReply& reply);
    void heardMind(const v1::Explanation& explanation);

    // Ten times a second or less.
    void askPictures();
    // Tells the wall what its hours want.
    void keepHours();
    [[nodiscard]] std::uint32_t wantedWidth(int channel) const;
    void everySecond();
    // Closes who has lost its pairing, and sends each what its page shows.
    void tendVisitors();
    void hearDoctor();
    void hearCalibrations();
    void keepScan();
    void watchClock(UnixSeconds now);
    void tendCertificate(UnixSeconds now);
    // Of the wall, and of this machine's clock and certificate.
    [[nodiscard]] std::vector<Fault> faultsNow(UnixSeconds now) const;
    void sendWall();
    // What its page shows now, beside the wall.
    void sendTopics(Visitor& visitor);
    void sendLog(Visitor& visitor);
    void sendDoctor(Visitor& visitor);
    void sendHistory(Visitor& visitor, bool isAll);
    void sendWholeHistory(Visitor& visitor);
    void sendHours(Visitor& visitor);
    void sendCalibrations(Visitor& visitor);
    void sendPeople(Visitor& visitor);
    void sendPanorama(Visitor& visitor);
    void takeLook(Visitor& visitor, const browser::Look& look);
    void sendTo(Visitor& visitor, const std::string& topic, const browser::ToBrowser& message);
    void sendToAll(const std::string& topic, const browser::ToBrowser& message);
    [[nodiscard]] browser::ToBrowser snapshotFor(const Visitor& visitor) const;
    [[nodiscard]] browser::AlertList alertList() const;
    // Passwords and text are the crew's alone.
    [[nodiscard]] browser::Hours hoursFor(const Visitor& visitor) const;
    [[nodiscard]] browser::People peopleFor(const Holder& holder) const;
    [[nodiscard]] int channelIndexOf(const std::string& channel) const;
    [[nodiscard]] bool isWatched(const Visitor& visitor, int channel) const;

    ConsoleOptions options_;
    Access& access_;
    Doors doors_;
    web::WebServer* server_ = nullptr;
    EventBook events_;
    Opening opening_;
    std::optional<config::WantedHours> beingOpened_;  // told to the wall, not done yet
    std::uint64_t openingId_ = 0;
    Alerts alerts_;
    ProjectorBook projectorBook_;
    FigureRings figures_;
    PanoramaWatch panorama_;
    browser::Wall wall_;
    browser::DoctorReport doctor_;
    std::future<browser::DoctorReport> doctorRun_;
    std::optional<browser::Calibrations> calibrations_;  // as they were last read
    int calibrationsDue_ = 0;                            // tick at which they are read again
    std::future<browser::Calibrations> calibrationsRead_;
    std::future<std::string> calibrationUse_;  // why it was refused
    std::uint64_t calibrationUseId_ = 0;       // of the command
    ShownScan scan_;
    std::string code_;  // the last pairing code that somebody asked for in a page
    std::set<Visitor*> visitors_;
    std::map<std::uint64_t, Pending> pending_;
    // The last answers: a command that is repeated is not carried out twice.
    std::deque<browser::Done> settled_;
    std::map<int, PictureState> pictures_;
    // By the number of the question.
    std::map<std::uint64_t, Visitor*> fishAsked_;
    browser::Mind mind_;
    std::uint64_t number_ = 0;                               // of questions to nodes
    const std::uint64_t holder_ = ask::freshRequest() | 1U;  // of scans; never 0
    std::uint64_t refused_ = 0;
    int ticks_ = 0;
    // When the clocks were last looked at: the system's, and one that nobody sets.
    UnixSeconds lastSecond_ = 0;
    std::chrono::steady_clock::time_point lastLook_;
    std::string doubtOfClock_;  // empty: it may be right
    std::unique_ptr<PictureHub> hub_;
    std::unique_ptr<ShowLink> link_;  // last: their threads use all of the above
};

}  // namespace aquarama::console
