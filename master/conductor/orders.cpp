// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/orders.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "common/base/characters.h"
#include "common/base/log.h"
#include "master/conductor/hall_clock.h"

namespace aquarama::conductor {
namespace {

// A node answers at once; its network may lose the order or the answer.
constexpr net::Duration kNodesPatience = std::chrono::seconds(3);

// A fader that moves no more has come to rest after this.
constexpr net::Duration kFaderRests = std::chrono::seconds(1);

}  // namespace

Orders::Orders(OrderLimits limits, Roster& roster, const Sender& sender, Drawings& drawings)
    : limits_{std::move(limits)},
      roster_{roster},
      sender_{sender},
      drawings_{drawings},
      control_{limits_.wanted, limits_.kept, book_} {}

v1::OrderReply Orders::obey(const std::string& user,
                            const v1::Order& order,
                            Frame unpublished,
                            net::Moment now) {
    Answer answer;
    std::uint32_t drawing = 0;
    if (order.run() != 0 && order.run() != sender_.session())
        answer = ask::refused("the show was started again meanwhile: look, and say it once more");
    else if (order.has_scan())
        answer = hold(user, order.scan(), unpublished, now);
    else if (order.has_sign())
        answer = hold(order.sign(), now);
    else if (order.has_show())
        answer = change(user, order, now);
    else if (order.has_drawing() || order.has_moderation())
        answer = takeDrawing(user, order, drawing);
    else
        answer = carryOutOnce(user, order, now);
    v1::OrderReply reply;
    reply.set_request(order.request());
    reply.set_outcome(static_cast<v1::OrderReply::Outcome>(answer.outcome));
    reply.set_reason(legible(answer.reason, wire::kMostReasonBytes));
    if (drawing != 0) reply.set_drawing(drawing);
    if (order.has_scan() && answer.outcome == Outcome::Done)
        reply.set_frame(std::ranges::max(roster_.seats(), {}, &NodeSeat::released).released.value);
    return reply;
}

Answer Orders::carryOutOnce(const std::string& user, const v1::Order& order, net::Moment now) {
    if (const Answer* known = book_.find(order.request())) return *known;
    if (order.has_release()) return release(user, order);
    return order.has_power() ? power(user, order, now) : restart(user, order);
}

Answer Orders::release(const std::string& user, const v1::Order& order) {
    std::string objection = objectionToRelease();
    if (objection.empty()) objection = hunters_.call(order.release().species());
    if (!objection.empty()) return ask::refused(std::move(objection));
    logInfo("{} releases a {}", user, order.release().species());
    return book_.enter(order.request(), {});
}

Answer Orders::change(const std::string& user, const v1::Order& order, net::Moment now) {
    if (std::string objection = objectionTo(order.show()); !objection.empty())
        return ask::refused(std::move(objection));
    const std::uint64_t before = control_.version();
    Answer answer = control_.set(order.request(), order.show());
    if (control_.version() == before) return answer;
    std::string line = user + " sets " + wire::textOf(order.show());
    if (wire::isOfFader(order.show()))
        fader_ = {std::move(line), now};
    else
        logInfo("{}", line);
    return answer;
}

std::string Orders::objectionTo(const v1::WantedShow& show) const {
    if (limits_.isLockstep) return "a show in lockstep is the same every time; run it with --live";
    const bool changesPatterns =
        show.has_scene() || show.has_quality() || show.has_pattern() || show.has_brightness();
    if (scan_.pattern() && changesPatterns)
        return "a scan holds the wall; wait for its end, or end it";
    if (show.has_scene())
        if (std::string objection = objectionToScene(show.scene()); !objection.empty())
            return objection;
    if (show.quality() == v1::WantedShow::AUTO && !roster_.measuredTier())
        return "not every node has measured which quality it bears; that is done when a show "
               "starts without a chosen quality";
    return {};
}

std::string Orders::objectionToRelease() const {
    if (limits_.isLockstep) return "a show in lockstep is the same every time; run it with --live";
    if (control_.wanted().freeze()) return "the world is frozen; set freeze off";
    return {};
}

std::string Orders::objectionToScene(const std::string& scene) const {
    if (scene != control_.wanted().scene() && !limits_.whyOneScene.empty())
        return limits_.whyOneScene;
    if (scene.find_first_of("/\\") != std::string::npos || scene.ends_with(".txtpb"))
        return "a scene is named without folder and ending";
    return {};
}

Answer Orders::hold(const std::string& user,
                    const v1::HeldScan& scan,
                    Frame unpublished,
                    net::Moment now) {
    if (!scan.has_pattern()) {
        scan_.end(scan.holder());
        return {};
    }
    if (std::string objection = objectionToScan(); !objection.empty())
        return ask::refused(std::move(objection));
    const auto pattern = wire::readScanPattern(scan.pattern());
    const bool begins = !scan_.pattern();
    if (!scan_.hold(scan.holder(), pattern.value(), std::max(unpublished, Frame{1}), now))
        return ask::refused("another scan holds the wall; wait for its end, or end it");
    if (begins) logInfo("{} holds the wall for a scan", user);
    const std::string missing = notShowingScan();
    return missing.empty() ? Answer{} : Answer{Outcome::Waiting, "not shown yet by " + missing};
}

// What is said again is answered again.
Answer Orders::takeDrawing(const std::string& user, const v1::Order& order, std::uint32_t& number) {
    if (limits_.isLockstep)
        return ask::refused("a show in lockstep is the same every time; run it with --live");
    if (order.has_moderation()) return drawings_.decide(user, order.request(), order.moderation());
    if (!control_.wanted().drawings()) return ask::refused("drawings are set off; set drawings on");
    return drawings_.offer(
        order.request(), order.drawing(), static_cast<std::uint64_t>(unixNow()), number);
}

// Said again every second or so.
Answer Orders::hold(const v1::HeldSign& sign, net::Moment now) {
    if (limits_.isLockstep)
        return ask::refused("a show in lockstep is the same every time; run it with --live");
    if (!control_.wanted().guests()) return ask::refused("guests are set off; set guests on");
    if (sign.has_sign() && !wire::readSign(sign.sign()))
        return ask::refused("the sign has not as many dots as columns and rows say");
    sign_.hold(sign, now);
    return {};
}

// A wall that is set black stays black, whoever scans it.
std::string Orders::objectionToScan() const {
    if (limits_.isLockstep) return "a show in lockstep is the same every time; run it with --live";
    if (control_.wanted().black()) return "the wall is set black; set black off for a scan";
    if (control_.wanted().brightness() < 1)
        return "the wall is dimmed; set brightness 1 for a scan";
    if (control_.phase() != ShowControl::Phase::Steady)
        return "another change is under way; wait for its end";
    return {};
}

std::string Orders::notShowingScan() const {
    std::string missing;
    for (const NodeSeat& seat : roster_.seats()) {
        const bool isThere = seat.prepared && !seat.peer.empty();
        if (isThere && scan_.first() <= seat.released) continue;
        missing += (missing.empty() ? "" : ", ") + seat.name + (isThere ? " (late)" : " (absent)");
    }
    return missing;
}

std::string Orders::objectionToEnding(const std::string& channel) const {
    if (limits_.isLockstep) return "a node of a show in lockstep is not restarted";
    const auto node = roster_.named(channel);
    if (!node) return "the rig has no channel " + channel;
    if (roster_.seats()[*node].peer.empty()) return channel + " is absent: start it on its machine";
    return {};
}

void Orders::passOn(const v1::Order& order, const std::string& channel) const {
    v1::Envelope message;
    *message.mutable_order() = order;
    sender_.say(roster_.seats()[*roster_.named(channel)].peer, std::move(message));
}

Answer Orders::restart(const std::string& user, const v1::Order& order) {
    const std::string& channel = order.restart().channel();
    if (std::string objection = objectionToEnding(channel); !objection.empty())
        return ask::refused(std::move(objection));
    logInfo("{} restarts node {}", user, channel);
    passOn(order, channel);
    return book_.enter(order.request(), {});
}

// Nodes of another build do not say whether their machine takes the word.
std::string Orders::objectionToPower(const std::string& channel) const {
    if (std::string objection = objectionToEnding(channel); !objection.empty()) return objection;
    const auto& report = roster_.seats()[*roster_.named(channel)].report;
    if (!report) return "nothing is known of the machine of " + channel + " yet; say it again";
    if (report->takes_power_word()) return {};
    return "the machine of " + channel + " takes no such word; set up aquarama-power.path there";
}

// Passed on once: a power order that was lost must not come later.
Answer Orders::power(const std::string& user, const v1::Order& order, net::Moment now) {
    const std::string& channel = order.power().channel();
    if (std::string objection = objectionToPower(channel); !objection.empty())
        return ask::refused(std::move(objection));
    logInfo("{} switches the machine of {}: {}",
            user,
            channel,
            order.power().word() == v1::Power::POWEROFF ? "poweroff" : "reboot");
    passOn(order, channel);
    passedOn_.push_back({order.request(), *roster_.named(channel), now});
    return book_.enter(order.request(),
                       {Outcome::Waiting, "the machine of " + channel + " is told"});
}

void Orders::hear(std::size_t node, const v1::OrderReply& reply) {
    const auto known = std::ranges::find(passedOn_, reply.request(), &PassedOn::request);
    if (known == passedOn_.end() || known->node != node) return;
    passedOn_.erase(known);
    book_.enter(reply.request(), {static_cast<Outcome>(reply.outcome()), reply.reason()});
}

void Orders::giveUpTheSilent(net::Moment now) {
    sign_.expire(now);
    if (!fader_.told.empty() && now - fader_.moved > kFaderRests)
        logInfo("{}", std::exchange(fader_.told, {}));
    if (scan_.expires(now)) logWarning("a scan has fallen silent: the wall shows what it did");
    std::erase_if(passedOn_, [&](const PassedOn& order) {
        if (now - order.said < kNodesPatience) return false;
        book_.enter(order.request,
                    {Outcome::Lost,
                     "the machine of " + roster_.seats()[order.node].name +
                         " has not answered; look whether it ends"});
        return true;
    });
}

}  // namespace aquarama::conductor
