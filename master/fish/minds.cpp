// SPDX-License-Identifier: Apache-2.0
#include "master/fish/minds.h"

#include "common/units/folded_hash.h"

namespace aquarama {

namespace {

template <class Column>
void each(auto& minds, const Column& column) {
    column(minds.intention, &Mind::intention);
    column(minds.target, &Mind::target);
    column(minds.pursued, &Mind::pursued);
    column(minds.remembered, &Mind::remembered);
    column(minds.rememberedTarget, &Mind::rememberedTarget);
    column(minds.sinceRemembered, &Mind::sinceRemembered);
    column(minds.sinceMeal, &Mind::sinceMeal);
    column(minds.sinceSpawning, &Mind::sinceSpawning);
    column(minds.sinceChase, &Mind::sinceChase);
    column(minds.alarm, &Mind::alarm);
    column(minds.eaten, &Mind::eaten);
    column(minds.likes, &Mind::likes);
    column(minds.stage, &Mind::stage);
    column(minds.sinceStage, &Mind::sinceStage);
}

}  // namespace

void Minds::resize(std::size_t fish) {
    const Mind fresh;
    each(*this, [&](auto& values, auto member) { values.resize(fish, fresh.*member); });
}

Mind Minds::at(std::size_t fish) const {
    Mind mind;
    each(*this, [&](const auto& values, auto member) { mind.*member = values[fish]; });
    return mind;
}

void Minds::set(std::size_t fish, const Mind& mind) {
    each(*this, [&](auto& values, auto member) { values[fish] = mind.*member; });
}

std::uint64_t Minds::hash() const {
    std::uint64_t hash = 1;
    each(*this, [&](const auto& values, auto) { hash = folded(hash, values); });
    return hash;
}

std::size_t Minds::bytes() const {
    std::size_t bytes = 0;
    each(*this, [&](const auto& values, auto) { bytes += bytesIn(values); });
    return bytes;
}

}  // namespace aquarama
