// SPDX-License-Identifier: Apache-2.0
// A projector that the hours switch: what is known of it, what is wanted of it, and what to ask or
// command next. What it does not tell is unknown, and is never taken for on, off, open or shut.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/config/hours.h"
#include "console/projectors/pjlink.h"

namespace aquarama::console {

// Whether it answers at all; apart from whether it is on.
enum class ProjectorReach : std::uint8_t {
    NotAsked,
    Answers,
    NoAnswer,
    RefusesPassword,
    WantsPassword  // and the hours have none
};
enum class LampPower : std::uint8_t { Unknown, Off, On, Cooling, Warming };
// As pages and events have them: "no answer", "warming".
[[nodiscard]] const char* nameOf(ProjectorReach reach);
[[nodiscard]] const char* nameOf(LampPower power);

// What is known of a projector. Empty: unknown.
struct ProjectorFacts {
    ProjectorReach reach = ProjectorReach::NotAsked;
    LampPower power = LampPower::Unknown;
    std::optional<bool> isShut = {};
    std::optional<std::string> input = {};  // "31"; asked where the hours name one
    std::optional<std::uint32_t> lampHours = {};
    std::optional<bool> wantedPower = {};    // of hours or people; empty: it is left as it is
    bool areProblemsKnown = false;           // it tells whether it has any
    std::vector<std::string> problems = {};  // "lamp: warning", "shutter: failure"
    friend bool operator==(const ProjectorFacts&, const ProjectorFacts&) = default;
};

// What to do next: a command, or nothing before `until`.
struct ProjectorStep {
    std::string command = {};  // "%1POWR ?"; empty: rest
    double until = 0;          // of a rest
};

// A value without clock and socket: times are seconds of any clock that never goes back. Next() and
// heard() are called in turn, want() between them at any time.
class ProjectorControl {
  public:
    // `input`: as INPT takes it; empty: left as it is.
    explicit ProjectorControl(std::string input = {}, bool hasPassword = false);

    // Wanted values: said to the projector until it has them. What is empty stays as it was.
    void want(std::optional<bool> power, std::optional<bool> shut);
    // Nothing is wanted any more: people work on it.
    void release();
    [[nodiscard]] ProjectorStep next(double now) const;
    void heard(const std::string& command, const PjlinkReply& reply, double now);
    [[nodiscard]] const ProjectorFacts& facts() const { return facts_; }

  private:
    enum Item : std::uint8_t { Power, Shutter, Input, Errors, Lamp };
    static constexpr std::size_t kItems = 5;
    // How often a wanted value was said since it was last wanted, or since it last held.
    struct Wish {
        int sent = 0;
        int taken = 0;         // of these were answered by OK
        double notBefore = 0;  // when it may be said again
    };
    using Query = std::pair<Item, double>;  // which, and when it is due

    // Whether something is wanted otherwise than it is known to be, and can be set now.
    [[nodiscard]] bool isPowerNeeded() const;
    [[nodiscard]] bool isShutterNeeded() const;
    [[nodiscard]] bool isInputNeeded() const;
    [[nodiscard]] bool mayHavePicture() const;
    [[nodiscard]] bool isNeeded(Item item) const;
    [[nodiscard]] std::vector<Item> needed() const;
    [[nodiscard]] bool isUnknown(Item item) const;
    [[nodiscard]] bool hasPictureToAsk(Item item) const;
    [[nodiscard]] bool isQueryDue(Item item, double now) const;
    [[nodiscard]] bool isWished(Item item) const;
    [[nodiscard]] bool isChanging() const;
    // As PJLink has them: "%1AVMT 31", "%1AVMT ?".
    [[nodiscard]] std::string commandOf(Item item) const;
    [[nodiscard]] std::string queryOf(Item item) const;
    [[nodiscard]] Query nextQuery() const;
    [[nodiscard]] bool isAsked(Item item) const;

    // What an exchange has brought; each keeps when it is asked or said again.
    void isOutOfReach(ProjectorReach reach, double now);
    void heardState(Item item, const std::string& value, double now);
    void takeState(Item item, const std::string& value, double now);
    void takePower(const std::string& value, double now);
    void settlePower(double now);
    void takeShutter(std::optional<bool> isShut);
    void takeInput(const std::string& value);
    void toldPower(bool isOk, double now);
    void noteAnswer(bool isAnswered, double now);
    void keepOutcome(Item item, const std::string& value, double now);
    [[nodiscard]] ProjectorReach reachOf(PjlinkEnd end) const;
    [[nodiscard]] double intervalOf(Item item, const std::string& value) const;
    void heardOutcome(Item item, const std::string& command, const std::string& value, double now);
    void refused(Item item, double now);
    void beginWishes();
    void beginPicture(double now);
    void showProblems();
    [[nodiscard]] double lookInterval() const;

    std::string input_;
    bool hasPassword_;
    std::optional<bool> power_, shut_;  // wanted
    std::array<Wish, 3> wishes_ = {};   // of Power, Shutter, Input
    std::array<double, kItems> due_ = {};
    ProjectorFacts facts_;
    std::optional<std::vector<std::string>> told_;  // its own problems; empty: unknown
    std::map<Item, std::string> refusals_;          // what it cannot do
    std::array<bool, kItems> isBroken_ = {};        // answered by ERR4
    bool isInputSet_ = false;                       // since it came on
    bool pictureOnly_ = false;                      // it mutes the picture alone: AVMT 11 for 31
    bool isThere_ = false;                          // it greeted at the last exchange
    int failures_ = 0;                              // one after another
    LampPower lastPower_ = LampPower::Unknown;      // the last that was known
    std::string saidPower_;                         // as it last answered
    double powerSince_ = 0;                         // since when it says so
    double answeredAt_ = 0, restUntil_ = 0;
};

// What the opening switches; tests have pretended ones.
class SwitchedProjector {
  public:
    SwitchedProjector() = default;
    virtual ~SwitchedProjector() = default;
    SwitchedProjector(const SwitchedProjector&) = delete;
    SwitchedProjector& operator=(const SwitchedProjector&) = delete;
    // As those of ProjectorControl.
    virtual void want(std::optional<bool> power, std::optional<bool> shut) = 0;
    virtual void release() = 0;
    [[nodiscard]] virtual ProjectorFacts facts() const = 0;
};

// A real one, on a thread of its own. It ends within milliseconds, whatever the projector does.
class ProjectorWatch final : public SwitchedProjector {
  public:
    explicit ProjectorWatch(const config::ControlledProjector& projector,
                            PjlinkPatience patience = {});
    ~ProjectorWatch() override;

    void want(std::optional<bool> power, std::optional<bool> shut) override;
    void release() override;
    [[nodiscard]] ProjectorFacts facts() const override;

  private:
    // The thread.
    void run();

    PjlinkConnection connection_;
    mutable std::mutex mutex_;  // of what follows
    std::condition_variable changed_;
    bool ended_ = false;
    bool isNew_ = false;
    ProjectorControl control_;
    std::thread thread_;
};

}  // namespace aquarama::console
