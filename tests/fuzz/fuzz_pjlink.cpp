// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "console/projectors/projector.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

// Whatever is answered to each question, it goes on: with another one, a command or a rest.
void fuzzControl(const std::string& value) {
    console::ProjectorControl control("31");
    control.want(true, false);
    double now = 1;
    for (int i = 0; i < 20; ++i) {
        const console::ProjectorStep step = control.next(now);
        promise(!step.command.empty() || step.until > now, "a rest is ahead");
        if (step.command.empty())
            now = step.until;
        else
            control.heard(step.command, {console::PjlinkEnd::Answered, value}, now);
    }
    promise(control.facts().problems.size() <= 16, "problems are few");
}

}  // namespace

int fuzzPjlink(const std::uint8_t* bytes, std::size_t size) {
    const std::string line(reinterpret_cast<const char*>(bytes), size);
    const auto isPrintable = [](const std::string& text) {
        return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
    };
    if (const auto greeting = console::readGreeting(line))
        promise(greeting->salt.size() <= 32 && isPrintable(greeting->salt), "a salt is short text");
    for (const char* const command : {"%1POWR ?", "%1LAMP ?", "%2INPT ?"})
        if (const auto value = console::readPjlinkAnswer(line, command))
            promise(
                !value->empty() && value->size() < console::kMostPjlinkBytes && isPrintable(*value),
                "a value is short text");
    if (const auto problems = console::problemsIn(line))
        promise(problems->size() <= 6, "a projector has six parts");
    if (const auto hours = console::lampHoursIn(line))
        promise(*hours < 1'000'000, "no lamp lasts a century");
    static_cast<void>(console::shutIn(line));
    fuzzControl(line);
    return 0;
}

}  // namespace aquarama
