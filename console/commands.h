// SPDX-License-Identifier: Apache-2.0
// The commands of people and programs: who may give which, how each is carried out, and the one
// book of what became of them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/ask/order_book.h"
#include "common/config/hours.h"
#include "common/wire/messages.h"
#include "console/errands.h"
#include "console/show_link.h"
#include "console/state.h"
#include "console/visitors.h"

namespace aquarama::console {

// Of the server's thread. Orders for the wall go to the master, whose answer comes by said(); all
// other commands are carried out here.
class Commands {
  public:
    // All that is referred to outlives this.
    Commands(State& state, Visitors& visitors, Errands& errands)
        : state_{state}, visitors_{visitors}, errands_{errands} {}

    // Sets the way to the master, which outlives the commands. No wall is heard before.
    void reach(MasterProxy* master) { master_ = master; }

    // Carries a command out, or begins it; said again, it is answered again. `visitor`: whose page
    // gives it; null: a program does.
    [[nodiscard]] v1::OrderReply carryOut(const Holder& holder,
                                          Visitor* visitor,
                                          const browser::Command& command);
    // What the master or an errand says of an order.
    void said(std::uint64_t request, const ask::Answer& answer);
    // Tells the wall what its hours want; one change at a time, as its end is waited for.
    void keepHours();
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
        bool isQuiet = false;  // noted only where it is refused
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
    [[nodiscard]] ask::Answer tellWall(const Holder& holder,
                                       Visitor* visitor,
                                       const v1::Order& order);
    [[nodiscard]] ask::Answer showScan(const Holder& holder,
                                       Visitor* visitor,
                                       const Command& command);
    [[nodiscard]] ask::Answer useKept(const Holder& holder,
                                      Visitor* visitor,
                                      const Command& command);
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
    void saidOfHours(const ask::Answer& answer);

    State& state_;
    Visitors& visitors_;
    Errands& errands_;
    MasterProxy* master_ = nullptr;
    ask::OrderBook book_;
    std::map<std::uint64_t, Waiting> waiting_;
    ShownScan scan_;
    std::optional<Opened> opened_;
    const std::uint64_t holder_ = ask::freshRequest();  // of scans
};

}  // namespace aquarama::console
