// SPDX-License-Identifier: Apache-2.0
// Projectors by PJLink, class 1 (JBMIA): what they say is read within bounds, and one that is
// silent or odd is a state, never an error.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/config/hours.h"

namespace aquarama::console {

// The longest line of PJLink, with its end.
inline constexpr std::size_t kMostPjlinkBytes = 136;

// The first line of a projector: whether it wants a password, and the random number for it.
struct PjlinkGreeting {
    bool wantsPassword = false;
    bool refuses = false;  // the password was wrong
    std::string salt;
};
[[nodiscard]] std::optional<PjlinkGreeting> readGreeting(const std::string& line);
// What goes before the first command: MD5 of salt and password.
[[nodiscard]] std::string pjlinkProof(const std::string& salt, const std::string& password);

// The answer to a command, as "POWR": its value ("1", "OK", "ERR3"). Empty where it is none.
[[nodiscard]] std::optional<std::string> readPjlinkAnswer(const std::string& line,
                                                          const std::string& command);

// What is known of a projector.
struct ProjectorFacts {
    std::string power = "no answer";  // on, off, warming, cooling, refuses the password, not now
    bool isShut = false;
    std::vector<std::string> problems;  // "lamp: warning"
    std::uint32_t lampHours = 0;
    friend bool operator==(const ProjectorFacts&, const ProjectorFacts&) = default;
};
// "100002": fan, lamp, temperature, cover, filter, other; 1 warns, 2 fails.
[[nodiscard]] std::vector<std::string> problemsIn(const std::string& digits);

// One connection: the commands one after another ("POWR ?"), and the value of each; those that were
// not answered are empty. Closed afterwards, as some projectors take one connection only. Takes at
// most `patience` for each line.
struct PjlinkAnswers {
    bool isThere = false;
    bool refusesPassword = false;
    std::vector<std::string> values;
};
[[nodiscard]] PjlinkAnswers askProjector(const config::ControlledProjector& projector,
                                         const std::vector<std::string>& commands,
                                         std::chrono::milliseconds patience);
// All that is asked of one at a look.
[[nodiscard]] ProjectorFacts lookAtProjector(const config::ControlledProjector& projector,
                                             std::chrono::milliseconds patience);

// Looks at a projector every twenty seconds, and switches it to what is wanted, on a thread of its
// own.
class ProjectorWatch {
  public:
    explicit ProjectorWatch(config::ControlledProjector projector);
    ~ProjectorWatch();
    ProjectorWatch(const ProjectorWatch&) = delete;
    ProjectorWatch& operator=(const ProjectorWatch&) = delete;

    // Wanted values: said again until the projector has them.
    void want(std::optional<bool> power, std::optional<bool> shut);
    [[nodiscard]] ProjectorFacts facts() const;
    [[nodiscard]] const std::string& name() const { return projector_.name; }

  private:
    // The thread: it ends soon after ended_ is set.
    void run();
    // Sends what brings the projector to what is wanted.
    void press(const ProjectorFacts& facts);

    config::ControlledProjector projector_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    bool isNew_ = false;
    ProjectorFacts facts_;
    std::optional<bool> power_, shut_;  // wanted
    std::thread thread_;
};

}  // namespace aquarama::console
