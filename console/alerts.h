// SPDX-License-Identifier: Apache-2.0
// What somebody has to look at: faults that last, kept until a person has acknowledged them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "console/access.h"

namespace aquarama::console {

// Something that is wrong now. It becomes an alert when it has lasted this long.
struct Fault {
    std::string key;  // the same fault has the same
    std::string text;
    double lastsSeconds = 0;
};

// An alert: it fires, and stays when the fault is over until somebody has acknowledged it.
struct StandingAlert {
    std::string key, text;
    UnixSeconds since = 0;
    bool isOver = false;
    bool isAcknowledged = false;
};

// A value without clock. Where the times that it is told jump, somebody has set the clock: what has
// lasted goes on to last, and began as long before the new time.
class Alerts {
  public:
    // The faults that there are now. Quiet: the wall is off on purpose, and nothing new fires.
    // Returns a line for each that begins or ends.
    std::vector<std::string> update(const std::vector<Fault>& faults,
                                    UnixSeconds now,
                                    bool isQuiet = false);
    // False where there is no such alert.
    bool acknowledge(const std::string& key);
    [[nodiscard]] const std::vector<StandingAlert>& standing() const { return standing_; }

  private:
    void follow(UnixSeconds now);

    std::optional<UnixSeconds> last_;
    // Since when each fault that is there now has lasted.
    std::map<std::string, UnixSeconds> pending_;
    std::vector<StandingAlert> standing_;
};

}  // namespace aquarama::console
