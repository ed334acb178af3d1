// SPDX-License-Identifier: Apache-2.0
// The commands of people and programs: who may give which, how each is carried out, and the one
// book of what became of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "common/ask/drawing_reader.h"
#include "common/ask/order_book.h"
#include "common/config/hours.h"
#include "common/wire/messages.h"
#include "console/errands.h"
#include "console/show_link.h"
#include "console/state.h"
#include "console/visitors.h"

namespace aquarama::console {

// Has a picture of a sheet read, and hears on the server's thread what became of it. False: too
// many wait.
using ReadPicture =
    std::function<bool(std::string picture, std::function<void(const ask::DrawingOutcome&)> done)>;

// What the list of events says of a picture: "picture of scan_1.jpg", of a sheet where it has no
// name. One line of at most a hundred bytes, whatever the name has.
[[nodiscard]] std::string titleOfPicture(const std::string& fileName);

// Of the server's thread. Orders for the wall go to the master, whose answer comes by said(); all
// other commands are carried out here.
class Commands {
  public:
    // All that is referred to outlives this.
    Commands(State& state, Visitors& visitors, Errands& errands)
        : state_{state}, visitors_{visitors}, errands_{errands} {}

    // Sets the way to the master, which outlives the commands. No wall is heard before.
    void reach(MasterProxy* master) { master_ = master; }

    // Sets how pictures of sheets are read. Before, none is.
    void readBy(ReadPicture read) { read_ = std::move(read); }
    [[nodiscard]] bool readsPictures() const { return read_ != nullptr; }

    // Carries a command out, or begins it; said again, it is answered again. `visitor`: whose page
    // gives it; null: a program does.
    [[nodiscard]] v1::OrderReply carryOut(const Holder& holder,
                                          Visitor* visitor,
                                          const browser::Command& command);
    // What the master or an errand says of an order.
    void said(std::uint64_t request, const ask::Answer& answer);
    // What is known of a command; null: it is not known, or no longer.
    [[nodiscard]] const ask::Answer* answerTo(std::uint64_t id) const { return book_.find(id); }
    // Tells the wall what its hours want; one change at a time, as its end is waited for.
    void keepHours();
    // When the wall was closed for the day, ends the day of visitors' drawings.
    void keepDay();
    // Says the pattern of a scan again, as long as the page that asked for it is open.
    void keepScan();
    // The visitor goes. What it has asked for goes on, and is answered to nobody.
    void forget(const Visitor& visitor);

  private:
    using Command = browser::Command;
    // Who waits for the end of an order, and what it was, for the list of events.
    struct Waiting {
        Visitor* visitor = nullptr;  // null: nobody
        std::string who, what;
        bool isQuiet = false;     // noted only where it is refused
        std::string person = {};  // whose pages are told where there is no visitor
    };
    // A pattern of a scan, said to the master each second.
    struct ShownScan {
        Visitor* visitor = nullptr;  // null: none is shown
        std::uint64_t request = 0;   // of the command
        v1::HeldScan held;
    };
    // What the hours want, told to the wall and not done yet.
    struct Opened {
        std::uint64_t request = 0;
        config::WantedHours wanted;
    };

    // The answer to a command that ends here.
    [[nodiscard]] ask::Answer carryOutAllowed(const Holder& holder,
                                              Visitor* visitor,
                                              const Command& command);
    [[nodiscard]] ask::Answer passOn(const Holder& holder,
                                     Visitor* visitor,
                                     const Command& command);
    [[nodiscard]] ask::Answer tellWall(const Holder& holder,
                                       Visitor* visitor,
                                       const v1::Order& order);
    [[nodiscard]] ask::Answer showScan(const Holder& holder,
                                       Visitor* visitor,
                                       const Command& command);
    // The answer to a command that an errand carries out, one at a time; said() tells how it ended.
    // `what`: for the list of events.
    [[nodiscard]] ask::Answer awaitErrand(bool isBegun,
                                          const Holder& holder,
                                          Visitor* visitor,
                                          const Command& command,
                                          const std::string& what);
    [[nodiscard]] ask::Answer useKept(const Holder& holder,
                                      Visitor* visitor,
                                      const Command& command);
    [[nodiscard]] ask::Answer assignNode(const Holder& holder,
                                         Visitor* visitor,
                                         const Command& command);
    [[nodiscard]] ask::Answer changeRelease(const Holder& holder,
                                            Visitor* visitor,
                                            const Command& command);
    [[nodiscard]] ask::Answer confirmStep(const Holder& holder,
                                          Visitor* visitor,
                                          const Command& command);
    [[nodiscard]] ask::Answer readPicture(const Holder& holder,
                                          Visitor* visitor,
                                          const Command& command);
    // What the picture of this command shows is offered.
    void offer(std::uint64_t id, int aside, const ask::DrawingOutcome& outcome);
    // Each carries one out; why not, where it is refused.
    [[nodiscard]] std::string carryOutHere(const Holder& holder,
                                           Visitor* visitor,
                                           const Command& command);
    [[nodiscard]] std::string carryOutOfHall(const Holder& holder, const Command& command);
    [[nodiscard]] std::string acknowledge(const Holder& holder, const std::string& alert);
    [[nodiscard]] std::string takeHours(const Holder& holder,
                                        Visitor* visitor,
                                        const Command& command);
    [[nodiscard]] std::string switchMachine(const Holder& holder, const std::string& word);
    [[nodiscard]] std::string sendAway(const Holder& holder, const std::string& person);
    // The end of an order that the console itself has given, or of a scan. False: others wait for
    // it.
    bool saidOfOwn(std::uint64_t request, const ask::Answer& answer);
    void tell(const Waiting& who, std::uint64_t request, const ask::Answer& answer);
    void noteEnd(const Waiting& of, const ask::Answer& answer);
    void saidOfHours(const ask::Answer& answer);
    void saidOfDay(const ask::Answer& answer);

    State& state_;
    Visitors& visitors_;
    Errands& errands_;
    MasterProxy* master_ = nullptr;
    ReadPicture read_;
    ask::OrderBook book_;
    std::map<std::uint64_t, Waiting> waiting_;
    ShownScan scan_;
    std::optional<Opened> opened_;
    std::uint64_t dayEnd_ = 0;  // the order that ends the day; 0: none is under way
    const std::uint64_t holder_ = ask::freshRequest();  // of scans
};

}  // namespace aquarama::console
