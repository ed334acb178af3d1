// SPDX-License-Identifier: Apache-2.0
#include "console/projectors/projector.h"

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

// Commands of PJLink, in the order of ProjectorControl::Item.
constexpr std::array kCommands{"POWR", "AVMT", "INPT", "ERST", "LAMP"};

// Of its state; Unknown for ERR1 to ERR4, and whatever else is said.
LampPower powerIn(const std::string& value) {
    static const std::map<std::string, LampPower> kValues{{"0", LampPower::Off},
                                                          {"1", LampPower::On},
                                                          {"2", LampPower::Cooling},
                                                          {"3", LampPower::Warming}};
    const auto found = kValues.find(value);
    return found == kValues.end() ? LampPower::Unknown : found->second;
}

// It cannot tell, or does not: it is asked seldom, as silence costs the whole patience each time.
bool isLacking(const std::string& value) {
    return value.empty() || value == "ERR1" || value == "ERR2";
}

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

// What is wanted otherwise than it is known to be, in the order in which it is set.
std::vector<ProjectorControl::Item> ProjectorControl::needed() const {
    std::vector<Item> items;
    if (!isThere_) return items;
    for (const Item item : {Power, Shutter, Input})
        if (isNeeded(item)) items.push_back(item);
    return items;
}

std::string ProjectorControl::commandOf(Item item) const {
    if (item == Power) return *power_ ? "%1POWR 1" : "%1POWR 0";
    if (item == Input) return classOf(input_) + ("INPT " + input_);
    return std::string("%1AVMT ") + (pictureOnly_ ? '1' : '3') + (*shut_ ? '1' : '0');
}

std::string ProjectorControl::queryOf(Item item) const {
    const char* const header = item == Input ? classOf(input_) : "%1";
    return std::string(header) + kCommands.at(item) + " ?";
}

// Of the lamp, or what may be asked while there may be a picture.
bool ProjectorControl::hasPictureToAsk(Item item) const {
    if (item == Input && input_.empty()) return false;
    return facts_.power == LampPower::On || mayHavePicture();
}

// In the dark there is no picture to ask about, and while it warms or cools many are overtaxed.
bool ProjectorControl::isAsked(Item item) const {
    if (item == Power) return true;
    if (!isThere_ || isChanging()) return false;
    return item == Errors || item == Lamp || hasPictureToAsk(item);
}

// The one that has been due for longest: a slow projector starves none of them.
ProjectorControl::Query ProjectorControl::nextQuery() const {
    Query query{Power, due_[Power]};
    for (const Item item : {Shutter, Input, Errors, Lamp})
        if (isAsked(item) && due_[item] < query.second) query = {item, due_[item]};
    return query;
}

bool ProjectorControl::isQueryDue(Item item, double now) const {
    return isAsked(item) && due_.at(item) <= now;
}

// Nothing is commanded before it was asked once, nor without asking anew what can be asked.
ProjectorStep ProjectorControl::next(double now) const {
    if (now < restUntil_) return {"", restUntil_};
    const Query query = nextQuery();
    double until = query.second;
    for (const Item item : needed()) {
        if (isQueryDue(item, now)) return {queryOf(item)};
        if (wishes_.at(item).notBefore <= now) return {commandOf(item)};
        until = std::min(until, wishes_.at(item).notBefore);
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

// Of an exchange that ended without a projector.
ProjectorReach ProjectorControl::reachOf(PjlinkEnd end) const {
    if (end != PjlinkEnd::Refused) return ProjectorReach::NoAnswer;
    return hasPassword_ ? ProjectorReach::RefusesPassword : ProjectorReach::WantsPassword;
}

// One that greets and does not answer a question may still answer others.
void ProjectorControl::noteAnswer(bool isAnswered, double now) {
    isThere_ = true;
    failures_ = 0;
    if (isAnswered) {
        answeredAt_ = now;
        facts_.reach = ProjectorReach::Answers;
    } else if (facts_.reach != ProjectorReach::Answers || now - answeredAt_ > kSilence) {
        facts_.reach = ProjectorReach::NoAnswer;
    }
}

// As next() has named it.
void ProjectorControl::heard(const std::string& command, const PjlinkReply& reply, double now) {
    if (reply.end == PjlinkEnd::Unreachable || reply.end == PjlinkEnd::Refused)
        return isOutOfReach(reachOf(reply.end), now);
    noteAnswer(reply.end == PjlinkEnd::Answered, now);
    const auto* const name = std::ranges::find(kCommands, command.substr(2, 4));
    const Item item = static_cast<Item>(name - kCommands.begin());
    if (command.ends_with("?"))
        heardState(item, reply.value, now);
    else
        heardOutcome(item, command, reply.value, now);
    showProblems();
}

// Sooner while something is under way, for some minutes.
double ProjectorControl::lookInterval() const {
    bool isUnderWay = isChanging();
    for (const Item item : needed()) {
        const Wish& wish = wishes_.at(item);
        isUnderWay = isUnderWay || (wish.sent < kSome && wish.taken < kEnoughOk);
    }
    return isUnderWay ? kWhileItChanges : kBetweenLooks;
}

// Until the same is asked again. Its power is asked at each look, whatever it says.
double ProjectorControl::intervalOf(Item item, const std::string& value) const {
    if (item == Power) return lookInterval();
    if (isLacking(value)) return kWhatItLacks;
    return item == Lamp && facts_.lampHours ? kLampHours : lookInterval();
}

// ERR1 and ERR2: it cannot tell; ERR3: not now; ERR4: it is broken.
void ProjectorControl::heardState(Item item, const std::string& value, double now) {
    takeState(item, value, now);
    if (!isLacking(value)) isBroken_.at(item) = value == "ERR4";
    due_.at(item) = now + intervalOf(item, value);
}

// Whatever is no value of the item leaves it unknown.
void ProjectorControl::takeState(Item item, const std::string& value, double now) {
    switch (item) {
        case Power:
            takePower(value, now);
            return settlePower(now);
        case Shutter:
            return takeShutter(shutIn(value));
        case Input:
            return takeInput(value);
        case Errors:
            told_ = problemsIn(value);
            return;
        default:
            facts_.lampHours = lampHoursIn(value);
    }
}

// What is confirmed is said at once where it changes by itself.
void ProjectorControl::takeShutter(std::optional<bool> isShut) {
    facts_.isShut = isShut;
    if (isShut && isShut == shut_) wishes_[Shutter] = {};
}

// A code has two characters; ERR1 to ERR4 have not.
void ProjectorControl::takeInput(const std::string& value) {
    constexpr std::size_t kCode = 2;
    facts_.input.reset();
    if (value.size() == kCode) facts_.input = value;
    if (facts_.input == input_) isInputSet_ = true;
}

// Warming for ever is not believed.
void ProjectorControl::takePower(const std::string& value, double now) {
    if (value != saidPower_) powerSince_ = now;
    saidPower_ = value;
    facts_.power = powerIn(value);
    if (isChanging() && now - powerSince_ > kLongestChange) facts_.power = LampPower::Unknown;
}

// One that comes on, from what it was last known to be, begins a picture; one that does not say for
// a minute what it is may have been off meanwhile.
void ProjectorControl::settlePower(double now) {
    const LampPower power = facts_.power;
    if (power == LampPower::On && lastPower_ != LampPower::On) beginPicture(now);
    if (power != LampPower::Unknown || now - powerSince_ > kSilence) lastPower_ = power;
    if (power == LampPower::Off || isChanging()) {
        facts_.isShut.reset();
        facts_.input.reset();
    }
    const bool isAtRest = power == LampPower::On || power == LampPower::Off;
    if (isAtRest && !isPowerNeeded()) wishes_[Power] = {};
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

// While a lamp comes on or goes off it is not asked for some seconds.
void ProjectorControl::toldPower(bool isOk, double now) {
    restUntil_ = now + kAfterAPowerCommand;
    due_[Power] = restUntil_;
    if (isOk && facts_.power == LampPower::Unknown) lastPower_ = LampPower::Unknown;
}

// Said again after a while, until it has what is wanted. What it can tell is asked before that.
void ProjectorControl::heardOutcome(Item item,
                                    const std::string& command,
                                    const std::string& value,
                                    double now) {
    if (item == Power)
        toldPower(value == "OK", now);
    else if (due_.at(item) - now <= kBetweenLooks)
        due_.at(item) = now + kAfterACommand;
    if (!isWished(item) || command != commandOf(item)) return;  // something else is wanted since
    Wish& wish = wishes_.at(item);
    ++wish.sent;
    if (value == "OK") ++wish.taken;
    wish.notBefore = now + pauseAfter(wish.sent, isUnknown(item), wish.taken);
    keepOutcome(item, value, now);
}

// Power, shutter and input alone have a state that is wanted.
bool ProjectorControl::isUnknown(Item item) const {
    if (item == Power) return facts_.power == LampPower::Unknown;
    return item == Shutter ? !facts_.isShut : !facts_.input;
}

// What it cannot do is shown until it does it.
void ProjectorControl::keepOutcome(Item item, const std::string& value, double now) {
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
    refusals_[item] =
        item == Input ? "the projector has none of that code" : "it cannot be set by PJLink";
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
