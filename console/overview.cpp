// SPDX-License-Identifier: Apache-2.0
#include "console/overview.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <google/protobuf/util/json_util.h>
#include <spdlog/fmt/fmt.h>

#include "common/base/counted.h"
#include "common/wire/journal_text.h"
#include "common/wire/wanted_show.h"

namespace aquarama::console {

namespace {

// Why a node is not as it should be; empty where nothing is known to be wrong.
std::string causeOf(const v1::NodeStatus& node) {
    if (node.hash_mismatches() > 0) return "shows other fish than were sent";
    switch (node.condition()) {
        case v1::NODE_ABSENT:
            return node.machine().empty() ? "its process does not run"
                                          : "nothing is heard of machine " + node.machine();
        case v1::NODE_PREPARING:
            return "it builds what it will show";
        case v1::NODE_LATE:
            return fmt::format("its pictures take {:.0f} ms", node.report().picture_median_ms());
        default:
            return {};
    }
}

// Of FigureRings.
constexpr std::uint32_t kTenthsOfMinute = 600;
constexpr std::uint16_t kNothingHeard = 65535;
// Of a text that browsers or programs send.
constexpr std::size_t kMostBytes = 65536;

// The last of them, little-endian.
std::string bytesOf(const std::deque<std::uint16_t>& values, std::size_t most) {
    std::string bytes;
    for (std::size_t i = values.size() - std::min(values.size(), most); i < values.size(); ++i) {
        bytes += static_cast<char>(values[i] & 0xFFU);
        bytes += static_cast<char>(values[i] >> 8U);
    }
    return bytes;
}

}  // namespace

// The causes stand beside the status, which stays as it came.
browser::Wall wallOf(const v1::StatusReply& status, std::uint64_t run) {
    browser::Wall wall;
    wall.set_heard(true);
    wall.set_run(run);
    *wall.mutable_status() = status;
    for (const v1::NodeStatus& node : status.nodes()) wall.add_causes(causeOf(node));
    return wall;
}

bool isInStep(const browser::Wall& wall) {
    return wall.heard() &&
           std::ranges::all_of(wall.status().nodes(), [](const v1::NodeStatus& node) {
               return node.condition() == v1::NODE_IN_STEP;
           });
}

// A silent master hides everything else: it is the one fault then.
std::vector<Fault> faultsOf(const browser::Wall& wall, const std::string& build, UnixSeconds now) {
    constexpr double kSilence = 3, kStart = 60, kOutOfStep = 10, kHot = 30;
    constexpr float kHotCelsius = 85;
    if (!wall.heard() && !wall.preparing().empty()) return {};
    if (!wall.heard() || now - wall.heard_s() > kSilence)
        return {{"master",
                 "the master does not answer: no show runs, or it hangs",
                 wall.heard_s() > 0 ? kSilence : kStart}};
    std::vector<Fault> faults;
    for (const v1::NodeStatus& node : wall.status().nodes()) {
        const std::string name = "node " + node.name();
        const v1::NodeReport& report = node.report();
        if (node.condition() != v1::NODE_IN_STEP)
            faults.push_back(
                {name,
                 name + " is " + wire::wordFor(node.condition()) + ": " + causeOf(node),
                 kOutOfStep});
        if (node.hash_mismatches() > 0)
            faults.push_back({name + " hash", name + " shows other fish than were sent", 0});
        if (report.gpu_celsius() >= kHotCelsius)
            faults.push_back(
                {name + " hot",
                 fmt::format("{}: its card has {:.0f} degrees", name, report.gpu_celsius()),
                 kHot});
        if (!report.build().empty() && report.build() != build)
            faults.push_back({name + " build", name + " is of another build", kOutOfStep});
    }
    if (std::string problem = wire::journalProblem(wall.status().journal()); !problem.empty())
        faults.push_back({"journal", std::move(problem), 0});
    if (wall.status().has_standby())
        if (std::string problem = wire::standbyProblem(wall.status().standby()); !problem.empty())
            faults.push_back({"standby", std::move(problem), kOutOfStep});
    return faults;
}

namespace {

// Whether it answers, and what to do where it does not.
void addReachFault(std::vector<Fault>& faults, const browser::ProjectorState& one) {
    constexpr double kGone = 60, kRefused = 10;
    const std::string name = "projector " + one.name();
    const std::string write = ": write that of its menu into the hours";
    if (one.reach() == "no answer")
        faults.push_back({name,
                          name + " does not answer: is it powered, its network on in standby, its "
                                 "PJLink on, and its address right?",
                          kGone});
    if (one.reach() == "refuses the password")
        faults.push_back({name, name + " refuses the password" + write, kRefused});
    if (one.reach() == "wants a password")
        faults.push_back({name, name + " wants a password" + write, kRefused});
}

}  // namespace

namespace {

// A lamp that is known to be otherwise than wanted; it has five minutes to come to it.
void addPowerFault(std::vector<Fault>& faults, const browser::ProjectorState& one) {
    constexpr double kLampSeconds = 300;
    const std::string name = "projector " + one.name();
    const std::string wanted = one.wanted_power() ? "on" : "off";
    if (!one.has_wanted_power() || one.power() == "unknown" || one.power() == wanted) return;
    faults.push_back({name + " power",
                      name + " is " + one.power() + ", and should be " + wanted +
                          ": look at its lamp and its menu",
                      kLampSeconds});
}

// "power on, open"; whether it answers, where it does not.
std::string stateOf(const browser::ProjectorState& one) {
    if (one.reach() != "answers") return one.reach();
    if (one.power() != "on") return "power " + one.power();
    if (!one.has_shut()) return "power on, shutter unknown";
    return one.shut() ? "power on, shut" : "power on, open";
}

}  // namespace

// A warning of some seconds is none.
std::vector<Fault> faultsOf(const browser::ProjectorList& projectors) {
    constexpr double kProblemSeconds = 60;
    std::vector<Fault> faults;
    for (const browser::ProjectorState& one : projectors.projectors()) {
        const std::string name = "projector " + one.name();
        addReachFault(faults, one);
        addPowerFault(faults, one);
        for (const std::string& problem : one.problems())
            faults.push_back({fmt::format("{} {}", name, problem),
                              fmt::format("{}: {}", name, problem),
                              kProblemSeconds});
    }
    return faults;
}

// Whether a state of it is to be told now.
bool ProjectorBook::isNews(const browser::ProjectorState& one, UnixSeconds now) {
    constexpr double kLasts = 25;
    const std::string state = stateOf(one);
    Page& page = pages_[one.name()];
    if (state != page.seen) page = {page.told, state, now};
    if (state == page.told || state == "not asked yet" || now - page.since < kLasts) return false;
    page.told = state;
    return true;
}

// A state of some seconds is passed over, as one that cannot be told for a moment is no news.
std::vector<std::pair<std::string, std::string>> ProjectorBook::update(
    const browser::ProjectorList& list, UnixSeconds now) {
    std::erase_if(pages_, [&](const auto& page) {
        return std::ranges::count(list.projectors(), page.first, &browser::ProjectorState::name) ==
               0;
    });
    std::vector<std::pair<std::string, std::string>> lines;
    for (const browser::ProjectorState& one : list.projectors())
        if (isNews(one, now)) lines.emplace_back("projector " + one.name(), stateOf(one));
    return lines;
}

namespace {

// What an operator would say of the journal.
std::vector<std::string> changesOfJournal(const v1::JournalStatus& before,
                                          const v1::JournalStatus& after) {
    std::vector<std::string> lines;
    const bool isOne = before.went_on_tick() == after.went_on_tick();
    if (std::string wentOn = wire::wentOnText(after); !isOne && !wentOn.empty())
        lines.push_back(std::move(wentOn));
    if (after.late_spells() > (isOne ? before.late_spells() : 0))
        lines.push_back("what visitors do takes effect before the journal's disk has it: " +
                        counted(after.late_inputs(), "input") + " so far");
    return lines;
}

// And of the standby: who is the master, and who would take over.
std::vector<std::string> changesOfStandby(const v1::StatusReply& before,
                                          const v1::StatusReply& after) {
    const v1::StandbyStatus& was = before.standby();
    const v1::StandbyStatus& is = after.standby();
    std::vector<std::string> lines;
    if (was.master() != is.master() && after.has_standby())
        lines.push_back("machine " + is.master() + " is the master");
    if (was.machine() != is.machine())
        lines.push_back("machine " + (is.has_machine()
                                          ? is.machine() + " simulates along"
                                          : was.machine() + " is no standby any more"));
    return lines;
}

}  // namespace

// Another run of the master is a line or two, not ten.
std::vector<std::string> changesOf(const browser::Wall& before, const browser::Wall& after) {
    std::vector<std::string> lines;
    const auto note = [&](bool hasChanged, std::string line) {
        if (hasChanged) lines.push_back(std::move(line));
    };
    const auto was = wire::readShow(before.status().show()).value_or(wire::Show{});
    const auto is = wire::readShow(after.status().show()).value_or(wire::Show{});
    if (before.run() != after.run()) {
        lines = changesOfJournal({}, after.status().journal());
        std::ranges::move(changesOfStandby({}, after.status()), std::back_inserter(lines));
        lines.insert(lines.begin(), "the show has begun: scene " + is.scene);
        return lines;
    }
    note(was.black != is.black, is.black ? "the wall is black" : "light again");
    note(was.frozen != is.frozen, is.frozen ? "frozen" : "the world moves again");
    note(was.scene != is.scene, "scene " + is.scene);
    note(was.pattern != is.pattern, fmt::format("pattern {}", wire::nameOf(is.pattern)));
    const auto dayOf = [](const browser::Wall& wall) {
        return wire::dayName(wall.status().has_day() ? wall.status().day() : v1::WantedShow::CLOCK);
    };
    note(dayOf(before) != dayOf(after), "day " + dayOf(after));
    const bool wereGuests = before.status().guests();
    const bool areGuests = after.status().guests();
    note(wereGuests != areGuests, areGuests ? "phones take part" : "no phone takes part");
    const bool wereDrawings = before.status().drawings();
    const bool areDrawings = after.status().drawings();
    note(wereDrawings != areDrawings, areDrawings ? "drawings swim" : "no drawing swims");
    note(was.quality != is.quality, fmt::format("quality {}", config::nameOf(is.quality)));
    const auto& nodesBefore = before.status().nodes();
    const auto& nodes = after.status().nodes();
    for (int i = 0; i < std::min(nodesBefore.size(), nodes.size()); ++i)
        note(nodesBefore[i].condition() != nodes[i].condition(),
             "node " + nodes[i].name() + " is " + wire::wordFor(nodes[i].condition()));
    for (std::string& line : changesOfJournal(before.status().journal(), after.status().journal()))
        lines.push_back(std::move(line));
    std::ranges::move(changesOfStandby(before.status(), after.status()), std::back_inserter(lines));
    return lines;
}

// Another run brings other values, and another scene another colour, which nobody has moved.
std::vector<std::string> FaderWatch::update(const browser::Wall& wall, double now) {
    constexpr double kRests = 1;
    const auto show = wire::readShow(wall.status().show());
    if (!wall.heard() || !show) return {};
    const bool isFading = show->black || !wall.status().change().empty();
    const Values seen{isFading ? seen_.brightness : show->brightness, show->colourReturned};
    if (std::exchange(seen_, seen) != seen) movedAt_ = now;
    if (std::exchange(scene_, show->scene) != show->scene) told_.colour = seen.colour;
    if (std::exchange(run_, wall.run()) != wall.run()) told_ = seen;
    if (now - movedAt_ < kRests) return {};
    std::vector<std::string> lines;
    if (seen.brightness != told_.brightness)
        lines.push_back(fmt::format("brightness {:.2f}", seen.brightness));
    if (seen.colour != told_.colour) lines.push_back(fmt::format("colour {:.2f}", seen.colour));
    told_ = seen;
    return lines;
}

// The minute's largest: a mean would hide what people saw.
void FigureRings::add(const std::string& name, float ms, bool isHeard) {
    constexpr std::size_t kTenths = 6000, kMinutes = 1440;
    constexpr float kScale = 100, kMost = 65534;
    Ring& ring = rings_[name];
    const float scaled = std::clamp(ms * kScale, 0.0F, kMost);
    const std::uint16_t value = isHeard ? static_cast<std::uint16_t>(scaled) : kNothingHeard;
    ring.tenths.push_back(value);
    if (ring.tenths.size() > kTenths) ring.tenths.pop_front();
    if (isHeard) ring.largest = std::max(ring.largest, value);
    if (tenths_ % kTenthsOfMinute != 0) return;
    ring.minutes.push_back(std::exchange(ring.largest, std::uint16_t{0}));
    if (ring.minutes.size() > kMinutes) ring.minutes.pop_front();
}

// Minutes are counted by the calls. Of a master that is silent the places stay empty.
void FigureRings::add(const browser::Wall& wall) {
    ++tenths_;
    add("frame", wall.status().frame_peak_ms(), wall.heard());
    add("skew", wall.status().skew_peak_ms(), wall.heard());
    for (const v1::NodeStatus& node : wall.status().nodes())
        add("node " + node.name(),
            node.picture_ms(),
            wall.heard() && node.condition() != v1::NODE_ABSENT &&
                node.condition() != v1::NODE_PREPARING);
}

// In the order of their names.
browser::History FigureRings::newest(std::size_t tenths, std::size_t minutes) const {
    browser::History history;
    history.set_tenths(tenths_);
    history.set_minutes(tenths_ / kTenthsOfMinute);
    for (const auto& [name, ring] : rings_) {
        for (auto* const series : {history.add_ten_minutes(), history.add_day()})
            series->set_name(name);
        history.mutable_ten_minutes()->rbegin()->set_values(bytesOf(ring.tenths, tenths));
        history.mutable_day()->rbegin()->set_values(bytesOf(ring.minutes, minutes));
    }
    return history;
}

browser::History FigureRings::history() const {
    constexpr std::size_t kAll = 1U << 16U;
    return newest(kAll, kAll);
}

// A little more than that: whoever missed one second has it from the next.
browser::History FigureRings::lastSecond() const {
    constexpr std::size_t kTenths = 25, kMinutes = 2;
    return newest(kTenths, kMinutes);
}

// A zero is said: a page need not know what is left out.
std::string jsonOf(const browser::ToBrowser& message) {
    google::protobuf::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    std::string text;
    static_cast<void>(google::protobuf::util::MessageToJsonString(message, &text, options));
    return text;
}

std::optional<v1::Order> readOrder(const std::string& text) {
    v1::Order order;
    const bool isRead =
        text.size() <= kMostBytes && google::protobuf::util::JsonStringToMessage(text, &order).ok();
    return isRead ? std::optional(order) : std::nullopt;
}

// protobuf refuses unknown fields, wrong types and depth; sizes are ours to bound.
std::optional<browser::FromBrowser> readBrowser(const std::string& text) {
    constexpr int kMostListed = 64;
    if (text.size() > kMostBytes) return std::nullopt;
    browser::FromBrowser message;
    if (!google::protobuf::util::JsonStringToMessage(text, &message).ok()) return std::nullopt;
    const browser::Look& look = message.look();
    if (look.topics_size() > kMostListed || look.channels_size() > kMostListed) return std::nullopt;
    return message;
}

}  // namespace aquarama::console
