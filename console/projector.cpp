// SPDX-License-Identifier: Apache-2.0
#include "console/projector.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace aquarama::console {

namespace {

// Seconds. More often, and some projectors hang.
constexpr double kBetweenLooks = 20;
constexpr double kWhileItChanges = 10;      // warming, cooling, or on the way to what is wanted
constexpr double kAfterAPowerCommand = 10;  // which some need to themselves
constexpr double kAfterACommand = 3;
constexpr double kAfterARefusal = 30;   // of the password: some lock after several
constexpr double kWhatItLacks = 300;    // until it is asked again for what it cannot tell or do
constexpr double kLampHours = 600;      // between questions for them
constexpr double kLongestChange = 600;  // of warming and cooling; then they are not believed
constexpr double kSilence = 60;         // without any answer, though it greets
// So many times OK for a state that cannot be asked is taken as having it.
constexpr int kEnoughOk = 6;
// A command that was said so often is said more slowly.
constexpr int kSome = 12;

// "INPT 3A" is of class 2, "INPT 31" of both.
const char* classOf(const std::string& input) {
    const bool isOfClass1 = input.size() == 2 && input[0] >= '1' && input[0] <= '5' &&
                            input[1] >= '1' && input[1] <= '9';
    return isOfClass1 ? "%1" : "%2";
}

// Seconds until a command is said again that has been said `sent` times: slower with time.
double pauseAfter(int sent, bool isUnknown, int taken) {
    constexpr double kFirst = 10, kThen = 30, kLater = 60, kSeldom = 600;
    constexpr int kMany = 40;
    if (sent <= 1) return kFirst;
    if (isUnknown && (taken >= kEnoughOk || sent >= kMany)) return kSeldom;
    return sent < kSome ? kThen : kLater;
}

// Seconds of a clock that never goes back.
double steadyNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

const char* nameOf(ProjectorReach reach) {
    switch (reach) {
        case ProjectorReach::Answers:
            return "answers";
        case ProjectorReach::NoAnswer:
            return "no answer";
        case ProjectorReach::RefusesPassword:
            return "refuses the password";
        case ProjectorReach::WantsPassword:
            return "wants a password";
        default:
            return "not asked yet";
    }
}

const char* nameOf(LampPower power) {
    constexpr std::array kNames{"unknown", "off", "on", "cooling", "warming"};
    return kNames.at(static_cast<std::size_t>(power));
}

ProjectorControl::ProjectorControl(std::string input, bool hasPassword)
    : input_{std::move(input)}, hasPassword_{hasPassword} {}

// Another value is said at once; the same again changes nothing.
void ProjectorControl::want(std::optional<bool> power, std::optional<bool> shut) {
    if (power && power != power_) {
        power_ = power;
        wishes_[Power] = {};
        if (*power) beginWishes();
    }
    if (shut && shut != shut_) {
        shut_ = shut;
        wishes_[Shutter] = {};
    }
    facts_.wantedPower = power_;
}

// What a projector that comes on has to be told.
void ProjectorControl::beginWishes() {
    wishes_[Shutter] = wishes_[Input] = {};
    isInputSet_ = false;
}

void ProjectorControl::release() {
    power_.reset();
    shut_.reset();
    facts_.wantedPower.reset();
    isInputSet_ = true;
}

// While it warms or cools it is left alone. On, off and unknown are three things: where it is
// unknown, the command is said.
bool ProjectorControl::isPowerNeeded() const {
    if (!power_ || isChanging()) return false;
    return facts_.power != (*power_ ? LampPower::On : LampPower::Off);
}

bool ProjectorControl::isChanging() const {
    return facts_.power == LampPower::Warming || facts_.power == LampPower::Cooling;
}

// Whether shutter and input can be set: the lamp is on, or may be.
bool ProjectorControl::mayHavePicture() const {
    if (power_ == false) return false;
    return facts_.power == LampPower::On || facts_.power == LampPower::Unknown;
}

bool ProjectorControl::isShutterNeeded() const {
    if (!shut_ || !mayHavePicture()) return false;
    if (facts_.isShut) return *facts_.isShut != *shut_;
    return wishes_[Shutter].taken < kEnoughOk;
}

// Once after it has come on: what people choose later holds.
bool ProjectorControl::isInputNeeded() const {
    if (input_.empty() || isInputSet_ || power_ != true || !mayHavePicture()) return false;
    return facts_.input ? *facts_.input != input_ : wishes_[Input].taken < kEnoughOk;
}

bool ProjectorControl::isNeeded(Item item) const {
    if (item == Power) return isPowerNeeded();
    return item == Shutter ? isShutterNeeded() : isInputNeeded();
}

std::string ProjectorControl::commandOf(Item item) const {
    if (item == Power) return *power_ ? "%1POWR 1" : "%1POWR 0";
    if (item == Input) return classOf(input_) + ("INPT " + input_);
    return std::string("%1AVMT ") + (pictureOnly_ ? '1' : '3') + (*shut_ ? '1' : '0');
}

std::string ProjectorControl::queryOf(Item item) const {
    constexpr std::array kNames{"%1POWR ?", "%1AVMT ?", "", "%1ERST ?", "%1LAMP ?"};
    return item == Input ? classOf(input_) + std::string("INPT ?") : kNames.at(item);
}

// In the dark there is no picture to ask about, and while it warms or cools many are overtaxed.
bool ProjectorControl::isAsked(Item item) const {
    if (item == Power) return true;
    if (!isThere_ || isChanging()) return false;
    if (item == Errors || item == Lamp) return true;
    if (item == Input && input_.empty()) return false;
    return facts_.power == LampPower::On || mayHavePicture();
}

// The one that has been due for longest: a slow projector starves none of them.
ProjectorControl::Query ProjectorControl::nextQuery() const {
    Query query{Power, due_[Power]};
    for (const Item item : {Shutter, Input, Errors, Lamp})
        if (isAsked(item) && due_[item] < query.second) query = {item, due_[item]};
    return query;
}

// Nothing is commanded before it was asked once, nor without asking anew what can be asked.
ProjectorStep ProjectorControl::next(double now) const {
    if (now < restUntil_) return {"", restUntil_};
    const Query query = nextQuery();
    double until = query.second;
    for (const Item item : {Power, Shutter, Input}) {
        if (!isThere_ || !isNeeded(item)) continue;
        if (isAsked(item) && due_[item] <= now) return {queryOf(item)};
        if (wishes_[item].notBefore <= now) return {commandOf(item)};
        until = std::min(until, wishes_[item].notBefore);
    }
    return query.second <= now ? ProjectorStep{queryOf(query.first)} : ProjectorStep{"", until};
}

// What it told before is not known any more.
void ProjectorControl::isOutOfReach(ProjectorReach reach, double now) {
    constexpr int kGone = 2;
    facts_ = {.reach = reach, .wantedPower = facts_.wantedPower};
    told_.reset();
    refusals_.clear();
    isBroken_ = {};
    isThere_ = false;
    const bool isRefused = reach != ProjectorReach::NoAnswer;
    restUntil_ = now + (isRefused ? kAfterARefusal : kWhileItChanges);
    due_ = {};
    if (++failures_ >= kGone) lastPower_ = LampPower::Unknown;  // it may have been without current
}

void ProjectorControl::heard(const std::string& command, const PjlinkReply& reply, double now) {
    if (reply.end == PjlinkEnd::Unreachable) return isOutOfReach(ProjectorReach::NoAnswer, now);
    if (reply.end == PjlinkEnd::Refused)
        return isOutOfReach(
            hasPassword_ ? ProjectorReach::RefusesPassword : ProjectorReach::WantsPassword, now);
    isThere_ = true;
    failures_ = 0;
    const bool isAnswered = reply.end == PjlinkEnd::Answered;
    if (isAnswered) answeredAt_ = now;
    if (isAnswered)
        facts_.reach = ProjectorReach::Answers;
    else if (facts_.reach != ProjectorReach::Answers || now - answeredAt_ > kSilence)
        facts_.reach = ProjectorReach::NoAnswer;
    for (const Item item : {Power, Shutter, Input, Errors, Lamp})
        if (queryOf(item).compare(2, 4, command, 2, 4) == 0)
            command.ends_with("?") ? heardState(item, reply.value, now)
                                   : heardOutcome(item, command, reply.value, now);
    showProblems();
}

// Sooner while something is under way, for some minutes.
double ProjectorControl::lookInterval() const {
    bool isUnderWay = isChanging();
    for (const Item item : {Power, Shutter, Input}) {
        const Wish& wish = wishes_.at(item);
        isUnderWay = isUnderWay || (isNeeded(item) && wish.sent < kSome && wish.taken < kEnoughOk);
    }
    return isUnderWay ? kWhileItChanges : kBetweenLooks;
}

// ERR1 and ERR2: it cannot tell; ERR3: not now; ERR4: it is broken. What is not answered at all is
// asked seldom, as it costs the whole patience each time; the power is asked at each look.
void ProjectorControl::heardState(Item item, const std::string& value, double now) {
    takeState(item, value, now);
    const bool isLacking = value.empty() || value == "ERR1" || value == "ERR2";
    if (value == "ERR4" || !isLacking) isBroken_.at(item) = value == "ERR4";
    double interval = lookInterval();
    if (item == Lamp && facts_.lampHours) interval = kLampHours;
    if (item != Power && isLacking) interval = kWhatItLacks;
    due_[item] = now + interval;
}

// Whatever is no value of the item leaves it unknown.
void ProjectorControl::takeState(Item item, const std::string& value, double now) {
    switch (item) {
        case Power:
            return takePower(value, now);
        case Shutter:
            facts_.isShut = shutIn(value);
            if (facts_.isShut && facts_.isShut == shut_) wishes_[Shutter] = {};
            return;
        case Input:
            facts_.input.reset();
            if (value.size() == input_.size()) facts_.input = value;
            isInputSet_ = isInputSet_ || facts_.input == input_;
            return;
        case Errors:
            told_ = problemsIn(value);
            return;
        default:
            facts_.lampHours = lampHoursIn(value);
    }
}

// Warming for ever is not believed, and a projector that was told to come on begins anew.
void ProjectorControl::takePower(const std::string& value, double now) {
    constexpr std::array kStates{
        LampPower::Off, LampPower::On, LampPower::Cooling, LampPower::Warming};
    const bool isState = value.size() == 1 && value[0] >= '0' && value[0] <= '3';
    facts_.power =
        isState ? kStates.at(static_cast<std::size_t>(value[0] - '0')) : LampPower::Unknown;
    if (value != saidPower_) powerSince_ = now;
    saidPower_ = value;
    if (isChanging() && now - powerSince_ > kLongestChange) facts_.power = LampPower::Unknown;
    if (!isState && now - powerSince_ > kSilence) lastPower_ = LampPower::Unknown;
    if (facts_.power == LampPower::On && lastPower_ != LampPower::On) beginPicture(now);
    if (isState) lastPower_ = facts_.power;
    if (facts_.power == LampPower::On || facts_.power == LampPower::Unknown) {
        if (facts_.power == LampPower::On && !isPowerNeeded()) wishes_[Power] = {};
        return;
    }
    facts_.isShut.reset();
    facts_.input.reset();
    if (!isChanging() && !isPowerNeeded()) wishes_[Power] = {};
}

// It has come on: shutter and input are as its maker likes, and are set anew.
void ProjectorControl::beginPicture(double now) {
    for (const Item item : {Shutter, Input, Errors}) due_[item] = now;
    beginWishes();
    facts_.isShut.reset();
    facts_.input.reset();
    refusals_.erase(Shutter);
    refusals_.erase(Input);
}

// Said again after a while, until it has what is wanted. What it can tell is asked before that.
void ProjectorControl::heardOutcome(Item item,
                                    const std::string& command,
                                    const std::string& value,
                                    double now) {
    if (item == Power) restUntil_ = now + kAfterAPowerCommand;
    if (item == Power && value == "OK" && facts_.power == LampPower::Unknown)
        lastPower_ = LampPower::Unknown;
    if (item == Power || due_[item] - now <= kBetweenLooks)
        due_[item] = now + (item == Power ? kAfterAPowerCommand : kAfterACommand);
    if (!isWished(item) || command != commandOf(item)) return;  // something else is wanted since
    Wish& wish = wishes_.at(item);
    ++wish.sent;
    if (value == "OK") ++wish.taken;
    const bool isUnknown = (item == Power && facts_.power == LampPower::Unknown) ||
                           (item == Shutter && !facts_.isShut) || (item == Input && !facts_.input);
    wish.notBefore = now + pauseAfter(wish.sent, isUnknown, wish.taken);
    if (value == "OK") refusals_.erase(item);
    if (value == "ERR4") refusals_[item] = "failure";
    if (value == "ERR1" || value == "ERR2") refused(item, now);
}

// Whether a value is wanted of it, whatever it is now.
bool ProjectorControl::isWished(Item item) const {
    if (item == Power) return power_.has_value();
    return item == Shutter ? shut_.has_value() : !input_.empty();
}

// It cannot do that. Some mute the picture alone, without the sound.
void ProjectorControl::refused(Item item, double now) {
    if (item == Shutter) pictureOnly_ = !pictureOnly_;
    if (item == Shutter && pictureOnly_) return;
    refusals_[item] = item == Input ? "there is none" : "it cannot be set by PJLink";
    if (item != Power) wishes_.at(item).notBefore = now + kWhatItLacks;
}

// Those that it tells itself, then those of what was asked of it.
void ProjectorControl::showProblems() {
    constexpr std::array kNames{"power", "shutter", "input", "problems", "lamp hours"};
    facts_.areProblemsKnown = told_.has_value();
    facts_.problems = told_.value_or(std::vector<std::string>{});
    for (const Item item : {Power, Shutter, Input, Errors, Lamp}) {
        const std::string name = item == Input ? "input " + input_ : kNames.at(item);
        const auto refusal = refusals_.find(item);
        if (refusal != refusals_.end()) facts_.problems.push_back(name + ": " + refusal->second);
        if (isBroken_.at(item)) facts_.problems.push_back(name + ": failure");
    }
}

ProjectorWatch::ProjectorWatch(const config::ControlledProjector& projector,
                               PjlinkPatience patience)
    : connection_{projector, patience},
      control_{projector.input, !projector.password.empty()},
      thread_{[this] { run(); }} {}

// An exchange that is under way ends at once.
ProjectorWatch::~ProjectorWatch() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    connection_.stop();
    thread_.join();
}

void ProjectorWatch::want(std::optional<bool> power, std::optional<bool> shut) {
    {
        const std::lock_guard lock(mutex_);
        control_.want(power, shut);
        isNew_ = true;
    }
    changed_.notify_all();
}

void ProjectorWatch::release() {
    const std::lock_guard lock(mutex_);
    control_.release();
}

// A copy: the thread of the watch replaces what is kept.
ProjectorFacts ProjectorWatch::facts() const {
    const std::lock_guard lock(mutex_);
    return control_.facts();
}

// Between looks the connection is given back.
void ProjectorWatch::run() {
    constexpr double kShortRest = 4;
    std::unique_lock lock(mutex_);
    while (!ended_) {
        isNew_ = false;
        const ProjectorStep step = control_.next(steadyNow());
        if (!step.command.empty()) {
            lock.unlock();
            const PjlinkReply reply = connection_.ask(step.command);
            lock.lock();
            control_.heard(step.command, reply, steadyNow());
            continue;
        }
        const double rest = step.until - steadyNow();
        if (rest > kShortRest) connection_.close();
        changed_.wait_for(lock, std::chrono::duration<double>(std::max(rest, 0.0)), [this] {
            return ended_ || isNew_;
        });
    }
}

}  // namespace aquarama::console
