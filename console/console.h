// SPDX-License-Identifier: Apache-2.0
// The operator's console: it listens to the show, answers requests, and does each second what is
// due: hours, alerts, the clock, the certificate.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/ask/drawing_reader.h"
#include "common/ask/picture_hub.h"
#include "common/ask/request_client.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/web/server.h"
#include "console/access.h"
#include "console/alerts.h"
#include "console/certificate.h"
#include "console/commands.h"
#include "console/console.pb.h"
#include "console/cues/dmx_desk.h"
#include "console/cues/osc_desk.h"
#include "console/drawing_folder.h"
#include "console/errands.h"
#include "console/gate.h"
#include "console/overview.h"
#include "console/show_link.h"
#include "console/state.h"
#include "console/touch/tracker_keeper.h"
#include "console/visitors.h"
#include "console/waiting_nodes.h"

namespace aquarama::console {

// How a console is set up.
struct ConsoleOptions {
    config::Rig rig;
    ask::AskedMaster master;     // of this rig, with the operator's key where it needs one
    std::string keyFolder = {};  // of the master's keys; empty: the rig's own
    std::string build;           // version and commit
    machine::ServiceNotifier* service = nullptr;  // hears of every second; null: nobody
    CertificateKeeper* certificate = nullptr;     // of the server; null: it is without TLS
    UnixSeconds built = 0;                        // no clock before that is right
};

// Holds no truth of the show: killed and started again, nothing changes on the wall. All functions
// are called by the server's thread.
class Console final : public web::Service {
  public:
    // Throws Error where what it keeps cannot be read.
    Console(const ConsoleOptions& options, Access& access);
    ~Console() override;
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    // Before the server runs: listens to master and nodes, and is reached by these doors. Throws
    // Error where it cannot.
    void begin(web::WebServer& server, Doors doors);
    // After the server has run, while it is there: listens no more.
    void end();

    [[nodiscard]] std::optional<web::BodyLimit> admit(const web::HttpRequest& head,
                                                      web::HttpReply& refusal) override;
    [[nodiscard]] web::HttpReply answer(const web::HttpRequest& request) override;
    [[nodiscard]] std::unique_ptr<Connection> open(const web::HttpRequest& request,
                                                   web::Outbox& outbox,
                                                   web::HttpReply& refusal) override;
    void tick() override;

    // What a visitor says; called by its connection.
    void hear(Visitor& visitor, const std::string& text);
    // Called when the connection ends; the visitor is destroyed after it.
    void forget(Visitor& visitor);

  private:
    // Requests (answer()).
    web::HttpReply act(const web::HttpRequest& request);
    web::HttpReply actAs(const web::HttpRequest& request);
    web::HttpReply pair(const web::HttpRequest& request);
    web::HttpReply leave(const web::HttpRequest& request);
    web::HttpReply look(const web::HttpRequest& request);
    [[nodiscard]] std::string metrics(UnixSeconds now) const;
    web::HttpReply bundle();  // all logs, for whoever helps from afar
    web::HttpReply obey(const web::HttpRequest& request, const Holder& holder);
    web::HttpReply takeOrder(const web::HttpRequest& request, const Holder& holder);
    // Of a sheet that a visitor has coloured.
    web::HttpReply takePicture(const web::HttpRequest& request, const Holder& holder);
    [[nodiscard]] web::HttpReply drawingAt(const web::HttpRequest& request) const;
    // Of a program, for the run that it names, else the one that is heard; an order gets a number
    // where it has none.
    v1::OrderReply giveOrder(const Holder& holder, const v1::Order& order);
    web::HttpReply refused(int status, const std::string& why);
    // In the log: a code for the first browser.
    void showCode(ConsoleRole role);

    // From the other threads, on the server's.
    void heardWall(const browser::Wall& wall);
    void wallIsSilent(const std::string& preparing);
    void heardDrawings(const v1::DrawingsReply& reply);

    // What is due.
    void everySecond();
    // Where the rig has drawings: reads pictures of sheets, also those of its folder.
    void beginDrawings();
    void askForSkin();
    [[nodiscard]] bool takesDrawings() const;
    void watchClock(UnixSeconds now);
    // Listens to the rig's desks, where that is not done yet.
    void listenToDesk();
    void hearDesks();
    void tendCertificate(UnixSeconds now);
    // Of the wall, and of this machine's clock and certificate.
    [[nodiscard]] std::vector<Fault> faultsNow(UnixSeconds now) const;
    [[nodiscard]] std::string problemOfDrawings() const;

    ConsoleOptions options_;
    State state_;
    Visitors visitors_;
    Errands errands_;
    Commands commands_;
    TrackerKeeper tracker_;
    NodeSearch search_;
    Doors doors_;
    web::WebServer* server_ = nullptr;
    ProjectorBook projectorBook_;
    FaderWatch faders_;
    int ticks_ = 0;
    // When the clocks were last looked at: the system's, and one that nobody sets.
    UnixSeconds lastSecond_ = 0;
    std::chrono::steady_clock::time_point lastLook_;
    std::unique_ptr<OscDesk> desk_;               // null: the rig has none, or it cannot be heard
    std::string deskProblem_;                     // why not
    std::unique_ptr<DmxDesk> dmx_;                // null: the rig has none
    std::unique_ptr<ask::DrawingReader> reader_;  // of pictures of sheets; as desk_
    std::unique_ptr<DrawingFolder> folder_;       // as desk_
    std::unique_ptr<ask::PictureHub> hub_;
    std::unique_ptr<ShowLink> link_;  // last: their threads use all of the above
};

}  // namespace aquarama::console
