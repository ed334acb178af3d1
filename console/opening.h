// SPDX-License-Identifier: Apache-2.0
// Opens and closes the wall by its hours: what is wanted now against what was last brought about,
// and the projectors that go with it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/hours.h"
#include "common/machine/machine_power.h"
#include "console/access.h"
#include "console/console.pb.h"
#include "console/projectors/projector.h"

namespace aquarama::console {

// Keeps the hours of a rig in its state folder. One thread uses it.
class Opening {
  public:
    // Makes the control of one projector; replaced in tests.
    using MakeProjector =
        std::function<std::unique_ptr<SwitchedProjector>(const config::ControlledProjector&)>;
    // A file that cannot be read is logged, and there are no hours; hours() says why.
    // `make`: what switches a projector; tests have pretended ones. `batteryMark`: a file that is
    // there while the hall runs on battery: then nothing opens, and projectors are off. Empty:
    // none.
    explicit Opening(std::filesystem::path folder,
                     MakeProjector make = {},
                     std::filesystem::path batteryMark = machine::batteryMark());

    // Takes another text and keeps it; empty: no hours any more. Throws Error, as parseHours().
    void setText(const std::string& text);
    // Takes the message of a form and keeps it as a text. Throws Error, as parseHours().
    void setForm(const v1::Hours& form);
    // The schedule rests for so long, ten hours at most; 0: it goes on.
    void hold(double forHours, UnixSeconds now);
    [[nodiscard]] UnixSeconds heldUntil(UnixSeconds now) const;

    // What the wall is to be told now, if anything: asked every second, answered until done() was
    // called with it. What an operator sets meanwhile holds until the hours want something else.
    [[nodiscard]] std::optional<config::WantedHours> due(UnixSeconds now) const;
    void done(const config::WantedHours& wanted, UnixSeconds now);
    // Whether the wall was closed for the day, and dayEnded() was not called since. An opening
    // within four hours goes on with the same day.
    [[nodiscard]] bool isDayToEnd() const { return isDayToEnd_; }
    void dayEnded();
    // Whether the hall runs on battery.
    [[nodiscard]] bool isOnBattery() const;
    // Whether the wall is off on purpose.
    [[nodiscard]] bool isClosed(UnixSeconds now) const;

    // Every second: projectors on three minutes before, their shutters open together when the wall
    // is in step, for as long as it is open, and off when it has been made black.
    void switchProjectors(UnixSeconds now, bool isWallInStep);
    // Of one, or of all where the name is empty; false where there is none of that name.
    bool setProjector(const browser::ProjectorCommand& command);

    // Why there are no hours although there is a text; empty: there is none, or it is read.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] browser::Hours hours(UnixSeconds now) const;
    [[nodiscard]] browser::ProjectorList projectors() const;

  private:
    [[nodiscard]] config::WantedHours wantedIn(UnixSeconds now) const;
    void findNextChange();  // after doneAt_
    void watchProjectors();
    [[nodiscard]] bool opensAgainSoon(UnixSeconds now) const;
    [[nodiscard]] bool isLampWanted(UnixSeconds now) const;
    // Of the lamps and shutters of all projectors together.
    [[nodiscard]] bool mayOpenShutters(UnixSeconds now, bool isWallInStep) const;
    [[nodiscard]] bool isOpenAlready() const;
    [[nodiscard]] bool isFirstLook(UnixSeconds now) const;
    void keep() const;
    void readHours();
    void readDone();
    void rest();
    void noteOpening(UnixSeconds now);
    void tellProjectors(bool power, std::optional<bool> shut);

    std::filesystem::path folder_;
    MakeProjector make_;
    std::filesystem::path batteryMark_;
    std::string text_;
    std::string problem_;  // why there are no hours although there is a text
    v1::Hours form_;       // the message of the text, where there are hours
    std::optional<config::Hours> hours_;
    std::optional<config::WantedHours> done_;  // what was last brought about
    UnixSeconds doneAt_ = 0;                   // 0: not known
    UnixSeconds holdsUntil_ = 0;  // the first change of the hours after that; 0: none is known
    bool isDayToEnd_ = false;
    UnixSeconds heldUntil_ = 0;
    UnixSeconds openSince_ = 0;
    UnixSeconds litSince_ = 0;      // since when lamps are to be on
    UnixSeconds watchedSince_ = 0;  // the projectors of these hours; 0: not yet
    std::vector<std::unique_ptr<SwitchedProjector>> projectors_;  // in the order of the hours
    std::optional<bool> power_, shut_;  // that all projectors were last told
};

}  // namespace aquarama::console
